//! Keyframes, as named configurations.

use std::collections::BTreeMap;

use nalgebra::Quaternion;
use urdd_kinematics::rotation::to_rotation_vector;

use super::super::features::{self, Tally};
use super::super::model::Configuration;
use super::super::names::Names;
use super::at::{Fallible, at};
use super::body::Bodies;
use super::document::Element;
use super::fault::MjcfFault;
use super::joint::Kind;
use super::made::Made;
use super::orientation::unit;
use super::reading::list;

/// The named configurations of the robot.
pub fn configurations(
    root: &Element,
    bodies: &Bodies<'_>,
    made: &Made,
    tally: &mut Tally,
) -> Fallible<Vec<Configuration>> {
    let joints = || {
        let each = bodies.all.iter().enumerate();
        each.flat_map(|(body, raw)| {
            raw.joints.iter().enumerate().map(move |(at, joint)| ((body, at), joint))
        })
    };
    let expected: usize = joints().map(|(_, joint)| joint.positions()).sum();
    let (mut configurations, mut names) = (Vec::new(), Names::default());
    for (number, key) in root.sections("keyframe").filter(|of| of.tag == "key").enumerate() {
        for name in ["qvel", "act", "ctrl"] {
            if key.text(name).is_some() {
                tally.count(features::CONTROLS);
            }
        }
        if bodies.is_partial {
            tally.count(features::SOFT);
            tally.remark(
                key.place,
                "the key is left out: it also has positions of what is not read",
            );
            continue;
        }
        let numbers = list(key, "qpos", usize::MAX)?;
        if !numbers.is_empty() && numbers.len() != expected {
            let fault = MjcfFault::Qpos { found: numbers.len(), expected };
            return Err(at(key.place, fault));
        }
        let mut values = BTreeMap::new();
        let mut rest = &numbers[..];
        for (place, joint) in joints() {
            let (own, after) = rest.split_at(joint.positions().min(rest.len()));
            rest = after;
            if joint.kind == Kind::Free && bodies.all[place.0].parent.is_some() {
                let is_root = made.index.get(&place.0) == Some(&0);
                if is_root && !own.is_empty() {
                    tally.count(features::BASE_POSES);
                }
                continue;
            }
            let Some((body, at)) = made.joints.get(&place) else { continue };
            let value = match own {
                [w, x, y, z] => to_rotation_vector(&unit(Quaternion::new(*w, *x, *y, *z))).to_vec(),
                [] if joint.kind == Kind::Ball => vec![0.0; 3],
                [] => vec![joint.reference],
                own => own.to_vec(),
            };
            values.insert(made.bodies[*body].joints[*at].name.clone(), value);
        }
        tally.count(features::POSES);
        let name = key.text("name").map_or_else(|| format!("key_{number}"), str::to_owned);
        configurations.push(Configuration { name: names.free(&name), values });
    }
    Ok(configurations)
}
