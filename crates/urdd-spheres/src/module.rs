//! Makes `link_shapes_spheres_module` (SPEC 8.9): levels of spheres, with figures, contacts and counts.
//!
//! Levels that cover are each inside the one before. The pieces of a link are cut into cells, as [`cover`](crate::cover) does. A
//! cell's smallest sphere is a sphere of the finest level. Cells that came from one cell of a coarser level have one sphere
//! there: the smallest around theirs, so that it holds them all.

use rayon::prelude::*;

use crate::cover::{Cell, cut};
use crate::fit::Limits;
use crate::fitted::{Numbers, auto_limits, fitted, surfaces};
use crate::frame::{add, norm, scaled, sub};
use crate::judge::{SphereRates, touching};
use crate::model::{Sphere, Spheres};
use crate::samples::{Ask, Moves, Pairs, Region, Sampler};
use crate::surface::Pieces;
use urdd_directory::account::{Account, AccountError, Overdrawn};
use urdd_directory::cancellation::Cancelled;
use urdd_format::index::{Count, LevelIdx, LinkIdx, SphereIdx};
use urdd_format::link_shapes_spheres::{
    LinkShapesSpheresModule, LinkSphere, SPHERES_FIRST, SphereEvaluation, SphereLevel, SphereOrigin,
};
use urdd_format::self_collision_model::LinkPair;
use urdd_geometry::Mesh;
use urdd_geometry::convex::ShapeError;

/// Changes whenever the same robot gets other spheres.
pub const VERSION: &str = "1";

/// Sampled configurations that contacts and counts are of.
pub const SAMPLES: usize = 10_000;

/// Most checks of pairs of links in all of these: of a robot with more pairs there are fewer configurations.
const CHECKS: usize = 50_000_000;

/// Spheres that a person gave: those of each link of the robot.
pub type Given = Vec<Vec<Sphere>>;

/// Why there is no module.
#[derive(Debug)]
pub enum NoSpheres<E> {
    /// The robot cannot be posed.
    Robot(E),
    /// A piece of this link cannot be measured.
    Piece(usize, ShapeError),
    /// The spheres of these links take more work than the account has.
    Costly(Vec<usize>, Overdrawn),
    /// It was cancelled.
    Cancelled(Cancelled),
}

impl<E> NoSpheres<E> {
    fn of_account(links: &[usize], error: AccountError) -> Self {
        match error {
            AccountError::Overdrawn(error) => NoSpheres::Costly(links.to_vec(), error),
            AccountError::Cancelled(cancelled) => NoSpheres::Cancelled(cancelled),
        }
    }
}

impl<E> From<Cancelled> for NoSpheres<E> {
    fn from(cancelled: Cancelled) -> Self {
        NoSpheres::Cancelled(cancelled)
    }
}

/// The robot whose module is made.
#[derive(Debug)]
pub struct Subject<'a, R> {
    /// How it moves.
    pub robot: &'a R,
    /// Its pieces, and the pairs of links that are not skipped (SPEC 8.8.5).
    pub pairs: &'a Pairs,
    /// How many links it has.
    pub num_links: usize,
    /// Levels that a person gave, from coarse to fine; without them spheres are fitted.
    pub given: &'a [Given],
}

/// A level as it is made. Links are those of [`Pairs::links`].
struct Made {
    origin: SphereOrigin,
    covers: bool,
    outer: Option<usize>,
    links: Vec<Level>,
    /// By pair of [`Pairs::checked`].
    ignored: Vec<bool>,
}

