//! Meshes: files, and those that are written in the text.

use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

use nalgebra::{Isometry3, Matrix4, Translation3, UnitQuaternion, Vector3};
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::read::{Part, Scene};
use urdd_geometry::write::stl;
use urdd_source::{FoundMesh, Inspected, inspect_alone};
use urdd_source::{is_plain_mesh, lines};

use super::assets::{Assets, Folder, read_msh};
use super::compiler::quaternion;
use super::reading::{Attributes, Defaults, Element, MAIN, View, list, wrong};
use crate::fault::{MjcfFault, Unreachable};
use crate::features::{self, Tally};
use crate::mass::{Mode, measure};
use crate::model::{Geometry, Inertial};
use crate::place::{Fallible, Place, Refusal, at};

/// The meshes of a model. A file is read when a shape needs it.
pub struct Meshes<'d> {
    by_name: HashMap<String, MeshAsset<'d>>,
    /// What was read, by name, and by file.
    read: HashMap<String, Arc<Content>>,
    measured: HashMap<String, Inertial>,
}

struct MeshAsset<'d> {
    view: View<'d>,
    file: Option<&'d str>,
    origin: Vector3<f64>,
    rotation: UnitQuaternion<f64>,
    scale: [f64; 3],
    mode: Mode,
}

struct Content {
    /// What tells it from other files.
    key: String,
    /// Its path below the folder of the URDF, without its extension.
    name: String,
    extension: String,
    /// What is carried; of a file that is not a mesh, why it is not.
    bytes: Result<Arc<[u8]>, String>,
    triangles: Triangles,
}

enum Triangles {
    /// They are in a file that was made of them: of another format, or of a text.
    Written(Mesh),
    /// As they are read from it, when they are needed.
    Read(OnceLock<Result<Arc<Scene>, String>>),
}

/// Why the mesh of a plugin is left out.
const PLUGIN: &str = "a plugin of MuJoCo makes it, which an import does not run; if its mass is needed, say it in an `<inertial>` of the body";

/// What measuring a mesh costs for each of its vertices: its hull.
const VERTEX: usize = 100;

impl Content {
    /// A mesh that is written as STL: of points alone, their hull.
    fn made(mesh: Mesh, name: &str, (key, file): (String, String), place: Place) -> Fallible<Self> {
        let mesh = with_faces(mesh);
        let mesh = mesh.ok_or_else(|| broken(name, place, "has no faces and no convex hull"))?;
        let bytes = Ok(written(mesh.clone(), name, place)?);
        let (extension, triangles) = ("stl".to_owned(), Triangles::Written(mesh));
        Ok(Content { key, name: file, extension, bytes, triangles })
    }

    fn file(&self) -> String {
        format!("{}.{}", self.name, self.extension)
    }
}

impl<'d> Meshes<'d> {
    pub fn of(root: &'d Element, defaults: &'d Defaults<'d>) -> Fallible<Self> {
        let mut by_name = HashMap::new();
        for element in root.sections("asset").filter(|element| element.tag == "mesh") {
            let view = View::new(element, defaults, MAIN)?;
            let file = element.text("file");
            let Some(name) = element.text("name").or(element.stem()) else { continue };
            let words = ["convex", "legacy", "exact", "shell"];
            let mode = view.word("inertia", &words, "`convex`, `legacy`, `exact` or `shell`")?;
            let asset = MeshAsset {
                view,
                file,
                origin: view.numbers::<3>("refpos")?.unwrap_or_default().into(),
                rotation: quaternion(element, "refquat")?.unwrap_or_default(),
                scale: view.numbers::<3>("scale")?.unwrap_or([1.0; 3]),
                mode: [Mode::Convex, Mode::Legacy, Mode::Exact, Mode::Shell][mode.unwrap_or(1)],
            };
            if asset.scale.contains(&0.0) {
                return Err(wrong(element, "scale", "three numbers that are not 0"));
            }
            if by_name.insert(name.to_owned(), asset).is_some() {
                let fault = MjcfFault::SameName { what: "meshes", name: name.to_owned() };
                return Err(at(element.place, fault));
            }
        }
        Ok(Meshes { by_name, read: HashMap::new(), measured: HashMap::new() })
    }

