//! Joints between bodies, with limits, drives and mimics; and kinematic loops as joints that are not of the articulation.

use std::collections::HashMap;

use nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};

use super::prim::{Filters, Paths, Prim, elements, float, floats, mend, wxyz};
use crate::gains::positive;
use crate::joints::{Closing, Followers, moved, range};
use crate::names::last;
use crate::{Gains, Note, Subject};
use urdd_directory::export_toml::ActuatorKind;
use urdd_document::robot::Joint;
use urdd_format::loops::LoopKind;
use urdd_format::urdf::{JointType, Limit};
use urdd_kinematics::rotation::{planar_basis, unit_axis};

const LOCKED: &str = "its limits are equal; it is a fixed joint there";
const CROSSED: &str = "its lower limit is above its upper one, which USD takes for a joint that is locked; it has no limits";
const AXIS: &str = "its axis is zero; it is fixed";
const SEVERAL: &str =
    "it mimics a joint of several DOFs, which USD cannot express; it moves freely";
const STANDS: &str =
    "it mimics a joint that never moves; it is a fixed joint at the position that follows";
const OTHER: &str = "it mimics a joint of another kind, for which Newton's schema defines no units; Newton takes rad and m";

const UNLIMITED: &str = "it mimics a joint, and one of the two has no limits: PhysX couples only joints with limits, so that it moves freely there; Newton couples them";

const AXES: [&str; 6] = ["transX", "transY", "transZ", "rotX", "rotY", "rotZ"];

pub(super) struct Joints<'a> {
    pub subject: &'a Subject<'a>,
    pub paths: &'a Paths,
    pub filters: &'a Filters,
    /// What moves each joint.
    pub drives: Option<Vec<Option<Gains>>>,
    /// Couplings that are mimics.
    pub followers: Followers,
    /// The configuration in which the bodies are.
    pub values: HashMap<&'a str, f64>,
}

enum Motion {
    /// Not at all, at that position of a joint of one DOF.
    Fixed(f64),
    One {
        kind: &'static str,
        instance: &'static str,
        unit: f64,
        axis: Vector3<f64>,
    },
    Ball,
    /// As a generic joint along and about axes of a frame.
    Generic(UnitQuaternion<f64>, [bool; 6]),
}