/// Makes the module. `progress` receives finished and all steps.
///
/// # Errors
/// If the robot has no poses, a piece cannot be measured, or it is cancelled.
pub fn module<R: Moves>(
    subject: &Subject<R>,
    account: &Account,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<LinkShapesSpheresModule, NoSpheres<R::Error>> {
    let (pairs, cancellation) = (subject.pairs, account.cancellation());
    let samples = samples(pairs);
    let steps = 3;
    progress(0, steps);
    let fine = match subject.given {
        [] => vec![computed(subject, samples)?],
        given => given.iter().map(|own| of_person(own, pairs)).collect(),
    };
    cancellation.check()?;
    progress(1, steps);
    let mut levels = cover(pairs, &fine);
    levels.extend(fine);
    let pieces = (pairs.pieces.par_iter().zip(&pairs.links))
        .map(|(meshes, link)| Pieces::new(meshes).map_err(|error| NoSpheres::Piece(*link, error)))
        .collect::<Result<Vec<Pieces>, _>>()?;
    cancellation.check()?;
    progress(2, steps);
    let contacts = contacts(subject, &levels, samples, account)?;
    cancellation.check()?;
    let levels = levels.iter().zip(contacts);
    let levels = levels.map(|(level, found)| written(subject, level, &pieces, &found, account));
    let levels = levels.collect::<Result<_, _>>()?;
    progress(steps, steps);
    Ok(LinkShapesSpheresModule { levels, num_samples: Count::saturating(samples) })
}

/// How many configurations are looked at.
fn samples(pairs: &Pairs) -> usize {
    let links = pairs.links.len();
    let all = links * links.saturating_sub(1) / 2;
    SAMPLES.min(CHECKS / all.max(1)).max(100)
}

/// The spheres that are fitted, as a level inside of the first.
fn computed<R: Moves>(subject: &Subject<R>, samples: usize) -> Result<Made, NoSpheres<R::Error>> {
    let pairs = subject.pairs;
    let limits: Limits = auto_limits(pairs.links.len());
    let per_link = limits.total / pairs.links.len().max(1);
    let numbers = Numbers::new(samples, pairs, per_link);
    let surface = surfaces(pairs, per_link);
    let mut ignored = vec![false; pairs.checked.len()];
    let (spheres, _) = fitted(subject.robot, pairs, &surface, &numbers, &mut ignored, limits)
        .map_err(NoSpheres::Robot)?;
    let links = spheres.into_iter().map(|own| own.into_iter().map(|one| (one, 0)).collect());
    Ok(Made {
        origin: SphereOrigin::Computed,
        covers: false,
        outer: Some(0),
        links: links.collect(),
        ignored,
    })
}

/// Spheres that a person gave, as a level inside of the first. Those of links without pieces are not among them.
fn of_person(own: &Given, pairs: &Pairs) -> Made {
    let of = |link: &usize| own.get(*link).map_or(&[][..], Vec::as_slice);
    let links = pairs.links.iter().map(|link| of(link).iter().map(|one| (*one, 0)).collect());
    Made {
        origin: SphereOrigin::Given,
        covers: false,
        outer: Some(0),
        links: links.collect(),
        ignored: vec![false; pairs.checked.len()],
    }
}

/// The levels that cover; the first holds all finer ones.
fn cover(pairs: &Pairs, fine: &[Made]) -> Vec<Made> {
    let each = pairs.pieces.par_iter().enumerate().map(|(link, pieces)| {
        let more = fine.iter().flat_map(|level| &level.links[link]);
        let more: Vec<Sphere> = more.map(|(sphere, _)| *sphere).collect();
        covering(pieces, &more)
    });
    let each: Vec<[Level; COUNTS.len()]> = each.collect();
    let level = |number: usize| Made {
        origin: SphereOrigin::Computed,
        covers: true,
        outer: number.checked_sub(1),
        links: each.iter().map(|levels| levels[number].clone()).collect(),
        ignored: vec![false; pairs.checked.len()],
    };
    (0..COUNTS.len()).map(level).collect()
}

/// What sampled configurations say of a level.
struct Found {
    /// Of each pair of links with pieces, in how many configurations it is in contact.
    contacts: Vec<usize>,
    rates: SphereRates,
}

/// All pairs of links with pieces, ascending.
fn all_pairs(links: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..links).flat_map(move |a| (a + 1..links).map(move |b| [a, b]))
}

/// Samples between two looks at whether it is cancelled.
const AT_ONCE: usize = 250;

