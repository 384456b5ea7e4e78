//! Pairs of bodies that never collide, by groups of shapes too, or do though a joint connects them.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use urdd_directory::account::{Account, AccountError, Charged};
use urdd_usd::{Prim, Value};

use super::frames::Made;
use super::gprim::Solid;
use super::joint::UsdJoint;
use super::scene::{Scene, flag, word};
use crate::features::{self, Tally};
use crate::model::Apart;
use crate::place::{Fallible, Placing};

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

/// Comparing a group with another, or a shape with a group, as bytes.
const LOOK: usize = 20;

/// The prims that are in a group or out of it, and whether without what is in them.
type Listed = BTreeMap<usize, (bool, bool)>;

pub struct Groups {
    /// The groups that each group never collides with.
    apart: Vec<BTreeSet<usize>>,
    /// Groups with what is in them; several where groups of one name are one.
    listed: Vec<(usize, Listed)>,
}

impl Groups {
    pub fn of(
        scene: &Scene<'_>,
        account: &Account,
        tally: &mut Tally,
    ) -> Result<Self, AccountError> {
        let all: Vec<(usize, &Prim)> = (scene.stage.prims.iter().enumerate())
            .filter(|(_, prim)| &*prim.type_name == "PhysicsCollisionGroup")
            .collect();
        account.charge(LOOK * all.len() * all.len())?;
        // Groups of one name are one.
        let (mut named, mut index) = (HashMap::new(), HashMap::new());
        let mut count = 0;
        for (at, prim) in &all {
            let name = word(prim, "physics:mergeGroup").filter(|name| !name.is_empty());
            let new = name.map_or(count, |name| *named.entry(name).or_insert(count));
            count += usize::from(new == count);
            index.insert(*at, new);
        }
        let (mut apart, mut listed) = (vec![BTreeSet::new(); count], Vec::new());
        for (at, prim) in &all {
            let own = index[at];
            let others = prim.targets("physics:filteredGroups").iter();
            let others: BTreeSet<usize> =
                others.filter_map(|path| index.get(&scene.stage.find(path)?).copied()).collect();
            let is_inverted = flag(prim, "physics:invertFilteredGroups", false);
            for other in (0..count).filter(|other| others.contains(other) != is_inverted) {
                apart[own].insert(other);
                apart[other].insert(own);
            }
            let is_alone = word(prim, "collection:colliders:expansionRule") == Some("explicitOnly");
            let mut inside = BTreeMap::new();
            for (name, is_in) in [("includes", true), ("excludes", false)] {
                let paths = prim.targets(&format!("collection:colliders:{name}")).iter();
                let prims = paths.filter_map(|path| scene.stage.find(path));
                inside.extend(prims.map(|prim| (prim, (is_in, is_alone && is_in))));
            }
            listed.push((own, inside));
            let expression = prim.value("collection:colliders:membershipExpression");
            if expression.and_then(Value::text).is_some_and(|text| !text.is_empty()) {
                tally.unread("expressions that say what is in a collision group");
            }
        }
        Ok(Groups { apart, listed })
    }

    pub fn is_empty(&self) -> bool {
        self.apart.is_empty()
    }

    fn of_shape(
        &self,
        scene: &Scene<'_>,
        prim: usize,
        account: &Account,
    ) -> Result<BTreeSet<usize>, AccountError> {
        let around: Vec<usize> =
            std::iter::successors(Some(prim), |at| scene.prim(*at).parent).collect();
        account.charge(LOOK * self.listed.len() * around.len())?;
        let is_in = |listed: &Listed| {
            let mut all = around.iter().filter_map(|at| Some((at, listed.get(at)?)));
            let said = all.find(|(at, (_, is_alone))| !is_alone || **at == prim);
            said.is_some_and(|(_, (is_in, _))| *is_in)
        };
        let groups = self.listed.iter().filter(|(_, listed)| is_in(listed));
        Ok(groups.map(|(group, _)| *group).collect())
    }

    /// The pairs of bodies of which no shapes collide. Those of which some do not are counted.
    pub fn pairs(
        &self,
        scene: &Scene<'_>,
        solids: &HashMap<usize, Vec<Solid>>,
        account: &Account,
        tally: &mut Tally,
    ) -> Result<Vec<(usize, usize)>, AccountError> {
        // The sets of groups that the shapes of each body are in.
        let mut bodies: BTreeMap<usize, BTreeSet<BTreeSet<usize>>> = BTreeMap::new();
        for (body, solids) in solids {
            for solid in solids {
                let groups = self.of_shape(scene, solid.prim, account)?;
                bodies.entry(*body).or_default().insert(groups);
            }
        }
        let mut pairs = Vec::new();
        for (one, own) in &bodies {
            for (other, others) in bodies.range(one + 1..) {
                account.charge(LOOK * own.len() * others.len() * self.apart.len())?;
                let is_apart = |a: &BTreeSet<usize>, b: &BTreeSet<usize>| {
                    a.iter().any(|group| !self.apart[*group].is_disjoint(b))
                };
                let all = own.iter().flat_map(|a| others.iter().map(move |b| (a, b)));
                let apart = all.filter(|(a, b)| is_apart(a, b)).count();
                if apart == own.len() * others.len() {
                    pairs.push((*one, *other));
                } else if apart > 0 {
                    tally.count(features::PARTLY_APART);
                }
            }
        }
        Ok(pairs)
    }
}
