//! Opens a robot of either kind, and validates it.

use std::path::Path;
use std::sync::Arc;

use crate::shapes::shapes;
use crate::side::{DiffError, Options, Side};
use crate::{dof_state, side_urdd};
use urdd_directory::account::Account;
use urdd_directory::discover::{Found, discover};
use urdd_directory::file_type::FileType;
use urdd_directory::root::{ReadError, Root};
use urdd_document::load::Loaded;
use urdd_document::robot::of_urdf;
use urdd_document::urdd::Urdd;
use urdd_format::report::{self, Kind};
use urdd_source::{Files, format_of};
use urdd_validate::settings::Settings;
use urdd_validate::{Run, ValidateError, examine_urdf, validate, validate_loaded};
use urdd_xml::Xml;
use urdd_xml::other_parts::other_parts;

impl Side {
    /// Opens a URDF (a file whose name ends in `.urdf`), a xacro file, an MJCF or an SDF as the URDF that it becomes, or a URDD: a
    /// folder or a zip archive.
    ///
    /// # Errors
    /// If the path has no robot, or one that cannot be read.
    pub fn open(path: &Path, options: &Options) -> Result<Side, DiffError> {
        let shown = path.display().to_string();
        let is_urdf = FileType::Urdf.is_of(path) && !path.is_dir();
        // The validator reads what is written.
        let is_expanded = options.urdf.xacro.expand_urdf;
        if is_urdf && path.exists() && !is_expanded {
            let (mut side, _) = open_urdf(path, shown, options)?;
            side.validation = validation(options, |settings| validate(&[path], settings))?;
            return Ok(side);
        }
        let is_xacro = FileType::Xacro.is_of(path) && path.is_file();
        if is_urdf && path.exists() || is_xacro || format_of(path, &Files::Disk).is_some() {
            let (mut side, text) = open_urdf(path, shown, options)?;
            side.validation = validation(options, |settings| {
                let examined = vec![examine_urdf(&Xml::new(&text), &side.path)];
                Ok(Run::of(examined, vec![path.to_owned()], 0, settings))
            })?;
            return Ok(side);
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
        let mut side = side_urdd::open(Urdd::new(Arc::clone(&loaded)), path, shown)?;
        side.validation = validation(options, |settings| validate_loaded(loaded, name, settings))?;
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

/// Opens a URDF and reads its meshes. Gives its text too.
fn open_urdf(path: &Path, shown: String, options: &Options) -> Result<(Side, String), DiffError> {
    let source =
        urdd_import::open(path, &options.urdf, &options.cancellation).map_err(DiffError::Urdf)?;
    let view = of_urdf(&source.robot);
    let files = source.meshes.iter().map(|mesh| {
        let place = (mesh.link, mesh.geometry, mesh.element);
        (place, mesh.file.clone().map_err(|why| why.reason))
    });
    let shapes = shapes(&view, files.collect(), |file| source.read(file));
    let side = Side {
        path: shown,
        kind: Kind::Urdf,
        dofs: dof_state::of_robot(&view),
        other_parts: Some(other_parts(&source.text)),
        view,
        shapes,
        beside: source.beside(path),
        robot: source.robot,
        urdd: None,
        validation: None,
        notes: Vec::new(),
        account: Account::default(),
    };
    Ok((side, source.text))
}
