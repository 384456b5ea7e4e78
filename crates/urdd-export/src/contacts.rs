//! By what pairs of shapes are judged, and contacts of those that a link-level format treats differently from the URDD.

use std::collections::{HashMap, HashSet};
use std::fmt::Display;

use rayon::prelude::*;

use crate::pairs::{ascending, pairs};
use crate::{Choices, Contacts, ExportError, Layout, LinkPair, Shape, Solid, Structure};
use urdd_directory::account::Account;
use urdd_document::tree::RigidGroups;
use urdd_format::link_shapes_simple_skips::{CONTACT, SeenPair, SkipReason};
use urdd_geometry::convex::{ConvexShape, Motion, PlacedShape, pair_distances, pair_ranges};
use urdd_geometry::decompose::{self, decompose};
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::primitives::Prism;
use urdd_robot::{Robot, RobotError, ShapeKind, Skips};

/// Number of sampled configurations to evaluate if the URDD does not record its own.
const USUAL_SAMPLES: u32 = 1_000;
const MAX_SAMPLES: u32 = 10_000;

pub(super) enum Basis {
    /// By the URDD's own skips of a kind of shapes.
    Kind(ShapeKind, Skips),
    /// By shapes that only the export has.
    Written(Box<Judged>),
}

impl Basis {
    /// The shapes, and which pairs of them are skipped.
    pub fn skips(&self) -> &Skips {
        match self {
            Basis::Kind(_, skips) => skips,
            Basis::Written(judged) => &judged.skips,
        }
    }

    /// Every pair of links with shapes, sorted by index, as a format of pairs of links, or of pieces, represents them; the
    /// former with contacts.
    pub fn link_pairs(
        &self,
        robot: &Robot,
        layout: &Layout,
        links: &[String],
        choices: &Choices,
        of_pieces: bool,
        account: &Account,
    ) -> Result<Vec<LinkPair>, ExportError> {
        let (reasons, keeps) = (choices.reasons.as_deref(), choices.keep_pairs && !of_pieces);
        let mut pairs = pairs(self.skips(), layout, links, reasons, keeps, account)?;
        if !of_pieces {
            count(robot, layout, self, &mut pairs)?;
        }
        Ok(pairs)
    }
}

/// The number of sampled configurations by which pairs are judged here.
pub(super) fn num_samples(robot: &Robot) -> Result<u32, RobotError> {
    Ok(robot.num_samples()?.unwrap_or(USUAL_SAMPLES).min(MAX_SAMPLES))
}

/// Counts the contacts of mixed pairs, except those that differ only by the reason `Never`. Counts nothing without
/// bounds, since there are then no sampled configurations.
fn count(
    robot: &Robot,
    layout: &Layout,
    basis: &Basis,
    pairs: &mut [LinkPair],
) -> Result<(), RobotError> {
    let of_shapes: HashMap<[(usize, usize); 2], bool> = pairs
        .iter()
        .filter(|pair| !matches!(pair.reason, Some(SkipReason::Never | SkipReason::None)))
        .flat_map(|pair| {
            let [a, b] = pair.links;
            let mixed = pair.mixed.iter();
            mixed.flat_map(move |mixed| {
                let checked = mixed.checked.iter().map(|pieces| (pieces, true));
                let skipped = mixed.skipped.iter().map(|pieces| (pieces, false));
                let both = checked.chain(skipped);
                both.map(move |(pieces, checked)| ([(a, pieces[0]), (b, pieces[1])], checked))
            })
        })
        .collect();
    if of_shapes.is_empty() {
        return Ok(());
    }
    let configurations = match robot.configurations() {
        Err(RobotError::Missing(_)) => return Ok(()),
        other => other?,
    };
    let samples = num_samples(robot)?;
    let sampled: Vec<f64> =
        (0..u64::from(samples)).flat_map(|k| configurations.random(k)).collect();
    let body = |link: usize| layout.body(link);
    let contacts = |checked: bool| -> Result<HashMap<[usize; 2], usize>, RobotError> {
        let is_wanted = |shapes: [(usize, usize); 2]| {
            let mut shapes = shapes.map(|shape| layout.shape(shape));
            shapes.sort_unstable();
            of_shapes.get(&shapes) == Some(&checked)
        };
        Ok(match basis {
            Basis::Written(judged) => judged.contacts(is_wanted, body),
            Basis::Kind(kind, _) => {
                let found = robot.proximity_of(*kind, is_wanted)?;
                found.contacts_of_links(&sampled, body)?.into_iter().collect()
            }
        })
    };
    let (checked, skipped) = (contacts(true)?, contacts(false)?);
    for pair in pairs {
        if let Some(mixed) = &mut pair.mixed
            && let (Some(checked), Some(skipped)) =
                (checked.get(&pair.links), skipped.get(&pair.links))
        {
            mixed.contacts = Some(Contacts { checked: *checked, skipped: *skipped, samples });
        }
    }
    Ok(())
}

/// The most shapes, or pieces of them, of which pairs are judged: time grows with their square.
const MOST_SHAPES: usize = 1_000;

/// A robot's shapes that no URDD has judged, with their reasons: by the same samples and reasons (SPEC 8.6).
pub(super) struct Judged {
    pub skips: Skips,
    bodies: Vec<PlacedShape<ConvexShape>>,
    /// Each body is all points that are at most this far from its shape, m.
    radii: Vec<f64>,
    sampled: Motion,
}

