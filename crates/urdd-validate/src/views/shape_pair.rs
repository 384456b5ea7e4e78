//! The statistics of a pair of shapes (SPEC 8.5).

use super::tangled::Tangled;
use crate::tolerance::{LEGACY_SAMPLES, mean_tolerance, numbers_agree};
use urdd_document::shape_matrices::{Elements, Statistics, at};

/// Largest distance of shapes in contact, m (SPEC 8.6).
pub const CONTACT: f64 = 0.001;

/// The distances of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Mean distance.
    pub mean: f64,
    /// Smallest distance.
    pub min: f64,
    /// Largest distance.
    pub max: f64,
    /// How far the mean may be outside the other two.
    pub tolerance: f64,
}

/// Reads pairs from the statistics of one kind of shapes.
#[derive(Debug, Clone)]
pub struct Pairs<'a> {
    statistics: Statistics<'a>,
    tangled: [Tangled; 3],
}

impl<'a> Pairs<'a> {
    pub fn new(statistics: &Statistics<'a>) -> Self {
        let three = [statistics.mean, statistics.min, statistics.max];
        Pairs {
            statistics: *statistics,
            tangled: three.map(|rows| Tangled::new(Elements::Distances(rows))),
        }
    }

    /// The distances of shapes i and j. `None` if an element is missing, differs from its mirror, is negative where it
    /// must not be, or is in a row that is wrong as a whole: other rules report these faults.
    pub fn read(&self, i: usize, j: usize) -> Option<Pair> {
        let statistics = &self.statistics;
        let one = |rows| {
            let (a, b) = (at(rows, i, j)?, at(rows, j, i)?);
            let sound = numbers_agree(a, b) && (statistics.num_samples.is_none() || a >= 0.0);
            sound.then_some(a)
        };
        let (mean, min, max) = (one(statistics.mean)?, one(statistics.min)?, one(statistics.max)?);
        if self.tangled.iter().any(|tangled| tangled.pair(i, j)) {
            return None;
        }
        let samples = statistics.num_samples.unwrap_or(LEGACY_SAMPLES);
        Some(Pair { mean, min, max, tolerance: mean_tolerance(samples, min.abs().max(max.abs())) })
    }
}

impl Pair {
    /// Whether the mean lies between the smallest and the largest.
    pub fn in_order(&self) -> bool {
        self.min <= self.mean + self.tolerance && self.mean <= self.max + self.tolerance
    }

    /// Whether the three are equal within a tolerance. Depths, which legacy modules have, count as contact, because
    /// libraries do not agree on them.
    pub fn is_constant(&self, tolerance: f64) -> bool {
        let [mean, min, max] = [self.mean, self.min, self.max].map(|d| d.max(0.0));
        min.max(mean).max(max) - min.min(mean).min(max) <= tolerance
    }

    /// Whether the pair is always in contact; `None` if that depends on rounding.
    pub fn always(&self) -> Option<bool> {
        decided(self.max).then_some(self.max <= CONTACT)
    }

    /// Whether the pair is never in contact; `None` if that depends on rounding.
    pub fn never(&self) -> Option<bool> {
        decided(self.min).then_some(self.min > CONTACT)
    }
}

fn decided(distance: f64) -> bool {
    distance == CONTACT || !numbers_agree(distance, CONTACT)
}
