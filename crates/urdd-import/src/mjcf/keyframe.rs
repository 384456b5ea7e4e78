//! Keyframes, as named configurations.

use nalgebra::Quaternion;

use super::super::features::{self, Tally};
use super::super::model::{Configuration, Joint, JointKind, JointValue};
use super::super::names::Names;
use super::super::refusal::{Fallible, Placing, at};
use super::body::{Bodies, Made};
use super::element::Element;
use super::fault::MjcfFault;
use super::orientation::unit;
use super::reading::list;
use urdd_directory::account::{Account, Charged};
use urdd_kinematics::rotation::to_rotation_vector;

/// What passing a joint of the model costs.
const JOINT: usize = 10;

/// The named configurations of the robot.
pub fn configurations(
    root: &Element,
    bodies: &Bodies<'_>,
    made: &Made,
    tally: &mut Tally,
    account: &Account,
) -> Fallible<Charged<Configuration>> {
    let joints = || {
        let each = bodies.all.iter().enumerate();
        each.flat_map(|(body, raw)| {
            raw.joints.iter().enumerate().map(move |(at, joint)| ((body, at), joint))
        })
    };
    let expected: usize = joints().map(|(_, joint)| positions(joint)).sum();
    let (mut configurations, mut names) = (Charged::default(), Names::new(account));
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
        if numbers.len() > expected {
            let fault = MjcfFault::Qpos { found: numbers.len(), expected };
            return Err(at(key.place, fault));
        }
        account.charge(JOINT * joints().count()).at(key.place)?;
        let (mut values, mut base) = (Charged::default(), None);
        let mut rest = &numbers[..];
        for (place, joint) in joints() {
            let (own, after) = rest.split_at(positions(joint).min(rest.len()));
            rest = after;
            if joint.kind == JointKind::Floating && bodies.all[place.0].parent.is_some() {
                let is_root = made.index.get(&place.0) == Some(&0);
                if let (true, [x, y, z, turn @ ..]) = (is_root, own)
                    && let [w, i, j, k] = turn
                {
                    tally.count(features::BASE_POSES);
                    let q = unit(Quaternion::new(*w, *i, *j, *k));
                    base = Some([*x, *y, *z, q.w, q.i, q.j, q.k]);
                }
                continue;
            }
            let Some(&(body, at)) = made.joints.get(&place) else { continue };
            // What a short key does not say is as in the model.
            let whole = [own, start(joint).get(own.len()..).unwrap_or_default()].concat();
            let own = match whole[..] {
                [w, x, y, z] => to_rotation_vector(&unit(Quaternion::new(w, x, y, z))).to_vec(),
                _ => whole,
            };
            let name = made.bodies[body].joints[at].name.clone();
            let value = JointValue { joint: (body, at), name, values: own };
            values.push(value, account).at(key.place)?;
        }
        tally.count(features::POSES);
        let name = key.text("name").map_or_else(|| format!("key_{number}"), str::to_owned);
        let name = names.free(&name).at(key.place)?;
        configurations.push(Configuration { name, values, base }, account).at(key.place)?;
    }
    Ok(configurations)
}

/// How many numbers of a configuration a joint has.
fn positions(joint: &Joint) -> usize {
    match joint.kind {
        JointKind::Floating => 7,
        JointKind::Ball => 4,
        _ => 1,
    }
}

/// The numbers that it has in the model's own configuration. A free joint's are its body's.
fn start(joint: &Joint) -> Vec<f64> {
    match joint.kind {
        JointKind::Floating => Vec::new(),
        JointKind::Ball => vec![1.0, 0.0, 0.0, 0.0],
        _ => vec![joint.reference],
    }
}
