//! What loops and couplings hold: how far a configuration is from it, and how that changes with the DOFs; and the equations of a
//! kind alone, in metres and radians, without the rows that are always 0.

use nalgebra::{Isometry3, Matrix3, Vector3};

use crate::forward::ForwardKinematics;
use crate::jacobian::columns;
use crate::loops::model::{Ends, Group, Loops, ROWS, Sum};
use crate::rotation::to_rotation_vector;
use urdd_format::loops::LoopKind;

/// How far a loop is from closed (SPEC 6.8.3).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Gap {
    /// m.
    pub position: f64,
    /// rad, while small.
    pub rotation: f64,
}

/// A loop that is not closed, or a coupling that does not hold, by its place in the module.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FirstOpen {
    /// A loop, with its gap.
    Loop(usize, Gap),
    /// A coupling, with its sum.
    Coupling(usize, f64),
}

/// Fraction of the reach, and angle in rad, within which a loop without tolerances counts as closed; fraction of its
/// summands within which a coupling holds (SPEC 6.8.4, 6.8.5).
pub(super) const CLOSED: f64 = 1e-9;

/// A coupling whose summands change less with each DOF does not change.
const LEAST_SLOPE: f64 = 1e-10;

/// The sum of a coupling may always be this far from 0.
const LEAST_SUM: f64 = 1e-12;

/// The numbers of a position or a rotation that are held: those of a table of SPEC 6.8.3.
#[derive(Clone, Copy, PartialEq)]
enum Turn {
    All,
    Direction,
    RightAngle,
    Nothing,
}

/// Which components of the position are held, and what of the rotation.
fn held(kind: LoopKind) -> ([bool; 3], Turn) {
    let all = [true; 3];
    match kind {
        LoopKind::Fixed => (all, Turn::All),
        LoopKind::Revolute => (all, Turn::Direction),
        LoopKind::Prismatic => ([true, true, false], Turn::All),
        LoopKind::Cylindrical => ([true, true, false], Turn::Direction),
        LoopKind::Universal => (all, Turn::RightAngle),
        LoopKind::Spherical => (all, Turn::Nothing),
        LoopKind::Planar => ([false, false, true], Turn::Direction),
    }
}

/// Which of the rows of a loop are equations: the others are 0 wherever it is closed.
pub(super) fn is_equation(kind: LoopKind) -> [bool; ROWS] {
    let ([x, y, z], turn) = held(kind);
    let [a, b, c] = match turn {
        Turn::All => [true; 3],
        Turn::Direction => [true, true, false],
        Turn::RightAngle => [true, false, false],
        Turn::Nothing => [false; 3],
    };
    [x, y, z, a, b, c]
}

impl Gap {
    /// That of a loop, for the pose of its frame B in its frame A.
    pub fn of(kind: LoopKind, between: &Isometry3<f64>) -> Self {
        let (axes, turn) = held(kind);
        let mut position = between.translation.vector;
        for (value, held) in position.iter_mut().zip(axes) {
            *value = if held { *value } else { 0.0 };
        }
        let matrix = *between.rotation.to_rotation_matrix().matrix();
        let axis = matrix.column(2);
        let rotation = match turn {
            Turn::All => (matrix - Matrix3::identity()).norm() / std::f64::consts::SQRT_2,
            Turn::Direction => (axis - Vector3::z()).norm(),
            Turn::RightAngle => axis.z.abs(),
            Turn::Nothing => 0.0,
        };
        Gap { position: position.norm(), rotation }
    }

    /// The angle of the rotation gap, rad: that of a turn, or of two directions.
    pub fn angle(&self) -> f64 {
        2.0 * (0.5 * self.rotation).clamp(0.0, 1.0).asin()
    }
}

impl Ends {
    fn between(&self, poses: &[Isometry3<f64>]) -> Isometry3<f64> {
        let [a, b] = self.world(poses);
        a.inv_mul(&b)
    }

    fn world(&self, poses: &[Isometry3<f64>]) -> [Isometry3<f64>; 2] {
        [0, 1].map(|end| poses[self.links[end]] * self.frames[end])
    }

    fn gap(&self, poses: &[Isometry3<f64>]) -> Gap {
        Gap::of(self.kind, &self.between(poses))
    }

