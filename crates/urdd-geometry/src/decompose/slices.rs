//! Hulls of the cut search, which grow slice by slice: the planes to try, the slices of a part between parallel planes,
//! and their support points.
//!
//! A part may have thousands of points. For the *search*, the farthest point in each of [`COUNT`] directions describes
//! its hull well enough. Scaling along the axes does not change which points are hull corners, so flat sets are best
//! scaled to a cube first: then the directions find their rims.

use std::sync::LazyLock;

use fearless_simd::{Level, Simd, dispatch, f32x16, prelude::*, u32x16};
use rayon::join;

use super::field::{Field, Known};
use super::growing_hull::GrowingHull;
use super::part::{Bounds, Part, Plane, dot, lerp, norm};
use crate::vector::spread;

/// Weight of a hull's bulk relative to its standoff. Deep narrow hollows have little standoff, but must still be cut.
const BULK: f64 = 0.1;

/// Thickness t of the bulk, in unit coordinates (1 is half the link's largest extent).
const THICKNESS: f64 = 1e-3;

/// Radius of the octahedron that hulls of the search start from, in unit coordinates.
pub(super) const SEED: f64 = 1e-4;

/// Minimum outward step that grows a hull of the search, as a fraction of the part's largest extent. For a cylinder,
/// the lost volume is below 2 %.
const STEP: f64 = 2.5e-3;

/// Three orthonormal axes, of which the last is normal to the planes, and the flat coordinates to try along it,
/// ascending.
pub(super) type Frame = ([[f64; 3]; 3], Vec<f64>);

/// Parameters of the planes to try; the same for all parts of a link.
pub(super) struct Places {
    pub frames: Vec<Frame>,
    /// Points without a triangle this near to a plane are also projected into it.
    pub reach: f64,
    /// Points this near to a plane count as in it.
    pub eps: f64,
    pub field: Field,
}

/// The identity frame.
pub(super) const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Places {
    /// The standoff of a hull in the coordinates of `frame`; faces in one of the planes do not count.
    pub fn standoff(&self, hull: &mut Grower, frame: &[[f64; 3]; 3], planes: &[Plane]) -> f64 {
        self.field.standoff(&hull.hull, frame, planes, &mut hull.known)
    }

    /// What `new` makes of the parts below and above a plane; `None` if one of them has no surface.
    pub fn split<T: Send>(
        &self,
        part: &Part,
        plane: &Plane,
        new: impl Fn(Part) -> T + Sync,
    ) -> Option<[T; 2]> {
        let [below, above] = part.split(plane, self.eps, self.reach);
        if below.triangles.is_empty() || above.triangles.is_empty() {
            return None;
        }
        let (below, above) = join(|| new(below), || new(above));
        Some([below, above])
    }

    /// Standoff and bulk.
    pub fn cost(&self, hull: &mut Grower, frame: &[[f64; 3]; 3], planes: &[Plane]) -> f64 {
        self.standoff(hull, frame, planes) + bulk(&hull.hull)
    }
}

/// The bulk of a hull: a fraction of V + t A / 2.
pub(super) fn bulk(hull: &GrowingHull) -> f64 {
    BULK * (hull.volume() + THICKNESS * hull.area() / 2.0)
}

/// A growing hull for the search.
#[derive(Clone)]
pub(super) struct Grower {
    pub hull: GrowingHull,
    pub step: f64,
    known: Known,
}

impl Grower {
    /// An empty hull; `extent` is the largest extent of the points to come.
    pub fn new(extent: f64) -> Self {
        Grower {
            hull: GrowingHull::default(),
            step: (STEP * extent).max(4.0 * SEED),
            known: Known::default(),
        }
    }

    /// The hull of all points.
    pub fn of(points: &[[f64; 3]]) -> Self {
        let mut hull = Grower::new(Bounds::of(points.iter().copied()).extent());
        hull.add(points);
        hull
    }

    pub fn add(&mut self, points: &[[f64; 3]]) {
        for &p in points {
            if self.hull.points.is_empty() {
                self.hull = GrowingHull::seed(p, SEED);
            } else {
                self.hull.insert(p, self.step);
            }
        }
    }
}

/// The support points of a part's slices between parallel planes, and of the sections in these planes.
pub(super) struct Slices {
    slices: Vec<Vec<[f64; 3]>>,
    sections: Vec<Vec<[f64; 3]>>,
}

