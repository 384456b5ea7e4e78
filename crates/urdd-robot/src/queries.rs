//! What is asked of a robot's own pairs, and of those with obstacles.

use super::batch::{answer, answer_edges, check_room, room};
use super::checked::{Checked, any_within, at_most, check_margin, closest, least};
use super::edge::{EdgeSettings, FirstContact};
use super::error::RobotError;
use super::follow;
use super::proximity::{Gradient, Overlap, in_root, penetration_of, toward};
use super::workspace::{Workspace, with_workspace};
use arrayvec::ArrayVec;
use urdd_directory::cancellation::Cancellation;
use urdd_geometry::convex::TOLERANCE;
use urdd_geometry::convex::across::AT_ONCE;

/// Queries on pairs of shapes: a robot's own ([`Proximity`](super::Proximity)), or a shape of the robot and an obstacle
/// ([`WorldProximity`](crate::WorldProximity)). Answers say of a pair what a [`PairDistance`](super::PairDistance) or an
/// [`ObstacleDistance`](super::ObstacleDistance) says.
///
/// A configuration has one value for each DOF, rad or m; values beyond the bounds are allowed. Every query fails with
/// [`RobotError::Configuration`] if the length differs from the number of DOFs or a value is not finite; a batch, for the
/// first invalid configuration. A batch also fails with [`RobotError::Batch`] if the number of values is not a multiple of
/// the number of DOFs, and with [`RobotError::Memory`] if there is not enough memory; what writes into `out`, with
/// [`RobotError::Room`] if its length differs from the number of results. Methods name further errors.
///
/// Queries use memory that their thread keeps for the next one. After the first, those whose answer is a number, that
/// write into the caller's memory, or that call back do not allocate.
pub trait Queries: Checked + Sized {
    /// Number of DOFs: the length of a configuration.
    fn num_dofs(&self) -> usize {
        self.shapes().motion.kinematics.num_dofs()
    }

    /// Number of pairs: the length of [`Queries::distances`].
    fn num_pairs(&self) -> usize {
        self.num_answers()
    }

    /// Number of pairs that [`Queries::nearest`] has. For obstacles, those of a shape of the robot and a convex part of an
    /// obstacle.
    fn num_pairs_of_parts(&self) -> usize {
        self.count()
    }

    /// Whether any pair touches or overlaps, that is, has distance 0. Stops at the first collision.
    fn in_collision(&self, configuration: &[f64]) -> Result<bool, RobotError> {
        self.is_within(configuration, 0.0)
    }

    /// Whether any pair is at most `margin` apart, m. Stops at the first such pair. With a margin of 0, this is
    /// [`Queries::in_collision`]; with another one, those of the robot's own pairs count whose links can move against
    /// each other.
    ///
    /// # Errors
    /// [`RobotError::Setting`] if the margin is negative or not finite.
    fn is_within(&self, configuration: &[f64], margin: f64) -> Result<bool, RobotError> {
        let margin = check_margin(margin)?;
        with_workspace(|Workspace { placed, .. }| {
            self.shapes().place(configuration, placed)?;
            Ok(any_within(self, placed, margin))
        })
    }

    /// The distance of each pair, in metres, in their order.
    fn distances(&self, configuration: &[f64]) -> Result<Vec<f64>, RobotError> {
        let mut values = vec![0.0; self.num_pairs()];
        self.distances_into(configuration, &mut values)?;
        Ok(values)
    }

    /// As [`Queries::distances`], into `out`.
    fn distances_into(&self, configuration: &[f64], out: &mut [f64]) -> Result<(), RobotError> {
        check_room(out.len(), 1, self.num_pairs())?;
        with_workspace(|Workspace { placed, .. }| {
            self.shapes().place(configuration, placed)?;
            let mut answers = 0;
            for first in (0..self.count()).step_by(AT_ONCE) {
                let pairs = first..self.count().min(first + AT_ONCE);
                let pairs: ArrayVec<usize, AT_ONCE> = pairs.collect();
                let mut values = [0.0; AT_ONCE];
                self.values(placed, &pairs, &mut values[..pairs.len()]);
                for (pair, value) in pairs.into_iter().zip(values) {
                    let is_first = self.is_first(pair);
                    answers += usize::from(is_first);
                    let out = &mut out[answers - 1];
                    *out = if is_first { value } else { out.min(value) };
                }
            }
            Ok(())
        })
    }

