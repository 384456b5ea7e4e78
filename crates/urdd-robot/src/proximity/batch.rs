//! Queries on batches of configurations, stored one after another in one slice.

use rayon::prelude::*;

use super::{Group, Placed, Proximity, Workspace};
use crate::batch::{check_room, fill, room};
use crate::edge::EdgeSettings;
use crate::error::RobotError;
use urdd_directory::cancellation::Cancellation;

/// Configurations in one block of work.
const BLOCK: usize = 32;

/// Motions in one block of work.
const EDGES: usize = 4;

/// Batch queries with cancellation: [`Proximity::cancellable`].
#[derive(Debug, Clone, Copy)]
pub struct Cancellable<'a> {
    proximity: &'a Proximity,
    cancellation: &'a Cancellation,
}

impl Proximity {
    /// Batch queries with cancellation. After a cancellation, a query returns [`RobotError::Cancelled`] as soon as each
    /// thread has finished its current configuration.
    ///
    /// ```
    /// use urdd_directory::cancellation::Cancellation;
    /// # use urdd_robot::{Robot, RobotError, ShapeKind};
    /// # let folder = tempfile::tempdir()?;
    /// # let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/../../conformance/robots/gripper.urdf");
    /// # let path = folder.path().join("gripper");
    /// # urdd_generate::generate(urdf.as_ref(), &path, &Default::default(), &())?;
    /// # let robot = Robot::open(&path)?;
    /// let cancellation = Cancellation::default();
    /// let elsewhere = cancellation.clone();   // for another thread, a handler of signals, a button
    /// # elsewhere.cancel();
    /// let proximity = robot.proximity(ShapeKind::Hulls)?;
    /// let batch = robot.configurations()?.random(1);
    /// match proximity.cancellable(&cancellation).distances_batch(&batch) {
    ///     Ok(distances) => println!("{distances:?}"),
    ///     Err(RobotError::Cancelled(_)) => println!("stopped"),
    ///     Err(error) => return Err(error.into()),
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cancellable<'a>(&'a self, cancellation: &'a Cancellation) -> Cancellable<'a> {
        Cancellable { proximity: self, cancellation }
    }

    /// Whether the robot collides with itself in each configuration, as [`Proximity::in_collision`].
    ///
    /// # Errors
    /// [`RobotError::Batch`] if the number of values is not a multiple of the number of DOFs; [`RobotError::Memory`] if
    /// there is not enough memory; and as [`Proximity::closest_points`], for the first invalid configuration.
    pub fn in_collision_batch(&self, configurations: &[f64]) -> Result<Vec<bool>, RobotError> {
        self.cancellable(&Cancellation::default()).in_collision_batch(configurations)
    }

    /// For each two links with checked pairs of shapes, by index: the number of configurations in which any of these
    /// pairs is in contact.
    ///
    /// # Errors
    /// As [`Proximity::in_collision_batch`].
    pub fn contacts_of_links(
        &self,
        configurations: &[f64],
    ) -> Result<Vec<([usize; 2], usize)>, RobotError> {
        let count = self.motion.batch(configurations)?;
        let dofs = self.num_dofs();
        let found = (0..count).into_par_iter().map(|k| {
            let mut placed = Placed::default();
            self.place(&configurations[k * dofs..(k + 1) * dofs], &mut placed)?;
            let touches = |group: &Group| self.any_touches(&placed, std::slice::from_ref(group));
            Ok(self.groups.iter().map(touches).collect())
        });
        let found: Vec<Vec<bool>> = found.collect::<Result<_, RobotError>>()?;
        let groups = self.groups.iter().enumerate();
        Ok(groups
            .map(|(at, group)| (group.links, found.iter().filter(|one| one[at]).count()))
            .collect())
    }

    /// The minimum distance in each configuration, in metres, as [`Proximity::self_distance`]: infinite if there are no
    /// pairs.
    ///
    /// # Errors
    /// As [`Proximity::in_collision_batch`].
    pub fn self_distance_batch(&self, configurations: &[f64]) -> Result<Vec<f64>, RobotError> {
        self.cancellable(&Cancellation::default()).self_distance_batch(configurations)
    }

    /// The distances of all pairs in each configuration, in metres: value `k * pairs + pair` is that of `pair`, in the
    /// order of [`Proximity::pairs`], in configuration `k`.
    ///
    /// # Errors
    /// As [`Proximity::in_collision_batch`].
    pub fn distances_batch(&self, configurations: &[f64]) -> Result<Vec<f64>, RobotError> {
        self.cancellable(&Cancellation::default()).distances_batch(configurations)
    }
}