    fn asset(&self, name: &str, place: Place) -> Fallible<&MeshAsset<'d>> {
        let found = self.by_name.get(name);
        found.ok_or_else(|| at(place, MjcfFault::UnknownMesh(name.to_owned())))
    }

    pub fn material(&self, name: &str) -> Option<&'d str> {
        self.by_name.get(name).and_then(|asset| asset.view.text("material"))
    }

    /// The mass of a mesh at a density of 1, in its own frame, with its scale.
    pub fn measures(
        &mut self,
        name: &str,
        place: Place,
        assets: &Assets<'_>,
    ) -> Fallible<Inertial> {
        if let Some(known) = self.measured.get(name) {
            return Ok(*known);
        }
        let mesh = self.placed(name, place, assets)?;
        assets.charge(mesh.vertices.len() * VERTEX, place)?;
        let asset = self.asset(name, place)?;
        let measures = measure(&mesh, asset.mode)
            .map_err(|problem| broken(name, asset.view.element.place, problem))?;
        self.measured.insert(name.to_owned(), measures);
        Ok(measures)
    }

    /// The triangles of a mesh, in its own frame, with its scale.
    pub fn placed(&mut self, name: &str, place: Place, assets: &Assets<'_>) -> Fallible<Mesh> {
        let content = self.content(name, place, assets)?;
        let asset = self.asset(name, place)?;
        let mut mesh = match &content.triangles {
            Triangles::Written(mesh) => mesh.clone(),
            Triangles::Read(scene) => {
                let scene = scene.get_or_init(|| {
                    let bytes = content.bytes.clone()?;
                    inspect_alone(bytes.to_vec(), &content.file()).scene
                });
                let unread = |why: &String| {
                    broken(name, asset.view.element.place, &format!("cannot be read: {why}"))
                };
                let mut mesh = scene.as_ref().map_err(unread)?.merged();
                mesh.round_to_f32();
                mesh.drop_non_finite();
                mesh
            }
        };
        let bytes = size_of_val(&*mesh.vertices) + size_of_val(&*mesh.triangles);
        assets.charge(bytes, place)?;
        mesh.transform(&asset.matrix());
        Ok(mesh)
    }

    /// A mesh as a shape, and the frame of its file in that of the mesh; `None` if the file is not a mesh.
    pub fn shape(
        &mut self,
        name: &str,
        place: Place,
        assets: &mut Assets<'_>,
        tally: &mut Tally,
    ) -> Fallible<Option<(Geometry, Isometry3<f64>)>> {
        let content = self.content(name, place, assets)?;
        let asset = self.asset(name, place)?;
        let bytes = match &content.bytes {
            Ok(bytes) => bytes,
            Err(reason) => {
                let file = asset.file.unwrap_or(name).to_owned();
                let why = Unreachable::NotMesh { file, reason: reason.clone() };
                let text = format!("{why}; it is left out");
                tally.say(features::MISSING_MESHES, asset.view.element.place, text);
                return Ok(None);
            }
        };
        tally.count(features::MESHES);
        let [x, y, z] = asset.scale;
        let is_even = x == y && y == z && x > 0.0;
        let own = asset.view.element.place;
        let is_turned = asset.rotation.angle() != 0.0;
        if is_turned && !is_even {
            // Turned, then stretched: no URDF says that.
            let mesh = self.placed(name, place, assets)?;
            let bytes = written(mesh, name, own)?;
            let path = format!("{}_turned.stl", content.name);
            let asset = assets.add(&format!("{name} turned"), &path, bytes, place)?;
            let geometry = Geometry::Mesh { asset, scale: [1.0; 3] };
            return Ok(Some((geometry, Isometry3::identity())));
        }
        if matches!(content.triangles, Triangles::Written(_)) {
            tally.count(features::WRITTEN_MESHES);
        }
        let index = assets.add(&content.key, &content.file(), Arc::clone(bytes), place)?;
        let turn = asset.rotation.inverse();
        let moved = -(turn * asset.origin).component_mul(&Vector3::from(asset.scale));
        let frame = Isometry3::from_parts(Translation3::from(moved), turn);
        Ok(Some((Geometry::Mesh { asset: index, scale: asset.scale }, frame)))
    }

    /// Assets of the same file share it, by whatever names.
    fn content(&mut self, name: &str, place: Place, assets: &Assets<'_>) -> Fallible<Arc<Content>> {
        let own = format!("name {name}");
        if let Some(known) = self.read.get(&own) {
            return Ok(Arc::clone(known));
        }
        let asset = self.asset(name, place)?;
        let content = match asset.file {
            None => Arc::new(asset.written_out(name)?),
            Some(file) => {
                let found = assets.find(file, Folder::Meshes, asset.view.element.place)?;
                let kind = asset.view.text("content_type");
                let key = format!("file {} {}", found.file.display(), kind.unwrap_or_default());
                match self.read.get(&key) {
                    Some(known) => Arc::clone(known),
                    None => {
                        let content = Arc::new(asset.read(name, key.clone(), &found, assets)?);
                        self.read.insert(key, Arc::clone(&content));
                        content
                    }
                }
            }
        };
        self.read.insert(own, Arc::clone(&content));
        Ok(content)
    }
}

