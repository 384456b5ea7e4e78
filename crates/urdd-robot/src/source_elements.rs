//! The visual and collision elements of the source URDF, as it has them.

use std::collections::BTreeMap;

use nalgebra::Isometry3;
use rayon::prelude::*;

use super::Robot;
use super::error::RobotError;
use super::textured::{bytes, in_link};
use urdd_directory::account::{Account, Overdrawn};
use urdd_directory::path::beside;
use urdd_document::robot::Element;
use urdd_document::urdd::Urdd;
use urdd_document::usable_geometry::UsableGeometry;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::urdf::Geometry;
use urdd_geometry::primitives::Primitive;
use urdd_geometry::read::{Options, Part, Scene, read_with};

/// An element of the source URDF that has a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct SourceElement {
    /// The link.
    pub link: usize,
    /// Its index among the link's elements of its kind.
    pub element: usize,
    /// Its shape.
    pub shape: SourceShape,
}

/// A shape as the source has it, in its link's frame.
#[derive(Debug, Clone, PartialEq)]
pub enum SourceShape {
    /// A box, a cylinder, a capsule or a sphere, and its pose.
    Primitive(Isometry3<f64>, Primitive),
    /// The triangles of a mesh by colour, placed and scaled.
    Mesh(Vec<Part>),
}

/// The elements of one kind.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SourceElements {
    /// Those with a surface, by link and element.
    pub usable: Vec<SourceElement>,
    /// The link of each other one: a size is 0, or the URDD has no mesh for it.
    pub lost: Vec<usize>,
}

/// Bytes of a triangle and its corners, in memory and in what is made of it.
const TRIANGLE: usize = 400;

impl Robot {
    /// The elements of a kind as the source URDF has them. Every call reads their meshes.
    ///
    /// # Errors
    /// If `urdf_module` is missing or unusable, a mesh changed on disk or cannot be read, or more would be made of small
    /// files than an [`Account`] allows.
    pub fn source_elements(&self, kind: GeometryKind) -> Result<SourceElements, RobotError> {
        let account = &Account::default();
        let modules = [ModuleKind::Urdf, ModuleKind::OriginalMeshes];
        let part = self.part_as_it_is(&modules)?;
        super::robot::usable(&part, ModuleKind::Urdf)?;
        let robot = part.robot().ok_or(RobotError::Missing(ModuleKind::Urdf))?;
        let paths = paths(&part);
        let of_kind = paths.iter().filter(|((_, of, _), _)| *of == kind);
        let scenes = scenes(&part, of_kind.map(|(_, path)| *path).collect(), account)?;
        let usable = UsableGeometry::new(&part);
        let mut found = SourceElements::default();
        for (link, of) in robot.links.iter().enumerate() {
            for (element, of) in of.elements(kind).iter().enumerate() {
                let path = paths.get(&(link, kind, element));
                let mesh = path.and_then(|path| Some((*path, scenes.get(path)?)));
                let shape = match usable.is_usable(link, kind, element) {
                    true => shape(of, mesh, account)?,
                    false => None,
                };
                match shape {
                    Some(shape) => found.usable.push(SourceElement { link, element, shape }),
                    None => found.lost.push(link),
                }
            }
        }
        Ok(found)
    }
}

/// A visual or collision element: its link, its kind, its place in the link.
pub(super) type Place = (usize, GeometryKind, usize);

/// The paths of the meshes of elements.
pub(super) fn paths(part: &Urdd) -> BTreeMap<Place, &str> {
    let Some(ModuleDocument::OriginalMeshes(module)) = part.document(ModuleKind::OriginalMeshes)
    else {
        return BTreeMap::new();
    };
    let mut paths = BTreeMap::new();
    for of in &module.references {
        let place = (of.link_idx.get(), of.geometry, of.element_idx.get());
        paths.extend(of.path.as_deref().map(|path| (place, path)));
    }
    paths
}

/// What is in these files, each read once.
fn scenes<'p>(
    part: &Urdd,
    mut paths: Vec<&'p str>,
    account: &Account,
) -> Result<BTreeMap<&'p str, Scene>, RobotError> {
    paths.sort_unstable();
    paths.dedup();
    let read = |path: &'p str| {
        let content = bytes(part, path)?.unwrap_or_default();
        account.deposit(content.len());
        // Of its materials the colours count.
        let mut fetch = |named: &str| bytes(part, &beside(path, named)?).ok().flatten();
        let scene = read_with(&content, path, &mut fetch, &Options::default());
        Ok(scene.ok().map(|scene| (path, scene)))
    };
    paths.into_par_iter().filter_map(|path| read(path).transpose()).collect()
}

/// The shape of a usable element; `None` if its mesh is not in the URDD.
fn shape(
    of: &Element,
    mesh: Option<(&str, &Scene)>,
    account: &Account,
) -> Result<Option<SourceShape>, RobotError> {
    let primitive = match &of.geometry {
        None => return Ok(None),
        Some(Geometry::Mesh(_)) => {
            let Some((path, scene)) = mesh else { return Ok(None) };
            let overdrawn = |error: Overdrawn| RobotError::Mesh {
                path: path.to_owned(),
                reason: error.to_string(),
            };
            account.charge(scene.triangle_count() * TRIANGLE).map_err(overdrawn)?;
            return Ok(in_link(scene.parts.clone(), of).map(SourceShape::Mesh));
        }
        Some(Geometry::Box(of)) => Primitive::Box(of.size.map(|side| side / 2.0)),
        Some(Geometry::Cylinder(of)) => {
            Primitive::Cylinder { radius: of.radius, half: of.length / 2.0 }
        }
        Some(Geometry::Capsule(of)) if of.length == 0.0 => Primitive::Sphere { radius: of.radius },
        Some(Geometry::Capsule(of)) => {
            Primitive::Capsule { radius: of.radius, half: of.length / 2.0 }
        }
        Some(Geometry::Sphere(of)) => Primitive::Sphere { radius: of.radius },
    };
    Ok(Some(SourceShape::Primitive(of.origin.motion(), primitive)))
}
