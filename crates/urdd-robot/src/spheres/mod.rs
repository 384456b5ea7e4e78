//! Spheres in the place of a robot's shapes: yes or no in a fraction of a microsecond.
//!
//! A planner asks millions of times whether a configuration or a straight motion is free. [`SphereChecker`] answers from
//! spheres of the links alone, eight configurations at once, by the vector instructions that the processor has. Nothing is
//! generated or compiled for a robot: its joints become a list of steps when the checker is made.
//!
//! Spheres come in levels ([`SphereLevel`]) from coarse to fine, each inside the coarser one. A pair of links goes to a finer
//! level only where the coarser ones touch, and the finest decides. If level 0 has one sphere for each link, it is what is
//! around the others; it is enlarged where it is not, and made where it is missing.
//!
//! **What an answer is worth** is in its type. [`Covering`] spheres contain the shapes: [`CoveringAnswer::Free`] is certain,
//! and where spheres touch, the answer is [`CoveringAnswer::Maybe`]. [`Approximating`] spheres are only near the shapes.
//!
//! **Accuracy.** Angles are reduced in 64 bits; all else is computed in 32 bits. A sine or a cosine is wrong by at most 2e-7.
//! For covering spheres, the errors of sines, cosines, rotations and positions are added up along the joints, and the radii
//! grow by the sum: a few micrometres for an arm, 1e-6 of the distance from the root for a robot that has moved far away. The
//! margin of a query grows by a millionth. Obstacles add 2e-6 of their size and their distance. So a free answer is certain,
//! and spheres that are farther apart than that are free. Answers are the same on each instruction set of an architecture,
//! for any number of threads, and alone as in a batch.
//!
//! Obstacles are what a [`World`] has: boxes, spheres, capsules and cylinders exactly, hulls and the pieces of
//! meshes by their exact distances, clouds of points and fields of heights by a tree.
//!
//! ```
//! use urdd_robot::spheres::{CoveringAnswer, SphereChecker};
//! use urdd_robot::{EdgeSettings, Obstacle, Robot, ShapeKind, World};
//!
//! # let folder = tempfile::tempdir()?;
//! # let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/../../conformance/robots/gripper.urdf");
//! # let path = folder.path().join("gripper");
//! # urdd_generate::generate(urdf.as_ref(), &path, &Default::default(), &())?;
//! let robot = Robot::open(&path)?;
//! let pieces = robot.proximity(ShapeKind::Pieces)?;
//! // One sphere around each piece covers the pieces.
//! let levels = [pieces.bounding_level()];
//! let checker = SphereChecker::covering(&robot, &levels, &pieces.link_pairs())?;
//! let mut world = World::default();
//! world.add_points("seen", &[[3.0, 0.0, 0.5], [3.0, 0.1, 0.5]], 0.01)?;
//! let checker = checker.around(&world)?;
//! let [start, end] = [robot.configurations()?.lower(), robot.configurations()?.upper()];
//! if checker.in_collision(&start)? == CoveringAnswer::Free {
//!     println!("blocked at {:?}", checker.blocked_edge(&start, &end, &EdgeSettings::default())?);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod block;
mod level;
mod model;
mod obstacles;
mod placed;
mod tape;

use std::marker::PhantomData;
use std::sync::Arc;

use nalgebra::Isometry3;

use crate::Robot;
use crate::batch::{answer_edges, check_room, room};
use crate::checked::check_margin;
use crate::edge::{EdgeSettings, FirstContact, halving, steps};
use crate::error::RobotError;
use crate::kept::{Closure, Motion};
use crate::lanes::LANES;
use crate::obstacle::World;
use block::{Scene, with_memory};
use model::Model;
use obstacles::Obstacles;
use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::fill;

pub use level::{
    ApproximateAnswer, Approximating, Coverage, Covering, CoveringAnswer, LinkSpheres, Sphere,
    SphereLevel,
};

