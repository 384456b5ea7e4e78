//! Queries on the learned self-collision model, in JSON.

use serde_json::{Value, json};
use urdd_format::registry::ModuleKind;
use urdd_kinematics::ConfigurationError;
use urdd_robot::{CollisionModel, Robot, RobotError};

/// Reads the model; `None` if the robot has none.
pub fn read(robot: &Robot) -> Result<Option<CollisionModel>, String> {
    match robot.collision_model() {
        Ok(model) => Ok(Some(model)),
        Err(RobotError::Missing(ModuleKind::SelfCollisionModel)) => Ok(None),
        Err(error) => Err(error.to_string()),
    }
}

/// `pairs` and `other_pairs` (their numbers), `num_parameters`, `clip_distance` (m), `evaluation` (the counts of
/// `self_collision_model_module`), and `rates`, each with its 95 % interval.
pub fn about(model: &CollisionModel) -> Value {
    let evaluation = model.evaluation();
    json!({
        "pairs": model.pairs().len(),
        "other_pairs": model.other_pairs().len(),
        "num_parameters": model.num_parameters(),
        "clip_distance": model.clip_distance(),
        "evaluation": evaluation,
        "rates": {
            "miss": evaluation.miss_rate(),
            "near_contact_miss": evaluation.near_contact_miss_rate(),
            "clear": evaluation.clear_rate(),
        },
    })
}

/// `may_collide`; `clearances` of all pairs (m); `min_clearance`: the index of its `pair` among them, its `links`,
/// `link_idxs` and `clearance`, or null for a model without pairs.
pub fn clearances(model: &CollisionModel, robot: &Robot, q: &[f64]) -> Result<Value, String> {
    let said = |error: ConfigurationError| error.to_string();
    let names = robot.link_names().map_err(|error| error.to_string())?;
    let least = model.min_clearance(q).map_err(said)?.and_then(|least| {
        let pair = model.pairs().get(least.pair)?;
        let links = [pair.link_a_idx.get(), pair.link_b_idx.get()];
        Some(json!({
            "pair": least.pair,
            "links": [names.get(links[0])?, names.get(links[1])?],
            "link_idxs": links,
            "clearance": least.value,
        }))
    });
    Ok(json!({
        "may_collide": model.may_collide(q).map_err(said)?,
        "min_clearance": least,
        "clearances": model.clearances(q).map_err(said)?,
    }))
}
