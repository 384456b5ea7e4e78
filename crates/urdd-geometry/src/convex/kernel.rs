//! Distances of one pair of shapes in all samples.

use fearless_simd::{Level, Simd, dispatch, prelude::*};
use nalgebra::Isometry3;

use super::gjk;
use super::lanes::{LANES, Pose, Vec3, columns, select, splat};
use super::motion::PoseLanes;
use super::shape::{ConvexShape, OrientedBox, Sphere};

/// A shape with distance queries: [`ConvexShape`], [`OrientedBox`] or [`Sphere`].
pub trait Shape: sealed::Distances + Sync {}

impl Shape for ConvexShape {}
impl Shape for OrientedBox {}
impl Shape for Sphere {}

/// The distance of two shapes, metres; 0 if they touch or overlap. `b_in_a` is the pose of the frame of `b` in that of
/// `a` and must be finite.
pub fn distance<T: Shape>(a: &T, b: &T, b_in_a: &Isometry3<f64>) -> f64 {
    let poses = PoseLanes::new(std::iter::once(b_in_a));
    let mut lanes = [0.0; LANES];
    T::distances(Level::new(), [a, b], &poses, gjk::EXACT, &mut lanes);
    lanes[0]
}

mod sealed {
    use super::{Level, PoseLanes};

    pub trait Distances: Sized {
        /// The distance in each sample, in order. In place of one in the range `within`, any number in it. The length
        /// of `distances` is a multiple of the lane count.
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
}

impl sealed::Distances for ConvexShape {
    fn distances(
        level: Level,
        pair: [&Self; 2],
        poses: &PoseLanes,
        within: [f64; 2],
        distances: &mut [f64],
    ) {
        dispatch!(level, simd => hulls(simd, pair, poses, within, distances));
    }
}

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
        out.copy_from_slice(&gjk::distances(simd, a, b, &pose, lanes, within));
    }
}

impl sealed::Distances for OrientedBox {
    fn distances(
        level: Level,
        pair: [&Self; 2],
        poses: &PoseLanes,
        within: [f64; 2],
        distances: &mut [f64],
    ) {
        dispatch!(level, simd => boxes(simd, pair, poses, within, distances));
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
        out.copy_from_slice(&gjk::distances(simd, a, b, &pose, lanes, within));
    }
}

impl sealed::Distances for Sphere {
    fn distances(
        level: Level,
        pair: [&Self; 2],
        poses: &PoseLanes,
        within: [f64; 2],
        distances: &mut [f64],
    ) {
        dispatch!(level, simd => spheres(simd, pair, poses, within, distances));
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

#[cfg(test)]
mod tests {
    use nalgebra::{Translation3, UnitQuaternion};

    use super::sealed::Distances;
    use super::*;
    use crate::levels::levels;

    #[test]
    fn the_same_bits_on_each_instruction_set() {
        let point = |i: u32| {
            let x = f64::from(i);
            [(1.7 * x).sin(), (2.3 * x).cos(), (0.9 * x).sin() * 0.3]
        };
        let hull = |from| ConvexShape::of_points(&(from..from + 60).map(point).collect::<Vec<_>>());
        let (a, b) = (hull(0).expect("a shape"), hull(100).expect("a shape"));
        let poses: Vec<Isometry3<f64>> = (0..999)
            .map(|k| {
                let p = point(1000 + k).map(|x| 4.0 * x);
                let q = UnitQuaternion::from_euler_angles(p[1], p[2], p[0]);
                Isometry3::from_parts(Translation3::from(p), q)
            })
            .collect();
        let lanes = PoseLanes::new(poses.iter());
        let boxes = [0.3, 0.7].map(|h| OrientedBox::new(poses[3], [h, 0.5, 0.1]).expect("a box"));
        let all = levels().into_iter().map(|level| {
            let mut found = vec![0.0; 3000];
            let (hulls, of_boxes) = found.split_at_mut(1000);
            ConvexShape::distances(level, [&a, &b], &lanes, gjk::EXACT, hulls);
            let of_boxes = &mut of_boxes[..1000];
            OrientedBox::distances(level, boxes.each_ref(), &lanes, gjk::EXACT, of_boxes);
            found
                .iter()
                .map(|x: &f64| x.to_bits())
                .collect::<Vec<u64>>()
        });
        let all: Vec<_> = all.collect();
        assert!(all.iter().all(|found| *found == all[0]));
        let touching = all[0][..999].iter().filter(|&&x| x == 0).count();
        assert!((50..950).contains(&touching), "{touching} of 999 touch");
    }

    /// A blunt dome with a keel, across a cone's tip on the dome's axis. The vertices that the descent meets, the axis and
    /// the origin lie in one plane, so that a simplex has no volume but for rounding.
    #[test]
    fn what_lies_on_one_axis_is_as_far_as_it_is() {
        const SIDES: u32 = 24;
        let at = |side: u32, x: f64, radius: f64| {
            let angle = std::f64::consts::TAU * f64::from(side) / f64::from(SIDES);
            [x, radius * angle.cos(), radius * angle.sin()]
        };
        let shape = |points: Vec<[f64; 3]>| ConvexShape::of_points(&points).expect("a shape");
        let base = (0..SIDES).map(|side| at(side, 0.1, 0.05));
        let tip = shape(base.chain([[0.0; 3]]).collect());
        for keel in 0..SIDES {
            let rings = (1..=12).map(|k| 0.005 * f64::from(k));
            let cap = rings.flat_map(|r| (0..SIDES).map(move |side| at(side, 25e-6 - r * r, r)));
            let dome = shape(cap.chain([at(keel, -0.1, 0.15)]).collect());
            for k in 0..5_000 {
                let x = f64::from(k);
                let placed = |at: f64, angle: f64| {
                    let turn = UnitQuaternion::from_euler_angles(angle, 0.0, 0.0);
                    Isometry3::from_parts(Translation3::new(at, 0.051, 0.0), turn)
                };
                let [p, q] = [(1.1 * x).sin(), (0.37 * x + 0.3).sin()];
                let pose = placed(-0.09, 1.2 * p).inv_mul(&placed(0.24, 1.2 * q));
                let found = distance(&dome, &tip, &pose);
                assert!((found - 0.33).abs() < 1e-9, "{keel}, {k}: {found}");
            }
        }
    }
}