/// The spheres of a robot, prepared for yes or no: whether any touch, in configurations and along straight motions.
///
/// A configuration has one value for each DOF, rad or m; values beyond the bounds are allowed, up to 1e9. A query fails with
/// [`RobotError::Configuration`] if the length differs from the number of DOFs or a value is not finite, with
/// [`RobotError::Far`] beyond 1e9; a batch, which runs on rayon's thread pool, also as those of
/// [`Queries`](crate::Queries). Queries on one configuration or motion do not allocate after the first of a thread.
///
/// Motions are straight. They fail as [`Queries::first_contact`](crate::Queries::first_contact), and with
/// [`RobotError::Setting`] without a resolution, as spheres have no proof, and for a robot with kinematic loops unless the
/// settings allow open ones: spheres follow no closed motion.
#[derive(Debug, Clone)]
pub struct SphereChecker<C> {
    motion: Arc<Motion>,
    closure: Result<Option<Arc<Closure>>, RobotError>,
    model: Arc<Model>,
    obstacles: Obstacles,
    coverage: PhantomData<C>,
}

/// Blocks of eight configurations in one piece of work for a thread.
const BLOCKS: usize = 32;

/// As many edges are one piece of work as there are motions in this many configurations.
const EDGES: usize = 256;

impl<C: Coverage> SphereChecker<C> {
    fn of(robot: &Robot, levels: &[SphereLevel], pairs: &[[usize; 2]]) -> Result<Self, RobotError> {
        let motion = Arc::clone(robot.shared_motion()?);
        Ok(SphereChecker {
            model: Arc::new(Model::new(&motion, levels, pairs, C::IS_CERTAIN)?),
            closure: robot.closure().map(Option::<&Arc<_>>::cloned),
            motion,
            obstacles: Obstacles::default(),
            coverage: PhantomData,
        })
    }

    /// The same spheres, and obstacles around the robot: each query then asks for both.
    ///
    /// # Errors
    /// [`RobotError::Unknown`] if an obstacle ignores a link that does not exist.
    pub fn around(&self, world: &World) -> Result<Self, RobotError> {
        let obstacles = Obstacles::new(&self.model, &self.motion.links, world, C::IS_CERTAIN)?;
        Ok(SphereChecker { obstacles, ..self.clone() })
    }

    /// Moves the obstacles from `first` on to these poses. It does not allocate. After an error, none has moved.
    ///
    /// # Errors
    /// As [`WorldProximity::move_obstacles`](crate::WorldProximity::move_obstacles).
    pub fn move_obstacles(
        &mut self,
        first: usize,
        poses: &[Isometry3<f64>],
    ) -> Result<(), RobotError> {
        self.obstacles.place(&self.model, first, poses)
    }

    /// Number of DOFs: the length of a configuration.
    pub fn num_dofs(&self) -> usize {
        self.motion.kinematics.num_dofs()
    }

    /// What is said of a configuration.
    pub fn in_collision(&self, configuration: &[f64]) -> Result<C::Answer, RobotError> {
        self.is_within(configuration, 0.0)
    }

    /// As [`SphereChecker::in_collision`], of spheres that are at most `margin` apart, m.
    pub fn is_within(&self, configuration: &[f64], margin: f64) -> Result<C::Answer, RobotError> {
        let scene = self.scene(margin)?;
        self.check(configuration)?;
        let touching =
            with_memory(&self.model, |memory| scene.rows(memory, std::iter::once(configuration)));
        Ok(C::answer(touching != 0))
    }

    /// As [`SphereChecker::in_collision`] for each of the configurations, which are stored one after another.
    pub fn in_collision_batch(&self, configurations: &[f64]) -> Result<Vec<C::Answer>, RobotError> {
        let mut answers = room(self.motion.rows(configurations)?.count, 1)?;
        self.in_collision_batch_into(configurations, &Cancellation::default(), &mut answers)?;
        Ok(answers)
    }

    /// As [`SphereChecker::in_collision_batch`], into `out`.
    pub fn in_collision_batch_into(
        &self,
        configurations: &[f64],
        cancellation: &Cancellation,
        out: &mut [C::Answer],
    ) -> Result<(), RobotError> {
        self.batch_into(configurations, 0.0, cancellation, out, C::answer)
    }

    /// Whether spheres are at most `margin` (m) apart in each of the configurations, into `out`: what is not free, whatever
    /// that is worth.
    pub fn touches_batch_into(
        &self,
        configurations: &[f64],
        margin: f64,
        cancellation: &Cancellation,
        out: &mut [bool],
    ) -> Result<(), RobotError> {
        self.batch_into(configurations, margin, cancellation, out, |touches| touches)
    }

