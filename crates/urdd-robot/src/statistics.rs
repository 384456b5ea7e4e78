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

/// The statistics of all pairs of shapes of one kind.
pub(super) struct AllStatistics {
    part: Urdd,
    kind: ShapeKind,
}

impl AllStatistics {
    pub fn pair(&self, i: usize, j: usize) -> Option<PairStatistics> {
        let one = statistics(self.part.document(MODULE)?)?[self.kind as usize]?;
        Some(PairStatistics {
            mean: at(one.mean, i, j)?,
            min: at(one.min, i, j)?,
            max: at(one.max, i, j)?,
        })
    }
}

impl Robot {
    /// The statistics of a kind of shapes; without a pair if the module is missing or has none for this kind.
    pub(super) fn statistics(&self, kind: ShapeKind) -> Result<AllStatistics, RobotError> {
        Ok(AllStatistics { part: self.part_as_it_is(&[MODULE])?, kind })
    }

    /// Number of configurations that the statistics cover; `None` if the URDD does not record it.
    ///
    /// # Errors
    /// If the files of the URDD cannot be listed.
    pub fn num_samples(&self) -> Result<Option<u32>, RobotError> {
        let part = self.part_as_it_is(&[MODULE])?;
        let six = part.document(MODULE).and_then(statistics);
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
        Ok(self.statistics(kind)?.pair(i, j))
    }
}
