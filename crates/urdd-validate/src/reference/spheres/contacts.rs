//! Which links are in contact by their spheres in sampled configurations: SPEC 8.9.6 and 8.9.7.

use std::collections::HashSet;
use std::fmt;
use std::ops::Range;

use nalgebra::{Isometry3, Vector3};
use rayon::prelude::*;

use super::fit::{Ball, balls};
use crate::reference::learned::{COMPARISON, not_skipped};
use crate::reference::samples::{Budget, Poses};
use crate::skip;
use crate::tolerance::{POSITION_OF_REACH, reach};
use urdd_document::urdd::Urdd;
use urdd_findings::part::SkipReason;
use urdd_format::link_shapes_spheres::{LinkShapesSpheresModule, SPHERES_FIRST};
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_geometry::convex::BodyPairs;

/// So many configurations are looked at before pairs of which all is known are left out.
const AT_ONCE: u32 = 256;
/// Maximum number of pairs of links, all levels together: each takes some bytes.
const MOST_PAIRS: usize = 5_000_000;
/// As many configurations are looked at by one thread.
const SPLIT: usize = 32;

/// Two links are in contact, where the radii of two spheres are together smaller by the tolerance.
const TIGHT: u8 = 1;
/// Where they are larger by the tolerance.
const LOOSE: u8 = 2;
const ALL: u8 = TIGHT | LOOSE;

/// The spheres of a link in a level, and one around them.
struct Link {
    link: usize,
    balls: Vec<Ball>,
    around: Ball,
}

impl Link {
    fn new(link: usize, balls: Vec<Ball>) -> Self {
        let sum: Vector3<f64> = balls.iter().map(|ball| ball.centre).sum();
        let centre = sum / balls.len() as f64;
        let radius = balls.iter().map(|ball| (ball.centre - centre).norm() + ball.radius);
        let radius = radius.fold(0.0, f64::max) * (1.0 + 1e-9);
        Link { link, balls, around: Ball { centre, radius } }
    }
}

/// How often two links of a level were in contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Often {
    Never,
    Sometimes,
    Always,
}

impl fmt::Display for Often {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Often::Never => "in no sampled configuration",
            Often::Sometimes => "in some sampled configurations",
            Often::Always => "in all sampled configurations",
        })
    }
}

/// Two links with spheres, the lower first, and how often they may be said to be in contact: from this to that.
#[derive(Debug, Clone, Copy)]
pub struct PairFound {
    pub links: [usize; 2],
    pub often: [Often; 2],
}

/// What was found in a level.
pub struct LevelFound {
    /// All pairs of links with spheres, ascending.
    pub pairs: Vec<PairFound>,
    /// For each configuration, whether the level touches: surely, and within the tolerance.
    pub touches: Vec<[bool; 2]>,
}

/// A pair of links of a level, and what is known of it.
struct Pair {
    places: [usize; 2],
    is_checked: bool,
    any: u8,
    all: u8,
}

impl Pair {
    /// Whether more configurations change nothing.
    fn is_settled(&self) -> bool {
        self.any & TIGHT != 0 && self.all & LOOSE == 0
    }

    fn often(&self, by: u8) -> Often {
        match (self.all & by != 0, self.any & by != 0) {
            (true, _) => Often::Always,
            (_, true) => Often::Sometimes,
            _ => Often::Never,
        }
    }
}

/// What is known of a level.
struct Level {
    links: Vec<Link>,
    pairs: Vec<Pair>,
    /// The indices of the pairs that are not settled, and of those that are and that a check asks.
    open: Vec<usize>,
    asked: Vec<usize>,
}

impl Level {
    fn sort_pairs(&mut self) {
        let pairs = &self.pairs;
        let settled = |at: &usize| pairs[*at].is_settled();
        self.open.retain(|at| !settled(at));
        self.asked = (0..pairs.len()).filter(|at| settled(at) && pairs[*at].is_checked).collect();
    }

