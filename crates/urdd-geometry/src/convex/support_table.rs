//! The farthest vertex in a direction, in constant time.
//!
//! The directions are divided into cells (`cells`). Most cells list one to four vertices, so four dot products find the
//! farthest, however many vertices the shape has.

use fearless_simd::{Simd, f64x4, prelude::*, u64x4};

use super::cells::candidates;

/// Vertices per block.
pub(crate) const WIDTH: usize = 4;

/// Candidates of a cell, padded by repetition.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Block {
    pub x: [f64; WIDTH],
    pub y: [f64; WIDTH],
    pub z: [f64; WIDTH],
    /// Whether the next block continues the same list.
    pub more: bool,
}

/// For each cell of directions, the vertices that are farthest in some direction of it.
#[derive(Clone, Debug)]
pub(crate) struct SupportTable {
    /// Cells along one side of the square map: a power of two.
    side: usize,
    /// The first block of each cell, row by row. Cells share blocks: a cell with few candidates reuses a block that
    /// contains them, so that the blocks fit the cache.
    cells: Vec<u32>,
    blocks: Vec<Block>,
}

impl SupportTable {
    /// From at least one point, all finite.
    pub fn new(points: &[[f64; 3]]) -> Self {
        let side = if points.len() < 24 { 32 } else { 64 };
        let lists = candidates(points, side);
        let mut cells = vec![0; side * side];
        let mut blocks = Vec::new();
        // Longest lists first, then in the order of the cells.
        let mut order: Vec<usize> = (0..lists.len()).collect();
        order.sort_by_key(|&cell| std::cmp::Reverse(lists[cell].len()));
        // For each vertex, the single-block lists that contain it.
        let mut shared: Vec<Vec<(u32, &[u32])>> = vec![Vec::new(); points.len()];
        for cell in order {
            let list = &lists[cell];
            let known = shared[list[0] as usize]
                .iter()
                .find(|(_, other)| list.iter().all(|i| other.contains(i)));
            if let Some(&(block, _)) = known {
                cells[cell] = block;
                continue;
            }
            cells[cell] = blocks.len() as u32;
            if list.len() <= WIDTH {
                for &i in list {
                    shared[i as usize].push((cells[cell], list));
                }
            }
            for (k, chunk) in list.chunks(WIDTH).enumerate() {
                let of = |axis: usize| {
                    std::array::from_fn(|i| points[chunk[i.min(chunk.len() - 1)] as usize][axis])
                };
                blocks.push(Block {
                    x: of(0),
                    y: of(1),
                    z: of(2),
                    more: (k + 1) * WIDTH < list.len(),
                });
            }
        }
        Self { side, cells, blocks }
    }

    /// Cells along one side of the map.
    #[inline(always)]
    pub fn side(&self) -> usize {
        self.side
    }

    /// The vertex that is farthest in a direction of a cell. Out-of-range cell numbers wrap around.
    #[inline(always)]
    pub fn farthest<S: Simd>(&self, simd: S, cell: usize, d: [f64; 3]) -> [f64; 3] {
        let mut at = self.cells[cell & (self.cells.len() - 1)] as usize;
        let mut block = &self.blocks[at];
        let mut most = greatest(simd, block, d);
        let mut k = (most.to_bits() & (WIDTH as u64 - 1)) as usize;
        let mut point = [block.x[k], block.y[k], block.z[k]];
        while block.more {
            at += 1;
            block = &self.blocks[at];
            let other = greatest(simd, block, d);
            if other > most {
                most = other;
                k = (most.to_bits() & (WIDTH as u64 - 1)) as usize;
                point = [block.x[k], block.y[k], block.z[k]];
            }
        }
        point
    }
}

/// The greatest dot product of a block's vertices with a direction.
///
/// The lowest bits of each product are replaced by the index of its vertex, to find the greatest without branches. This
/// changes the product by less than 2^-50 of its value.
#[inline(always)]
fn greatest<S: Simd>(simd: S, block: &Block, d: [f64; 3]) -> f64 {
    let dots = f64x4::load_array_ref(simd, &block.x) * d[0]
        + f64x4::load_array_ref(simd, &block.y) * d[1]
        + f64x4::load_array_ref(simd, &block.z) * d[2];
    let rest = u64x4::splat(simd, !(WIDTH as u64 - 1));
    let numbers = u64x4::load_array(simd, [0, 1, 2, 3]);
    let marked: f64x4<S> = ((dots.bitcast::<u64x4<S>>() & rest) | numbers).bitcast();
    marked.reduce_max()
}

#[cfg(test)]
#[path = "tests/support_table.rs"]
mod tests;
