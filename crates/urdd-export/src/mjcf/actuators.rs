//! Actuators of the joints of one DOF. Gains are computed, not tuned: a joint with inertia I follows its actuator as a
//! critically damped mass on a spring with the natural frequency w = 2 pi bandwidth.

use std::f64::consts::TAU;

use super::super::error::{ExportError, Note};
use super::super::options::{ActuatorKind, MjcfOptions};
use super::super::subject::Subject;
use super::gains::inertias;
use urdd_xml::number::{number, numbers};
use urdd_xml::writer::Element;

/// Inertia of a joint that moves no mass, kg m² or kg: what the file assumes for bodies without mass.
const LEAST: f64 = 1e-9;

const SEVERAL: &str = "it has several DOFs; it has no actuator";

/// The actuators, and a sentence about them.
pub(super) struct Actuators {
    pub element: Element,
    pub said: String,
}

pub(super) fn actuators(
    subject: &Subject,
    bandwidth: Option<f64>,
    kind: ActuatorKind,
    notes: &mut Vec<Note>,
) -> Result<Actuators, ExportError> {
    let given = || subject.given.and_then(|setup| setup.gains.bandwidth);
    let bandwidth = bandwidth.or_else(given).unwrap_or(MjcfOptions::BANDWIDTH);
    let frequency = TAU * bandwidth;
    let mut element = Element::new("actuator");
    for (index, inertia) in inertias(subject)?.into_iter().enumerate() {
        let joint = &subject.view.joints[index];
        if joint.num_dofs() > 1 {
            notes.push(Note::joint(&joint.name, SEVERAL));
        }
        let Some(inertia) = inertia else {
            continue;
        };
        let chosen = subject.gains(index);
        let inertia = inertia.max(LEAST) + chosen.armature.unwrap_or(0.0);
        let gain = |chosen: Option<f64>, computed: f64| {
            number(chosen.unwrap_or_else(|| rounded(computed)))
        };
        let positive = |value: Option<f64>| value.filter(|value| *value > 0.0);
        let effort = positive(joint.limit.and_then(|limit| limit.effort));
        let velocity = positive(joint.limit.and_then(|limit| limit.velocity));
        let either_way = |most: Option<f64>| most.map(|most| numbers(&[-most, most]));
        let actuator = Element::new(kind.word()).with("name", joint.name.as_str());
        let actuator = actuator.with("joint", joint.name.as_str());
        element.push(match kind {
            ActuatorKind::Position => {
                let range = joint.position_limits().filter(|(lower, upper)| lower < upper);
                actuator
                    .with("kp", gain(chosen.kp, inertia * frequency * frequency))
                    .with("kv", gain(chosen.kv, 2.0 * inertia * frequency))
                    .with_some("ctrlrange", range.map(|(lower, upper)| numbers(&[lower, upper])))
                    .with_some("forcerange", either_way(effort))
            }
            ActuatorKind::Velocity => actuator
                .with("kv", gain(chosen.kv, inertia * frequency))
                .with_some("ctrlrange", either_way(velocity))
                .with_some("forcerange", either_way(effort)),
            ActuatorKind::Motor => actuator.with_some("ctrlrange", either_way(effort)),
        });
    }
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
    Ok(Actuators { element, said })
}

/// To four significant digits: more would say more than is known.
fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
