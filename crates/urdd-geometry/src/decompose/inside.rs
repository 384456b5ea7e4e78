//! Points inside the surface, on a coarse grid.
//!
//! A part of a surface has a smaller hull than the same part of the body. If a solid cylinder is cut into quarters, the
//! quarters of its *surface* leave out its middle. Points inside prevent the search from taking that for a gain, and
//! keep pieces from leaving hollows. If a cut passes near them, they are also projected into it, so that corners
//! between cuts are not lost. Inside is what a flood fill from the grid's border does not reach. So a surface need not
//! be closed, only tight to within a cell. Otherwise it has no inside, and no points are added.

use super::part::Part;
use super::vector::{Bounds, norm, sub};

/// Approximate number of grid cells.
const CELLS: f64 = 8000.0;

/// Maximum number of cells along the largest extent, so that flat links do not get a huge grid.
const MAX_ALONG: f64 = 64.0;

/// Maximum number of surface samples. Links need up to some 50 million (long thin triangles). A tangled mesh that needs
/// more is treated as having no inside.
const MAX_SAMPLES: usize = 100_000_000;

/// Grid cells around the surface, and which of them are inside.
pub(super) struct Flood {
    low: [f64; 3],
    /// Edge length of a cell.
    pub cell: f64,
    count: [usize; 3],
    state: Vec<State>,
}

/// The number of parts into which to divide a triangle's sides, for samples at most `cell / fine` apart.
pub(super) fn parts([a, b, c]: [[f64; 3]; 3], cell: f64, fine: f64) -> usize {
    let longest = norm(sub(b, a)).max(norm(sub(c, a))).max(norm(sub(c, b)));
    (longest / cell * fine).ceil().max(1.0) as usize
}

/// Passes evenly spaced points of a triangle, whose sides are divided into `n` parts, to `take`.
#[inline]
pub(super) fn each_sample([a, b, c]: [[f64; 3]; 3], n: usize, mut take: impl FnMut([f64; 3])) {
    for i in 0..=n {
        for j in 0..=n - i {
            let (u, v) = (i as f64 / n as f64, j as f64 / n as f64);
            take([0, 1, 2].map(|k| a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k])));
        }
    }
}

impl Flood {
    /// `None` if the part has no extent, or needs too many samples.
    pub fn new(part: &Part) -> Option<Flood> {
        let bounds = Bounds::of(part.points.iter().copied());
        let size = bounds.size();
        let cell = (size.iter().product::<f64>() / CELLS).cbrt().max(bounds.extent() / MAX_ALONG);
        if cell <= 0.0 {
            return None;
        }
        let samples = part.triangles.iter().map(|t| {
            let n = parts(part.corners(*t), cell, 3.0);
            (n + 1) * (n + 2) / 2
        });
        if samples.sum::<usize>() > MAX_SAMPLES {
            return None;
        }
        // Add a border of empty cells on all sides.
        let count = size.map(|s| (s / cell).ceil() as usize + 2);
        let state = vec![State::Inside; count.iter().product()];
        let mut out = Flood { low: bounds.min, cell, count, state };
        for t in &part.triangles {
            let corners = part.corners(*t);
            let n = parts(corners, cell, 3.0);
            each_sample(corners, n, |p| {
                let at = out.at(p);
                out.state[at] = State::Surface;
            });
        }
        flood(&mut out.state, count);
        Some(out)
    }

    /// The cell of a point within the bounds, or the nearest cell.
    fn at(&self, p: [f64; 3]) -> usize {
        let i = [0, 1, 2]
            .map(|a| (((p[a] - self.low[a]) / self.cell) as usize + 1).min(self.count[a] - 2));
        (i[2] * self.count[1] + i[1]) * self.count[0] + i[0]
    }

    /// Centres of the cells inside, in the part's coordinates. Everything within half a cell of a centre is inside.
    pub fn centres(&self) -> Vec<[f64; 3]> {
        let [nx, ny, _] = self.count;
        let inside = (0..self.state.len()).filter(|&k| self.state[k] == State::Inside);
        inside
            .map(|k| {
                let i = [k % nx, k / nx % ny, k / (nx * ny)];
                [0, 1, 2].map(|a| self.low[a] + (i[a] as f64 - 0.5) * self.cell)
            })
            .collect()
    }
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum State {
    /// Not reached (yet).
    Inside,
    Surface,
    Outside,
}

/// Marks everything reachable from the first cell, which is in the border.
pub(super) fn flood(state: &mut [State], count: [usize; 3]) {
    let mut stack = vec![0];
    state[0] = State::Outside;
    let steps = [1, count[0], count[0] * count[1]];
    while let Some(k) = stack.pop() {
        for (a, step) in steps.into_iter().enumerate() {
            let place = k / step % count[a];
            let mut visit = |next: usize| {
                if state[next] == State::Inside {
                    state[next] = State::Outside;
                    stack.push(next);
                }
            };
            if place > 0 {
                visit(k - step);
            }
            if place + 1 < count[a] {
                visit(k + step);
            }
        }
    }
}

#[cfg(test)]
#[path = "tests/inside.rs"]
mod tests;
