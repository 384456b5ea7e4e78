//! Every path in the documents of a URDD, independent of module and version.

use super::module::Module;
use super::urdd::Urdd;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::path::{self, PathFault};
use urdd_format::meshes::MeshFiles;
use urdd_format::registry::{ModuleDocument, Profile};
use urdd_format::root_metadata::{RootMetadata, Source};

/// What a path refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PathRole {
    /// The source URDF (`urdd.json`).
    Source,
    /// The folder of a module (`urdd.json`).
    ModuleFolder,
    /// A file of a module, listed with size and hash (`urdd.json`).
    ModuleFile,
    /// An original mesh, in the module's list of files.
    OriginalMesh,
    /// A file that an original mesh refers to.
    SideFile,
    /// An original mesh, at an element that uses it (version 1).
    MeshReference,
    /// A derived mesh in STL.
    Stl,
    /// A derived mesh in OBJ.
    Obj,
    /// A derived mesh in glTF.
    Glb,
}

/// A path in a document.
#[derive(Clone)]
pub struct NamedPath<'a> {
    /// The module with the document; `None` for `urdd.json`.
    pub module: Option<&'a Module>,
    /// JSON Pointer in the document.
    pub pointer: String,
    /// The path as written: relative to the root, or in legacy modules to the parent folder of the root.
    pub path: &'a str,
    /// What it refers to.
    pub role: PathRole,
}

/// Where a path leads, judged by its text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place<'a> {
    /// A path within the root.
    Here(&'a str),
    /// A path within a sibling URDD (legacy).
    Sibling {
        /// Name of the sibling's folder.
        folder: &'a str,
        /// The path within that folder.
        path: &'a str,
    },
    /// An invalid path.
    Nowhere(PathFault),
}

impl<'a> NamedPath<'a> {
    /// The document's file, relative to the root.
    pub fn file(&self) -> String {
        match self.module {
            Some(module) => module.file("module.json"),
            None => ROOT_METADATA.to_owned(),
        }
    }

    /// Whether the path is relative to the parent folder of the root, as in legacy modules.
    pub fn from_parent(&self) -> bool {
        self.module
            .and_then(|module| module.spec)
            .is_some_and(|spec| spec.profile == Profile::Legacy)
    }

    /// Where the path leads.
    pub fn place(&self, urdd: &Urdd) -> Place<'a> {
        if let Err(fault) = path::check(self.path) {
            return Place::Nowhere(fault);
        }
        if !self.from_parent() {
            return Place::Here(self.path);
        }
        match self.path.split_once('/') {
            Some((folder, path)) if folder == urdd.root().folder_name() => Place::Here(path),
            Some((folder, path)) => Place::Sibling { folder, path },
            None => Place::Sibling {
                folder: self.path,
                path: "",
            },
        }
    }
}

/// Every path in `urdd.json` and the modules' documents, in document order. Skips documents that break their schema.
pub fn all(urdd: &Urdd) -> Vec<NamedPath<'_>> {
    let mut paths = match urdd.metadata() {
        Some(metadata) => of_metadata(metadata),
        None => Vec::new(),
    };
    for module in urdd.modules() {
        paths.extend(of_module(module));
    }
    paths
}

/// Every path in `urdd.json`.
pub fn of_metadata(metadata: &RootMetadata) -> Vec<NamedPath<'_>> {
    let mut paths = Paths::default();
    if let Some(Source::Urdf(file)) = &metadata.source {
        paths.add("/source/Urdf/path".to_owned(), &file.path, PathRole::Source);
    }
    for (m, module) in metadata.modules.iter().enumerate() {
        let pointer = format!("/modules/{m}/path");
        paths.add(pointer, &module.path, PathRole::ModuleFolder);
        for (f, file) in module.files.iter().enumerate() {
            let pointer = format!("/modules/{m}/files/{f}/path");
            paths.add(pointer, &file.path, PathRole::ModuleFile);
        }
    }
    paths.0
}

/// Every path in a module's document.
pub fn of_module(module: &Module) -> Vec<NamedPath<'_>> {
    let mut paths = Paths::default();
    if let Some(document) = &module.document {
        paths.add_document(document);
    }
    for path in &mut paths.0 {
        path.module = Some(module);
    }
    paths.0
}

#[derive(Default)]
struct Paths<'a>(Vec<NamedPath<'a>>);

impl<'a> Paths<'a> {
    fn add(&mut self, pointer: String, path: &'a str, role: PathRole) {
        self.0.push(NamedPath {
            module: None,
            pointer,
            path,
            role,
        });
    }

