//! A URDD of any version, loaded, in one shape.

use std::sync::{Arc, OnceLock};

use super::bounds::{self, Bounds};
use super::carried_urdf::{CarriedUrdf, NoUrdf};
use super::chain::{self, Chain};
use super::connections::{self, Connections};
use super::dof_layout::DofLayout;
use super::dofs::{self, Dofs};
use super::load::Loaded;
use super::meshes::{self, Meshes};
use super::mimics::Mimics;
use super::module::{MetadataFile, Module};
use super::rigid_groups::RigidGroups;
use super::robot::{self, Robot};
use super::tree::Tree;
use urdd_directory::root::{Listing, ReadError, Root};
use urdd_format::registry::{ModuleDocument, ModuleKind, Profile};
use urdd_format::root_metadata::RootMetadata;

/// A URDD that was loaded, and views of it that do not depend on its version.
///
/// A URDD describes its robot twice, in `urdf_module` and in the carried URDF. [`Urdd::robot`] and
/// what follows from it are those of `urdf_module`, unless [`Urdd::with_robot`] put another there.
pub struct Urdd {
    loaded: Arc<Loaded>,
    robot_from: RobotFrom,
    robot: OnceLock<Option<Robot>>,
    tree: OnceLock<Option<Tree>>,
    mimics: OnceLock<Option<Mimics>>,
    dof_layout: OnceLock<Option<DofLayout>>,
    rigid_groups: OnceLock<Option<RigidGroups>>,
}

/// Where a robot's description comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RobotFrom {
    /// `urdf_module`.
    UrdfModule,
    /// The carried URDF.
    CarriedUrdf,
}

impl Urdd {
    /// Reads the URDD in a folder or a zip archive.
    ///
    /// # Errors
    /// Where the folder or the archive cannot be opened or listed.
    pub fn read(path: &std::path::Path) -> Result<Self, ReadError> {
        Self::of(Root::open(path)?)
    }

    /// Reads the URDD at a root.
    ///
    /// # Errors
    /// Where the root cannot be listed.
    pub fn of(root: Root) -> Result<Self, ReadError> {
        Ok(Urdd::new(Arc::new(Loaded::read(root)?)))
    }

    /// For what was loaded.
    pub fn new(loaded: Arc<Loaded>) -> Self {
        Urdd {
            loaded,
            robot_from: RobotFrom::UrdfModule,
            robot: OnceLock::new(),
            tree: OnceLock::new(),
            mimics: OnceLock::new(),
            dof_layout: OnceLock::new(),
            rigid_groups: OnceLock::new(),
        }
    }

    /// The same URDD with the robot as its carried URDF describes it.
    pub fn with_robot(&self, robot: Robot) -> Self {
        Urdd {
            robot_from: RobotFrom::CarriedUrdf,
            robot: OnceLock::from(Some(robot)),
            ..Urdd::new(Arc::clone(&self.loaded))
        }
    }

    /// Where [`Urdd::robot`] comes from.
    pub fn robot_from(&self) -> RobotFrom {
        self.robot_from
    }

    /// The file that the robot is read from.
    pub fn robot_file(&self) -> Option<String> {
        match self.robot_from {
            RobotFrom::CarriedUrdf => Some(self.urdf().ok()?.path.clone()),
            RobotFrom::UrdfModule => Some(self.module(ModuleKind::Urdf)?.file("module.json")),
        }
    }

    /// The root folder.
    pub fn root(&self) -> &Root {
        &self.loaded.root
    }

    /// What lies in the root folder.
    pub fn listing(&self) -> &Listing {
        &self.loaded.listing
    }

    /// The family of formats that the URDD follows.
    pub fn profile(&self) -> Profile {
        self.loaded.profile
    }

    /// The root metadata's file, as far as it could be read.
    pub fn metadata_file(&self) -> &MetadataFile {
        &self.loaded.metadata
    }

    /// The root metadata.
    pub fn metadata(&self) -> Option<&RootMetadata> {
        self.loaded.metadata.metadata.as_ref()
    }

    /// The source URDF, or why there is none to look at.
    pub fn urdf(&self) -> Result<&CarriedUrdf, &NoUrdf> {
        self.loaded.urdf.as_ref()
    }

    /// Every module folder.
    pub fn modules(&self) -> &[Module] {
        &self.loaded.modules
    }

    /// The folder of a module.
    pub fn module(&self, kind: ModuleKind) -> Option<&Module> {
        self.loaded
            .modules
            .iter()
            .find(|module| module.kind == Some(kind))
    }

    /// The document of a module, where it fits its schema.
    pub fn document(&self, kind: ModuleKind) -> Option<&ModuleDocument> {
        self.module(kind)?.document.as_ref()
    }

    /// The robot: as `urdf_module` has it, whatever the module's version, or as the carried URDF
    /// has it ([`Urdd::with_robot`]).
    pub fn robot(&self) -> Option<&Robot> {
        let make = || robot::view(self.document(ModuleKind::Urdf)?);
        self.robot.get_or_init(make).as_ref()
    }

    /// The kinematic tree of [`Urdd::robot`]; `None` where its joints form no tree.
    pub fn tree(&self) -> Option<&Tree> {
        self.tree.get_or_init(|| Tree::new(self.robot()?)).as_ref()
    }

    /// The links of [`Urdd::robot`] that fixed joints hold together; `None` where its joints form
    /// no tree.
    pub fn rigid_groups(&self) -> Option<&RigidGroups> {
        self.rigid_groups
            .get_or_init(|| Some(RigidGroups::new(self.robot()?, self.tree()?)))
            .as_ref()
    }

    /// The mimic joints of [`Urdd::robot`], resolved; `None` where that has no meaning.
    pub fn mimics(&self) -> Option<&Mimics> {
        self.mimics
            .get_or_init(|| Mimics::resolve(self.robot()?))
            .as_ref()
    }

    /// The degrees of freedom that follow from [`Urdd::robot`], as `dof_module` of the version at
    /// hand should have them.
    pub fn dof_layout(&self) -> Option<&DofLayout> {
        // The first published version gave mimic joints DOFs of their own (SPEC 10.5).
        let version = || self.module(ModuleKind::Dof)?.version.as_deref();
        let make = || Some(DofLayout::new(self.robot()?, version() == Some("0.0.1")));
        self.dof_layout.get_or_init(make).as_ref()
    }

    /// `dof_module`, whatever its version.
    pub fn dofs(&self) -> Option<Dofs<'_>> {
        dofs::view(self.document(ModuleKind::Dof)?)
    }

    /// `chain_module`, whatever its version.
    pub fn chain(&self) -> Option<Chain<'_>> {
        chain::view(self.document(ModuleKind::Chain)?)
    }

    /// `connections_module`, whatever its version.
    pub fn connections(&self) -> Option<Connections<'_>> {
        connections::view(self.document(ModuleKind::Connections)?)
    }

    /// `bounds_module`, whatever its version.
    pub fn bounds(&self) -> Option<Bounds<'_>> {
        bounds::view(self.document(ModuleKind::Bounds)?)
    }

    /// The meshes of a mesh module, whatever its version; `None` for `original_meshes_module` of
    /// version 1, which is not a list by link.
    pub fn meshes(&self, kind: ModuleKind) -> Option<Meshes<'_>> {
        meshes::view(self.document(kind)?)
    }

    /// How a link is called in messages: by index, and by name where it has one.
    pub fn link_label(&self, link: usize) -> String {
        match self.robot().and_then(|robot| robot.links.get(link)) {
            Some(named) => format!("link {link} (`{}`)", named.name),
            None => format!("link {link}"),
        }
    }
}
