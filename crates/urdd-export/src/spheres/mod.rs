//! Sphere approximations of links, and the pairs of links that a planner ignores with them.
//!
//! `fit` fits spheres that give the same collision results as the exact shapes; [`cover`] covers each link
//! completely. In both cases [`judge`] evaluates the written spheres and pairs in configurations that were not used for
//! the fit. The counts are written with them.

#[doc(hidden)]
pub mod cover;
pub(super) mod curobo;
mod fit;
pub(super) mod foam;
#[doc(hidden)]
pub mod frame;
#[doc(hidden)]
pub mod judge;
mod loss;
mod measure;
mod model;
mod pairs;
mod said;
#[doc(hidden)]
pub mod samples;
#[doc(hidden)]
pub mod surface;

use rayon::prelude::*;

use crate::{Choices, ExportError, Shapes, Subject};
use fit::Limits;
use frame::Point;
pub use judge::SphereRates;
use measure::{Measured, Numbers, measure};
use model::{Sphere, Spheres};
use pairs::Pairs;
use samples::{Ask, Region, Sample, Sampler};
use urdd_robot::{RobotError, ShapeKind};

const AUTO_PER_LINK: usize = 12;
const AUTO_TOTAL: usize = 150;

/// Rounding factor of written lengths: 6 decimal places, in metres.
const DIGITS: f64 = 1e6;

/// Minimum fraction of free configurations for the fit. With fewer, some samples are taken near the default
/// configuration.
const FEW_FREE: f64 = 0.02;

/// Points on the surface of a link: minimum, per sphere, and maximum.
const POINTS: [usize; 3] = [600, 40, 4000];

/// Maximum change of all radii after the fit, relative to their mean.
const GROWTH: f64 = 0.25;

/// Minimum distance of spheres in the default configuration, if it is free, relative to the maximum change of radii.
const APART: f64 = 0.02;

/// The data of the file.
struct Model {
    /// The links that have shapes, ascending, with their spheres.
    links: Vec<(usize, Vec<Sphere>)>,
    /// Points on the surface of each link.
    surface: Vec<Vec<Point>>,
    /// Ignored pairs of links, ascending: the URDD skips all their pairs of pieces, or they were never in contact.
    ignored: Vec<[usize; 2]>,
    /// The number of these that were never in contact, although the URDD does not skip them.
    ignored_as_never: usize,
    measured: Measured,
}

impl Model {
    fn new(subject: &Subject) -> Result<Self, ExportError> {
        let options = &subject.options.chosen;
        let kind = match options.shapes {
            Shapes::Kind(kind @ (ShapeKind::Pieces | ShapeKind::Hulls)) => kind,
            other => return Err(ExportError::SpheresOf(other)),
        };
        let pairs = Pairs::new(subject, kind, options.reasons.as_deref())?;
        let limits = limits(options, pairs.links.len());
        let per_link = limits.total / pairs.links.len().max(1);
        let count = (POINTS[1] * per_link).clamp(POINTS[0], POINTS[2]);
        let surface: Vec<Vec<Point>> =
            (pairs.pieces.par_iter()).map(|pieces| surface::points(pieces, count)).collect();
        let numbers = Numbers::new(options.samples, &pairs, per_link);
        let mut ignored = vec![false; pairs.checked.len()];
        let (spheres, near) = if options.cover {
            (covering(options, &pairs), false)
        } else {
            fitted(subject, &pairs, &surface, &numbers, &mut ignored, limits)?
        };
        let measured = measure(subject.robot, &pairs, &spheres, &ignored, &numbers, near)?;
        let mut written = Vec::new();
        for a in 0..pairs.links.len() {
            for b in a + 1..pairs.links.len() {
                let number = pairs.checked.binary_search(&[a, b]);
                if !number.is_ok_and(|number| !ignored[number]) {
                    written.push([pairs.links[a], pairs.links[b]]);
                }
            }
        }
        Ok(Model {
            links: pairs.links.iter().copied().zip(spheres).collect(),
            surface,
            ignored: written,
            ignored_as_never: ignored.iter().filter(|ignored| **ignored).count(),
            measured,
        })
    }
}

/// A number for all links counts before one for each.
fn limits(options: &Choices, links: usize) -> Limits {
    match (options.total_spheres, options.spheres) {
        (Some(total), _) => Limits { total, per_link: usize::MAX },
        (None, Some(count)) => Limits { total: count.saturating_mul(links), per_link: count },
        (None, None) => {
            Limits { total: (AUTO_PER_LINK * links).min(AUTO_TOTAL), per_link: usize::MAX }
        }
    }
}

