//! Pairs of bodies that never collide, or do though a joint connects them.

use std::collections::{BTreeSet, HashMap};

use urdd_directory::account::{Account, Charged};

use super::super::features::{self, Tally};
use super::super::model::Apart;
use super::super::refusal::{Fallible, Placing};
use super::gprim::Solid;
use super::groups::Groups;
use super::joint::UsdJoint;
use super::made::Made;
use super::scene::{Scene, flag};

/// Those that never collide, and those that do.
pub fn pairs(
    scene: &Scene<'_>,
    joints: &[UsdJoint],
    made: &Made,
    solids: &HashMap<usize, Vec<Solid>>,
    account: &Account,
    tally: &mut Tally,
) -> Fallible<(Charged<Apart>, Charged<Apart>)> {
    let (mut apart, mut checked) = (Charged::default(), Charged::default());
    let mut known = BTreeSet::new();
    let body = |prim: usize| scene.body[prim].and_then(|body| made.index.get(&body).copied());
    for (prim, of) in scene.stage.prims.iter().enumerate() {
        if !of.has("PhysicsFilteredPairsAPI") {
            continue;
        }
        for target in of.targets("physics:filteredPairs") {
            let Some(other) = scene.stage.find(target) else { continue };
            let Some((one, two)) = body(prim).zip(body(other)).filter(|(one, two)| one != two)
            else {
                continue;
            };
            // Of shapes: they alone do not collide.
            if scene.body[prim] != Some(prim) || scene.body[other] != Some(other) {
                tally.count(features::PARTLY_APART);
                continue;
            }
            if known.insert((one.min(two), one.max(two))) {
                tally.count(features::APART);
                let pair = Apart { bodies: [one, two], reason: "User" };
                apart.push(pair, account).at(scene.place(prim))?;
            }
        }
    }
    let groups = Groups::of(scene, account, tally).at(Default::default())?;
    if !groups.is_empty() {
        for pair in groups.pairs(scene, solids, account, tally).at(Default::default())? {
            if known.insert(pair) {
                tally.count(features::APART);
                let pair = Apart { bodies: [pair.0, pair.1], reason: "User" };
                apart.push(pair, account).at(Default::default())?;
            }
        }
    }
    for joint in joints {
        if !flag(scene.prim(joint.prim), "physics:collisionEnabled", false) {
            continue;
        }
        let [one, two] =
            joint.ends.map(|end| end.body.and_then(|body| made.index.get(&body).copied()));
        if let Some((one, two)) = one.zip(two) {
            let pair = Apart { bodies: [one, two], reason: "physics:collisionEnabled" };
            checked.push(pair, account).at(scene.place(joint.prim))?;
        }
    }
    Ok((apart, checked))
}
