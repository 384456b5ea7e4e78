//! Actuators of the joints of one DOF.

use std::collections::{BTreeMap, BTreeSet};

use crate::gains::{gains, positive};
use crate::names::{ANOTHER, check_names};
use crate::{ExportError, Note, Subject};
use urdd_directory::export_toml::ActuatorKind;
use urdd_xml::number::{number, numbers};
use urdd_xml::writer::Element;

pub(super) fn actuators(
    subject: &Subject,
    kind: ActuatorKind,
    notes: &mut Vec<Note>,
) -> Result<(Element, String), ExportError> {
    let (gains, said) = gains(subject, kind, notes)?;
    let mut element = Element::new("actuator");
    let mut names = names(subject)?;
    for (index, gains) in gains.into_iter().enumerate() {
        let Some(gains) = gains else { continue };
        let joint = &subject.view.joints[index];
        let chosen = subject.gains(index);
        let name = names.remove(&index).unwrap_or_default();
        let effort = positive(joint.limit.and_then(|limit| limit.effort));
        let velocity = positive(joint.limit.and_then(|limit| limit.velocity));
        let either_way = |most: Option<f64>| most.map(|most| [-most, most]);
        let limits = joint.position_limits().map(|(lower, upper)| [lower, upper]);
        let limits = limits.filter(|[lower, upper]| lower < upper);
        // What was set is of the kind that was set.
        let is_other = chosen.kind.unwrap_or(ActuatorKind::Position) != gains.kind;
        let told = chosen.ctrlrange.filter(|_| !is_other);
        let force = chosen.forcerange.or(either_way(effort));
        let (told, force) = match gains.kind {
            ActuatorKind::Position => (told.or(limits), force),
            ActuatorKind::Velocity => (told.or(either_way(velocity)), force),
            ActuatorKind::Motor => (force, None),
        };
        let (has_kp, has_kv) =
            (gains.kind == ActuatorKind::Position, gains.kind != ActuatorKind::Motor);
        let actuator = Element::new(gains.kind.word())
            .with("name", name)
            .with("joint", joint.name.as_str())
            .with_some("kp", has_kp.then(|| number(gains.kp)))
            .with_some("kv", has_kv.then(|| number(gains.kv)))
            .with_some("ctrlrange", told.map(|told| numbers(&told)))
            .with_some("forcerange", force.map(|force| numbers(&force)));
        element.push(actuator);
    }
    Ok((element, said))
}

/// The names of actuators, by joint: as a person set, or that of the joint.
pub(crate) fn names(subject: &Subject) -> Result<BTreeMap<usize, String>, ExportError> {
    let joints = 0..subject.view.joints.len();
    let given = |joint: usize| subject.gains(joint).name;
    let taken: BTreeSet<String> = joints.clone().filter_map(given).collect();
    check_names(subject.format, "actuator", taken.iter().map(String::as_str), ANOTHER)?;
    let mut names = subject.names.taken.clone();
    for name in &taken {
        names.insert(name);
    }
    let of_joint = |index: usize| {
        let joint = &subject.view.joints[index].name;
        let name = match given(index) {
            Some(name) => name,
            None if taken.contains(joint) => names.free(joint.clone()),
            None => joint.clone(),
        };
        (index, name)
    };
    Ok(joints.filter(|joint| subject.is_actuated(*joint)).map(of_joint).collect())
}
