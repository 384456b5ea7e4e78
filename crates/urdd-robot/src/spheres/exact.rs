//! Spheres against convex parts, by their exact distances, and against the copies of an obstacle, by its tree.

use arrayvec::ArrayVec;
use fearless_simd::{Simd, prelude::*};
use nalgebra::{Isometry3, Point3};

use crate::copies::{Child, Copies, WAITING};
use crate::lanes::{LANES, Row, Vec3, bits, splat};
use crate::obstacle::Part;
use urdd_geometry::convex::across::{self, PlacedPair};
use urdd_geometry::convex::{ConvexShape, Level};

/// The lanes of `near` in which a sphere touches a convex part, exactly.
#[inline(never)]
pub fn convex(
    level: Level,
    part: &Part,
    point: &ConvexShape,
    pose: &Isometry3<f64>,
    centre: &[Row; 3],
    reach: f64,
    near: u8,
) -> u8 {
    let mut lanes: ArrayVec<usize, LANES> = ArrayVec::new();
    let mut pairs: ArrayVec<PlacedPair, LANES> = ArrayVec::new();
    for lane in (0..LANES).filter(|lane| near >> lane & 1 != 0) {
        let at = [0, 1, 2].map(|k| f64::from(centre[k].0[lane]));
        let local = pose.inverse_transform_point(&Point3::from(at));
        let [x, y, z] = [local.x, local.y, local.z];
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let b_in_a = [axes[0], axes[1], axes[2], [x, y, z]];
        lanes.push(lane);
        pairs.push(PlacedPair { a: &part.core, b: point, b_in_a });
    }
    let mut apart = [0.0; LANES];
    across::distances(level, &pairs, &mut apart[..pairs.len()]);
    let touches = lanes.iter().zip(apart).filter(|(_, apart)| *apart <= reach + part.radius);
    touches.fold(0, |found, (lane, _)| found | 1 << lane)
}

/// Whether any copy is at most `reach` from a point of the frame of the tree.
#[inline(always)]
pub fn any_copy<S: Simd>(simd: S, copies: &Copies, point: [f32; 3], reach: f32) -> bool {
    let at = Vec3::splat(simd, point);
    let (zero, squared) = (splat(simd, 0.0), splat(simd, reach * reach));
    let half = [copies.half[0] as f32, copies.half[1] as f32, copies.half[2] as f32];
    let mut waiting: ArrayVec<Child, WAITING> = ArrayVec::new();
    waiting.push(Child::Node(0));
    while let Some(child) = waiting.pop() {
        match child {
            Child::None => {}
            Child::Leaf(leaf) => {
                let centre = Vec3::load(simd, &copies.leaves[leaf as usize]);
                let x = ((centre.x - at.x).abs() - half[0]).max(zero);
                let y = ((centre.y - at.y).abs() - half[1]).max(zero);
                let z = ((centre.z - at.z).abs() - half[2]).max(zero);
                if (x * x + y * y + z * z).simd_le(squared).any_true() {
                    return true;
                }
            }
            Child::Node(node) => {
                let node = &copies.nodes[node as usize];
                let (least, most) = (Vec3::load(simd, &node.least), Vec3::load(simd, &node.most));
                let x = (least.x - at.x).max(at.x - most.x).max(zero);
                let y = (least.y - at.y).max(at.y - most.y).max(zero);
                let z = (least.z - at.z).max(at.z - most.z).max(zero);
                let mut near = bits((x * x + y * y + z * z).simd_le(squared));
                while near != 0 {
                    let lane = near.trailing_zeros() as usize;
                    near &= near - 1;
                    let _ = waiting.try_push(node.children[lane]);
                }
            }
        }
    }
    false
}
