//! Kinematic loops (SPEC 6.8): how far they are from closed, the Jacobian of what they hold, which DOFs move freely, and the
//! nearest closed configuration.

mod close;
mod equations;
mod model;

use nalgebra::Isometry3;

use crate::forward::ForwardKinematics;

pub use close::{NotClosed, Scratch};
pub use equations::{FirstOpen, Gap};
pub use model::Loops;

pub(crate) use close::solve_cholesky;

/// A column counts while what is left of it exceeds this fraction of the largest column (SPEC 6.8.7).
const RANK: f64 = 1e-5;

/// And while it exceeds this.
const LEAST: f64 = 1e-9;

/// A DOF that is rather to be independent follows others only if those that may follow leave less than this.
const WELL: f64 = 1e-3;

/// The mobility at a configuration.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mobility {
    /// The DOFs that move freely, ascending.
    pub independent: Vec<usize>,
    /// The DOFs that follow from these, ascending.
    pub dependent: Vec<usize>,
}

impl Loops {
    /// Which DOFs move freely at a configuration. DOFs of a higher rank are chosen rather than those of a lower one, where the
    /// others can follow from them.
    pub fn mobility(
        &self,
        kinematics: &ForwardKinematics,
        configuration: &[f64],
        poses: &[Isometry3<f64>],
        rank: impl Fn(usize) -> u8,
    ) -> Mobility {
        let mut columns = Vec::new();
        let largest = self.columns_into(kinematics, configuration, poses, &mut columns);
        let mut columns = &mut columns[..];
        let mut dependent: Vec<usize> = Vec::new();
        for group in &self.groups {
            let (left, rest) = columns.split_at_mut(group.num_rows() * group.dofs.len());
            columns = rest;
            let rows = group.num_rows().max(1);
            let mut follows = vec![false; group.dofs.len()];
            let mut ranks: Vec<u8> = group.dofs.iter().map(|dof| rank(*dof)).collect();
            ranks.push(1);
            ranks.sort_unstable();
            ranks.dedup();
            let last = ranks.pop().unwrap_or_default();
            let phases = ranks.into_iter().map(|rank| (rank, WELL)).chain([(last, RANK)]);
            for (most, least) in phases {
                loop {
                    let rest = group
                        .dofs
                        .iter()
                        .enumerate()
                        .filter(|(place, dof)| !follows[*place] && rank(**dof) <= most);
                    let best = rest
                        .map(|(place, _)| (place, norm(&left[place * rows..(place + 1) * rows])))
                        .fold(None, better);
                    let Some((pivot, size)) =
                        best.filter(|(_, size)| *size > LEAST && *size > least * largest)
                    else {
                        break;
                    };
                    follows[pivot] = true;
                    dependent.push(group.dofs[pivot]);
                    let direction = &left[pivot * rows..(pivot + 1) * rows];
                    let direction: Vec<f64> = direction.iter().map(|x| x / size).collect();
                    let others = left.chunks_exact_mut(rows).enumerate();
                    for (_, column) in others.filter(|(place, _)| *place != pivot) {
                        take_away(&direction, column);
                    }
                }
            }
        }
        dependent.sort_unstable();
        let dofs = 0..kinematics.num_dofs();
        let independent = dofs.filter(|dof| dependent.binary_search(dof).is_err());
        Mobility { independent: independent.collect(), dependent }
    }

    /// Writes the derivatives of all groups, one group after another, a column for each DOF; the length of the longest one.
    fn columns_into(
        &self,
        kinematics: &ForwardKinematics,
        configuration: &[f64],
        poses: &[Isometry3<f64>],
        columns: &mut Vec<f64>,
    ) -> f64 {
        columns.clear();
        let mut largest = 0.0_f64;
        for group in &self.groups {
            let (first, rows) = (columns.len(), group.num_rows());
            columns.resize(first + rows * group.dofs.len(), 0.0);
            let of_group = &mut columns[first..];
            self.jacobian_into(group, kinematics, configuration, poses, of_group);
            largest = of_group.chunks_exact(rows.max(1)).map(norm).fold(largest, f64::max);
        }
        largest
    }
}

/// Columns that differ by less are as good, so that the last of them follows, whatever the rounding.
const AS_GOOD: f64 = 1e-6;

fn better(best: Option<(usize, f64)>, next: (usize, f64)) -> Option<(usize, f64)> {
    match best {
        Some(best) if best.1 * (1.0 - AS_GOOD) > next.1 => Some(best),
        _ => Some(next),
    }
}

fn norm(column: &[f64]) -> f64 {
    column.iter().map(|x| x * x).sum::<f64>().sqrt()
}

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
        let largest = self.columns_into(kinematics, configuration, poses, columns);
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
