//! A URDD, or a URDF alone, as rules see it, with what is computed once for all rules.

use std::collections::HashMap;
use std::hash::Hash;
use std::ops::Deref;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::reference::distances::Distances;
use super::reference::learned::Judge;
use super::reference::spheres::contacts::{self, LevelFound};
use super::reference::{loops, urdf_text};
use super::solids::Solids;
use super::solids::placed::{self, Placed};
use super::solids::polytope::{Dents, NotConvex};
use urdd_directory::cancellation::Cancellation;
use urdd_document::carried_urdf::{CarriedUrdf, NoUrdf};
use urdd_document::mechanism::Mechanism;
use urdd_document::meshes::Meshes;
use urdd_document::module::Module;
use urdd_document::robot::{self, Robot};
use urdd_document::shape_matrices::{self, Statistics};
use urdd_document::shapes::Shapes;
use urdd_document::tree::{Mimics, RigidGroups};
use urdd_document::urdd::Urdd;
use urdd_findings::check::Check;
use urdd_findings::check::{Examined, blank};
use urdd_findings::code::Code;
use urdd_findings::part::SkipReason;
use urdd_findings::settings::Settings;
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
    /// Whether to check sampled data completely, however long that takes.
    pub(super) deep: bool,
    /// Once cancelled, no further rule starts.
    pub(super) cancellation: Cancellation,
    urdf_text: Arc<UrdfText>,
    solids: Arc<OnceLock<Solids>>,
    /// Results that follow from files alone, and so are the same by both descriptions of the robot.
    pub memos: Arc<Memos>,
    computed: Computed,
}

/// What is computed of one description of the robot, on first use.
#[derive(Default)]
struct Computed {
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
    /// A context of a loaded URDD, with what its source URDF says, where somebody has parsed it. Of the settings, those
    /// apply that change what rules compute.
    pub fn new(urdd: Urdd, urdf: Option<urdf_text::Reading>, settings: &Settings) -> Self {
        Context {
            urdd,
            class: settings.class,
            deep: settings.deep,
            cancellation: settings.cancellation.clone(),
            urdf_text: UrdfText::known(urdf).into(),
            solids: Arc::default(),
            memos: Arc::default(),
            computed: Computed::default(),
        }
    }

    /// The same URDD with the robot of the carried URDF instead of that of `urdf_module`; `None` if there is no
    /// carried URDF or it cannot be read (URD011).
    pub fn by_urdf(&self) -> Option<Context> {
        let robot = self.urdf_text.robot(self.urdf())?;
        Some(Context {
            urdd: self.urdd.with_robot(robot),
            class: self.class,
            deep: self.deep,
            cancellation: self.cancellation.clone(),
            urdf_text: Arc::clone(&self.urdf_text),
            solids: Arc::clone(&self.solids),
            memos: Arc::clone(&self.memos),
            computed: Computed::default(),
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
        self.computed.distances.get_or_init(make).as_ref().map_err(Clone::clone)
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
        self.computed.model_judge.get_or_init(make).as_ref().map_err(Clone::clone)
    }

    /// The contacts of links by their spheres, level by level, computed on first use. For rules that need SPH009 passed.
    ///
    /// # Errors
    /// Why they cannot be computed.
    pub fn sphere_contacts(&self) -> Result<&[LevelFound], SkipReason> {
        let make = || contacts::of_urdd(&self.urdd, self.deep);
        self.computed.sphere_contacts.get_or_init(make).as_deref().map_err(Clone::clone)
    }

    /// How many DOFs loops tie to others: [`loops::ranks`].
    pub fn loop_ranks(&self) -> Result<&[[usize; 2]; 2], SkipReason> {
        let make = || loops::ranks(&self.urdd);
        self.computed.loop_ranks.get_or_init(make).as_ref().map_err(Clone::clone)
    }

    /// The plain meshes compared with the robot's geometry.
    pub fn placed(&self) -> &Placed {
        self.computed.placed.get_or_init(|| placed::all(&self.urdd, self.solids()))
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

/// What a URDF says, parsed on first use; `None` if there is no URDF.
#[derive(Default)]
pub struct UrdfText(OnceLock<Option<urdf_text::Reading>>);

impl UrdfText {
    /// What somebody has parsed, if anybody has.
    pub(super) fn known(reading: Option<urdf_text::Reading>) -> Self {
        UrdfText(reading.map_or_else(OnceLock::new, |reading| Some(reading).into()))
    }

    /// What the URDF says, if there is one.
    pub(super) fn of(&self, urdf: Result<&CarriedUrdf, &NoUrdf>) -> Option<&urdf_text::Reading> {
        self.0.get_or_init(|| Some(urdf_text::read(&urdf.ok()?.text))).as_ref()
    }

    /// The robot of the URDF; `None` if it cannot be read (URD011).
    pub(super) fn robot(&self, urdf: Result<&CarriedUrdf, &NoUrdf>) -> Option<Robot> {
        let is_utf8 = urdf.is_ok_and(|urdf| urdf.not_utf8_at.is_none());
        let reading = self.of(urdf).filter(|reading| is_utf8 && reading.problems.is_empty())?;
        reading.robot.as_ref().map(robot::of_urdf)
    }
}

/// A robot by one of its descriptions, with the URDF.
#[derive(Clone, Copy)]
pub struct Described<'a> {
    pub(super) mechanism: Option<&'a Mechanism>,
    /// The module that describes it, unless the URDF does.
    pub(super) module: Option<&'a Module>,
    /// The source URDF, or why it is not available.
    pub urdf: Result<&'a CarriedUrdf, &'a NoUrdf>,
    pub(super) text: &'a UrdfText,
}

impl<'a> Described<'a> {
    /// The robot.
    pub fn robot(&self) -> Option<&'a Robot> {
        self.mechanism.map(Mechanism::robot)
    }

    /// Its rigid groups; `None` if its joints do not form a tree.
    pub fn rigid_groups(&self) -> Option<&'a RigidGroups> {
        self.mechanism?.rigid_groups()
    }

    /// Its resolved mimic joints; `None` if they cannot be resolved.
    pub fn mimics(&self) -> Option<&'a Mimics> {
        self.mechanism?.mimics()
    }

