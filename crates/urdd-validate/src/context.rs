//! What a rule sees of a URDD.

use std::ops::Deref;
use std::sync::{Arc, OnceLock};

use super::distances::Distances;
use super::learned::counts::Judge;
use super::part::Why;
use super::skip::SkipReason;
use super::solids::Solids;
use super::solids::placed::{self, Misplaced, Placed};
use super::urdf_text;
use urdd_directory::cancellation::Cancellation;
use urdd_document::robot;
use urdd_document::shapes::Shapes;
use urdd_document::urdd::{RobotFrom, Urdd};
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::root_metadata::ConformanceClass;

/// A URDD as rules see it: what was loaded, and what the validator works out once for all rules. A
/// rule may count on what it says that it needs.
///
/// A URDD describes its robot twice, in `urdf_module` and in the carried URDF. By which of them
/// rules judge is the context's choice: see [`Context::by_urdf`].
pub struct Context {
    urdd: Urdd,
    class: Option<ConformanceClass>,
    deep: bool,
    cancellation: Cancellation,
    urdf_text: Arc<OnceLock<Option<urdf_text::Reading>>>,
    solids: Arc<OnceLock<Solids>>,
    distances: OnceLock<Result<Distances, SkipReason>>,
    placed: OnceLock<Placed>,
    model_judge: OnceLock<Result<Judge, SkipReason>>,
}

impl Deref for Context {
    type Target = Urdd;

    fn deref(&self) -> &Urdd {
        &self.urdd
    }
}

impl Context {
    /// For a URDD that was read. `class` is the conformance class to hold it to, where that is
    /// not the one that it claims.
    pub fn new(urdd: Urdd, class: Option<ConformanceClass>) -> Self {
        Context {
            urdd,
            class,
            deep: false,
            cancellation: Cancellation::default(),
            urdf_text: Arc::default(),
            solids: Arc::default(),
            distances: OnceLock::new(),
            placed: OnceLock::new(),
            model_judge: OnceLock::new(),
        }
    }

    /// The same URDD with the robot as the carried URDF has it, instead of `urdf_module`; `None`
    /// where none is carried, or it cannot be read (URD011).
    pub fn by_urdf(&self) -> Option<Context> {
        let utf8 = self.urdf().is_ok_and(|urdf| urdf.not_utf8_at.is_none());
        let reading = self.urdf_text().filter(|_| utf8)?;
        let robot = reading.robot.as_ref()?;
        reading.problems.is_empty().then(|| Context {
            urdf_text: Arc::clone(&self.urdf_text),
            solids: Arc::clone(&self.solids),
            deep: self.deep,
            cancellation: self.cancellation.clone(),
            ..Context::new(self.urdd.with_robot(robot::of_urdf(robot)), self.class)
        })
    }

    /// Whether to take all the time that complete checks of sampled data need.
    pub fn deep(mut self, deep: bool) -> Self {
        self.deep = deep;
        self
    }

    /// With a wish to stop, after which no rule is begun.
    pub fn until(mut self, cancellation: &Cancellation) -> Self {
        self.cancellation = cancellation.clone();
        self
    }

    /// Whether to begin no rule any more.
    pub fn is_cancelled(&self) -> bool {
        self.cancellation.is_cancelled()
    }

    /// Whether sampled data is recomputed in full.
    pub fn is_deep(&self) -> bool {
        self.deep
    }

    /// What was loaded.
    pub fn urdd(&self) -> &Urdd {
        &self.urdd
    }

    /// Whether the robot is the carried URDF's.
    pub fn is_by_urdf(&self) -> bool {
        self.urdd.robot_from() == RobotFrom::CarriedUrdf
    }

    /// The conformance class to hold the URDD to: the one that was asked for, or that it claims.
    pub fn class(&self) -> Option<ConformanceClass> {
        self.class
            .or_else(|| self.metadata().map(|metadata| metadata.conformance_class))
    }

    /// The source URDF, read; `None` where none is carried. What it says counts only where URD011
    /// found nothing.
    pub fn urdf_text(&self) -> Option<&urdf_text::Reading> {
        self.urdf_text
            .get_or_init(|| Some(urdf_text::read(&self.urdf().ok()?.text)))
            .as_ref()
    }

    /// What the mesh files hold: all are read when this is first asked for.
    pub fn solids(&self) -> &Solids {
        self.solids.get_or_init(|| Solids::read(&self.urdd))
    }

    /// The distances between shapes, computed again when this is first asked for; or why they cannot
    /// be.
    pub fn distances(&self) -> Result<&Distances, &SkipReason> {
        let make = || Distances::new(&self.urdd, self.solids(), self.deep);
        self.distances.get_or_init(make).as_ref()
    }

    /// What compares the self-collision model with exact geometry, prepared when this is first asked for; or why that
    /// cannot be. For rules that need LRN003 to have found no fault.
    pub fn model_judge(&self) -> Result<&Judge, &SkipReason> {
        let kind = ModuleKind::SelfCollisionModel;
        let make = || match self.document(kind) {
            Some(ModuleDocument::SelfCollisionModel(model)) => {
                Judge::new(&self.urdd, self.solids(), model, self.deep)
            }
            _ => Err(SkipReason::Absent(kind)),
        };
        self.model_judge.get_or_init(make).as_ref()
    }

    /// The links whose plain mesh is not what the robot shows there.
    pub fn misplaced(&self) -> &[Misplaced] {
        &self.placed().wrong
    }

    /// The links of which it cannot be said whether their plain mesh is what the robot shows there.
    pub fn unplaced(&self) -> &[(usize, Why)] {
        &self.placed().unknown
    }

    fn placed(&self) -> &Placed {
        self.placed
            .get_or_init(|| placed::all(&self.urdd, self.solids()))
    }

    /// Whether a link's plain mesh is not what the robot shows there: nothing is held to it then.
    pub fn is_misplaced(&self, link: usize) -> bool {
        self.misplaced().iter().any(|wrong| wrong.link == link)
    }

    /// What shape indices stand for, as follows from the hulls and the convex pieces.
    pub fn shapes(&self) -> Option<Shapes> {
        Shapes::new(&self.urdd)
    }
}
