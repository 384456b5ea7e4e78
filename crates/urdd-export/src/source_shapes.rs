//! The collision elements of the source as an export writes them, and what it says of them.

use nalgebra::{Point3, Vector3};

use crate::{Format, Note, Shape, ShapeCounts, Shapes, Solid};
use urdd_document::usable_geometry::UsableGeometry;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::urdf::{Geometry, UrdfModule};
use urdd_geometry::Mesh;
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

/// The collision geometry of the source.
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
