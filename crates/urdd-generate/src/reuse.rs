//! Reuses results from other URDDs. The mesh, hull, pieces, boxes and spheres of a link depend only on its geometry.
//! They are reused from a URDD that this version of the program generated with the same settings from identical bytes.
//!
//! A module of such a URDD is used if its `x_urdd_inputs` is what this program would write. A file is used if its bytes
//! match `urdd.json`.

use std::collections::HashMap;
use std::sync::Arc;

use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::made::{Content, MadeFile};
use super::meshes::written::{WrittenMesh, take_up_bytes};
use super::metadata::{self, Entry, INPUTS_KEY};
use super::old;
use super::pose::has_quaternions;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::json;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::Root;
use urdd_directory::writer::sha256;
use urdd_format::convex_decomposition_meshes::ConvexDecompositionMeshesModule;
use urdd_format::convex_hull_meshes::ConvexHullMeshesModule;
use urdd_format::link_shapes_approximations::{
    BoundingSphere, LinkShapesApproximationsModule, Obb,
};
use urdd_format::meshes::MeshFiles;
use urdd_format::original_meshes::OriginalMeshesModule;
use urdd_format::plain_meshes::{PlainMesh, PlainMeshesModule};
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::{FileEntry, RootMetadata};
use urdd_format::urdf::{Geometry, Material, UrdfModule};

/// The oriented bounding box and the bounding sphere of a hull or a piece.
pub(super) type Shape = (Obb, BoundingSphere);

/// The settings text of each module: what it depends on besides other modules.
pub(super) type SettingsTexts = HashMap<ModuleKind, String>;

/// A mesh of another URDD and its files.
pub(super) struct Taken {
    pub mesh: WrittenMesh,
    pub files: TakenFiles,
}

/// The bytes of the files of a mesh.
pub(super) struct TakenFiles {
    stl: Option<Arc<Vec<u8>>>,
    obj: Option<Arc<Vec<u8>>>,
    glb: Arc<Vec<u8>>,
}

impl TakenFiles {
    /// The files under these names.
    pub fn named(&self, names: &MeshFiles) -> Vec<MadeFile> {
        let stl = names.stl.as_ref().zip(self.stl.as_ref());
        let obj = names.obj.as_ref().zip(self.obj.as_ref());
        let all = stl.into_iter().chain(obj).chain([(&names.glb, &self.glb)]);
        let made = all.map(|(path, bytes)| MadeFile {
            path: path.clone(),
            content: Content::Shared(Arc::clone(bytes)),
        });
        made.collect()
    }
}

/// A URDD whose results may be reused.
struct Donor {
    root: Root,
    files: HashMap<String, FileEntry>,
}

/// All reusable results, by their input.
#[derive(Default)]
pub(super) struct Reusable {
    donors: Vec<Donor>,
    /// By the content of a link's geometry.
    plain: HashMap<String, (usize, PlainMesh)>,
    /// By the SHA-256 of a plain mesh's .glb.
    hulls: HashMap<String, (usize, MeshFiles)>,
    pieces: HashMap<String, (usize, Vec<MeshFiles>)>,
    /// By the SHA-256 of the .glb of a hull or piece.
    shapes: HashMap<String, Shape>,
}

impl Reusable {
    /// Collects the results of URDDs; ignores what cannot be read.
    pub fn of(roots: &[Root], settings: &SettingsTexts) -> Self {
        let mut all = Reusable::default();
        for root in roots {
            all.add(root, settings);
        }
        all
    }