impl Slices {
    /// Slices across z of the coordinates `turned`, which are those in `frame`; planes ascending.
    pub fn new(
        part: &Part,
        turned: &[[f64; 3]],
        frame: &[[f64; 3]; 3],
        planes: &[f64],
        places: &Places,
    ) -> Self {
        let eps = places.eps;
        let bounds = Bounds::of(turned.iter().copied());
        // Odd code 2k+1: inside slice k. Even code 2k: in plane k-1, between slices k-1 and k.
        let code: Vec<u8> = turned
            .iter()
            .map(|[_, _, x]| {
                let k = planes.partition_point(|&o| o < x - eps);
                let on = k < planes.len() && planes[k] <= x + eps;
                (2 * k + 1 + usize::from(on)) as u8
            })
            .collect();
        let mut sections = vec![Vec::new(); planes.len()];
        let mut cut_points: Vec<[f64; 3]> = Vec::new();
        let flat = Scaling::new(&bounds, 0.0, f64::INFINITY);
        let edge = |k: usize| planes.get(k).copied().unwrap_or(bounds.max[2]);
        let cubes: Vec<Scaling> = (0..=planes.len())
            .map(|k| {
                let from = if k == 0 { bounds.min[2] } else { edge(k - 1) };
                Scaling::new(&bounds, from, edge(k))
            })
            .collect();
        let mut mask = vec![0_u32; part.points.len()];
        for &t in &part.triangles {
            let c = t.map(|i| code[i as usize]);
            let (least, most) = (c[0].min(c[1]).min(c[2]), c[0].max(c[1]).max(c[2]));
            if least == most && least % 2 == 0 {
                // In a plane: goes with the body behind it.
                let bit = 1 << (least / 2 - u8::from(part.faces(t, frame[2])));
                t.iter().for_each(|&i| mask[i as usize] |= bit);
                continue;
            }
            // The first and last slice that the triangle reaches into.
            let (first, last) = (least / 2, (most - 1) / 2);
            for k in 0..3 {
                let v = c[k];
                let bits = if v % 2 == 1 {
                    1 << (v / 2)
                } else {
                    (u32::from(v / 2 > first) << (v / 2 - 1))
                        | (u32::from(v / 2 <= last) << (v / 2))
                };
                mask[t[k] as usize] |= bits;
                if first == last {
                    continue;
                }
                let (i, j) = (t[k] as usize, t[(k + 1) % 3] as usize);
                let (from, to) = (v.min(c[(k + 1) % 3]), v.max(c[(k + 1) % 3]));
                for b in from / 2..(to - 1) / 2 {
                    let (p, q) = (turned[i], turned[j]);
                    let p = lerp(p, q, (planes[b as usize] - p[2]) / (q[2] - p[2]));
                    let index = cut_points.len() as u32;
                    sections[b as usize].push(Candidate::new(flat.apply(p), index));
                    cut_points.push(p);
                }
            }
        }
        let loose =
            part.triangles.iter().filter(|t| Part::is_loose(**t)).map(|t| turned[t[0] as usize]);
        for p in loose.chain(part.inner.iter().map(|&p| frame.map(|axis| dot(axis, p)))) {
            let first = planes.partition_point(|&o| o < p[2] - places.reach);
            for (b, &offset) in planes.iter().enumerate().skip(first) {
                if offset > p[2] + places.reach {
                    break;
                }
                let p = [p[0], p[1], offset];
                sections[b].push(Candidate::new(flat.apply(p), cut_points.len() as u32));
                cut_points.push(p);
            }
        }
        let mut slices = vec![Vec::new(); planes.len() + 1];
        for (i, &m) in mask.iter().enumerate() {
            let mut m = m;
            while m != 0 {
                let k = m.trailing_zeros() as usize;
                slices[k].push(Candidate::new(cubes[k].apply(turned[i]), i as u32));
                m &= m - 1;
            }
        }
        Slices {
            slices: slices.iter().map(|c| support_points(c, turned)).collect(),
            sections: sections.iter().map(|c| support_points(c, &cut_points)).collect(),
        }
    }

    /// Grows a hull over the slices, upwards or downwards. Returns the cost at each plane in that order (zero while the
    /// hull is empty), and the whole hull. `cost` evaluates a hull that ends at the plane with the given index.
    pub fn sweep(
        &self,
        upwards: bool,
        extent: f64,
        cost: impl Fn(&mut Grower, usize) -> f64,
    ) -> (Vec<f64>, Grower) {
        let planes = self.sections.len();
        let mut hull = Grower::new(extent);
        let mut costs = Vec::with_capacity(planes);
        for n in 0..planes {
            let (slice, section) = if upwards { (n, n) } else { (planes - n, planes - 1 - n) };
            hull.add(&self.slices[slice]);
            // A section counts only if the hull is not empty.
            if hull.hull.points.is_empty() {
                costs.push(0.0);
            } else {
                hull.add(&self.sections[section]);
                costs.push(cost(&mut hull, section));
            }
        }
        // Downwards, nobody asks for the whole hull.
        if upwards {
            hull.add(&self.slices[planes]);
        }
        (costs, hull)
    }
}

/// The support points of candidates, whose indices refer to `points`.
fn support_points(candidates: &[Candidate], points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    support(candidates).into_iter().map(|i| points[i as usize]).collect()
}

/// Scaling of a slice to a cube.
struct Scaling {
    centre: [f64; 3],
    factor: [f64; 3],
}

