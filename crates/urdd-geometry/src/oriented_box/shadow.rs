//! The smallest box with a given axis: the extent of the hull along the axis, times the minimum-area rectangle of its
//! projection along the axis (its *shadow*).
//!
//! Dot products with several axes are computed at once; one lane is one axis. A box does not depend on the machine
//! (`lanes`).

use fearless_simd::{Level, Simd, dispatch, prelude::*};
use nalgebra::Vector3;

use super::calipers::{Rectangle, outline, smallest_rectangle};
use crate::hull::ConvexHull;
pub(super) use crate::lanes::LANES as AXES;
use crate::lanes::{Vec3, splat};

/// An edge of the hull between two triangles whose planes differ.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// The vertices, in the direction of `left`.
    pub vertices: [u32; 2],
    /// The triangle that has the edge in this direction.
    pub left: u32,
    /// The other triangle.
    pub right: u32,
}

/// A hull, prepared for many shadows.
pub struct Caster {
    /// The vertices, relative to the first vertex.
    vertices: Vec<Vector3<f64>>,
    /// The triangles' unit normals; zero for a degenerate triangle.
    pub normals: Vec<Vector3<f64>>,
    /// Edges whose triangles' normals differ.
    pub edges: Vec<Edge>,
    /// The unit normal of the largest triangle.
    pub largest_normal: Vector3<f64>,
    /// Upper bound of the distance between two vertices: the diagonal of the bounding box.
    diameter: f64,
    /// For each triangle, the set of axes that it faces along.
    lit: Vec<u8>,
    /// For each edge, the set of axes that only one of its triangles faces along; eight edges per word.
    border: Vec<u64>,
    /// For each vertex on the outline, the next one.
    next: Vec<u32>,
    polygon: Vec<[f64; 2]>,
}

/// The smallest box with a given axis.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// Volume, cubic metres.
    pub volume: f64,
    /// Upper bound of the decrease of the volume per radian of rotation, cubic metres.
    pub steepness: f64,
    /// The three unit axes, right-handed; the first is the given one.
    pub axes: [Vector3<f64>; 3],
}

