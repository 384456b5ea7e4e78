//! Version-independent view of the mesh modules: the meshes of each link, with their paths and JSON Pointers.

use urdd_format::legacy;
use urdd_format::meshes::MeshFiles;
use urdd_format::registry::{ModuleDocument, ModuleKind, Profile};

/// The modules of derived meshes.
pub const DERIVED: &[ModuleKind] = &[
    ModuleKind::PlainMeshes,
    ModuleKind::ConvexHullMeshes,
    ModuleKind::ConvexDecompositionMeshes,
];

/// A mesh file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// Binary STL.
    Stl,
    /// Wavefront OBJ.
    Obj,
    /// Binary glTF.
    Glb,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 3] = [Format::Stl, Format::Obj, Format::Glb];

    /// Its file extension, also its folder and its key in version 1.
    pub fn extension(self) -> &'static str {
        match self {
            Format::Stl => "stl",
            Format::Obj => "obj",
            Format::Glb => "glb",
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
    pub format: Option<Format>,
}

impl<'a> Meshes<'a> {
    /// The meshes of a link in all lists.
    pub fn of_link(&self, link: usize) -> impl Iterator<Item = &Mesh<'a>> {
        self.lists
            .iter()
            .filter_map(move |list| list.links.get(link))
            .flatten()
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
                meshes
                    .iter()
                    .flat_map(move |mesh| mesh.paths.iter().map(move |path| (link, path)))
            })
        })
    }
}

/// The view of a mesh module. `None` for `original_meshes_module` of version 1, which is not organised by link.
pub fn view(document: &ModuleDocument) -> Option<Meshes<'_>> {
    let (kind, profile, lists) = match document {
        ModuleDocument::PlainMeshes(module) => {
            let meshes = module.link_meshes.iter().enumerate().map(|(link, mesh)| {
                let at = format!("/link_meshes/{link}/files");
                mesh.iter().map(|mesh| three(&mesh.files, &at)).collect()
            });
            let list = MeshList {
                key: "link_meshes",
                links: meshes.collect(),
            };
            (ModuleKind::PlainMeshes, Profile::V1, vec![list])
        }
        ModuleDocument::ConvexHullMeshes(module) => {
            let hulls = module.link_hulls.iter().enumerate().map(|(link, hull)| {
                let at = format!("/link_hulls/{link}");
                hull.iter().map(|files| three(files, &at)).collect()
            });
            let list = MeshList {
                key: "link_hulls",
                links: hulls.collect(),
            };
            (ModuleKind::ConvexHullMeshes, Profile::V1, vec![list])
        }
        ModuleDocument::ConvexDecompositionMeshes(module) => {
            let pieces = module.link_pieces.iter().enumerate().map(|(link, pieces)| {
                let pieces = pieces.iter().enumerate();
                pieces
                    .map(|(piece, files)| three(files, &format!("/link_pieces/{link}/{piece}")))
                    .collect()
            });
            let list = MeshList {
                key: "link_pieces",
                links: pieces.collect(),
            };
            (
                ModuleKind::ConvexDecompositionMeshes,
                Profile::V1,
                vec![list],
            )
        }
        ModuleDocument::LegacyPlainMeshes(module) => {
            let legacy::plain_meshes::PlainMeshesModule {
                stl_link_mesh_relative_paths: stl,
                obj_link_mesh_relative_paths: obj,
                glb_link_mesh_relative_paths: glb,
            } = module.as_ref();
            (
                ModuleKind::PlainMeshes,
                Profile::Legacy,
                by_format([stl, obj, glb]),
            )
        }
        ModuleDocument::LegacyConvexHullMeshes(module) => {
            let legacy::convex_hull_meshes::ConvexHullMeshesModule {
                stl_link_mesh_relative_paths: stl,
                obj_link_mesh_relative_paths: obj,
                glb_link_mesh_relative_paths: glb,
            } = module.as_ref();
            (
                ModuleKind::ConvexHullMeshes,
                Profile::Legacy,
                by_format([stl, obj, glb]),
            )
        }
        ModuleDocument::LegacyConvexDecompositionMeshes(module) => {
            let lists = [
                (Format::Stl, &module.stl_link_mesh_relative_paths),
                (Format::Obj, &module.obj_link_mesh_relative_paths),
                (Format::Glb, &module.glb_link_mesh_relative_paths),
            ];
            (
                ModuleKind::ConvexDecompositionMeshes,
                Profile::Legacy,
                lists
                    .into_iter()
                    .map(|(format, list)| many(legacy_key(format), Some(format), list))
                    .collect(),
            )
        }
        ModuleDocument::LegacyOriginalMeshes(module) => (
            ModuleKind::OriginalMeshes,
            Profile::Legacy,
            vec![one(
                "link_mesh_relative_paths",
                None,
                &module.link_mesh_relative_paths,
            )],
        ),
        ModuleDocument::LegacyOriginalMeshLists(module) => (
            ModuleKind::OriginalMeshes,
            Profile::Legacy,
            vec![many(
                "link_mesh_relative_paths",
                None,
                &module.link_mesh_relative_paths,
            )],
        ),
        _ => return None,
    };
    Some(Meshes {
        kind,
        profile,
        lists,
    })
}

fn legacy_key(format: Format) -> &'static str {
    match format {
        Format::Stl => "stl_link_mesh_relative_paths",
        Format::Obj => "obj_link_mesh_relative_paths",
        Format::Glb => "glb_link_mesh_relative_paths",
    }
}

fn three<'a>(files: &'a MeshFiles, at: &str) -> Mesh<'a> {
    let each = [
        (Format::Stl, files.stl.as_ref()),
        (Format::Obj, files.obj.as_ref()),
        (Format::Glb, Some(&files.glb)),
    ];
    let given = each.into_iter().filter_map(|(format, path)| {
        Some(MeshPath {
            path: path?,
            pointer: format!("{at}/{}", format.extension()),
            format: Some(format),
        })
    });
    Mesh {
        paths: given.collect(),
    }
}

fn by_format(lists: [&Vec<Option<String>>; 3]) -> Vec<MeshList<'_>> {
    Format::ALL
        .into_iter()
        .zip(lists)
        .map(|(format, list)| one(legacy_key(format), Some(format), list))
        .collect()
}

fn one<'a>(key: &'static str, format: Option<Format>, list: &'a [Option<String>]) -> MeshList<'a> {
    let single = |(link, path): (usize, &'a Option<String>)| {
        path.iter()
            .map(|path| single_path(path, format!("/{key}/{link}"), format))
            .collect()
    };
    MeshList {
        key,
        links: list.iter().enumerate().map(single).collect(),
    }
}

fn many<'a>(key: &'static str, format: Option<Format>, list: &'a [Vec<String>]) -> MeshList<'a> {
    let several = |(link, paths): (usize, &'a Vec<String>)| {
        let paths = paths.iter().enumerate();
        paths
            .map(|(piece, path)| single_path(path, format!("/{key}/{link}/{piece}"), format))
            .collect()
    };
    MeshList {
        key,
        links: list.iter().enumerate().map(several).collect(),
    }
}

fn single_path(path: &str, pointer: String, format: Option<Format>) -> Mesh<'_> {
    Mesh {
        paths: vec![MeshPath {
            path,
            pointer,
            format,
        }],
    }
}
