//! Distance statistics of pairs of shapes, as recorded in the URDD.

use super::Robot;
use super::error::RobotError;
use super::shapes::ShapeKind;
use urdd_document::shape_matrices::{Statistics, at, statistics};
use urdd_format::registry::ModuleKind;

/// Distance statistics of a pair of shapes over the sampled configurations, in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairStatistics {
    /// The mean.
    pub mean: f64,
    /// The smallest.
    pub min: f64,
    /// The largest.
    pub max: f64,
}

/// The statistics of all pairs of shapes of one kind.
#[derive(Debug, Clone)]
pub(super) struct AllStatistics {
    mean: Vec<Vec<f64>>,
    min: Vec<Vec<f64>>,
    max: Vec<Vec<f64>>,
}

impl AllStatistics {
    fn of(one: Statistics<'_>) -> Self {
        Self { mean: one.mean.to_vec(), min: one.min.to_vec(), max: one.max.to_vec() }
    }

    pub fn pair(&self, i: usize, j: usize) -> Option<PairStatistics> {
        Some(PairStatistics {
            mean: at(&self.mean, i, j)?,
            min: at(&self.min, i, j)?,
            max: at(&self.max, i, j)?,
        })
    }
}

impl Robot {
    /// The statistics of a kind of shapes; `None` if the module is missing or has none for this kind.
    pub(super) fn statistics(&self, kind: ShapeKind) -> Result<Option<AllStatistics>, RobotError> {
        let module = ModuleKind::LinkShapesDistanceStatistics;
        let part = self.part_as_it_is(&[module])?;
        let six = part.document(module).and_then(statistics);
        let one = six.and_then(|six| six[kind as usize]);
        Ok(one.map(AllStatistics::of))
    }

    /// Number of configurations that the statistics cover; `None` if the URDD does not record it.
    ///
    /// # Errors
    /// If the files of the URDD cannot be listed.
    pub fn num_samples(&self) -> Result<Option<u32>, RobotError> {
        let module = ModuleKind::LinkShapesDistanceStatistics;
        let part = self.part_as_it_is(&[module])?;
        let six = part.document(module).and_then(statistics);
        Ok(six.and_then(|six| six.into_iter().flatten().find_map(|one| one.num_samples)))
    }

    /// The statistics of a pair of shapes of a kind, by their indices (SPEC 8.1); `None` if the URDD has none.
    ///
    /// # Errors
    /// If the files of the URDD cannot be listed.
    pub fn pair_statistics(
        &self,
        kind: ShapeKind,
        i: usize,
        j: usize,
    ) -> Result<Option<PairStatistics>, RobotError> {
        Ok(self.statistics(kind)?.and_then(|all| all.pair(i, j)))
    }
}