    fn add(&mut self, root: &Root, settings: &SettingsTexts) -> Option<()> {
        let bytes = root.read(ROOT_METADATA, MAX_DOCUMENT_BYTES).ok()?;
        let value = json::read(&bytes).ok()?.value;
        let metadata: RootMetadata = serde_json::from_value(value.clone()).ok()?;
        let modules = Modules {
            root,
            inputs: inputs_of(&value),
            settings,
            entries: (metadata.modules.iter().cloned())
                .map(|module| Entry {
                    module,
                    inputs: None,
                })
                .collect(),
        };
        let listed = metadata.modules.into_iter().flat_map(|module| module.files);
        let files: HashMap<String, FileEntry> =
            listed.map(|file| (file.path.clone(), file)).collect();
        let donor = self.donors.len();
        let sha = |files_of: &MeshFiles| Some(files.get(&files_of.glb)?.sha256.as_str().to_owned());

        let plain: PlainMeshesModule = modules.same(ModuleKind::PlainMeshes)?;
        let robot: UrdfModule = modules.document(ModuleKind::Urdf)?;
        let original: OriginalMeshesModule = modules.document(ModuleKind::OriginalMeshes)?;
        let digest = |path: &str| Some(files.get(path)?.sha256.as_str().to_owned());
        let keys = link_keys(&robot, &original, &digest);
        for (key, mesh) in keys.into_iter().zip(&plain.link_meshes) {
            if let (Some(key), Some(mesh)) = (key, mesh) {
                self.plain.entry(key).or_insert((donor, mesh.clone()));
            }
        }
        let plain: Vec<Option<String>> = (plain.link_meshes.iter())
            .map(|mesh| sha(&mesh.as_ref()?.files))
            .collect();
        let hulls: Option<ConvexHullMeshesModule> = modules.same(ModuleKind::ConvexHullMeshes);
        let hulls = hulls.map(|module| module.link_hulls).unwrap_or_default();
        for (of, hull) in plain.iter().zip(&hulls) {
            if let (Some(of), Some(hull)) = (of, hull) {
                let entry = self.hulls.entry(of.clone());
                entry.or_insert((donor, hull.clone()));
            }
        }
        let pieces: Option<ConvexDecompositionMeshesModule> =
            modules.same(ModuleKind::ConvexDecompositionMeshes);
        let pieces = pieces.map(|module| module.link_pieces).unwrap_or_default();
        for (of, pieces) in plain.iter().zip(&pieces) {
            if let Some(of) = of {
                let entry = self.pieces.entry(of.clone());
                entry.or_insert((donor, pieces.clone()));
            }
        }
        let shapes: Option<LinkShapesApproximationsModule> =
            modules.same(ModuleKind::LinkShapesApproximations);
        if let Some(found) = shapes {
            let full = hulls.iter().map(|hull| sha(hull.as_ref()?));
            let full = full.zip(found.full_obbs.into_iter().zip(found.full_bounding_spheres));
            for (of, (obb, sphere)) in full {
                if let (Some(of), Some(obb), Some(sphere)) = (of, obb, sphere) {
                    self.shapes.entry(of).or_insert((obb, sphere));
                }
            }
            let of_pieces = pieces.iter().flatten().map(sha);
            let obbs = found.decomposition_obbs.into_iter().flatten();
            let spheres = found.decomposition_bounding_spheres.into_iter().flatten();
            for (of, shape) in of_pieces.zip(obbs.zip(spheres)) {
                if let Some(of) = of {
                    self.shapes.entry(of).or_insert(shape);
                }
            }
        }
        self.donors.push(Donor {
            root: root.clone(),
            files,
        });
        Some(())
    }

    /// Whether there is nothing to reuse.
    pub fn is_empty(&self) -> bool {
        self.donors.is_empty()
    }

    /// The plain mesh of a link with this geometry key, with the files in `wanted`.
    pub fn plain(&self, key: &str, wanted: &MeshFiles) -> Option<(PlainMesh, Taken)> {
        let (donor, mesh) = self.plain.get(key)?;
        let taken = self.donors.get(*donor)?.take(&mesh.files, wanted)?;
        Some((mesh.clone(), taken))
    }

