//! Sphere approximations of links, and the pairs of links that a planner ignores with them.
//!
//! They are those of the URDD, or new ones: fitted so that they give the same collision results as the exact
//! shapes, or covering each link completely. The written spheres and pairs are measured in configurations that were
//! not used for the fit. The counts are written with them.

pub(super) mod curobo;
pub(super) mod import;
pub(super) mod said;

use std::collections::{HashMap, HashSet};

use nalgebra::Isometry3;

use crate::pairs::Decision;
use crate::{Choices, ExportError, Shapes, Subject};
use urdd_directory::account::AccountError;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::link_shapes_spheres::{SphereLevel, SphereOrigin};
use urdd_format::registry::ModuleKind;
use urdd_geometry::Mesh;
use urdd_robot::{LinkShape, Robot, RobotError, ShapeKind, Solid};
use urdd_spheres::fit::Limits;
use urdd_spheres::fitted::{Numbers, auto_limits, fitted, surfaces};
use urdd_spheres::frame::Point;
use urdd_spheres::judge::{CostlyPair, PairFaults};
use urdd_spheres::model::{Sphere, Spheres, count};
use urdd_spheres::samples::{Ask, Moves, Pairs, Region, Sample, Sampler};
use urdd_spheres::{cover, judge};

pub use urdd_spheres::judge::SphereRates;

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
    /// The level of `link_shapes_spheres_module` that the spheres are; `None` where they were made now.
    level: Option<Level>,
}

impl Model {
    fn new(subject: &Subject) -> Result<Self, ExportError> {
        let options = &subject.options.chosen;
        let kind = match options.shapes {
            Shapes::Kind(kind @ (ShapeKind::Pieces | ShapeKind::Hulls)) => kind,
            other => return Err(ExportError::SpheresOf(other)),
        };
        let pairs = checked_pairs(subject.robot, &subject.links, kind, options.reasons.as_deref())?;
        let limits = limits(options, pairs.links.len());
        let per_link = limits.total / pairs.links.len().max(1);
        let surface = surfaces(&pairs, per_link);
        let numbers = Numbers::new(options.samples, &pairs, per_link);
        let mut ignored = vec![false; pairs.checked.len()];
        let level = level(subject.robot, options)?;
        let (spheres, near) = if let Some(level) = &level {
            level.mark_ignored(&pairs, &mut ignored);
            (level.spheres(&pairs.links), false)
        } else if options.cover {
            (covering(options, &pairs), false)
        } else {
            fitted(&Moving(subject.robot), &pairs, &surface, &numbers, &mut ignored, limits)?
        };
        let measured = measure(subject, &pairs, &spheres, &ignored, &numbers, near)?;
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
            level,
        })
    }
}

/// A number for all links counts before one for each.
fn limits(options: &Choices, links: usize) -> Limits {
    match (options.total_spheres, options.spheres) {
        (Some(total), _) => Limits { total, per_link: usize::MAX },
        (None, Some(count)) => Limits { total: count.saturating_mul(links), per_link: count },
        (None, None) => auto_limits(links),
    }
}

fn covering(options: &Choices, pairs: &Pairs) -> Spheres {
    let vertices = |pieces: &Vec<urdd_geometry::Mesh>| {
        pieces.iter().map(|mesh| mesh.vertices.clone()).collect()
    };
    let links: Vec<Vec<Vec<Point>>> = pairs.pieces.iter().map(vertices).collect();
    cover::cover(&links, options.spheres, options.total_spheres)
}

/// A level of `link_shapes_spheres_module`.
pub(super) struct Level {
    number: usize,
    level: SphereLevel,
}

/// The level to write: with `cover` the finest that covers, otherwise the last that does not. `None` where the URDD has none,
/// or other spheres are asked for.
pub(super) fn level(robot: &Robot, options: &Choices) -> Result<Option<Level>, RobotError> {
    let default = Choices::default();
    let is_other = options.spheres.is_some()
        || options.total_spheres.is_some()
        || options.shapes != default.shapes;
    if is_other {
        return Ok(None);
    }
    let Some(module) = robot.spheres_module()? else { return Ok(None) };
    let mut levels = module.levels.into_iter().enumerate().rev();
    let found = levels.find(|(_, level)| level.covers == options.cover);
    Ok(found.map(|(number, level)| Level { number, level }))
}

