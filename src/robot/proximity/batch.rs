//! Questions about many configurations, which follow each other in one list.

use rayon::prelude::*;

use super::{Placed, Proximity};
use crate::robot::error::RobotError;

/// Configurations that one thread works on at once.
const BLOCK: usize = 32;

impl Proximity {
    /// Whether the robot collides with itself in each configuration, as [`Proximity::in_collision`].
    ///
    /// # Errors
    /// [`RobotError::Batch`] where the values are no whole number of configurations; and as
    /// [`Proximity::distances`], for the first configuration that has none.
    pub fn in_collision_batch(&self, configurations: &[f64]) -> Result<Vec<bool>, RobotError> {
        self.each(configurations, |q, placed| self.collides(q, placed))
    }

    /// The least distance in each configuration, metres, as [`Proximity::self_distance`]: infinite where there is no
    /// pair.
    ///
    /// # Errors
    /// As [`Proximity::in_collision_batch`].
    pub fn self_distance_batch(&self, configurations: &[f64]) -> Result<Vec<f64>, RobotError> {
        self.each(configurations, |q, placed| {
            let least = self.least(q, 1, placed)?;
            Ok(least
                .first()
                .map_or(f64::INFINITY, |(distance, _)| *distance))
        })
    }

    /// The distances of all pairs in each configuration, metres: value `k * pairs + pair` is that of `pair`, in the
    /// order of [`Proximity::pairs`], in configuration `k`.
    ///
    /// # Errors
    /// As [`Proximity::in_collision_batch`].
    pub fn distances_batch(&self, configurations: &[f64]) -> Result<Vec<f64>, RobotError> {
        let (count, dofs, pairs) = (
            self.count(configurations)?,
            self.num_dofs(),
            self.pairs.len(),
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
                    let at = (block * BLOCK + k) * dofs;
                    let q = &configurations[at..at + dofs];
                    self.values_into(q, &mut placed, row).err()
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
        let (count, dofs) = (self.count(configurations)?, self.num_dofs());
        let blocks: Vec<Result<Vec<T>, RobotError>> = (0..count.div_ceil(BLOCK))
            .into_par_iter()
            .map(|block| {
                let mut placed = Placed::default();
                let own = block * BLOCK..count.min((block + 1) * BLOCK);
                own.map(|k| ask(&configurations[k * dofs..(k + 1) * dofs], &mut placed))
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
        self.motion.batch(configurations)
    }
}
