//! The meshes and shapes of links, taken from donors by content: a link's plain mesh, hull, pieces, boxes and spheres
//! depend on nothing but its geometry and the settings.

use std::collections::HashMap;
use std::sync::Arc;

use rayon::prelude::*;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::Donor;
use crate::context::Context;
use crate::error::Result;
use crate::made::{Digests, MadeFile};
use crate::meshes::original::OriginalMeshes;
use crate::meshes::{Shading, WrittenMesh, files_of, read_glb};
use crate::shapes::{ConvexMeshes, Shape};
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::Root;
use urdd_directory::writer::sha256;
use urdd_format::convex_decomposition_meshes::ConvexDecompositionMeshesModule;
use urdd_format::convex_hull_meshes::ConvexHullMeshesModule;
use urdd_format::link_shapes_approximations::LinkShapesApproximationsModule;
use urdd_format::meshes::{GeometryKind, MeshFiles};
use urdd_format::original_meshes::OriginalMeshesModule;
use urdd_format::plain_meshes::PlainMeshesModule;
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata;
use urdd_format::urdf::{Geometry, Material, UrdfModule};
use urdd_source::origin::has_quaternions;

/// A mesh of a link, and its files if a donor has them.
pub(crate) struct LinkMesh {
    pub mesh: WrittenMesh,
    pub files: Option<DonorFiles>,
}

impl LinkMesh {
    /// Its files under these names: those of the donor, or new ones.
    pub fn files(&self, names: &MeshFiles, shading: Shading) -> Result<Vec<MadeFile>> {
        match &self.files {
            Some(files) => Ok(files.named(names)),
            None => files_of(&[self.mesh.part()], names, shading),
        }
    }
}

pub(crate) struct DonorFiles {
    stl: Option<Arc<Vec<u8>>>,
    obj: Option<Arc<Vec<u8>>>,
    glb: Arc<Vec<u8>>,
}

impl DonorFiles {
    fn named(&self, names: &MeshFiles) -> Vec<MadeFile> {
        let stl = names.stl.as_ref().zip(self.stl.as_ref());
        let obj = names.obj.as_ref().zip(self.obj.as_ref());
        let all = stl.into_iter().chain(obj).chain([(&names.glb, &self.glb)]);
        let made =
            all.map(|(path, bytes)| MadeFile { path: path.clone(), bytes: Arc::clone(bytes) });
        made.collect()
    }
}

struct Files {
    root: Root,
    digests: HashMap<String, root_metadata::Sha256>,
}

/// A mesh or the meshes of a link, and the number of the donor that has them.
type Place<T> = (usize, T);

/// The meshes and shapes of all donors. Of equal ones, those of the first donor count.
#[derive(Default)]
pub(crate) struct DonorLinks {
    donors: Vec<Files>,
    /// By the key of a link's geometry.
    plain: HashMap<String, Place<(GeometryKind, MeshFiles)>>,
    /// By the SHA-256 of a plain mesh's .glb.
    hulls: HashMap<String, Place<Vec<MeshFiles>>>,
    pieces: HashMap<String, Place<Vec<MeshFiles>>>,
    /// By the SHA-256 of the .glb of a hull or piece.
    shapes: HashMap<String, Shape>,
}

impl DonorLinks {
    /// Collects the meshes and shapes of URDDs; ignores what cannot be read. `text` returns the input of a module besides
    /// other modules.
    pub fn of(roots: &[Root], text: &dyn Fn(ModuleKind) -> Option<String>) -> Self {
        let mut all = DonorLinks::default();
        for root in roots {
            all.add(root, text);
        }
        all
    }

