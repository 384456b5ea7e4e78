//! Shapes that only an export has: the collision elements of the source, and primitives in the place of convex meshes, where
//! that costs little.

use std::fmt;
use std::str::FromStr;

use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use thiserror::Error;

use crate::{Format, Note, Shape, ShapeCounts, Shapes, Solid};
use urdd_document::usable_geometry::UsableGeometry;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::urdf::{Geometry, UrdfModule};
use urdd_geometry::Mesh;
use urdd_geometry::enclosing::Enclosing;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::primitives::Primitive;
use urdd_robot::{Robot, RobotError, ShapeKind, SourceShape};

/// How much of its hull's volume a mesh may lack, or have twice, and still count as convex.
const CONVEX: f64 = 1e-3;

const LOST: &str =
    "collision elements that are left out: a size is 0, or the URDD has no mesh for them";
const BARE: &str =
    "no collision geometry in the source; the shapes here are made of the visual geometry";
const HULLS: &str = "meshes that are not convex or not closed, which are written as they are: in contact, this format's programs take their convex hulls";
const DRAKES: &str = "meshes that are not convex or not closed, which are written as they are: in contact, Drake takes their convex hulls, and pairs are judged by these";
const AS_THEY_ARE: &str = "meshes that are not convex or not closed, which are written as they are";

pub(super) struct SourceShapes {
    /// In link order.
    pub by_link: Vec<Vec<Shape>>,
    pub notes: Vec<Note>,
}

impl SourceShapes {
    pub fn new(robot: &Robot, urdf: &UrdfModule, format: Format) -> Result<Self, RobotError> {
        let found = robot.source_elements(GeometryKind::Collision)?;
        let mut by_link: Vec<Vec<Shape>> = urdf.links.iter().map(|_| Vec::new()).collect();
        let mut lost = found.lost;
        for of in found.usable {
            let solid = match of.shape {
                SourceShape::Primitive(pose, primitive) => Some(Solid::Primitive(pose, primitive)),
                SourceShape::Mesh(parts) => solid_of(parts.iter().map(|part| &part.mesh)),
            };
            let element = urdf.links.get(of.link).and_then(|link| link.collision.get(of.element));
            let name = element.and_then(|element| element.name.clone());
            match (by_link.get_mut(of.link), solid) {
                (Some(shapes), Some(solid)) => {
                    shapes.push(Shape { number: of.element, name, solid });
                }
                _ => lost.push(of.link),
            }
        }
        if has_capsules(format) {
            by_link.iter_mut().for_each(join_capsules);
        }
        lost.sort_unstable();
        lost.dedup();
        let mut bare = Vec::new();
        if by_link.iter().any(Vec::is_empty) {
            let pieces = match robot.shapes(ShapeKind::Pieces) {
                Err(RobotError::Missing(_)) => Vec::new(),
                pieces => pieces?,
            };
            let is_bare: Vec<bool> = by_link.iter().map(Vec::is_empty).collect();
            for piece in pieces.into_iter().filter(|piece| is_bare.get(piece.link) == Some(&true)) {
                bare.push(piece.link);
                by_link[piece.link].push(piece.into());
            }
            bare.dedup();
        }
        let is_open =
            |shapes: &Vec<Shape>| shapes.iter().any(|shape| matches!(shape.solid, Solid::Mesh(_)));
        let open = (0..by_link.len()).filter(|link| is_open(&by_link[*link])).collect();
        let counts = ShapeCounts::of(by_link.iter().flatten().map(|shape| &shape.solid));
        let mut notes = vec![Note::SourceShapes(counts)];
        let taken = match format {
            Format::Sdf | Format::Drake => DRAKES,
            _ if takes_hulls(format) => HULLS,
            _ => AS_THEY_ARE,
        };
        for (links, what) in [(lost, LOST), (bare, BARE), (open, taken)] {
            notes.extend(Note::of_links(links, &urdf.links, what));
        }
        Ok(SourceShapes { by_link, notes })
    }
}