    /// The minimum distance over all pairs, in metres; `None` if there are no pairs.
    fn min_distance(&self, configuration: &[f64]) -> Result<Option<f64>, RobotError> {
        with_workspace(|workspace| {
            let nearest = least(self, configuration, 1, workspace)?;
            Ok(nearest.first().map(|(distance, _)| *distance))
        })
    }

    /// The distance and the closest points of each pair, in their order. For an obstacle of several parts, those of the
    /// nearest part.
    fn closest_points(&self, configuration: &[f64]) -> Result<Vec<Self::Pair>, RobotError> {
        with_workspace(|Workspace { placed, .. }| {
            self.shapes().place(configuration, placed)?;
            let (mut all, mut nearest) = (Vec::new(), 0.0);
            closest(self, placed, 0..self.count(), |pair, distance, points| {
                let is_first = self.is_first(pair);
                if is_first || distance < nearest {
                    all.truncate(all.len() - usize::from(!is_first));
                    all.push(self.found(placed, pair, distance, points));
                    nearest = distance;
                }
            });
            Ok(all)
        })
    }

    /// The `k` nearest pairs, nearest first; all pairs if there are fewer. Ties are in the order of the pairs. Among
    /// obstacles, a pair is a shape of the robot and a convex part of an obstacle.
    fn nearest(&self, configuration: &[f64], k: usize) -> Result<Vec<Self::Pair>, RobotError> {
        let mut all = Vec::new();
        self.each_nearest(configuration, k, |one| all.push(one))?;
        Ok(all)
    }

    /// As [`Queries::nearest`]: calls `each` with one pair after another.
    fn each_nearest(
        &self,
        configuration: &[f64],
        k: usize,
        mut each: impl FnMut(Self::Pair),
    ) -> Result<(), RobotError> {
        with_workspace(|workspace| {
            least(self, configuration, k, workspace)?;
            let Workspace { placed, least, .. } = workspace;
            closest(self, placed, least.best(), |pair, distance, points| {
                each(self.found(placed, pair, distance, points));
            });
            Ok(())
        })
    }

    /// The pairs of [`Queries::nearest`], with the gradients of their distances.
    fn gradients(
        &self,
        configuration: &[f64],
        k: usize,
    ) -> Result<Vec<Gradient<Self::Pair>>, RobotError> {
        let mut all = Vec::new();
        self.each_gradient(configuration, k, |pair, gradient| {
            all.push(Gradient { pair, gradient: gradient.map(<[f64]>::to_vec) });
        })?;
        Ok(all)
    }

    /// As [`Queries::gradients`]: calls `each` with one pair and its [gradient](Gradient::gradient) after another.
    fn each_gradient(
        &self,
        configuration: &[f64],
        k: usize,
        mut each: impl FnMut(Self::Pair, Option<&[f64]>),
    ) -> Result<(), RobotError> {
        with_workspace(|workspace| {
            least(self, configuration, k, workspace)?;
            let Workspace { placed, least, derivative, .. } = workspace;
            closest(self, placed, least.best(), |pair, distance, points| {
                let gradient = toward(&points, distance).map(|toward| {
                    let links = self.links(pair);
                    let shapes = self.shapes();
                    shapes.derivative(configuration, placed, links, points, toward, derivative)
                });
                each(self.found(placed, pair, distance, points), gradient);
            });
            Ok(())
        })
    }

    /// The pairs that touch or overlap, in order.
    fn collisions(&self, configuration: &[f64]) -> Result<Vec<Self::Pair>, RobotError> {
        let mut all = Vec::new();
        with_workspace(|Workspace { placed, .. }| {
            self.shapes().place(configuration, placed)?;
            let touching = at_most(self, placed, 0..self.count(), 0.0);
            closest(self, placed, touching, |pair, distance, points| {
                all.push(self.found(placed, pair, distance, points));
            });
            Ok(all)
        })
    }