    /// What is not 0 that should be: rows of the position divided by the reach, rows of the rotation in rad.
    pub(super) fn residual(&self, poses: &[Isometry3<f64>], reach: f64, rows: &mut [f64]) {
        let between = self.between(poses);
        let (axes, turn) = held(self.kind);
        for ((row, value), held) in rows.iter_mut().zip(between.translation.vector.iter()).zip(axes)
        {
            *row = if held { value / reach } else { 0.0 };
        }
        let axis = between.rotation * Vector3::z();
        let turned = match turn {
            Turn::All => Vector3::from(to_rotation_vector(&between.rotation)),
            Turn::Direction => axis - Vector3::z(),
            Turn::RightAngle => Vector3::new(axis.z, 0.0, 0.0),
            Turn::Nothing => Vector3::zeros(),
        };
        rows[3..ROWS].copy_from_slice(turned.as_slice());
    }

    /// Adds to `column(dof)`, of `ROWS` rows each, how the rows change with the DOF in its unit.
    pub(super) fn jacobian(
        &self,
        kinematics: &ForwardKinematics,
        poses: &[Isometry3<f64>],
        configuration: &[f64],
        (reach, unit): (f64, impl Fn(usize) -> f64),
        mut add: impl FnMut(usize, [f64; ROWS]),
    ) {
        let [a, b] = self.world(poses);
        let to_a = a.rotation.inverse();
        let point = b.translation.vector.into();
        let (axes, turn) = held(self.kind);
        let axis = to_a * (b.rotation * Vector3::z());
        for (steps, sign) in self.steps.iter().zip([-1.0, 1.0]) {
            for step in steps {
                let step = &kinematics.steps[*step];
                let frame = poses[step.parent].rotation * step.origin.rotation;
                let child = &poses[step.child].translation.vector;
                columns(step, &frame, child, &point, configuration, |dof, linear, angular| {
                    let factor = sign * unit(dof);
                    let linear = to_a * linear * (factor / reach);
                    let angular = to_a * angular * factor;
                    let turned = match turn {
                        Turn::All => angular,
                        Turn::Direction => angular.cross(&axis),
                        Turn::RightAngle => Vector3::new(angular.cross(&axis).z, 0.0, 0.0),
                        Turn::Nothing => Vector3::zeros(),
                    };
                    let mut rows = [0.0; ROWS];
                    for row in 0..3 {
                        rows[row] = if axes[row] { linear[row] } else { 0.0 };
                        rows[row + 3] = turned[row];
                    }
                    add(dof, rows);
                });
            }
        }
    }
}

impl Loops {
    /// How far apart the ends of each loop are, from the poses of the links.
    pub fn gaps(&self, poses: &[Isometry3<f64>]) -> impl Iterator<Item = Gap> {
        self.loops.iter().map(|one| one.gap(poses))
    }

    /// The sums of the couplings.
    pub fn sums(&self, configuration: &[f64]) -> impl Iterator<Item = f64> {
        self.couplings.iter().map(|one| one.at(configuration).value)
    }

    /// Whether all loops are closed and all couplings hold (SPEC 6.8.6), for a configuration and its link poses.
    pub fn is_closed(&self, configuration: &[f64], poses: &[Isometry3<f64>]) -> bool {
        self.first_open(configuration, poses).is_none()
    }

    /// The first loop that is not closed, or else the first coupling that does not hold.
    pub fn first_open(&self, configuration: &[f64], poses: &[Isometry3<f64>]) -> Option<FirstOpen> {
        let gaps = self.loops.iter().map(|one| (one.gap(poses), one.tolerances));
        let is_open = |(_, (gap, [position, rotation])): &(usize, (Gap, [f64; 2]))| {
            let position = gap.position <= position + CLOSED * self.reach;
            !(position && gap.rotation <= rotation + CLOSED)
        };
        let open = gaps.enumerate().find(is_open).map(|(k, (gap, _))| FirstOpen::Loop(k, gap));
        open.or_else(|| {
            let sums = self.couplings.iter().map(|one| one.at(configuration));
            let (k, sum) = sums.enumerate().find(|(_, sum)| !sum.holds())?;
            Some(FirstOpen::Coupling(k, sum.value))
        })
    }

    /// Writes what is not 0 that should be: [`Group::num_rows`] numbers.
    pub(super) fn residual_into(
        &self,
        group: &Group,
        configuration: &[f64],
        poses: &[Isometry3<f64>],
        out: &mut [f64],
    ) {
        let (loops, sums) = out.split_at_mut(ROWS * group.loops.len());
        for (one, rows) in group.loops.iter().zip(loops.chunks_exact_mut(ROWS)) {
            self.loops[*one].residual(poses, self.reach, rows);
        }
        for (one, row) in group.couplings.iter().zip(sums) {
            let one = &self.couplings[*one];
            *row = one.at(configuration).value / one.largest(configuration, &self.units);
        }
    }

