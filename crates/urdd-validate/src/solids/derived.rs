//! The meshes derived for links: plain meshes, hulls and convex pieces, each in three formats.

use std::collections::HashMap;

use rayon::prelude::*;

use super::file::{self, MeshFault};
use crate::tolerance::mesh_resolution;
use urdd_document::mesh_files::MeshFiles;
use urdd_document::meshes::{MeshFormat, MeshPath, Meshes};
use urdd_document::urdd::Urdd;
use urdd_findings::finding::point;
use urdd_format::readable::metres;
use urdd_format::registry::{ModuleKind, Profile};
use urdd_geometry::Mesh;
use urdd_geometry::read::Format as Content;
use urdd_geometry::surface::{self, Difference, Likeness};

/// A mesh of a link, or one of its pieces.
#[derive(Debug)]
pub struct Derived {
    pub link: usize,
    /// Its index among the pieces; 0 in modules with one mesh per link.
    pub piece: usize,
    /// Its files, with their faults.
    pub files: Vec<DerivedFile>,
    /// The content of its first sound file, otherwise of its first readable one. Metres, in the link's frame.
    pub mesh: Option<Mesh>,
    /// Index of that file.
    pub mesh_of: usize,
    /// The differences of other files from it, by index.
    pub differences: Vec<(usize, Difference)>,
}

impl Derived {
    /// The mesh, if all its files are sound and equal.
    pub fn sound(&self) -> Option<&Mesh> {
        let sound = self.differences.is_empty() && self.files.iter().all(|f| f.fault.is_none());
        self.mesh.as_ref().filter(|_| sound)
    }

    /// The mesh of copies of its files, which are sound.
    fn copied(&self, link: usize, piece: usize, paths: &[&MeshPath]) -> Derived {
        let paths = paths.iter().filter(|path| path.format.is_some());
        let files = self.files.iter().zip(paths).map(|(file, path)| DerivedFile {
            path: path.path.to_owned(),
            pointer: path.pointer.clone(),
            ..file.clone()
        });
        Derived {
            link,
            piece,
            files: files.collect(),
            mesh: self.mesh.clone(),
            mesh_of: self.mesh_of,
            differences: Vec::new(),
        }
    }

    /// Its JSON Pointer: in version 1 of the object with its files, in legacy modules of the entry in the first
    /// format's list.
    pub fn pointer(&self) -> &str {
        let first = self.files.first().map_or("", |file| &file.pointer);
        match first.rsplit_once('/') {
            Some((entry, "stl" | "obj" | "glb")) => entry,
            _ => first,
        }
    }
}

#[derive(Debug, Clone)]
pub struct DerivedFile {
    /// Its path, as written.
    pub path: String,
    /// Its JSON Pointer.
    pub pointer: String,
    /// The format that it should have.
    pub format: MeshFormat,
    /// The format of its content; `None` if it is not a mesh.
    pub content: Option<Content>,
    /// Its fault. MSH010 reports that of a `.glb` whose header or chunks are wrong.
    pub fault: Option<MeshFault>,
    /// Whether it is a `.glb` whose header or chunks are wrong.
    pub not_glb: bool,
}

/// Reads the meshes of a module, in order of links and pieces.
pub fn read_all(urdd: &Urdd, meshes: &Meshes) -> Vec<Derived> {
    let mut places: Vec<(usize, usize, Vec<&MeshPath>)> = Vec::new();
    for link in 0..meshes.num_links() {
        let pieces = meshes.lists.iter().filter_map(|list| list.links.get(link));
        let most = pieces.clone().map(Vec::len).max().unwrap_or(0);
        for piece in 0..most {
            // One list in version 1, one list per format in legacy modules.
            let paths = pieces.clone().filter_map(|list| list.get(piece));
            let paths: Vec<&MeshPath> = paths.flat_map(|mesh| &mesh.paths).collect();
            places.push((link, piece, paths));
        }
    }
    let profile = meshes.profile;
    let sizes = places.par_iter().map_init(
        || MeshFiles::new(urdd),
        |files, (_, _, paths)| {
            let size = |path: &&MeshPath| files.open(profile, path.path).map(|(_, size)| size);
            let sizes: Result<Vec<u64>, _> = paths.iter().map(size).collect();
            sizes.ok()
        },
    );
    let sizes: Vec<Option<Vec<u64>>> = sizes.collect();
    // Files of the same sizes may be copies, whose meshes need not be read again.
    let mut groups: HashMap<(usize, Option<Vec<u64>>), Vec<usize>> = HashMap::new();
    for (at, sizes) in sizes.into_iter().enumerate() {
        let alone = if sizes.is_none() { at } else { 0 };
        groups.entry((alone, sizes)).or_default().push(at);
    }
    let read = groups.into_par_iter().flat_map_iter(|(_, group)| {
        let mut files = MeshFiles::new(urdd);
        let mut done: Vec<(usize, Derived)> = Vec::with_capacity(group.len());
        for at in group {
            let (link, piece, paths) = &places[at];
            let known = done.iter().take(MAX_COMPARED).find(|(other, derived)| {
                derived.sound().is_some()
                    && are_copies(&mut files, profile, &places[*other].2, paths)
            });
            let derived = match known {
                Some((_, known)) => known.copied(*link, *piece, paths),
                None => read(&mut files, profile, *link, *piece, paths),
            };
            done.push((at, derived));
        }
        done
    });
    let mut read: Vec<(usize, Derived)> = read.collect();
    read.sort_unstable_by_key(|(at, _)| *at);
    read.into_iter().map(|(_, derived)| derived).collect()
}

