//! Gains of the actuators of joints of one DOF. They are computed, not tuned: a joint with inertia I follows its actuator
//! as a critically damped mass on a spring with the natural frequency w = 2 pi bandwidth.

use std::f64::consts::TAU;

use nalgebra::{Isometry3, Point3, Rotation3, Vector3};

use crate::inertia::tensor;
use crate::setup::USUAL_BANDWIDTH;
use crate::{ExportError, Note, Subject};
use urdd_directory::export_toml::ActuatorKind;
use urdd_document::robot::{Inertial, Joint};
use urdd_format::urdf::JointType;
use urdd_kinematics::rotation::unit_axis;
use urdd_xml::number::number;

/// Inertia of a joint that moves no mass, kg m² or kg: what the file assumes for bodies without mass.
const LEAST: f64 = 1e-9;

const SEVERAL: &str = "it has several DOFs; it has no actuator";

/// The gains of an actuator: N m/rad and N m s/rad, or N/m and N s/m. 0 for what its kind does not have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gains {
    pub kind: ActuatorKind,
    pub kp: f64,
    pub kv: f64,
}

/// The gains of each joint that has an actuator, in joint order, and a sentence about them.
pub(super) fn gains(
    subject: &Subject,
    kind: ActuatorKind,
    notes: &mut Vec<Note>,
) -> Result<(Vec<Option<Gains>>, String), ExportError> {
    let given = || subject.given.as_ref().and_then(|setup| setup.gains.bandwidth);
    let bandwidth = subject.options.chosen.bandwidth.or_else(given).unwrap_or(USUAL_BANDWIDTH);
    let frequency = TAU * bandwidth;
    let several = subject.view.joints.iter().filter(|joint| joint.num_dofs() > 1);
    notes.extend(several.map(|joint| Note::joint(&joint.name, SEVERAL)));
    let of_joint = |(index, inertia): (usize, Option<f64>)| {
        let chosen = subject.gains(index);
        let inertia = inertia?.max(LEAST) + chosen.armature.unwrap_or(0.0);
        let or = |chosen: Option<f64>, computed: f64| chosen.unwrap_or_else(|| rounded(computed));
        let kind = subject.actuator_kind(index, kind);
        let [kp, kv] = match kind {
            ActuatorKind::Position => [
                or(chosen.kp, inertia * frequency * frequency),
                or(chosen.kv, 2.0 * inertia * frequency),
            ],
            ActuatorKind::Velocity => [0.0, or(chosen.kv, inertia * frequency)],
            ActuatorKind::Motor => [0.0; 2],
        };
        Some(Gains { kind, kp, kv })
    };
    let all = inertias(subject)?.into_iter().enumerate().map(of_joint).collect();
    let bandwidth = number(bandwidth);
    let computed = |gains: &str| {
        format!(
            " Gains of actuators are computed from the inertia that each joint moves, for a bandwidth of {bandwidth} Hz: {gains}. They are not tuned, except those that a person set."
        )
    };
    let said = match kind {
        ActuatorKind::Position => computed("kp = I w^2, kv = 2 I w"),
        ActuatorKind::Velocity => computed("kv = I w"),
        ActuatorKind::Motor => " Actuators take torques and forces, N m and N.".to_owned(),
    };
    Ok((all, said))
}

pub(super) fn positive(value: Option<f64>) -> Option<f64> {
    value.filter(|value| *value > 0.0)
}

/// To four significant digits: more would say more than is known.
fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// Number of sampled configurations (SPEC 9.3) in which inertias are computed, besides the default one.
const SAMPLES: u64 = 32;

/// For each joint that an actuator drives, the inertia about or along its axis: the diagonal entry of the mass
/// matrix, kg m² or kg, the greatest over the default configuration and [`SAMPLES`] others. Joints that follow it count
/// with the square of their factor. The other joints do not move.
fn inertias(subject: &Subject) -> Result<Vec<Option<f64>>, ExportError> {
    let space = subject.robot.configurations()?;
    let joints = 0..subject.view.joints.len();
    let mut most: Vec<Option<f64>> =
        joints.map(|joint| subject.is_actuated(joint).then_some(0.0)).collect();
    let configurations = (0..SAMPLES).map(|k| space.random(k));
    for configuration in [space.zero()].into_iter().chain(configurations) {
        let poses = subject.link_poses(&configuration)?;
        let mut now = vec![0.0; most.len()];
        for (index, joint) in subject.view.joints.iter().enumerate() {
            if joint.num_dofs() != 1 {
                continue;
            }
            let own = moved(subject, index, joint, &poses);
            match &subject.mimics.by_joint[index] {
                Some(mimic) => now[mimic.driver] += mimic.multiplier * mimic.multiplier * own,
                None => now[index] += own,
            }
        }
        for (most, now) in most.iter_mut().zip(now) {
            *most = most.map(|most| most.max(now));
        }
    }
    Ok(most)
}

/// What a joint moves: the inertia of all links after it about its axis, or their mass.
fn moved(subject: &Subject, index: usize, joint: &Joint, poses: &[Isometry3<f64>]) -> f64 {
    let child = subject.tree.joint_links[index].1;
    let Some(axis) = unit_axis(joint.axis) else { return 0.0 };
    let axis = poses[child].rotation * axis.into_inner();
    let origin = poses[child].translation.vector;
    let mut links = vec![child];
    let mut sum = 0.0;
    while let Some(link) = links.pop() {
        let children = subject.tree.child_joints[link].iter();
        links.extend(children.map(|joint| subject.tree.joint_links[*joint].1));
        let Some(inertial) = &subject.view.links[link].inertial else { continue };
        let mass = inertial.mass.unwrap_or(0.0).max(0.0);
        sum += match joint.joint_type {
            JointType::Prismatic => mass,
            _ => about(inertial, mass, &poses[link], axis, origin),
        };
    }
    sum
}

/// The inertia of a link about an axis through `origin`, kg m².
fn about(
    inertial: &Inertial,
    mass: f64,
    pose: &Isometry3<f64>,
    axis: Vector3<f64>,
    origin: Vector3<f64>,
) -> f64 {
    let tensor = tensor(inertial.inertia.unwrap_or_default());
    let turned = pose.rotation * Rotation3::from_matrix_unchecked(inertial.origin.rotation());
    let own = turned.inverse() * axis;
    let centre = pose * Point3::from(inertial.origin.xyz);
    let arm = axis.cross(&(centre.coords - origin));
    // An inertia that is not positive is left out, as in the file.
    own.dot(&(tensor * own)).max(0.0) + mass * arm.norm_squared()
}