impl Cancellable<'_> {
    /// As [`Proximity::in_collision_batch`].
    ///
    /// # Errors
    /// As there, and [`RobotError::Cancelled`].
    pub fn in_collision_batch(&self, configurations: &[f64]) -> Result<Vec<bool>, RobotError> {
        let mut answers = room(self.count(configurations)?, 1)?;
        self.in_collision_batch_into(configurations, &mut answers)?;
        Ok(answers)
    }

    /// As [`Proximity::in_collision_batch`], into `out`.
    ///
    /// # Errors
    /// As there, [`RobotError::Room`] if the length of `out` differs from the number of results, and
    /// [`RobotError::Cancelled`].
    pub fn in_collision_batch_into(
        &self,
        configurations: &[f64],
        out: &mut [bool],
    ) -> Result<(), RobotError> {
        self.fill(configurations, 1, out, |q, workspace, out| {
            out[0] = self.proximity.in_collision_with(q, workspace)?;
            Ok(())
        })
    }

    /// As [`Proximity::self_distance_batch`].
    ///
    /// # Errors
    /// As there, and [`RobotError::Cancelled`].
    pub fn self_distance_batch(&self, configurations: &[f64]) -> Result<Vec<f64>, RobotError> {
        let mut distances = room(self.count(configurations)?, 1)?;
        self.self_distance_batch_into(configurations, &mut distances)?;
        Ok(distances)
    }

    /// As [`Proximity::self_distance_batch`], into `out`.
    ///
    /// # Errors
    /// As [`Cancellable::in_collision_batch_into`].
    pub fn self_distance_batch_into(
        &self,
        configurations: &[f64],
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        self.fill(configurations, 1, out, |q, workspace, out| {
            let least = self.proximity.self_distance_with(q, workspace)?;
            out[0] = least.unwrap_or(f64::INFINITY);
            Ok(())
        })
    }

    /// As [`Proximity::distances_batch`].
    ///
    /// # Errors
    /// As there, and [`RobotError::Cancelled`].
    pub fn distances_batch(&self, configurations: &[f64]) -> Result<Vec<f64>, RobotError> {
        let mut distances = room(self.count(configurations)?, self.proximity.pairs.len())?;
        self.distances_batch_into(configurations, &mut distances)?;
        Ok(distances)
    }

    /// As [`Proximity::distances_batch`], into `out`.
    ///
    /// # Errors
    /// As [`Cancellable::in_collision_batch_into`].
    pub fn distances_batch_into(
        &self,
        configurations: &[f64],
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        let pairs = self.proximity.pairs.len();
        self.fill(configurations, pairs, out, |q, workspace, out| {
            self.proximity.distances_with(q, workspace, out)
        })
    }

    /// As [`Proximity::is_within`] of each configuration, into `out`.
    ///
    /// # Errors
    /// As [`Cancellable::in_collision_batch_into`], and [`RobotError::Setting`].
    pub fn is_within_batch_into(
        &self,
        configurations: &[f64],
        margin: f64,
        out: &mut [bool],
    ) -> Result<(), RobotError> {
        self.fill(configurations, 1, out, |q, workspace, out| {
            out[0] = self.proximity.is_within_with(q, margin, workspace)?;
            Ok(())
        })
    }

    /// As [`Proximity::blocked_edge`] from each configuration of `starts` to that of `ends`, into `out`: NaN where the
    /// motion is free.
    ///
    /// # Errors
    /// As [`Cancellable::in_collision_batch_into`], [`RobotError::Setting`] and [`RobotError::Steps`].
    pub fn blocked_edge_batch_into(
        &self,
        starts: &[f64],
        ends: &[f64],
        settings: &EdgeSettings,
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        self.edges([starts, ends], 1, out, |start, end, workspace, out| {
            let blocked = self.proximity.blocked_edge_with(start, end, settings, workspace)?;
            out[0] = blocked.unwrap_or(f64::NAN);
            Ok(())
        })
    }

    /// As [`Proximity::first_contact`] from each configuration of `starts` to that of `ends`, into `out`: the last part
    /// that is free and the first that is blocked, NaN where the motion is free.
    ///
    /// # Errors
    /// As [`Cancellable::blocked_edge_batch_into`].
    pub fn first_contact_batch_into(
        &self,
        starts: &[f64],
        ends: &[f64],
        settings: &EdgeSettings,
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        self.edges([starts, ends], 2, out, |start, end, workspace, out| {
            let contact = self.proximity.first_contact_with(start, end, settings, workspace)?;
            out.copy_from_slice(&contact.map_or([f64::NAN; 2], |one| [one.free, one.blocked]));
            Ok(())
        })
    }

    fn edges(
        &self,
        [starts, ends]: [&[f64]; 2],
        width: usize,
        out: &mut [f64],
        ask: impl Fn(&[f64], &[f64], &mut Workspace, &mut [f64]) -> Result<(), RobotError> + Sync,
    ) -> Result<(), RobotError> {
        let (count, dofs) = (self.count(ends)?, self.proximity.num_dofs());
        check_room(starts.len(), count, dofs)?;
        check_room(out.len(), count, width)?;
        fill(out, width, EDGES, Workspace::default, |workspace, k, out| {
            self.cancellation.check()?;
            let [start, end] = [starts, ends].map(|all| &all[k * dofs..(k + 1) * dofs]);
            ask(start, end, workspace, out)
        })
    }

    fn fill<T: Send>(
        &self,
        configurations: &[f64],
        width: usize,
        out: &mut [T],
        ask: impl Fn(&[f64], &mut Workspace, &mut [T]) -> Result<(), RobotError> + Sync,
    ) -> Result<(), RobotError> {
        check_room(out.len(), self.count(configurations)?, width)?;
        let dofs = self.proximity.num_dofs();
        fill(out, width, BLOCK, Workspace::default, |workspace, k, out| {
            self.cancellation.check()?;
            ask(&configurations[k * dofs..(k + 1) * dofs], workspace, out)
        })
    }

    /// Number of configurations in the slice. For a robot without DOFs, an empty slice is one configuration.
    fn count(&self, configurations: &[f64]) -> Result<usize, RobotError> {
        self.proximity.motion.batch(configurations)
    }
}
