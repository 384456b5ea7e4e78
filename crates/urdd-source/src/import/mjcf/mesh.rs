//! Meshes: files, and those that are written in the text.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::{Isometry3, Matrix4, Translation3, UnitQuaternion, Vector3};
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::read::{Part, read};
use urdd_geometry::write::stl;

use super::super::fault::ImportFault;
use super::super::features::{self, Tally};
use super::super::model::Geometry;
use super::super::place::Place;
use super::assets::{Assets, Folder};
use super::at::{At, Fallible, at};
use super::defaults::{Defaults, MAIN};
use super::document::Element;
use super::fault::MjcfFault;
use super::mesh_mass::{Measures, Mode, measure};
use super::msh;
use super::orientation::quaternion;
use super::reading::{View, list, wrong};

/// The meshes of a model. A file is read when a shape needs it.
pub struct Meshes<'d> {
    by_name: HashMap<String, MeshAsset<'d>>,
    /// What was read, by file, or by name where it is in the text.
    read: HashMap<String, Arc<Content>>,
    measured: HashMap<String, Measures>,
}

struct MeshAsset<'d> {
    view: View<'d>,
    file: Option<&'d str>,
    origin: Vector3<f64>,
    rotation: UnitQuaternion<f64>,
    scale: [f64; 3],
    mode: Mode,
}

/// A mesh file.
struct Content {
    /// Its path below the folder of the URDF, without its extension.
    name: String,
    extension: String,
    bytes: Arc<[u8]>,
    /// Its triangles, if it is not a file as robots have it.
    mesh: Option<Mesh>,
}

impl<'d> Meshes<'d> {
    /// The meshes that a model defines.
    pub fn of(root: &'d Element, defaults: &'d Defaults<'d>) -> Fallible<Self> {
        let mut by_name = HashMap::new();
        for element in root.sections("asset").filter(|element| element.tag == "mesh") {
            let view = View::new(element, defaults, MAIN)?;
            let file = element.text("file");
            let stem = file.map(|file| {
                let base = file.rsplit(['/', '\\']).next().unwrap_or(file);
                base.rsplit_once('.').map_or(base, |(stem, _)| stem)
            });
            let Some(name) = element.text("name").or(stem) else { continue };
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

    /// The material that a mesh names.
    pub fn material(&self, name: &str) -> Option<&'d str> {
        self.by_name.get(name).and_then(|asset| asset.view.text("material"))
    }

    /// The measures of a mesh, in its own frame, with its scale.
    pub fn measures(
        &mut self,
        name: &str,
        place: Place,
        assets: &Assets<'_>,
    ) -> Fallible<Measures> {
        if let Some(known) = self.measured.get(name) {
            return Ok(*known);
        }
        let mesh = self.placed(name, place, assets)?;
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
        let mut mesh = match &content.mesh {
            Some(mesh) => mesh.clone(),
            None => triangles(&content, name, asset.view.element.place)?,
        };
        mesh.transform(&asset.matrix());
        Ok(mesh)
    }

    /// A mesh as a shape, and the frame of its file in that of the mesh.
    pub fn shape(
        &mut self,
        name: &str,
        place: Place,
        assets: &mut Assets<'_>,
        tally: &mut Tally,
    ) -> Fallible<(Geometry, Isometry3<f64>)> {
        let content = self.content(name, place, assets)?;
        let asset = self.asset(name, place)?;
        let [x, y, z] = asset.scale;
        let is_even = x == y && y == z && x > 0.0;
        let own = asset.view.element.place;
        let is_turned = asset.rotation.angle() != 0.0;
        if is_turned && !is_even {
            // Turned, then stretched: no URDF says that.
            let mesh = self.placed(name, place, assets)?;
            let bytes = written(mesh, name, own)?;
            let path = format!("{}_turned.stl", content.name);
            let index = assets.add(&format!("{name} turned"), &path, bytes);
            return Ok((Geometry::Mesh { asset: index, scale: [1.0; 3] }, Isometry3::identity()));
        }
        if content.extension == "stl" && content.mesh.is_some() {
            tally.count(features::WRITTEN_MESHES);
        }
        let path = format!("{}.{}", content.name, content.extension);
        let index = assets.add(&asset.key(name), &path, Arc::clone(&content.bytes));
        let turn = asset.rotation.inverse();
        let moved = -(turn * asset.origin).component_mul(&Vector3::from(asset.scale));
        let frame = Isometry3::from_parts(Translation3::from(moved), turn);
        Ok((Geometry::Mesh { asset: index, scale: asset.scale }, frame))
    }

    fn content(&mut self, name: &str, place: Place, assets: &Assets<'_>) -> Fallible<Arc<Content>> {
        let asset = self.asset(name, place)?;
        let key = asset.key(name);
        if let Some(known) = self.read.get(&key) {
            return Ok(Arc::clone(known));
        }
        let content = Arc::new(asset.read(name, assets)?);
        self.read.insert(key, Arc::clone(&content));
        Ok(content)
    }
}

impl MeshAsset<'_> {
    /// Meshes of the same file share it.
    fn key(&self, name: &str) -> String {
        match self.file {
            Some(file) => {
                format!("file {file} {}", self.view.text("content_type").unwrap_or_default())
            }
            None => format!("text {name}"),
        }
    }

