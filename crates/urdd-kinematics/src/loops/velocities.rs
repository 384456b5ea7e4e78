//! Velocities that keep loops closed.

use nalgebra::Isometry3;

use super::independent::{RANK, norm};
use super::model::Loops;
use crate::forward::ForwardKinematics;

/// Memory of [`Loops::velocities`]; reusable, so that further calls allocate nothing.
#[derive(Debug, Clone, Default)]
pub struct VelocityScratch {
    /// The columns of all groups, one group after another.
    columns: Vec<f64>,
    /// What is left of the right-hand side.
    left: Vec<f64>,
    /// Places in the group's DOFs that follow, in the order in which they were chosen.
    order: Vec<usize>,
    follows: Vec<usize>,
    /// The column that was chosen last, of length 1.
    direction: Vec<f64>,
    /// For each chosen column, how much of the others is along it.
    factor: Vec<f64>,
    values: Vec<f64>,
}

impl Loops {
    /// Computes the velocities of the DOFs that loops and couplings depend on and that are not `given`, from those that
    /// are: by least squares, as equations may say the same as others. False where they do not follow from them: the others
    /// could move alone, or no velocities of theirs keep the loops closed. `velocities` is then left as it was, or in part.
    pub fn velocities(
        &self,
        kinematics: &ForwardKinematics,
        configuration: &[f64],
        poses: &[Isometry3<f64>],
        given: impl Fn(usize) -> bool,
        velocities: &mut [f64],
        scratch: &mut VelocityScratch,
    ) -> bool {
        let VelocityScratch { columns, left, order, follows, direction, factor, values } = scratch;
        columns.clear();
        let mut largest = 0.0_f64;
        for group in &self.groups {
            let (first, rows) = (columns.len(), group.num_rows());
            columns.resize(first + rows * group.dofs.len(), 0.0);
            let of_group = &mut columns[first..];
            self.jacobian_into(group, kinematics, configuration, poses, of_group);
            largest = of_group.chunks_exact(rows.max(1)).map(norm).fold(largest, f64::max);
        }
        let mut columns = &mut columns[..];
        for group in &self.groups {
            let (rows, count) = (group.num_rows(), group.dofs.len());
            let (matrix, rest) = columns.split_at_mut(rows * count);
            columns = rest;
            let at = |place: usize| place * rows..(place + 1) * rows;
            left.clear();
            left.resize(rows, 0.0);
            let mut fastest = 0.0_f64;
            follows.clear();
            for (place, dof) in group.dofs.iter().enumerate() {
                if !given(*dof) {
                    follows.push(place);
                    continue;
                }
                let velocity = velocities[*dof] / self.units[*dof];
                fastest = fastest.max(velocity.abs());
                for (left, value) in left.iter_mut().zip(&matrix[at(place)]) {
                    *left -= value * velocity;
                }
            }
            order.clear();
            values.clear();
            factor.clear();
            factor.resize(follows.len() * count, 0.0);
            while !follows.is_empty() {
                let sizes = follows.iter().map(|place| norm(&matrix[at(*place)])).enumerate();
                let (best, size) = sizes.fold((0, 0.0), |a, b| if b.1 > a.1 { b } else { a });
                // The sizes of what is not finite are no better than 0.
                if size <= RANK * largest {
                    return false;
                }
                let (row, pivot) = (order.len() * count, follows.swap_remove(best));
                order.push(pivot);
                direction.clear();
                direction.extend(matrix[at(pivot)].iter().map(|value| value / size));
                factor[row + pivot] = size;
                for place in &*follows {
                    factor[row + place] = take_away(direction, &mut matrix[at(*place)]);
                }
                values.push(take_away(direction, left));
            }
            if norm(left) > RANK * largest * fastest {
                return false;
            }
            for (k, place) in order.iter().enumerate().rev() {
                let row = &factor[k * count..(k + 1) * count];
                let known = (k + 1..order.len()).map(|later| row[order[later]] * values[later]);
                values[k] = (values[k] - known.sum::<f64>()) / row[*place];
                let dof = group.dofs[*place];
                velocities[dof] = values[k] * self.units[dof];
            }
        }
        true
    }
}

/// Makes a column orthogonal to a direction of length 1; returns how much of it was along that. Twice, so that it stays so
/// in spite of rounding.
fn take_away(direction: &[f64], column: &mut [f64]) -> f64 {
    let mut along = 0.0;
    for _ in 0..2 {
        let dot: f64 = column.iter().zip(direction).map(|(a, b)| a * b).sum();
        column.iter_mut().zip(direction).for_each(|(value, of)| *value -= dot * of);
        along += dot;
    }
    along
}
