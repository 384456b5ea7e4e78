//! Pairs of bodies that never collide: by bits of contact, by excludes, and as neighbours.

use std::collections::{HashMap, HashSet};

use urdd_directory::account::{Account, Charged};

use super::body::{Lookup, Made, RawBody, WORLD};
use super::geom::{Geom, GeomKind};
use super::reading::{Attributes, Element};
use crate::features::{self, Tally};
use crate::model::{Apart, LETTER};
use crate::place::{Fallible, Place, Placing};

/// Bodies that can collide; their pairs are counted one by one.
const MOST: usize = 1500;

#[derive(Default)]
pub struct Contacts {
    /// Shapes of pairs that always collide, by body and place in it.
    paired: HashSet<(usize, usize)>,
    /// The pairs of bodies of these shapes.
    together: HashSet<[usize; 2]>,
    excluded: HashSet<[usize; 2]>,
    /// Whether a body collides with the one that it moves on.
    keeps_parents: bool,
}

#[derive(Default)]
pub struct Pairs {
    /// Those that never collide, though both have shapes that do.
    pub apart: Charged<Apart>,
    /// A body and the one that it moves on, where the model says that they collide.
    pub checked: Charged<Apart>,
}

/// Bits of contact of shapes that are told apart in one body.
const BITS: usize = 32;

/// A body with shapes that collide: its index in the model and in the robot, and the bits of its shapes.
struct Solid(usize, usize, Vec<[u32; 2]>);

impl Contacts {
    pub fn of(root: &Element, lookup: &Lookup<'_>, tally: &mut Tally) -> Fallible<Self> {
        let mut contacts = Contacts::default();
        for flags in root.sections("option").filter(|of| of.tag == "flag") {
            let said = flags.word("filterparent", &["enable", "disable"], "`enable` or `disable`");
            contacts.keeps_parents = said?.map_or(contacts.keeps_parents, |said| said == 1);
        }
        for element in root.sections("contact") {
            let two = |a, b| [element.text(a), element.text(b)];
            match element.tag.as_str() {
                "pair" => {
                    tally.count(features::CONTACT_PAIRS);
                    let names = two("geom1", "geom2");
                    for suffix in lookup.replicas(element, &names)? {
                        let [Some(a), Some(b)] = names else { continue };
                        let a = lookup.geom(element, a, suffix)?;
                        let b = lookup.geom(element, b, suffix)?;
                        contacts.paired.extend([a, b]);
                        contacts.together.insert(ordered(a.0, b.0));
                    }
                }
                "exclude" => {
                    let names = two("body1", "body2");
                    for suffix in lookup.replicas(element, &names)? {
                        let [Some(a), Some(b)] = names else { continue };
                        let a = lookup.body(element, a, suffix)?;
                        let b = lookup.body(element, b, suffix)?;
                        contacts.excluded.insert(ordered(a, b));
                    }
                }
                _ => {}
            }
        }
        Ok(contacts)
    }

    pub fn is_visual(&self, geom: &Geom<'_>, body: usize, place: usize) -> bool {
        geom.is_visual() && !self.paired.contains(&(body, place))
    }

