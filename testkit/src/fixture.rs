//! A whole URDD in memory: built valid, then edited, sealed and written.
//!
//! ```ignore
//! let mut urdd = Fixture::toy();
//! urdd.set("dof_module", "/num_dofs", json!(3));  // one fault
//! urdd.seal();                                    // mirror, sizes and hashes follow it
//! urdd.write_to(folder.path());
//! ```

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde::Serialize;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use urdd_directory::source::Memory;
use urdd_directory::{canonical, file_entry};
use urdd_format::link_shapes_skips::SkipEdit;
use urdd_format::registry::{FIRST_SPEC_VERSION, ModuleKind};
use urdd_format::urdf::*;

use super::core::{Core, kinematics_samples_module};
use super::emit;
use super::meshes::Meshes;
use super::robot::*;
use super::shapes::Shapes;

/// Name of the root metadata, which is also a document.
pub const ROOT: &str = "urdd.json";
/// Path of the URDF in the URDD.
pub const URDF: &str = "robot.urdf";

/// A URDD in memory.
#[derive(Debug, Clone)]
pub struct Fixture {
    /// Every file by its path. [`Fixture::seal`] updates those that it writes.
    pub files: BTreeMap<String, Vec<u8>>,
    /// Documents by module folder; the root metadata is under [`ROOT`].
    pub documents: BTreeMap<String, Value>,
    /// Files that `seal` leaves unchanged (or absent) because a test has put, removed or kept them.
    by_hand: BTreeSet<String>,
    /// Entries of `urdd.json` that `seal` does not update.
    kept_hashes: Kept,
    /// Whether `seal` writes the canonical format of SPEC instead of that of [`emit`].
    pub canonical: bool,
}

#[derive(Debug, Clone)]
enum Kept {
    These(BTreeSet<String>),
    All,
}

impl Fixture {
    /// A URDD of class Core with kinematics samples.
    pub fn core(robot: &Robot) -> Fixture {
        Fixture::build(robot, Vec::new(), BTreeMap::new(), "Core")
    }

    /// A URDD of class Core with one more module that belongs to no class.
    pub fn core_with(robot: &Robot, kind: ModuleKind, document: Value) -> Fixture {
        Fixture::build(robot, vec![(kind, document)], BTreeMap::new(), "Core")
    }

    /// A URDD of class Shapes with all modules. An edit skips the pair of the first and the last link with a shape.
    ///
    /// # Panics
    /// Like [`Meshes::new`].
    pub fn full(robot: &Robot) -> Fixture {
        let meshes = Meshes::new(robot);
        let shaped = robot.urdf.links.iter().zip(&meshes.solids);
        let shaped: Vec<&str> = shaped
            .filter(|(_, solids)| solids.is_some())
            .map(|(link, _)| link.name.as_str())
            .collect();
        let edits = match shaped[..] {
            [first, .., last] => vec![edit(first, last, true)],
            _ => Vec::new(),
        };
        Fixture::full_with_edits(robot, edits)
    }

    /// Like [`Fixture::full`], with these skip edits.
    pub fn full_with_edits(robot: &Robot, edits: Vec<SkipEdit>) -> Fixture {
        let core = Core::new(robot);
        let meshes = Meshes::new(robot);
        let shapes = Shapes::new(robot, &core, &meshes, edits);
        let documents = vec![
            (ModuleKind::OriginalMeshes, value(&meshes.originals)),
            (ModuleKind::PlainMeshes, value(&meshes.plain)),
            (ModuleKind::ConvexHullMeshes, value(&meshes.hulls)),
            (ModuleKind::ConvexDecompositionMeshes, value(&meshes.pieces)),
            (ModuleKind::LinkShapesApproximations, value(&shapes.approximations)),
            (ModuleKind::LinkShapesMaxDistanceFromOrigin, value(&shapes.max_distances)),
            (ModuleKind::LinkShapesDistanceStatistics, value(&shapes.statistics)),
            (ModuleKind::LinkShapesSimpleSkips, value(&shapes.simple_skips)),
            (ModuleKind::LinkShapesSkips, value(&shapes.skips)),
        ];
        Fixture::build(robot, documents, meshes.files, "Shapes")
    }

