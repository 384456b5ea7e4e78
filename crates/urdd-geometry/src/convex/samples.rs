//! Poses of bodies in many samples, in a layout for eight at once, and the distances of one pair of shapes in all of them.

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch};
use nalgebra::Isometry3;

use crate::convex::gjk::{self, Pair};
use crate::convex::shape::{ConvexShape, OrientedBox, Sphere};
use crate::lanes::{LANES, Pose, Vec3, columns, select, splat};

/// The poses of a robot's bodies in each sample.
#[derive(Clone, Debug)]
pub struct Motion {
    num_samples: usize,
    bodies: Vec<PoseLanes>,
    groups: Vec<usize>,
}

/// Why poses are not a valid motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MotionError {
    /// There are no samples.
    #[error("there are no samples; give at least one")]
    NoSamples,
    /// A sample has another number of poses than there are bodies.
    #[error("sample {sample} has {found} poses; give one for each of the {expected} bodies")]
    Bodies {
        /// Index of the sample.
        sample: usize,
        /// Number of bodies.
        expected: usize,
        /// Number of poses.
        found: usize,
    },
    /// A pose has a value that is not finite.
    #[error("the pose of body {body} in sample {sample} is not finite")]
    NotFinite {
        /// Index of the sample.
        sample: usize,
        /// Index of the body.
        body: usize,
    },
}

impl Motion {
    /// Builds a motion from the pose of each body in each sample, `poses[sample][body]`, and the group of each body.
    /// Bodies of one group do not move relative to each other.
    pub fn new(poses: &[Vec<Isometry3<f64>>], groups: &[usize]) -> Result<Self, MotionError> {
        if poses.is_empty() {
            return Err(MotionError::NoSamples);
        }
        for (sample, row) in poses.iter().enumerate() {
            if row.len() != groups.len() {
                return Err(MotionError::Bodies {
                    sample,
                    expected: groups.len(),
                    found: row.len(),
                });
            }
            let finite = |p: &Isometry3<f64>| {
                let rotation = p.rotation.coords.iter();
                rotation.chain(&p.translation.vector).all(|x| x.is_finite())
            };
            if let Some(body) = row.iter().position(|p| !finite(p)) {
                return Err(MotionError::NotFinite { sample, body });
            }
        }
        let body = |b: usize| PoseLanes::new(poses.iter().map(|row| &row[b]));
        Ok(Self {
            num_samples: poses.len(),
            bodies: (0..groups.len()).map(body).collect(),
            groups: groups.to_vec(),
        })
    }

    /// Number of samples.
    pub fn num_samples(&self) -> usize {
        self.num_samples
    }

    /// Number of bodies.
    pub fn num_bodies(&self) -> usize {
        self.bodies.len()
    }

    /// Whether two bodies are fixed relative to each other.
    pub fn is_rigid(&self, a: usize, b: usize) -> bool {
        self.groups[a] == self.groups[b]
    }

    /// The poses of body `b` in the frame of body `a`: of all samples, or only of the first if all are equal.
    pub(crate) fn relative(&self, a: usize, b: usize) -> PoseLanes {
        if a == b {
            PoseLanes::new(std::iter::once(&Isometry3::identity()))
        } else {
            let num_samples = if self.is_rigid(a, b) { 1 } else { self.num_samples };
            PoseLanes::relative(&self.bodies[a], &self.bodies[b], num_samples)
        }
    }
}

/// One pose per sample, as 12 arrays: the columns of the rotation, then the translation.
#[derive(Clone, Debug)]
pub struct PoseLanes {
    num_samples: usize,
    /// Each of length `num_samples`, padded to a multiple of the lane count with the last sample.
    numbers: [Vec<f64>; 12],
}

impl PoseLanes {
    /// From at least one pose.
    pub fn new<'a>(poses: impl Iterator<Item = &'a Isometry3<f64>>) -> Self {
        let mut numbers: [Vec<f64>; 12] = Default::default();
        let mut num_samples: usize = 0;
        for pose in poses {
            num_samples += 1;
            let rotation = pose.rotation.to_rotation_matrix();
            let all = rotation.matrix().iter().chain(&pose.translation.vector);
            for (list, &x) in numbers.iter_mut().zip(all) {
                list.push(x);
            }
        }
        for list in &mut numbers {
            let last = list.last().copied().unwrap_or_default();
            list.resize(num_samples.next_multiple_of(LANES), last);
        }
        Self { num_samples, numbers }
    }

    /// The inverse of `a` times `b`, for the first `num_samples` samples.
    fn relative(a: &Self, b: &Self, num_samples: usize) -> Self {
        let len = num_samples.next_multiple_of(LANES);
        let mut relative = Self { num_samples, numbers: std::array::from_fn(|_| vec![0.0; len]) };
        dispatch!(Level::new(), simd => relative.fill(simd, a, b));
        relative
    }

    #[inline(always)]
    fn fill<S: Simd>(&mut self, simd: S, a: &Self, b: &Self) {
        for at in (0..self.numbers[0].len()).step_by(LANES) {
            let (a, b) = (a.load(simd, at), b.load(simd, at));
            let vectors = [
                a.rotate_back(b.columns[0]),
                a.rotate_back(b.columns[1]),
                a.rotate_back(b.columns[2]),
                a.rotate_back(b.shift - a.shift),
            ];
            for (to, v) in self.numbers.chunks_exact_mut(3).zip(vectors) {
                to[0][at..at + LANES].copy_from_slice(v.x.as_slice());
                to[1][at..at + LANES].copy_from_slice(v.y.as_slice());
                to[2][at..at + LANES].copy_from_slice(v.z.as_slice());
            }
        }
    }

    /// Number of poses.
    pub fn num_samples(&self) -> usize {
        self.num_samples
    }

    /// The poses of the samples from `at`, which is a multiple of the lane count.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, simd: S, at: usize) -> Pose<S> {
        Pose {
            columns: [
                self.load_vector(simd, 0, at),
                self.load_vector(simd, 3, at),
                self.load_vector(simd, 6, at),
            ],
            shift: self.load_vector(simd, 9, at),
        }
    }

    #[inline(always)]
    fn load_vector<S: Simd>(&self, simd: S, k: usize, at: usize) -> Vec3<S> {
        let from = |k: usize| &self.numbers[k][at..at + LANES];
        Vec3::load(simd, [from(k), from(k + 1), from(k + 2)])
    }
}

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