impl Caster {
    pub fn new(hull: &ConvexHull) -> Self {
        let mesh = hull.mesh();
        let vertex = |i: u32| Vector3::from(mesh.vertices[i as usize]);
        let areas = mesh.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(vertex);
            (b - a).cross(&(c - a))
        });
        let unit = |area: Vector3<f64>| area.try_normalize(0.0).unwrap_or_default();
        let normals: Vec<Vector3<f64>> = areas.clone().map(unit).collect();
        let largest = areas.max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
        let mut halves: Vec<(u32, u32, bool, u32)> = Vec::with_capacity(3 * normals.len());
        for (t, triangle) in mesh.triangles.iter().enumerate() {
            for k in 0..3 {
                let (from, to) = (triangle[k], triangle[(k + 1) % 3]);
                halves.push((from.min(to), from.max(to), from > to, t as u32));
            }
        }
        halves.sort_unstable();
        let (pairs, _) = halves.as_chunks();
        let edges: Vec<Edge> = pairs
            .iter()
            .map(|&[(from, to, _, left), (.., right)]| Edge { vertices: [from, to], left, right })
            .filter(|edge| normals[edge.left as usize] != normals[edge.right as usize])
            .collect();
        // Relative to a vertex, so that small shapes far from the origin keep their precision.
        let vertices: Vec<Vector3<f64>> =
            (0..mesh.vertices.len() as u32).map(|i| vertex(i) - vertex(0)).collect();
        let sides = [0, 1, 2].map(|k| {
            let along = || vertices.iter().map(|p| p[k]);
            along().fold(0.0, f64::max) - along().fold(0.0, f64::min)
        });
        Self {
            largest_normal: largest.map(unit).unwrap_or_default(),
            diameter: Vector3::from(sides).norm(),
            lit: Vec::new(),
            border: Vec::new(),
            normals,
            edges,
            next: vec![0; vertices.len()],
            vertices,
            polygon: Vec::new(),
        }
    }

    /// The unit vector along an edge.
    pub fn along(&self, edge: &Edge) -> Vector3<f64> {
        let [from, to] = edge.vertices.map(|i| self.vertices[i as usize]);
        (to - from).normalize()
    }

    /// The smallest box with this unit vector as an axis; `None` if the shadow has no area.
    pub fn smallest_box(&mut self, axis: &Vector3<f64>) -> Option<Candidate> {
        self.smallest_boxes(&[*axis])[0]
    }

    /// The same for 1 to [`AXES`] axes at once, with less work for each. The values after the last axis are `None`.
    pub fn smallest_boxes(&mut self, axes: &[Vector3<f64>]) -> [Option<Candidate>; AXES] {
        let lanes = Axes::new(axes);
        let [low, high] = reach(Level::new(), &self.vertices, &lanes);
        self.light(&lanes);
        std::array::from_fn(|a| {
            let axis = axes.get(a)?;
            let (u, v) = across(axis);
            let Rectangle { area, half_perimeter, side } = self.shadow(a, [&u, &v])?;
            let (length, second) = (high[a] - low[a], u * side[0] + v * side[1]);
            Some(Candidate {
                volume: length * area,
                steepness: self.diameter * (area + length * half_perimeter),
                axes: [*axis, second, axis.cross(&second)],
            })
        })
    }

    /// Finds the triangles that face along the axes, and the border edges between these and the others.
    fn light(&mut self, axes: &Axes) {
        beyond(Level::new(), &self.normals, axes, GRAZING, &mut self.lit);
        let border = self.edges.chunks(8).map(|edges| {
            let mut word = [0; 8];
            for (byte, edge) in word.iter_mut().zip(edges) {
                *byte = self.lit[edge.left as usize] ^ self.lit[edge.right as usize];
            }
            u64::from_le_bytes(word)
        });
        self.border.clear();
        self.border.extend(border);
    }

    /// The minimum-area rectangle of the shadow along an axis, in the coordinates `u` and `v`.
    ///
    /// The shadow's outline is the border of the triangles that face along the axis (the silhouette).
    fn shadow(&mut self, axis: usize, [u, v]: [&Vector3<f64>; 2]) -> Option<Rectangle> {
        let (mut count, mut vertex) = (0, 0);
        for (words, edges) in self.border.chunks(8).zip(self.edges.chunks(64)) {
            let mut set = one_axis(words, axis);
            while set != 0 {
                let edge = &edges[set.trailing_zeros() as usize];
                set &= set - 1;
                let [from, to] = edge.vertices;
                let left = self.lit[edge.left as usize] >> axis & 1 == 1;
                let (from, to) = if left { (from, to) } else { (to, from) };
                self.next[from as usize] = to;
                vertex = from;
                count += 1;
            }
        }
        let vertices = &self.vertices;
        let project = |p: &Vector3<f64>| [u.dot(p), v.dot(p)];
        self.polygon.clear();
        let start = vertex;
        for _ in 0..count {
            self.polygon.push(project(&vertices[vertex as usize]));
            vertex = self.next[vertex as usize];
        }
        if count < 3 || vertex != start {
            // Rounding broke the border, or no triangle faces along the axis: the hull is flat and seen edge-on.
            self.polygon.clear();
            self.polygon.extend(vertices.iter().map(project));
            outline(&mut self.polygon);
        }
        smallest_rectangle(&mut self.polygon)
    }
}

/// The set of edges whose bit `axis` is set, from up to eight words of eight edges each.
fn one_axis(words: &[u64], axis: usize) -> u64 {
    /// The lowest bit of each byte.
    const LOWEST: u64 = 0x0101_0101_0101_0101;
    /// Multiplying a word of lowest bits by this gathers them in the highest byte, the first byte's bit lowest.
    const GATHER: u64 = 0x0102_0408_1020_4080;
    let mut set = 0;
    for (k, word) in words.iter().enumerate() {
        set |= ((word >> axis & LOWEST).wrapping_mul(GATHER) >> 56) << (8 * k);
    }
    set
}

/// A triangle counts as parallel to the axis if the cosine between its normal and the axis is below this. Its shadow is
/// then thinner than this fraction of its size.
const GRAZING: f64 = 1e-9;

