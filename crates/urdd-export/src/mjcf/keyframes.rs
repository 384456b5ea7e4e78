//! Keyframes: the named configurations of the URDD, as MuJoCo's positions and controls.

use crate::names::{ANOTHER, check_names};
use crate::order::Walk;
use crate::{ExportError, Stand, Subject};
use urdd_directory::export_toml::ActuatorKind;
use urdd_format::urdf::JointType;
use urdd_kinematics::rotation::from_rotation_vector;
use urdd_xml::number::numbers;
use urdd_xml::writer::Element;

/// The name of the keyframe of a robot whose URDD names none.
const DEFAULT: &str = "default";

/// The name of the keyframe in which loops are closed.
const CLOSED: &str = "closed";

/// A keyframe for each named configuration. Without one, actuators, a free base and a locked joint get the default configuration,
/// which differs from MuJoCo's zeros where 0 is out of bounds.
pub(super) fn keyframes(
    subject: &Subject,
    actuators: Option<ActuatorKind>,
    stand: &Stand,
) -> Result<Element, ExportError> {
    let mut keyframes = Element::new("keyframe");
    let named = subject.robot.named_configurations()?;
    let names = named.iter().map(|named| named.name.as_str());
    check_names(subject.format, "configuration", names, ANOTHER)?;
    let is_away = |joint| subject.locked_at(joint).is_some_and(|position| position != 0.0);
    let is_needed = actuators.is_some()
        || subject.has_free_base()
        || (0..subject.view.joints.len()).any(is_away);
    if named.is_empty() && is_needed {
        let zero = subject.robot.configurations()?.zero();
        keyframes.push(keyframe(subject, DEFAULT, actuators, &zero, stand)?);
    }
    // One in which the loops are closed comes first: MuJoCo pulls at those that are open.
    if let Some(loops) = subject.robot.loops()? {
        let mut name = CLOSED.to_owned();
        while named.iter().any(|named| named.name.as_str() == name) {
            name.push('_');
        }
        let reference = &loops.reference_configuration;
        keyframes.push(keyframe(subject, &name, actuators, reference, stand)?);
    }
    for named in named {
        let name = named.name.as_str();
        keyframes.push(keyframe(subject, name, actuators, &named.configuration, stand)?);
    }
    Ok(keyframes)
}

fn keyframe(
    subject: &Subject,
    name: &str,
    actuators: Option<ActuatorKind>,
    configuration: &[f64],
    stand: &Stand,
) -> Result<Element, ExportError> {
    let values = subject.values(configuration)?;
    let value = |dof: &str| values.get(dof).copied().unwrap_or(0.0);
    let mut positions = Vec::new();
    let mut controls = Vec::new();
    if subject.has_free_base() {
        positions.extend(stand.base(subject, Some(name), configuration)?);
    }
    // MuJoCo numbers joints as it meets their bodies: depth first, children in their order.
    for index in Walk::DepthFirst.joints(subject, &subject.names.joints) {
        let joint = &subject.view.joints[index];
        let part = |part: &str| value(&format!("{}/{part}", joint.name));
        let rotation = || {
            let q = from_rotation_vector(["rot_x", "rot_y", "rot_z"].map(part));
            [q.w, q.i, q.j, q.k]
        };
        match joint.joint_type {
            JointType::Fixed => {}
            JointType::Spherical => positions.extend(rotation()),
            JointType::Floating => {
                positions.extend(["trans_x", "trans_y", "trans_z"].map(part));
                positions.extend(rotation());
            }
            JointType::Planar => positions.extend(["trans_x", "trans_y", "rot"].map(part)),
            JointType::Revolute | JointType::Continuous | JointType::Prismatic => {
                positions.push(match &subject.mimics.by_joint[index] {
                    Some(mimic) => {
                        let driver = &subject.view.joints[mimic.driver];
                        let driven = match driver.num_dofs() {
                            1 => value(&driver.name),
                            _ => 0.0,
                        };
                        mimic.multiplier * driven + mimic.offset
                    }
                    None => value(&joint.name),
                });
            }
        }
    }
    // Actuators are in the order of joints.
    for (index, joint) in subject.view.joints.iter().enumerate() {
        if subject.is_actuated(index) {
            // A servo of speed stands still.
            let asked = ActuatorKind::Position;
            let is_position = subject.actuator_kind(index, asked) == asked;
            controls.push(if is_position { value(&joint.name) } else { 0.0 });
        }
    }
    let is_position = actuators == Some(ActuatorKind::Position);
    Ok(Element::new("key")
        .with("name", name)
        .with("qpos", numbers(&positions))
        .with_some("ctrl", (is_position && !controls.is_empty()).then(|| numbers(&controls))))
}
