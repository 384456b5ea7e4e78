//! The planes of a hull's faces, in a SIMD layout, so that a hull does not depend on the machine (`lanes`).

use fearless_simd::{Level, Simd, dispatch, prelude::*};

use crate::lanes::{LANES as WIDTH, Mask, Num, Vec3, splat};

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

/// Slots for planes, some of them empty.
#[derive(Clone, Debug, Default)]
pub(super) struct Planes {
    /// The last one is padded with empty slots.
    blocks: Vec<Block>,
    slots: usize,
}

/// The slots whose planes a point is above, and its heights.
#[derive(Clone, Debug, Default)]
pub(super) struct Above {
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
#[path = "tests/planes.rs"]
mod tests;
