//! Shapes whose rows of a matrix are wrong as a whole, so that one mistake gives one message.

use crate::tolerance::numbers_agree;
use urdd_document::shape_matrices::{Elements, at};

/// The shapes of a matrix that are *tangled*: rows that were exchanged, or written in another order,
/// make a matrix asymmetric, its diagonal wrong, and with luck some pairs wrong both ways round. All of
/// that is one mistake, which the first of these rules tells.
#[derive(Debug, Clone)]
pub struct Tangled {
    asymmetric: Vec<bool>,
    off_diagonal: Vec<bool>,
}

impl Tangled {
    /// Looks through a square matrix.
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
        Tangled {
            asymmetric,
            off_diagonal,
        }
    }

    /// Whether some element of the shape is not that of its mirror: SHP006 tells.
    pub fn asymmetric(&self, shape: usize) -> bool {
        self.asymmetric.get(shape).copied().unwrap_or(false)
    }

    /// Whether both shapes of a pair have faults that SHP006 or SHP007 tell.
    pub fn pair(&self, i: usize, j: usize) -> bool {
        let tangled = |shape| {
            self.asymmetric(shape) || self.off_diagonal.get(shape).copied().unwrap_or(false)
        };
        tangled(i) && tangled(j)
    }
}

/// Whether the elements (i, j) and (j, i) of a matrix agree; so they do where one is missing.
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
            let mut pairs = a.iter().flatten().zip(b.iter().flatten());
            pairs.all(|(a, b)| numbers_agree(*a, *b))
        }),
    }
}

/// Whether the element (i, i) of a matrix is what every diagonal has: distance 0, skip true. Reasons
/// and models are not judged here.
pub fn diagonal_sound(elements: Elements<'_>, i: usize) -> bool {
    match elements {
        Elements::Distances(rows) => at(rows, i, i).is_none_or(|d| numbers_agree(d, 0.0)),
        Elements::Skips(rows) => at(rows, i, i).unwrap_or(true),
        Elements::Reasons(_) | Elements::Models(_) => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn skips(rows: [[bool; 3]; 3]) -> Tangled {
        let rows: Vec<Vec<bool>> = rows.iter().map(|row| row.to_vec()).collect();
        Tangled::new(Elements::Skips(&rows))
    }

    #[test]
    fn exchanged_rows_are_tangled_and_others_are_not() {
        let sound = skips([
            [true, false, true],
            [false, true, false],
            [true, false, true],
        ]);
        assert!((0..3).all(|i| !sound.asymmetric(i) && !sound.pair(i, i)));
        // The last two rows exchanged.
        let exchanged = skips([
            [true, false, true],
            [true, false, true],
            [false, true, false],
        ]);
        assert!(exchanged.asymmetric(1) && exchanged.pair(1, 2));
        // Equal but for the two diagonal elements and those across.
        let across = skips([
            [true, false, false],
            [false, false, true],
            [false, true, false],
        ]);
        assert!(!across.asymmetric(1) && across.pair(1, 2) && !across.pair(0, 1));
    }
}