    /// A small fixed robot with every joint type, chained mimic joints, meshes, and all modules. A validator has
    /// nothing to report about it, neither as a URDD nor as a robot.
    pub fn toy() -> Fixture {
        static TOY: std::sync::OnceLock<Fixture> = std::sync::OnceLock::new();
        let make = || {
            let edits = vec![edit("base", "tool/ü 1", true), edit("base", "turret", false)];
            Fixture::full_with_edits(&toy_robot(), edits)
        };
        TOY.get_or_init(make).clone()
    }

    fn build(
        robot: &Robot,
        more: Vec<(ModuleKind, Value)>,
        mut files: BTreeMap<String, Vec<u8>>,
        class: &str,
    ) -> Fixture {
        let core = Core::new(robot);
        let mut modules = vec![
            (ModuleKind::Urdf, value(&robot.urdf)),
            (ModuleKind::Dof, value(&core.dof)),
            (ModuleKind::Chain, value(&core.chain)),
            (ModuleKind::Connections, value(&core.connections)),
            (ModuleKind::Bounds, value(&core.bounds)),
            (ModuleKind::KinematicsSamples, value(&kinematics_samples_module(robot, &core))),
        ];
        modules.extend(more);
        let entries: Vec<Value> = modules
            .iter()
            .map(|(kind, _)| {
                let depends_on: Vec<&str> = kind.depends_on().iter().map(|k| k.name()).collect();
                json!({ "name": kind.name(), "version": "1.0.0", "path": kind.folder(),
                        "depends_on": depends_on, "files": [] })
            })
            .collect();
        let since = modules.iter().map(|(kind, _)| kind.since()).max();
        let version = since.unwrap_or(FIRST_SPEC_VERSION);
        let root = json!({
            "urdd_version": version,
            "robot_name": robot.urdf.name,
            "conformance_class": class,
            "generator": { "name": "tests/support", "version": "1" },
            "source": { "Urdf": { "path": URDF, "size": 0, "sha256": "" } },
            "modules": entries,
        });
        files.insert(URDF.to_owned(), robot.to_urdf_xml().into_bytes());
        let mut documents: BTreeMap<String, Value> = modules
            .into_iter()
            .map(|(kind, document)| (kind.folder().to_owned(), document))
            .collect();
        documents.insert(ROOT.to_owned(), root);
        let mut fixture = Fixture {
            files,
            documents,
            by_hand: BTreeSet::new(),
            kept_hashes: Kept::These(BTreeSet::new()),
            canonical: false,
        };
        fixture.relist();
        fixture.seal();
        fixture
    }

    // ---- Documents

    /// The key of a document in `documents`, found by a module's name or folder.
    fn key(&self, name: &str) -> String {
        let is_it = |key: &&String| *key == name || key.ends_with(&format!("/{name}"));
        let found = self.documents.keys().find(is_it);
        found.unwrap_or_else(|| panic!("no document {name:?}")).clone()
    }

    /// Folder of a module, by its name.
    pub fn folder(&self, module: &str) -> String {
        self.key(module)
    }

    /// The document of a module (by name or folder), or `urdd.json`.
    pub fn doc(&self, name: &str) -> &Value {
        &self.documents[&self.key(name)]
    }

    /// Like [`Fixture::doc`], mutable.
    pub fn doc_mut(&mut self, name: &str) -> &mut Value {
        let key = self.key(name);
        self.documents.get_mut(&key).expect("just found")
    }

