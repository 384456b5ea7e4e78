//! Distance statistics of pairs of shapes, as recorded in the URDD.

use super::Robot;
use super::error::RobotError;
use super::shapes::ShapeKind;
use urdd_document::shape_matrices::{at, statistics};
use urdd_document::urdd::Urdd;
use urdd_format::registry::ModuleKind;

const MODULE: ModuleKind = ModuleKind::LinkShapesDistanceStatistics;

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

impl PairStatistics {
    /// Those of two shapes of a kind; `None` if `part` has none of that module, kind or pair.
    pub(super) fn of(part: &Urdd, kind: ShapeKind, i: usize, j: usize) -> Option<Self> {
        let one = statistics(part.document(MODULE)?)?[kind as usize]?;
        let [mean, min, max] = [one.mean, one.min, one.max].map(|matrix| at(matrix, i, j));
        Some(PairStatistics { mean: mean?, min: min?, max: max? })
    }
}

/// Each method fails if the files of the URDD cannot be listed.
impl Robot {
    /// The module of statistics, if there is one.
    pub(super) fn statistics(&self) -> Result<Urdd, RobotError> {
        self.part_as_it_is(&[MODULE])
    }

    /// Number of configurations that the statistics cover; `None` if the URDD does not record it.
    pub fn num_samples(&self) -> Result<Option<u32>, RobotError> {
        let part = self.statistics()?;
        let six = part.document(MODULE).and_then(statistics);
        Ok(six.and_then(|six| six.into_iter().flatten().find_map(|one| one.num_samples)))
    }

    /// The statistics of a pair of shapes of a kind, by their indices (SPEC 8.1); `None` if the URDD has none.
    pub fn pair_statistics(
        &self,
        kind: ShapeKind,
        i: usize,
        j: usize,
    ) -> Result<Option<PairStatistics>, RobotError> {
        Ok(PairStatistics::of(&self.statistics()?, kind, i, j))
    }
}
