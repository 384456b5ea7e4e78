//! Points inside the surface, and distances from it, on grids.
//!
//! A part of a surface has a smaller hull than the same part of the body. If a solid cylinder is cut into quarters, the
//! quarters of its *surface* leave out its middle. Points inside ([`Flood`]) prevent the search from taking that for a
//! gain, and keep pieces from leaving hollows. If a cut passes near them, they are also projected into it, so that corners
//! between cuts are not lost. Inside is what a flood fill from the grid's border does not reach. So a surface need not
//! be closed, only tight to within a cell. Otherwise it has no inside, and no points are added.
//!
//! A piece adds to the mean standoff the integral, over its outside faces, of the distance to the surface. So the nodes
//! of another grid ([`Field`]) store signed distances, negative inside, which are interpolated. Sweeps that pass triangles
//! from node to node find each node's nearest triangle (Danielsson, "Euclidean distance mapping", 1980).

use super::growing_hull::GrowingHull;
use super::part::{Bounds, Part, Plane, dot, nearest_on_triangle, norm, normal, sub};

/// Approximate number of grid cells.
const CELLS: f64 = 8000.0;

/// Maximum number of cells along the largest extent, so that flat links do not get a huge grid.
const MAX_ALONG: f64 = 64.0;

/// Maximum number of surface samples. Links need up to some 50 million (long thin triangles). A tangled mesh that needs
/// more is treated as having no inside.
const MAX_FLOOD_SAMPLES: usize = 100_000_000;

/// Grid cells around the surface, and which of them are inside.
pub(super) struct Flood {
    low: [f64; 3],
    /// Edge length of a cell.
    pub cell: f64,
    count: [usize; 3],
    state: Vec<State>,
}

/// The number of parts into which to divide a triangle's sides, for samples at most `cell / fine` apart.
fn parts([a, b, c]: [[f64; 3]; 3], cell: f64, fine: f64) -> usize {
    let longest = norm(sub(b, a)).max(norm(sub(c, a))).max(norm(sub(c, b)));
    (longest / cell * fine).ceil().max(1.0) as usize
}

