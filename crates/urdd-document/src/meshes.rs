//! Version-independent view of the mesh modules: the meshes of each link, with their paths and JSON Pointers.

use urdd_format::meshes::MeshFiles;
use urdd_format::plain_meshes::PlainMesh;
use urdd_format::registry::{ModuleDocument, ModuleKind, Profile};

/// The modules of derived meshes.
pub const DERIVED: &[ModuleKind] =
    &[ModuleKind::PlainMeshes, ModuleKind::ConvexHullMeshes, ModuleKind::ConvexDecompositionMeshes];

/// A mesh file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MeshFormat {
    /// Binary STL.
    Stl,
    /// Wavefront OBJ.
    Obj,
    /// Binary glTF.
    Glb,
}

impl MeshFormat {
    /// Every format.
    pub const ALL: [MeshFormat; 3] = [MeshFormat::Stl, MeshFormat::Obj, MeshFormat::Glb];

    /// Its file extension, also its folder and its key in version 1.
    pub fn extension(self) -> &'static str {
        match self {
            MeshFormat::Stl => "stl",
            MeshFormat::Obj => "obj",
            MeshFormat::Glb => "glb",
        }
    }
}

/// The meshes of a module.
#[derive(Debug, Clone)]
pub struct Meshes<'a> {
    /// The module.
    pub kind: ModuleKind,
    /// Its format family.
    pub profile: Profile,
    /// In version 1, one list whose meshes have all formats. In legacy versions, one list per format.
    pub lists: Vec<MeshList<'a>>,
}

/// A list with one entry per link.
#[derive(Debug, Clone)]
pub struct MeshList<'a> {
    /// Its key in the document.
    pub key: &'static str,
    /// Meshes of each link: none or one, or the pieces.
    pub links: Vec<Vec<Mesh<'a>>>,
}

/// A mesh, with one path per format.
#[derive(Debug, Clone)]
pub struct Mesh<'a> {
    /// Its paths.
    pub paths: Vec<MeshPath<'a>>,
}

/// A path to a mesh file.
#[derive(Debug, Clone)]
pub struct MeshPath<'a> {
    /// The path as written in the document.
    pub path: &'a str,
    /// JSON Pointer in the document.
    pub pointer: String,
    /// Its expected format; `None` for a mesh that the URDF names.
    pub format: Option<MeshFormat>,
}

impl<'a> Meshes<'a> {
    /// The meshes of a link in all lists.
    pub fn of_link(&self, link: usize) -> impl Iterator<Item = &Mesh<'a>> {
        self.lists.iter().filter_map(move |list| list.links.get(link)).flatten()
    }

    /// Number of meshes of a link in the first list.
    pub fn count(&self, link: usize) -> usize {
        let first = self.lists.first().and_then(|list| list.links.get(link));
        first.map_or(0, Vec::len)
    }

    /// Number of links in the first list.
    pub fn num_links(&self) -> usize {
        self.lists.first().map_or(0, |list| list.links.len())
    }

    /// JSON Pointer to a link's entry in the first list.
    pub fn pointer(&self, link: usize) -> String {
        let key = self.lists.first().map_or("", |list| list.key);
        format!("/{key}/{link}")
    }

    /// Every path with its link, list by list.
    pub fn paths(&self) -> impl Iterator<Item = (usize, &MeshPath<'a>)> {
        self.lists.iter().flat_map(|list| {
            list.links.iter().enumerate().flat_map(|(link, meshes)| {
                meshes.iter().flat_map(move |mesh| mesh.paths.iter().map(move |path| (link, path)))
            })
        })
    }
}

/// One list per format, as in legacy modules.
macro_rules! by_format {
    ($module:ident, $of_pieces:literal) => {
        by_format!($module, $of_pieces; stl_link_mesh_relative_paths Stl,
            obj_link_mesh_relative_paths Obj, glb_link_mesh_relative_paths Glb)
    };
    ($module:ident, $of_pieces:literal; $($field:ident $format:ident),*) => {
        vec![$(list(stringify!($field), $of_pieces, &$module.$field, |path, at| {
            one(path, at, Some(MeshFormat::$format))
        })),*]
    };
}