impl Judged {
    /// Judges shapes, by link, in so many samples. A mesh that is not convex counts as its hull, or as its convex pieces,
    /// which then have numbers of their own.
    pub fn new(
        robot: &Robot,
        structure: &Structure,
        shapes: &[Vec<Shape>],
        as_hulls: bool,
        samples: u32,
    ) -> Result<Self, ExportError> {
        let within = |count: usize| match count > MOST_SHAPES {
            true => Err(ExportError::TooManyShapes { count, most: MOST_SHAPES }),
            false => Ok(()),
        };
        within(shapes.iter().map(Vec::len).sum())?;
        let (mut places, mut bodies, mut radii) = (Vec::new(), Vec::new(), Vec::new());
        for (link, shapes) in shapes.iter().enumerate() {
            let of_link = shapes.iter().flat_map(|shape| cores(shape, as_hulls));
            for (place, (number, points, radius)) in of_link.enumerate() {
                let shape = ConvexShape::of_points(&points).map_err(unusable)?;
                bodies.push(PlacedShape { body: link, shape });
                places.push((link, if as_hulls { number } else { place }));
                radii.push(radius);
            }
            // A mesh may have become several.
            within(bodies.len())?;
        }
        let groups = RigidGroups::new(&structure.view, &structure.tree).of_link;
        let space = robot.configurations()?;
        let poses = |configuration: Vec<f64>| robot.link_poses(&configuration);
        let random = (0..u64::from(samples)).into_par_iter().map(|k| poses(space.random(k)));
        let random = random.collect::<Result<Vec<_>, RobotError>>()?;
        let sampled = Motion::new(&random, &groups).map_err(unusable)?;
        let default = Motion::new(&[poses(space.zero())?], &groups).map_err(unusable)?;
        // Whether a distance is of contact is all that is asked.
        let range = |i: usize, j: usize| Some([0.0, CONTACT + radii[i] + radii[j]]);
        let over = |motion: &Motion| {
            let found = pair_ranges(&bodies, motion, range);
            found.ok_or_else(|| unusable("a link has no pose"))
        };
        let (seen, at_default) = (over(&sampled)?, over(&default)?);
        let joined: HashSet<[usize; 2]> =
            structure.tree.joint_links.iter().map(|&(a, b)| ascending(a, b)).collect();
        let reason = |i: usize, j: usize| {
            let [a, b] = [bodies[i].body, bodies[j].body];
            let between = |distance: f64| distance - radii[i] - radii[j];
            let pair = SeenPair {
                is_same_link: a == b,
                is_joined: joined.contains(&ascending(a, b)),
                range: [between(seen.min[i][j]), between(seen.max[i][j])],
                at_default: between(at_default.min[i][j]),
            };
            pair.reason()
        };
        let all = 0..bodies.len();
        let reasons: Vec<Vec<SkipReason>> =
            all.clone().map(|i| all.clone().map(|j| reason(i, j)).collect()).collect();
        let skips = robot.skips(ShapeKind::Hulls)?.of_reasons(places, reasons);
        Ok(Judged { skips, bodies, radii, sampled })
    }

    /// For each pair of bodies with wanted pairs of shapes, in how many samples any of these touches. Shapes have their
    /// link and their number.
    pub fn contacts(
        &self,
        wanted: impl Fn([(usize, usize); 2]) -> bool + Sync,
        body: impl Fn(usize) -> usize + Sync,
    ) -> HashMap<[usize; 2], usize> {
        let places = self.skips.places();
        let pairs = (0..places.len()).flat_map(|i| (0..i).map(move |j| [j, i]));
        let pairs: Vec<[usize; 2]> =
            pairs.filter(|pair| wanted(pair.map(|shape| places[shape]))).collect();
        let touches = |[i, j]: [usize; 2]| {
            let distances = pair_distances(&self.bodies[i], &self.bodies[j], &self.sampled);
            let reach = self.radii[i] + self.radii[j];
            let touches = distances.unwrap_or_default().into_iter().map(|it| it <= reach);
            (ascending(body(places[i].0), body(places[j].0)), touches.collect::<Vec<bool>>())
        };
        let mut by_links: HashMap<[usize; 2], Vec<bool>> = HashMap::new();
        for (links, touches) in pairs.into_par_iter().map(touches).collect::<Vec<_>>() {
            let known = by_links.entry(links).or_insert_with(|| vec![false; touches.len()]);
            known.iter_mut().zip(touches).for_each(|(known, one): (_, bool)| *known |= one);
        }
        let count = |touches: Vec<bool>| touches.into_iter().filter(|one| *one).count();
        by_links.into_iter().map(|(links, touches)| (links, count(touches))).collect()
    }
}

fn unusable(error: impl Display) -> ExportError {
    ExportError::Unmeasurable(error.to_string())
}

/// The convex bodies of a shape: its number, points, and how far around them it reaches.
fn cores(shape: &Shape, as_hulls: bool) -> Vec<(usize, Vec<[f64; 3]>, f64)> {
    let (points, radius) = match &shape.solid {
        Solid::Mesh(mesh) if !as_hulls => {
            let pieces = decompose(mesh, &decompose::Settings::default()).pieces;
            let pieces = pieces.into_iter().map(|piece| piece.vertices);
            return pieces.map(|points| (shape.number, points, 0.0)).collect();
        }
        Solid::Mesh(mesh) | Solid::Convex(mesh) => {
            let hull = ConvexHull::new(&mesh.vertices);
            (hull.map_or_else(|_| mesh.vertices.clone(), |hull| hull.into_mesh().vertices), 0.0)
        }
        Solid::Primitive(pose, primitive) => {
            let (own, radius) = primitive.core(Prism::Inside);
            let placed = own.into_iter().map(|point| (pose * nalgebra::Point3::from(point)).into());
            (placed.collect(), radius)
        }
    };
    vec![(shape.number, points, radius)]
}