impl Level {
    pub fn spheres(&self, links: &[usize]) -> Spheres {
        let one = |link: &usize| {
            let own = self.level.spheres[*link].iter();
            own.map(|sphere| Sphere { centre: sphere.offset_xyz, radius: sphere.radius }).collect()
        };
        links.iter().map(one).collect()
    }

    /// Marks the pairs that a check by this level leaves out.
    fn mark_ignored(&self, pairs: &Pairs, ignored: &mut [bool]) {
        let own = self.level.ignored_pairs.iter();
        let own: HashSet<[usize; 2]> =
            own.map(|of| [of.link_a_idx.get(), of.link_b_idx.get()]).collect();
        for (pair, ignored) in pairs.checked.iter().zip(ignored) {
            *ignored = own.contains(&pair.map(|link| pairs.links[link]));
        }
    }

    /// Whether a person gave them.
    pub fn is_given(&self) -> bool {
        self.level.origin == SphereOrigin::Given
    }

    pub fn said(&self) -> String {
        let origin = if self.is_given() { ", which a person gave" } else { "" };
        format!(
            "The spheres are those of level {} of link_shapes_spheres_module{origin}.",
            self.number
        )
    }
}

/// The robot, as its URDD moves.
pub(super) struct Moving<'a>(pub &'a Robot);

impl Moves for Moving<'_> {
    type Error = RobotError;

    fn start(&self) -> Result<Vec<f64>, RobotError> {
        Ok(self.0.configurations()?.zero())
    }

    fn sampled(&self, k: u64) -> Result<Vec<f64>, RobotError> {
        Ok(self.0.configurations()?.random(k))
    }

    fn link_poses(&self, configuration: &[f64]) -> Result<Vec<Isometry3<f64>>, RobotError> {
        self.0.link_poses(configuration)
    }
}

/// Pairs of links with shapes of which the URDD checks at least one pair of pieces.
pub(super) fn checked_pairs(
    robot: &Robot,
    names: &[String],
    kind: ShapeKind,
    reasons: Option<&[SkippedReason]>,
) -> Result<Pairs, ExportError> {
    let shapes = robot.shapes(kind)?;
    let count = names.len();
    if let Some(index) = shapes.iter().map(|shape| shape.link).find(|link| *link >= count) {
        let what = "link";
        return Err(RobotError::OutOfRange { what, index, count }.into());
    }
    let skips = robot.skips(kind)?;
    let decision = Decision::new(&skips, names, reasons);
    let rows: HashMap<(usize, usize), usize> =
        skips.places().iter().enumerate().map(|(row, place)| (*place, row)).collect();
    let row = |shape: &LinkShape| rows.get(&(shape.link, shape.piece)).copied();
    let rows: Vec<Option<usize>> = shapes.iter().map(row).collect();
    let is_checked = |a: usize, b: usize| match rows[a].zip(rows[b]) {
        Some((a, b)) => !decision.is_skipped(a, b),
        None => true,
    };
    let meshes: Vec<(usize, Mesh)> = shapes
        .into_iter()
        .filter_map(|shape| match shape.solid {
            Solid::Mesh(mesh) => Some((shape.link, mesh)),
            Solid::Box { .. } | Solid::Sphere { .. } => None,
        })
        .collect();
    let links: Vec<usize> = meshes.iter().map(|(link, _)| *link).collect();
    Ok(Pairs::new(meshes, is_checked).map_err(|(shape, error)| RobotError::Unusable {
        module: ModuleKind::ConvexDecompositionMeshes,
        reason: format!("a piece of link {}: {error}", links[shape]),
    })?)
}

/// What a sphere adds to the account, bytes: about what a file says of it.
const SPHERE: usize = 100;

