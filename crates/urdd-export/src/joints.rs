//! Joints in a form that every URDF reader accepts: mimic chains resolved, rotations as roll, pitch, yaw.

use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use crate::layout::origin;
use crate::loops::{Followers, LeftOut};
use crate::{ExportError, Note, Subject};
use urdd_document::pose::has_quaternions;
use urdd_document::robot::{Joint as View, Origin as ViewOrigin};
use urdd_document::tree::Resolved;
use urdd_format::urdf::{Joint, JointType, Mimic, Origin};
use urdd_kinematics::rotation::{to_rpy, unit_axis};

const STANDS: &str =
    "it mimics a fixed joint and never moves; it is exported as a fixed joint at its offset";
const SEVERAL: &str =
    "it mimics a joint of several DOFs, which no program supports; it moves freely";

/// The joints of the robot, in URDF order.
pub(super) fn joints(subject: &Subject, notes: &mut Vec<Note>) -> Vec<Joint> {
    let quaternions = has_quaternions(subject.urdf.version.as_deref());
    let each = subject.urdf.joints.iter().zip(&subject.view.joints).zip(&subject.mimics.by_joint);
    let joint = |((source, view), resolved): ((&Joint, &View), &Option<Resolved>)| {
        let mut joint = source.clone();
        joint.origin = (joint.origin.as_ref())
            .map(|origin| without_quaternion(origin, &view.origin, quaternions));
        let mut note = |what| notes.push(Note::joint(&view.name, what));
        // A mimic of a fixed joint is meaningless (SPEC 6.1.5).
        joint.mimic = None;
        if let Some(resolved) = resolved {
            let driver = &subject.view.joints[resolved.driver];
            match driver.num_dofs() {
                0 => {
                    note(STANDS);
                    return standing(joint, view, resolved.offset);
                }
                1 => joint.mimic = Some(mimic(source.mimic.as_ref(), driver, resolved)),
                _ => note(SEVERAL),
            }
        }
        joint
    };
    each.map(joint).collect()
}

/// The joints where couplings are mimics too, for formats that have no other couplings.
pub(super) fn coupled(subject: &Subject, notes: &mut Vec<Note>) -> Result<Vec<Joint>, ExportError> {
    let mut left_out = LeftOut::default();
    let followers = Followers::new(subject, &mut left_out)?;
    notes.extend(left_out.notes());
    let mut joints = joints(subject, notes);
    for (index, joint) in joints.iter_mut().enumerate() {
        let own = subject.mimics.by_joint[index];
        if let Some(of) = followers.mimic(subject, index).filter(|of| Some(*of) != own) {
            joint.mimic = Some(mimic(None, &subject.view.joints[of.driver], &of));
        }
    }
    Ok(joints)
}

/// The mimic as written in the source if it names the driver directly; otherwise the resolved one.
fn mimic(source: Option<&Mimic>, driver: &View, resolved: &Resolved) -> Mimic {
    match source {
        Some(source) if source.joint == driver.name => source.clone(),
        _ => Mimic {
            joint: driver.name.clone(),
            multiplier: Some(resolved.multiplier),
            offset: Some(resolved.offset),
        },
    }
}

/// Replaces a joint of one DOF by a fixed joint at `position`.
fn standing(joint: Joint, view: &View, position: f64) -> Joint {
    Joint {
        origin: Some(origin(&(view.origin.motion() * moved(view, position)))),
        unknown_elements: joint.unknown_elements,
        ..Joint::new(joint.name, JointType::Fixed, joint.parent.link, joint.child.link)
    }
}

/// The pose of a joint of one DOF at a position, in its frame.
pub(super) fn moved(joint: &View, position: f64) -> Isometry3<f64> {
    match (unit_axis(joint.axis), joint.joint_type) {
        (Some(axis), JointType::Prismatic) => {
            Isometry3::from(Translation3::from(axis.into_inner() * position))
        }
        (Some(axis), _) => Isometry3::from_parts(
            Translation3::identity(),
            UnitQuaternion::from_axis_angle(&axis, position),
        ),
        (None, _) => Isometry3::identity(),
    }
}

/// An origin without `quat_xyzw`, which most programs ignore. Before URDF 1.1 the attribute has no meaning.
pub(super) fn without_quaternion(origin: &Origin, view: &ViewOrigin, counts: bool) -> Origin {
    let mut plain = Origin { quat_xyzw: None, ..origin.clone() };
    if counts && origin.quat_xyzw.is_some() {
        plain.rpy = Some(to_rpy(&view.rotation()));
    }
    plain
}
