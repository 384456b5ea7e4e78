//! A URDD as a side.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use crate::dof_state;
use crate::shapes::{Place, Shapes, mesh_at, shapes};
use crate::side::{DiffError, Side};
use urdd_directory::account::Account;
use urdd_directory::layout::setup_beside;
use urdd_directory::limits::MAX_TOML_BYTES;
use urdd_directory::path::beside;
use urdd_directory::regular;
use urdd_document::mesh_files::MeshFiles;
use urdd_document::robot::{Robot, of_urdf};
use urdd_document::urdd::Urdd;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::{ModuleDocument, ModuleKind, Profile};
use urdd_format::report::Kind;
use urdd_format::urdf::Geometry;
use urdd_geometry::read::{Scene, read};
use urdd_source::beside::{Beside, Companion};
use urdd_xml::Xml;
use urdd_xml::other_parts::other_parts;

/// Reads the original meshes of a URDD. `xml` is its source URDF, if it has one.
///
/// # Errors
/// If it does not say what its robot is.
pub(super) fn open(
    urdd: Urdd,
    xml: Option<&Xml<'_>>,
    path: &Path,
    shown: String,
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
    let dofs = dof_state::of_urdd(&urdd, &view, &mut notes);
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
        account: Account::default(),
    })
}

/// What stands beside it for exports, if it is there.
fn setup(urdd: &Path) -> Option<Companion> {
    let path = setup_beside(urdd);
    path.symlink_metadata().ok()?;
    let bytes = regular::read(&path, MAX_TOML_BYTES).map_err(|error| error.to_string());
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
    let mut files: Vec<(Place, Result<File, String>)> = Vec::new();
    for (link, of) in view.links.iter().enumerate() {
        for kind in [GeometryKind::Visual, GeometryKind::Collision] {
            for (index, element) in of.elements(kind).iter().enumerate() {
                if let Some(Geometry::Mesh(mesh)) = &element.geometry {
                    let place = (link, kind, index);
                    // Published URDDs list visual meshes alone.
                    let path = paths.get(&place).or_else(|| by_name.get(mesh.filename.as_str()));
                    let missing = || "the URDD carries no such original mesh".to_owned();
                    files.push((place, path.cloned().ok_or_else(missing)));
                }
            }
        }
    }
    shapes(view, files, |(profile, path)| scene(urdd, *profile, path))
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
    let mut fetch = |named: &str| files.read(profile, &beside(path, named)?).ok();
    let scene = read(&bytes, name, &mut fetch).map_err(|error| error.to_string())?;
    Ok(Arc::new(scene))
}