    /// The value at a JSON Pointer of a document.
    pub fn get(&self, name: &str, pointer: &str) -> &Value {
        let found = self.doc(name).pointer(pointer);
        found.unwrap_or_else(|| panic!("{name} has nothing at {pointer:?}"))
    }

    /// Sets the value at a JSON Pointer: replaces an existing value, adds a key to an object, or appends to a list
    /// (`-`, or its length).
    pub fn set(&mut self, name: &str, pointer: &str, new: Value) {
        let document = self.doc_mut(name);
        if let Some(old) = document.pointer_mut(pointer) {
            *old = new;
            return;
        }
        match parent_of(document, pointer) {
            (Some(Value::Object(map)), last) => {
                map.insert(last, new);
            }
            (Some(Value::Array(list)), last) if last == "-" || last == list.len().to_string() => {
                list.push(new);
            }
            _ => panic!("{name} has no place {pointer:?}"),
        }
    }

    /// Removes the value at a JSON Pointer and returns it.
    pub fn remove(&mut self, name: &str, pointer: &str) -> Value {
        let removed = match parent_of(self.doc_mut(name), pointer) {
            (Some(Value::Object(map)), last) => map.shift_remove(&last),
            (Some(Value::Array(list)), last) => {
                let at = last.parse().ok().filter(|i: &usize| *i < list.len());
                at.map(|i| list.remove(i))
            }
            _ => None,
        };
        removed.unwrap_or_else(|| panic!("{name} has nothing at {pointer:?}"))
    }

    /// Removes a whole module: its document, its files, its entry in `urdd.json`.
    pub fn remove_module(&mut self, module: &str) {
        let folder = self.key(module);
        self.documents.remove(&folder);
        let inside = format!("{folder}/");
        self.files.retain(|path, _| !path.starts_with(&inside));
        let modules = self.modules_mut();
        modules.retain(|entry| entry["path"] != json!(folder));
    }

    /// Adds a module at the end of `urdd.json` and lists its files.
    pub fn add_module(&mut self, folder: &str, document: Value) {
        let name = folder.rsplit('/').next().unwrap_or_default();
        let entry = json!({ "name": name, "version": "1.0.0", "path": folder,
                            "depends_on": [], "files": [] });
        self.modules_mut().push(entry);
        self.documents.insert(folder.to_owned(), document);
        self.relist();
    }

    fn modules_mut(&mut self) -> &mut Vec<Value> {
        let modules = self.doc_mut(ROOT)["modules"].as_array_mut();
        modules.expect("urdd.json has a list of modules")
    }

    // ---- Files

    /// Edits the URDF in the URDD: `urdd.urdf_mut(|xml| *xml = xml.replace("a", "b"))`.
    pub fn urdf_mut(&mut self, change: impl FnOnce(&mut String)) {
        let bytes = self.files.remove(URDF).expect("a URDF");
        let mut xml = String::from_utf8(bytes).expect("UTF-8");
        change(&mut xml);
        self.files.insert(URDF.to_owned(), xml.into_bytes());
    }

    /// Replaces the first `from` in the URDF; panics if there is none.
    pub fn urdf_replace(&mut self, from: &str, to: &str) {
        self.urdf_mut(|xml| {
            assert!(xml.contains(from), "the URDF has no {from:?}");
            *xml = xml.replacen(from, to, 1);
        });
    }

    /// The bytes of a file.
    pub fn file(&self, path: &str) -> &[u8] {
        let found = self.files.get(path);
        found.unwrap_or_else(|| panic!("no file {path:?}"))
    }

    /// Adds or replaces a file permanently: `seal` does not write it again. A new file is not listed in `urdd.json`:
    /// see [`Fixture::list`].
    pub fn put_file(&mut self, path: &str, bytes: impl Into<Vec<u8>>) {
        self.by_hand.insert(path.to_owned());
        self.files.insert(path.to_owned(), bytes.into());
    }