/// Notes on what the URDD's own shapes are made of, where that is not the collision geometry of the source.
pub(super) fn notes(
    robot: &Robot,
    urdf: &UrdfModule,
    shapes: Shapes,
    format: Format,
) -> Result<Vec<Note>, RobotError> {
    let part = robot.part_as_it_is(&[
        ModuleKind::Urdf,
        ModuleKind::PlainMeshes,
        ModuleKind::OriginalMeshes,
    ])?;
    let (Some(view), Some(ModuleDocument::PlainMeshes(plain))) =
        (part.robot(), part.document(ModuleKind::PlainMeshes))
    else {
        return Ok(Vec::new());
    };
    let usable = UsableGeometry::new(&part);
    let (mut bare, mut elements, mut is_visual) = (Vec::new(), Vec::new(), false);
    for (link, (of, mesh)) in view.links.iter().zip(&plain.link_meshes).enumerate() {
        let Some(mesh) = mesh else { continue };
        let own = of.collision.iter().enumerate();
        let own =
            own.filter(|(element, _)| usable.is_usable(link, GeometryKind::Collision, *element));
        let own: Vec<&Geometry> =
            own.filter_map(|(_, element)| element.geometry.as_ref()).collect();
        let of_visual = mesh.geometry == GeometryKind::Visual;
        if own.is_empty() {
            bare.push(link);
        } else if of_visual || own.iter().any(|of| !matches!(of, Geometry::Mesh(_))) {
            is_visual |= of_visual;
            elements.extend(own);
        }
    }
    let mut notes: Vec<Note> = Note::of_links(bare, &urdf.links, BARE).into_iter().collect();
    if !elements.is_empty() && !format.has_spheres() {
        let elements = ShapeCounts::of_elements(elements.into_iter());
        notes.push(Note::NotOfSource { elements, shapes, is_visual });
    }
    Ok(notes)
}

/// Whether a program of the format collides with the convex hull of a mesh.
pub(super) fn takes_hulls(format: Format) -> bool {
    matches!(format, Format::Mjcf | Format::Drake | Format::Usd | Format::Sdf)
}

/// Whether every program of the format knows capsules.
pub(super) fn has_capsules(format: Format) -> bool {
    takes_hulls(format)
}

/// The mesh of a collision element; `None` if its triangles vanish in binary32.
fn solid_of<'m>(meshes: impl Iterator<Item = &'m Mesh>) -> Option<Solid> {
    let mut mesh = Mesh::default();
    meshes.for_each(|part| mesh.append(part));
    mesh.weld();
    mesh.drop_degenerate();
    mesh.drop_unused_vertices();
    if mesh.triangles.is_empty() {
        return None;
    }
    let hull = ConvexHull::new(&mesh.vertices).map(|hull| hull.mesh().signed_volume());
    let is_convex =
        hull.is_ok_and(|volume| (volume - mesh.signed_volume()).abs() <= CONVEX * volume);
    Some(if is_convex { Solid::Convex(mesh) } else { Solid::Mesh(mesh) })
}

/// How far a sphere may be from where it belongs, and its radius from that of the cylinder, in radii: what printing and
/// reading a URDF leaves.
const NEAR: f64 = 1e-6;

/// How far a sphere may be from its cylinder in the list of elements: a link may have many thousands.
const NEARBY: usize = 100;

/// Makes one capsule of each cylinder with a sphere of its radius on both ends, in any order.
fn join_capsules(shapes: &mut Vec<Shape>) {
    let mut taken = vec![false; shapes.len()];
    for place in 0..shapes.len() {
        if let Some((ends, capsule)) = capsule(shapes, &taken, place) {
            ends.iter().for_each(|end| taken[*end] = true);
            shapes[place].solid = capsule;
        }
    }
    let mut taken = taken.into_iter();
    shapes.retain(|_| taken.next() != Some(true));
}

