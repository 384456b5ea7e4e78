//! Uses a URDD from before version 1 as a part. Its URDF names meshes in packages that do not exist here; its
//! `original_meshes_module` contains the meshes of visual elements. If one is missing, the link's plain mesh replaces
//! it.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use urdd_xml::Document;

use super::error::PartFault;
use super::names::mesh_edits;
use super::sources::document;
use urdd_directory::file_type::FileType;
use urdd_directory::root::Root;
use urdd_format::legacy::meshes::PlainMeshesModule;
use urdd_format::meshes::GeometryKind;
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::{Geometry, Link, Mesh};
use urdd_source::{MAX_SOURCE_BYTES, named, read_urdf};
use urdd_xml::element::{Edit, apply, attribute, children};
use urdd_xml::{Kind, parse};

/// The URDF in a legacy URDD.
pub(super) struct Carried {
    pub file: String,
    pub found: Vec<u8>,
    /// Its text, with mesh names that refer to the URDD's files, relative to its folder.
    pub text: Vec<u8>,
    /// Links that use their plain mesh because the original is missing.
    pub plain_meshes: Vec<String>,
}

/// Reads the URDF of the legacy URDD in `folder`. Opens nothing outside that folder.
pub(super) fn read(folder: &Path) -> Result<Carried, PartFault> {
    let file = urdf_in(folder).ok_or_else(PartFault::no_urdf)?;
    let root = Root::open_folder(folder).map_err(|e| PartFault::unreadable(&file, e))?;
    let found = root.read(&file, MAX_SOURCE_BYTES).map_err(|e| PartFault::unreadable(&file, e))?;
    let robot = read_urdf(&found, "robot").map_err(|e| PartFault::unreadable(&file, e))?;
    let text = String::from_utf8(robot.carried).map_err(|e| PartFault::unreadable(&file, e))?;
    let links = &robot.robot.links;
    let is_there = |place: &str| root.open_file(place).is_ok();
    let mut places = BTreeMap::new();
    let visual = named(&robot.robot).into_iter();
    for mesh in visual.filter(|mesh| mesh.geometry == GeometryKind::Visual) {
        let name = last_component(mesh.filename.trim());
        let place = format!("{}/meshes/{name}", ModuleKind::OriginalMeshes.folder());
        if !name.is_empty() && is_there(&place) {
            places.insert(mesh.filename.to_owned(), place);
        }
    }
    let document = parse(&text, Kind::Robot)
        .map_err(|error| PartFault::unreadable(&file, error.words(&text)))?;
    let mut edits = mesh_edits(&document, &places);
    let mut plain = plain_meshes(&root);
    plain.retain(|idx, place| {
        let mesh = links.get(*idx).and_then(only_mesh);
        mesh.is_some_and(|mesh| !places.contains_key(&mesh.filename)) && is_there(place)
    });
    edits.extend(plain_edits(&document, &plain));
    Ok(Carried {
        text: apply(&text, edits).into_bytes(),
        plain_meshes: plain.keys().map(|idx| links[*idx].name.clone()).collect(),
        found,
        file,
    })
}

/// The file name of the only URDF in the folder of a legacy URDD.
fn urdf_in(folder: &Path) -> Option<String> {
    let entries = fs::read_dir(folder).ok()?;
    let files = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut urdfs = files.filter(|file| FileType::Urdf.is_of(Path::new(file)));
    let first = urdfs.next()?;
    urdfs.next().is_none().then_some(first)
}

fn last_component(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or_default()
}

/// The mesh of a link with only one visual element and no scale: the converter ignored scales.
fn only_mesh(link: &Link) -> Option<&Mesh> {
    let [visual] = link.visual.as_slice() else { return None };
    match &visual.geometry {
        Some(Geometry::Mesh(mesh)) if mesh.scale.is_none_or(|scale| scale == [1.0; 3]) => {
            Some(mesh)
        }
        _ => None,
    }
}

/// The plain mesh of each link, in the link's frame. Links whose plain meshes share a file name are left out: the
/// converter overwrote one with the other.
fn plain_meshes(root: &Root) -> BTreeMap<usize, String> {
    let folder = ModuleKind::PlainMeshes.folder();
    let module = document(root, &format!("{folder}/module.json"));
    let paths = module.map_or_else(
        |_| Vec::new(),
        |(module, _): (PlainMeshesModule, _)| module.stl_link_mesh_relative_paths,
    );
    let named = paths
        .iter()
        .enumerate()
        .filter_map(|(idx, path)| Some((idx, last_component(path.as_ref()?))));
    let mut links_of: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (idx, name) in named {
        links_of.entry(name).or_default().push(idx);
    }
    let own = links_of.into_iter().filter(|(_, links)| links.len() == 1);
    own.map(|(name, links)| (links[0], format!("{folder}/meshes/stl/{name}"))).collect()
}

/// The edits that make links use their plain meshes, in which the origins are already applied.
fn plain_edits(document: &Document, plain: &BTreeMap<usize, String>) -> Vec<Edit> {
    let links = children(document.root_element()).filter(|(tag, _)| *tag == "link");
    let mut edits = Vec::new();
    for (idx, (_, link)) in links.enumerate() {
        let Some(place) = plain.get(&idx) else { continue };
        let visuals = children(link).filter(|(tag, _)| *tag == "visual");
        for (tag, element) in visuals.flat_map(|(_, visual)| children(visual)) {
            if tag == "origin" {
                let (range, text) = (element.range(), String::new());
                edits.push(Edit { range, text });
            }
            let meshes = children(element).filter(|(tag, _)| *tag == "mesh");
            for found in meshes.filter_map(|(_, mesh)| attribute(mesh, "filename")) {
                let (range, text) = (found.range_value(), super::names::escaped(place));
                edits.push(Edit { range, text });
            }
        }
    }
    edits
}
