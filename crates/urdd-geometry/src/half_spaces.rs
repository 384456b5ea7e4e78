//! The half-spaces of a body's faces, several side by side, so that results do not depend on the machine (`lanes`).

use fearless_simd::{Level, Simd, dispatch, prelude::*};

use crate::lanes::{LANES as WIDTH, Num, Vec3, splat};

/// The inner side of a face's plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpace {
    /// Outward normal of unit length.
    pub normal: [f64; 3],
    /// Distance of the plane from the origin along the normal, m.
    pub offset: f64,
    /// How far outside a point of a convex body may appear, m: the corners of a face are known to the resolution, and
    /// the resulting tilt of its plane grows with the distance from a thin face.
    pub slack: f64,
}

#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
struct Block {
    normal: [[f64; WIDTH]; 3],
    offset: [f64; WIDTH],
    slack: [f64; WIDTH],
}

/// One half-space or more.
#[derive(Debug)]
pub struct HalfSpaces {
    /// The last block is padded by repetition.
    blocks: Vec<Block>,
    len: usize,
    level: Level,
}

impl HalfSpaces {
    /// `None` without half-spaces.
    pub fn new(list: &[HalfSpace]) -> Option<Self> {
        let first = list.first()?;
        let block = |chunk: &[HalfSpace]| {
            let all: [HalfSpace; WIDTH] = std::array::from_fn(|k| *chunk.get(k).unwrap_or(first));
            Block {
                normal: std::array::from_fn(|axis| all.map(|h| h.normal[axis])),
                offset: all.map(|h| h.offset),
                slack: all.map(|h| h.slack),
            }
        };
        let blocks = list.chunks(WIDTH).map(block).collect();
        Some(Self { blocks, len: list.len(), level: Level::new() })
    }

    /// Their number.
    #[expect(clippy::len_without_is_empty, reason = "it is not empty")]
    pub fn len(&self) -> usize {
        self.len
    }

    /// The largest distance of a point beyond a plane, m, among planes that it is beyond by more than their slack;
    /// minus infinity if there are none.
    pub fn beyond(&self, point: [f64; 3]) -> f64 {
        dispatch!(self.level, simd => beyond(simd, &self.blocks, point))
    }

    /// The distance of a point from the nearest plane, m; negative beyond one.
    pub fn depth(&self, point: [f64; 3]) -> f64 {
        dispatch!(self.level, simd => depth(simd, &self.blocks, point))
    }

    /// Whether a point is beyond no plane by more than `distance` or, if that is larger, its slack up to `resolution`.
    pub fn hold(&self, point: [f64; 3], distance: f64, resolution: f64) -> bool {
        dispatch!(self.level, simd => hold(simd, &self.blocks, point, distance, resolution))
    }
}

/// The coordinates of a point along the normals of a block.
#[inline(always)]
fn along<S: Simd>(simd: S, block: &Block, point: Vec3<S>) -> Num<S> {
    let [x, y, z] = &block.normal;
    Vec3::load(simd, [x, y, z]).dot(point)
}

#[inline(always)]
fn beyond<S: Simd>(simd: S, blocks: &[Block], point: [f64; 3]) -> f64 {
    let point = Vec3::splat(simd, point);
    let mut most = splat(simd, f64::NEG_INFINITY);
    for block in blocks {
        let beyond = along(simd, block, point) - Num::load_array_ref(simd, &block.offset);
        let slack = Num::load_array_ref(simd, &block.slack);
        let more = beyond.simd_gt(most) & beyond.simd_gt(slack);
        most = more.select(beyond, most);
    }
    let most = most.to_array();
    most.into_iter().fold(f64::NEG_INFINITY, f64::max)
}

#[inline(always)]
fn depth<S: Simd>(simd: S, blocks: &[Block], point: [f64; 3]) -> f64 {
    let point = Vec3::splat(simd, point);
    let mut least = splat(simd, f64::INFINITY);
    for block in blocks {
        let depth = Num::load_array_ref(simd, &block.offset) - along(simd, block, point);
        least = depth.simd_lt(least).select(depth, least);
    }
    least.to_array().into_iter().fold(f64::INFINITY, f64::min)
}

#[inline(always)]
fn hold<S: Simd>(
    simd: S,
    blocks: &[Block],
    point: [f64; 3],
    distance: f64,
    resolution: f64,
) -> bool {
    let point = Vec3::splat(simd, point);
    let distance = splat(simd, distance);
    let resolution = splat(simd, resolution);
    for block in blocks {
        let beyond = along(simd, block, point) - Num::load_array_ref(simd, &block.offset);
        let slack = Num::load_array_ref(simd, &block.slack);
        let slack = slack.simd_lt(resolution).select(slack, resolution);
        let within = beyond.simd_le(distance) | beyond.simd_le(slack);
        if !within.all_true() {
            return false;
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::levels::levels;

    #[test]
    fn each_instruction_set_finds_what_the_plain_loop_finds() {
        for count in [1, 3, 7, 8, 9, 20, 64] {
            // Every third one repeats the one eight before, so that distances are equal.
            let list: Vec<HalfSpace> = (0..count)
                .map(|i: usize| if i.is_multiple_of(3) { i.saturating_sub(8) } else { i })
                .map(|i| {
                    let x = i as f64;
                    let (z, r) = ((1.9 * x).sin(), (1.9 * x).cos());
                    HalfSpace {
                        normal: [r * (2.3 * x).cos(), r * (2.3 * x).sin(), z],
                        offset: 1.0,
                        slack: if i.is_multiple_of(2) { 1e-3 } else { 0.3 },
                    }
                })
                .collect();
            let mut all = HalfSpaces::new(&list).expect("one");
            assert_eq!(all.len(), count);
            for k in 0..300 {
                let x = f64::from(k);
                let p = [(1.1 * x).sin(), (0.7 * x).cos(), (0.3 * x).sin()].map(|c| 1.1 * c);
                let along =
                    |h: &HalfSpace| h.normal[0] * p[0] + h.normal[1] * p[1] + h.normal[2] * p[2];
                let heights = || list.iter().map(|h| (along(h) - h.offset, h.slack));
                let beyond = heights().filter(|(height, slack)| height > slack);
                let beyond = beyond.map(|(height, _)| height).fold(f64::NEG_INFINITY, f64::max);
                let depths = list.iter().map(|h| h.offset - along(h));
                let depth = depths.fold(f64::INFINITY, f64::min);
                for level in levels() {
                    all.level = level;
                    assert_eq!(all.beyond(p), beyond, "{level:?} {count} {k}");
                    assert_eq!(all.depth(p), depth, "{level:?} {count} {k}");
                    for (distance, resolution) in
                        [(0.0, 0.1), (0.2, 0.1), (-depth, 0.0), (-depth, 1.0)]
                    {
                        let within = |(height, slack): (f64, f64)| {
                            height <= distance.max(slack.min(resolution))
                        };
                        let hold = all.hold(p, distance, resolution);
                        assert_eq!(hold, heights().all(within), "{level:?} {count} {k}");
                    }
                }
            }
        }
    }
}