    /// The pairs that touch or overlap, in order, with how far they do.
    fn penetrations(&self, configuration: &[f64]) -> Result<Vec<Overlap<Self::Pair>>, RobotError> {
        let (shapes, mut all) = (self.shapes(), Vec::new());
        with_workspace(|Workspace { placed, derivative, .. }| {
            shapes.place(configuration, placed)?;
            for pair in at_most(self, placed, 0..self.count(), TOLERANCE) {
                let Some(found) = penetration_of(shapes.level, &self.swept(placed, pair)) else {
                    continue;
                };
                let links = self.links(pair);
                let (direction, points) = in_root(&placed.links[links.0], &found);
                let toward =
                    shapes.derivative(configuration, placed, links, points, direction, derivative);
                all.push(Overlap {
                    pair: self.found(placed, pair, 0.0, points),
                    depth: found.depth,
                    direction,
                    gradient: toward.iter().map(|x| -x).collect(),
                });
            }
            Ok(all)
        })
    }

    /// Where the straight motion from `start` to `end` is blocked: a part of it, from 0 to 1, at which a pair is at most
    /// [`EdgeSettings::margin`] apart. `None` if it is free.
    ///
    /// With a resolution, configurations along the motion are checked, the end and the halves first, so that a blocked
    /// motion is found early. The answer is one of those that are blocked, and need not be the first:
    /// [`Queries::first_contact`] has that. Without a resolution, the motion is proved free by conservative advancement:
    /// every distance is divided by a bound on how fast it can shrink. It then needs 0.1 mm more than the margin of pairs
    /// that move against each other, and the answer is the first part where they have less.
    ///
    /// Where the robot has kinematic loops, the motion is the one in which they stay closed: the
    /// [independent DOFs](crate::Robot::independent_dofs) go straight, the others follow, each configuration closed from the
    /// last one, within the bounds. Between two checked configurations no point travels farther than the resolution. Where no
    /// closed configuration is found, the motion is blocked, and so it is at the end if the others arrive on another branch
    /// of the closed configurations than `end` is on; [`FirstContact::obstruction`] says which. There is no proof of such a
    /// motion. [`EdgeSettings::open_loops`] asks for the straight motion of the spanning tree.
    ///
    /// # Errors
    /// As [`Queries::first_contact`]: [`RobotError::Setting`] if a setting makes no sense, such as no resolution for a robot
    /// with loops; [`RobotError::NotClosed`] and [`RobotError::NotCoupled`] if `start` or `end` is not closed;
    /// [`RobotError::Steps`] if the motion needs more than a million configurations, with loops more than 100,000, or its
    /// proof more than 100,000 steps.
    fn blocked_edge(
        &self,
        start: &[f64],
        end: &[f64],
        settings: &EdgeSettings,
    ) -> Result<Option<f64>, RobotError> {
        let found = with_workspace(|Workspace { placed, .. }| {
            follow::contact(self, [start, end], settings, false, placed)
        })?;
        Ok(found.map(|contact| contact.blocked))
    }

    /// Where the straight motion from `start` to `end` is blocked first, and how far it is free; `None` if it is free.
    ///
    /// With a resolution, the configurations of [`Queries::blocked_edge`] are checked in order. The part between the
    /// first that is blocked and the one before is then halved ten times: no point of the robot travels farther between
    /// [`FirstContact::free`] and [`FirstContact::blocked`] than a thousandth of the resolution. Both were checked. A
    /// contact that begins and ends between two configurations can be missed. Without a resolution, the whole motion up
    /// to `free` is proved free, and `blocked` is as in `blocked_edge`.
    fn first_contact(
        &self,
        start: &[f64],
        end: &[f64],
        settings: &EdgeSettings,
    ) -> Result<Option<FirstContact>, RobotError> {
        with_workspace(|Workspace { placed, .. }| {
            follow::contact(self, [start, end], settings, true, placed)
        })
    }

    /// As [`Queries::in_collision`] for each of the configurations, which are stored one after another. Batches run on
    /// rayon's thread pool.
    fn in_collision_batch(&self, configurations: &[f64]) -> Result<Vec<bool>, RobotError> {
        let mut answers = room(self.shapes().motion.rows(configurations)?.count, 1)?;
        self.in_collision_batch_into(configurations, &Cancellation::default(), &mut answers)?;
        Ok(answers)
    }

