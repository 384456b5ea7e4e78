//! Kinematic loops (SPEC 6.8.3 to 6.8.7): gaps from two poses, and the matrix of what is held by differences of these.

use nalgebra::{DMatrix, Isometry3, Matrix3, UnitQuaternion, Vector3};

use crate::skip;
use crate::tolerance::{CLOSED, LEAST_SUM, POSITION_OF_REACH, reach, rotation_distance};
use urdd_document::pose::unit_quaternion;
use urdd_document::urdd::Urdd;
use urdd_findings::part::SkipReason;
use urdd_format::dof::Quantity;
use urdd_format::loops::{Coupling, Loop, LoopKind, LoopsModule};
use urdd_format::pose::Pose;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_kinematics::ForwardKinematics;

/// The step of differences, rad or reaches. Errors of them are below 1e-9, and ranks are told apart at 1e-5.
const STEP: f64 = 1e-5;

/// Most multiplications for the poses of all differences, and for the singular values.
const MOST_WORK: usize = 2_000_000_000;

/// A pose of a document. One that is no pose stands for the identity; LOP003 reports it.
fn isometry(pose: &Pose) -> Isometry3<f64> {
    let [w, x, y, z] = unit_quaternion(pose.quaternion_wxyz).unwrap_or([1.0, 0.0, 0.0, 0.0]);
    let rotation = UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(w, x, y, z));
    Isometry3::from_parts(pose.position.into(), rotation)
}

/// The pose of frame B in frame A.
fn between(one: &Loop, poses: &[Isometry3<f64>]) -> Option<Isometry3<f64>> {
    let a = poses.get(one.link_a_idx.get())? * isometry(&one.frame_a);
    let b = poses.get(one.link_b_idx.get())? * isometry(&one.frame_b);
    Some(a.inverse() * b)
}

/// How far a loop is from closed: m, and rad.
pub struct Gap {
    pub position: f64,
    pub rotation: f64,
    /// What is allowed of each.
    pub most: [f64; 2],
}

impl Gap {
    /// Of a loop, at the poses of a configuration of a robot with this reach.
    pub fn of(one: &Loop, poses: &[Isometry3<f64>], reach: f64) -> Option<Self> {
        let pose = between(one, poses)?;
        let p = pose.translation.vector;
        let matrix: Matrix3<f64> = pose.rotation.to_rotation_matrix().into_inner();
        let axis: Vector3<f64> = matrix.column(2).into();
        let all = || rotation_distance(&matrix, &Matrix3::identity());
        let direction = || (axis - Vector3::z()).norm();
        let (position, rotation) = match one.kind {
            LoopKind::Fixed => (p.norm(), all()),
            LoopKind::Revolute => (p.norm(), direction()),
            LoopKind::Prismatic => (p.x.hypot(p.y), all()),
            LoopKind::Cylindrical => (p.x.hypot(p.y), direction()),
            LoopKind::Universal => (p.norm(), axis.z.abs()),
            LoopKind::Spherical => (p.norm(), 0.0),
            LoopKind::Planar => (p.z.abs(), direction()),
        };
        let most =
            [one.position_tolerance + POSITION_OF_REACH * reach, one.rotation_tolerance + CLOSED];
        Some(Gap { position, rotation, most })
    }
}

/// The sum of a coupling, and how far from 0 it may be.
pub fn sum(coupling: &Coupling, configuration: &[f64]) -> Option<(f64, f64)> {
    let mut summands = vec![coupling.constant];
    for term in &coupling.terms {
        let q = *configuration.get(term.dof_idx.get())?;
        let powers = [q, q * q, q * q * q, q * q * q * q];
        // A power may overflow; with the coefficient 0 it says nothing all the same.
        let stated = term.coefficients.iter().zip(powers).filter(|(c, _)| **c != 0.0);
        summands.extend(stated.map(|(c, power)| c * power));
    }
    let size: f64 = summands.iter().map(|summand| summand.abs()).sum();
    Some((summands.iter().sum(), (CLOSED * size).max(LEAST_SUM)))
}

