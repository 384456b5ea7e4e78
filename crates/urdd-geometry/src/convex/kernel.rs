//! Distances of one pair of shapes in all samples.

use fearless_simd::{Level, Simd, dispatch, prelude::*};
use nalgebra::Isometry3;

use super::gjk::{self, Pair};
use super::motion::PoseLanes;
use super::shape::{ConvexShape, OrientedBox, Sphere};
use crate::lanes::{LANES, Pose, Vec3, columns, select, splat};

/// A shape with distance queries: [`ConvexShape`], [`OrientedBox`] or [`Sphere`].
pub trait Shape: Sized + Sync {
    /// The distance in each sample, in order. In place of one in the range `within`, any number in it. The length of
    /// `distances` is a multiple of the lane count.
    ///
    /// A function of each shape, and none of the trait: a kernel is compiled here, and not in each crate that asks.
    fn distances(
        level: Level,
        pair: [&Self; 2],
        poses: &PoseLanes,
        within: [f64; 2],
        distances: &mut [f64],
    );
}

/// The distance of two shapes, metres; 0 if they touch or overlap. `b_in_a` is the pose of the frame of `b` in that of
/// `a` and must be finite.
pub fn distance<T: Shape>(a: &T, b: &T, b_in_a: &Isometry3<f64>) -> f64 {
    let poses = PoseLanes::new(std::iter::once(b_in_a));
    let mut lanes = [0.0; LANES];
    T::distances(Level::new(), [a, b], &poses, gjk::EXACT, &mut lanes);
    lanes[0]
}

macro_rules! shapes {
    ($($kernel:ident: $shape:ty),*) => {$(
        impl Shape for $shape {
            fn distances(
                level: Level,
                pair: [&Self; 2],
                poses: &PoseLanes,
                within: [f64; 2],
                distances: &mut [f64],
            ) {
                dispatch!(level, simd => $kernel(simd, pair, poses, within, distances));
            }
        }
    )*};
}

shapes! { hulls: ConvexShape, boxes: OrientedBox, spheres: Sphere }

#[inline(always)]
fn hulls<S: Simd>(
    simd: S,
    [a, b]: [&ConvexShape; 2],
    poses: &PoseLanes,
    within: [f64; 2],
    distances: &mut [f64],
) {
    let (centre_a, centre_b) = (Vec3::splat(simd, a.centre), Vec3::splat(simd, b.centre));
    for (at, out) in groups(distances) {
        let mut pose = poses.load(simd, at);
        pose.shift = pose.shift + pose.rotate(centre_b) - centre_a;
        let lanes = gjk::first_lanes(poses.num_samples() - at);
        out.copy_from_slice(&Pair { simd, a, b, pose }.distances(lanes, within));
    }
}

#[inline(always)]
fn boxes<S: Simd>(
    simd: S,
    [a, b]: [&OrientedBox; 2],
    poses: &PoseLanes,
    within: [f64; 2],
    distances: &mut [f64],
) {
    let frame = |shape: &OrientedBox| Pose::same(simd, &columns(&shape.pose));
    let (frame_a, frame_b) = (frame(a), frame(b));
    for (at, out) in groups(distances) {
        let pose = poses.load(simd, at);
        let shift = pose.shift + pose.rotate(frame_b.shift) - frame_a.shift;
        let pose = Pose {
            columns: [
                frame_a.rotate_back(pose.rotate(frame_b.columns[0])),
                frame_a.rotate_back(pose.rotate(frame_b.columns[1])),
                frame_a.rotate_back(pose.rotate(frame_b.columns[2])),
            ],
            shift: frame_a.rotate_back(shift),
        };
        let lanes = gjk::first_lanes(poses.num_samples() - at);
        out.copy_from_slice(&Pair { simd, a, b, pose }.distances(lanes, within));
    }
}

#[inline(always)]
fn spheres<S: Simd>(
    simd: S,
    [a, b]: [&Sphere; 2],
    poses: &PoseLanes,
    _within: [f64; 2],
    distances: &mut [f64],
) {
    let (centre_a, centre_b) = (Vec3::splat(simd, a.centre), Vec3::splat(simd, b.centre));
    let radii = splat(simd, a.radius + b.radius);
    let zero = splat(simd, 0.0);
    for (at, out) in groups(distances) {
        let pose = poses.load(simd, at);
        let between = pose.shift + pose.rotate(centre_b) - centre_a;
        let gap = between.dot(between).sqrt() - radii;
        out.copy_from_slice(&select(gap.simd_gt(zero), gap, zero).to_array());
    }
}

/// For each group of lanes, the index of its first sample and the output slice for its distances.
#[inline(always)]
fn groups(distances: &mut [f64]) -> impl Iterator<Item = (usize, &mut [f64])> {
    let groups = distances.chunks_exact_mut(LANES).enumerate();
    groups.map(|(i, out)| (i * LANES, out))
}