/// The view of a mesh module. `None` for `original_meshes_module` of version 1, which is not organised by link.
pub fn view(document: &ModuleDocument) -> Option<Meshes<'_>> {
    use ModuleDocument as Document;
    use ModuleKind::{ConvexDecompositionMeshes, ConvexHullMeshes, OriginalMeshes, PlainMeshes};
    let key = "link_mesh_relative_paths";
    let (kind, profile, lists) = match document {
        Document::PlainMeshes(module) => {
            let list = list("link_meshes", false, &module.link_meshes, |mesh, at| {
                let mesh: &PlainMesh = mesh;
                three(&mesh.files, at + "/files")
            });
            (PlainMeshes, Profile::V1, vec![list])
        }
        Document::ConvexHullMeshes(module) => {
            let list = list("link_hulls", false, &module.link_hulls, three);
            (ConvexHullMeshes, Profile::V1, vec![list])
        }
        Document::ConvexDecompositionMeshes(module) => {
            let list = list("link_pieces", true, &module.link_pieces, three);
            (ConvexDecompositionMeshes, Profile::V1, vec![list])
        }
        Document::LegacyPlainMeshes(module) => {
            (PlainMeshes, Profile::Legacy, by_format!(module, false))
        }
        Document::LegacyConvexHullMeshes(module) => {
            (ConvexHullMeshes, Profile::Legacy, by_format!(module, false))
        }
        Document::LegacyConvexDecompositionMeshes(module) => {
            (ConvexDecompositionMeshes, Profile::Legacy, by_format!(module, true))
        }
        Document::LegacyOriginalMeshes(module) => {
            let paths = &module.link_mesh_relative_paths;
            let list = list(key, false, paths, |path, at| one(path, at, None));
            (OriginalMeshes, Profile::Legacy, vec![list])
        }
        Document::LegacyOriginalMeshLists(module) => {
            let paths = &module.link_mesh_relative_paths;
            let list = list(key, true, paths, |path, at| one(path, at, None));
            (OriginalMeshes, Profile::Legacy, vec![list])
        }
        _ => return None,
    };
    Some(Meshes { kind, profile, lists })
}

/// A list of the document: an option or, with `of_pieces`, a list for each link. `mesh` reads an entry, given its
/// pointer.
fn list<'a, E: 'a, L>(
    key: &'static str,
    of_pieces: bool,
    entries: &'a [L],
    mesh: impl Fn(&'a E, String) -> Mesh<'a>,
) -> MeshList<'a>
where
    &'a L: IntoIterator<Item = &'a E>,
{
    let of_link = |(link, own): (usize, &'a L)| {
        let own = own.into_iter().enumerate();
        let pointer = |piece| {
            if of_pieces { format!("/{key}/{link}/{piece}") } else { format!("/{key}/{link}") }
        };
        own.map(|(piece, entry)| mesh(entry, pointer(piece))).collect()
    };
    MeshList { key, links: entries.iter().enumerate().map(of_link).collect() }
}

fn three(files: &MeshFiles, at: String) -> Mesh<'_> {
    let each = [
        (MeshFormat::Stl, files.stl.as_ref()),
        (MeshFormat::Obj, files.obj.as_ref()),
        (MeshFormat::Glb, Some(&files.glb)),
    ];
    let given = each.into_iter().filter_map(|(format, path)| {
        Some(MeshPath {
            path: path?,
            pointer: format!("{at}/{}", format.extension()),
            format: Some(format),
        })
    });
    Mesh { paths: given.collect() }
}

fn one(path: &str, pointer: String, format: Option<MeshFormat>) -> Mesh<'_> {
    Mesh { paths: vec![MeshPath { path, pointer, format }] }
}