/// The least and greatest rank of what loops hold at the reference configuration that may be counted (SPEC 6.8.7); the same
/// without the columns of the independent DOFs.
///
/// # Errors
/// If that takes too much work, or there is nothing to compute it from.
pub fn ranks(urdd: &Urdd) -> Result<[[usize; 2]; 2], SkipReason> {
    let of = |kind| urdd.document_v1(kind);
    let documents = (of(ModuleKind::Loops), of(ModuleKind::Dof), of(ModuleKind::Chain));
    let (
        Some(ModuleDocument::Loops(loops)),
        Some(ModuleDocument::Dof(dof)),
        Some(ModuleDocument::Chain(chain)),
    ) = documents
    else {
        return Err(SkipReason::absent(ModuleKind::Loops));
    };
    let (robot, tree) = urdd.robot().zip(urdd.tree()).ok_or(skip::KINEMATICS_OPEN)?;
    let kinematics = ForwardKinematics::new(chain, dof).map_err(SkipReason::obstacle)?;
    let lengths: Vec<bool> = dof.dofs.iter().map(|dof| dof.quantity == Quantity::Length).collect();
    let reference = &loops.reference_configuration;
    let held = Held::new(loops, &kinematics, reference, &lengths, reach(robot, tree));
    let independent: Vec<usize> = loops.independent_dof_idxs.iter().map(|idx| idx.get()).collect();
    Ok(held.ok_or(skip::TOO_MANY_LOOPS)?.ranks(&independent))
}

/// The matrix M of SPEC 6.8.7 without columns of zeros: for each of its columns, the DOF.
struct Held {
    matrix: DMatrix<f64>,
    dofs: Vec<usize>,
}

impl Held {
    /// At a configuration; `lengths` says which DOFs are lengths. `None` if that takes too much work, or the configuration
    /// has no poses.
    fn new(
        module: &LoopsModule,
        kinematics: &ForwardKinematics,
        configuration: &[f64],
        lengths: &[bool],
        reach: f64,
    ) -> Option<Self> {
        let dofs = configuration.len();
        let rows = 6 * module.loops.len() + module.couplings.len();
        let poses = dofs.saturating_mul(kinematics.num_links() + rows).saturating_mul(200);
        let values = rows.max(dofs).saturating_mul(dofs.min(rows).saturating_pow(2));
        if poses > MOST_WORK || values.saturating_mul(4) > MOST_WORK {
            return None;
        }
        // What the row of each coupling is divided by.
        let of_row = |coupling| steepest(coupling, configuration, lengths, reach);
        let steepest: Option<Vec<f64>> = module.couplings.iter().map(of_row).collect();
        let divisor = |largest: f64| if largest > 0.0 { largest } else { 1.0 };
        let steepest: Vec<f64> = steepest?.into_iter().map(divisor).collect();
        let mut columns = Vec::new();
        let mut moving = Vec::new();
        for dof in 0..dofs {
            let unit = if *lengths.get(dof)? { reach } else { 1.0 };
            let at = |sign: f64| {
                let mut moved = configuration.to_vec();
                moved[dof] += sign * STEP * unit;
                kinematics.link_poses(&moved).ok()
            };
            let ends = [at(-1.0)?, at(1.0)?];
            let mut column = Vec::with_capacity(rows);
            for one in &module.loops {
                let [before, after] = [between(one, &ends[0])?, between(one, &ends[1])?];
                column.extend(rows_of(one.kind, &before, &after, reach));
            }
            for (coupling, largest) in module.couplings.iter().zip(&steepest) {
                column.push(slope(coupling, dof, *configuration.get(dof)?) * unit / largest);
            }
            // Of what does not move, rounding alone is left.
            if column.iter().any(|value| value.abs() > 1e-10) {
                columns.extend(column);
                moving.push(dof);
            }
        }
        let matrix = DMatrix::from_column_slice(rows, moving.len(), &columns);
        Some(Held { matrix, dofs: moving })
    }