    /// Adds what the pairs are in a configuration. Returns how the level touches, and the work.
    fn look(&self, poses: &[Isometry3<f64>], tolerance: f64, seen: &mut [(u8, u8)]) -> (u8, usize) {
        let mut work = 5 * (self.open.len() + self.asked.len());
        let mut placed: Vec<Option<Placed>> = Vec::new();
        placed.resize_with(self.links.len(), || None);
        let mut contact = |pair: &Pair| {
            for place in pair.places {
                placed[place].get_or_insert_with(|| {
                    work += 10 + 5 * self.links[place].balls.len();
                    Placed::new(&self.links[place], poses)
                });
            }
            let [a, b] =
                pair.places.map(|place| placed[place].as_ref().map(|at| (&self.links[place], at)));
            a.zip(b).map_or(0, |(a, b)| contact(a, b, tolerance, &mut work))
        };
        let mut touches = 0;
        for at in &self.open {
            let pair = &self.pairs[*at];
            let found = contact(pair);
            seen[*at].0 |= found;
            seen[*at].1 &= found;
            touches |= if pair.is_checked { found } else { 0 };
        }
        for at in &self.asked {
            if touches == ALL {
                break;
            }
            touches |= contact(&self.pairs[*at]);
        }
        (touches, work)
    }
}

/// The spheres of a link in a configuration.
struct Placed {
    centres: Vec<Vector3<f64>>,
    /// The centre of the sphere around them.
    around: Vector3<f64>,
}

impl Placed {
    fn new(link: &Link, poses: &[Isometry3<f64>]) -> Self {
        let pose = poses.get(link.link).copied().unwrap_or_else(Isometry3::identity);
        let place = |centre: &Vector3<f64>| pose.rotation * centre + pose.translation.vector;
        let centres = link.balls.iter().map(|ball| place(&ball.centre)).collect();
        Placed { centres, around: place(&link.around.centre) }
    }
}

/// What two links are to each other.
fn contact(
    (a, at_a): (&Link, &Placed),
    (b, at_b): (&Link, &Placed),
    tolerance: f64,
    work: &mut usize,
) -> u8 {
    let reach = a.around.radius + tolerance;
    if (at_a.around - at_b.around).norm() > reach + b.around.radius {
        return 0;
    }
    *work += 4 * b.balls.len();
    let mut found = 0;
    for (ball, centre) in b.balls.iter().zip(&at_b.centres) {
        if (centre - at_a.around).norm() > reach + ball.radius {
            continue;
        }
        *work += 3 * a.balls.len();
        for (other, other_centre) in a.balls.iter().zip(&at_a.centres) {
            let gap = (centre - other_centre).norm() - (ball.radius + other.radius);
            if gap <= -tolerance {
                return ALL;
            }
            found |= if gap <= tolerance { LOOSE } else { 0 };
        }
    }
    found
}

/// The contacts of the levels of a URDD's module.
///
/// # Errors
/// As [`contacts`]; or why there is nothing to compute them from.
pub fn of_urdd(urdd: &Urdd, deep: bool) -> Result<Vec<LevelFound>, SkipReason> {
    let kind = ModuleKind::LinkShapesSpheres;
    let Some(ModuleDocument::LinkShapesSpheres(module)) = urdd.document(kind) else {
        return Err(SkipReason::absent(kind));
    };
    let (robot, tree) = urdd.robot().zip(urdd.tree()).ok_or(skip::KINEMATICS_OPEN)?;
    let poses = Poses::new(urdd)?;
    let pairs = not_skipped(urdd).unwrap_or_default();
    let asked: HashSet<[usize; 2]> = pairs.into_iter().collect();
    let ignored = module.levels.iter().map(|level| {
        let pairs = level.ignored_pairs.iter();
        pairs.map(|pair| [pair.link_a_idx.get(), pair.link_b_idx.get()]).collect()
    });
    let ignored: Vec<HashSet<[usize; 2]>> = ignored.collect();
    let is_checked = |level: usize, links: [usize; 2]| {
        asked.contains(&links) && !ignored.get(level).is_some_and(|of| of.contains(&links))
    };
    let tolerance = POSITION_OF_REACH * 2.0 * reach(robot, tree);
    contacts(module, &poses, tolerance, is_checked, &Budget::of_spheres(deep))
}

