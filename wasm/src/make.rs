//! What is made of the descriptions among files: which there are, a URDF of an MJCF, SDF or USD, and a URDD, with the
//! progress of making it, which the host is told of.

use serde::Deserialize;
use serde_json::{Value, json};
use urdd_directory::range::OutOfRange;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::ModuleKind;
use urdd_generate::{
    Generated, MeshFormats, PIECES, Progress, SAMPLES, Selection, Settings, generate_in_memory,
};
use urdd_import::import_whole;
use urdd_source::ImportOptions;
use urdd_source::dropped::{Dropped, descriptions};

use crate::around::GivenFiles;
use crate::files::Files;
use crate::{answer, memory};

/// How a ball joint is written.
#[derive(Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
enum Ball {
    /// As a spherical joint.
    Spherical,
    /// As three revolute joints.
    Revolute,
}

/// The mass of links between the joints of one body.
#[derive(Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
enum Massless {
    /// None.
    None,
    /// 1e-9 kg and 1e-9 kg m².
    Tiny,
}

/// What is chosen of a description that is no URDF, as in `urdd.import_robot` in Python.
fn options(
    body: Option<String>,
    model: Option<String>,
    ball: Option<Ball>,
    massless: Option<Massless>,
) -> ImportOptions {
    let has_revolute_balls = ball == Some(Ball::Revolute);
    let has_tiny_masses = massless == Some(Massless::Tiny);
    ImportOptions { body, model, has_revolute_balls, has_tiny_masses }
}

/// What is asked.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ImportQuestion {
    /// The path of the MJCF, SDF or USD.
    path: String,
    body: Option<String>,
    model: Option<String>,
    ball: Option<Ball>,
    massless: Option<Massless>,
}

/// Imports an MJCF, SDF or USD among these files. The question is a [`ImportQuestion`] as JSON. The answer has the address of `files`
/// (the URDF, its meshes, `NAME.srdf`, `NAME.export.toml`), the path of the `urdf` there, and the `report`.
///
/// # Safety
/// `files` is open; the question is valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_import(
    files: *mut Files,
    question: *const u8,
    length: usize,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (files, question) = unsafe { (&*files, memory::bytes(question, length)) };
    answer::result(import(files, question))
}

fn import(files: &Files, question: &[u8]) -> Result<Value, String> {
    let question: ImportQuestion =
        serde_json::from_slice(question).map_err(|error| error.to_string())?;
    let given = GivenFiles::of(files)?;
    let mut settings = given.settings(&question.path)?;
    settings.import = options(question.body, question.model, question.ball, question.massless);
    let path = given.place(&question.path);
    let imported = import_whole(&path, &settings);
    let (imported, _) = imported.map_err(|error| error.to_string())?;
    let report = serde_json::from_str::<Value>(&imported.report.to_json());
    let report = report.map_err(|error| error.to_string())?;
    let files = Files::address_of("", imported.files)?;
    Ok(json!({ "files": files, "urdf": imported.urdf, "report": report }))
}

/// The descriptions among these files: `path`, `name` and `format` (`urdf`, `xacro`, `mjcf`, `sdf`, `usd`) of each.
///
/// # Safety
/// `files` is open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_descriptions(files: *mut Files) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let files = unsafe { &*files };
    answer::result(GivenFiles::of(files).map(|given| {
        let one = |Dropped { job, kind }: &Dropped| {
            json!({ "path": given.path(&job.source), "name": job.name, "format": kind.name() })
        };
        Value::from(descriptions(given.files()).iter().map(one).collect::<Vec<_>>())
    }))
}

/// What is asked. The options are those of `urdd.generate` in Python.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GenerateQuestion {
    /// The path of the URDF, MJCF, SDF or USD.
    path: String,
    modules: Option<Vec<String>>,
    geometry: Option<Geometry>,
    mesh_formats: Option<Vec<Mesh>>,
    pieces: Option<f64>,
    piece_tolerance: Option<f64>,
    samples: Option<f64>,
    reference: Option<String>,
    #[serde(default)]
    strict: bool,
    body: Option<String>,
    model: Option<String>,
    ball: Option<Ball>,
    massless: Option<Massless>,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Geometry {
    Visual,
    Collision,
}

