//! Sphere approximations of links, and the pairs of links that a planner ignores with them.
//!
//! They are those of the URDD (`kept`), or new ones: fitted so that they give the same collision results as the exact
//! shapes, or covering each link completely. `measure` evaluates the written spheres and pairs in configurations that were
//! not used for the fit. The counts are written with them.

pub(super) mod curobo;
pub(super) mod foam;
pub(super) mod import;
mod kept;
mod measure;
mod moving;
mod pairs;
mod said;

use crate::{Choices, ExportError, Shapes, Subject};
use measure::{Measured, measure};
use moving::Moving;
use urdd_robot::ShapeKind;
use urdd_spheres::cover;
use urdd_spheres::fit::Limits;
use urdd_spheres::fitted::{Numbers, auto_limits, fitted, surfaces};
use urdd_spheres::frame::Point;
pub use urdd_spheres::judge::SphereRates;
use urdd_spheres::model::{Sphere, Spheres};
use urdd_spheres::samples::Pairs;

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
    /// The level of `link_shapes_spheres_module` that the spheres are; `None` where they were made now.
    level: Option<kept::Level>,
}

impl Model {
    fn new(subject: &Subject) -> Result<Self, ExportError> {
        let options = &subject.options.chosen;
        let kind = match options.shapes {
            Shapes::Kind(kind @ (ShapeKind::Pieces | ShapeKind::Hulls)) => kind,
            other => return Err(ExportError::SpheresOf(other)),
        };
        let pairs = pairs::of(subject.robot, &subject.links, kind, options.reasons.as_deref())?;
        let limits = limits(options, pairs.links.len());
        let per_link = limits.total / pairs.links.len().max(1);
        let surface = surfaces(&pairs, per_link);
        let numbers = Numbers::new(options.samples, &pairs, per_link);
        let mut ignored = vec![false; pairs.checked.len()];
        let level = kept::level(subject.robot, options)?;
        let (spheres, near) = if let Some(level) = &level {
            level.mark_ignored(&pairs, &mut ignored);
            (level.spheres(&pairs.links), false)
        } else if options.cover {
            (covering(options, &pairs), false)
        } else {
            fitted(&Moving(subject.robot), &pairs, &surface, &numbers, &mut ignored, limits)?
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