    fn add(&mut self, root: &Root, text: &dyn Fn(ModuleKind) -> Option<String>) -> Option<()> {
        let donor = Donor::open(root.clone())?;
        let plain: PlainMeshesModule = donor.same_document(ModuleKind::PlainMeshes, text)?;
        let robot: UrdfModule = donor.current_document(ModuleKind::Urdf)?;
        let original: OriginalMeshesModule = donor.current_document(ModuleKind::OriginalMeshes)?;
        let hulls: Option<ConvexHullMeshesModule> =
            donor.same_document(ModuleKind::ConvexHullMeshes, text);
        let pieces: Option<ConvexDecompositionMeshesModule> =
            donor.same_document(ModuleKind::ConvexDecompositionMeshes, text);
        let shapes: Option<LinkShapesApproximationsModule> =
            donor.same_document(ModuleKind::LinkShapesApproximations, text);
        let hulls = hulls.map_or_else(Vec::new, |module| module.link_hulls);
        let pieces = pieces.map_or_else(Vec::new, |module| module.link_pieces);

        let listed = donor.metadata.modules.into_iter().flat_map(|module| module.files);
        let digests: HashMap<_, _> = listed.map(|file| (file.path, file.sha256)).collect();
        let digest = |path: &str| Some(digests.get(path)?.as_str().to_owned());
        let number = self.donors.len();
        let keys = link_keys(&robot, &original, &digest);
        for (link, (key, mesh)) in keys.into_iter().zip(plain.link_meshes).enumerate() {
            let Some(mesh) = mesh else { continue };
            if let Some(of) = digest(&mesh.files.glb) {
                if let Some(Some(hull)) = hulls.get(link) {
                    self.hulls.entry(of.clone()).or_insert((number, vec![hull.clone()]));
                }
                if let Some(pieces) = pieces.get(link) {
                    self.pieces.entry(of).or_insert((number, pieces.clone()));
                }
            }
            if let Some(key) = key {
                self.plain.entry(key).or_insert((number, (mesh.geometry, mesh.files)));
            }
        }
        if let Some(found) = shapes {
            let hulls = hulls.iter().map(Option::as_ref);
            let pieces = pieces.iter().flatten().map(Some);
            let obbs = found.decomposition_obbs.into_iter().flatten().map(Some);
            let spheres = found.decomposition_bounding_spheres.into_iter().flatten();
            let of_hulls = hulls.zip(found.full_obbs.into_iter().zip(found.full_bounding_spheres));
            let of_pieces = pieces.zip(obbs.zip(spheres.map(Some)));
            for (files, (obb, sphere)) in of_hulls.chain(of_pieces) {
                let of = files.and_then(|files| digest(&files.glb));
                if let (Some(of), Some(obb), Some(sphere)) = (of, obb, sphere) {
                    self.shapes.entry(of).or_insert((obb, sphere));
                }
            }
        }
        self.donors.push(Files { root: donor.root, digests });
        Some(())
    }

    /// The plain mesh of each link, if a donor has it. Empty without donors.
    pub fn plain(
        &self,
        context: &Context,
        original: Option<&OriginalMeshes>,
        digests: &Digests,
    ) -> Vec<Option<(GeometryKind, LinkMesh)>> {
        let Some(original) = original.filter(|_| !self.donors.is_empty()) else {
            return Vec::new();
        };
        let digest = |path: &str| digests.get(path).cloned();
        let keys = link_keys(&context.source.reading.robot, &original.module, &digest);
        let taken = keys.into_par_iter().enumerate().map(|(link, key)| {
            let (donor, (geometry, files)) = self.plain.get(&key?)?;
            let wanted = context.mesh_files(ModuleKind::PlainMeshes, link, None);
            Some((*geometry, self.donors[*donor].take(files, &wanted)?))
        });
        taken.collect()
    }

    /// The hulls or the pieces of each link, if a donor has them for the same plain mesh.
    pub fn solids(
        &self,
        context: &Context,
        kind: ModuleKind,
        plain: &[Option<WrittenMesh>],
        digests: &Digests,
    ) -> Vec<Option<Vec<LinkMesh>>> {
        let known = match kind {
            ModuleKind::ConvexHullMeshes => &self.hulls,
            _ => &self.pieces,
        };
        let taken = plain.par_iter().enumerate().map(|(link, plain)| {
            plain.as_ref().filter(|_| !known.is_empty())?;
            // All meshes have the same formats.
            let wanted = context.mesh_files(ModuleKind::PlainMeshes, link, None);
            let (donor, files) = known.get(digests.get(&wanted.glb)?)?;
            let donor = &self.donors[*donor];
            files.iter().map(|files| donor.take(files, &wanted)).collect()
        });
        taken.collect()
    }

