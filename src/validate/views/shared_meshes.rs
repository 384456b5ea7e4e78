//! Derived mesh files that several links name.

use std::collections::{BTreeSet, HashMap};

use crate::document::meshes::DERIVED;
use crate::document::urdd::Urdd;
use crate::format::legacy::urdf as legacy;
use crate::format::registry::{ModuleDocument, ModuleKind, Profile};

/// A file that two entries of a mesh module name.
pub struct SharedMesh {
    /// The module.
    pub kind: ModuleKind,
    /// The link whose entry comes first, and the pointer of that entry.
    pub first: (usize, String),
    /// The other link, and the pointer of its entry.
    pub other: (usize, String),
    /// The path, as written.
    pub path: String,
    /// Whether the file is right for both: both place the very same mesh in the same way. Only
    /// legacy URDDs may share so.
    pub alike: bool,
}

/// Every pair of links of a module that share a file, once, however many formats and pieces they
/// share.
pub fn all(urdd: &Urdd) -> Vec<SharedMesh> {
    let mut shared = Vec::new();
    for kind in DERIVED {
        let Some(meshes) = urdd.meshes(*kind) else {
            continue;
        };
        let mut first_use: HashMap<&str, (usize, &str)> = HashMap::new();
        let mut told: BTreeSet<(usize, usize, bool)> = BTreeSet::new();
        for (link, mesh) in meshes.paths() {
            let Some((first, first_pointer)) = first_use.get(mesh.path).copied() else {
                first_use.insert(mesh.path, (link, &mesh.pointer));
                continue;
            };
            let alike = meshes.profile == Profile::Legacy
                && first != link
                && same_piece(*kind, first_pointer, &mesh.pointer)
                && placed_alike(urdd, first, link);
            if told.insert((first, link, alike)) {
                shared.push(SharedMesh {
                    kind: *kind,
                    first: (first, first_pointer.to_owned()),
                    other: (link, mesh.pointer.clone()),
                    path: mesh.path.to_owned(),
                    alike,
                });
            }
        }
    }
    shared
}

/// Whether two places stand for the same piece of two links.
fn same_piece(kind: ModuleKind, a: &str, b: &str) -> bool {
    kind != ModuleKind::ConvexDecompositionMeshes || a.rsplit('/').next() == b.rsplit('/').next()
}

/// Whether two links of a legacy URDD place the same meshes in the same way.
fn placed_alike(urdd: &Urdd, a: usize, b: usize) -> bool {
    let Some(ModuleDocument::LegacyUrdf(urdf)) = urdd.document(ModuleKind::Urdf) else {
        return false;
    };
    let (Some(a), Some(b)) = (urdf.links.get(a), urdf.links.get(b)) else {
        return false;
    };
    let (a, b) = (placements(a), placements(b));
    !a.is_empty() && a == b
}

/// The meshes that a link shows: origin, file, scale.
fn placements(link: &legacy::Link) -> Vec<(&legacy::Origin, &str, [f64; 3])> {
    let meshes = link
        .visual
        .iter()
        .filter_map(|visual| match &visual.geometry {
            legacy::Geometry::Mesh(mesh) => Some((
                &visual.origin,
                mesh.filename.as_str(),
                mesh.scale.unwrap_or([1.0; 3]),
            )),
            _ => None,
        });
    meshes.collect()
}
