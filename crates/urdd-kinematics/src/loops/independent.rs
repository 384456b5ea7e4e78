//! Which DOFs move freely at a configuration, and which follow.

use nalgebra::Isometry3;

use super::model::Loops;
use crate::forward::ForwardKinematics;

/// A column counts while what is left of it exceeds this fraction of the largest column (SPEC 6.8.7).
pub(super) const RANK: f64 = 1e-5;

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
    /// Which DOFs move freely at a configuration. DOFs of `preferred` are chosen where others can follow from them.
    pub fn mobility(
        &self,
        kinematics: &ForwardKinematics,
        configuration: &[f64],
        poses: &[Isometry3<f64>],
        preferred: impl Fn(usize) -> bool,
    ) -> Mobility {
        self.mobility_by(kinematics, configuration, poses, |dof| u8::from(preferred(dof)))
    }

    /// As [`Loops::mobility`]; DOFs of a higher rank are rather independent than those of a lower one.
    pub fn mobility_by(
        &self,
        kinematics: &ForwardKinematics,
        configuration: &[f64],
        poses: &[Isometry3<f64>],
        rank: impl Fn(usize) -> u8,
    ) -> Mobility {
        let mut columns: Vec<Vec<f64>> = Vec::with_capacity(self.groups.len());
        for group in &self.groups {
            let mut left = vec![0.0; group.num_rows() * group.dofs.len()];
            self.jacobian_into(group, kinematics, configuration, poses, &mut left);
            columns.push(left);
        }
        let sizes = self
            .groups
            .iter()
            .zip(&columns)
            .flat_map(|(group, left)| left.chunks_exact(group.num_rows().max(1)).map(norm));
        let largest = sizes.fold(0.0, f64::max);
        let mut dependent: Vec<usize> = Vec::new();
        for (group, left) in self.groups.iter().zip(&mut columns) {
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
                    take_away(left, rows, pivot, size);
                }
            }
        }
        dependent.sort_unstable();
        let dofs = 0..kinematics.num_dofs();
        let independent = dofs.filter(|dof| dependent.binary_search(dof).is_err());
        Mobility { independent: independent.collect(), dependent }
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

pub(super) fn norm(column: &[f64]) -> f64 {
    column.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Makes all other columns orthogonal to one of a given norm: twice, so that they stay so in spite of rounding.
fn take_away(left: &mut [f64], rows: usize, pivot: usize, size: f64) {
    let direction: Vec<f64> =
        left[pivot * rows..(pivot + 1) * rows].iter().map(|x| x / size).collect();
    let others = left.chunks_exact_mut(rows).enumerate().filter(|(place, _)| *place != pivot);
    for (_, column) in others {
        for _ in 0..2 {
            let dot: f64 = column.iter().zip(&direction).map(|(a, b)| a * b).sum();
            for (value, direction) in column.iter_mut().zip(&direction) {
                *value -= dot * direction;
            }
        }
    }
}