fn covering(options: &Choices, pairs: &Pairs) -> Spheres {
    let vertices = |pieces: &Vec<urdd_geometry::Mesh>| {
        pieces.iter().map(|mesh| mesh.vertices.clone()).collect()
    };
    let links: Vec<Vec<Vec<Point>>> = pairs.pieces.iter().map(vertices).collect();
    cover::cover(&links, options.spheres, options.total_spheres)
}

/// Fits spheres that give the same collision results as the exact shapes. Also returns whether the fit used
/// configurations near the default one.
fn fitted(
    subject: &Subject,
    pairs: &Pairs,
    surface: &[Vec<Point>],
    numbers: &Numbers,
    ignored: &mut [bool],
    limits: Limits,
) -> Result<(Spheres, bool), RobotError> {
    let sampler = Sampler { robot: subject.robot, pairs };
    let mut near = false;
    let mut known: Vec<Sample> = Vec::new();
    if !pairs.checked.is_empty() {
        known.push(sampler.zero(Ask::Pairs)?);
        let some = numbers.fit / 10;
        let take = |region, first, count| sampler.samples(region, first, count, Ask::Pairs);
        let first = Numbers::FIT;
        known.extend(take(Region::Bounds, first, some)?);
        let free = known.iter().filter(|sample| !sample.collides()).count();
        near = (free as f64) < FEW_FREE * known.len() as f64;
        known.extend(if near {
            take(Region::NearDefault, first, numbers.fit - some)?
        } else {
            take(Region::Bounds, first + some as u64, numbers.fit - some)?
        });
    }
    let mut to_balance = Vec::new();
    if let Some(default) = known.first() {
        let region = if near { Region::NearDefault } else { Region::Bounds };
        let (first, count) = (Numbers::GROW, numbers.measure);
        to_balance = sampler.samples(region, first, count, Ask::Any)?;
        to_balance.insert(0, default.clone());
    }
    let mut best: Option<(f64, Spheres, Vec<bool>)> = None;
    for steps in fit::CONTACT_STEP {
        let mut own = ignored.to_vec();
        let mut spheres = fit::fit(surface, &known, &pairs.checked, &mut own, limits, steps);
        let worse = if to_balance.is_empty() {
            0.0
        } else {
            balance(&mut spheres, surface, pairs, &mut own, &known, &to_balance)
        };
        if best.as_ref().is_none_or(|best| worse < best.0) {
            best = Some((worse, spheres, own));
        }
        if worse <= 1.0 {
            break;
        }
    }
    let mut spheres = Spheres::new();
    if let Some((_, found, own)) = best {
        spheres = found;
        ignored.copy_from_slice(&own);
    }
    let rounded = |x: f64| (x * DIGITS).round() / DIGITS + 0.0;
    for sphere in spheres.iter_mut().flatten() {
        // Rounds before the evaluation. Tiny spheres keep all digits.
        if sphere.radius * DIGITS > 1e2 {
            sphere.centre = sphere.centre.map(rounded);
            sphere.radius = rounded(sphere.radius);
        }
    }
    Ok((spheres, near))
}

/// Grows or shrinks all radii so that the rates are balanced, with the default configuration free; twice, since a pair
/// that becomes ignored changes the balance. Returns the worse rate, relative to its goal.
fn balance(
    spheres: &mut Spheres,
    surface: &[Vec<Point>],
    pairs: &Pairs,
    ignored: &mut [bool],
    known: &[Sample],
    to_balance: &[Sample],
) -> f64 {
    let checked = &pairs.checked;
    let radii = spheres.iter().flatten().map(|sphere| sphere.radius);
    let limit = GROWTH * radii.sum::<f64>() / model::count(spheres).max(1) as f64;
    for _ in 0..2 {
        let gaps = judge::gaps(spheres, checked, ignored, to_balance, limit);
        let by = judge::growth(to_balance, &gaps, limit);
        for sphere in spheres.iter_mut().flatten() {
            sphere.radius = (sphere.radius + by).max(0.5 * sphere.radius);
        }
        let goal = fit::Goal { surface, samples: known, pairs: checked, size: limit };
        goal.look(spheres, ignored, f64::MIN_POSITIVE);
        if !known[0].collides() {
            let left = checked.iter().zip(&*ignored).filter(|(_, ignored)| !**ignored);
            let left: Vec<[usize; 2]> = left.map(|(pair, _)| *pair).collect();
            model::part(spheres, &left, &known[0], APART * limit);
        }
    }
    let gaps = judge::gaps(spheres, checked, ignored, to_balance, limit);
    judge::rates(to_balance, &gaps).worse()
}