    /// The file that the robot was read from.
    pub fn robot_file(&self) -> String {
        match self.module {
            Some(module) => module.file("module.json"),
            None => self.urdf.map_or_else(|_| String::new(), |urdf| urdf.path.clone()),
        }
    }

    /// The parsed source URDF; `None` if none is carried. Only meaningful if URD011 passed.
    pub fn urdf_text(&self) -> Option<&'a urdf_text::Reading> {
        self.text.of(self.urdf)
    }
}

/// Results by key, each computed once.
pub struct Memo<K, V>(Mutex<HashMap<K, V>>);

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Memo(Mutex::default())
    }
}

impl<K: Eq + Hash, V: Copy> Memo<K, V> {
    /// The result of a key, computed if it is not known.
    pub fn get(&self, key: K, compute: impl FnOnce() -> V) -> V {
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // Unlocked before it is computed.
        let found = known().get(&key).copied();
        found.unwrap_or_else(|| {
            let value = compute();
            known().insert(key, value);
            value
        })
    }
}

/// The place that is farthest from where it should be.
#[derive(Clone, Copy)]
pub struct Farthest {
    /// Coordinates in the frame of the link, m.
    pub place: [f64; 3],
    /// Its distance, m.
    pub distance: f64,
    /// The distance up to which it is not reported, m.
    pub tolerance: f64,
}

impl Farthest {
    /// The first of the farthest of some places, given with their distances.
    pub fn of(places: impl Iterator<Item = ([f64; 3], f64)>, tolerance: f64) -> Option<Farthest> {
        let (place, distance) = places.reduce(|a, b| if b.1 > a.1 { b } else { a })?;
        Some(Farthest { place, distance, tolerance })
    }

    /// Whether it is reported.
    pub fn is_off(&self) -> bool {
        self.distance > self.tolerance
    }
}

/// Why a mesh is not convex, and its dents, where they were measured.
type Concavity = (NotConvex, Option<Dents>);

/// The results of comparisons of mesh files, boxes and spheres with each other. Meshes are by their content: see
/// [`Solids::content`].
#[derive(Default)]
pub struct Memos {
    /// For a rule and the meshes that it compares: the place farthest off.
    pub farthest: Memo<(Code, Vec<usize>), Option<Farthest>>,
    pub convexity: Memo<usize, Option<Concavity>>,
    /// The size of a box or sphere over that of the smallest one around a mesh. The numbers are those of its size.
    pub ratios: Memo<(usize, [u64; 4]), Option<f64>>,
}