    /// The pairs of bodies of the robot that never collide, and those that do beside what is usual.
    pub fn pairs(
        &self,
        all: &[RawBody<'_>],
        made: &Made,
        tally: &mut Tally,
        account: &Account,
    ) -> Fallible<Pairs> {
        let welds = welds(all);
        let mut solid = self.solid(all, made);
        let mut reasons: HashMap<[usize; 2], &'static str> = HashMap::new();
        if solid.len() > MOST {
            let text = format!(
                "more than {MOST} bodies have shapes that collide; which of their pairs never do, but for excludes, is left out"
            );
            tally.remark(Place::default(), text);
            solid.clear();
        }
        for (number, Solid(first, a, bits)) in solid.iter().enumerate() {
            for Solid(second, b, others) in &solid[number + 1..] {
                if self.together.contains(&ordered(*first, *second)) {
                    continue;
                }
                account.charge(bits.len() * others.len() - 1).at(all[*second].place)?;
                let (none, every) = meet(bits, others);
                let (is_same, is_parent) = neighbours(all, &welds, *first, *second);
                let reason = if is_same || is_parent && !self.keeps_parents {
                    "Adjacent"
                } else if none {
                    "Never"
                } else if is_parent && !self.excluded.contains(&ordered(*first, *second)) {
                    CHECKED
                } else {
                    ""
                };
                if !every && matches!(reason, "" | CHECKED) {
                    tally.count(features::PARTLY_APART);
                }
                if !reason.is_empty() {
                    reasons.insert([*a, *b], reason);
                }
            }
        }
        for [a, b] in &self.excluded {
            let [Some(first), Some(second)] = [a, b].map(|index| made.index.get(index)) else {
                continue;
            };
            if a != b && !self.together.contains(&[*a, *b]) {
                reasons.entry([*first, *second]).or_insert("User");
            }
        }
        let mut sorted: Vec<([usize; 2], &'static str)> = reasons.into_iter().collect();
        sorted.sort_unstable();
        let mut pairs = Pairs::default();
        for (bodies, reason) in sorted {
            let [first, second] = bodies.map(|body| &made.bodies[body]);
            let names = LETTER * (first.name.len() + second.name.len());
            let list = match reason {
                CHECKED => &mut pairs.checked,
                _ => &mut pairs.apart,
            };
            let charged = account.charge(names);
            charged.and_then(|()| list.push(Apart { bodies, reason }, account)).at(second.place)?;
            if reason != CHECKED {
                tally.count(features::APART);
            }
        }
        Ok(pairs)
    }

    /// The bodies of the robot with shapes that collide.
    fn solid(&self, all: &[RawBody<'_>], made: &Made) -> Vec<Solid> {
        let mut solid = Vec::new();
        for (index, body) in all.iter().enumerate() {
            let Some(of) = made.index.get(&index) else { continue };
            if made.bodies[*of].shapes.is_empty() {
                continue;
            }
            let shapes = body.geoms.iter().enumerate().filter(|(place, geom)| {
                !matches!(geom.kind, GeomKind::Plane | GeomKind::HeightField)
                    && !self.is_visual(geom, index, *place)
            });
            let mut bits: Vec<[u32; 2]> =
                shapes.map(|(_, geom)| [geom.contype, geom.conaffinity]).collect();
            bits.sort_unstable();
            bits.dedup();
            if bits.len() > BITS {
                let all = bits.iter().fold([0; 2], |[a, b], [c, d]| [a | c, b | d]);
                bits = vec![all];
            }
            if !bits.is_empty() {
                solid.push(Solid(index, *of, bits));
            }
        }
        solid
    }
}

/// The reason of a pair that is checked.
const CHECKED: &str = "filterparent is disabled";

/// Whether no shapes of two bodies collide, and whether all do.
fn meet(bits: &[[u32; 2]], others: &[[u32; 2]]) -> (bool, bool) {
    let (mut none, mut every) = (true, true);
    for [contype, affinity] in bits {
        for [other_contype, other_affinity] in others {
            let collide = contype & other_affinity != 0 || other_contype & affinity != 0;
            (none, every) = (none && !collide, every && collide);
        }
    }
    (none, every)
}

fn ordered(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// The body that each one moves with: itself if it has joints.
fn welds(all: &[RawBody<'_>]) -> Vec<usize> {
    let mut welds: Vec<usize> = Vec::with_capacity(all.len());
    for (index, body) in all.iter().enumerate() {
        let moves = !body.joints.is_empty() || body.is_mocap;
        welds.push(if moves { index } else { body.parent.map_or(WORLD, |parent| welds[parent]) });
    }
    welds
}

/// MuJoCo's own rule: whether bodies move together, and whether one of them moves on the other, but for the world.
fn neighbours(all: &[RawBody<'_>], welds: &[usize], a: usize, b: usize) -> (bool, bool) {
    let [a, b] = [welds[a], welds[b]];
    let under = |weld: usize| all[weld].parent.map_or(WORLD, |parent| welds[parent]);
    (a == b, a != WORLD && b != WORLD && (a == under(b) || b == under(a)))
}

/// The coefficient of friction of all shapes that collide, where some say it and all have the same.
pub fn friction(all: &[RawBody<'_>], made: &Made, tally: &mut Tally) -> Option<f64> {
    let geoms = all.iter().enumerate().filter(|(index, _)| made.index.contains_key(index));
    let said: Vec<Option<f64>> = geoms
        .flat_map(|(_, body)| &body.geoms)
        .filter(|geom| !geom.is_visual())
        .inspect(|geom| {
            let [_, torsion, rolling] = geom.friction;
            if torsion.is_some_and(|of| of != 0.005) || rolling.is_some_and(|of| of != 0.0001) {
                tally.count(features::TORSION);
            }
        })
        .map(|geom| geom.friction[0])
        .collect();
    let first = said.iter().flatten().next()?;
    let is_one = said.iter().all(|of| of.unwrap_or(1.0).to_bits() == first.to_bits());
    let feature = if is_one { features::FRICTION } else { features::FRICTIONS };
    tally.add(feature, said.iter().flatten().count());
    is_one.then_some(*first)
}
