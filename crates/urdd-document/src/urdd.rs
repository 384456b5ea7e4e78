//! A loaded URDD of any version, and the modules that its `urdd.json` lists, with their folders.

use std::collections::{HashMap, HashSet};
use std::sync::{Arc, OnceLock};

use crate::load::Loaded;
use crate::meshes::{self, Meshes};
use crate::module::{CarriedUrdf, MetadataFile, Module, NoUrdf, is_extension};
use crate::robot::{DofLayout, Robot, of_urdf};
use crate::tree::{Mechanism, Mimics, RigidGroups, Tree};
use urdd_directory::path;
use urdd_directory::root::{EntryKind, Listing, ReadError, Root};
use urdd_format::bounds::BoundsModule;
use urdd_format::chain::ChainModule;
use urdd_format::connections::ConnectionsModule;
use urdd_format::dof::DofModule;
use urdd_format::registry::{self, ModuleDocument, ModuleKind, Profile};
use urdd_format::root_metadata::{ModuleEntry, RootMetadata};
use urdd_format::urdf::UrdfModule;

/// Accessors of modules that legacy documents are raised to.
macro_rules! documents {
    ($($(#[$doc:meta])* $name:ident -> $kind:ident($type:ty);)*) => {$(
        $(#[$doc])*
        pub fn $name(&self) -> Option<&$type> {
            match self.document(ModuleKind::$kind)? {
                ModuleDocument::$kind(module) => Some(module),
                _ => None,
            }
        }
    )*};
}

/// A loaded URDD, with version-independent views.
///
/// A URDD describes its robot twice, in `urdf_module` and in the source URDF. [`Urdd::robot`] and the data derived from
/// it use `urdf_module`, unless [`Urdd::with_robot`] replaced the robot.
pub struct Urdd {
    loaded: Arc<Loaded>,
    is_by_urdf: bool,
    mechanism: OnceLock<Option<Mechanism>>,
    dof_layout: OnceLock<Option<DofLayout>>,
}

impl Urdd {
    /// Reads the URDD in a folder or a zip archive.
    ///
    /// # Errors
    /// If the folder or the archive cannot be opened or listed.
    pub fn read(path: &std::path::Path) -> Result<Self, ReadError> {
        Self::of(Root::open(path)?)
    }

    /// Reads the URDD at a root.
    ///
    /// # Errors
    /// If the root cannot be listed.
    pub fn of(root: Root) -> Result<Self, ReadError> {
        Ok(Urdd::new(Arc::new(Loaded::read(root)?)))
    }

    /// Views of a URDD in memory.
    pub fn new(loaded: Arc<Loaded>) -> Self {
        Urdd { loaded, is_by_urdf: false, mechanism: OnceLock::new(), dof_layout: OnceLock::new() }
    }

    /// The same URDD with the robot of its source URDF.
    pub fn with_robot(&self, robot: Robot) -> Self {
        Urdd {
            is_by_urdf: true,
            mechanism: OnceLock::from(Some(Mechanism::new(robot))),
            ..Urdd::new(Arc::clone(&self.loaded))
        }
    }

    /// Whether [`Urdd::robot`] is that of the source URDF.
    pub fn is_by_urdf(&self) -> bool {
        self.is_by_urdf
    }

    /// The root folder.
    pub fn root(&self) -> &Root {
        &self.loaded.root
    }

    /// The files and folders below the root.
    pub fn listing(&self) -> &Listing {
        &self.loaded.listing
    }

    /// The format family of the URDD.
    pub fn profile(&self) -> Profile {
        self.loaded.profile
    }

    /// The file of the root metadata, as far as it is readable.
    pub fn metadata_file(&self) -> &MetadataFile {
        &self.loaded.metadata
    }

    /// The root metadata.
    pub fn metadata(&self) -> Option<&RootMetadata> {
        self.loaded.metadata.metadata.as_ref()
    }

    /// The source URDF, or why it is not available.
    pub fn urdf(&self) -> Result<&CarriedUrdf, &NoUrdf> {
        self.loaded.urdf.as_ref()
    }

    /// Every module folder.
    pub fn modules(&self) -> impl ExactSizeIterator<Item = &Module> {
        self.loaded.modules.iter().map(|module| &**module)
    }

    /// The module folder of a module.
    pub fn module(&self, kind: ModuleKind) -> Option<&Module> {
        self.modules().find(|module| module.kind == Some(kind))
    }

    /// The document of a module, if it fits its schema. That of a legacy module is one of version 1 where it can be.
    pub fn document(&self, kind: ModuleKind) -> Option<&ModuleDocument> {
        self.module(kind)?.document.as_ref()
    }

    /// As [`Urdd::document`], but only of a module of version 1.
    pub fn document_v1(&self, kind: ModuleKind) -> Option<&ModuleDocument> {
        self.document(kind).filter(|_| !self.is_legacy(kind))
    }

    /// Whether a module's version is from before the specification.
    pub fn is_legacy(&self, kind: ModuleKind) -> bool {
        self.module(kind).is_some_and(Module::is_legacy)
    }

    documents! {
        /// The content of `urdf_module`.
        description -> Urdf(UrdfModule);
        /// The content of `dof_module`. A legacy module has no mimics and no descriptions of its DOFs.
        dofs -> Dof(DofModule);
        /// The content of `chain_module`. The joints of a legacy module have no motion: see [`crate::consumer`].
        chain -> Chain(ChainModule);
        /// The content of `connections_module`. A legacy module has only `link_connection_paths`.
        connections -> Connections(ConnectionsModule);
        /// The content of `bounds_module`. A legacy module has only bounds.
        bounds -> Bounds(BoundsModule);
    }

    /// [`Urdd::robot`] with what follows from it.
    pub fn mechanism(&self) -> Option<&Mechanism> {
        let make = || self.description().map(|module| Mechanism::new(of_urdf(module)));
        self.mechanism.get_or_init(make).as_ref()
    }

    /// The robot of `urdf_module` in any version, or that of the source URDF ([`Urdd::with_robot`]).
    pub fn robot(&self) -> Option<&Robot> {
        self.mechanism().map(Mechanism::robot)
    }

    /// The kinematic tree of [`Urdd::robot`]; `None` if its joints do not form a tree.
    pub fn tree(&self) -> Option<&Tree> {
        self.mechanism()?.tree()
    }

    /// The rigid groups of [`Urdd::robot`]; `None` if its joints do not form a tree.
    pub fn rigid_groups(&self) -> Option<&RigidGroups> {
        self.mechanism()?.rigid_groups()
    }

    /// The resolved mimic joints of [`Urdd::robot`]; `None` if they cannot be resolved.
    pub fn mimics(&self) -> Option<&Mimics> {
        self.mechanism()?.mimics()
    }

    /// The degrees of freedom of [`Urdd::robot`], as `dof_module` of the present version should define them.
    pub fn dof_layout(&self) -> Option<&DofLayout> {
        // The first published version gave mimic joints their own DOFs (SPEC 10.5).
        let version = || self.module(ModuleKind::Dof)?.version.as_deref();
        let make = || Some(DofLayout::new(self.robot()?, version() == Some("0.0.1")));
        self.dof_layout.get_or_init(make).as_ref()
    }

    /// View of a mesh module in any version. `None` for `original_meshes_module` of version 1, which is not organised
    /// by link.
    pub fn meshes(&self, kind: ModuleKind) -> Option<Meshes<'_>> {
        meshes::view(self.document(kind)?)
    }

    /// A link in messages: its index, and its name if known.
    pub fn link_label(&self, link: usize) -> String {
        match self.robot().and_then(|robot| robot.links.get(link)) {
            Some(named) => format!("link {link} (`{}`)", named.name),
            None => format!("link {link}"),
        }
    }
}

/// The files of every module (2.4) and every extension (11.1).
pub const MODULE_FILES: [&str; 3] = ["VERSION", "module.json", "module.yaml"];

/// An entry of `modules` of `urdd.json`.
pub struct Entry<'a> {
    /// Its index in `modules`.
    pub index: usize,
    /// Its content.
    pub entry: &'a ModuleEntry,
    /// The module of this specification with its name, or else with its path.
    pub kind: Option<ModuleKind>,
    /// The module folder at its path, if it exists.
    pub module: Option<&'a Module>,
}

