//! The equations of loops and couplings in metres and radians, and their derivatives: those of a kind alone, without the
//! rows that are always 0.

use nalgebra::Isometry3;

use super::equations::{is_equation, slope};
use super::model::{Loops, ROWS};
use crate::forward::ForwardKinematics;

impl Loops {
    /// The number of equations: for each loop in the order of the module those of its kind, then one for each coupling.
    pub fn num_equations(&self) -> usize {
        let of_loops = self.loops.iter().map(|one| count(&is_equation(one.kind)));
        of_loops.sum::<usize>() + self.couplings.len()
    }

    /// Writes the left-hand side of each equation, which is 0 where it holds. For a loop first the held components of the
    /// position of frame B in frame A, m; then of its rotation R: the rotation vector where all of it is held, the x and y
    /// components of R ez where the direction of z is, the z component of R ez where the right angle is. Then the sums of
    /// the couplings.
    ///
    /// # Panics
    /// If `out` has fewer than [`Loops::num_equations`] entries.
    pub fn equations_into(&self, configuration: &[f64], poses: &[Isometry3<f64>], out: &mut [f64]) {
        let mut next = 0;
        for one in &self.loops {
            let mut rows = [0.0; ROWS];
            one.residual(poses, 1.0, &mut rows);
            for (row, _) in rows.iter().zip(is_equation(one.kind)).filter(|(_, held)| *held) {
                out[next] = *row;
                next += 1;
            }
        }
        for (one, out) in self.couplings.iter().zip(&mut out[next..]) {
            *out = one.at(configuration).value;
        }
    }

    /// Writes the derivatives of the equations by each DOF: column-major, [`Loops::num_equations`] numbers for each DOF.
    /// The rows of a rotation that is wholly held are the angular velocity of frame B relative to frame A, in frame A; that
    /// is the derivative of the rotation vector where the loop is closed.
    ///
    /// # Panics
    /// If `out` has fewer than [`Loops::num_equations`] numbers for each DOF.
    pub fn equations_jacobian_into(
        &self,
        kinematics: &ForwardKinematics,
        configuration: &[f64],
        poses: &[Isometry3<f64>],
        out: &mut [f64],
    ) {
        out.fill(0.0);
        let height = self.num_equations();
        let mut first = 0;
        for one in &self.loops {
            let held = is_equation(one.kind);
            one.jacobian(kinematics, poses, configuration, (1.0, |_| 1.0), |dof, rows| {
                let column = &mut out[dof * height + first..];
                let rows = rows.iter().zip(held).filter(|(_, held)| *held);
                for (out, (row, _)) in column.iter_mut().zip(rows) {
                    *out += row;
                }
            });
            first += count(&held);
        }
        for (row, one) in (first..).zip(&self.couplings) {
            for (dof, coefficients) in &one.terms {
                out[dof * height + row] += slope(coefficients, configuration[*dof]);
            }
        }
    }
}

fn count(held: &[bool]) -> usize {
    held.iter().filter(|held| **held).count()
}