/// Two unit vectors that complete an axis to a right-handed frame; the axis is the first of the frame.
fn across(axis: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let mut least = Vector3::zeros();
    least[axis.iamin()] = 1.0;
    let u = axis.cross(&least).normalize();
    (u, axis.cross(&u))
}

/// The x, y and z coordinates of the axes.
pub struct Axes([[f64; AXES]; 3]);

impl Axes {
    /// From 1 to [`AXES`] axes; the first axis fills unused lanes.
    pub fn new(axes: &[Vector3<f64>]) -> Self {
        let of = |k: usize| std::array::from_fn(|a| axes.get(a).unwrap_or(&axes[0])[k]);
        Self([of(0), of(1), of(2)])
    }
}

/// One number for each axis.
pub type Each = [f64; AXES];

/// The minimum and maximum dot product of each axis with the vectors.
pub fn reach(level: Level, vectors: &[Vector3<f64>], axes: &Axes) -> [Each; 2] {
    dispatch!(level, simd => reach_in(simd, vectors, axes))
}

/// For each vector, the set of axes with a dot product greater than `limit`.
pub fn beyond(
    level: Level,
    vectors: &[Vector3<f64>],
    axes: &Axes,
    limit: f64,
    found: &mut Vec<u8>,
) {
    found.resize(vectors.len(), 0);
    dispatch!(level, simd => beyond_in(simd, vectors, axes, limit, found));
}

#[inline(always)]
fn reach_in<S: Simd>(simd: S, vectors: &[Vector3<f64>], Axes([x, y, z]): &Axes) -> [Each; 2] {
    let axes = Vec3::load(simd, [x, y, z]);
    let mut low = splat(simd, f64::INFINITY);
    let mut high = splat(simd, f64::NEG_INFINITY);
    for v in vectors {
        let along = axes.dot(Vec3::splat(simd, (*v).into()));
        low = along.simd_lt(low).select(along, low);
        high = along.simd_gt(high).select(along, high);
    }
    [low.to_array(), high.to_array()]
}

#[inline(always)]
fn beyond_in<S: Simd>(
    simd: S,
    vectors: &[Vector3<f64>],
    Axes([x, y, z]): &Axes,
    limit: f64,
    found: &mut [u8],
) {
    let axes = Vec3::load(simd, [x, y, z]);
    let limit = splat(simd, limit);
    for (v, found) in vectors.iter().zip(found) {
        let along = axes.dot(Vec3::splat(simd, (*v).into()));
        *found = along.simd_gt(limit).to_bitmask() as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::levels::levels;

    #[test]
    fn each_instruction_set_finds_what_the_plain_loop_finds() {
        // On a coarse grid, so that many dot products equal each other or the limits.
        let vectors = |count: u32, shift: f64| -> Vec<Vector3<f64>> {
            (0..count)
                .map(|i| f64::from(i) + shift)
                .map(|x| Vector3::new((1.7 * x).sin(), (2.3 * x).cos(), (0.9 * x).sin()))
                .map(|v| v.map(|x| (4.0 * x).round() / 4.0))
                .collect()
        };
        for (count, num_axes) in [(1, 1), (2, 8), (7, 3), (8, 5), (9, 8), (100, 7)] {
            let (list, axes) = (vectors(count, 1.0), vectors(num_axes, 0.5));
            for level in levels() {
                let [low, high] = reach(level, &list, &Axes::new(&axes));
                for (a, axis) in axes.iter().enumerate() {
                    let dot = |v: &Vector3<f64>| axis.x * v.x + axis.y * v.y + axis.z * v.z;
                    let dots = || list.iter().map(dot);
                    let plain = [
                        dots().fold(f64::INFINITY, f64::min),
                        dots().fold(f64::NEG_INFINITY, f64::max),
                    ];
                    assert_eq!([low[a], high[a]], plain, "{level:?} {count} {a}");
                    let mut found = Vec::new();
                    for limit in [0.0, 0.25, plain[1]] {
                        beyond(level, &list, &Axes::new(&axes), limit, &mut found);
                        let found = found.iter().map(|bits| bits >> a & 1 == 1);
                        let plain = dots().map(|d| d > limit);
                        assert!(found.eq(plain), "{level:?} {count} {a} {limit}");
                    }
                }
            }
        }
    }
}