#[derive(Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
enum Mesh {
    Glb,
    Stl,
    Obj,
}

/// Generates the URDD of a description among these files. `donor` is null, or the files of a URDD that this function made,
/// from which what did not change is taken. The question is a [`GenerateQuestion`] as JSON. The answer has the address of `files`,
/// those of the URDD, its `robot`, `modules`, and `notes`.
///
/// # Safety
/// `files` is open, as is `donor` unless it is null; the question is valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_generate(
    files: *mut Files,
    donor: *mut Files,
    question: *const u8,
    length: usize,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (files, donor, question) =
        unsafe { (&*files, donor.as_ref(), memory::bytes(question, length)) };
    answer::result(generate(files, donor, question))
}

fn generate(files: &Files, donor: Option<&Files>, question: &[u8]) -> Result<Value, String> {
    let question: GenerateQuestion =
        serde_json::from_slice(question).map_err(|error| error.to_string())?;
    let given = GivenFiles::of(files)?;
    let path = given.place(&question.path);
    let mut source = given.settings(&question.path)?;
    source.import = options(question.body, question.model, question.ball, question.massless);
    let mut settings = Settings {
        source,
        reference: question.reference,
        strict: question.strict,
        donors: donor.map(|donor| donor.root.clone()).into_iter().collect(),
        ..Settings::default()
    };
    if let Some(words) = &question.modules {
        let words = words.iter().map(String::as_str);
        settings.selection = Selection::parse(words).map_err(|error| error.to_string())?;
    }
    settings.preferred_geometry = match question.geometry {
        Some(Geometry::Collision) => GeometryKind::Collision,
        Some(Geometry::Visual) | None => GeometryKind::Visual,
    };
    if let Some(formats) = question.mesh_formats {
        let (stl, obj) = (formats.contains(&Mesh::Stl), formats.contains(&Mesh::Obj));
        settings.mesh_formats = MeshFormats { stl, obj };
    }
    let refused = |error: OutOfRange| error.to_string();
    if let Some(most) = question.pieces {
        settings.pieces.most = PIECES.check(most).map_err(refused)? as u8;
    }
    settings.pieces.tolerance = question.piece_tolerance;
    if let Some(count) = question.samples {
        settings.num_samples = SAMPLES.check(count).map_err(refused)? as u32;
    }
    settings.check().map_err(refused)?;
    let made = generate_in_memory(&path, &settings, &Told);
    let (made, files) = made.map_err(|error| error.to_string())?;
    let files = Files::address_of(&made.robot_name, files)?;
    Ok(said(&made, files))
}

fn said(made: &Generated, files: usize) -> Value {
    let modules: Vec<&str> = made.modules.iter().map(|module| module.kind.name()).collect();
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    json!({
        "files": files,
        "robot": made.robot_name,
        "links": made.num_links,
        "joints": made.num_joints,
        "dofs": made.num_dofs,
        "class": made.class,
        "modules": modules,
        "notes": notes,
    })
}

#[cfg(target_arch = "wasm32")]
#[link(wasm_import_module = "urdd")]
unsafe extern "C" {
    /// Tells the host of progress: JSON with `what`, `done` and `of`.
    fn progress(text: *const u8, length: usize);
}

/// Tells the host.
struct Told;

impl Told {
    fn tell(what: &str, done: usize, of: usize) {
        let text = json!({ "what": what, "done": done, "of": of }).to_string();
        #[cfg(target_arch = "wasm32")]
        // SAFETY: the host only reads the bytes, and does so before it returns.
        unsafe {
            progress(text.as_ptr(), text.len());
        }
        #[cfg(not(target_arch = "wasm32"))]
        drop(text);
    }
}

impl Progress for Told {
    fn module(&self, kind: ModuleKind, done: usize, total: usize) {
        Told::tell(kind.name(), done, total);
    }

    fn part(&self, kind: ModuleKind, done: usize, total: usize) {
        Told::tell(&format!("{}: step", kind.name()), done, total);
    }
}