impl Joints<'_> {
    /// The position of a joint of one DOF in the configuration of the bodies.
    fn position(&self, index: usize) -> f64 {
        match &self.subject.mimics.by_joint[index] {
            Some(of) => of.multiplier * self.position(of.driver) + of.offset,
            None => {
                let name = self.subject.view.joints[index].name.as_str();
                self.values.get(name).copied().unwrap_or(0.0)
            }
        }
    }

    fn motion(&self, index: usize, notes: &mut Vec<Note>) -> Motion {
        let joint = &self.subject.view.joints[index];
        if let Some(position) = self.subject.stands_at(index) {
            let what = if joint.num_dofs() == 0 {
                None
            } else if unit_axis(joint.axis).is_none() {
                Some(AXIS)
            } else if self.subject.mimics.by_joint[index].is_some() {
                Some(STANDS)
            } else {
                Some(LOCKED)
            };
            notes.extend(what.map(|what| Note::joint(&joint.name, what)));
            return Motion::Fixed(position);
        }
        let axis = unit_axis(joint.axis).unwrap_or(Vector3::x_axis());
        let one = |kind, instance, unit| Motion::One { kind, instance, unit, axis: *axis };
        match joint.joint_type {
            JointType::Fixed => Motion::Fixed(0.0),
            JointType::Revolute | JointType::Continuous => {
                one("PhysicsRevoluteJoint", "angular", 1f64.to_degrees())
            }
            JointType::Prismatic => one("PhysicsPrismaticJoint", "linear", 1.0),
            JointType::Spherical => Motion::Ball,
            JointType::Planar => {
                let [x, y] = planar_basis(&axis);
                let frame = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, *axis]));
                let frame = UnitQuaternion::from_rotation_matrix(&frame);
                Motion::Generic(frame, [true, true, false, false, false, true])
            }
            JointType::Floating => Motion::Generic(UnitQuaternion::identity(), [true; 6]),
        }
    }

    pub fn prim(&self, index: usize, notes: &mut Vec<Note>) -> Prim {
        let subject = self.subject;
        let (joint, name) = (&subject.view.joints[index], last(&self.paths.joints[index]));
        let origin = joint.origin.motion();
        let motion = self.motion(index, notes);
        let (kind, frames) = match &motion {
            Motion::Fixed(position) => {
                let own = match joint.num_dofs() {
                    1 => moved(joint, *position),
                    _ => Isometry3::identity(),
                };
                ("PhysicsFixedJoint", [origin * own, Isometry3::identity()])
            }
            Motion::One { kind, axis, .. } => (*kind, turned(&origin, &aligned(axis).1)),
            Motion::Ball => ("PhysicsSphericalJoint", turned(&origin, &UnitQuaternion::identity())),
            Motion::Generic(frame, _) => ("PhysicsJoint", turned(&origin, frame)),
        };
        let mut prim = Prim::new(kind, name);
        prim.show(&joint.name);
        elements(&mut prim, &subject.urdf.joints[index].unknown_elements);
        let (parent, child) = subject.tree.joint_links[index];
        connect(&mut prim, Some(&self.paths.links[parent]), &self.paths.links[child], &frames);
        if self.filters.checked.contains(&index) {
            prim.set("bool physics:collisionEnabled", "1");
        }
        match motion {
            Motion::Fixed(_) => {}
            Motion::One { instance, unit, axis, .. } => {
                let token = aligned(&axis).0;
                prim.set("uniform token physics:axis", format!("\"{token}\""));
                if let Some((lower, upper)) = range(joint, CROSSED, notes) {
                    prim.set("float physics:lowerLimit", float(lower * unit));
                    prim.set("float physics:upperLimit", float(upper * unit));
                }
                self.inner(index, unit, &mut prim);
                self.drive(index, instance, unit, &mut prim);
                self.mimic(index, token, unit, &mut prim, notes);
            }
            Motion::Ball => self.inner(index, 1f64.to_degrees(), &mut prim),
            Motion::Generic(_, free) => {
                generic(&mut prim, free);
            }
        }
        prim
    }

    /// Damping, friction, the motor's inertia and the greatest velocity, for Newton and for PhysX.
    fn inner(&self, index: usize, unit: f64, prim: &mut Prim) {
        let dynamics = self.subject.urdf.joints[index].dynamics.as_ref();
        let armature = self.subject.gains(index).armature;
        let velocity = self.limit_of(index, |limit| limit.velocity).map(|velocity| velocity * unit);
        let damping = positive(dynamics.and_then(|of| of.damping)).map(|damping| damping / unit);
        let friction = positive(dynamics.and_then(|of| of.friction));
        let mut set = |schema: &str, attribute: &str, value: Option<f64>| {
            if let Some(value) = value {
                prim.apply(schema);
                prim.set(&format!("float {attribute}"), float(value));
            }
        };
        set("NewtonJointAPI", "newton:armature", armature);
        set("NewtonJointAPI", "newton:damping", damping);
        set("NewtonJointAPI", "newton:friction", friction);
        set("NewtonJointAPI", "newton:velocityLimit", velocity);
        set("PhysxJointAPI", "physxJoint:armature", armature);
        set("PhysxJointAPI", "physxJoint:maxJointVelocity", velocity);
    }

    fn limit_of(&self, index: usize, of: fn(&Limit) -> Option<f64>) -> Option<f64> {
        positive(self.subject.urdf.joints[index].limit.as_ref().and_then(of))
    }

    /// Where the joint is, and what drives it there.
    fn drive(&self, index: usize, instance: &str, unit: f64, prim: &mut Prim) {
        let position = self.position(index);
        if position != 0.0 {
            prim.apply(format!("PhysicsJointStateAPI:{instance}"));
            prim.set(&format!("float state:{instance}:physics:position"), float(position * unit));
        }
        let Some(gains) = self.drives.as_ref().and_then(|drives| drives[index]) else { return };
        prim.apply(format!("PhysicsDriveAPI:{instance}"));
        let mut set = |name: &str, value: f64| {
            prim.set(&format!("float drive:{instance}:physics:{name}"), float(value));
        };
        set("stiffness", gains.kp / unit);
        set("damping", gains.kv / unit);
        if let Some(effort) = self.limit_of(index, |limit| limit.effort) {
            set("maxForce", effort);
        }
        if gains.kind == ActuatorKind::Position {
            set("targetPosition", position * unit);
        }
    }

    fn mimic(&self, index: usize, axis: &str, unit: f64, prim: &mut Prim, notes: &mut Vec<Note>) {
        let Some(mimic) = self.followers.mimic(self.subject, index) else { return };
        let joints = &self.subject.view.joints;
        let mut note = |what| notes.push(Note::joint(&joints[index].name, what));
        let [own, other] = [index, mimic.driver].map(|index| &joints[index]);
        if other.num_dofs() > 1 {
            note(SEVERAL);
            return;
        }
        let slides = |joint: &Joint| joint.joint_type == JointType::Prismatic;
        if slides(own) != slides(other) {
            note(OTHER);
        }
        let driver = std::slice::from_ref(&self.paths.joints[mimic.driver]);
        prim.apply("NewtonMimicAPI");
        prim.relate("newton:mimicJoint", driver);
        prim.set("float newton:mimicCoef0", float(mimic.offset * unit));
        prim.set("float newton:mimicCoef1", float(mimic.multiplier));
        let is_limited = |joint: &Joint| {
            let limits = joint.position_limits();
            limits.is_some_and(|(lower, upper)| lower <= upper && (upper - lower).is_finite())
        };
        if !is_limited(own) || !is_limited(other) {
            note(UNLIMITED);
            return;
        }
        // PhysX has own + gearing * other + offset = 0. It knows an axis by `rotX`, `rotY` or `rotZ` also where a joint
        // slides, and passes over any other name.
        let instance = format!("rot{axis}");
        let other_axis = unit_axis(other.axis).map_or("X", |axis| aligned(&axis).0);
        prim.apply(format!("PhysxMimicJointAPI:{instance}"));
        prim.relate(&format!("physxMimicJoint:{instance}:referenceJoint"), driver);
        let name = |name: &str| format!("physxMimicJoint:{instance}:{name}");
        let axis_name = format!("uniform token {}", name("referenceJointAxis"));
        prim.set(&axis_name, format!("\"rot{other_axis}\""));
        prim.set(&format!("float {}", name("gearing")), float(-mimic.multiplier));
        prim.set(&format!("float {}", name("offset")), float(-mimic.offset * unit));
    }

    /// The joint that fixes the root link to the world.
    pub fn to_world(&self) -> Prim {
        let mut prim = Prim::new("PhysicsFixedJoint", self.paths.world.as_str());
        let frames = [Isometry3::identity(); 2];
        connect(&mut prim, None, &self.paths.links[self.subject.tree.root], &frames);
        prim
    }
}

