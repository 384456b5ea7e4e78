//! Actuators of the joints of one DOF.

use super::super::error::{ExportError, Note};
use super::super::gains::gains;
use super::super::options::ActuatorKind;
use super::super::subject::Subject;
use urdd_xml::number::{number, numbers};
use urdd_xml::writer::Element;

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
    let (gains, said) = gains(subject, bandwidth, kind, notes)?;
    let mut element = Element::new("actuator");
    for (joint, gains) in subject.view.joints.iter().zip(gains) {
        let Some(gains) = gains else {
            continue;
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
                    .with("kp", number(gains.kp))
                    .with("kv", number(gains.kv))
                    .with_some("ctrlrange", range.map(|(lower, upper)| numbers(&[lower, upper])))
                    .with_some("forcerange", either_way(effort))
            }
            ActuatorKind::Velocity => actuator
                .with("kv", number(gains.kv))
                .with_some("ctrlrange", either_way(velocity))
                .with_some("forcerange", either_way(effort)),
            ActuatorKind::Motor => actuator.with_some("ctrlrange", either_way(effort)),
        });
    }
    Ok(Actuators { element, said })
}
