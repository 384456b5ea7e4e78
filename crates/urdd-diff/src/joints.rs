//! Values of joints.

use crate::fields::{Fields, numbers};
use crate::other_elements;
use crate::side::Side;
use urdd_document::pose::unit;
use urdd_format::urdf::{Joint, JointType, Limit};
use urdd_xml::other_parts::{OtherParts, Owner};

/// `said` are names of attributes that another list compares.
pub(super) fn parts(
    side: &Side,
    others: Option<&OtherParts>,
    said: &[&str],
) -> Vec<(String, Fields)> {
    let part = |joint: &Joint| {
        let mut fields = fields(joint, side.has_quaternions());
        other_elements::add(&joint.unknown_elements, &side.account, &mut fields);
        let owner = Owner::Joint(joint.name.clone());
        other_elements::add_parts_but(others, &owner, said, &mut fields);
        (joint.name.clone(), fields)
    };
    side.robot.joints.iter().map(part).collect()
}

/// All values of a joint, with the defaults of SPEC 5.7, 5.10 and 6.1.8 in place of what is absent.
fn fields(joint: &Joint, quaternions: bool) -> Fields {
    let mut fields = Fields::default();
    fields.text("type", Some(joint.joint_type.as_str()));
    fields.text("parent", Some(&joint.parent.link));
    fields.text("child", Some(&joint.child.link));
    fields.origin("origin.", joint.origin.as_ref(), quaternions);
    if has_axis(joint.joint_type) {
        let axis = joint.axis.as_ref().and_then(|axis| axis.xyz).unwrap_or([1.0, 0.0, 0.0]);
        // Only the direction has a meaning.
        let direction = unit(axis).map_or(axis, Into::into);
        fields.keyed("axis", numbers(&direction), numbers(&axis));
    }
    if let Some(limit) = &joint.limit {
        add_limit(limit, joint.joint_type, &mut fields);
    }
    let dynamics = joint.dynamics.as_ref();
    let [position, _, _, damping, friction] = units(joint.joint_type);
    let value = dynamics.and_then(|dynamics| dynamics.damping);
    fields.number("dynamics.damping", damping, Some(value.unwrap_or(0.0)));
    let value = dynamics.and_then(|dynamics| dynamics.friction);
    fields.number("dynamics.friction", friction, Some(value.unwrap_or(0.0)));
    if let Some(mimic) = &joint.mimic {
        fields.text("mimic.joint", Some(&mimic.joint));
        fields.number("mimic.multiplier", "", Some(mimic.multiplier.unwrap_or(1.0)));
        fields.number("mimic.offset", position, Some(mimic.offset.unwrap_or(0.0)));
    }
    if let Some(safety) = &joint.safety_controller {
        for (name, unit, value) in [
            ("soft_lower_limit", position, safety.soft_lower_limit),
            ("soft_upper_limit", position, safety.soft_upper_limit),
            ("k_position", "", safety.k_position),
            ("k_velocity", "", safety.k_velocity),
        ] {
            fields.number(format!("safety_controller.{name}"), unit, value);
        }
    }
    if let Some(calibration) = &joint.calibration {
        fields.number("calibration.rising", position, calibration.rising);
        fields.number("calibration.falling", position, calibration.falling);
    }
    fields
}

/// Whether the axis of a joint has a meaning (SPEC 6.3.4).
fn has_axis(joint_type: JointType) -> bool {
    use JointType::{Continuous, Planar, Prismatic, Revolute};
    matches!(joint_type, Revolute | Continuous | Prismatic | Planar)
}

fn add_limit(limit: &Limit, joint_type: JointType, fields: &mut Fields) {
    let [position, speed, effort, ..] = units(joint_type);
    let (acceleration, jerk) = match joint_type {
        JointType::Prismatic => ("m/s²", "m/s³"),
        _ => ("rad/s²", "rad/s³"),
    };
    // Of the two, one that is absent is 0 (SPEC 6.5.2).
    let lower = limit.lower.or(limit.upper.map(|_| 0.0));
    let upper = limit.upper.or(limit.lower.map(|_| 0.0));
    for (name, unit, value) in [
        ("lower", position, lower),
        ("upper", position, upper),
        ("effort", effort, limit.effort),
        ("velocity", speed, limit.velocity),
        ("acceleration", acceleration, limit.acceleration),
        ("deceleration", acceleration, limit.deceleration),
        ("jerk", jerk, limit.jerk),
    ] {
        fields.number(format!("limit.{name}"), unit, value);
    }
}

/// Units of position, speed, effort, damping and friction.
fn units(joint_type: JointType) -> [&'static str; 5] {
    match joint_type {
        JointType::Prismatic => ["m", "m/s", "N", "N s/m", "N"],
        _ => ["rad", "rad/s", "N m", "N m s/rad", "N m"],
    }
}
