//! Mean, minimum and maximum distance of each pair of shapes over samples.

use std::sync::atomic::{AtomicBool, Ordering};

use fearless_simd::Level;
use rayon::prelude::*;

use super::gjk::EXACT;
use super::samples::{Motion, PoseLanes, Shape};
use crate::lanes::LANES;

/// A shape and the index of its body.
#[derive(Clone, Debug)]
pub struct PlacedShape<T> {
    /// Index of the body.
    pub body: usize,
    /// The shape, in the frame of its body.
    pub shape: T,
}

/// Distances of each pair of shapes over the samples, metres; 0 in contact.
///
/// Each is a symmetric matrix over the shapes, in their order, with zeros on the diagonal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairStatistics {
    /// Mean distances.
    pub mean: Vec<Vec<f64>>,
    /// Minimum distances.
    pub min: Vec<Vec<f64>>,
    /// Maximum distances.
    pub max: Vec<Vec<f64>>,
}

/// Mean, minimum and maximum of one pair.
type Summary = [f64; 3];

/// A kind, the index of a shape of that kind, and its pairs with others.
type Row = (usize, usize, Vec<(usize, Summary)>);

/// A list of [`PlacedShape`] of any one kind.
pub trait ShapeList: Sync {
    /// Number of shapes.
    fn count(&self) -> usize;

    /// Body index of a shape.
    fn body(&self, shape: usize) -> usize;

    /// The distance of two shapes in each sample, in order. In place of one in the range `within`, any number in it. The
    /// length of `distances` is a multiple of the lane count.
    fn distances(
        &self,
        level: Level,
        pair: [usize; 2],
        poses: &PoseLanes,
        within: [f64; 2],
        distances: &mut [f64],
    );
}

impl<T: Shape> ShapeList for &[PlacedShape<T>] {
    fn count(&self) -> usize {
        self.len()
    }

    fn body(&self, shape: usize) -> usize {
        self[shape].body
    }

    fn distances(
        &self,
        level: Level,
        pair: [usize; 2],
        poses: &PoseLanes,
        within: [f64; 2],
        distances: &mut [f64],
    ) {
        let pair = pair.map(|shape| &self[shape].shape);
        T::distances(level, pair, poses, within, distances);
    }
}

/// The range of distances of a pair, given as `i < j`, in place of which any number in it will do; `None` asks for exact
/// distances.
type Range<'a> = &'a (dyn Fn(usize, usize) -> Option<[f64; 2]> + Sync);

/// Number of body pairs whose results are buffered before they go into the matrices.
const PAIRS_AT_ONCE: usize = 1 << 13;

/// The statistics of every pair of shapes. `None` if a shape's body is not in the motion.
///
/// Pairs in fixed relative position are evaluated once. The result is bit-identical for any number of threads and each
/// instruction set: one thread handles a pair and sums its mean in sample order.
pub fn pair_statistics<T: Shape>(
    shapes: &[PlacedShape<T>],
    motion: &Motion,
) -> Option<PairStatistics> {
    statistics_of_kinds(&[&shapes], motion, &|| false)?.pop()
}

/// Answers whether the distances of every pair of shapes stay in a range, with less work than [`pair_statistics`]: the
/// minimum and maximum are in the `range` of a pair, given as `i < j`, exactly if all its distances are. Otherwise those
/// outside are exact; the mean is not. `None` for a range asks for exact distances.
pub fn pair_ranges<T: Shape>(
    shapes: &[PlacedShape<T>],
    motion: &Motion,
    range: impl Fn(usize, usize) -> Option<[f64; 2]> + Sync,
) -> Option<PairStatistics> {
    statistics_within(&[&shapes], motion, &range, &|| false)?.pop()
}