    /// The boxes and spheres of all hulls, then of all pieces, where a donor has them.
    pub fn shapes(
        &self,
        context: &Context,
        solids: &ConvexMeshes,
        digests: &Digests,
    ) -> Vec<Option<Shape>> {
        let hulls = solids.hulls.iter().enumerate();
        let hulls = hulls
            .filter(|(_, hull)| hull.is_some())
            .map(|(link, _)| context.mesh_files(ModuleKind::ConvexHullMeshes, link, None));
        let pieces = solids.decomposition_shapes().into_iter().map(|piece| {
            let (link, piece) = (piece.link_idx.get(), piece.piece_idx.get());
            context.mesh_files(ModuleKind::ConvexDecompositionMeshes, link, Some(piece))
        });
        let all = hulls.chain(pieces);
        all.map(|files| self.shapes.get(digests.get(&files.glb)?).cloned()).collect()
    }
}

impl Files {
    /// A mesh with the wanted files, if all of them are unchanged.
    fn take(&self, files: &MeshFiles, wanted: &MeshFiles) -> Option<LinkMesh> {
        let beside = |there: &Option<String>, wanted: &Option<String>| match (there, wanted) {
            (_, None) => Some(None),
            (Some(path), Some(_)) => self.intact(path).map(Some),
            (None, Some(_)) => None,
        };
        let glb = self.intact(&files.glb)?;
        Some(LinkMesh {
            mesh: read_glb(&glb, &files.glb).ok()?,
            files: Some(DonorFiles {
                stl: beside(&files.stl, &wanted.stl)?,
                obj: beside(&files.obj, &wanted.obj)?,
                glb,
            }),
        })
    }

    fn intact(&self, path: &str) -> Option<Arc<Vec<u8>>> {
        let bytes = self.root.read(path, MAX_DOCUMENT_BYTES).ok()?;
        let is_same = sha256(&Sha256::digest(&bytes)) == *self.digests.get(path)?;
        is_same.then(|| Arc::new(bytes))
    }
}

/// For each link, a key that is equal for equal plain meshes: the contents of its elements, with the content of mesh
/// files instead of their names. `digest` returns the SHA-256 of a file of the URDD. `None` if a file is unknown.
fn link_keys(
    robot: &UrdfModule,
    original: &OriginalMeshesModule,
    digest: &dyn Fn(&str) -> Option<String>,
) -> Vec<Option<String>> {
    let mut contents: HashMap<&str, Option<String>> = HashMap::new();
    for file in &original.files {
        let of = |path: &String| Some(format!("{} {}\n", extension(path), digest(path)?));
        let mut parts: Vec<Option<String>> = file.side_files.iter().map(of).collect();
        parts.push(Some(format!("{}\n", file.usable)));
        parts.push(of(&file.path));
        contents.insert(&file.path, parts.into_iter().collect());
    }
    let mut meshes: HashMap<(usize, String), Option<String>> = HashMap::new();
    for of in &original.references {
        let content = match &of.path {
            None => Some("none".to_owned()),
            Some(path) => contents.get(path.as_str()).cloned().flatten(),
        };
        meshes.insert((of.link_idx.get(), of.filename.clone()), content);
    }
    let quaternions = has_quaternions(robot.version.as_deref());
    let links = robot.links.iter().enumerate().map(|(idx, link)| {
        let geometry = |geometry: &Option<Geometry>| match geometry {
            Some(Geometry::Mesh(mesh)) => {
                let content = meshes.get(&(idx, mesh.filename.clone()))?.clone()?;
                Some(json!({ "content": content, "scale": mesh.scale }))
            }
            other => serde_json::to_value(other).ok(),
        };
        let visual = link.visual.iter().map(|visual| {
            let color = look(visual.material.as_ref(), robot);
            Some(json!([visual.origin, geometry(&visual.geometry)?, color]))
        });
        let collision = link
            .collision
            .iter()
            .map(|collision| Some(json!([collision.origin, geometry(&collision.geometry)?])));
        let visual: Option<Vec<Value>> = visual.collect();
        let collision: Option<Vec<Value>> = collision.collect();
        Some(json!([quaternions, visual?, collision?]).to_string())
    });
    links.collect()
}

/// The colours of all materials that an element may refer to: those of the same name, and its own.
fn look(material: Option<&Material>, robot: &UrdfModule) -> Value {
    let Some(material) = material else { return Value::Null };
    let named = robot.materials.iter().filter(|of| of.name.is_some() && of.name == material.name);
    let colors: Vec<_> = named.map(|of| &of.color).collect();
    json!([material.color, colors])
}

fn extension(path: &str) -> String {
    path.rsplit_once('.').map(|(_, ending)| ending).unwrap_or_default().to_ascii_lowercase()
}
