//! A URDD as rules see it.

use std::ops::Deref;
use std::sync::{Arc, OnceLock};

use super::described::{Described, UrdfText};
use super::memo::Memos;
use super::reference::distances::Distances;
use super::reference::learned::counts::Judge;
use super::reference::loops;
use super::reference::spheres;
use super::reference::spheres::contacts::LevelFound;
use super::reference::urdf_text;
use super::solids::Solids;
use super::solids::placed::{self, Placed};
use urdd_directory::cancellation::Cancellation;
use urdd_document::meshes::Meshes;
use urdd_document::module::Module;
use urdd_document::robot::Robot;
use urdd_document::shape_matrices::{self, Statistics};
use urdd_document::shapes::Shapes;
use urdd_document::urdd::Urdd;
use urdd_findings::check::Check;
use urdd_findings::examined::{Examined, blank};
use urdd_findings::skip::SkipReason;
use urdd_format::index::Count;
use urdd_format::registry::{ModuleDocument, ModuleKind, Profile};
use urdd_format::report::{self as format, Kind, Size};
use urdd_format::root_metadata::ConformanceClass;

/// A loaded URDD, with data that the validator computes once for all rules. A rule's needs guarantee which of it is
/// available.
///
/// A URDD describes its robot twice, in `urdf_module` and in the carried URDF. The context decides which of them rules
/// use: see [`Context::by_urdf`].
pub struct Context {
    urdd: Urdd,
    class: Option<ConformanceClass>,
    pub(super) deep: bool,
    /// Once cancelled, no further rule starts.
    pub(super) cancellation: Cancellation,
    urdf_text: Arc<UrdfText>,
    solids: Arc<OnceLock<Solids>>,
    /// Results that follow from files alone, and so are the same by both descriptions of the robot.
    pub memos: Arc<Memos>,
    distances: OnceLock<Result<Distances, SkipReason>>,
    placed: OnceLock<Placed>,
    model_judge: OnceLock<Result<Judge, SkipReason>>,
    sphere_contacts: OnceLock<Result<Vec<LevelFound>, SkipReason>>,
    loop_ranks: OnceLock<Result<[[usize; 2]; 2], SkipReason>>,
}

impl Deref for Context {
    type Target = Urdd;

    fn deref(&self) -> &Urdd {
        &self.urdd
    }
}

impl Context {
    /// A context of a loaded URDD. `class` replaces the conformance class that the URDD claims.
    pub fn new(urdd: Urdd, class: Option<ConformanceClass>) -> Self {
        Context {
            urdd,
            class,
            deep: false,
            cancellation: Cancellation::default(),
            urdf_text: Arc::default(),
            solids: Arc::default(),
            memos: Arc::default(),
            distances: OnceLock::new(),
            placed: OnceLock::new(),
            model_judge: OnceLock::new(),
            sphere_contacts: OnceLock::new(),
            loop_ranks: OnceLock::new(),
        }
    }

    /// The same URDD with the robot of the carried URDF instead of that of `urdf_module`; `None` if there is no
    /// carried URDF or it cannot be read (URD011).
    pub fn by_urdf(&self) -> Option<Context> {
        let robot = self.urdf_text.robot(self.urdf())?;
        Some(Context {
            urdf_text: Arc::clone(&self.urdf_text),
            solids: Arc::clone(&self.solids),
            memos: Arc::clone(&self.memos),
            deep: self.deep,
            cancellation: self.cancellation.clone(),
            ..Context::new(self.urdd.with_robot(robot), self.class)
        })
    }