    fn batch_into<T: Send>(
        &self,
        configurations: &[f64],
        margin: f64,
        cancellation: &Cancellation,
        out: &mut [T],
        answer: impl Fn(bool) -> T + Sync,
    ) -> Result<(), RobotError> {
        let (scene, rows) = (self.scene(margin)?, self.motion.rows(configurations)?);
        check_room(out.len(), rows.count, 1)?;
        fill(out, LANES, BLOCKS, |(): &mut (), block, out| {
            cancellation.check()?;
            let rows = (0..out.len()).map(|lane| rows.row(block * LANES + lane));
            rows.clone().try_for_each(|row| self.check(row))?;
            let touching = with_memory(&self.model, |memory| scene.rows(memory, rows));
            for (lane, out) in out.iter_mut().enumerate() {
                *out = answer(touching >> lane & 1 != 0);
            }
            Ok(())
        })
    }

    /// A part of the straight motion from `start` to `end`, from 0 to 1, at which spheres touch; `None` if none is found. As
    /// [`Queries::blocked_edge`](crate::Queries::blocked_edge): it need not be the first. Eight configurations that are spread
    /// over the whole motion are checked at once, the end among the first. Between two of all no point of a sphere travels
    /// farther than the resolution.
    pub fn blocked_edge(
        &self,
        start: &[f64],
        end: &[f64],
        settings: &EdgeSettings,
    ) -> Result<Option<f64>, RobotError> {
        let (scene, steps) = self.motion_of([start, end], settings)?;
        Ok(blocked(&scene, [start, end], steps))
    }

    /// As [`SphereChecker::blocked_edge`], at both ends and between this many parts of the same length, for planners that
    /// have a resolution of their own. Loops may be open on the way.
    pub fn blocked_in_steps(
        &self,
        start: &[f64],
        end: &[f64],
        steps: u64,
    ) -> Result<Option<f64>, RobotError> {
        self.check(start)?;
        self.check(end)?;
        Ok(blocked(&self.scene(0.0)?, [start, end], steps.max(1)))
    }

    /// How far the spheres are free on the straight motion from `start` to `end`, and where they touch first; `None` if they do
    /// not. As [`Queries::first_contact`](crate::Queries::first_contact): the part between two configurations is divided by
    /// 4096.
    pub fn first_contact(
        &self,
        start: &[f64],
        end: &[f64],
        settings: &EdgeSettings,
    ) -> Result<Option<FirstContact>, RobotError> {
        let (scene, steps) = self.motion_of([start, end], settings)?;
        Ok(first(&scene, [start, end], steps))
    }

    /// As [`SphereChecker::blocked_edge`] from each configuration of the first batch to that of the second, into `out`: NaN
    /// where the motion is free.
    pub fn blocked_edge_batch_into(
        &self,
        edges: [&[f64]; 2],
        settings: &EdgeSettings,
        cancellation: &Cancellation,
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        answer_edges((&self.motion, EDGES), edges, cancellation, out, |start, end| {
            Ok([self.blocked_edge(start, end, settings)?.unwrap_or(f64::NAN)])
        })
    }

    /// As [`SphereChecker::first_contact`] from each configuration of the first batch to that of the second, into `out`: the
    /// last part that is free and the first that is blocked, NaN where the motion is free.
    pub fn first_contact_batch_into(
        &self,
        edges: [&[f64]; 2],
        settings: &EdgeSettings,
        cancellation: &Cancellation,
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        answer_edges((&self.motion, EDGES), edges, cancellation, out, |start, end| {
            let contact = self.first_contact(start, end, settings)?;
            Ok(contact.map_or([f64::NAN; 2], |one| [one.free, one.blocked]))
        })
    }

    fn check(&self, configuration: &[f64]) -> Result<(), RobotError> {
        let most = &self.model.most;
        let mut each = configuration.iter().zip(most);
        // What is not a number is not within.
        let is_within = |q: f64, most: f64| (-most..=most).contains(&q);
        let far = each.position(|(q, most)| !is_within(*q, *most));
        if far.is_none() && configuration.len() == most.len() {
            return Ok(());
        }
        self.motion.kinematics.check(configuration)?;
        let dof_idx = far.unwrap_or(0);
        Err(RobotError::Far { dof_idx, value: configuration[dof_idx] })
    }

