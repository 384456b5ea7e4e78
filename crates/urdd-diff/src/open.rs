//! Opens a robot of either kind, and validates it.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use urdd_directory::discover::{Found, discover};
use urdd_directory::file_type::setup_beside;
use urdd_directory::limits::MAX_SETUP_BYTES;
use urdd_directory::path;
use urdd_directory::regular;
use urdd_directory::root::{ReadError, Root};
use urdd_document::load::Loaded;
use urdd_document::mesh_files::MeshFiles;
use urdd_document::robot::{Robot, of_urdf};
use urdd_document::urdd::Urdd;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::{ModuleDocument, ModuleKind, Profile};
use urdd_format::report::{self, Kind};
use urdd_format::urdf::Geometry;
use urdd_geometry::read::{Scene, read};
use urdd_source::beside::{Beside, Companion};
use urdd_source::{Files, RobotFile, Settings as SourceSettings, robot_file};
use urdd_validate::settings::Settings;
use urdd_validate::{Run, ValidateError, alone, examine_urdf, found, validate, validate_loaded};
use urdd_xml::Xml;
use urdd_xml::other_parts::other_parts;

use crate::shapes::{Place, Shapes, elements, mesh_at, shapes};
use crate::side::{self, DiffError, Options, Side};

impl Side {
    /// Opens a URDF, a xacro file, an MJCF, SDF or USD as the URDF that it becomes, or a URDD: a folder or a zip archive. The
    /// content says which it is, before the name.
    ///
    /// # Errors
    /// If the path has no robot, or one that cannot be read.
    pub fn open(path: &Path, options: &Options) -> Result<Side, DiffError> {
        // All that is made of a robot is of one account.
        let account = Some(options.urdf.run_account());
        let urdf = SourceSettings { account, ..options.urdf.clone() };
        Side::within(path, &Options { urdf, ..*options })
    }

    fn within(path: &Path, options: &Options) -> Result<Side, DiffError> {
        let shown = path.display().to_string();
        let is_there = !path.is_dir() && path.exists();
        match robot_file(path, &Files::Disk).filter(|_| is_there) {
            Some(RobotFile::Srdf) | None => {}
            Some(is) => return open_urdf(path, is, options),
        }
        let found = discover(path).map_err(DiffError::Discover)?;
        let found = match found.as_slice() {
            [one] => one,
            several => {
                let first = several.first().map(|found| found.path.display().to_string());
                return Err(DiffError::Several {
                    path: shown,
                    count: several.len(),
                    first: first.unwrap_or_default(),
                });
            }
        };
        let Found { path, name, closed } = found;
        let failed = |error: &ReadError| {
            let reason = error.to_string();
            DiffError::NoRobot { path: shown.clone(), reason }
        };
        if let Some(error) = closed {
            return Err(failed(error));
        }
        // All that is compared is of one moment, also where a program writes to the folder meanwhile.
        let loaded = Root::open(path).and_then(|root| Loaded::read(root.kept()));
        let loaded = Arc::new(loaded.map_err(|error| failed(&error))?);
        let xml = loaded.urdf.as_ref().ok().map(|urdf| Xml::new(&urdf.text));
        let xml = xml.as_ref();
        let mut side = open_urdd(Urdd::new(Arc::clone(&loaded)), xml, path, shown, &options.urdf)?;
        side.validation = validation(options, |settings| {
            validate_loaded(Arc::clone(&loaded), name, settings, xml)
        })?;
        Ok(side)
    }
}

fn validation(
    options: &Options,
    validate: impl FnOnce(&Settings) -> Result<Run, ValidateError>,
) -> Result<Option<report::Urdd>, DiffError> {
    if options.without_findings {
        return Ok(None);
    }
    let settings =
        Settings { cancellation: options.urdf.cancellation.clone(), ..Settings::default() };
    let run = validate(&settings).map_err(|error| match error {
        ValidateError::Discover(error) => DiffError::Discover(error),
        _ => DiffError::Cancelled,
    })?;
    Ok(run.report.urdds.into_iter().next())
}

/// Opens a URDF, or what becomes one, and reads its meshes.
fn open_urdf(path: &Path, is: RobotFile, options: &Options) -> Result<Side, DiffError> {
    let shown = path.display().to_string();
    // The validator reads a URDF as it is written.
    let as_written = is == RobotFile::Urdf && !options.urdf.xacro.expand_urdf;
    let name = if as_written { found(path).name } else { shown.clone() };
    let also = |xml: &Xml<'_>, is_as_found: bool| {
        let is_read = !as_written || is_as_found && path::check(&name).is_ok();
        let is_validated = !options.without_findings && is_read;
        (other_parts(xml), is_validated.then(|| examine_urdf(xml, &name)))
    };
    let opened = urdd_import::open(path, &options.urdf, also);
    let (source, (other_parts, examined)) = opened.map_err(DiffError::Urdf)?;
    let view = of_urdf(&source.robot);
    let files = source.meshes.iter().map(|mesh| {
        let place = (mesh.link, mesh.geometry, mesh.element);
        (place, mesh.file.clone().map_err(|why| why.reason))
    });
    Ok(Side {
        kind: Kind::Urdf,
        dofs: side::of_robot(&view),
        other_parts: Some(other_parts),
        shapes: shapes(&view, files.collect(), |file| source.read(file)),
        view,
        beside: source.beside(path),
        loops: source.loops.map(|said| said.file),
        robot: source.robot,
        urdd: None,
        validation: validation(options, |settings| match examined {
            Some(examined) => {
                settings.cancellation.check()?;
                Ok(alone(examined, path.to_owned(), settings))
            }
            None => validate(&[path], settings),
        })?,
        path: shown,
        notes: Vec::new(),
        account: options.urdf.run_account(),
    })
}

