//! The joints of UsdPhysics: which of six motions they leave free, and their frames in two bodies.

use nalgebra::{Isometry3, Translation3, Vector3};
use urdd_usd::Prim;

use super::super::features::{self, Tally};
use super::super::model::JointKind;
use super::super::refusal::Fallible;
use super::scene::{Scene, flag, number, triple, turn, word};

/// The motions of a generic joint, in the order in which they follow each other.
pub const MOTIONS: [&str; 6] = ["transX", "transY", "transZ", "rotX", "rotY", "rotZ"];
/// The axes of these.
const AXES: [Vector3<f64>; 3] =
    [Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.0, 1.0, 0.0), Vector3::new(0.0, 0.0, 1.0)];

/// A joint.
#[derive(Debug)]
pub struct UsdJoint {
    pub prim: usize,
    /// What moves.
    pub motions: Vec<Motion>,
    /// What the motions are together, if that is one joint.
    pub whole: Option<JointKind>,
    /// The ends: body 0, and body 1, which moves.
    pub ends: [JointEnd; 2],
    /// Whether it closes a chain that the articulation leaves open.
    pub is_excluded: bool,
    /// Whether it moves in all ways.
    pub is_free: bool,
    /// Whether it is one of MuJoCo, which follows another one between its bodies, and does not close a chain.
    pub is_mujocos: bool,
}

/// Where a joint is in a body.
#[derive(Debug, Clone, Copy)]
pub struct JointEnd {
    /// The prim of the body; none of the world.
    pub body: Option<usize>,
    /// In m.
    pub frame: Isometry3<f64>,
}

/// A motion along or about an axis of the frame of a joint.
#[derive(Debug, Clone)]
pub struct Motion {
    /// Its index in [`MOTIONS`].
    pub which: usize,
    pub axis: Vector3<f64>,
    /// Limits, rad or m; infinite where there are none.
    pub range: [f64; 2],
    /// The name of its drive and its state.
    pub instance: &'static str,
}

impl Motion {
    pub fn is_slide(&self) -> bool {
        self.which < 3
    }
}

/// Whether a prim is a joint.
pub fn is_joint(prim: &Prim) -> bool {
    prim.type_name.starts_with("Physics") && prim.type_name.ends_with("Joint")
}

/// The joints of a stage that hold bodies.
pub fn joints(scene: &Scene<'_>, tally: &mut Tally) -> Fallible<Vec<UsdJoint>> {
    let mut all = Vec::new();
    for (at, prim) in scene.stage.prims.iter().enumerate() {
        if !is_joint(prim) {
            continue;
        }
        let is_lost = |end| !prim.targets(end).is_empty() && scene.target(prim, end).is_none();
        if !flag(prim, "physics:jointEnabled", true)
            || &*prim.type_name == "PhysicsDistanceJoint"
            || is_lost("physics:body0")
            || is_lost("physics:body1")
        {
            tally.count(features::DISTANCES);
            continue;
        }
        let (motions, whole) = motions(scene, prim, tally);
        let ends = [end(scene, prim, 0)?, end(scene, prim, 1)?];
        if ends[0].body == ends[1].body {
            continue;
        }
        let is_excluded = flag(prim, "physics:excludeFromArticulation", false);
        let is_free = motions.len() == 6;
        let is_mujocos = prim.has("MjcJointAPI");
        all.push(UsdJoint { prim: at, motions, whole, ends, is_excluded, is_free, is_mujocos });
    }
    Ok(all)
}

/// The frame of a joint in the body of one of its ends.
fn end(scene: &Scene<'_>, prim: &Prim, which: usize) -> Fallible<JointEnd> {
    let place = triple(prim, &format!("physics:localPos{which}")).unwrap_or_default();
    let rotation = turn(prim, &format!("physics:localRot{which}")).unwrap_or_default();
    let frame = |scale: Vector3<f64>| {
        let place = place.component_mul(&scale) * scene.metre;
        Isometry3::from_parts(Translation3::from(place), rotation)
    };
    let Some(target) = scene.target(prim, &format!("physics:body{which}")) else {
        return Ok(JointEnd { body: None, frame: frame(Vector3::repeat(1.0)) });
    };
    let (own, scale) = scene.frame(target)?;
    let frame = frame(scale);
    Ok(match scene.body[target] {
        Some(body) if body == target => JointEnd { body: Some(body), frame },
        Some(body) => {
            JointEnd { body: Some(body), frame: scene.frame(body)?.0.inverse() * own * frame }
        }
        None => JointEnd { body: None, frame: own * frame },
    })
}