    fn scene(&self, margin: f64) -> Result<Scene<'_>, RobotError> {
        let margin = check_margin(margin)?.min(1e9);
        let margin = if C::IS_CERTAIN { margin * (1.0 + 1e-6) } else { margin } as f32;
        Ok(Scene { model: &self.model, obstacles: &self.obstacles, margin })
    }

    /// What a motion is checked for, and in how many parts.
    fn motion_of(
        &self,
        ends: [&[f64]; 2],
        settings: &EdgeSettings,
    ) -> Result<(Scene<'_>, u64), RobotError> {
        if !settings.open_loops && self.closure.as_ref().map_err(Clone::clone)?.is_some() {
            let why = "spheres follow no motion in which loops stay closed: ask the shapes, or for open loops";
            return Err(RobotError::Setting(why));
        }
        let scene = self.scene(settings.margin)?;
        let Some(resolution) = settings.resolution else {
            return Err(RobotError::Setting(
                "spheres have no proof of a motion: give a resolution",
            ));
        };
        for end in ends {
            self.check(end)?;
        }
        let length =
            with_memory(&self.model, |memory| self.model.farthest(ends, &mut memory.travel));
        Ok((scene, steps(length, resolution)?))
    }
}

impl SphereChecker<Covering> {
    /// Prepares levels of spheres that cover the shapes, and the pairs of links that are checked, such as those of
    /// [`Proximity::link_pairs`](crate::Proximity::link_pairs). A link without spheres at the finest level is left out.
    ///
    /// # Errors
    /// [`RobotError::Sphere`] for a centre that is not finite or farther than 1e9 m, or a radius that is not above 0 or larger;
    /// [`RobotError::OutOfRange`] for an unknown link; [`RobotError::Setting`] without a level, for a level that does not cover,
    /// or for a pair of a link with itself.
    pub fn covering(
        robot: &Robot,
        levels: &[SphereLevel],
        pairs: &[[usize; 2]],
    ) -> Result<Self, RobotError> {
        match levels.iter().all(|level| level.covers) {
            true => Self::of(robot, levels, pairs),
            false => Err(RobotError::Setting("a level of spheres does not cover the shapes")),
        }
    }
}

impl SphereChecker<Approximating> {
    /// As [`SphereChecker::covering`], for levels that need not cover the shapes.
    ///
    /// # Errors
    /// As there.
    pub fn approximating(
        robot: &Robot,
        levels: &[SphereLevel],
        pairs: &[[usize; 2]],
    ) -> Result<Self, RobotError> {
        Self::of(robot, levels, pairs)
    }
}

/// One of the ends of this many parts of a motion at which spheres touch. Each block is spread over the whole motion; its end
/// is in the first one.
fn blocked(scene: &Scene, ends: [&[f64]; 2], steps: u64) -> Option<f64> {
    let blocks = steps / LANES as u64 + 1;
    let scale = steps as f64;
    with_memory(scene.model, |memory| {
        halving(blocks).find_map(|block| {
            let part =
                |lane: usize| steps.saturating_sub(lane as u64 * blocks + block) as f64 / scale;
            let parts: [f64; LANES] = std::array::from_fn(part);
            let touching = scene.parts(memory, ends, &parts, true);
            (touching != 0).then(|| parts[touching.trailing_zeros() as usize])
        })
    })
}

/// The first of this many parts that is blocked, with the part before it divided by eight four times.
fn first(scene: &Scene, ends: [&[f64]; 2], steps: u64) -> Option<FirstContact> {
    with_memory(scene.model, |memory| {
        let at = |k: u64| k.min(steps) as f64 / steps as f64;
        let mut contact = (0..=steps).step_by(LANES).find_map(|from| {
            let parts: [f64; LANES] = std::array::from_fn(|lane| at(from + lane as u64));
            let touching = scene.parts(memory, ends, &parts, false);
            let k = from + u64::from(touching.trailing_zeros());
            (touching != 0).then(|| FirstContact::new(at(k.saturating_sub(1)), at(k)))
        })?;
        for _ in 0..if contact.blocked == 0.0 { 0 } else { 4 } {
            let FirstContact { free, blocked, .. } = contact;
            let at = |k: usize| {
                if k == LANES { blocked } else { free + (blocked - free) * k as f64 / LANES as f64 }
            };
            let parts: [f64; LANES] = std::array::from_fn(|lane| at(lane + 1));
            // The last one is blocked.
            let touching = scene.parts(memory, ends, &parts, false) | 1 << (LANES - 1);
            let k = touching.trailing_zeros() as usize;
            contact = FirstContact::new(at(k), at(k + 1));
        }
        Some(contact)
    })
}
