//! Kinematic loops as joints that are not of the articulation.
//!
//! The axis of a loop is z. A generic joint turns about x of its first frame last (`rotX` is the twist): that of a universal
//! joint is the second body's axis, and y the first body's.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{UnitQuaternion, Vector3};

use super::joints::connect;
use super::names::{Paths, mend};
use super::prim::Prim;
use crate::Subject;
use crate::loops::Closing;
use urdd_format::loops::LoopKind;

/// The prim of a loop's joint.
pub(super) fn prim(subject: &Subject, paths: &Paths, name: String, closing: &Closing) -> Prim {
    let about = |axis: Vector3<f64>, angle: f64| {
        UnitQuaternion::from_axis_angle(&nalgebra::Unit::new_unchecked(axis), angle)
    };
    let none = [UnitQuaternion::identity(); 2];
    // Which axes move, where the joint is a generic one: along x, y, z, and about them.
    let (kind, turns, free) = match closing.of.kind {
        LoopKind::Fixed => ("PhysicsFixedJoint", none, None),
        LoopKind::Revolute => ("PhysicsRevoluteJoint", none, None),
        LoopKind::Prismatic => ("PhysicsPrismaticJoint", none, None),
        LoopKind::Spherical => ("PhysicsSphericalJoint", none, None),
        LoopKind::Cylindrical => {
            ("PhysicsJoint", none, Some([false, false, true, false, false, true]))
        }
        LoopKind::Planar => ("PhysicsJoint", none, Some([true, true, false, false, false, true])),
        LoopKind::Universal => {
            let turns = [about(Vector3::x(), FRAC_PI_2), about(Vector3::y(), -FRAC_PI_2)];
            ("PhysicsJoint", turns, Some([false, false, false, true, true, false]))
        }
    };
    let mut prim = Prim::new(kind, name);
    if mend(&closing.of.name) != closing.of.name {
        prim.show(&closing.of.name);
    }
    let [a, b] = closing.ends;
    let frames = [a.pose * turns[0], b.pose * turns[1]];
    connect(&mut prim, Some(&paths.links[a.link]), &paths.links[b.link], &frames);
    prim.set("bool physics:excludeFromArticulation", "1");
    let is_tried = subject.pairs.iter().any(|pair| {
        !pair.disabled && (pair.links == [a.link, b.link] || pair.links == [b.link, a.link])
    });
    if is_tried {
        prim.set("bool physics:collisionEnabled", "1");
    }
    match free {
        Some(free) => super::joints::generic(&mut prim, free),
        None if matches!(closing.of.kind, LoopKind::Revolute | LoopKind::Prismatic) => {
            prim.set("uniform token physics:axis", "\"Z\"");
        }
        None => {}
    }
    prim
}
