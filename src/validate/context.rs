//! What a rule sees of a URDD.

use std::sync::{Arc, OnceLock};

use super::distances::Distances;
use super::load::{CarriedUrdf, Loaded, MetadataFile, Module};
use super::solids::Solids;
use super::solids::placed::{self, Misplaced};
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
///
/// A URDD describes its robot twice, in `urdf_module` and in the carried URDF. By which of them
/// rules judge is the context's choice: see [`Context::by_urdf`].
pub struct Context {
    loaded: Arc<Loaded>,
    class: Option<ConformanceClass>,
    deep: bool,
    robot_from: RobotFrom,
    robot: OnceLock<Option<Robot>>,
    tree: OnceLock<Option<Tree>>,
    mimics: OnceLock<Option<Mimics>>,
    freedom: OnceLock<Option<Freedom>>,
    urdf_text: Arc<OnceLock<Option<urdf_text::Reading>>>,
    rigid_groups: OnceLock<Option<RigidGroups>>,
    solids: Arc<OnceLock<Solids>>,
    distances: OnceLock<Result<Distances, String>>,
    misplaced: OnceLock<Vec<Misplaced>>,
}

/// Which of the two descriptions of the robot rules judge by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RobotFrom {
    UrdfModule,
    CarriedUrdf,
}

impl Context {
    /// For a URDD that was read. `class` is the conformance class to hold it to, where that is
    /// not the one that it claims.
    pub fn new(loaded: Loaded, class: Option<ConformanceClass>) -> Self {
        let (urdf_text, solids) = (Arc::default(), Arc::default());
        let loaded = Arc::new(loaded);
        Context::over(loaded, urdf_text, solids, class, RobotFrom::UrdfModule)
    }

    fn over(
        loaded: Arc<Loaded>,
        urdf_text: Arc<OnceLock<Option<urdf_text::Reading>>>,
        solids: Arc<OnceLock<Solids>>,
        class: Option<ConformanceClass>,
        robot_from: RobotFrom,
    ) -> Self {
        Context {
            loaded,
            class,
            deep: false,
            robot_from,
            robot: OnceLock::new(),
            tree: OnceLock::new(),
            mimics: OnceLock::new(),
            freedom: OnceLock::new(),
            urdf_text,
            rigid_groups: OnceLock::new(),
            solids,
            distances: OnceLock::new(),
            misplaced: OnceLock::new(),
        }
    }

    /// The same URDD with the robot as the carried URDF has it, instead of `urdf_module`; `None`
    /// where none is carried, or it cannot be read (URD011).
    pub fn by_urdf(&self) -> Option<Context> {
        let readable = self.urdf().is_ok_and(|urdf| urdf.not_utf8_at.is_none())
            && self
                .urdf_text()
                .is_some_and(|reading| reading.problems.is_empty() && reading.robot.is_some());
        readable.then(|| {
            let (loaded, text) = (Arc::clone(&self.loaded), Arc::clone(&self.urdf_text));
            let solids = Arc::clone(&self.solids);
            Context::over(loaded, text, solids, self.class, RobotFrom::CarriedUrdf).deep(self.deep)
        })
    }

    /// Whether to take all the time that complete checks of sampled data need.
    pub fn deep(mut self, deep: bool) -> Self {
        self.deep = deep;
        self
    }

    /// Whether sampled data is recomputed in full.
    pub fn is_deep(&self) -> bool {
        self.deep
    }

    /// Whether the robot is the carried URDF's.
    pub fn is_by_urdf(&self) -> bool {
        self.robot_from == RobotFrom::CarriedUrdf
    }

    /// The file that the robot is read from. A finding about the robot stands there, at the JSON
    /// Pointer that its value has in `urdf_module`.
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

    /// The robot: as `urdf_module` has it, whatever the module's version, or as the carried URDF
    /// has it ([`Context::by_urdf`]).
    pub fn robot(&self) -> Option<&Robot> {
        let make = || match self.robot_from {
            RobotFrom::UrdfModule => robot::view(self.document(ModuleKind::Urdf)?),
            RobotFrom::CarriedUrdf => self.urdf_text()?.robot.as_ref().map(robot::of_urdf),
        };
        self.robot.get_or_init(make).as_ref()
    }

    /// The kinematic tree of [`Context::robot`]; `None` where its joints form no tree.
    pub fn tree(&self) -> Option<&Tree> {
        self.tree.get_or_init(|| Tree::new(self.robot()?)).as_ref()
    }

    /// The links of [`Context::robot`] that fixed joints hold together; `None` where its joints form
    /// no tree.
    pub fn rigid_groups(&self) -> Option<&RigidGroups> {
        self.rigid_groups
            .get_or_init(|| Some(RigidGroups::new(self.robot()?, self.tree()?)))
            .as_ref()
    }

    /// The mimic joints of [`Context::robot`], resolved; `None` where that has no meaning.
    pub fn mimics(&self) -> Option<&Mimics> {
        self.mimics
            .get_or_init(|| Mimics::resolve(self.robot()?))
            .as_ref()
    }

    /// The degrees of freedom that follow from [`Context::robot`], as `dof_module` of the version at
    /// hand should have them.
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

    /// What the mesh files hold: all are read when this is first asked for.
    pub fn solids(&self) -> &Solids {
        self.solids.get_or_init(|| Solids::read(self))
    }

    /// The distances between shapes, computed again when this is first asked for; or why they cannot
    /// be.
    pub fn distances(&self) -> Result<&Distances, &str> {
        let make = || Distances::new(self);
        self.distances
            .get_or_init(make)
            .as_ref()
            .map_err(String::as_str)
    }

    /// The links whose plain mesh is not what the robot shows there.
    pub fn misplaced(&self) -> &[Misplaced] {
        self.misplaced.get_or_init(|| placed::all(self))
    }

    /// Whether a link's plain mesh is not what the robot shows there: nothing is held to it then.
    pub fn is_misplaced(&self, link: usize) -> bool {
        self.misplaced().iter().any(|wrong| wrong.link == link)
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
