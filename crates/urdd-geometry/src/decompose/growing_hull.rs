//! An incremental convex hull that tracks its volume and area.
//!
//! The plain incremental (beneath-beyond) construction: removes the faces that see the new point, and connects the
//! horizon's edges to it. Tests each face for each point: with a hundred faces, that is faster than conflict lists. Their
//! planes are in a SIMD layout, so that a hull does not depend on the machine (`lanes`).
//!
//! First moves each point by a small pseudo-random step, so that no four points are coplanar ("joggled input", Barber
//! and Huhdanpaa, Qhull manual). CAD models are full of flat faces, which break a plain incremental hull. So this hull
//! serves only the search and the choice of vertices; [`crate::hull`] makes the final pieces.

use fearless_simd::{Level, Simd, dispatch, prelude::*};

use super::part::{dot, normal, sub};
use crate::lanes::{LANES as WIDTH, Mask, Num, Vec3, splat};

#[derive(Clone, Default)]
pub(super) struct GrowingHull {
    /// The points of the hull, jittered, except those of the initial hull.
    pub points: Vec<[f64; 3]>,
    jitter: f64,
    corners: Vec<[u16; 3]>,
    planes: Planes,
    area: Vec<f64>,
    free: Vec<u32>,
    /// The faces that the point to be inserted sees.
    seen: Above,
    /// The horizon edges: the first corner in the upper half.
    edges: Vec<u32>,
    volume6: f64,
    area_sum: f64,
}

