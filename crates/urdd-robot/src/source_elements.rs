//! The visual and collision elements of the source URDF: as it has them; what a robot looks like by them, for a URDD without
//! plain meshes; and the textured parts of their meshes.

use std::collections::{BTreeMap, HashMap};

use nalgebra::{Isometry3, Matrix4};
use rayon::prelude::*;

use super::Robot;
use super::error::RobotError;
use super::robot::usable;
use super::shapes::{LinkVisual, read};
use urdd_directory::account::{Account, AccountError};
use urdd_directory::listing::ReadError;
use urdd_directory::path::beside;
use urdd_document::mesh_files::{Absence, MeshFiles};
use urdd_document::robot::Element;
use urdd_document::urdd::Urdd;
use urdd_document::usable_geometry::UsableGeometry;
use urdd_format::colors::Colors;
use urdd_format::meshes::GeometryKind;
use urdd_format::original_meshes::MeshReference;
use urdd_format::registry::{ModuleDocument, ModuleKind, Profile};
use urdd_format::urdf::Geometry;
use urdd_geometry::mesh::placement;
use urdd_geometry::primitives::{self, Primitive};
use urdd_geometry::read::{GltfUp, Options, Part, Scene, read_with};

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
        usable(&part, ModuleKind::Urdf)?;
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
type Place = (usize, GeometryKind, usize);

/// The paths of the meshes of elements.
fn paths(part: &Urdd) -> BTreeMap<Place, &str> {
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
            let overdrawn = |error: AccountError| RobotError::Mesh {
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

/// Maximum number of triangles: elements may name one large mesh many times. Those beyond are left out.
const MAX_TRIANGLES: usize = 1_000_000;

impl Robot {
    /// The URDF's visual elements of each link in its frame, or its collision elements if it has no visual shape.
    /// Meshes are those that the URDD carries. What cannot be read is left out.
    ///
    /// # Errors
    /// If `urdf_module` is missing or unusable.
    #[doc(hidden)]
    pub fn source_visuals(&self) -> Result<Vec<LinkVisual>, RobotError> {
        let part = self.part_as_it_is(&[ModuleKind::Urdf, ModuleKind::OriginalMeshes])?;
        let urdf = self.description()?;
        let colors = Colors::of(&urdf);
        let mut carried = Carried { urdd: &part, paths: paths(&part), read: HashMap::new() };
        let mut room = MAX_TRIANGLES;
        let mut visuals = Vec::new();
        let links = part.robot().map_or(&[][..], |robot| &robot.links);
        for (link, of) in links.iter().enumerate() {
            let has_visual = of.visual.iter().any(|element| element.geometry.is_some());
            let kind = if has_visual { GeometryKind::Visual } else { GeometryKind::Collision };
            let mut parts = Vec::new();
            for (index, element) in of.elements(kind).iter().enumerate() {
                let own = urdf.links.get(link).filter(|_| has_visual);
                let material = own.and_then(|link| link.visual.get(index)?.material.as_ref());
                let mesh = carried.of((link, kind, index));
                // It is not copied to be left out.
                if triangles(mesh) > room {
                    continue;
                }
                let added = placed(element, mesh, colors.get(material));
                let Some(left) = room.checked_sub(triangles(&added)) else { continue };
                room = left;
                parts.extend(added);
            }
            visuals.push(LinkVisual { link, parts });
        }
        Ok(visuals)
    }
}

fn triangles(parts: &[Part]) -> usize {
    parts.iter().map(|part| part.mesh.triangles.len()).sum()
}

/// The parts of an element in the link's frame. `mesh` is the one that it names.
fn placed(element: &Element, mesh: &[Part], color: Option<[f64; 4]>) -> Vec<Part> {
    let mut scale = [1.0; 3];
    let mut parts: Vec<Part> = match &element.geometry {
        None => return Vec::new(),
        Some(Geometry::Box(of)) => vec![primitives::cuboid(of.size).into()],
        Some(Geometry::Cylinder(of)) => vec![primitives::cylinder(of.radius, of.length).into()],
        Some(Geometry::Capsule(of)) => vec![primitives::capsule(of.radius, of.length).into()],
        Some(Geometry::Sphere(of)) => vec![primitives::sphere(of.radius).into()],
        Some(Geometry::Mesh(of)) => {
            scale = of.scale.unwrap_or(scale);
            mesh.to_vec()
        }
    };
    let place = place_of(element, scale);
    for part in &mut parts {
        part.mesh.transform(&place);
        part.color = part.color.or(color);
    }
    parts
}

/// The matrix that puts a scaled shape into its link's frame.
fn place_of(element: &Element, scale: [f64; 3]) -> Matrix4<f64> {
    let rotation = element.origin.rotation();
    let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| rotation[(row, column)]));
    placement(scale, rows, element.origin.xyz)
}

