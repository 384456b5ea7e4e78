//! The content of binary STL besides corners: a normal for each triangle, and two unused bytes.

use nalgebra::Vector3;

use crate::tolerance::{STL_NORMAL, mesh_resolution};
use urdd_geometry::surface::is_thin;

pub const HEADER: usize = 84;
pub const RECORD: usize = 50;

/// The fault of the normals or the unused bytes of a binary STL, for its first faulty triangle. The corners are assumed
/// sound.
pub fn fault(stl: &[u8]) -> Option<String> {
    stl.get(HEADER..)?.chunks_exact(RECORD).enumerate().find_map(|(at, record)| {
        let mut numbers = [0.0; 12];
        for (number, bytes) in numbers.iter_mut().zip(record.as_chunks().0) {
            *number = f64::from(f32::from_le_bytes(*bytes));
        }
        let &[normal, a, b, c] = numbers.as_chunks().0 else { return None };
        let (normal, corners) = (Vector3::from(normal), [a, b, c]);
        let extent = numbers[3..].iter().map(|x| x.abs()).fold(0.0, f64::max);
        if record[48..] != [0, 0] {
            return Some(format!(
                "triangle {at} has {:?} in the two unused bytes; write zeros",
                &record[48..]
            ));
        }
        // A zero normal means that it is to be computed, which is impossible for a thin triangle.
        if normal == Vector3::zeros() || is_thin(corners, mesh_resolution(extent) / STL_NORMAL) {
            return None;
        }
        let (a, b, c) = (Vector3::from(a), Vector3::from(b), Vector3::from(c));
        let right = (b - a).cross(&(c - a)).normalize();
        let off = (right - normal).norm();
        (off.is_nan() || off > STL_NORMAL).then(|| {
            format!(
                "the normal of triangle {at} is not the one of its corners; write that, or zeros"
            )
        })
    })
}
