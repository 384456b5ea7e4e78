//! Mesh cleaning: rounding, welding, and removal of degenerate or unused elements.
//!
//! All operations are deterministic and keep the order of the remaining elements.

use crate::mesh::{Mesh, double_area_normal};

impl Mesh {
    /// Rounds every coordinate to the nearest binary32, and -0 to 0. Returns how many triangles were dropped because a
    /// corner has no finite binary32 value.
    pub fn round_to_f32(&mut self) -> usize {
        for coordinate in self.vertices.iter_mut().flatten() {
            #[allow(clippy::cast_possible_truncation)]
            let rounded = *coordinate as f32;
            // Adding 0 turns -0 into 0 and leaves other values unchanged.
            *coordinate = f64::from(rounded) + 0.0;
        }
        self.drop_non_finite()
    }

    /// Drops triangles with a non-finite corner; returns how many. If a coordinate is not finite, also drops all unused
    /// vertices.
    pub fn drop_non_finite(&mut self) -> usize {
        if self.vertices.iter().flatten().all(|coordinate| coordinate.is_finite()) {
            return 0;
        }
        let before = self.triangles.len();
        let vertices = &self.vertices;
        self.triangles.retain(|triangle| {
            triangle.iter().all(|index| {
                vertices[*index as usize].iter().all(|coordinate| coordinate.is_finite())
            })
        });
        self.drop_unused_vertices();
        before - self.triangles.len()
    }

    /// Merges vertices at the same position into the first of them. 0 and -0 are equal; no tolerance applies.
    ///
    /// Returns how many vertices were removed. Triangles stay, even if they become degenerate.
    pub fn weld(&mut self) -> usize {
        let before = self.vertices.len();
        let mut table = PlaceTable::for_count(before);
        let mut kept: Vec<[f64; 3]> = Vec::with_capacity(before);
        let mut index_of: Vec<u32> = Vec::with_capacity(before);
        for vertex in &self.vertices {
            index_of.push(table.index(vertex.map(|coordinate| coordinate + 0.0), &mut kept));
        }
        self.vertices = kept;
        for triangle in &mut self.triangles {
            *triangle = triangle.map(|index| index_of[index as usize]);
        }
        before - self.vertices.len()
    }

    /// Drops triangles without area, which have coincident or collinear corners; returns how many.
    ///
    /// The area is computed from the stored coordinates in binary64 and compared with exactly 0, so a thin triangle
    /// stays. After [`round_to_f32`](Self::round_to_f32) two corners are either equal or distinct.
    pub fn drop_degenerate(&mut self) -> usize {
        let before = self.triangles.len();
        let vertices = &self.vertices;
        self.triangles.retain(|triangle| {
            let [a, b, c] = triangle.map(|index| vertices[index as usize]);
            a != b && b != c && c != a && double_area_normal([a, b, c]).norm_squared() > 0.0
        });
        before - self.triangles.len()
    }

    /// Drops vertices that no triangle uses; returns how many. The order of the others is kept.
    pub fn drop_unused_vertices(&mut self) -> usize {
        let mut used = vec![false; self.vertices.len()];
        for index in self.triangles.iter().flatten() {
            used[*index as usize] = true;
        }
        let mut index_of = vec![0_u32; self.vertices.len()];
        let mut next = 0_u32;
        for (new, used) in index_of.iter_mut().zip(&used) {
            *new = next;
            next += u32::from(*used);
        }
        let before = self.vertices.len();
        let mut flags = used.iter();
        self.vertices.retain(|_| *flags.next().unwrap_or(&false));
        for triangle in &mut self.triangles {
            *triangle = triangle.map(|index| index_of[index as usize]);
        }
        before - self.vertices.len()
    }
}

/// Maps positions to their first index. Uses open addressing: the standard map with its secure hash takes three times
/// as long.
pub(crate) struct PlaceTable {
    slots: Vec<u32>,
}

const FREE: u32 = u32::MAX;

impl PlaceTable {
    pub(crate) fn for_count(count: usize) -> Self {
        Self { slots: vec![FREE; (count * 2).next_power_of_two().max(2)] }
    }

    /// The index of the position in `kept`; appends the position if it is new.
    pub(crate) fn index(&mut self, place: [f64; 3], kept: &mut Vec<[f64; 3]>) -> u32 {
        let mask = self.slots.len() - 1;
        let mut slot = hash(place) & mask;
        loop {
            match self.slots[slot] {
                FREE => {
                    // A mesh has at most `u32::MAX` vertices.
                    let index = u32::try_from(kept.len()).unwrap_or(u32::MAX);
                    self.slots[slot] = index;
                    kept.push(place);
                    return index;
                }
                index if kept[index as usize].map(f64::to_bits) == place.map(f64::to_bits) => {
                    return index;
                }
                _ => slot = (slot + 1) & mask,
            }
        }
    }
}

/// Mixes the bits of three coordinates (the finalizer of MurmurHash3 after each).
#[allow(clippy::cast_possible_truncation)]
fn hash(place: [f64; 3]) -> usize {
    let mut mixed = 0_u64;
    for coordinate in place {
        mixed = (mixed ^ coordinate.to_bits()).wrapping_mul(0xff51_afd7_ed55_8ccd);
        mixed ^= mixed >> 33;
        mixed = mixed.wrapping_mul(0xc4ce_b9fe_1a85_ec53);
        mixed ^= mixed >> 33;
    }
    mixed as usize
}
