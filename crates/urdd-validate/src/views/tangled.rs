//! Shapes whose rows of a matrix are wrong as a whole, so that one mistake gives one finding.

use crate::tolerance::numbers_agree;
use urdd_document::shape_matrices::{Elements, at};

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