    /// Writes the derivatives of the rows: a column of [`Group::num_rows`] numbers for each DOF of the group, in the DOF's
    /// unit.
    pub(super) fn jacobian_into(
        &self,
        group: &Group,
        kinematics: &ForwardKinematics,
        configuration: &[f64],
        poses: &[Isometry3<f64>],
        out: &mut [f64],
    ) {
        out.fill(0.0);
        let rows = group.num_rows();
        for (place, one) in group.loops.iter().enumerate() {
            let scale = (self.reach, |dof: usize| self.units[dof]);
            self.loops[*one].jacobian(kinematics, poses, configuration, scale, |dof, column| {
                let Ok(at) = group.dofs.binary_search(&dof) else { return };
                let begin = at * rows + place * ROWS;
                for (out, value) in out[begin..begin + ROWS].iter_mut().zip(column) {
                    *out += value;
                }
            });
        }
        for (place, one) in group.couplings.iter().enumerate() {
            let one = &self.couplings[*one];
            let largest = one.largest(configuration, &self.units);
            for (dof, coefficients) in &one.terms {
                let Ok(at) = group.dofs.binary_search(dof) else { continue };
                let slope = slope(coefficients, configuration[*dof]) * self.units[*dof];
                out[at * rows + ROWS * group.loops.len() + place] += slope / largest;
            }
        }
    }

    /// Adds to a symmetric matrix, of which row and column `place(dof)` are those of a DOF, the products of the columns of
    /// the equations with each other, times `weight`. The lower triangle alone, row by row. `columns` is memory.
    pub(crate) fn add_products(
        &self,
        kinematics: &ForwardKinematics,
        (configuration, poses): (&[f64], &[Isometry3<f64>]),
        place: &[Option<usize>],
        weight: f64,
        (matrix, size): (&mut [f64], usize),
        columns: &mut Vec<f64>,
    ) {
        for group in &self.groups {
            let rows = group.num_rows();
            columns.resize(rows * group.dofs.len(), 0.0);
            self.jacobian_into(group, kinematics, configuration, poses, columns);
            let column = |k: usize| &columns[k * rows..(k + 1) * rows];
            for (a, first) in group.dofs.iter().enumerate() {
                for (b, second) in group.dofs[..=a].iter().enumerate() {
                    let (Some(i), Some(j)) = (place[*first], place[*second]) else { continue };
                    let dot: f64 = column(a).iter().zip(column(b)).map(|(x, y)| x * y).sum();
                    let scale = weight / (self.units[*first] * self.units[*second]);
                    matrix[i.max(j) * size + i.min(j)] += scale * dot;
                }
            }
        }
    }
}

/// The sum of a coupling, and the sum of the absolute values of its summands.
pub(super) struct Summed {
    pub(super) value: f64,
    size: f64,
}

impl Summed {
    fn holds(&self) -> bool {
        self.value.is_finite() && self.value.abs() <= (CLOSED * self.size).max(LEAST_SUM)
    }
}

impl Sum {
    pub(super) fn at(&self, configuration: &[f64]) -> Summed {
        let mut sum = Summed { value: self.constant, size: self.constant.abs() };
        for (dof, coefficients) in &self.terms {
            let mut power = 1.0;
            for coefficient in coefficients {
                power *= configuration[*dof];
                sum.value += coefficient * power;
                sum.size += (coefficient * power).abs();
            }
        }
        sum
    }

    /// The largest derivative of a summand, each in its DOF's unit; 1 where all are 0 but for rounding.
    fn largest(&self, configuration: &[f64], units: &[f64]) -> f64 {
        let slopes = self.terms.iter().flat_map(|(dof, coefficients)| {
            slopes(coefficients, configuration[*dof]).map(|slope| (slope * units[*dof]).abs())
        });
        let largest = slopes.fold(0.0, f64::max);
        if largest > LEAST_SLOPE { largest } else { 1.0 }
    }
}

/// The derivative of a term.
pub(super) fn slope(coefficients: &[f64; 4], q: f64) -> f64 {
    slopes(coefficients, q).iter().sum()
}

/// The derivatives of the summands of a term.
fn slopes([a, b, c, d]: &[f64; 4], q: f64) -> [f64; 4] {
    [*a, 2.0 * b * q, 3.0 * c * q * q, 4.0 * d * q * q * q]
}

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