impl Entry<'_> {
    /// JSON Pointer to one of its keys.
    pub fn pointer(&self, key: &str) -> String {
        format!("/modules/{}/{key}", self.index)
    }

    /// Whether a listed file has a fault that another rule reports: an invalid path, a missing file, or a duplicate.
    pub fn has_faulty_file(&self, urdd: &Urdd) -> bool {
        let mut seen = HashSet::new();
        self.entry.files.iter().any(|file| {
            path::check(&file.path).is_err()
                || !seen.insert(file.path.as_str())
                || look(urdd, &file.path).is_err()
        })
    }

    /// Whether a path is inside its folder.
    pub fn holds(&self, path: &str) -> bool {
        path.strip_prefix(self.entry.path.as_str()).is_some_and(|rest| rest.starts_with('/'))
    }
}

/// Every entry, in order. Empty if the root metadata is unusable.
pub fn all(urdd: &Urdd) -> Vec<Entry<'_>> {
    let Some(metadata) = urdd.metadata() else {
        return Vec::new();
    };
    let modules: HashMap<&str, &Module> =
        urdd.modules().map(|module| (module.folder.as_str(), module)).collect();
    let by_name: HashMap<&str, ModuleKind> =
        version_1_kinds().map(|kind| (kind.name(), kind)).collect();
    let by_folder: HashMap<&str, ModuleKind> =
        version_1_kinds().map(|kind| (kind.folder(), kind)).collect();
    let entries = metadata.modules.iter().enumerate().map(|(index, entry)| {
        let (name, path) = (entry.name.as_str(), entry.path.as_str());
        let kind = by_name.get(name).or_else(|| by_folder.get(path)).copied();
        Entry { index, entry, kind, module: modules.get(path).copied() }
    });
    entries.collect()
}