/// Reads the original meshes of a URDD. `xml` is its source URDF, if it has one.
///
/// # Errors
/// If it does not say what its robot is.
fn open_urdd(
    urdd: Urdd,
    xml: Option<&Xml<'_>>,
    path: &Path,
    shown: String,
    settings: &SourceSettings,
) -> Result<Side, DiffError> {
    let robot = match urdd.description() {
        Some(module) => module.clone(),
        None => {
            let module = urdd.module(ModuleKind::Urdf);
            let reason = module.and_then(|module| {
                let fault = module.first_fault();
                fault.or_else(|| Some(module.unusable()?.to_string()))
            });
            let missing = || "urdf_module is missing, which says what the robot is".to_owned();
            let reason = reason.unwrap_or_else(missing);
            return Err(DiffError::NoRobot { path: shown, reason });
        }
    };
    let view = of_urdf(&robot);
    let mut notes = Vec::new();
    let dofs = side::of_urdd(&urdd, &view, &mut notes);
    Ok(Side {
        path: shown,
        kind: Kind::Urdd,
        dofs,
        other_parts: xml.map(other_parts),
        shapes: read_shapes(&urdd, &view),
        view,
        robot,
        urdd: Some(urdd),
        validation: None,
        beside: Beside { setup: setup(path), ..Beside::default() },
        loops: None,
        notes,
        account: settings.run_account(),
    })
}

/// What stands beside it for exports, if it is there.
fn setup(urdd: &Path) -> Option<Companion> {
    let path = setup_beside(urdd);
    path.symlink_metadata().ok()?;
    let bytes = regular::read(&path, MAX_SETUP_BYTES).map_err(|error| error.to_string());
    Some(bytes.and_then(|bytes| String::from_utf8(bytes).map_err(|_| "it is not UTF-8".to_owned())))
}

/// A mesh file of a URDD, by its path as the module has it.
type File = (Profile, String);

fn read_shapes(urdd: &Urdd, view: &Robot) -> Shapes {
    let paths = paths(urdd, view);
    let by_name: HashMap<&str, File> = paths
        .iter()
        .filter_map(|(place, file)| {
            let (_, mesh) = mesh_at(view, *place)?;
            Some((mesh.filename.as_str(), file.clone()))
        })
        .collect();
    let files = elements(view).filter_map(|(place, element)| {
        let Some(Geometry::Mesh(mesh)) = &element.geometry else { return None };
        // Published URDDs list visual meshes alone.
        let path = paths.get(&place).or_else(|| by_name.get(mesh.filename.as_str()));
        let missing = || "the URDD carries no such original mesh".to_owned();
        Some((place, path.cloned().ok_or_else(missing)))
    });
    shapes(view, files.collect(), |(profile, path)| scene(urdd, *profile, path))
}

/// The path of each mesh element, as `original_meshes_module` has it.
fn paths(urdd: &Urdd, view: &Robot) -> HashMap<Place, File> {
    let mut paths = HashMap::new();
    if let Some(ModuleDocument::OriginalMeshes(module)) = urdd.document(ModuleKind::OriginalMeshes)
    {
        for reference in &module.references {
            let place = (reference.link_idx.get(), reference.geometry, reference.element_idx.get());
            if let Some(path) = &reference.path {
                paths.insert(place, (Profile::V1, path.clone()));
            }
        }
        return paths;
    }
    let Some(meshes) = urdd.meshes(ModuleKind::OriginalMeshes) else { return paths };
    for list in &meshes.lists {
        for (link, meshes) in list.links.iter().enumerate() {
            let Some(of) = view.links.get(link) else { continue };
            let visual = of.visual.iter().enumerate();
            let named = visual.filter(|(_, v)| matches!(v.geometry, Some(Geometry::Mesh(_))));
            for ((index, _), mesh) in named.zip(meshes) {
                if let Some(path) = mesh.paths.first() {
                    let place = (link, GeometryKind::Visual, index);
                    paths.insert(place, (Profile::Legacy, path.path.to_owned()));
                }
            }
        }
    }
    paths
}

/// Reads a mesh file. Files that it names are read from the URDD alone.
fn scene(urdd: &Urdd, profile: Profile, path: &str) -> Result<Arc<Scene>, String> {
    let mut files = MeshFiles::new(urdd);
    let bytes = files.read(profile, path);
    let bytes = bytes.map_err(|absence| format!("{path}: {absence}"))?;
    let name = path.rsplit('/').next().unwrap_or(path);
    let mut fetch = |named: &str| files.read(profile, &path::beside(path, named)?).ok();
    let scene = read(&bytes, name, &mut fetch).map_err(|error| error.to_string())?;
    Ok(Arc::new(scene))
}
