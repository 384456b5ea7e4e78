//! Mean, least and greatest distance of each pair of shapes over samples.

use fearless_simd::Level;
use rayon::prelude::*;

use super::kernel::Shape;
use super::lanes::LANES;
use super::motion::{Motion, PoseLanes};

/// A shape and the number of the body that it is on.
#[derive(Clone, Debug)]
pub struct PlacedShape<T> {
    pub body: usize,
    pub shape: T,
}

/// Distances of each pair of shapes over the samples, metres; 0 in contact.
///
/// Each is a square symmetric matrix over the shapes in their order, with zeros on the diagonal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairStatistics {
    pub mean: Vec<Vec<f64>>,
    pub min: Vec<Vec<f64>>,
    pub max: Vec<Vec<f64>>,
}

/// What is known of one pair.
#[derive(Clone, Copy)]
struct Summary {
    mean: f64,
    min: f64,
    max: f64,
}

/// The statistics of every pair of shapes. `None` if a shape is on a body that the motion does not have.
///
/// Pairs that do not move with respect to each other are worked out once. The result has the same bits
/// for each number of threads and each instruction set: a pair is the work of one thread, and its mean
/// is summed in the order of the samples.
pub fn pair_statistics<T: Shape>(
    shapes: &[PlacedShape<T>],
    motion: &Motion,
) -> Option<PairStatistics> {
    let mut on_body = vec![Vec::new(); motion.num_bodies()];
    for (i, shape) in shapes.iter().enumerate() {
        on_body.get_mut(shape.body)?.push(i);
    }
    let bodies: Vec<usize> = (0..on_body.len())
        .filter(|&b| !on_body[b].is_empty())
        .collect();
    let pairs: Vec<[usize; 2]> = bodies
        .iter()
        .enumerate()
        .flat_map(|(i, &a)| bodies[i..].iter().map(move |&b| [a, b]))
        .collect();

    let level = Level::new();
    let rows = pairs.into_par_iter().flat_map(|[a, b]| {
        let poses = motion.relative(a, b);
        let of_b = &on_body[b];
        on_body[a].par_iter().map(move |&i| {
            let others = of_b.iter().copied().filter(|&j| a != b || j > i);
            row(level, shapes, i, others, &poses)
        })
    });
    let rows: Vec<Vec<(usize, usize, Summary)>> = rows.collect();

    let zeros = vec![vec![0.0; shapes.len()]; shapes.len()];
    let mut statistics = PairStatistics {
        mean: zeros.clone(),
        min: zeros.clone(),
        max: zeros,
    };
    for (i, j, summary) in rows.into_iter().flatten() {
        for (i, j) in [(i, j), (j, i)] {
            statistics.mean[i][j] = summary.mean;
            statistics.min[i][j] = summary.min;
            statistics.max[i][j] = summary.max;
        }
    }
    Some(statistics)
}

/// The distance of two shapes in each sample, metres; 0 in contact. `None` if a shape is on a body that the
/// motion does not have.
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
    T::distances(Level::new(), &a.shape, &b.shape, &poses, &mut distances);
    distances.truncate(poses.num_samples());
    // Of bodies that do not move with respect to each other one sample stands for all.
    let first = distances.first().copied()?;
    distances.resize(motion.num_samples(), first);
    Some(distances)
}

/// The pairs of shape `i` with others, all on one body.
fn row<T: Shape>(
    level: Level,
    shapes: &[PlacedShape<T>],
    i: usize,
    others: impl Iterator<Item = usize>,
    poses: &PoseLanes,
) -> Vec<(usize, usize, Summary)> {
    let num_samples = poses.num_samples();
    let mut distances = vec![0.0; num_samples.next_multiple_of(LANES)];
    others
        .map(|j| {
            T::distances(
                level,
                &shapes[i].shape,
                &shapes[j].shape,
                poses,
                &mut distances,
            );
            (i, j, summary(&distances[..num_samples]))
        })
        .collect()
}

/// Of one distance or more.
fn summary(distances: &[f64]) -> Summary {
    let (mut sum, mut min, mut max) = (0.0, f64::INFINITY, 0.0);
    for &d in distances {
        sum += d;
        min = if d < min { d } else { min };
        max = if d > max { d } else { max };
    }
    // The sum's rounding may not push the mean of equal distances beyond them.
    let mean = (sum / distances.len() as f64).max(min).min(max);
    Summary { mean, min, max }
}
