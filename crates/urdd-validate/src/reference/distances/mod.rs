//! Distances between shapes in the sampled configurations (SPEC 9.3), recomputed from the modules: mesh files, boxes
//! and spheres, kinematics.
//!
//! The number of configurations depends on counted work, not on time, so that results are reproducible: see [`plan`].

pub mod plan;
pub mod poses;
pub mod shape_set;

use self::plan::Work;
use self::poses::Poses;
use self::shape_set::ShapeSet;
use crate::skip;
use crate::solids::Solids;
use urdd_document::shape_matrices::statistics;
use urdd_document::shapes::Shapes;
use urdd_document::urdd::Urdd;
use urdd_findings::skip::SkipReason;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;
use urdd_geometry::convex::{Motion, PairStatistics};

pub struct Distances {
    /// In the order of [`ShapeKind::ALL`]; `None` for a kind without statistics.
    pub kinds: [Option<KindDistances>; 6],
    /// Link poses in the first configurations.
    first: Motion,
    default: Motion,
}

/// The distances of one kind of shapes.
pub struct KindDistances {
    pub shapes: ShapeSet,
    /// Whether these are all configurations of the statistics.
    pub complete: bool,
    /// Where not complete, exact only outside the stated ranges, and without means.
    found: PairStatistics,
}

/// The distances of a pair. Where not all configurations were used, `min` and `max` are exact only outside the stated
/// range, and `mean` is not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Mean distance, m.
    pub mean: f64,
    /// Smallest distance, m.
    pub min: f64,
    /// Largest distance, m.
    pub max: f64,
}

impl Distances {
    /// Recomputes the statistics of a URDD of version 1, as far as the allowed work permits.
    ///
    /// # Errors
    /// Why there is nothing to compare with.
    pub fn new(urdd: &Urdd, solids: &Solids, deep: bool) -> Result<Self, SkipReason> {
        let recorded = urdd
            .document(ModuleKind::LinkShapesDistanceStatistics)
            .and_then(statistics)
            .ok_or(skip::STATISTICS_UNUSABLE)?;
        let mut stated = recorded.iter().flatten();
        let num_samples = stated.find_map(|one| one.num_samples).ok_or(skip::SAMPLES_UNKNOWN)?;
        if num_samples == 0 {
            return Err(skip::NO_SAMPLES);
        }
        let poses = Poses::new(urdd)?;
        let shapes = Shapes::new(urdd).ok_or(skip::NO_SHAPES)?;
        let sets: Vec<Option<ShapeSet>> = (ShapeKind::ALL.into_iter().zip(&recorded))
            .map(|(kind, one)| one.map(|_| ShapeSet::new(urdd, solids, &shapes, kind, true)))
            .collect();
        let work: Vec<Option<Work>> =
            sets.iter().map(|set| set.as_ref().map(|set| set.work(&poses))).collect();
        let configurations = plan::configurations(&work, num_samples, plan::budget(deep));

        let default = poses.default_motion()?;
        let first = poses.motion(0..num_samples.min(plan::AT_ONCE))?;
        let mut kinds: [Option<KindDistances>; 6] = Default::default();
        let planned = recorded.iter().zip(sets).zip(configurations);
        for (kind, ((stated, set), n)) in kinds.iter_mut().zip(planned) {
            let (Some(stated), Some(shapes)) = (stated, set) else { continue };
            let complete = n == num_samples;
            let found = over(&poses, &first, n, |motion| {
                if complete { shapes.statistics(motion) } else { shapes.ranges(motion, stated) }
            })?;
            *kind = Some(KindDistances { shapes, complete, found });
        }
        Ok(Distances { kinds, first, default })
    }

    /// The distances of all pairs in the default configuration, by the indices of [`ShapeSet::place`].
    pub fn at_default_configuration(&self, kind: &KindDistances) -> Vec<Vec<f64>> {
        kind.shapes.statistics(&self.default).min
    }

    /// The first of the configurations in which the distance of a pair satisfies `outside`, and that distance.
    pub fn find(
        &self,
        kind: &KindDistances,
        (i, j): (usize, usize),
        outside: impl Fn(f64) -> bool,
    ) -> Option<(usize, f64)> {
        let each = kind.shapes.pair(i, j, &self.first)?.into_iter();
        each.enumerate().find(|(_, distance)| outside(*distance))
    }
}

impl KindDistances {
    /// The distances of a pair; `None` if one of the two shapes is unsound, which other rules report.
    pub fn pair(&self, i: usize, j: usize) -> Option<Found> {
        let (i, j) = (self.shapes.place(i)?, self.shapes.place(j)?);
        let at = |rows: &[Vec<f64>]| rows.get(i)?.get(j).copied();
        Some(Found {
            mean: at(&self.found.mean)?,
            min: at(&self.found.min)?,
            max: at(&self.found.max)?,
        })
    }
}

/// The statistics over the first `n` configurations, some of which are in `first`.
fn over(
    poses: &Poses,
    first: &Motion,
    n: u32,
    statistics: impl Fn(&Motion) -> PairStatistics,
) -> Result<PairStatistics, SkipReason> {
    if n as usize == first.num_samples() {
        return Ok(statistics(first));
    }
    let mut all = PairStatistics::default();
    let mut start = 0;
    while start < n {
        let end = n.min(start + plan::AT_ONCE);
        let part = statistics(&poses.motion(start..end)?);
        match start {
            0 => all = part,
            _ => join(&mut all, &part, start, end),
        }
        start = end;
    }
    Ok(all)
}

/// Adds the statistics of configurations `start..end`.
pub fn join(all: &mut PairStatistics, part: &PairStatistics, start: u32, end: u32) {
    let weight = f64::from(end - start) / f64::from(end);
    let each = |into: &mut [Vec<f64>], from: &[Vec<f64>], put: &dyn Fn(&mut f64, f64)| {
        let pairs = into.iter_mut().flatten().zip(from.iter().flatten());
        pairs.for_each(|(into, from)| put(into, *from));
    };
    each(&mut all.mean, &part.mean, &|into, from| {
        *into += (from - *into) * weight;
    });
    each(&mut all.min, &part.min, &|into, from| *into = into.min(from));
    each(&mut all.max, &part.max, &|into, from| *into = into.max(from));
}