/// The places of the two spheres, and the capsule.
fn capsule(shapes: &[Shape], taken: &[bool], place: usize) -> Option<([usize; 2], Solid)> {
    let Solid::Primitive(pose, Primitive::Cylinder { radius, half }) = shapes[place].solid else {
        return None;
    };
    let near = place.saturating_sub(NEARBY)..shapes.len().min(place + NEARBY);
    let find = |z: f64| {
        let end = pose * Point3::from(Vector3::z() * z);
        near.clone().find(|other| match shapes[*other].solid {
            Solid::Primitive(at, Primitive::Sphere { radius: own }) if !taken[*other] => {
                let away = (at.translation.vector - end.coords).norm();
                away.max((own - radius).abs()) <= NEAR * radius
            }
            _ => false,
        })
    };
    let ends = [find(half)?, find(-half)?];
    let joined = Solid::Primitive(pose, Primitive::Capsule { radius, half });
    (ends[0] != ends[1]).then_some((ends, joined))
}

/// What a primitive in the place of a convex mesh may cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Its volume, over that of the mesh.
    pub(super) volume: f64,
    /// How far it stands off the mesh, at most, m.
    pub(super) standoff: f64,
}

impl Default for Fit {
    fn default() -> Self {
        Fit { volume: 1.2, standoff: 0.005 }
    }
}

/// Words that are no [`Fit`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error(
    "a fit is a volume of 1 or more over that of the mesh and a distance in metres, such as 1.2 and 0.005"
)]
pub struct NoFit;

impl Fit {
    /// A primitive may have this multiple of the volume of the mesh, and stand off it by so many metres.
    ///
    /// # Errors
    /// If the multiple is less than 1, the distance negative, or one of them not finite.
    pub fn new(volume: f64, standoff: f64) -> Result<Self, NoFit> {
        let is_usable =
            volume.is_finite() && standoff.is_finite() && volume >= 1.0 && standoff >= 0.0;
        is_usable.then_some(Fit { volume, standoff }).ok_or(NoFit)
    }

    /// The tightest primitive around a mesh, if one is within these costs.
    fn around(&self, shape: &Shape, has_capsules: bool) -> Option<Solid> {
        let Solid::Convex(mesh) = &shape.solid else { return None };
        let hull = ConvexHull::new(&mesh.vertices).ok().filter(|hull| !hull.is_flat())?;
        let most = self.volume * hull.mesh().signed_volume();
        let is_capsule = |of: &Enclosing| matches!(of.primitive, Primitive::Capsule { .. });
        let mut all: Vec<(f64, Enclosing)> = Enclosing::around(&hull)
            .into_iter()
            .filter(|of| has_capsules || !is_capsule(of))
            .map(|of| (of.primitive.volume(), of))
            .filter(|(volume, _)| *volume <= most)
            .collect();
        all.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let is_near = |of: &Enclosing| of.standoff(&hull).is_some_and(|away| away <= self.standoff);
        let (_, found) = all.into_iter().find(|(_, of)| is_near(of))?;
        Some(Solid::Primitive(found.pose, found.primitive))
    }
}

/// `VOLUME,STANDOFF`.
impl FromStr for Fit {
    type Err = NoFit;

    fn from_str(word: &str) -> Result<Self, NoFit> {
        let (volume, standoff) = word.split_once(',').ok_or(NoFit)?;
        let number = |word: &str| word.trim().parse().map_err(|_| NoFit);
        Fit::new(number(volume)?, number(standoff)?)
    }
}

/// As it stands in a sentence.
impl fmt::Display for Fit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Fit { volume, standoff } = self;
        write!(f, "at most {volume} times its volume, and at most {standoff} m off it")
    }
}

/// Puts primitives in the place of convex meshes: how many, and a note.
pub(super) fn fit(by_link: &mut [Vec<Shape>], fit: Fit, has_capsules: bool) -> (usize, Note) {
    let is_mesh = |shape: &&mut Shape| matches!(shape.solid, Solid::Convex(_));
    let meshes: Vec<&mut Shape> = by_link.iter_mut().flatten().filter(is_mesh).collect();
    let of = meshes.len();
    let fitted = meshes.into_par_iter().filter_map(|shape| {
        shape.solid = fit.around(shape, has_capsules)?;
        Some(shape.solid.clone())
    });
    let fitted: Vec<Solid> = fitted.collect();
    let counts = ShapeCounts::of(fitted.iter());
    (fitted.len(), Note::Fitted { counts, of, costs: fit.to_string() })
}
