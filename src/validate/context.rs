//! What a rule sees of a URDD.

use std::sync::OnceLock;

use super::load::{CarriedUrdf, Loaded, MetadataFile, Module};
use super::urdf_text;
use super::views::freedom::Freedom;
use super::views::mimics::Mimics;
use super::views::rigid_groups::RigidGroups;
use super::views::robot::Robot;
use super::views::shapes::Shapes;
use super::views::tree::Tree;
use super::views::{
    Bounds, Chain, Connections, Dofs, Meshes, bounds, chain, connections, dofs, meshes, robot,
};
use crate::directory::root::{Listing, Root};
use crate::format::registry::{ModuleDocument, ModuleKind, Profile};
use crate::format::root_metadata::{ConformanceClass, RootMetadata};

/// A URDD, as rules see it. A rule may count on what it says that it needs.
pub struct Context {
    loaded: Loaded,
    class: Option<ConformanceClass>,
    robot: OnceLock<Option<Robot>>,
    tree: OnceLock<Option<Tree>>,
    mimics: OnceLock<Option<Mimics>>,
    freedom: OnceLock<Option<Freedom>>,
    urdf_text: OnceLock<Option<urdf_text::Reading>>,
    rigid_groups: OnceLock<Option<RigidGroups>>,
}

impl Context {
    /// For a URDD that was read. `class` is the conformance class to hold it to, where that is
    /// not the one that it claims.
    pub fn new(loaded: Loaded, class: Option<ConformanceClass>) -> Self {
        Context {
            loaded,
            class,
            robot: OnceLock::new(),
            tree: OnceLock::new(),
            mimics: OnceLock::new(),
            freedom: OnceLock::new(),
            urdf_text: OnceLock::new(),
            rigid_groups: OnceLock::new(),
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

    /// The conformance class to hold the URDD to: the one that was asked for, or that it claims.
    pub fn class(&self) -> Option<ConformanceClass> {
        self.class
            .or_else(|| self.metadata().map(|metadata| metadata.conformance_class))
    }

    /// The source URDF, or why there is none to look at.
    pub fn urdf(&self) -> Result<&CarriedUrdf, &str> {
        self.loaded.urdf.as_ref().map_err(String::as_str)
    }

    /// The source URDF, read; `None` where none is carried. What it says counts only where URD011
    /// found nothing.
    pub fn urdf_text(&self) -> Option<&urdf_text::Reading> {
        self.urdf_text
            .get_or_init(|| Some(urdf_text::read(&self.urdf().ok()?.text)))
            .as_ref()
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

    /// The robot as `urdf_module` has it, whatever the module's version.
    pub fn robot(&self) -> Option<&Robot> {
        let make = || robot::view(self.document(ModuleKind::Urdf)?);
        self.robot.get_or_init(make).as_ref()
    }

    /// The kinematic tree that follows from `urdf_module`; `None` where its joints form no tree.
    pub fn tree(&self) -> Option<&Tree> {
        self.tree.get_or_init(|| Tree::new(self.robot()?)).as_ref()
    }

    /// The links of `urdf_module` that fixed joints hold together; `None` where its joints form no
    /// tree.
    pub fn rigid_groups(&self) -> Option<&RigidGroups> {
        self.rigid_groups
            .get_or_init(|| Some(RigidGroups::new(self.robot()?, self.tree()?)))
            .as_ref()
    }

    /// The mimic joints of `urdf_module`, resolved; `None` where that has no meaning.
    pub fn mimics(&self) -> Option<&Mimics> {
        self.mimics
            .get_or_init(|| Mimics::resolve(self.robot()?))
            .as_ref()
    }

    /// The degrees of freedom that follow from `urdf_module`, as `dof_module` of the version at hand
    /// should have them.
    pub fn freedom(&self) -> Option<&Freedom> {
        // The first published version gave mimic joints DOFs of their own (SPEC 10.5).
        let version = || self.module(ModuleKind::Dof)?.version.as_deref();
        let make = || Some(Freedom::new(self.robot()?, version() == Some("0.0.1")));
        self.freedom.get_or_init(make).as_ref()
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

    /// What shape indices stand for, as follows from the hulls and the convex pieces.
    pub fn shapes(&self) -> Option<Shapes> {
        Shapes::new(self)
    }

    /// How a link is called in messages: by index, and by name where it has one.
    pub fn link_label(&self, link: usize) -> String {
        match self.robot().and_then(|robot| robot.links.get(link)) {
            Some(named) => format!("link {link} (`{}`)", named.name),
            None => format!("link {link}"),
        }
    }
}