impl MeshAsset<'_> {
    /// From the file to the mesh: moved, turned, stretched.
    fn matrix(&self) -> Matrix4<f64> {
        let stretch = Matrix4::new_nonuniform_scaling(&Vector3::from(self.scale));
        let turn = self.rotation.inverse().to_homogeneous();
        stretch * turn * Translation3::from(-self.origin).to_homogeneous()
    }

    fn read(
        &self,
        name: &str,
        key: String,
        found: &FoundMesh,
        assets: &Assets<'_>,
    ) -> Fallible<Content> {
        let (place, path) = (self.view.element.place, &found.file);
        let bytes = assets.bytes(found, place)?;
        let mut extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        if let Some(kind) = self.view.text("content_type") {
            kind.rsplit(['/', '.']).next().unwrap_or_default().clone_into(&mut extension);
        }
        extension.retain(|c| c.is_ascii_alphanumeric());
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let file = format!("meshes/{stem}");
        if extension == "msh" {
            let mesh = read_msh(&bytes).map_err(|problem| broken(name, place, problem))?;
            assets.charge(mesh.vertices.len() * VERTEX, place)?;
            return Content::made(mesh, name, (key, file), place);
        }
        if let Some(vertices) = (extension == "obj").then(|| points_of_obj(&bytes)).flatten() {
            assets.charge(vertices.len() * VERTEX, place)?;
            let mesh = Mesh { vertices, triangles: Vec::new() };
            return Content::made(mesh, name, (key, file), place);
        }
        let bytes = if extension == "obj" { without_materials(bytes) } else { bytes };
        if is_plain_mesh(&extension, &bytes) {
            let (bytes, triangles) = (Ok(bytes.into()), Triangles::Read(OnceLock::new()));
            return Ok(Content { key, name: file, extension, bytes, triangles });
        }
        let Inspected { bytes, scene, .. } = inspect_alone(bytes, &format!("{stem}.{extension}"));
        let unread = || scene.as_ref().err().cloned().unwrap_or_default();
        let bytes = bytes.map(|bytes| Arc::unwrap_or_clone(bytes).into()).ok_or_else(unread);
        let triangles = Triangles::Read(OnceLock::from(scene));
        Ok(Content { key, name: file, extension, bytes, triangles })
    }

    /// The mesh whose vertices are in the text.
    fn written_out(&self, name: &str) -> Fallible<Content> {
        let element = self.view.element;
        let key = (format!("text {name}"), format!("meshes/{name}"));
        if element.get("builtin").is_some() {
            return Err(at(element.place, MjcfFault::Unsupported("mesh builtin=…".to_owned())));
        }
        if element.get("vertex").is_none() {
            let (bytes, triangles) =
                (Err(PLUGIN.to_owned()), OnceLock::from(Err(PLUGIN.to_owned())));
            let (extension, triangles) = (String::new(), Triangles::Read(triangles));
            return Ok(Content { key: key.0, name: key.1, extension, bytes, triangles });
        }
        let numbers = list(element, "vertex", usize::MAX)?;
        let faces = list(element, "face", usize::MAX)?;
        #[expect(clippy::cast_possible_truncation, reason = "MuJoCo keeps 32 bits")]
        let vertices: Vec<[f64; 3]> = numbers
            .as_chunks()
            .0
            .iter()
            .map(|v: &[f64; 3]| v.map(|x| f64::from(x as f32)))
            .collect();
        if numbers.len() % 3 != 0 || vertices.len() < 4 {
            return Err(wrong(element, "vertex", "three numbers each of 4 vertices or more"));
        }
        let count = vertices.len();
        #[expect(clippy::cast_precision_loss, reason = "fewer than 2^53")]
        let is_vertex = |index: &f64| index.fract() == 0.0 && (0.0..count as f64).contains(index);
        if faces.len() % 3 != 0 || !faces.iter().all(is_vertex) {
            return Err(wrong(element, "face", "three indices of vertices each"));
        }
        #[expect(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "is_vertex")]
        let triangles: Vec<[u32; 3]> =
            faces.as_chunks().0.iter().map(|f: &[f64; 3]| f.map(|index| index as u32)).collect();
        Content::made(Mesh { vertices, triangles }, name, key, element.place)
    }
}