/// Number of meshes of the same sizes that a mesh is compared with.
const MAX_COMPARED: usize = 8;

/// Whether two lists of files have the same formats and contents.
fn are_copies(files: &mut MeshFiles, profile: Profile, a: &[&MeshPath], b: &[&MeshPath]) -> bool {
    let mut bytes = |path: &MeshPath| file::read_bytes(files, profile, path.path).ok();
    a.len() == b.len()
        && a.iter().zip(b).all(|(a, b)| {
            let end = |path: &str| path.rsplit_once('.').map(|(_, end)| end.to_owned());
            let alike = a.format == b.format && end(a.path) == end(b.path);
            alike && bytes(a).is_some_and(|one| bytes(b).is_some_and(|other| one == other))
        })
}

fn read(
    files: &mut MeshFiles,
    profile: Profile,
    link: usize,
    piece: usize,
    paths: &[&MeshPath],
) -> Derived {
    let mut derived = Derived {
        link,
        piece,
        files: Vec::with_capacity(paths.len()),
        mesh: None,
        mesh_of: 0,
        differences: Vec::new(),
    };
    let mut meshes: Vec<(usize, Mesh)> = Vec::new();
    for path in paths {
        let Some(format) = path.format else { continue };
        let mut file = DerivedFile {
            path: path.path.to_owned(),
            pointer: path.pointer.clone(),
            format,
            content: None,
            fault: None,
            not_glb: false,
        };
        let read = file::read_bytes(files, profile, path.path).and_then(|bytes| {
            file.not_glb = format == MeshFormat::Glb
                && matches!(file::glb_fault(&bytes[..], bytes.len() as u64), Ok(Some(_)));
            let (scene, fault) = file::derived(&bytes, path.path, profile)?;
            let of_stl = profile == Profile::V1 && scene.format == Content::StlBinary;
            let fault = fault.or_else(|| file::stl_fault(&bytes).filter(|_| of_stl));
            Ok((scene, fault))
        });
        match read {
            Err(fault) => file.fault = Some(fault),
            Ok((scene, fault)) => {
                file.content = Some(scene.format);
                file.fault = fault.map(MeshFault::Broken);
                if scene.triangle_count() > 0 {
                    meshes.push((derived.files.len(), scene.merged()));
                }
            }
        }
        derived.files.push(file);
    }
    let sound = |(at, _): &(usize, Mesh)| derived.files[*at].fault.is_none();
    // Among sound files that store binary32 exactly, the one with the fewest vertices: an STL file has three for each
    // triangle.
    let exact = |(at, _): &(usize, Mesh)| derived.files[*at].format != MeshFormat::Obj;
    let order = |(_, of): &(usize, &(usize, Mesh))| (!sound(of), !exact(of), of.1.vertices.len());
    let Some((first, _)) = meshes.iter().enumerate().min_by_key(order) else { return derived };
    let (mesh_of, mesh) = meshes.swap_remove(first);
    meshes.sort_by_key(|(at, _)| *at);
    let tolerance = mesh_resolution(surface::extent(&mesh));
    for (at, other) in &meshes {
        // The fault of a broken file is enough.
        if derived.files[*at].fault.is_none() {
            let difference = surface::difference(&mesh, other, tolerance, Likeness::SameTriangles);
            derived.differences.extend(Some((*at, difference)).filter(|(_, of)| of.is_any()));
        }
    }
    derived.mesh_of = mesh_of;
    derived.mesh = Some(mesh);
    derived
}

/// The name of a module's meshes in messages.
pub fn noun(kind: ModuleKind) -> &'static str {
    match kind {
        ModuleKind::ConvexHullMeshes => "hull",
        ModuleKind::ConvexDecompositionMeshes => "piece",
        _ => "mesh",
    }
}

pub fn in_words(difference: &Difference) -> String {
    let counts = [
        (difference.missing, "missing"),
        (difference.extra.len(), "too many"),
        (difference.turned, "turned round"),
    ];
    let parts = counts.into_iter().filter_map(|(count, what)| match count {
        0 => None,
        1 => Some(format!("1 triangle {what}")),
        _ => Some(format!("{count} triangles {what}")),
    });
    let mut text = parts.collect::<Vec<_>>().join(", ");
    if difference.distance > 0.0 {
        text += &format!(", corners {} apart", metres(difference.distance));
    }
    text + &format!(", first at {}", point(difference.place))
}
