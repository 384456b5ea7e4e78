//! Kinematic loops as joints that are not of the articulation. The axis of a loop is z.

use super::joints::{connect, generic};
use super::names::{Paths, mend};
use super::prim::Prim;
use crate::Subject;
use crate::loops::Closing;
use urdd_format::loops::LoopKind;

/// Why a universal joint is left out.
pub(super) const UNIVERSAL: &str =
    "USD does not say in which order a generic joint turns about its axes";

/// The prim of a loop's joint; `None` of a universal joint.
pub(super) fn prim(
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