    /// From the file to the mesh: moved, turned, stretched.
    fn matrix(&self) -> Matrix4<f64> {
        let stretch = Matrix4::new_nonuniform_scaling(&Vector3::from(self.scale));
        let turn = self.rotation.inverse().to_homogeneous();
        stretch * turn * Translation3::from(-self.origin).to_homogeneous()
    }

    fn read(&self, name: &str, assets: &Assets<'_>) -> Fallible<Content> {
        let element = self.view.element;
        let place = element.place;
        let Some(file) = self.file else { return self.written_out(name) };
        let (path, bytes) = assets
            .file(file, Folder::Meshes, place)
            .map_err(|fault| at(place, ImportFault::File(fault)))?;
        let mut extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        if let Some(kind) = self.view.text("content_type") {
            kind.rsplit(['/', '.']).next().unwrap_or_default().clone_into(&mut extension);
        }
        extension.retain(|c| c.is_ascii_alphanumeric());
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let content = |extension: &str, bytes, mesh| Content {
            name: format!("meshes/{stem}"),
            extension: extension.to_owned(),
            bytes,
            mesh,
        };
        Ok(match extension.as_str() {
            "msh" => {
                let mesh = msh::read(&bytes).map_err(|problem| broken(name, place, problem))?;
                content("stl", written(mesh.clone(), name, place)?, Some(mesh))
            }
            "obj" => content("obj", without_materials(bytes).into(), None),
            other => content(other, bytes.into(), None),
        })
    }

    /// The mesh whose vertices are in the text.
    fn written_out(&self, name: &str) -> Fallible<Content> {
        let element = self.view.element;
        let unsupported =
            |what: &str| Err(at(element.place, MjcfFault::Unsupported(what.to_owned())));
        if element.get("builtin").is_some() {
            return unsupported("mesh builtin=…");
        }
        if element.get("vertex").is_none() {
            return unsupported("mesh> with a <plugin");
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
        let mesh = match triangles.is_empty() {
            false => Mesh { vertices, triangles },
            true => ConvexHull::new(&vertices)
                .map_err(|_| broken(name, element.place, "has no convex hull"))?
                .into_mesh(),
        };
        let bytes = written(mesh.clone(), name, element.place)?;
        let name = format!("meshes/{name}");
        Ok(Content { name, extension: "stl".to_owned(), bytes, mesh: Some(mesh) })
    }
}

fn triangles(content: &Content, name: &str, place: Place) -> Fallible<Mesh> {
    let file = format!("{}.{}", content.name, content.extension);
    let scene = read(&content.bytes, &file, &mut |_| None)
        .map_err(|error| broken(name, place, &format!("cannot be read: {error}")))?;
    let mut mesh = scene.merged();
    mesh.round_to_f32();
    mesh.drop_non_finite();
    Ok(mesh)
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
    if !bytes.split(|byte| *byte == b'\n').any(names) {
        return bytes;
    }
    let lines = bytes.split_inclusive(|byte| *byte == b'\n');
    lines.filter(|line| !names(line)).flatten().copied().collect()
}

fn broken(name: &str, place: Place, problem: &str) -> At {
    let (name, problem) = (name.to_owned(), problem.to_owned());
    at(place, MjcfFault::Mesh { name, problem })
}
