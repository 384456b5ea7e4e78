//! What is left out: references that are not there, of which a robot may need some, and what no robot of ours has.

use urdd_usd::{Stage, UsdError};

use super::super::features::{self, Tally};
use super::joint::is_joint;
use super::scene::Scene;

/// The first that may hold a part of a robot: where bodies or joints are in the prim that brings it in, or it is in a body,
/// or a joint leads into it, or there are no bodies.
pub fn needed(stage: &Stage) -> Option<&UsdError> {
    // Of each prim: whether it is in a body, and whether a body or a joint is in it.
    let mut is_inside = vec![false; stage.prims.len()];
    let mut is_around = vec![false; stage.prims.len()];
    let mut has_bodies = false;
    let mut mark = |mut at: Option<usize>| {
        while let Some(prim) = at.filter(|prim| !std::mem::replace(&mut is_around[*prim], true)) {
            at = stage.prims[prim].parent;
        }
    };
    for (at, prim) in stage.prims.iter().enumerate() {
        let is_body = prim.has("PhysicsRigidBodyAPI");
        has_bodies |= is_body;
        is_inside[at] = is_body || prim.parent.is_some_and(|parent| is_inside[parent]);
        if is_body || is_joint(prim) {
            mark(Some(at));
        }
        let ends = ["physics:body0", "physics:body1"].map(|end| prim.targets(end));
        for target in ends.into_iter().flatten().filter(|target| stage.find(target).is_none()) {
            // What is there of the path.
            let mut path = &**target;
            while let Some((above, _)) = path.rsplit_once('/') {
                path = above;
                if let Some(there) = stage.find(path) {
                    mark(Some(there));
                    break;
                }
            }
        }
    }
    let is_needed = |prim: Option<usize>| {
        prim.is_none_or(|prim| !has_bodies || is_inside[prim] || is_around[prim])
    };
    stage.missing.iter().find(|(prim, _)| is_needed(*prim)).map(|(_, error)| error)
}

/// Counts what is left out, so that the report has it.
pub fn say(scene: &Scene<'_>, tally: &mut Tally) {
    for prim in &scene.stage.prims {
        match &*prim.type_name {
            "MjcTendon" => tally.count(features::TENDONS),
            "MjcKeyframe" => tally.unread("keyframes of MuJoCo"),
            _ => {}
        }
        let starts = |start: &str| prim.schemas.iter().any(|schema| schema.starts_with(start));
        if starts("PhysxTendon") {
            tally.count(features::TENDONS);
        }
        if starts("PhysxVehicle") || starts("PhysxParticle") || starts("PhysxDeformable") {
            tally.count(features::SOFT);
        }
    }
    for (prim, error) in &scene.stage.missing {
        tally.count(features::MISSING_PARTS);
        let place = prim.map_or_else(Default::default, |prim| scene.place(prim));
        tally.remark(place, format!("a reference is left out: {}", error.fault));
    }
}