/// Maximum number of wrong results that are traced to pairs.
const TRACED: usize = 2000;

#[derive(Debug, Default)]
pub(super) struct Measured {
    /// Rates in configurations throughout the bounds; `None` if no pair is checked.
    pub rates: Option<SphereRates>,
    /// Rates in configurations near the default one, if the fit used such configurations.
    pub near_default: Option<SphereRates>,
    /// Whether the exact shapes collide in the default configuration, and whether the spheres touch.
    pub default: [bool; 2],
    /// The pairs of links that cause wrong results, worst first.
    pub faults: Vec<([usize; 2], PairFaults)>,
}

impl Measured {
    /// Whether both rates are within the goals, and the spheres are free in the default configuration if the shapes
    /// are.
    pub fn is_good(&self) -> bool {
        let all = self.rates.iter().chain(&self.near_default);
        let [collides, touches] = self.default;
        let is_few =
            |rates: &SphereRates| self.near_default.is_some() && Some(rates) == self.rates.as_ref();
        let is_good = |rates: &SphereRates| match is_few(rates) {
            // Too few free configurations to count false contacts.
            true => SphereRates { free: 0, false_contacts: 0, ..*rates }.are_within_goals(),
            false => rates.are_within_goals(),
        };
        (collides || !touches) && all.into_iter().all(is_good)
    }
}

fn measure(
    subject: &Subject,
    pairs: &Pairs,
    spheres: &Spheres,
    ignored: &[bool],
    numbers: &Numbers,
    near: bool,
) -> Result<Measured, RobotError> {
    let mut measured = Measured::default();
    if pairs.checked.is_empty() {
        return Ok(measured);
    }
    let Subject { robot, account, .. } = *subject;
    account.deposit(count(spheres) * SPHERE);
    let touch = |samples: &[Sample]| {
        account.cancellation().check()?;
        let found = judge::any_touching(spheres, &pairs.checked, ignored, samples, account);
        found.map_err(|CostlyPair { links, error }| match error {
            AccountError::Cancelled(cancelled) => cancelled.into(),
            AccountError::Overdrawn(error) => RobotError::Unusable {
                module: ModuleKind::LinkShapesSpheres,
                reason: format!(
                    "the spheres of links {:?}: {error}",
                    links.map(|link| pairs.links[link])
                ),
            },
        })
    };
    let sampler = Sampler { robot: &Moving(robot), pairs };
    let zero = sampler.zero(Ask::Any)?;
    measured.default = [zero.collides(), touch(std::slice::from_ref(&zero))?[0]];
    let mut wrong: Vec<Sample> = Vec::new();
    let mut count = |region| -> Result<SphereRates, RobotError> {
        let (first, number) = (Numbers::MEASURE, numbers.measure);
        let known = sampler.samples(region, first, number, Ask::Any)?;
        let mut rates = SphereRates::default();
        for (k, (sample, touches)) in known.iter().zip(touch(&known)?).enumerate() {
            rates.count(sample.collides(), touches);
            if sample.collides() != touches && wrong.len() < TRACED {
                wrong.push(sampler.nth(region, first, k, Ask::Pairs)?);
            }
        }
        Ok(rates)
    };
    measured.rates = Some(count(Region::Bounds)?);
    if near {
        measured.near_default = Some(count(Region::NearDefault)?);
    }
    if measured.default == [false, true] {
        wrong.push(zero);
    }
    let faults = judge::faults(spheres, &pairs.checked, ignored, &wrong);
    let mut faults: Vec<([usize; 2], PairFaults)> = faults
        .into_iter()
        .map(|(pair, faults)| (pairs.checked[pair].map(|link| pairs.links[link]), faults))
        .collect();
    // A missed collision weighs as much as five false contacts, in line with the goals of 1 % and 5 %.
    faults.sort_by_key(|(links, faults)| {
        (std::cmp::Reverse(5 * faults.missed + faults.false_contacts), *links)
    });
    measured.faults = faults;
    Ok(measured)
}