    /// As [`Queries::in_collision_batch`], into `out`. After a cancellation, a batch returns [`RobotError::Cancelled`] as
    /// soon as each thread has finished its current configuration.
    ///
    /// ```
    /// use urdd_directory::cancellation::Cancellation;
    /// use urdd_robot::Queries;
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
    /// let mut answers = [false];
    /// match proximity.in_collision_batch_into(&batch, &cancellation, &mut answers) {
    ///     Ok(()) => println!("{answers:?}"),
    ///     Err(RobotError::Cancelled(_)) => println!("stopped"),
    ///     Err(error) => return Err(error.into()),
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    fn in_collision_batch_into(
        &self,
        configurations: &[f64],
        cancellation: &Cancellation,
        out: &mut [bool],
    ) -> Result<(), RobotError> {
        self.is_within_batch_into(configurations, 0.0, cancellation, out)
    }

    /// As [`Queries::is_within`] of each configuration, into `out`.
    fn is_within_batch_into(
        &self,
        configurations: &[f64],
        margin: f64,
        cancellation: &Cancellation,
        out: &mut [bool],
    ) -> Result<(), RobotError> {
        answer(self, configurations, cancellation, (out, 1), |q, out| {
            out[0] = self.is_within(q, margin)?;
            Ok(())
        })
    }

    /// The minimum distance in each configuration, in metres, as [`Queries::min_distance`]: infinite if there are no
    /// pairs.
    fn min_distance_batch(&self, configurations: &[f64]) -> Result<Vec<f64>, RobotError> {
        let mut distances = room(self.shapes().motion.rows(configurations)?.count, 1)?;
        self.min_distance_batch_into(configurations, &Cancellation::default(), &mut distances)?;
        Ok(distances)
    }

    /// As [`Queries::min_distance_batch`], into `out`.
    fn min_distance_batch_into(
        &self,
        configurations: &[f64],
        cancellation: &Cancellation,
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        answer(self, configurations, cancellation, (out, 1), |q, out| {
            out[0] = self.min_distance(q)?.unwrap_or(f64::INFINITY);
            Ok(())
        })
    }

    /// The distances of all pairs in each configuration, in metres: value `k * pairs + pair` is that of `pair` in
    /// configuration `k`.
    fn distances_batch(&self, configurations: &[f64]) -> Result<Vec<f64>, RobotError> {
        let count = self.shapes().motion.rows(configurations)?.count;
        let mut distances = room(count, self.num_pairs())?;
        self.distances_batch_into(configurations, &Cancellation::default(), &mut distances)?;
        Ok(distances)
    }

    /// As [`Queries::distances_batch`], into `out`.
    fn distances_batch_into(
        &self,
        configurations: &[f64],
        cancellation: &Cancellation,
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        answer(self, configurations, cancellation, (out, self.num_pairs()), |q, out| {
            self.distances_into(q, out)
        })
    }

    /// As [`Queries::blocked_edge`] from each configuration of the first batch to that of the second, into `out`: NaN where the
    /// motion is free.
    fn blocked_edge_batch_into(
        &self,
        edges: [&[f64]; 2],
        settings: &EdgeSettings,
        cancellation: &Cancellation,
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        answer_edges(
            (&self.shapes().motion, Self::BLOCK),
            edges,
            cancellation,
            out,
            |start, end| Ok([self.blocked_edge(start, end, settings)?.unwrap_or(f64::NAN)]),
        )
    }

    /// As [`Queries::first_contact`] from each configuration of the first batch to that of the second, into `out`: the last part
    /// that is free and the first that is blocked, NaN where the motion is free.
    fn first_contact_batch_into(
        &self,
        edges: [&[f64]; 2],
        settings: &EdgeSettings,
        cancellation: &Cancellation,
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        let whole = (&*self.shapes().motion, Self::BLOCK);
        answer_edges(whole, edges, cancellation, out, |start, end| {
            let contact = self.first_contact(start, end, settings)?;
            Ok(contact.map_or([f64::NAN; 2], |one| [one.free, one.blocked]))
        })
    }

    /// As [`Queries::first_contact`] from each configuration of the first batch to that of the second, into `out`.
    fn motion_batch_into(
        &self,
        edges: [&[f64]; 2],
        settings: &EdgeSettings,
        cancellation: &Cancellation,
        out: &mut [Option<FirstContact>],
    ) -> Result<(), RobotError> {
        let whole = (&*self.shapes().motion, Self::BLOCK);
        answer_edges(whole, edges, cancellation, out, |start, end| {
            Ok([self.first_contact(start, end, settings)?])
        })
    }
}

impl<C: Checked> Queries for C {}
