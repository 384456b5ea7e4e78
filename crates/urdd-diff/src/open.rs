//! Opens a robot of either kind, and validates it.

use std::path::Path;
use std::sync::Arc;

use crate::shapes::shapes;
use crate::side::{DiffError, Options, Side};
use crate::{dof_state, side_urdd};
use urdd_directory::account::Account;
use urdd_directory::discover::{Found, discover};
use urdd_directory::path;
use urdd_directory::root::{ReadError, Root};
use urdd_document::load::Loaded;
use urdd_document::robot::of_urdf;
use urdd_document::urdd::Urdd;
use urdd_format::report::{self, Kind};
use urdd_source::{Files, RobotFile, robot_file};
use urdd_validate::settings::Settings;
use urdd_validate::{Run, ValidateError, alone, examine_urdf, found, validate, validate_loaded};
use urdd_xml::Xml;
use urdd_xml::other_parts::other_parts;

impl Side {
    /// Opens a URDF, a xacro file, an MJCF, SDF or USD as the URDF that it becomes, or a URDD: a folder or a zip archive. The
    /// content says which it is, before the name.
    ///
    /// # Errors
    /// If the path has no robot, or one that cannot be read.
    pub fn open(path: &Path, options: &Options) -> Result<Side, DiffError> {
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
        let mut side = side_urdd::open(Urdd::new(Arc::clone(&loaded)), xml, path, shown)?;
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
    let settings = Settings { cancellation: options.cancellation.clone(), ..Settings::default() };
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
    let opened = urdd_import::open(path, &options.urdf, &options.cancellation, also);
    let (source, (other_parts, examined)) = opened.map_err(DiffError::Urdf)?;
    let view = of_urdf(&source.robot);
    let files = source.meshes.iter().map(|mesh| {
        let place = (mesh.link, mesh.geometry, mesh.element);
        (place, mesh.file.clone().map_err(|why| why.reason))
    });
    Ok(Side {
        kind: Kind::Urdf,
        dofs: dof_state::of_robot(&view),
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
        account: Account::default(),
    })
}