/// Passes evenly spaced points of a triangle, whose sides are divided into `n` parts, to `take`.
#[inline]
fn each_sample([a, b, c]: [[f64; 3]; 3], n: usize, mut take: impl FnMut([f64; 3])) {
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
        if samples.sum::<usize>() > MAX_FLOOD_SAMPLES {
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
enum State {
    /// Not reached (yet).
    Inside,
    Surface,
    Outside,
}

/// Marks everything reachable from the first cell, which is in the border.
fn flood(state: &mut [State], count: [usize; 3]) {
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

/// Nodes along the largest extent.
const ALONG: f64 = 40.0;

/// Maximum number of nodes.
const MAX_NODES: f64 = 20_000.0;

/// Approximate maximum number of surface samples; links need a tenth of it.
const MAX_SAMPLES: usize = 500_000;

/// Nodes nearer to the surface than this count as next to it, in cells.
const NEXT_TO: f64 = 0.6;

/// Cells between the samples of a face, and maximum samples along one side.
const SPREAD: f64 = 4.0;
const MAX_SIDE: usize = 3;

/// Signed distances on a grid around the surface, in unit coordinates.
pub(super) struct Field {
    low: [f64; 3],
    cell: f64,
    count: [usize; 3],
    value: Vec<f32>,
}

impl Field {
    /// Inside is what a flood fill from the border does not reach, as in [`Flood`]. Next to the surface, the triangles'
    /// orientation decides.
    pub fn new(part: &Part) -> Field {
        let bounds = Bounds::of(part.points.iter().copied());
        let size = bounds.size();
        let extent = bounds.extent();
        let thick = size.map(|s| s.max(extent / ALONG));
        let cell = (extent / ALONG)
            .max((thick.iter().product::<f64>() / MAX_NODES).cbrt())
            .max(f64::MIN_POSITIVE);
        let count = size.map(|s| (s / cell).ceil() as usize + 3);
        let low = bounds.min.map(|x| x - cell);
        let mut out = Field { low, cell, count, value: Vec::new() };
        let nearest = out.nearest(part);
        let away: Vec<([f64; 3], f64)> = (0..nearest.len())
            .map(|k| {
                let Some(t) = part.triangles.get(nearest[k] as usize) else {
                    return ([0.0; 3], 0.0);
                };
                let p = out.node(k);
                let away = sub(p, nearest_on_triangle(p, part.corners(*t)));
                (away, norm(away))
            })
            .collect();
        // Two neighbours on different sides of a surface cannot both be farther from it than half their distance.
        let near = NEXT_TO * cell;
        let mut state: Vec<State> = away
            .iter()
            .map(|(_, far)| if *far <= near { State::Surface } else { State::Inside })
            .collect();
        flood(&mut state, count);
        out.value = (0..nearest.len())
            .map(|k| {
                let (away, far) = away[k];
                let behind = |t: &[u32; 3]| dot(normal(part.corners(*t)), away) < 0.0;
                let inside = match state[k] {
                    State::Inside => true,
                    State::Outside => false,
                    State::Surface => part.triangles.get(nearest[k] as usize).is_some_and(behind),
                };
                (if inside { -far } else { far }) as f32
            })
            .collect();
        out
    }

    fn node(&self, k: usize) -> [f64; 3] {
        let [nx, ny, _] = self.count;
        let i = [k % nx, k / nx % ny, k / (nx * ny)];
        [0, 1, 2].map(|a| self.low[a] + self.cell * i[a] as f64)
    }

    fn nearest(&self, part: &Part) -> Vec<u32> {
        let [nx, ny, nz] = self.count;
        let mut best = vec![(f64::INFINITY, u32::MAX); nx * ny * nz];
        let try_at = |best: &mut [(f64, u32)], k: usize, t: u32| {
            if best[k].1 != t {
                let p = self.node(k);
                let e = sub(p, nearest_on_triangle(p, part.corners(part.triangles[t as usize])));
                if dot(e, e) < best[k].0 {
                    best[k] = (dot(e, e), t);
                }
            }
        };
        let sides = |t: &[u32; 3]| parts(part.corners(*t), self.cell, 1.0);
        let samples = part.triangles.iter().map(|t| sides(t) * sides(t));
        let coarser = 1 + samples.sum::<usize>() / MAX_SAMPLES;
        for (t, triangle) in part.triangles.iter().enumerate() {
            let n = (sides(triangle) / coarser).max(1);
            let mut last = usize::MAX;
            each_sample(part.corners(*triangle), n, |p| {
                let at = self.place(p).map(|x| x as usize);
                let k = (at[2] * ny + at[1]) * nx + at[0];
                if k == last {
                    return;
                }
                last = k;
                for corner in 0..8 {
                    let step = (corner & 1) + (corner >> 1 & 1) * nx + (corner >> 2) * nx * ny;
                    try_at(&mut best, k + step, t as u32);
                }
            });
        }
        let strides = [1, nx, nx * ny];
        for backwards in [false, true] {
            for at in 0..best.len() {
                let k = if backwards { best.len() - 1 - at } else { at };
                for (a, stride) in strides.into_iter().enumerate() {
                    let place = k / stride % self.count[a];
                    let from = match backwards {
                        false if place > 0 => k - stride,
                        true if place + 1 < self.count[a] => k + stride,
                        _ => continue,
                    };
                    let triangle = best[from].1;
                    if triangle != u32::MAX {
                        try_at(&mut best, k, triangle);
                    }
                }
            }
        }
        best.into_iter().map(|b| b.1).collect()
    }

    /// Distance outside the surface at a point in unit coordinates; 0 inside.
    pub fn at(&self, p: [f64; 3]) -> f64 {
        self.at_place(self.place(p))
    }

    /// A point in cells from the first node.
    fn place(&self, p: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|a| (p[a] - self.low[a]) / self.cell)
    }

    /// As [`Field::at`], at a point in cells from the first node.
    #[inline]
    fn at_place(&self, p: [f64; 3]) -> f64 {
        let [nx, ny, _] = self.count;
        let mut base = [0_usize; 3];
        let mut f = [0.0_f64; 3];
        for a in 0..3 {
            let x = p[a].clamp(0.0, (self.count[a] - 1) as f64);
            base[a] = (x as usize).min(self.count[a] - 2);
            f[a] = x - base[a] as f64;
        }
        let k = (base[2] * ny + base[1]) * nx + base[0];
        let row = |step: usize| {
            let two = self.value.get(k + step..).and_then(|v| v.first_chunk());
            let [v, w] = two.map_or([0.0; 2], |two: &[f32; 2]| two.map(f64::from));
            v + f[0] * (w - v)
        };
        let plane = |step: usize| {
            let low = row(step);
            low + f[1] * (row(step + nx) - low)
        };
        let low = plane(0);
        (low + f[2] * (plane(nx * ny) - low)).max(0.0)
    }

    /// Passes evenly spread points of a triangle in unit coordinates to `take`, each for the same part of its area;
    /// returns their number.
    pub fn spread(&self, corners: [[f64; 3]; 3], take: impl FnMut([f64; 3])) -> usize {
        spread(corners, SPREAD * self.cell, take)
    }

    /// The integral of distances over the faces of a hull in the coordinates of `frame`. Skips faces in one of the
    /// planes, where another piece begins. `known` is what is known of the hull from earlier calls.
    pub fn standoff(
        &self,
        hull: &GrowingHull,
        frame: &[[f64; 3]; 3],
        planes: &[Plane],
        known: &mut Known,
    ) -> f64 {
        let turn = |p: [f64; 3]| {
            [0, 1, 2].map(|a| p[0] * frame[0][a] + p[1] * frame[1][a] + p[2] * frame[2][a])
        };
        let fresh = hull.points.iter().skip(known.points.len());
        known.points.extend(fresh.map(|&p| turn(p)));
        known.faces.resize(hull.slots(), ([0; 3], 0.0));
        let mut sum = 0.0;
        for (slot, face, area) in hull.faces() {
            let corners = face.map(|i| known.points[i as usize]);
            if known.faces[slot].0 != face {
                let places = corners.map(|p| self.place(p));
                let mut of_face = 0.0;
                let n = spread(places, SPREAD, |p| of_face += self.at_place(p));
                known.faces[slot] = (face, of_face / n as f64 * area);
            }
            let of_face = known.faces[slot].1;
            if of_face > 0.0 && !in_cut(corners, planes) {
                sum += of_face;
            }
        }
        sum
    }
}

/// What the standoff of a growing hull found at its last call.
#[derive(Clone, Default)]
pub(super) struct Known {
    /// The hull's points in unit coordinates.
    points: Vec<[f64; 3]>,
    /// The integral over each face, by slot.
    faces: Vec<([u16; 3], f64)>,
}

/// Passes evenly spread points of a triangle to `take`, at most [`MAX_SIDE`] along a side, and about `apart` from each
/// other. Returns their number.
#[inline]
fn spread([a, b, c]: [[f64; 3]; 3], apart: f64, mut take: impl FnMut([f64; 3])) -> usize {
    let (ab, ac) = (sub(b, a), sub(c, a));
    let bc = sub(c, b);
    let longest = dot(ab, ab).max(dot(ac, ac)).max(dot(bc, bc)).sqrt();
    // Rounds up without `ceil`, which would be a function call.
    let n = ((longest / apart) as usize).saturating_add(1).min(MAX_SIDE);
    // The centroids of the n^2 triangles between parallels to the sides.
    let side = 1.0 / (3 * n) as f64;
    for i in 0..n {
        for j in 0..n - i {
            let mut at = |u: usize, v: usize| {
                let (u, v) = (u as f64 * side, v as f64 * side);
                take([0, 1, 2].map(|k| a[k] + u * ab[k] + v * ac[k]));
            };
            at(3 * i + 1, 3 * j + 1);
            if i + j + 1 < n {
                at(3 * i + 2, 3 * j + 2);
            }
        }
    }
    n * n
}

/// Whether a face is in one of the planes, where another piece begins.
pub(super) fn in_cut(corners: [[f64; 3]; 3], planes: &[Plane]) -> bool {
    let lies = |plane: &Plane| corners.iter().all(|&p| plane.height(p).abs() <= IN_CUT);
    planes.iter().any(lies)
}

/// A face with no corner farther from a cut than this is in the cut.
const IN_CUT: f64 = 1e-3;

#[cfg(test)]
#[path = "tests/field.rs"]
mod tests;