/// The meshes that the URDF names, of those that the URDD carries. Each file is read once.
struct Carried<'a> {
    urdd: &'a Urdd,
    paths: BTreeMap<Place, &'a str>,
    read: HashMap<&'a str, Vec<Part>>,
}

impl<'a> Carried<'a> {
    /// The mesh of an element; nothing if it names none, or one that cannot be read.
    fn of(&mut self, place: Place) -> &[Part] {
        let Some(&path) = self.paths.get(&place) else { return &[] };
        self.read.entry(path).or_insert_with(|| {
            let scene = read(self.urdd, Profile::V1, path, GltfUp::Turn);
            scene.map(|scene| scene.parts).unwrap_or_default()
        })
    }
}

impl Robot {
    /// The parts with a texture of each visual element whose mesh has some, in its link's frame; [`Robot::visuals`] has the
    /// same triangles without it. The name of a texture is its path in the URDD, or that of its mesh and what is in it.
    /// Every call reads the files. Empty for a legacy URDD, and without `original_meshes_module`.
    ///
    /// # Errors
    /// If the files cannot be listed, or one changed on disk.
    pub fn textured_visuals(&self) -> Result<Vec<LinkVisual>, RobotError> {
        let kinds = [ModuleKind::OriginalMeshes, ModuleKind::Urdf];
        let part = self.part_as_it_is(&kinds)?;
        let (Some(ModuleDocument::OriginalMeshes(original)), Some(robot)) =
            (part.document(kinds[0]), part.robot())
        else {
            return Ok(Vec::new());
        };
        let visual = |reference: &MeshReference| {
            let path = reference.path.as_ref()?;
            let link = reference.link_idx.get();
            let element = robot.links.get(link)?.visual.get(reference.element_idx.get())?;
            let parts = textured_parts(&part, path).map(|parts| in_link(parts, element));
            Some(parts.transpose()?.map(|parts| LinkVisual { link, parts }))
        };
        let references = original.references.par_iter();
        let references = references.filter(|of| of.geometry == GeometryKind::Visual);
        let is_textured = |visual: &Result<LinkVisual, RobotError>| {
            visual.as_ref().map_or(true, |visual| !visual.parts.is_empty())
        };
        references.filter_map(visual).filter(is_textured).collect()
    }

    /// The bytes of a file of the URDD, if it lists it.
    ///
    /// # Errors
    /// If the files cannot be listed, or this one changed on disk.
    pub fn listed_file(&self, path: &str) -> Result<Option<Vec<u8>>, RobotError> {
        bytes(&self.part_as_it_is(&[])?, path)
    }
}

fn bytes(part: &Urdd, path: &str) -> Result<Option<Vec<u8>>, RobotError> {
    if !part.listing().has_file(path) {
        return Ok(None);
    }
    match MeshFiles::new(part).read(Profile::V1, path) {
        Err(Absence::Other(ReadError::Changed)) => {
            Err(RobotError::Changed(part.root().folder_name()))
        }
        read => Ok(read.ok()),
    }
}

/// The parts of a mesh that have a texture.
fn textured_parts(part: &Urdd, mesh: &str) -> Result<Vec<Part>, RobotError> {
    let content = bytes(part, mesh)?.unwrap_or_default();
    // Without what names a library or an image, there is none: OBJ, COLLADA, glTF.
    let names: [&[u8]; 3] = [b"mtllib", b"init_from", b"\"images\""];
    if !names.iter().any(|name| content.windows(name.len()).any(|bytes| bytes == *name)) {
        return Ok(Vec::new());
    }
    let mut changed = None;
    let mut fetch = |named: &str| {
        let read = bytes(part, &beside(mesh, named)?);
        read.unwrap_or_else(|error| {
            changed = Some(error);
            None
        })
    };
    let options = Options { textures: true, ..Options::default() };
    let scene = read_with(&content, mesh, &mut fetch, &options);
    if let Some(error) = changed {
        return Err(error);
    }
    let mut parts = scene.map_or_else(|_| Vec::new(), |scene| scene.parts);
    parts.retain(|part| part.texture.is_some());
    for texture in parts.iter_mut().filter_map(|part| part.texture.as_mut()) {
        texture.name = match beside(mesh, &texture.name) {
            Some(path) if texture.embedded.is_none() => path,
            _ => format!("{mesh}: {}", texture.name),
        };
    }
    Ok(parts)
}

/// Puts the parts of an element's mesh into its link's frame, with coordinates of binary32.
fn in_link(mut parts: Vec<Part>, element: &Element) -> Option<Vec<Part>> {
    let Some(Geometry::Mesh(mesh)) = &element.geometry else { return None };
    let place = place_of(element, mesh.scale.unwrap_or([1.0; 3]));
    for part in &mut parts {
        part.mesh.transform(&place);
        let coordinates = part.mesh.vertices.as_flattened_mut();
        coordinates.iter_mut().for_each(|of| *of = f64::from(*of as f32));
    }
    Some(parts)
}