fn written(mesh: Mesh, name: &str, place: Place) -> Fallible<Arc<[u8]>> {
    let mut mesh = mesh;
    mesh.round_to_f32();
    let bytes = stl(&[Part::from(mesh)]);
    bytes
        .map(Into::into)
        .map_err(|error| broken(name, place, &format!("cannot be written: {error}")))
}

/// An OBJ without what names its materials: MuJoCo does not read them.
fn without_materials(bytes: Vec<u8>) -> Vec<u8> {
    let names = |line: &[u8]| {
        let line = line.trim_ascii_start();
        line.starts_with(b"mtllib") || line.starts_with(b"usemtl")
    };
    if !lines(&bytes).any(names) {
        return bytes;
    }
    let (mut kept, mut start) = (Vec::with_capacity(bytes.len()), 0);
    for line in lines(&bytes) {
        let end = (start + line.len() + 1).min(bytes.len());
        if !names(line) {
            kept.extend_from_slice(&bytes[start..end]);
        }
        start = end;
    }
    kept
}

fn broken(name: &str, place: Place, problem: &str) -> Refusal {
    let (name, problem) = (name.to_owned(), problem.to_owned());
    at(place, MjcfFault::Mesh { name, problem })
}

/// A mesh with its triangles; of points alone, those of their hull. None if they have none.
fn with_faces(mesh: Mesh) -> Option<Mesh> {
    match mesh.triangles.is_empty() {
        false => Some(mesh),
        true => Some(ConvexHull::new(&mesh.vertices).ok()?.into_mesh()),
    }
}

/// The points of an OBJ that has no faces, in 32 bits as MuJoCo keeps them.
fn points_of_obj(bytes: &[u8]) -> Option<Vec<[f64; 3]>> {
    // Most have faces, behind their points: of these no number is read.
    let is_face = |line: &[u8]| {
        let mut words = line.split(u8::is_ascii_whitespace);
        words.find(|word| !word.is_empty()) == Some(&b"f"[..]) && std::str::from_utf8(line).is_ok()
    };
    if lines(bytes).any(is_face) {
        return None;
    }
    let mut points = Vec::new();
    for line in lines(bytes) {
        let Ok(line) = std::str::from_utf8(line) else { continue };
        let mut words = line.split_ascii_whitespace();
        if words.next() == Some("v") {
            let mut point = [0.0; 3];
            for coordinate in &mut point {
                *coordinate = f64::from(words.next()?.parse::<f32>().ok()?);
            }
            points.push(point);
        }
    }
    let is_finite = points.as_flattened().iter().all(|x| x.is_finite());
    (is_finite && !points.is_empty()).then_some(points)
}