/// The axis of USD that is the joint's, and the rotation that takes one to the other.
fn aligned(axis: &Vector3<f64>) -> (&'static str, UnitQuaternion<f64>) {
    let axes = [("X", Vector3::x()), ("Y", Vector3::y()), ("Z", Vector3::z())];
    if let Some((token, _)) = axes.iter().find(|(_, of)| of == axis) {
        return (token, UnitQuaternion::identity());
    }
    let half_turn = || UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::PI);
    ("X", UnitQuaternion::rotation_between(&Vector3::x(), axis).unwrap_or_else(half_turn))
}

/// The frames of a joint in its parent and in its child, turned alike.
fn turned(origin: &Isometry3<f64>, by: &UnitQuaternion<f64>) -> [Isometry3<f64>; 2] {
    let by = Isometry3::from_parts(nalgebra::Translation3::identity(), *by);
    [origin * by, by]
}

/// Says which axes of a generic joint move.
pub(super) fn generic(prim: &mut Prim, free: [bool; 6]) {
    for (axis, free) in AXES.into_iter().zip(free) {
        prim.apply(format!("PhysicsLimitAPI:{axis}"));
        let [low, high] = if free { ["-inf", "inf"] } else { ["1", "-1"] };
        prim.set(&format!("float limit:{axis}:physics:low"), low);
        prim.set(&format!("float limit:{axis}:physics:high"), high);
    }
}

/// Connects the parent, or the world, and the child.
pub(super) fn connect(
    prim: &mut Prim,
    parent: Option<&String>,
    child: &str,
    frames: &[Isometry3<f64>; 2],
) {
    if let Some(parent) = parent {
        prim.relate("physics:body0", std::slice::from_ref(parent));
    }
    prim.relate("physics:body1", &[child.to_owned()]);
    for (place, frame) in frames.iter().enumerate() {
        let position = floats(frame.translation.vector.as_slice());
        prim.set(&format!("point3f physics:localPos{place}"), position);
        prim.set(&format!("quatf physics:localRot{place}"), floats(&wxyz(&frame.rotation)));
    }
}

/// Why a universal joint is left out.
pub(super) const UNIVERSAL: &str =
    "USD does not say in which order a generic joint turns about its axes";

/// The prim of a loop's joint; `None` of a universal joint.
pub(super) fn closing_prim(
    subject: &Subject,
    paths: &Paths,
    name: String,
    closing: &Closing,
) -> Option<Prim> {
    const CYLINDER: [bool; 6] = [false, false, true, false, false, true];
    const PLANE: [bool; 6] = [true, true, false, false, false, true];
    let (kind, free) = match closing.of.kind {
        LoopKind::Fixed => ("PhysicsFixedJoint", None),
        LoopKind::Revolute => ("PhysicsRevoluteJoint", None),
        LoopKind::Prismatic => ("PhysicsPrismaticJoint", None),
        LoopKind::Spherical => ("PhysicsSphericalJoint", None),
        LoopKind::Cylindrical => ("PhysicsJoint", Some(CYLINDER)),
        LoopKind::Planar => ("PhysicsJoint", Some(PLANE)),
        LoopKind::Universal => return None,
    };
    let mut prim = Prim::new(kind, name);
    if mend(&closing.of.name) != closing.of.name {
        prim.show(&closing.of.name);
    }
    let [a, b] = closing.ends;
    let frames = [a.pose, b.pose];
    connect(&mut prim, Some(&paths.links[a.link]), &paths.links[b.link], &frames);
    prim.set("bool physics:excludeFromArticulation", "1");
    let is_checked = |links: [usize; 2]| links == [a.link, b.link] || links == [b.link, a.link];
    if subject.pairs.iter().any(|pair| !pair.disabled && is_checked(pair.links)) {
        prim.set("bool physics:collisionEnabled", "1");
    }
    match (closing.of.kind, free) {
        (_, Some(free)) => generic(&mut prim, free),
        (LoopKind::Revolute | LoopKind::Prismatic, None) => {
            prim.set("uniform token physics:axis", "\"Z\"");
        }
        (_, None) => {}
    }
    Some(prim)
}