fn contacts<R: Moves>(
    subject: &Subject<R>,
    levels: &[Made],
    samples: usize,
    account: &Account,
) -> Result<Vec<Found>, NoSpheres<R::Error>> {
    let pairs = subject.pairs;
    let all: Vec<[usize; 2]> = all_pairs(pairs.links.len()).collect();
    let sampler = Sampler { robot: subject.robot, pairs };
    let mut known = Vec::with_capacity(samples);
    while known.len() < samples {
        account.cancellation().check()?;
        let first = u64::from(SPHERES_FIRST) + known.len() as u64;
        let count = AT_ONCE.min(samples - known.len());
        let next = sampler.samples(Region::Bounds, first, count, Ask::Any);
        known.extend(next.map_err(NoSpheres::Robot)?);
    }
    let found = levels.iter().map(|level| {
        let spheres: Spheres = (level.links.iter())
            .map(|own| own.iter().map(|(sphere, _)| *sphere).collect())
            .collect();
        // By pair of all: whether a check asks it.
        let asked: Vec<bool> = (all.iter())
            .map(|pair| {
                let checked = pairs.checked.binary_search(pair);
                checked.is_ok_and(|number| !level.ignored[number])
            })
            .collect();
        let touching = touching(&spheres, &all, &known, account).map_err(|costly| {
            NoSpheres::of_account(&costly.links.map(|link| pairs.links[link]), costly.error)
        })?;
        let mut found = Found { contacts: vec![0; all.len()], rates: SphereRates::default() };
        for (sample, touching) in known.iter().zip(touching) {
            let touches = touching.iter().any(|pair| asked[*pair as usize]);
            found.rates.count(sample.collides(), touches);
            for pair in touching {
                found.contacts[pair as usize] += 1;
            }
        }
        Ok(found)
    });
    found.collect()
}

/// The level as the module has it.
fn written<R: Moves>(
    subject: &Subject<R>,
    level: &Made,
    pieces: &[Pieces],
    found: &Found,
    account: &Account,
) -> Result<SphereLevel, NoSpheres<R::Error>> {
    let pairs = subject.pairs;
    let samples = found.rates.colliding + found.rates.free;
    let mut spheres = vec![Vec::new(); subject.num_links];
    let mut fits = vec![None; subject.num_links];
    let figures: Vec<_> = (level.links.par_iter().zip(pieces).zip(&pairs.links))
        .map(|((own, pieces), link)| {
            let own: Vec<Sphere> = own.iter().map(|(sphere, _)| *sphere).collect();
            let fit = (!own.is_empty()).then(|| pieces.fit(&own, account)).transpose();
            fit.map_err(|error| NoSpheres::of_account(&[*link], error))
        })
        .collect::<Result<_, _>>()?;
    for ((link, own), fit) in pairs.links.iter().zip(&level.links).zip(figures) {
        let one = |(sphere, outer): &(Sphere, usize)| LinkSphere {
            radius: sphere.radius,
            offset_xyz: sphere.centre,
            outer_sphere_idx: level.outer.map(|_| SphereIdx(index(*outer))),
        };
        spheres[*link] = own.iter().map(one).collect();
        fits[*link] = fit;
    }
    let of = |[a, b]: [usize; 2]| LinkPair {
        link_a_idx: LinkIdx(index(pairs.links[a])),
        link_b_idx: LinkIdx(index(pairs.links[b])),
    };
    let with = |is: &dyn Fn(usize) -> bool| {
        let all = all_pairs(pairs.links.len()).zip(&found.contacts);
        all.filter(|(_, count)| is(**count)).map(|(pair, _)| of(pair)).collect()
    };
    let ignored = pairs.checked.iter().zip(&level.ignored);
    let SphereRates { colliding, missed, free, false_contacts } = found.rates;
    Ok(SphereLevel {
        origin: level.origin,
        covers: level.covers,
        outer_level_idx: level.outer.map(|outer| LevelIdx(index(outer))),
        spheres,
        fits,
        ignored_pairs: ignored.filter(|(_, is)| **is).map(|(pair, _)| of(*pair)).collect(),
        always_pairs: with(&|count| count == samples),
        sometimes_pairs: with(&|count| count > 0 && count < samples),
        evaluation: SphereEvaluation {
            num_colliding: Count::saturating(colliding),
            num_missed: Count::saturating(missed),
            num_free: Count::saturating(free),
            num_false_contacts: Count::saturating(false_contacts),
        },
    })
}