    /// The robot, for rules about it alone.
    pub fn described(&self) -> Described<'_> {
        Described {
            mechanism: self.mechanism(),
            module: self.module(ModuleKind::Urdf).filter(|_| !self.is_by_urdf()),
            urdf: self.urdf(),
            text: &self.urdf_text,
        }
    }

    /// Sets what the source URDF says, where somebody has parsed it.
    pub(super) fn knowing(self, urdf: Option<urdf_text::Reading>) -> Self {
        Context { urdf_text: UrdfText::known(urdf).into(), ..self }
    }

    /// Whether to check sampled data completely, however long that takes.
    pub fn deep(mut self, deep: bool) -> Self {
        self.deep = deep;
        self
    }

    /// Sets the cancellation: once cancelled, no further rule starts.
    pub fn until(mut self, cancellation: &Cancellation) -> Self {
        self.cancellation = cancellation.clone();
        self
    }

    /// The conformance class that the URDD must meet: the requested one, otherwise the one it claims.
    pub fn class(&self) -> Option<ConformanceClass> {
        self.class.or_else(|| self.metadata().map(|metadata| metadata.conformance_class))
    }

    /// The parsed source URDF; `None` if none is carried. Only meaningful if URD011 passed.
    pub fn urdf_text(&self) -> Option<&urdf_text::Reading> {
        self.urdf_text.of(self.urdf())
    }

    /// The contents of the mesh files, all read on first use.
    pub fn solids(&self) -> &Solids {
        self.solids.get_or_init(|| Solids::read(&self.urdd))
    }

    /// The distances between shapes, recomputed on first use.
    ///
    /// # Errors
    /// Why they cannot be computed.
    pub fn distances(&self) -> Result<&Distances, SkipReason> {
        let make = || Distances::new(&self.urdd, self.solids(), self.deep);
        self.distances.get_or_init(make).as_ref().map_err(Clone::clone)
    }

    /// Compares the self-collision model with exact geometry; prepared on first use. For rules that need LRN003 passed.
    ///
    /// # Errors
    /// Why the model cannot be compared.
    pub fn model_judge(&self) -> Result<&Judge, SkipReason> {
        let kind = ModuleKind::SelfCollisionModel;
        let make = || match self.document(kind) {
            Some(ModuleDocument::SelfCollisionModel(model)) => {
                Judge::new(&self.urdd, self.solids(), model, self.deep)
            }
            _ => Err(SkipReason::absent(kind)),
        };
        self.model_judge.get_or_init(make).as_ref().map_err(Clone::clone)
    }

    /// The contacts of links by their spheres, level by level, computed on first use. For rules that need SPH009 passed.
    ///
    /// # Errors
    /// Why they cannot be computed.
    pub fn sphere_contacts(&self) -> Result<&[LevelFound], SkipReason> {
        let make = || spheres::contacts::of_urdd(&self.urdd, self.deep);
        self.sphere_contacts.get_or_init(make).as_deref().map_err(Clone::clone)
    }

    /// How many DOFs loops tie to others: [`loops::ranks`].
    pub fn loop_ranks(&self) -> Result<&[[usize; 2]; 2], SkipReason> {
        let make = || loops::ranks(&self.urdd);
        self.loop_ranks.get_or_init(make).as_ref().map_err(Clone::clone)
    }

    /// The plain meshes compared with the robot's geometry.
    pub fn placed(&self) -> &Placed {
        self.placed.get_or_init(|| placed::all(&self.urdd, self.solids()))
    }

    /// Whether a link's plain mesh differs from the robot's geometry, so that nothing is compared with it.
    pub fn is_misplaced(&self, link: usize) -> bool {
        self.placed().wrong.iter().any(|wrong| wrong.link == link)
    }

    /// The meaning of shape indices, from the hulls and the convex pieces.
    pub fn shapes(&self) -> Option<Shapes> {
        Shapes::new(&self.urdd)
    }

    /// The distance statistics of the six kinds of shape.
    pub fn statistics(&self) -> Option<[Option<Statistics<'_>>; 6]> {
        shape_matrices::statistics(self.document(ModuleKind::LinkShapesDistanceStatistics)?)
    }

    /// What a report says of it, with its checks. `name` is its name in the report.
    pub(super) fn examined(&self, name: &str, checks: Vec<Check>) -> Examined {
        let mut examined = examined(Kind::Urdd, name, self.robot(), checks);
        let metadata = self.metadata().map(|metadata| &metadata.robot_name);
        let modules = self.modules().map(|module| format::Module {
            name: module.name().to_owned(),
            path: module.folder.clone(),
            version: module.version.clone(),
            profile: module.spec.map(|spec| spec.profile.as_str().to_owned()),
        });
        examined.report.name = examined.report.name.or_else(|| metadata.cloned());
        examined.report.size.dofs = self.dofs().map(|dofs| dofs.num_dofs);
        examined.report.modules = modules.collect();
        examined
    }

    /// Those of the modules whose documents are usable.
    pub fn documents(
        &self,
        kinds: &[ModuleKind],
    ) -> impl Iterator<Item = (ModuleKind, &Module, &ModuleDocument)> {
        kinds.iter().filter_map(|kind| {
            let module = self.module(*kind)?;
            Some((*kind, module, module.document.as_ref()?))
        })
    }

    /// Those of the mesh modules that list meshes by link.
    pub fn mesh_modules(
        &self,
        kinds: &[ModuleKind],
    ) -> impl Iterator<Item = (ModuleKind, &Module, Meshes<'_>)> {
        kinds.iter().filter_map(|kind| Some((*kind, self.module(*kind)?, self.meshes(*kind)?)))
    }
}

/// What a report says of a robot, with its checks. `name` is its name in the report.
pub(super) fn examined(
    kind: Kind,
    name: &str,
    robot: Option<&Robot>,
    checks: Vec<Check>,
) -> Examined {
    let report = format::Urdd {
        name: robot.map(|robot| robot.name.clone()),
        size: Size {
            links: robot.map(|robot| Count::saturating(robot.links.len())),
            joints: robot.map(|robot| Count::saturating(robot.joints.len())),
            dofs: None,
        },
        ..blank(kind, name)
    };
    Examined { report, checks }
}

/// What rules are run on: a robot, and the URDD that it is of, if any.
#[derive(Clone, Copy)]
pub(super) struct Subject<'a> {
    pub described: Described<'a>,
    pub urdd: Option<&'a Context>,
}

impl<'a> From<&'a Context> for Subject<'a> {
    fn from(context: &'a Context) -> Self {
        Subject { described: context.described(), urdd: Some(context) }
    }
}

impl<'a> Subject<'a> {
    /// The module of the URDD.
    pub fn module(&self, kind: ModuleKind) -> Option<&'a Module> {
        self.urdd?.module(kind)
    }

    /// The format family; a URDF alone is judged as that of a URDD of the present version.
    pub fn profile(&self) -> Profile {
        self.urdd.map_or(Profile::V1, |urdd| urdd.profile())
    }
}
