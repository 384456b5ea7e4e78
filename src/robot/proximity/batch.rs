//! Questions about many configurations, which follow each other in one list.

use rayon::prelude::*;

use super::{Placed, Proximity};
use crate::cancellation::Cancellation;
use crate::robot::error::RobotError;

/// Configurations that one thread works on at once.
const BLOCK: usize = 32;

/// Questions about many configurations that end where they are asked to stop: [`Proximity::until`].
#[derive(Debug, Clone, Copy)]
pub struct Until<'a> {
    proximity: &'a Proximity,
    cancellation: &'a Cancellation,
}

impl Proximity {
    /// Questions about many configurations that can be stopped: each then ends soon, within some configurations, with
    /// [`RobotError::Cancelled`].
    ///
    /// ```
    /// use urdd::cancellation::Cancellation;
    /// # use urdd::robot::{Robot, RobotError, ShapeKind};
    /// # let folder = tempfile::tempdir()?;
    /// # let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/conformance/robots/gripper.urdf");
    /// # let path = folder.path().join("gripper");
    /// # urdd::generate::generate(urdf.as_ref(), &path, &Default::default(), &())?;
    /// # let robot = Robot::open(&path)?;
    /// let cancellation = Cancellation::default();
    /// let elsewhere = cancellation.clone();   // for another thread, a handler of signals, a button
    /// # elsewhere.cancel();
    /// let proximity = robot.proximity(ShapeKind::Hulls)?;
    /// let batch = robot.configurations()?.random(1);
    /// match proximity.until(&cancellation).distances_batch(&batch) {
    ///     Ok(distances) => println!("{distances:?}"),
    ///     Err(RobotError::Cancelled(_)) => println!("stopped"),
    ///     Err(error) => return Err(error.into()),
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn until<'a>(&'a self, cancellation: &'a Cancellation) -> Until<'a> {
        Until {
            proximity: self,
            cancellation,
        }
    }

    /// Whether the robot collides with itself in each configuration, as [`Proximity::in_collision`].
    ///
    /// # Errors
    /// [`RobotError::Batch`] where the values are no whole number of configurations; and as
    /// [`Proximity::distances`], for the first configuration that has none.
    pub fn in_collision_batch(&self, configurations: &[f64]) -> Result<Vec<bool>, RobotError> {
        self.until(&Cancellation::default())
            .in_collision_batch(configurations)
    }

    /// The least distance in each configuration, metres, as [`Proximity::self_distance`]: infinite where there is no
    /// pair.
    ///
    /// # Errors
    /// As [`Proximity::in_collision_batch`].
    pub fn self_distance_batch(&self, configurations: &[f64]) -> Result<Vec<f64>, RobotError> {
        self.until(&Cancellation::default())
            .self_distance_batch(configurations)
    }

    /// The distances of all pairs in each configuration, metres: value `k * pairs + pair` is that of `pair`, in the
    /// order of [`Proximity::pairs`], in configuration `k`.
    ///
    /// # Errors
    /// As [`Proximity::in_collision_batch`].
    pub fn distances_batch(&self, configurations: &[f64]) -> Result<Vec<f64>, RobotError> {
        self.until(&Cancellation::default())
            .distances_batch(configurations)
    }
}

impl Until<'_> {
    /// As [`Proximity::in_collision_batch`].
    ///
    /// # Errors
    /// As there, and [`RobotError::Cancelled`].
    pub fn in_collision_batch(&self, configurations: &[f64]) -> Result<Vec<bool>, RobotError> {
        self.each(configurations, |q, placed| {
            self.proximity.collides(q, placed)
        })
    }

    /// As [`Proximity::self_distance_batch`].
    ///
    /// # Errors
    /// As there, and [`RobotError::Cancelled`].
    pub fn self_distance_batch(&self, configurations: &[f64]) -> Result<Vec<f64>, RobotError> {
        self.each(configurations, |q, placed| {
            let least = self.proximity.least(q, 1, placed)?;
            Ok(least
                .first()
                .map_or(f64::INFINITY, |(distance, _)| *distance))
        })
    }

    /// As [`Proximity::distances_batch`].
    ///
    /// # Errors
    /// As there, and [`RobotError::Cancelled`].
    pub fn distances_batch(&self, configurations: &[f64]) -> Result<Vec<f64>, RobotError> {
        let (count, dofs, pairs) = (
            self.count(configurations)?,
            self.proximity.num_dofs(),
            self.proximity.pairs.len(),
        );
        let mut values = vec![0.0; count * pairs];
        if pairs == 0 {
            return Ok(values);
        }
        let faults: Vec<RobotError> = values
            .par_chunks_mut(BLOCK * pairs)
            .enumerate()
            .filter_map(|(block, out)| {
                let mut placed = Placed::default();
                let mut rows = out.chunks_mut(pairs).enumerate();
                rows.find_map(|(k, row)| {
                    if let Err(error) = self.cancellation.check() {
                        return Some(error.into());
                    }
                    let at = (block * BLOCK + k) * dofs;
                    let q = &configurations[at..at + dofs];
                    self.proximity.values_into(q, &mut placed, row).err()
                })
            })
            .collect();
        match faults.into_iter().next() {
            Some(error) => Err(error),
            None => Ok(values),
        }
    }

    fn each<T: Send>(
        &self,
        configurations: &[f64],
        ask: impl Fn(&[f64], &mut Placed) -> Result<T, RobotError> + Sync,
    ) -> Result<Vec<T>, RobotError> {
        let (count, dofs) = (self.count(configurations)?, self.proximity.num_dofs());
        let blocks: Vec<Result<Vec<T>, RobotError>> = (0..count.div_ceil(BLOCK))
            .into_par_iter()
            .map(|block| {
                let mut placed = Placed::default();
                let own = block * BLOCK..count.min((block + 1) * BLOCK);
                own.map(|k| {
                    self.cancellation.check()?;
                    ask(&configurations[k * dofs..(k + 1) * dofs], &mut placed)
                })
                .collect()
            })
            .collect();
        let mut answers = Vec::with_capacity(count);
        for block in blocks {
            answers.extend(block?);
        }
        Ok(answers)
    }

    /// How many configurations follow each other; of a robot without DOFs one, and no value.
    fn count(&self, configurations: &[f64]) -> Result<usize, RobotError> {
        self.proximity.motion.batch(configurations)
    }
}
