//! The terms of a coupling, added up.

use urdd_format::index::DofIdx;
use urdd_format::loops::CouplingTerm;

/// A sum that is smaller than this fraction of its summands is 0.
const ROUNDING: f64 = 1e-14;

/// The polynomial in m q + o as one in q: its constant and coefficients.
pub(super) fn substituted([a, b, c, d]: [f64; 4], m: f64, o: f64) -> (f64, [f64; 4]) {
    let coefficients = [
        m * (a + o * (2.0 * b + o * (3.0 * c + o * 4.0 * d))),
        m * m * (b + o * (3.0 * c + o * 6.0 * d)),
        m * m * m * (c + 4.0 * o * d),
        m * m * m * m * d,
    ];
    (o * (a + o * (b + o * (c + o * d))), coefficients)
}

/// What is added up for a coupling; of each number, the sum and the sum of the absolute values.
pub(super) struct Terms {
    constant: [f64; 2],
    terms: Vec<(CouplingTerm, [f64; 4])>,
}

impl Terms {
    pub(super) fn new(constant: f64) -> Self {
        Terms { constant: [constant, constant.abs()], terms: Vec::new() }
    }

    pub(super) fn add_constant(&mut self, constant: f64, size: f64) {
        self.constant[0] += constant;
        self.constant[1] += size;
    }

    pub(super) fn add(&mut self, dof_idx: DofIdx, coefficients: [f64; 4], sizes: Option<[f64; 4]>) {
        let sizes = sizes.unwrap_or_else(|| coefficients.map(f64::abs));
        let Some((term, of)) = self.terms.iter_mut().find(|(term, _)| term.dof_idx == dof_idx)
        else {
            return self.terms.push((CouplingTerm { dof_idx, coefficients }, sizes));
        };
        for place in 0..4 {
            term.coefficients[place] += coefficients[place];
            of[place] += sizes[place];
        }
    }

    /// The constant, and the terms that are not 0, by their DOFs. What is left by rounding alone is 0.
    pub(super) fn done(self) -> (f64, Vec<CouplingTerm>) {
        let rounded = |sum: f64, size: f64| if sum.abs() <= ROUNDING * size { 0.0 } else { sum };
        let [constant, size] = self.constant;
        let terms = self.terms.into_iter().map(|(mut term, sizes)| {
            for (sum, size) in term.coefficients.iter_mut().zip(sizes) {
                *sum = rounded(*sum, size);
            }
            term
        });
        let is_there = |term: &CouplingTerm| term.coefficients.iter().any(|x| *x != 0.0);
        let mut terms: Vec<CouplingTerm> = terms.filter(is_there).collect();
        terms.sort_by_key(|term| term.dof_idx);
        (rounded(constant, size), terms)
    }
}