fn index(of: usize) -> u32 {
    u32::try_from(of).unwrap_or(u32::MAX)
}

/// The most spheres of a link in the levels that cover, from coarse to fine.
pub const COUNTS: [usize; 3] = [1, 4, 16];

/// Steps of the search for the smallest sphere around spheres.
const STEPS: u32 = 400;

/// Radii are larger by this part, so that rounding leaves no vertex outside and no sphere out of its outer one.
const LARGER: f64 = 1.0 + 1e-10;

/// Spheres of one level, each with the index of its outer sphere in the level before; 0 in the first.
pub type Level = Vec<(Sphere, usize)>;

/// The levels of a link from coarse to fine, from its pieces; each is empty without a piece. The first holds `more` too.
pub fn covering(pieces: &[Mesh], more: &[Sphere]) -> [Level; COUNTS.len()] {
    let mut levels: [Level; COUNTS.len()] = Default::default();
    if pieces.is_empty() {
        return levels;
    }
    let vertices: Vec<_> = pieces.iter().map(|mesh| mesh.vertices.clone()).collect();
    let mut cells = vec![Cell::new(&vertices)];
    // The cell that each was cut from, and how many there are in each level.
    let mut cut_from = vec![0];
    let counts = COUNTS.map(|count| {
        while cells.len() < count {
            let Some(cell) = cut(&mut cells) else { break };
            cut_from.push(cell);
        }
        cells.len()
    });
    let mut inner: Vec<Sphere> = cells.iter().map(|cell| larger(cell.sphere)).collect();
    for level in (0..COUNTS.len()).rev() {
        levels[level] = inner.iter().map(|sphere| (*sphere, 0)).collect();
        let Some(count) = level.checked_sub(1).map(|outer| counts[outer]) else { break };
        let mut held = vec![Vec::new(); count];
        for (number, (sphere, outer)) in levels[level].iter_mut().enumerate() {
            *outer = number;
            while *outer >= count {
                *outer = cut_from[*outer];
            }
            held[*outer].push(*sphere);
        }
        if level == 1 {
            held.iter_mut().for_each(|held| held.extend(more));
        }
        inner = held.iter().map(|held| around(held)).collect();
    }
    levels
}

fn larger(sphere: Sphere) -> Sphere {
    Sphere { centre: sphere.centre, radius: (sphere.radius * LARGER).max(f64::MIN_POSITIVE) }
}

/// A sphere around spheres, close to the smallest: the centre moves toward the farthest one by smaller and smaller steps
/// (Bădoiu and Clarkson, Smaller Core-Sets for Balls, 2003).
pub fn around(spheres: &[Sphere]) -> Sphere {
    let Some(first) = spheres.first() else {
        return Sphere { centre: [0.0; 3], radius: f64::MIN_POSITIVE };
    };
    let reach = |centre, sphere: &Sphere| norm(sub(sphere.centre, centre)) + sphere.radius;
    let farthest = |centre| {
        let each = spheres.iter().map(|sphere| (reach(centre, sphere), sphere));
        each.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, first))
    };
    let mut centre = first.centre;
    let mut best = (farthest(centre).0, centre);
    for step in 1..=STEPS {
        let (_, sphere) = farthest(centre);
        let between = sub(sphere.centre, centre);
        let length = norm(between);
        // The farthest point of that sphere.
        let far = if length > 0.0 {
            add(between, scaled(between, sphere.radius / length))
        } else {
            [sphere.radius, 0.0, 0.0]
        };
        centre = add(centre, scaled(far, 1.0 / f64::from(step + 1)));
        let radius = farthest(centre).0;
        if radius < best.0 {
            best = (radius, centre);
        }
    }
    larger(Sphere { centre: best.1, radius: best.0 })
}