    /// Its largest singular value, and how many are more than each of the fractions of it; without the columns of some DOFs.
    fn counts(matrix: DMatrix<f64>, largest: Option<f64>) -> (f64, [usize; 2]) {
        if matrix.is_empty() {
            return (largest.unwrap_or(0.0), [0, 0]);
        }
        let values = matrix.singular_values();
        let largest = largest.unwrap_or_else(|| values.max());
        let count = |fraction: f64| {
            values
                .iter()
                .filter(|value| **value > LEAST_VALUE && **value > fraction * largest)
                .count()
        };
        (largest, [count(RANK_AT_LEAST), count(RANK_AT_MOST)])
    }

    /// The least and the greatest rank that may be counted, and the same without the columns of some DOFs.
    fn ranks(&self, without: &[usize]) -> [[usize; 2]; 2] {
        let (largest, whole) = Self::counts(self.matrix.clone(), None);
        let kept: Vec<usize> = (0..self.dofs.len())
            .filter(|column| without.binary_search(&self.dofs[*column]).is_err())
            .collect();
        let (_, rest) = Self::counts(self.matrix.select_columns(&kept), Some(largest));
        [whole, rest]
    }
}

/// A singular value above this fraction of the largest counts.
const RANK_AT_LEAST: f64 = 1e-4;
/// One below this fraction does not.
const RANK_AT_MOST: f64 = 1e-6;

/// One that is not above this is rounding.
const LEAST_VALUE: f64 = 1e-9;

/// How the held numbers change between two steps.
fn rows_of(
    kind: LoopKind,
    before: &Isometry3<f64>,
    after: &Isometry3<f64>,
    reach: f64,
) -> [f64; 6] {
    let shift = (after.translation.vector - before.translation.vector) / (2.0 * STEP * reach);
    let turn = (after.rotation * before.rotation.inverse()).scaled_axis() / (2.0 * STEP);
    let axis = (after.rotation * Vector3::z() - before.rotation * Vector3::z()) / (2.0 * STEP);
    let turned = match kind {
        LoopKind::Fixed | LoopKind::Prismatic => turn,
        LoopKind::Revolute | LoopKind::Cylindrical | LoopKind::Planar => axis,
        LoopKind::Universal => Vector3::new(axis.z, 0.0, 0.0),
        LoopKind::Spherical => Vector3::zeros(),
    };
    let held = match kind {
        LoopKind::Prismatic | LoopKind::Cylindrical => [shift.x, shift.y, 0.0],
        LoopKind::Planar => [0.0, 0.0, shift.z],
        _ => shift.into(),
    };
    [held[0], held[1], held[2], turned.x, turned.y, turned.z]
}

/// The largest derivative of a summand of a coupling; for a length, times the reach.
fn steepest(
    coupling: &Coupling,
    configuration: &[f64],
    lengths: &[bool],
    reach: f64,
) -> Option<f64> {
    let mut largest = 0.0_f64;
    for term in &coupling.terms {
        let q = *configuration.get(term.dof_idx.get())?;
        let unit = if *lengths.get(term.dof_idx.get())? { reach } else { 1.0 };
        let [a, b, c, d] = term.coefficients;
        for slope in [a, 2.0 * b * q, 3.0 * c * q * q, 4.0 * d * q * q * q] {
            largest = largest.max((slope * unit).abs());
        }
    }
    Some(largest)
}

/// The derivative of a coupling's sum with respect to a DOF at q.
fn slope(coupling: &Coupling, dof: usize, q: f64) -> f64 {
    let of_dof = coupling.terms.iter().filter(|term| term.dof_idx.get() == dof);
    of_dof
        .map(|term| {
            let [a, b, c, d] = term.coefficients;
            a + 2.0 * b * q + 3.0 * c * q * q + 4.0 * d * q * q * q
        })
        .sum()
}