    /// Removes a file permanently: `seal` does not write it again. It remains listed in `urdd.json`: see
    /// [`Fixture::unlist`].
    pub fn remove_file(&mut self, path: &str) {
        self.by_hand.insert(path.to_owned());
        let removed = self.files.remove(path);
        assert!(removed.is_some(), "no file {path:?}");
    }

    /// Adds a file to its module's list in `urdd.json`, at the sorted position.
    pub fn list(&mut self, path: &str) {
        let entry = json!({ "path": path, "size": 0, "sha256": "0".repeat(64) });
        let inside = |module: &&mut Value| {
            let folder = module["path"].as_str().unwrap_or_default();
            path.starts_with(&format!("{folder}/"))
        };
        let mut modules = self.modules_mut().iter_mut();
        let module = modules.find(inside).expect("a module around the file");
        let files = module["files"].as_array_mut().expect("a list");
        let before = |file: &Value| file["path"].as_str() < Some(path);
        files.insert(files.partition_point(before), entry);
    }

    /// Removes a file from its module's list in `urdd.json`.
    pub fn unlist(&mut self, path: &str) {
        file_entry::unlist(self.doc_mut(ROOT), |listed| listed == path);
    }

    /// Rebuilds all file lists in `urdd.json`: existing files and those that `seal` will write.
    pub fn relist(&mut self) {
        let mut paths: BTreeSet<String> = self.files.keys().cloned().collect();
        let sealed = self.documents.keys().filter(|key| *key != ROOT);
        paths.extend(sealed.flat_map(|folder| sealed_files(folder)));
        paths.retain(|path| self.files.contains_key(path) || !self.by_hand.contains(path));
        for module in self.modules_mut() {
            let folder = format!("{}/", module["path"].as_str().unwrap_or_default());
            let inside = paths.iter().filter(|path| path.starts_with(&folder));
            module["files"] = inside
                .map(|path| json!({ "path": path, "size": 0, "sha256": "0".repeat(64) }))
                .collect();
        }
    }

    // ---- Sealing

    /// Keeps `module.yaml` of a module unchanged in [`Fixture::seal`].
    pub fn keep_mirror(&mut self, module: &str) {
        let path = format!("{}/module.yaml", self.key(module));
        self.by_hand.insert(path);
    }

    /// Keeps size and hash of a file in `urdd.json` unchanged.
    pub fn keep_hash(&mut self, path: &str) {
        if let Kept::These(kept) = &mut self.kept_hashes {
            kept.insert(path.to_owned());
        }
    }

    /// Keeps all sizes and hashes in `urdd.json` unchanged.
    pub fn keep_hashes(&mut self) {
        self.kept_hashes = Kept::All;
    }

    /// Writes `VERSION`, `module.json` and `module.yaml` of every module from its document, updates the sizes and
    /// hashes in `urdd.json`, and writes it. Files put or removed by hand, and entries of missing files, remain
    /// unchanged.
    pub fn seal(&mut self) {
        let documents = self.documents.iter().filter(|(key, _)| *key != ROOT);
        for (folder, document) in documents {
            let [version, json, yaml] = sealed_files(folder);
            let root = &self.documents[ROOT]["modules"];
            let entry = root.as_array().into_iter().flatten();
            let stated = entry
                .filter(|entry| entry["path"] == json!(folder))
                .find_map(|entry| entry["version"].as_str());
            for (path, bytes) in [
                (version, stated.unwrap_or("1.0.0").as_bytes().to_vec()),
                (json, self.json(document)),
                (yaml, self.yaml(document)),
            ] {
                if !self.by_hand.contains(&path) {
                    self.files.insert(path, bytes);
                }
            }
        }
        let mut root = self.documents[ROOT].clone();
        file_entry::all(&mut root).for_each(|entry| self.rehash(entry));
        if !self.by_hand.contains(ROOT) {
            self.files.insert(ROOT.to_owned(), self.json(&root));
        }
        self.documents.insert(ROOT.to_owned(), root);
    }

