//! Derived mesh files that several links name.

use std::collections::{BTreeMap, HashMap};

use urdd_document::meshes::{DERIVED, MeshPath, Meshes};
use urdd_document::urdd::Urdd;
use urdd_findings::part::Part;
use urdd_format::registry::{ModuleKind, Profile};
use urdd_format::urdf::{Geometry, Link, Origin};

/// A file that two entries of a mesh module name.
pub struct SharedMesh {
    pub kind: ModuleKind,
    /// The link of the first entry, and its pointer.
    pub first: (usize, String),
    /// The link of the other entry, and its pointer.
    pub other: (usize, String),
    /// The path, as written.
    pub path: String,
    /// Every mesh of the two that shares a file with the other.
    pub parts: Vec<Part>,
    /// Whether the file is right for both, because both place the same mesh in the same way. Only possible in legacy
    /// URDDs.
    pub alike: bool,
}

/// Every pair of links of a module that share a file, once, regardless of the number of formats and pieces.
pub fn all(urdd: &Urdd) -> Vec<SharedMesh> {
    let mut shared: Vec<SharedMesh> = Vec::new();
    for kind in DERIVED {
        let Some(meshes) = urdd.meshes(*kind) else { continue };
        let mut first_use: HashMap<&str, Use> = HashMap::new();
        // Index in `shared`, by links and by whether they share alike.
        let mut by_links: BTreeMap<(usize, usize, bool), usize> = BTreeMap::new();
        for (link, piece, path) in places(&meshes) {
            let Some(&(first, first_piece, first_path)) = first_use.get(path.path) else {
                first_use.insert(path.path, (link, piece, path));
                continue;
            };
            let alike = meshes.profile == Profile::Legacy
                && first != link
                && first_piece == piece
                && placed_alike(urdd, first, link);
            let at = *by_links.entry((first, link, alike)).or_insert_with(|| {
                shared.push(SharedMesh {
                    kind: *kind,
                    first: (first, first_path.pointer.clone()),
                    other: (link, path.pointer.clone()),
                    path: path.path.to_owned(),
                    parts: Vec::new(),
                    alike,
                });
                shared.len() - 1
            });
            let both = [(first, first_piece), (link, piece)];
            let parts = both.map(|(link, piece)| Part::of(*kind, link, piece));
            shared[at].parts.extend(parts.into_iter().flatten());
        }
    }
    shared
}

/// A path of a module, with its link and piece.
type Use<'a> = (usize, usize, &'a MeshPath<'a>);

/// Every path of a module, with its link and piece.
fn places<'a>(meshes: &'a Meshes<'a>) -> impl Iterator<Item = Use<'a>> {
    let links = meshes.lists.iter().flat_map(|list| list.links.iter().enumerate());
    let pieces = links.flat_map(|(link, pieces)| {
        let pieces = pieces.iter().enumerate();
        pieces.map(move |(piece, mesh)| (link, piece, mesh))
    });
    pieces.flat_map(|(link, piece, mesh)| mesh.paths.iter().map(move |path| (link, piece, path)))
}

/// Whether two links of a legacy URDD place the same meshes in the same way.
fn placed_alike(urdd: &Urdd, a: usize, b: usize) -> bool {
    let Some(urdf) = urdd.description().filter(|_| urdd.is_legacy(ModuleKind::Urdf)) else {
        return false;
    };
    let (Some(a), Some(b)) = (urdf.links.get(a), urdf.links.get(b)) else { return false };
    let (a, b) = (placements(a), placements(b));
    !a.is_empty() && a == b
}

/// The meshes that a link shows: origin, file, scale.
fn placements(link: &Link) -> Vec<(&Option<Origin>, &str, [f64; 3])> {
    let meshes = link.visual.iter().filter_map(|visual| match &visual.geometry {
        Some(Geometry::Mesh(mesh)) => {
            Some((&visual.origin, mesh.filename.as_str(), mesh.scale.unwrap_or([1.0; 3])))
        }
        _ => None,
    });
    meshes.collect()
}
