//! Distances between convex shapes (hulls, boxes and spheres), and their statistics over many poses.
//!
//! A robot's statistics take tens of millions of distance queries. So GJK processes the poses of eight samples at once
//! (`gjk`), and a table replaces the search for the farthest vertex in a direction (`support_table`). Of the pairs of bodies
//! ([`BodyPairs`]), bounding spheres cull the shapes that are far apart.
//!
//! **Accuracy.** Each distance is within [`TOLERANCE`] of the exact distance of the convex hulls of the given points.
//! Shapes that touch or overlap have distance 0. Results are bit-identical on each instruction set of an architecture
//! and for any number of threads.

pub mod across;
mod gjk;
mod penetration;
mod samples;
mod shape;
mod statistics;
mod support_table;

use nalgebra::{Isometry3, Point3};

use crate::bounding_sphere::{BoundingSphere, LARGER, about, about_spheres};
use across::{AT_ONCE, PlacedPair};

pub use across::Witness;
pub use fearless_simd::Level;
pub use gjk::TOLERANCE;
pub use penetration::{Penetration, penetration};
pub use samples::{Motion, MotionError, PoseLanes, Shape, distance};
pub use shape::{ConvexShape, OrientedBox, ShapeError, Sphere};
pub use statistics::{
    PairStatistics, PlacedShape, ShapeList, pair_distances, pair_ranges, pair_statistics,
    statistics_of_kinds,
};

#[derive(Debug)]
struct Part {
    shape: ConvexShape,
    sphere: BoundingSphere,
}

/// The shapes of bodies, and the pairs of interest.
#[derive(Debug)]
pub struct BodyPairs {
    parts: Vec<Part>,
    /// For each body, the indices of its shapes in `parts`.
    of_body: Vec<Vec<usize>>,
    /// Pairs of parts, grouped by body pair.
    pairs: Vec<[usize; 2]>,
    /// For each body pair, the bodies and the end of its range in `pairs`.
    bodies: Vec<([usize; 2], usize)>,
    /// For each body, the bounding sphere of all its shapes; `None` without shapes.
    spheres: Vec<Option<BoundingSphere>>,
    level: Level,
}

impl BodyPairs {
    /// Takes the shapes: for each the index of its body, and its vertices in the body frame, metres.
    ///
    /// # Errors
    /// The index of the first invalid shape, and the reason.
    pub fn new<'a>(
        shapes: impl IntoIterator<Item = (usize, &'a [[f64; 3]])>,
    ) -> Result<Self, (usize, ShapeError)> {
        let mut parts = Vec::new();
        let mut of_body: Vec<Vec<usize>> = Vec::new();
        for (number, (body, vertices)) in shapes.into_iter().enumerate() {
            let shape = ConvexShape::of_points(vertices).map_err(|error| (number, error))?;
            let sphere = about(shape.centre(), vertices);
            parts.push(Part { shape, sphere });
            of_body.resize(of_body.len().max(body + 1), Vec::new());
            of_body[body].push(number);
        }
        let sphere =
            |of: &Vec<usize>| about_spheres(of.iter().map(|number| &parts[*number].sphere));
        let spheres = of_body.iter().map(sphere).collect();
        let (pairs, bodies) = (Vec::new(), Vec::new());
        Ok(Self { parts, of_body, pairs, bodies, spheres, level: Level::new() })
    }

    /// Adds a pair of bodies, with all pairs of their shapes for which `of_interest` returns true; it takes two shape
    /// indices. Returns whether there is such a pair; otherwise adds nothing.
    pub fn add(&mut self, bodies: [usize; 2], of_interest: impl Fn(usize, usize) -> bool) -> bool {
        let before = self.pairs.len();
        let of = |body: usize| self.of_body.get(body).map_or(&[][..], Vec::as_slice);
        for a in of(bodies[0]) {
            let with = of(bodies[1]).iter().filter(|b| of_interest(*a, **b));
            self.pairs.extend(with.map(|b| [*a, *b]));
        }
        let any = self.pairs.len() > before;
        if any {
            self.bodies.push((bodies, self.pairs.len()));
        }
        any
    }

    /// The body pairs in the order of addition.
    pub fn bodies(&self) -> impl ExactSizeIterator<Item = [usize; 2]> {
        self.bodies.iter().map(|(bodies, _)| *bodies)
    }

    /// Number of pairs of shapes.
    pub fn num_shape_pairs(&self) -> usize {
        self.pairs.len()
    }

