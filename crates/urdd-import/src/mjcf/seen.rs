//! Which shapes are seen: those that MuJoCo's viewer shows from the start.

use std::collections::HashSet;
use std::ops::RangeInclusive;

use nalgebra::Point3;
use urdd_geometry::mesh::Bounds;

use super::super::fault::ImportFault;
use super::super::model::Geometry;
use super::super::refusal::Fallible;
use super::assets::Assets;
use super::body::{Bodies, WORLD};
use super::contact::Contacts;
use super::fit::Fitted;
use super::geom::Geom;
use super::mesh::Meshes;
use super::scene::Robot;

/// The groups that the viewer shows.
const SHOWN: RangeInclusive<i64> = 0..=2;
/// How far a shape may stand out of those that cover it, as a part of the longest edge of the box around them. Of 634 shapes
/// of robosuite and its models that collide in a group of their own, 619 stand out by less.
const MARGIN: f64 = 0.25;

/// What is seen of a robot.
pub struct Seen {
    /// Whether hidden groups are seen too: without them, nothing of the robot would be.
    shows_all: bool,
    /// The groups that are shown and have shapes that do not collide.
    looks: HashSet<i64>,
}

/// A shape of a body, with its size, and whether it does not collide.
pub type Part<'p, 'd> = (&'p Geom<'d>, &'p Fitted, bool);

impl Seen {
    /// What is seen of a robot.
    pub fn of(bodies: &Bodies<'_>, robot: &Robot, contacts: &Contacts) -> Self {
        let own = robot.bodies.iter().filter(|body| **body != WORLD || robot.has_world);
        let geoms = own.flat_map(|body| {
            let each = bodies.all[*body].geoms.iter().enumerate();
            each.map(move |(place, geom)| (geom.group, contacts.is_visual(geom, *body, place)))
        });
        let shown: Vec<(i64, bool)> = geoms.filter(|(group, _)| SHOWN.contains(group)).collect();
        let looks = shown.iter().filter(|(_, is_visual)| *is_visual).map(|(group, _)| *group);
        Seen { shows_all: shown.is_empty(), looks: looks.collect() }
    }

    /// Whether each shape of a body is seen. One that collides is not, where others are its look: the robot keeps those that
    /// collide in a group of their own, and the box around those that do not holds it.
    pub fn of_body(
        &self,
        parts: &[Part<'_, '_>],
        meshes: &mut Meshes<'_>,
        assets: &Assets<'_>,
    ) -> Fallible<Vec<bool>> {
        let is_shown = |geom: &Geom<'_>| self.shows_all || SHOWN.contains(&geom.group);
        let may_be_covered = |(geom, _, is_visual): &Part<'_, '_>| {
            is_shown(geom) && !is_visual && !self.looks.contains(&geom.group)
        };
        let mut corners: Vec<[f64; 3]> = Vec::new();
        if parts.iter().any(may_be_covered) {
            let others = parts.iter().filter(|(geom, _, is_visual)| *is_visual && is_shown(geom));
            for (geom, fitted, _) in others {
                let own = bounds(geom, fitted, meshes, assets)?;
                corners.extend(own.into_iter().flat_map(|own| [own.min, own.max]));
            }
        }
        let look = (!corners.is_empty()).then(|| Bounds::of(corners));
        let mut seen = Vec::with_capacity(parts.len());
        for part @ (geom, fitted, _) in parts {
            seen.push(match look.as_ref().filter(|_| may_be_covered(part)) {
                Some(look) => {
                    let own = bounds(geom, fitted, meshes, assets)?;
                    !own.is_some_and(|own| is_inside(&own, look))
                }
                None => is_shown(geom),
            });
        }
        Ok(seen)
    }
}

fn is_inside(own: &Bounds, look: &Bounds) -> bool {
    let margin = MARGIN * look.size().into_iter().fold(0.0, f64::max);
    (0..3).all(|axis| {
        own.min[axis] >= look.min[axis] - margin && own.max[axis] <= look.max[axis] + margin
    })
}

/// The box around a shape, in the frame of its body; none of a surface without an end, and of what cannot be read.
fn bounds(
    geom: &Geom<'_>,
    fitted: &Fitted,
    meshes: &mut Meshes<'_>,
    assets: &Assets<'_>,
) -> Fallible<Option<Bounds>> {
    let moved = |point: [f64; 3]| (fitted.pose * Point3::from(point)).coords.into();
    let half = match geom.kind.solid(fitted.size) {
        Some(Geometry::Sphere(radius)) => [radius; 3],
        Some(Geometry::Cylinder { radius, length }) => [radius, radius, length / 2.0],
        Some(Geometry::Capsule { radius, length }) => [radius, radius, length / 2.0 + radius],
        Some(Geometry::Ellipsoid(radii)) => radii,
        Some(Geometry::Box(edges)) => edges.map(|edge| edge / 2.0),
        Some(Geometry::Mesh { .. }) | None => {
            let Some(mesh) = geom.mesh else { return Ok(None) };
            return match meshes.placed(mesh, geom.place, assets) {
                Ok(mesh) => Ok(Some(Bounds::of(mesh.vertices.into_iter().map(moved)))),
                Err(why) if matches!(why.fault, ImportFault::TooMuch(_)) => Err(why),
                Err(_) => Ok(None),
            };
        }
    };
    let corner = |bits: usize| [0, 1, 2].map(|axis| half[axis] * [-1.0, 1.0][(bits >> axis) & 1]);
    Ok(Some(Bounds::of((0..8).map(|bits| moved(corner(bits))))))
}
