//! Shapes of links: convex hulls, convex pieces, and their bounding boxes and spheres; visual meshes; and the files of all
//! meshes.

use rayon::prelude::*;

use super::Robot;
use super::error::RobotError;
use super::kept::{LinkShape, Solid};
use super::robot::of_read;
use urdd_document::kept::keep;
use urdd_document::mesh_files::{Absence, MeshFiles};
use urdd_document::meshes::{self, MeshFormat, MeshPath};
use urdd_document::shapes::{Volume, approximations};
use urdd_document::urdd::Urdd;
use urdd_format::registry::{ModuleKind, Profile};
pub use urdd_format::shape_kind::ShapeKind;
use urdd_geometry::Mesh;
use urdd_geometry::read::{GltfUp, Options, Part, Scene, read_with};
use urdd_kinematics::pose::from_xyz_rpy;

impl Robot {
    /// The shapes of one kind, by link and piece. Links without geometry have none.
    ///
    /// # Errors
    /// If their module is missing or unusable, or a mesh cannot be read.
    pub fn shapes(&self, kind: ShapeKind) -> Result<Vec<LinkShape>, RobotError> {
        keep(&self.shapes[kind as usize], || self.read_shapes(kind)).cloned()
    }

    fn read_shapes(&self, kind: ShapeKind) -> Result<Vec<LinkShape>, RobotError> {
        let part = self.part(&[kind.module()])?;
        if matches!(kind, ShapeKind::Hulls | ShapeKind::Pieces) {
            let meshes = Meshes::new(&part, kind.module())?.all()?.into_iter();
            let shape = |(link, piece, mesh)| LinkShape { link, piece, solid: Solid::Mesh(mesh) };
            return Ok(meshes.map(shape).collect());
        }
        let lists = part
            .document(ModuleKind::LinkShapesApproximations)
            .and_then(approximations)
            .ok_or(RobotError::Missing(ModuleKind::LinkShapesApproximations))?;
        let list = lists.into_iter().find(|list| list.kind == kind);
        let links = list.map_or_else(Vec::new, |list| list.links);
        let one = |(link, volumes): (usize, Vec<Volume>)| {
            let shapes = volumes.into_iter().enumerate();
            shapes.map(move |(piece, volume)| LinkShape { link, piece, solid: solid(volume) })
        };
        Ok(links.into_iter().enumerate().flat_map(one).collect())
    }
}

fn solid(volume: Volume) -> Solid {
    match volume {
        Volume::Box { half_extents, offset, rpy } => {
            Solid::Box { pose: from_xyz_rpy(offset, rpy), half_extents }
        }
        Volume::Sphere { radius, offset } => Solid::Sphere { centre: offset, radius },
    }
}

struct Meshes<'a> {
    part: &'a Urdd,
    meshes: meshes::Meshes<'a>,
    /// The format to read: the first of STL, OBJ and GLB, ordered by how compactly they store vertices, that has any
    /// file. A page in one file omits whole formats.
    format: Option<MeshFormat>,
}

impl<'a> Meshes<'a> {
    pub fn new(part: &'a Urdd, kind: ModuleKind) -> Result<Self, RobotError> {
        let meshes = part.meshes(kind).ok_or(RobotError::Missing(kind))?;
        let files = MeshFiles::new(part);
        let has_files = |format: &MeshFormat| {
            let links = meshes.lists.iter().flat_map(|list| &list.links);
            let mut paths = links.flatten().flat_map(|mesh| &mesh.paths);
            paths.any(|path| {
                let own = files.own(meshes.profile, path.path);
                path.format == Some(*format) && own.is_none_or(|own| part.listing().has_file(own))
            })
        };
        let format =
            [MeshFormat::Stl, MeshFormat::Obj, MeshFormat::Glb].into_iter().find(has_files);
        Ok(Self { part, meshes, format })
    }

    /// Reads all meshes; each with its link and its piece, in their order.
    pub fn all(&self) -> Result<Vec<(usize, usize, Mesh)>, RobotError> {
        let places: Vec<(usize, usize)> = (0..self.meshes.num_links())
            .flat_map(|link| (0..self.meshes.count(link)).map(move |piece| (link, piece)))
            .collect();
        let read = |(link, piece)| Ok((link, piece, self.read(link, piece)?));
        places.into_par_iter().map(read).collect()
    }

    /// The file of a mesh in this format, or else its first one.
    fn path(
        &self,
        link: usize,
        piece: usize,
        format: Option<MeshFormat>,
    ) -> Result<&MeshPath<'_>, RobotError> {
        let lists = self.meshes.lists.iter();
        let meshes = lists.filter_map(|list| list.links.get(link)?.get(piece));
        let mut paths = meshes.flat_map(|mesh| &mesh.paths);
        let of_format = paths.clone().find(|path| path.format == format);
        of_format.or_else(|| paths.next()).ok_or(RobotError::Missing(self.meshes.kind))
    }

    fn read(&self, link: usize, piece: usize) -> Result<Mesh, RobotError> {
        let path = self.path(link, piece, self.format)?;
        let mut mesh = read(self.part, self.meshes.profile, path.path, GltfUp::Keep)?.merged();
        // STL repeats each vertex for each of its triangles.
        mesh.weld();
        match mesh.vertices.is_empty() {
            true => Err(fault(path.path, "it has no vertex".to_owned())),
            false => Ok(mesh),
        }
    }

    /// The coloured parts of each link's mesh. Prefers GLB, the only format with colours.
    fn visuals(&self) -> Result<Vec<LinkVisual>, RobotError> {
        let links = (0..self.meshes.num_links()).filter(|link| self.meshes.count(*link) > 0);
        let visual = |link: usize| {
            let path = self.path(link, 0, Some(MeshFormat::Glb))?;
            let scene = read(self.part, self.meshes.profile, path.path, GltfUp::Keep)?;
            Ok(LinkVisual { link, parts: scene.parts })
        };
        links.collect::<Vec<_>>().into_par_iter().map(visual).collect()
    }
}

/// The visual mesh of a link, in its frame, in metres.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkVisual {
    /// The link.
    pub link: usize,
    /// Triangles by colour.
    pub parts: Vec<Part>,
}

impl Robot {
    /// The plain mesh of each link that has one, with its colours but without textures. Every call reads the files.
    ///
    /// # Errors
    /// If `plain_meshes_module` is missing or unusable, or a mesh cannot be read.
    pub fn visuals(&self) -> Result<Vec<LinkVisual>, RobotError> {
        let part = self.part(&[ModuleKind::PlainMeshes])?;
        Meshes::new(&part, ModuleKind::PlainMeshes)?.visuals()
    }
}

fn fault(path: &str, reason: String) -> RobotError {
    RobotError::Mesh { path: path.to_owned(), reason }
}

/// Reads a mesh file. In the URDD's own .glb files z is up.
pub(super) fn read(
    part: &Urdd,
    profile: Profile,
    path: &str,
    gltf_up: GltfUp,
) -> Result<Scene, RobotError> {
    let fail = |reason: String| fault(path, reason);
    let bytes = MeshFiles::new(part).read(profile, path).map_err(|absence| match absence {
        Absence::Other(error) => of_read(part.root(), error, |error| fail(error.to_string())),
        absence => fail(absence.to_string()),
    })?;
    let options = Options { gltf_up, ..Options::default() };
    read_with(&bytes, path, &mut |_| None, &options).map_err(|error| {
        fail(match &error.place {
            Some(place) => format!("{place}: {}", error.fault),
            None => error.fault.to_string(),
        })
    })
}
