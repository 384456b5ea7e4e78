//! The spheres of links that a URDD has, in JSON.

use serde_json::{Value, json};
use urdd_format::link_shapes_spheres::{SphereLevel, SphereOrigin};
use urdd_robot::{Robot, RobotError};

/// The levels from coarse to fine, null without `link_shapes_spheres_module`. Of each: `covers`; `is_given`, whether a person
/// gave it; `count`; `max_standoff` and `max_uncovered` (m) of all links; the rates `miss` and `false_contact`; and
/// `spheres` with `link`, `centre` and `radius` (m, in the link's frame).
pub fn levels(robot: &Robot) -> Result<Value, RobotError> {
    let module = robot.spheres_module()?;
    Ok(module.map_or(Value::Null, |module| module.levels.iter().map(level).collect()))
}

fn level(level: &SphereLevel) -> Value {
    let mut spheres = Vec::new();
    for (link, own) in level.spheres.iter().enumerate() {
        spheres.extend(own.iter().map(
            |sphere| json!({ "link": link, "centre": sphere.offset_xyz, "radius": sphere.radius }),
        ));
    }
    let fits = || level.fits.iter().flatten();
    json!({
        "covers": level.covers,
        "is_given": level.origin == SphereOrigin::Given,
        "count": spheres.len(),
        "max_standoff": fits().map(|fit| fit.max_standoff).fold(0.0, f64::max),
        "max_uncovered": fits().map(|fit| fit.max_uncovered).fold(0.0, f64::max),
        "miss": level.evaluation.miss_rate(),
        "false_contact": level.evaluation.false_contact_rate(),
        "spheres": spheres,
    })
}