    /// The hull of a plain mesh.
    pub fn hull(&self, plain: &str, wanted: &MeshFiles) -> Option<Taken> {
        let (donor, files) = self.hulls.get(plain)?;
        self.donors.get(*donor)?.take(files, wanted)
    }

    /// The pieces of a plain mesh.
    pub fn pieces(&self, plain: &str, wanted: &MeshFiles) -> Option<Vec<Taken>> {
        let (donor, files) = self.pieces.get(plain)?;
        let donor = self.donors.get(*donor)?;
        let taken = files.iter().map(|files| donor.take(files, wanted));
        taken.collect()
    }

    /// The box and the sphere of a hull or a piece.
    pub fn shape(&self, mesh: &str) -> Option<Shape> {
        self.shapes.get(mesh).cloned()
    }
}

impl Donor {
    /// A mesh with the wanted files, if all of them are unchanged.
    fn take(&self, files: &MeshFiles, wanted: &MeshFiles) -> Option<Taken> {
        let beside = |there: &Option<String>, wanted: &Option<String>| match (there, wanted) {
            (_, None) => Some(None),
            (Some(path), Some(_)) => self.intact(path).map(Some),
            (None, Some(_)) => None,
        };
        let glb = self.intact(&files.glb)?;
        Some(Taken {
            mesh: take_up_bytes(&glb, &files.glb).ok()?,
            files: TakenFiles {
                stl: beside(&files.stl, &wanted.stl)?,
                obj: beside(&files.obj, &wanted.obj)?,
                glb,
            },
        })
    }

    fn intact(&self, path: &str) -> Option<Arc<Vec<u8>>> {
        let bytes = self.root.read(path, MAX_DOCUMENT_BYTES).ok()?;
        let is_same = sha256(&Sha256::digest(&bytes)) == self.files.get(path)?.sha256;
        is_same.then(|| Arc::new(bytes))
    }
}

/// The `x_urdd_inputs` of each module, by its name.
fn inputs_of(metadata: &Value) -> HashMap<String, String> {
    let modules = metadata["modules"].as_array().into_iter().flatten();
    let inputs = modules.filter_map(|module| {
        let name = module["name"].as_str()?.to_owned();
        Some((name, module[INPUTS_KEY].as_str()?.to_owned()))
    });
    inputs.collect()
}

struct Modules<'a> {
    root: &'a Root,
    entries: Vec<Entry>,
    inputs: HashMap<String, String>,
    settings: &'a SettingsTexts,
}

impl Modules<'_> {
    /// The document of a module whose inputs are those that this program would use now.
    fn same<T: DeserializeOwned>(&self, kind: ModuleKind) -> Option<T> {
        let would_be = metadata::inputs(kind, self.settings.get(&kind)?, &self.entries);
        let is_same = self.inputs.get(kind.name()) == Some(&would_be);
        is_same.then(|| self.document(kind)).flatten()
    }

    fn document<T: DeserializeOwned>(&self, kind: ModuleKind) -> Option<T> {
        let named = |entry: &&Entry| entry.module.name == kind.name();
        let module = &self.entries.iter().find(named)?.module;
        let is_ours =
            module.version.as_str() == metadata::MODULE_VERSION && module.path == kind.folder();
        is_ours
            .then(|| old::document(self.root, kind).ok())
            .flatten()
    }
}

/// For each link, a key that is equal for equal plain meshes: the contents of its elements, with the content of mesh
/// files instead of their names. `digest` returns the SHA-256 of a file of the URDD. `None` if a file is unknown.
pub(super) fn link_keys(
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
    let Some(material) = material else {
        return Value::Null;
    };
    let named = robot
        .materials
        .iter()
        .filter(|of| of.name.is_some() && of.name == material.name);
    let colors: Vec<_> = named.map(|of| &of.color).collect();
    json!([material.color, colors])
}

fn extension(path: &str) -> String {
    let ending = path.rsplit_once('.').map(|(_, ending)| ending);
    ending.unwrap_or_default().to_ascii_lowercase()
}