impl Scaling {
    fn new(bounds: &Bounds, from: f64, to: f64) -> Self {
        let (mut low, mut high) = (bounds.min, bounds.max);
        (low[2], high[2]) = (from, to);
        let factor =
            [0, 1, 2].map(|a| if high[a] > low[a] { 2.0 / (high[a] - low[a]) } else { 0.0 });
        let centre =
            [0, 1, 2].map(|a| if factor[a] > 0.0 { (low[a] + high[a]) / 2.0 } else { 0.0 });
        Scaling { centre, factor }
    }

    #[inline]
    fn apply(&self, p: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|a| (p[a] - self.centre[a]) * self.factor[a])
    }
}

const WIDTH: usize = 16;

const ROWS: usize = 3;

const COUNT: usize = ROWS * WIDTH;

/// One value for each direction.
type Row<T> = [[T; WIDTH]; ROWS];

type Directions = [Row<f32>; 3];

/// The 26 directions of a cube's faces, corners and edges, and evenly spread ones for the rest.
static DIRECTIONS: LazyLock<Directions> = LazyLock::new(|| {
    let mut list: Vec<[f64; 3]> = Vec::with_capacity(COUNT);
    for kind in [1, 3, 2] {
        for code in 0..27_i32 {
            let d = [code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1];
            if d.iter().map(|c| c * c).sum::<i32>() == kind {
                list.push(d.map(f64::from));
            }
        }
    }
    list.extend(spread(COUNT - list.len()));
    let mut out = [[[0.0; WIDTH]; ROWS]; 3];
    for (i, d) in list.iter().enumerate() {
        for (row, x) in out.iter_mut().zip(d) {
            row[i / WIDTH][i % WIDTH] = (x / norm(*d)) as f32;
        }
    }
    out
});

/// A point and its index.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    at: [f32; 3],
    index: u32,
}

impl Candidate {
    pub fn new(at: [f64; 3], index: u32) -> Self {
        Candidate { at: at.map(|x| x as f32), index }
    }
}

/// The distinct support points, in the order of the directions; the first of equally far ones.
pub(super) fn support(candidates: &[Candidate]) -> Vec<u32> {
    let mut out: Vec<u32> = Vec::with_capacity(COUNT);
    if candidates.is_empty() {
        return out;
    }
    for &i in farthest_at(Level::new(), candidates).as_flattened() {
        if !out.contains(&i) {
            out.push(i);
        }
    }
    out
}

/// For each direction, the index of the farthest point, the first of equals. `candidates` must not be empty.
fn farthest_at(level: Level, candidates: &[Candidate]) -> Row<u32> {
    dispatch!(level, simd => farthest(simd, &DIRECTIONS, candidates))
}

#[inline(always)]
fn farthest<S: Simd>(simd: S, [x, y, z]: &Directions, candidates: &[Candidate]) -> Row<u32> {
    let mut rows = [[f32x16::splat(simd, 0.0); 3]; ROWS];
    for (k, row) in rows.iter_mut().enumerate() {
        *row = [&x[k], &y[k], &z[k]].map(|row| f32x16::load_array_ref(simd, row));
    }
    let first = candidates.first().map_or(0, |c| c.index);
    let mut value = [f32x16::splat(simd, f32::NEG_INFINITY); ROWS];
    let mut point = [u32x16::splat(simd, first); ROWS];
    for c in candidates {
        let x = f32x16::splat(simd, c.at[0]);
        let y = f32x16::splat(simd, c.at[1]);
        let z = f32x16::splat(simd, c.at[2]);
        let index = u32x16::splat(simd, c.index);
        for k in 0..ROWS {
            let [dx, dy, dz] = rows[k];
            let v = dx * x + dy * y + dz * z;
            let better = v.simd_gt(value[k]);
            value[k] = better.select(v, value[k]);
            point[k] = better.select(index, point[k]);
        }
    }
    [point[0].to_array(), point[1].to_array(), point[2].to_array()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::levels::levels;

    #[test]
    fn each_instruction_set_finds_what_the_plain_loop_finds() {
        for count in [1, 2, 5, 16, 33, 400] {
            // On a coarse grid, so that many are equally far, also in directions with a zero coordinate.
            let candidates: Vec<Candidate> = (0..count)
                .map(|i| {
                    let x = f64::from(i);
                    let p = [(1.7 * x).sin(), (2.3 * x).cos(), (0.9 * x).sin()];
                    Candidate::new(p.map(|c| (4.0 * c).round() / 4.0), 7 * i)
                })
                .collect();
            let d = &*DIRECTIONS;
            let mut plain = [[0; WIDTH]; ROWS];
            for (k, found) in plain.as_flattened_mut().iter_mut().enumerate() {
                let d = d.each_ref().map(|row| row.as_flattened()[k]);
                let along = |c: &Candidate| c.at[0] * d[0] + c.at[1] * d[1] + c.at[2] * d[2];
                let most = candidates.iter().map(along).fold(f32::NEG_INFINITY, f32::max);
                let first = candidates.iter().find(|c| along(c) == most);
                *found = first.expect("one").index;
            }
            for level in levels() {
                assert_eq!(farthest_at(level, &candidates), plain, "{level:?} {count}");
            }
        }
    }
}
