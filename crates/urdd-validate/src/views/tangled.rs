//! Pairs of shapes: shapes whose rows of a matrix are wrong as a whole, so that one mistake gives one finding, and the
//! statistics of a pair (SPEC 8.5).

use crate::tolerance::{LEGACY_SAMPLES, mean_tolerance, numbers_agree};
use urdd_document::shape_matrices::{Elements, Statistics, at};

/// The *tangled* shapes of a matrix. Rows that were swapped or written in another order make a matrix asymmetric, its
/// diagonal wrong, and sometimes pairs wrong in both directions. All of that is one mistake, which SHP006 or SHP007
/// reports.
#[derive(Debug, Clone)]
pub struct Tangled {
    asymmetric: Vec<bool>,
    off_diagonal: Vec<bool>,
}

impl Tangled {
    pub fn new(elements: Elements<'_>) -> Tangled {
        let rows = elements.rows();
        let mut asymmetric = vec![false; rows];
        for i in 0..rows {
            for j in i + 1..rows {
                if !symmetric_at(elements, i, j) {
                    asymmetric[i] = true;
                    asymmetric[j] = true;
                }
            }
        }
        let off_diagonal = (0..rows).map(|i| !diagonal_sound(elements, i)).collect();
        Tangled { asymmetric, off_diagonal }
    }

    /// Whether some element of the shape differs from its mirror, which SHP006 reports.
    pub fn asymmetric(&self, shape: usize) -> bool {
        self.asymmetric.get(shape).copied().unwrap_or(false)
    }

    /// Whether both shapes of a pair have faults that SHP006 or SHP007 report.
    pub fn pair(&self, i: usize, j: usize) -> bool {
        let tangled = |shape| {
            self.asymmetric(shape) || self.off_diagonal.get(shape).copied().unwrap_or(false)
        };
        tangled(i) && tangled(j)
    }
}

/// Whether the elements (i, j) and (j, i) of a matrix agree; true if one is missing.
pub fn symmetric_at(elements: Elements<'_>, i: usize, j: usize) -> bool {
    fn agree<T: Copy>(rows: &[Vec<T>], i: usize, j: usize, same: fn(T, T) -> bool) -> bool {
        match (at(rows, i, j), at(rows, j, i)) {
            (Some(a), Some(b)) => same(a, b),
            _ => true,
        }
    }
    match elements {
        Elements::Distances(rows) => agree(rows, i, j, numbers_agree),
        Elements::Skips(rows) => agree(rows, i, j, |a, b| a == b),
        Elements::Reasons(rows) => agree(rows, i, j, |a, b| a == b),
        Elements::Models(rows) => agree(rows, i, j, |a, b| {
            a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| numbers_agree(*a, *b))
        }),
    }
}

/// Every pair of shapes, each once.
pub fn pairs(shapes: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..shapes).flat_map(move |i| (i + 1..shapes).map(move |j| (i, j)))
}

/// The element of a pair in both directions; `None` if the two differ, which SHP006 reports.
pub fn of_pair<T: Copy + PartialEq>(rows: &[Vec<T>], i: usize, j: usize) -> Option<T> {
    at(rows, i, j).filter(|element| at(rows, j, i) == Some(*element))
}

/// Every pair of shapes with its element, without pairs that SHP006 or SHP007 report.
pub fn sound_pairs<'a, T: Copy + PartialEq>(
    rows: &'a [Vec<T>],
    elements: fn(&'a [Vec<T>]) -> Elements<'a>,
) -> impl Iterator<Item = (usize, usize, T)> {
    let tangled = Tangled::new(elements(rows));
    pairs(rows.len()).filter_map(move |(i, j)| {
        let element = of_pair(rows, i, j).filter(|_| !tangled.pair(i, j))?;
        Some((i, j, element))
    })
}

/// Whether the element (i, i) of a matrix has the value of every diagonal: distance 0, skip true. Always true for reasons
/// and models.
pub fn diagonal_sound(elements: Elements<'_>, i: usize) -> bool {
    match elements {
        Elements::Distances(rows) => at(rows, i, i).is_none_or(|d| numbers_agree(d, 0.0)),
        Elements::Skips(rows) => at(rows, i, i).unwrap_or(true),
        Elements::Reasons(_) | Elements::Models(_) => true,
    }
}

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