    fn add_document(&mut self, document: &'a ModuleDocument) {
        use ModuleDocument as Document;
        match document {
            Document::OriginalMeshes(module) => {
                for (i, reference) in module.references.iter().enumerate() {
                    if let Some(path) = &reference.path {
                        let pointer = format!("/references/{i}/path");
                        self.add(pointer, path, PathRole::MeshReference);
                    }
                }
                for (i, mesh) in module.files.iter().enumerate() {
                    let pointer = format!("/files/{i}/path");
                    self.add(pointer, &mesh.path, PathRole::OriginalMesh);
                    for (j, side) in mesh.side_files.iter().enumerate() {
                        let pointer = format!("/files/{i}/side_files/{j}");
                        self.add(pointer, side, PathRole::SideFile);
                    }
                }
            }
            Document::PlainMeshes(module) => {
                for (i, mesh) in module.link_meshes.iter().enumerate() {
                    if let Some(mesh) = mesh {
                        self.add_mesh(&format!("/link_meshes/{i}/files"), &mesh.files);
                    }
                }
            }
            Document::ConvexHullMeshes(module) => {
                for (i, hull) in module.link_hulls.iter().enumerate() {
                    if let Some(files) = hull {
                        self.add_mesh(&format!("/link_hulls/{i}"), files);
                    }
                }
            }
            Document::ConvexDecompositionMeshes(module) => {
                for (i, pieces) in module.link_pieces.iter().enumerate() {
                    for (j, files) in pieces.iter().enumerate() {
                        self.add_mesh(&format!("/link_pieces/{i}/{j}"), files);
                    }
                }
            }
            Document::LegacyOriginalMeshes(module) => {
                let list = &module.link_mesh_relative_paths;
                self.add_optional("link_mesh", list, PathRole::OriginalMesh);
            }
            Document::LegacyOriginalMeshLists(module) => {
                let lists = &module.link_mesh_relative_paths;
                self.add_lists("link_mesh", lists, PathRole::OriginalMesh);
            }
            Document::LegacyPlainMeshes(module) => self.add_legacy_meshes(
                &module.stl_link_mesh_relative_paths,
                &module.obj_link_mesh_relative_paths,
                &module.glb_link_mesh_relative_paths,
            ),
            Document::LegacyConvexHullMeshes(module) => self.add_legacy_meshes(
                &module.stl_link_mesh_relative_paths,
                &module.obj_link_mesh_relative_paths,
                &module.glb_link_mesh_relative_paths,
            ),
            Document::LegacyConvexDecompositionMeshes(module) => {
                for (name, lists, role) in [
                    (
                        "stl_link_mesh",
                        &module.stl_link_mesh_relative_paths,
                        PathRole::Stl,
                    ),
                    (
                        "obj_link_mesh",
                        &module.obj_link_mesh_relative_paths,
                        PathRole::Obj,
                    ),
                    (
                        "glb_link_mesh",
                        &module.glb_link_mesh_relative_paths,
                        PathRole::Glb,
                    ),
                ] {
                    self.add_lists(name, lists, role);
                }
            }
            _ => {}
        }
    }

    fn add_mesh(&mut self, pointer: &str, files: &'a MeshFiles) {
        if let Some(stl) = &files.stl {
            self.add(format!("{pointer}/stl"), stl, PathRole::Stl);
        }
        if let Some(obj) = &files.obj {
            self.add(format!("{pointer}/obj"), obj, PathRole::Obj);
        }
        self.add(format!("{pointer}/glb"), &files.glb, PathRole::Glb);
    }

    fn add_legacy_meshes(
        &mut self,
        stl: &'a [Option<String>],
        obj: &'a [Option<String>],
        glb: &'a [Option<String>],
    ) {
        self.add_optional("stl_link_mesh", stl, PathRole::Stl);
        self.add_optional("obj_link_mesh", obj, PathRole::Obj);
        self.add_optional("glb_link_mesh", glb, PathRole::Glb);
    }

    fn add_optional(&mut self, name: &str, list: &'a [Option<String>], role: PathRole) {
        for (i, path) in list.iter().enumerate() {
            if let Some(path) = path {
                self.add(format!("/{name}_relative_paths/{i}"), path, role);
            }
        }
    }

    fn add_lists(&mut self, name: &str, lists: &'a [Vec<String>], role: PathRole) {
        for (i, list) in lists.iter().enumerate() {
            for (j, path) in list.iter().enumerate() {
                self.add(format!("/{name}_relative_paths/{i}/{j}"), path, role);
            }
        }
    }
}