/// The modules of this specification.
pub fn version_1_kinds() -> impl Iterator<Item = ModuleKind> {
    ModuleKind::ALL.iter().copied().filter(|kind| has_version_1(*kind))
}

fn has_version_1(kind: ModuleKind) -> bool {
    registry::modules().iter().any(|spec| spec.kind == kind && spec.profile == Profile::V1)
}

/// Whether a module folder is a module of this specification (in a legacy URDD: or of earlier versions), or an
/// extension. Only DIR022 reports other folders.
pub fn is_known(urdd: &Urdd, module: &Module) -> bool {
    match module.kind {
        Some(kind) => urdd.profile() == Profile::Legacy || has_version_1(kind),
        None => is_extension(&module.folder),
    }
}

/// The module folders that the rules check.
pub fn known_modules(urdd: &Urdd) -> impl Iterator<Item = &Module> {
    urdd.modules().filter(|module| is_known(urdd, module))
}

/// The size of the regular file at a path. Does not check whether a listed file can be opened.
///
/// # Errors
/// Why there is no such file.
pub fn look(urdd: &Urdd, path: &str) -> Result<u64, ReadError> {
    path::check(path)?;
    let listing = urdd.listing();
    if let Some(entry) = listing.get(path) {
        return match entry.kind {
            EntryKind::File => Ok(entry.size),
            EntryKind::LinkOut => Err(ReadError::LeavesRoot),
            EntryKind::Folder | EntryKind::Other => Err(ReadError::NotAFile),
            EntryKind::Link => urdd.root().open_file(path).map(|(_, size)| size),
        };
    }
    // An unlisted file may still exist below a folder link, or beyond the point where the listing stopped.
    let mut above =
        std::iter::successors(Some(path), |path| path.rsplit_once('/').map(|(parent, _)| parent));
    let nearest = above.find_map(|folder| listing.get(folder));
    let below_link =
        nearest.is_some_and(|entry| matches!(entry.kind, EntryKind::Link | EntryKind::LinkOut));
    if below_link || listing.cut || !listing.unreadable.is_empty() {
        return urdd.root().open_file(path).map(|(_, size)| size);
    }
    Err(ReadError::Missing)
}
