//! Pairs of bodies that never collide: by bits of contact, by excludes, and as neighbours.

use std::collections::{HashMap, HashSet};

use super::super::features::{self, Tally};
use urdd_directory::account::{Account, Charged};

use super::super::model::{Apart, LETTER};
use super::super::place::Place;
use super::at::{Fallible, at};
use super::body::{RawBody, WORLD};
use super::document::Element;
use super::geom::{Geom, Kind};
use super::lookup::Lookup;
use super::made::Made;

/// Bodies that can collide; their pairs are counted one by one.
const MOST: usize = 1500;

/// What `<contact>` says.
#[derive(Default)]
pub struct Contacts {
    /// Shapes of pairs that always collide, by body and place in it.
    paired: HashSet<(usize, usize)>,
    /// The pairs of bodies of these shapes.
    together: HashSet<[usize; 2]>,
    excluded: HashSet<[usize; 2]>,
}

impl Contacts {
    /// Reads `<contact>`.
    pub fn of(root: &Element, lookup: &Lookup<'_>, tally: &mut Tally) -> Fallible<Self> {
        let mut contacts = Contacts::default();
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

    /// Whether a shape is only seen.
    pub fn is_visual(&self, geom: &Geom<'_>, body: usize, place: usize) -> bool {
        geom.is_visual() && !self.paired.contains(&(body, place))
    }

    /// The pairs of bodies of the robot that never collide, though both have shapes that do.
    pub fn apart(
        &self,
        all: &[RawBody<'_>],
        made: &Made,
        tally: &mut Tally,
        account: &Account,
    ) -> Fallible<Charged<Apart>> {
        let welds = welds(all);
        let mut solid: Vec<(usize, usize, [u32; 2])> = Vec::new();
        for (index, body) in all.iter().enumerate() {
            let Some(of) = made.index.get(&index) else { continue };
            if made.bodies[*of].shapes.is_empty() {
                continue;
            }
            let shapes = body.geoms.iter().enumerate().filter(|(place, geom)| {
                !matches!(geom.kind, Kind::Plane | Kind::HeightField)
                    && !self.is_visual(geom, index, *place)
            });
            let bits = shapes.map(|(_, geom)| [geom.contype, geom.conaffinity]);
            if let Some(bits) = bits.reduce(|[a, b], [c, d]| [a | c, b | d]) {
                solid.push((index, *of, bits));
            }
        }
        let mut reasons: HashMap<[usize; 2], &'static str> = HashMap::new();
        if solid.len() > MOST {
            let text = format!(
                "more than {MOST} bodies have shapes that collide; which of their pairs never do, but for excludes, is left out"
            );
            tally.remark(Place::default(), text);
            solid.clear();
        }
        for (number, (first, a, [type_a, affinity_a])) in solid.iter().enumerate() {
            for (second, b, [type_b, affinity_b]) in &solid[number + 1..] {
                let never = type_a & affinity_b == 0 && type_b & affinity_a == 0;
                let reason = match never {
                    _ if self.together.contains(&ordered(*first, *second)) => continue,
                    _ if are_neighbours(all, &welds, *first, *second) => "Adjacent",
                    true => "Never",
                    false => continue,
                };
                reasons.insert([*a, *b], reason);
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
        let mut apart = Charged::default();
        for (bodies, reason) in sorted {
            let [first, second] = bodies.map(|body| &made.bodies[body]);
            let names = LETTER * (first.name.len() + second.name.len());
            let charged = account.charge(names);
            let charged = charged.and_then(|()| apart.push(Apart { bodies, reason }, account));
            charged.map_err(|why| at(second.place, why))?;
            tally.count(features::APART);
        }
        Ok(apart)
    }
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

/// MuJoCo's own rule: bodies that move together, and a body and the one that it moves on, but for the world.
fn are_neighbours(all: &[RawBody<'_>], welds: &[usize], a: usize, b: usize) -> bool {
    let [a, b] = [welds[a], welds[b]];
    let under = |weld: usize| all[weld].parent.map_or(WORLD, |parent| welds[parent]);
    a == b || a != WORLD && b != WORLD && (a == under(b) || b == under(a))
}

/// The coefficient of friction of all shapes that collide, where some say it and all have the same.
pub fn friction(all: &[RawBody<'_>], made: &Made, tally: &mut Tally) -> Option<f64> {
    let geoms = all.iter().enumerate().filter(|(index, _)| made.index.contains_key(index));
    let said: Vec<Option<f64>> = geoms
        .flat_map(|(_, body)| &body.geoms)
        .filter(|geom| !geom.is_visual())
        .map(|geom| geom.friction)
        .collect();
    let first = said.iter().flatten().next()?;
    let is_one = said.iter().all(|of| of.unwrap_or(1.0).to_bits() == first.to_bits());
    let feature = if is_one { features::FRICTION } else { features::FRICTIONS };
    for _ in said.iter().flatten() {
        tally.count(feature);
    }
    is_one.then_some(*first)
}