    fn json(&self, document: &Value) -> Vec<u8> {
        match self.canonical {
            true => canonical::json_string(document).into_bytes(),
            false => emit::json(document),
        }
    }

    fn yaml(&self, document: &Value) -> Vec<u8> {
        match self.canonical {
            true => canonical::yaml_string(document).into_bytes(),
            false => emit::yaml(document),
        }
    }

    fn rehash(&self, entry: &mut Value) {
        let path = entry["path"].as_str().unwrap_or_default();
        let kept = match &self.kept_hashes {
            Kept::These(kept) => kept.contains(path),
            Kept::All => true,
        };
        if let (Some(bytes), false) = (self.files.get(path), kept) {
            let (size, sha256) = size_and_hash(bytes);
            entry["size"] = json!(size);
            entry["sha256"] = json!(sha256);
        }
    }

    /// The URDD as a source for a validator, without a disk.
    ///
    /// # Panics
    /// If a path is not one that SPEC 2.8 allows.
    pub fn in_memory(&self) -> Memory {
        let files = self.files.iter();
        let files = files.map(|(path, bytes)| (path.clone(), bytes.as_slice().into()));
        Memory::new("robot", files.collect())
            .unwrap_or_else(|(path, fault)| panic!("{path}: {fault}"))
    }

    /// Writes every file below `root`, which is created if it does not exist.
    pub fn write_to(&self, root: &Path) {
        std::fs::create_dir_all(root).expect("folder of the URDD");
        for (path, bytes) in &self.files {
            let path = root.join(path);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("folder");
            std::fs::write(&path, bytes).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        }
    }
}

/// The files that `seal` writes for a module, in byte order of their names.
fn sealed_files(folder: &str) -> [String; 3] {
    ["VERSION", "module.json", "module.yaml"].map(|file| format!("{folder}/{file}"))
}

/// Size and SHA-256 of a file in the format of `urdd.json`. Independent of `urdd_directory::file_entry`, which the
/// validator's tests check against it, and the tests of other producers.
pub fn size_and_hash(bytes: &[u8]) -> (usize, String) {
    let digest = Sha256::digest(bytes);
    let digits = digest.iter().map(|byte| format!("{byte:02x}"));
    (bytes.len(), digits.collect())
}

/// The parent of the value at a pointer, and the last token.
fn parent_of<'a>(document: &'a mut Value, pointer: &str) -> (Option<&'a mut Value>, String) {
    let (parent, last) = pointer.rsplit_once('/').unwrap_or(("", ""));
    let last = last.replace("~1", "/").replace("~0", "~");
    (document.pointer_mut(parent), last)
}

/// A module as a document without negative zeros.
pub fn value(module: &impl Serialize) -> Value {
    fn clean(value: &mut Value) {
        match value {
            Value::Array(items) => items.iter_mut().for_each(clean),
            Value::Object(map) => map.values_mut().for_each(clean),
            Value::Number(number) if number.as_f64() == Some(0.0) && number.is_f64() => {
                *value = json!(0.0);
            }
            _ => {}
        }
    }
    let mut value = serde_json::to_value(module).expect("a document");
    clean(&mut value);
    value
}

fn edit(link_a: &str, link_b: &str, skip: bool) -> SkipEdit {
    SkipEdit {
        link_a: link_a.to_owned(),
        link_b: link_b.to_owned(),
        skip,
        reason: "for tests".to_owned(),
    }
}