/// The contacts of all levels. `is_checked` says of a level and a pair of links whether a check asks it; `tolerance` is that
/// of the radii of two spheres together, m.
///
/// # Errors
/// If a configuration has no poses, or it takes too much work.
pub fn contacts(
    module: &LinkShapesSpheresModule,
    poses: &Poses,
    tolerance: f64,
    is_checked: impl Fn(usize, [usize; 2]) -> bool,
    budget: &Budget,
) -> Result<Vec<LevelFound>, SkipReason> {
    let mut levels: Vec<Level> = Vec::new();
    let mut num_pairs = 0_usize;
    for (number, level) in module.levels.iter().enumerate() {
        let links = 0..poses.num_links().min(level.spheres.len());
        let links =
            links.map(|link| (link, balls(level, link))).filter(|(_, balls)| !balls.is_empty());
        let links: Vec<Link> = links.map(|(link, balls)| Link::new(link, balls)).collect();
        num_pairs += links.len() * links.len().saturating_sub(1) / 2;
        if num_pairs > MOST_PAIRS {
            return Err(skip::spheres_take_too_long(true));
        }
        let mut pairs = Vec::new();
        for b in 0..links.len() {
            for a in 0..b {
                let is_checked = is_checked(number, [links[a].link, links[b].link]);
                pairs.push(Pair { places: [a, b], is_checked, any: 0, all: ALL });
            }
        }
        pairs.sort_unstable_by_key(|pair| pair.places);
        let open = (0..pairs.len()).collect();
        levels.push(Level { links, pairs, open, asked: Vec::new() });
    }
    let mut touches: Vec<Vec<[bool; 2]>> = vec![Vec::new(); levels.len()];
    let count = module.num_samples.0;
    for start in (0..count).step_by(AT_ONCE as usize) {
        let seen = look_at(
            &levels,
            poses,
            tolerance,
            start..count.min(start.saturating_add(AT_ONCE)),
            budget,
        )?;
        for (level, seen) in levels.iter_mut().zip(seen.pairs) {
            for (pair, (any, all)) in level.pairs.iter_mut().zip(seen) {
                pair.any |= any;
                pair.all &= all;
            }
            level.sort_pairs();
        }
        for touched in seen.touches {
            for (of_level, touches) in touches.iter_mut().enumerate() {
                let by = |kind: u8| touched[of_level] & kind != 0;
                touches.push([by(TIGHT), by(LOOSE)]);
            }
        }
    }
    let found = levels.into_iter().zip(touches).map(|(level, touches)| {
        let pairs = level.pairs.iter().map(|pair| PairFound {
            links: pair.places.map(|place| level.links[place].link),
            often: [pair.often(TIGHT), pair.often(LOOSE)],
        });
        LevelFound { pairs: pairs.collect(), touches }
    });
    Ok(found.collect())
}

/// What happened in some configurations.
struct Seen {
    /// For each pair of each level, what it was in any of them, and in all.
    pairs: Vec<Vec<(u8, u8)>>,
    /// For each of them, how each level touches.
    touches: Vec<Vec<u8>>,
}

fn look_at(
    levels: &[Level],
    poses: &Poses,
    tolerance: f64,
    samples: Range<u32>,
    budget: &Budget,
) -> Result<Seen, SkipReason> {
    let nothing = || Seen {
        pairs: levels.iter().map(|level| vec![(0, ALL); level.pairs.len()]).collect(),
        touches: Vec::new(),
    };
    let add = |mut seen: Seen, sample: u32| {
        let (_, poses) = poses.sampled(SPHERES_FIRST.wrapping_add(sample))?;
        let mut work = 2_000 + 50 * poses.len();
        let mut touched = Vec::with_capacity(levels.len());
        for (level, seen) in levels.iter().zip(&mut seen.pairs) {
            let (touches, looked) = level.look(&poses, tolerance, seen);
            touched.push(touches);
            work += looked;
        }
        seen.touches.push(touched);
        budget.spend(work as u64)?;
        Ok(seen)
    };
    let join = |mut a: Seen, b: Seen| {
        for (a, b) in a.pairs.iter_mut().flatten().zip(b.pairs.into_iter().flatten()) {
            *a = (a.0 | b.0, a.1 & b.1);
        }
        a.touches.extend(b.touches);
        Ok(a)
    };
    let parts = samples.into_par_iter().with_min_len(SPLIT);
    parts.try_fold(nothing, add).try_reduce(nothing, join)
}

/// For each of the sampled configurations from the first one of 8.9.6 on, whether it is in collision.
///
/// # Errors
/// If a configuration has no poses, or it takes too much work.
pub fn collisions(
    pieces: &BodyPairs,
    poses: &Poses,
    count: u32,
    budget: &Budget,
) -> Result<Vec<bool>, SkipReason> {
    let base = 2_000 + 50 * poses.num_links() + 4 * pieces.num_shape_pairs();
    let one = |sample: u32| {
        let (_, poses) = poses.sampled(SPHERES_FIRST.wrapping_add(sample))?;
        let (collides, compared) = pieces.any_touches_and_work(&poses);
        budget.spend(base as u64 + COMPARISON * compared as u64)?;
        Ok(collides)
    };
    (0..count).into_par_iter().map(one).collect()
}
