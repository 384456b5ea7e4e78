//! Opens a URDF.

use std::path::Path;

use crate::dof_state;
use crate::shapes::shapes;
use crate::side::{DiffError, Options, Side};
use urdd_directory::account::Account;
use urdd_document::robot::of_urdf;
use urdd_format::report::Kind;
use urdd_xml::other_parts::other_parts;

/// Opens a URDF and reads its meshes. Gives its text too.
///
/// # Errors
/// If it cannot be read or is not a valid robot.
pub(super) fn open(
    path: &Path,
    shown: String,
    options: &Options,
) -> Result<(Side, String), DiffError> {
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