impl GrowingHull {
    /// A hull of four points; `None` if the last is at most `thinnest` from the plane of the others. `jitter` is the
    /// maximum displacement of points along each axis.
    pub fn tetrahedron(p: [[f64; 3]; 4], thinnest: f64, jitter: f64) -> Option<Self> {
        let n = normal([p[0], p[1], p[2]]);
        let side = dot(n, sub(p[3], p[0]));
        if side.abs() <= thinnest * dot(n, n).sqrt() {
            return None;
        }
        let mut hull = GrowingHull { points: p.to_vec(), jitter, ..GrowingHull::default() };
        let faces = if side > 0.0 {
            [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
        } else {
            [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
        };
        hull.volume6 = side.abs();
        for f in faces {
            hull.add_face(f);
        }
        Some(hull)
    }

    /// A small octahedron around `centre`. Starting from it makes every later hull solid, so that flat and thin parts
    /// need no special cases. Its size is far below what the search resolves.
    pub fn seed(centre: [f64; 3], radius: f64) -> Self {
        let mut hull = GrowingHull { jitter: radius * 1e-4, ..GrowingHull::default() };
        for axis in 0..3 {
            for sign in [radius, -radius] {
                let mut p = centre;
                p[axis] += sign;
                hull.points.push(p);
            }
        }
        for code in 0..8_u16 {
            let (a, b, c) = (code & 1, 2 + (code >> 1 & 1), 4 + (code >> 2 & 1));
            let even = (code & 1) + (code >> 1 & 1) + (code >> 2 & 1);
            hull.add_face(if even % 2 == 0 { [a, b, c] } else { [a, c, b] });
        }
        hull.volume6 = 8.0 * radius * radius * radius;
        hull
    }

    fn add_face(&mut self, f: [u16; 3]) {
        let corners = f.map(|i| self.points[i as usize]);
        let n = normal(corners);
        let length = dot(n, n).sqrt();
        let n = if length > 0.0 { n.map(|x| x / length) } else { [0.0; 3] };
        let offset = if length > 0.0 { dot(n, corners[0]) } else { 0.0 };
        self.area_sum += length;
        if let Some(slot) = self.free.pop() {
            let i = slot as usize;
            self.corners[i] = f;
            self.planes.set(i, n, offset);
            self.area[i] = length;
        } else {
            self.corners.push(f);
            self.planes.push(n, offset);
            self.area.push(length);
        }
    }

    pub fn volume(&self) -> f64 {
        self.volume6 / 6.0
    }

    /// Number of face slots, including empty ones.
    pub fn slots(&self) -> usize {
        self.planes.slots()
    }

    pub fn area(&self) -> f64 {
        self.area_sum / 2.0
    }

    /// Whether the hull accepts no more points: corners are 16-bit, and more faces than Euler's formula allows mean
    /// that rounding has broken the hull.
    fn is_full(&self) -> bool {
        self.points.len() >= usize::from(u16::MAX) || self.slots() > 2 * self.points.len()
    }

    /// The point moved by up to `jitter` along each axis; depends only on the insertion index.
    fn moved(&self, p: [f64; 3]) -> [f64; 3] {
        let mut state = self.points.len() as u64;
        p.map(|x| {
            // SplitMix64 (Steele, Lea and Flood, 2014).
            state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            x + self.jitter * ((z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0)
        })
    }

    /// The face slot whose plane the point is farthest above, and its height, which is negative below all planes.
    pub fn farthest_face(&self, p: [f64; 3]) -> (u32, f64) {
        self.planes.highest(Level::new(), p)
    }

    /// Slots whose faces the last insertion removed.
    pub fn removed(&self) -> &[u32] {
        &self.seen.slots
    }

    /// The corners of a face slot, as indices of `points`.
    pub fn face(&self, slot: u32) -> [u16; 3] {
        self.corners[slot as usize]
    }

    /// The slot, the corners and the area of each face.
    pub fn faces(&self) -> impl Iterator<Item = (usize, [u16; 3], f64)> {
        (0..self.corners.len())
            .filter(|&i| !self.planes.is_empty(i))
            .map(|i| (i, self.corners[i], self.area[i] / 2.0))
    }

    /// The indices of points that are corners of a face, ascending.
    pub fn used(&self) -> Vec<usize> {
        let mut used = vec![false; self.points.len()];
        for (slot, f) in self.corners.iter().enumerate() {
            if !self.planes.is_empty(slot) {
                f.iter().for_each(|&i| used[i as usize] = true);
            }
        }
        (0..used.len()).filter(|&i| used[i]).collect()
    }

    /// Inserts `p`. Returns false if the hull already contains it within `eps` (which must exceed the jitter), or is
    /// full.
    pub fn insert(&mut self, p: [f64; 3], eps: f64) -> bool {
        let p = self.moved(p);
        if self.is_full() || !self.planes.above(Level::new(), p, eps, &mut self.seen) {
            return false;
        }
        self.edges.clear();
        for &slot in &self.seen.slots {
            let i = slot as usize;
            self.volume6 += self.seen.heights[i] * self.area[i];
            self.area_sum -= self.area[i];
            let [a, b, c] = self.corners[i].map(u32::from);
            for (from, to) in [(a, b), (b, c), (c, a)] {
                // An edge seen from both sides is not on the horizon.
                let opposite = to << 16 | from;
                match self.edges.iter().position(|&e| e == opposite) {
                    Some(k) => {
                        self.edges.swap_remove(k);
                    }
                    None => self.edges.push(from << 16 | to),
                }
            }
            self.planes.clear(i);
            self.area[i] = 0.0;
            self.free.push(slot);
        }
        let apex = self.points.len() as u16;
        self.points.push(p);
        let edges = std::mem::take(&mut self.edges);
        for e in &edges {
            self.add_face([(e >> 16) as u16, *e as u16, apex]);
        }
        self.edges = edges;
        true
    }
}

/// The offset of an empty slot: every point is below it.
const EMPTY: f64 = f64::INFINITY;

/// Unit normals and offsets of some slots.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Block {
    x: [f64; WIDTH],
    y: [f64; WIDTH],
    z: [f64; WIDTH],
    offset: [f64; WIDTH],
}

const NOTHING: Block =
    Block { x: [0.0; WIDTH], y: [0.0; WIDTH], z: [0.0; WIDTH], offset: [EMPTY; WIDTH] };

#[derive(Clone, Debug, Default)]
struct Planes {
    /// The last one is padded with empty slots.
    blocks: Vec<Block>,
    slots: usize,
}

/// The slots whose planes a point is above, and its heights.
#[derive(Clone, Debug, Default)]
struct Above {
    /// The slots, ascending.
    pub slots: Vec<u32>,
    /// The height above each slot's plane, including negative ones.
    pub heights: Vec<f64>,
}

impl Planes {
    /// Number of slots, including empty ones.
    pub fn slots(&self) -> usize {
        self.slots
    }

    pub fn push(&mut self, normal: [f64; 3], offset: f64) {
        if self.slots.is_multiple_of(WIDTH) {
            self.blocks.push(NOTHING);
        }
        self.slots += 1;
        self.set(self.slots - 1, normal, offset);
    }

    pub fn set(&mut self, slot: usize, normal: [f64; 3], offset: f64) {
        let (block, k) = (&mut self.blocks[slot / WIDTH], slot % WIDTH);
        (block.x[k], block.y[k], block.z[k]) = (normal[0], normal[1], normal[2]);
        block.offset[k] = offset;
    }

    pub fn clear(&mut self, slot: usize) {
        self.set(slot, [0.0; 3], EMPTY);
    }

    pub fn is_empty(&self, slot: usize) -> bool {
        self.blocks[slot / WIDTH].offset[slot % WIDTH] == EMPTY
    }

    /// The slot whose plane the point is farthest above, the first of equals, and its height, which is negative below
    /// all planes.
    pub fn highest(&self, level: Level, p: [f64; 3]) -> (u32, f64) {
        dispatch!(level, simd => highest(simd, &self.blocks, p))
    }

    /// Whether the point is more than `limit` above some plane; if so, `found` gets the planes that it is above.
    pub fn above(&self, level: Level, p: [f64; 3], limit: f64, found: &mut Above) -> bool {
        dispatch!(level, simd => above(simd, &self.blocks, p, limit, found))
    }
}

/// The heights of a point above the planes of a block.
#[inline(always)]
fn heights<S: Simd>(simd: S, block: &Block, point: Vec3<S>) -> Num<S> {
    Vec3::load(simd, [&block.x, &block.y, &block.z]).dot(point)
        - Num::load_array_ref(simd, &block.offset)
}

#[inline(always)]
fn above<S: Simd>(simd: S, blocks: &[Block], p: [f64; 3], limit: f64, found: &mut Above) -> bool {
    let p = Vec3::splat(simd, p);
    let limit = splat(simd, limit);
    if found.heights.len() < blocks.len() * WIDTH {
        found.heights.resize(blocks.len() * WIDTH, 0.0);
    }
    let mut beyond = Mask::splat(simd, false);
    let (rooms, _) = found.heights.as_chunks_mut::<WIDTH>();
    for (block, room) in blocks.iter().zip(rooms) {
        let height = heights(simd, block, p);
        beyond |= height.simd_gt(limit);
        height.store_slice(room);
    }
    if !beyond.any_true() {
        return false;
    }
    let zero = splat(simd, 0.0);
    found.slots.clear();
    let (rooms, _) = found.heights.as_chunks::<WIDTH>();
    for (first, room) in (0..).step_by(WIDTH).zip(&rooms[..blocks.len()]) {
        let mut seen = Num::load_array_ref(simd, room).simd_gt(zero).to_bitmask();
        while seen != 0 {
            found.slots.push(first + seen.trailing_zeros());
            seen &= seen - 1;
        }
    }
    true
}

#[inline(always)]
fn highest<S: Simd>(simd: S, blocks: &[Block], p: [f64; 3]) -> (u32, f64) {
    let p = Vec3::splat(simd, p);
    let mut most = splat(simd, f64::NEG_INFINITY);
    // Block numbers, which doubles represent exactly.
    let mut of = splat(simd, 0.0);
    let (mut number, one) = (of, splat(simd, 1.0));
    for block in blocks {
        let height = heights(simd, block, p);
        let higher = height.simd_gt(most);
        most = higher.select(height, most);
        of = higher.select(number, of);
        number += one;
    }
    let (most, of) = (most.to_array(), of.to_array());
    let mut best = (0, f64::NEG_INFINITY);
    for k in 0..WIDTH {
        let slot = of[k] as u32 * WIDTH as u32 + k as u32;
        if most[k] > best.1 || (most[k] == best.1 && slot < best.0) {
            best = (slot, most[k]);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::levels::levels;

    /// A normal and an offset.
    type Plain = ([f64; 3], f64);

    /// Planes around the origin at distances of about 1. Some repeat one or eight slots later, so that heights are
    /// equal, and every fifth slot is empty.
    fn planes(slots: usize) -> (Planes, Vec<Option<Plain>>) {
        let mut plain: Vec<Option<Plain>> = Vec::new();
        let mut planes = Planes::default();
        for i in 0..slots {
            let x = i.saturating_sub([0, 1, 8][i % 3]) as f64;
            let (z, r) = ((1.9 * x).sin(), (1.9 * x).cos());
            let plane =
                ([r * (2.3 * x).cos(), r * (2.3 * x).sin(), z], 1.0 + 0.1 * (0.7 * x).sin());
            planes.push(plane.0, plane.1);
            plain.push(Some(plane));
        }
        for i in (0..slots).skip(4).step_by(5) {
            planes.clear(i);
            plain[i] = None;
        }
        (planes, plain)
    }

    #[test]
    fn each_instruction_set_sees_what_the_plain_loop_sees() {
        for slots in [1, 3, 7, 8, 9, 16, 23, 100] {
            let (planes, plain) = planes(slots);
            assert_eq!(planes.slots(), slots);
            let height = |p: [f64; 3], i: usize| {
                plain[i].map_or(f64::NEG_INFINITY, |(n, offset)| {
                    n[0] * p[0] + n[1] * p[1] + n[2] * p[2] - offset
                })
            };
            for k in 0..200 {
                let x = f64::from(k);
                let p = [(1.1 * x).sin(), (0.7 * x).cos(), (0.3 * x).sin()].map(|c| 1.3 * c);
                let heights: Vec<f64> = (0..slots).map(|i| height(p, i)).collect();
                let most = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let first = heights.iter().position(|h| *h == most).unwrap_or(0);
                let seen: Vec<u32> =
                    (0..slots as u32).filter(|i| heights[*i as usize] > 0.0).collect();
                for level in levels() {
                    assert_eq!(planes.highest(level, p), (first as u32, most), "{level:?} {slots}");
                    let mut found = Above::default();
                    for limit in [1e-3, most, f64::MAX] {
                        let above = planes.above(level, p, limit, &mut found);
                        assert_eq!(above, most > limit, "{level:?} {slots}");
                        if above {
                            assert_eq!(found.slots, seen, "{level:?} {slots}");
                            assert_eq!(found.heights[..slots], heights, "{level:?} {slots}");
                        }
                    }
                }
            }
        }
    }
}