/// The robot of [`Fixture::toy`]. It has every joint type; mimic joints of a driver declared later, of a mimic joint,
/// and of a fixed joint; a locked joint; unusual names; links with a visual mesh, a visual box, both kinds of geometry,
/// only collision geometry, and none; and all five skip reasons.
pub fn toy_robot() -> Robot {
    let mut robot = Robot::new("toy robot");
    robot.urdf.version = Some("1.2".to_owned());
    robot.meshes = BTreeMap::from([
        ("package://toy_description/meshes/turret.stl".to_owned(), [0.2, 0.2, 0.1]),
        ("meshes/päckchen_1.obj".to_owned(), [100.0, 60.0, 40.0]),
    ]);
    let turret = mesh("package://toy_description/meshes/turret.stl", None);
    let tool = mesh("meshes/päckchen_1.obj", Some([0.001; 3]));
    let red = Material {
        name: Some("red".to_owned()),
        color: Some(Color { rgba: [0.8, 0.1, 0.1, 1.0] }),
        texture: None,
    };
    robot.urdf.materials.push(red);
    robot.urdf.unknown_elements = vec![
        "<transmission name=\"drive\">\n  <type>simple &amp; plain</type>\n</transmission>"
            .to_owned(),
    ];
    let shaped = |name: &str, size: [f64; 3], at: Option<Origin>| Link {
        inertial: Some(solid_box(1.0, size)),
        visual: vec![visual(at, cuboid(size))],
        ..link(name)
    };
    let mut base = shaped("base", [0.4, 0.4, 0.1], None);
    base.collision.push(collision(origin([0.0, 0.0, 0.01], [0.0; 3]), cuboid([0.5, 0.5, 0.12])));
    let mut turret_link = link("turret");
    turret_link.inertial = Some(solid_box(0.5, [0.2, 0.2, 0.1]));
    turret_link.visual.push(Visual {
        name: Some("no".to_owned()),
        material: Some(Material { name: Some("red".to_owned()), color: None, texture: None }),
        ..visual(origin([0.0, 0.0, 0.05], [0.0, 0.0, 0.3]), turret.clone())
    });
    turret_link.collision.push(collision(None, turret));
    turret_link.unknown_elements = vec!["<sensor name='a/>b'/>".to_owned()];
    let mut tool_link = link("tool/ü 1");
    tool_link.visual.push(visual(origin([0.05, 0.0, 0.0], [0.2, -0.4, 1.1]), tool));
    let mut bumper = link("1:30");
    bumper.collision.push(collision(None, cuboid([0.05, 0.3, 0.05])));
    let arm = origin([0.2, 0.0, 0.0], [0.0, 0.1, 0.0]);
    robot.urdf.links = vec![
        shaped("finger_left", [0.02, 0.02, 0.08], origin([0.0, 0.0, 0.04], [0.0; 3])),
        base,
        turret_link,
        shaped("arm", [0.4, 0.06, 0.06], arm),
        link("frame"),
        bumper,
        tool_link,
        shaped("finger_right", [0.02, 0.02, 0.08], None),
        link("finger_tip"),
        shaped("puck", [0.5, 0.5, 0.1], None),
        shaped("drone", [0.15, 0.1, 0.05], None),
        shaped("eye", [0.05, 0.05, 0.05], None),
        shaped("wheel", [0.3, 0.05, 0.3], None),
        shaped("lock", [0.1, 0.1, 0.1], None),
        link("still"),
    ];
    let axis = |xyz: [f64; 3]| Some(Axis { xyz: Some(xyz) });
    let mimic = |joint: &str, multiplier: Option<f64>, offset: Option<f64>| {
        Some(Mimic { joint: joint.to_owned(), multiplier, offset })
    };
    use JointType::*;
    let mut joints = vec![
        // Declared before its driver, which is itself a mimic joint.
        Joint {
            origin: origin([0.0, 0.0, 0.08], [0.0; 3]),
            axis: axis([0.0, 1.0, 0.0]),
            limit: limit(-1.0, 1.0),
            mimic: mimic("right", Some(10.0), Some(0.1)),
            ..joint("tip", Revolute, "finger_right", "finger_tip")
        },
        Joint {
            origin: origin([0.0, 0.0, 0.1], [0.0; 3]),
            axis: axis([0.0, 0.0, 2.0]),
            limit: limit(-2.5, 2.5),
            dynamics: Some(Dynamics { damping: Some(0.1), friction: None }),
            ..joint("turn", Revolute, "base", "turret")
        },
        Joint {
            origin: origin([0.05, 0.0, 0.2], [0.3, -1.2, 2.0]),
            axis: axis([1.0, 1.0, 0.0]),
            limit: limit(-1.0, 1.5),
            safety_controller: Some(SafetyController {
                soft_lower_limit: Some(-0.9),
                soft_upper_limit: None,
                k_position: Some(15.0),
                k_velocity: Some(10.0),
            }),
            ..joint("shoulder", Revolute, "turret", "arm")
        },
        // The rotation of the origin is missing, and so is the axis.
        Joint {
            origin: Some(Origin { xyz: Some([0.4, 0.0, 0.0]), rpy: None, quat_xyzw: None }),
            ..joint("flange", Fixed, "arm", "frame")
        },
        Joint {
            // URDF 1.2.
            limit: limit(0.0, 0.2).map(|limit| Limit {
                acceleration: Some(2.0),
                deceleration: Some(3.0),
                jerk: Some(40.0),
                ..limit
            }),
            ..joint("slide", Prismatic, "frame", "tool/ü 1")
        },
        Joint {
            axis: axis([0.0, 0.0, -1.0]),
            origin: origin([0.2, 0.2, 0.0], [0.0; 3]),
            ..joint("plane", Planar, "base", "puck")
        },
        Joint {
            origin: origin([0.0, 0.0, 1.0], [0.0; 3]),
            ..joint("air", Floating, "base", "drone")
        },
        Joint {
            origin: Some(Origin { xyz: None, rpy: Some([0.0, 0.5, 0.0]), quat_xyzw: None }),
            ..joint("socket/ü", Spherical, "drone", "eye")
        },
        Joint {
            axis: axis([0.0, 1.0, 0.0]),
            origin: origin([0.0, 0.4, 0.0], [0.0; 3]),
            ..joint("spin", Continuous, "base", "wheel")
        },
        Joint {
            origin: origin([0.1, 0.04, 0.0], [0.0; 3]),
            axis: axis([0.0, 1.0, 0.0]),
            limit: limit(0.0, 0.04),
            ..joint("left", Prismatic, "tool/ü 1", "finger_left")
        },
        Joint {
            origin: origin([0.1, -0.04, 0.04], [0.0; 3]),
            axis: axis([0.0, 1.0, 0.0]),
            limit: limit(-0.04, 0.0),
            mimic: mimic("left", Some(-1.0), None),
            ..joint("right", Prismatic, "tool/ü 1", "finger_right")
        },
        Joint {
            // URDF 1.1: half a turn about z, not normalised.
            origin: Some(Origin {
                xyz: Some([-0.22, 0.0, 0.0]),
                rpy: None,
                quat_xyzw: Some([0.0, 0.0, -2.0, 0.0]),
            }),
            ..joint("bolt", Fixed, "base", "1:30")
        },
        // Locked: lower equals upper.
        Joint {
            origin: origin([0.0, 0.0, -0.05], [0.0; 3]),
            limit: limit(0.25, 0.25),
            ..joint("locked", Revolute, "base", "lock")
        },
        // Follows a fixed joint: its position is its offset.
        Joint {
            origin: origin([0.0, 0.0, 0.1], [0.0; 3]),
            limit: limit(-1.0, 1.0),
            mimic: mimic("bolt", Some(2.0), Some(0.5)),
            ..joint("frozen", Revolute, "lock", "still")
        },
    ];
    joints[1].unknown_elements = vec!["<gazebo/>".to_owned()];
    joints[1].calibration = Some(Calibration { rising: Some(0.0), falling: None });
    robot.urdf.joints = joints;
    robot.layout = Layout::Alternating;
    robot
}