/// What a joint leaves free, and what that is if it is one joint.
fn motions(scene: &Scene<'_>, prim: &Prim, tally: &mut Tally) -> (Vec<Motion>, Option<JointKind>) {
    let axis = match word(prim, "physics:axis") {
        Some("Y") => 1,
        Some("Z") => 2,
        _ => 0,
    };
    let range = |lower: &str, upper: &str, unit: f64| {
        let of = |name: &str, none: f64| number(prim, name).map_or(none, |value| value * unit);
        [of(lower, f64::NEG_INFINITY), of(upper, f64::INFINITY)]
    };
    let unit = |which: usize| if which < 3 { scene.metre } else { 1f64.to_radians() };
    let single = |which: usize, instance| {
        let range = range("physics:lowerLimit", "physics:upperLimit", unit(which));
        let is_locked = range[0] > range[1];
        let motion = Motion { which, axis: AXES[axis], range, instance };
        if is_locked { Vec::new() } else { vec![motion] }
    };
    match &*prim.type_name {
        "PhysicsRevoluteJoint" => (single(3 + axis, "angular"), None),
        "PhysicsPrismaticJoint" => (single(axis, "linear"), None),
        "PhysicsSphericalJoint" => {
            let limits = ["physics:coneAngle0Limit", "physics:coneAngle1Limit"];
            if limits.iter().any(|name| number(prim, name).is_some_and(|limit| limit >= 0.0)) {
                tally.count(features::BALL_RANGES);
            }
            let each = (3..6).map(free);
            (each.collect(), Some(JointKind::Ball))
        }
        "PhysicsJoint" => {
            let mut all = Vec::new();
            for (which, name) in MOTIONS.into_iter().enumerate() {
                let range = match prim.has(&format!("PhysicsLimitAPI:{name}")) {
                    true => {
                        let [low, high] =
                            ["low", "high"].map(|end| format!("limit:{name}:physics:{end}"));
                        range(&low, &high, unit(which))
                    }
                    false => [f64::NEG_INFINITY, f64::INFINITY],
                };
                // Where the lower limit is above the upper one, it is locked; of equal ones, too.
                if range[0] < range[1] {
                    all.push(Motion { range, ..free(which) });
                }
            }
            if prim.has("PhysicsLimitAPI:distance") {
                tally.count(features::DISTANCES);
            }
            let is_limited =
                all.iter().any(|motion| motion.range.iter().any(|limit| limit.is_finite()));
            // What is driven or limited along one axis stays a joint of its own.
            let is_plain = !is_limited
                && !prim.schemas.iter().any(|schema| schema.starts_with("PhysicsDriveAPI:"));
            let normal = match &all[..] {
                [one, other, hinge] if other.is_slide() && !hinge.is_slide() => {
                    one.axis.cross(&other.axis).dot(&hinge.axis)
                }
                _ => 0.0,
            };
            let whole = match all.len() {
                3 if all.iter().all(|motion| !motion.is_slide()) => {
                    if is_limited {
                        tally.count(features::BALL_RANGES);
                    }
                    Some(JointKind::Ball)
                }
                3 if is_plain && normal != 0.0 => Some(JointKind::Planar),
                6 if is_plain => Some(JointKind::Floating),
                _ => None,
            };
            (all, whole)
        }
        _ => (Vec::new(), None),
    }
}

fn free(which: usize) -> Motion {
    let range = [f64::NEG_INFINITY, f64::INFINITY];
    Motion { which, axis: AXES[which % 3], range, instance: MOTIONS[which] }
}