    /// The distance of each body pair, metres, 0 in contact, and at most `limit`. `poses` has a finite pose for each
    /// body. `distances` is as long as [`BodyPairs::bodies`].
    pub fn distances(&self, poses: &[Isometry3<f64>], limit: f64, distances: &mut [f64]) {
        distances.fill(limit);
        let mut near = Near::default();
        for (number, pair) in self.near(poses, limit) {
            near.add(number, pair);
            if near.is_full() {
                near.take_distances(self.level, distances);
            }
        }
        near.take_distances(self.level, distances);
    }

    /// Whether any body pair is in contact.
    pub fn any_touches(&self, poses: &[Isometry3<f64>]) -> bool {
        self.any_touches_and_work(poses).0
    }

    /// Whether any body pair is in contact, and how many shape pairs the bounding spheres could not exclude.
    pub fn any_touches_and_work(&self, poses: &[Isometry3<f64>]) -> (bool, usize) {
        let mut near = Near::default();
        let mut compared = 0;
        for (number, pair) in self.near(poses, 0.0) {
            near.add(number, pair);
            compared += 1;
            if near.is_full() && near.touch(self.level) {
                return (true, compared);
            }
        }
        (near.touch(self.level), compared)
    }

    /// The indices of the body pairs in contact, ascending.
    pub fn touching(&self, poses: &[Isometry3<f64>]) -> Vec<usize> {
        let mut near = Near::default();
        let mut found: Vec<usize> = Vec::new();
        for (number, pair) in self.near(poses, 0.0) {
            if found.last() == Some(&number) {
                continue;
            }
            near.add(number, pair);
            if near.is_full() {
                near.take_touching(self.level, &mut found);
            }
        }
        near.take_touching(self.level, &mut found);
        found
    }

    /// The shape pairs whose bounding spheres are at most `limit` apart, each with the index of its body pair.
    fn near<'a>(
        &'a self,
        poses: &'a [Isometry3<f64>],
        limit: f64,
    ) -> impl Iterator<Item = (usize, PlacedPair<'a>)> {
        let mut start = 0;
        let groups = self.bodies.iter().enumerate();
        groups.flat_map(move |(number, (bodies, end))| {
            let pairs = &self.pairs[start..*end];
            start = *end;
            let b_in_a = poses[bodies[0]].inv_mul(&poses[bodies[1]]);
            let columns = across::columns(&b_in_a);
            let spheres = bodies.map(|body| self.spheres.get(body).copied().flatten());
            let near = move |a: &BoundingSphere, b: &BoundingSphere| {
                let centre = b_in_a * Point3::from(b.centre);
                let apart = (centre - Point3::from(a.centre)).norm();
                apart <= (limit + a.radius + b.radius) * LARGER
            };
            let may_be_near = matches!(spheres, [Some(a), Some(b)] if near(&a, &b));
            let pairs = if may_be_near { pairs } else { &[] };
            pairs.iter().filter_map(move |[a, b]| {
                let (a, b) = (&self.parts[*a], &self.parts[*b]);
                let pair = PlacedPair { a: &a.shape, b: &b.shape, b_in_a: columns };
                near(&a.sphere, &b.sphere).then_some((number, pair))
            })
        })
    }
}

/// Pairs waiting for a full batch.
#[derive(Default)]
struct Near<'a> {
    numbers: Vec<usize>,
    pairs: Vec<PlacedPair<'a>>,
}

impl<'a> Near<'a> {
    fn add(&mut self, number: usize, pair: PlacedPair<'a>) {
        self.numbers.push(number);
        self.pairs.push(pair);
    }

    fn is_full(&self) -> bool {
        self.pairs.len() == AT_ONCE
    }

    /// Computes the distances of the waiting pairs, and updates those of the body pairs.
    fn take_distances(&mut self, level: Level, distances: &mut [f64]) {
        let mut found = [0.0; AT_ONCE];
        across::distances(level, &self.pairs, &mut found[..self.pairs.len()]);
        for (number, found) in self.numbers.drain(..).zip(found) {
            distances[number] = distances[number].min(found);
        }
        self.pairs.clear();
    }

    fn take_touching(&mut self, level: Level, found: &mut Vec<usize>) {
        let touching = across::touching(level, &self.pairs);
        let in_contact = |(k, number): (usize, usize)| (touching >> k & 1 == 1).then_some(number);
        found.extend(self.numbers.drain(..).enumerate().filter_map(in_contact));
        found.dedup();
        self.pairs.clear();
    }

    fn touch(&mut self, level: Level) -> bool {
        let touch = across::any_touches(level, &self.pairs);
        self.numbers.clear();
        self.pairs.clear();
        touch
    }
}
