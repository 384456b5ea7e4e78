//! The equations of loops as part of a larger problem of least squares.

use nalgebra::Isometry3;

use super::model::Loops;
use crate::forward::ForwardKinematics;

/// The derivatives of the equations of all groups of loops; reusable.
#[derive(Debug, Clone, Default)]
pub(crate) struct Linearised {
    /// For each DOF that a loop or coupling depends on, its column: what is held, in reaches and rad.
    columns: Vec<f64>,
}

impl Loops {
    /// Adds to a symmetric matrix, of which row and column `place(dof)` are those of a DOF, the products of the columns of
    /// the equations with each other, times `weight`. The lower triangle alone, row by row.
    pub(crate) fn add_products(
        &self,
        kinematics: &ForwardKinematics,
        (configuration, poses): (&[f64], &[Isometry3<f64>]),
        place: &[Option<usize>],
        weight: f64,
        (matrix, size): (&mut [f64], usize),
        linearised: &mut Linearised,
    ) {
        for group in &self.groups {
            let rows = group.num_rows();
            let columns = &mut linearised.columns;
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
