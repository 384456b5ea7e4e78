//! What a stage says that no robot of ours has: it is counted, so that the report has it.

use super::super::features::{self, Tally};
use super::scene::Scene;

/// Counts it.
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
}