/// The statistics of several kinds of shapes, each as from [`pair_statistics`]. The relative poses of two bodies are
/// computed once for all kinds. Checks `should_stop` before each pair of shapes, and also returns `None` if it is true.
pub fn statistics_of_kinds(
    kinds: &[&dyn ShapeList],
    motion: &Motion,
    should_stop: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<PairStatistics>> {
    statistics_within(kinds, motion, &|_, _| None, should_stop)
}

fn statistics_within(
    kinds: &[&dyn ShapeList],
    motion: &Motion,
    range: Range<'_>,
    should_stop: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<PairStatistics>> {
    // For each body, its shapes: the kind, and the index within it.
    let mut on_body: Vec<Vec<(usize, usize)>> = vec![Vec::new(); motion.num_bodies()];
    for (kind, shapes) in kinds.iter().enumerate() {
        for shape in 0..shapes.count() {
            on_body.get_mut(shapes.body(shape))?.push((kind, shape));
        }
    }
    let bodies: Vec<usize> = (0..on_body.len()).filter(|&b| !on_body[b].is_empty()).collect();
    let mut pairs =
        bodies.iter().enumerate().flat_map(|(i, &a)| bodies[i..].iter().map(move |&b| [a, b]));

    let level = Level::new();
    let is_stopped = AtomicBool::new(false);
    let goes_on = || {
        let stops = should_stop();
        if stops {
            is_stopped.store(true, Ordering::Relaxed);
        }
        !stops
    };
    let mut statistics: Vec<PairStatistics> =
        kinds.iter().map(|shapes| PairStatistics::zeros(shapes.count())).collect();
    loop {
        let some: Vec<[usize; 2]> = pairs.by_ref().take(PAIRS_AT_ONCE).collect();
        if some.is_empty() {
            return Some(statistics);
        }
        let goes_on = &goes_on;
        // After cancellation, skip the relative poses too: they take long.
        let wanted = |_: &[usize; 2]| !is_stopped.load(Ordering::Relaxed);
        let rows = some.into_par_iter().filter(wanted).flat_map(|[a, b]| {
            let poses = motion.relative(a, b);
            let of_b = &on_body[b];
            on_body[a].par_iter().map(move |&(kind, i)| {
                let same_kind = of_b.iter().filter(|&&(of, j)| of == kind && (a != b || j > i));
                let others = same_kind.map(|(_, j)| *j).take_while(|_| goes_on());
                (kind, i, row(level, kinds[kind], i, others, &poses, range))
            })
        });
        let rows: Vec<Row> = rows.collect();
        if is_stopped.load(Ordering::Relaxed) {
            return None;
        }
        for (kind, i, pairs) in rows {
            for (j, summary) in pairs {
                statistics[kind].put(i, j, summary);
            }
        }
    }
}

impl PairStatistics {
    fn zeros(shapes: usize) -> Self {
        let zeros = || vec![vec![0.0; shapes]; shapes];
        PairStatistics { mean: zeros(), min: zeros(), max: zeros() }
    }

    fn put(&mut self, i: usize, j: usize, summary: Summary) {
        for (matrix, value) in
            [&mut self.mean, &mut self.min, &mut self.max].into_iter().zip(summary)
        {
            (matrix[i][j], matrix[j][i]) = (value, value);
        }
    }
}

/// The distance of two shapes in each sample, metres; 0 in contact. `None` if a shape's body is not in the motion.
pub fn pair_distances<T: Shape>(
    a: &PlacedShape<T>,
    b: &PlacedShape<T>,
    motion: &Motion,
) -> Option<Vec<f64>> {
    if a.body.max(b.body) >= motion.num_bodies() {
        return None;
    }
    let poses = motion.relative(a.body, b.body);
    let mut distances = vec![0.0; poses.num_samples().next_multiple_of(LANES)];
    let level = Level::new();
    T::distances(level, [&a.shape, &b.shape], &poses, EXACT, &mut distances);
    distances.truncate(poses.num_samples());
    // Bodies in fixed relative position have one sample that stands for all.
    let first = distances.first().copied()?;
    distances.resize(motion.num_samples(), first);
    Some(distances)
}

/// The statistics of shape `i` with others, all on one body.
fn row(
    level: Level,
    shapes: &dyn ShapeList,
    i: usize,
    others: impl Iterator<Item = usize>,
    poses: &PoseLanes,
    range: Range<'_>,
) -> Vec<(usize, Summary)> {
    let num_samples = poses.num_samples();
    let mut distances = vec![0.0; num_samples.next_multiple_of(LANES)];
    others
        .map(|j| {
            let within = range(i.min(j), i.max(j)).unwrap_or(EXACT);
            shapes.distances(level, [i, j], poses, within, &mut distances);
            (j, summary(&distances[..num_samples]))
        })
        .collect()
}

/// `distances` must not be empty.
fn summary(distances: &[f64]) -> Summary {
    let (mut sum, mut min, mut max) = (0.0, f64::INFINITY, 0.0);
    for &d in distances {
        sum += d;
        min = if d < min { d } else { min };
        max = if d > max { d } else { max };
    }
    // Rounding of the sum must not push the mean outside the range of the distances.
    let mean = (sum / distances.len() as f64).max(min).min(max);
    [mean, min, max]
}
