//! The loss of spheres, and its gradient.
//!
//! Two terms. *Surface*: the union of a link's spheres should have the same surface as the link. Each point of the
//! link's surface costs its squared distance to the surface of the spheres, outside or inside. *Contacts*: the spheres
//! should give the same collision results as the exact shapes. In a free configuration, each pair of spheres costs as
//! much as its distance falls short of a margin. In a colliding one, the pair of spheres nearest to contact, among the
//! pairs of links in contact, costs as much as its penetration falls short of a margin.

use rayon::prelude::*;

use super::frame::{Point, add, norm, scaled, sub};
use super::model::{Placeable, Placed, Sphere, Spheres, distance};
use super::samples::Sample;

/// Configurations per block. Blocks are summed in order, so results do not depend on the number of threads.
const BLOCK: usize = 256;

/// The target of the fit.
pub struct Goal<'a> {
    /// Points on the surface of each link.
    pub surface: &'a [Vec<Point>],
    /// The sampled configurations; the first has the weight of `FIRST` others.
    pub samples: &'a [Sample],
    /// The pairs of links that are checked.
    pub pairs: &'a [[usize; 2]],
    /// A typical radius, metres: the unit of lengths.
    pub size: f64,
}

/// Weight of the default configuration.
const FIRST: f64 = 50.0;

/// Total weights of all collisions and of all free configurations, relative to a surface error of one unit of length:
/// the inverse of the error rates allowed for each.
const COLLIDING: f64 = 100.0;
const FREE: f64 = 20.0;

/// Margin of penetration and of separation, in units of length.
const MARGIN: f64 = 0.01;

/// A configuration that may contribute to the loss, and its pairs of links that may.
#[derive(Clone)]
pub struct Looked {
    pub sample: usize,
    pub pairs: Vec<u32>,
}

/// A configuration that contributes to the loss, and its pairs of spheres that may: link and index of each.
pub struct Active {
    sample: usize,
    near: Vec<[(usize, usize); 2]>,
    weight: f64,
}

/// The gradient of the loss, 4 numbers per sphere (centre, radius), and each sphere's share of the loss.
pub struct Slope {
    pub by: Vec<[f64; 4]>,
    pub blame: Vec<f64>,
}

impl Slope {
    fn new(count: usize) -> Self {
        Slope { by: vec![[0.0; 4]; count], blame: vec![0.0; count] }
    }

    fn add(&mut self, sphere: usize, direction: Point, by_gap: f64) {
        let [x, y, z, radius] = &mut self.by[sphere];
        for (to, along) in [x, y, z].into_iter().zip(direction) {
            *to += by_gap * along;
        }
        *radius -= by_gap;
    }

    /// Adds another gradient, whose first sphere has index `first`.
    pub fn merge(&mut self, first: usize, other: &Slope) {
        sum_up(self.by[first..].as_flattened_mut(), other.by.as_flattened());
        sum_up(&mut self.blame[first..], &other.blame);
    }
}

pub fn sum_up(to: &mut [f64], from: &[f64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to += from;
    }
}

/// The index of each link's first sphere, and the total number of spheres.
fn firsts(spheres: &Spheres) -> (Vec<usize>, usize) {
    let mut all = 0;
    let first = |own: &Vec<_>| {
        all += own.len();
        all - own.len()
    };
    (spheres.iter().map(first).collect(), all)
}

impl Goal<'_> {
    /// The gradient of the surface term.
    pub fn of_surface(&self, spheres: &Spheres) -> Slope {
        let (firsts, count) = firsts(spheres);
        let of_link = |(own, points): (&Vec<_>, &Vec<Point>)| {
            let mut slope = Slope::new(own.len());
            let weight = 1.0 / (self.size * self.size * points.len().max(1) as f64);
            for p in points {
                let Some((nearest, off)) = nearest(own, *p) else { break };
                let between = sub(*p, own[nearest].centre);
                let toward = scaled(between, 1.0 / norm(between).max(f64::MIN_POSITIVE));
                // The distance decreases as the centre moves towards the point, and as the radius grows.
                slope.add(nearest, scaled(toward, -1.0), 2.0 * weight * off);
                slope.blame[nearest] += weight * off * off;
            }
            slope
        };
        let slopes: Vec<Slope> = spheres.par_iter().zip(self.surface).map(of_link).collect();
        let mut sum = Slope::new(count);
        for (first, slope) in firsts.into_iter().zip(&slopes) {
            sum.merge(first, slope);
        }
        sum
    }

    /// The pairs that are nearer than `reach` in each free configuration, and in contact in each colliding one. Pairs that
    /// are in no sampled collision, and whose spheres touch in some sample, are ignored from then on.
    pub fn look(&self, spheres: &Spheres, ignored: &mut [bool], reach: f64) -> Vec<Looked> {
        let mut touches = vec![false; self.pairs.len()];
        for pair in self.samples.iter().flat_map(|sample| &sample.touching) {
            touches[*pair as usize] = true;
        }
        let model = Placeable::new(spheres);
        let is_ignored = &*ignored;
        let near = |placed: &mut Placed, sample: &Sample| -> Vec<(u32, f64)> {
            model.place(sample, placed);
            let mut found = Vec::new();
            for (pair, (number, links)) in (0u32..).zip(self.pairs.iter().enumerate()) {
                let limit = if sample.collides() { f64::MIN_POSITIVE } else { reach };
                if !(is_ignored[number] || sample.collides() && touches[number])
                    && model.may_be_near(placed, *links, limit)
                {
                    let gap = model.gap(sample, placed, *links, limit);
                    if gap < limit {
                        found.push((pair, gap));
                    }
                }
            }
            found
        };
        let found = self.samples.par_iter().map_init(Placed::default, near);
        let found: Vec<Vec<(u32, f64)>> = found.collect();
        for (pair, gap) in found.iter().flatten() {
            ignored[*pair as usize] |= *gap <= 0.0 && !touches[*pair as usize];
        }
        let looked = |(sample, near): (usize, Vec<(u32, f64)>)| {
            let pairs = if self.samples[sample].collides() {
                self.samples[sample].touching.clone()
            } else {
                near.into_iter().map(|(pair, _)| pair).collect()
            };
            let pairs = pairs.into_iter().filter(|pair| !ignored[*pair as usize]);
            Looked { sample, pairs: pairs.collect() }
        };
        found.into_iter().enumerate().map(looked).collect()
    }

    /// The configurations that contribute to the loss as long as no sphere moves or grows by more than about half of
    /// `band`, metres. Removes from `looked_at` whatever cannot contribute before a sphere does so by half of `far`.
    pub fn active(
        &self,
        spheres: &Spheres,
        looked_at: &mut Vec<Looked>,
        [colliding, free]: [usize; 2],
        [band, far]: [f64; 2],
    ) -> Vec<Active> {
        let model = Placeable::new(spheres);
        let weights = [
            FREE / (self.size * free.max(1) as f64),
            COLLIDING / (self.size * colliding.max(1) as f64),
        ];
        let margin = MARGIN * self.size + band;
        let far = margin.max(MARGIN * self.size + far);
        let near = |placed: &mut Placed, looked: &mut Looked| -> Active {
            let sample = &self.samples[looked.sample];
            model.place(sample, placed);
            let mut near = Vec::new();
            let mut add = |placed: &mut Placed, pair: u32, limit| {
                let [a, b] = self.pairs[pair as usize];
                model.near(sample, placed, [a, b], limit, |_, [i, j]| {
                    near.push([(a, i), (b, j)]);
                    limit
                });
            };
            if sample.collides() {
                let mut deepest = f64::INFINITY;
                for pair in &looked.pairs {
                    let links = self.pairs[*pair as usize];
                    if model.may_be_near(placed, links, deepest) {
                        deepest = model.gap(sample, placed, links, deepest);
                    }
                    if deepest < -far {
                        looked.pairs.clear();
                        break;
                    }
                }
                if deepest >= -margin {
                    for pair in &looked.pairs {
                        add(placed, *pair, deepest + 2.0 * band);
                    }
                }
            } else {
                looked.pairs.retain(|pair| {
                    let links = self.pairs[*pair as usize];
                    let gap = if model.may_be_near(placed, links, far) {
                        model.gap(sample, placed, links, far)
                    } else {
                        far
                    };
                    if gap < margin {
                        add(placed, *pair, margin);
                    }
                    gap < far
                });
            }
            let first = if looked.sample == 0 { FIRST } else { 1.0 };
            Active {
                sample: looked.sample,
                near,
                weight: weights[usize::from(sample.collides())] * first,
            }
        };
        let found = looked_at.par_iter_mut().map_init(Placed::default, near);
        let mut found: Vec<Active> = found.collect();
        looked_at.retain(|looked| !looked.pairs.is_empty());
        found.retain(|active| !active.near.is_empty());
        found
    }

    /// The gradient of the contact term.
    pub fn of_contacts(&self, spheres: &Spheres, active: &[Active]) -> Slope {
        let (firsts, count) = firsts(spheres);
        let block = |active: &[Active]| {
            let mut slope = Slope::new(count);
            for one in active {
                self.of_configuration(spheres, &firsts, one, &mut slope);
            }
            slope
        };
        let slopes: Vec<Slope> = active.par_chunks(BLOCK).map(block).collect();
        let mut sum = Slope::new(count);
        for slope in &slopes {
            sum.merge(0, slope);
        }
        sum
    }

    fn of_configuration(
        &self,
        spheres: &Spheres,
        firsts: &[usize],
        active: &Active,
        slope: &mut Slope,
    ) {
        let sample = &self.samples[active.sample];
        let margin = MARGIN * self.size;
        // Two spheres, by link and index, and the vector from the second centre to the first.
        let mut push = |[(a, i), (b, j)]: [(usize, usize); 2], between: Point, by_gap: f64| {
            let toward = scaled(between, 1.0 / norm(between).max(f64::MIN_POSITIVE));
            let (first, second) = (firsts[a] + i, firsts[b] + j);
            slope.add(first, sample.poses[a].turn_back(toward), by_gap);
            slope.add(second, sample.poses[b].turn_back(scaled(toward, -1.0)), by_gap);
            slope.blame[first] += by_gap.abs();
            slope.blame[second] += by_gap.abs();
        };
        let mut nearest = None;
        let mut least = f64::INFINITY;
        for both in &active.near {
            let [of_a, of_b] = both.map(|(link, number)| spheres[link][number]);
            let [p, q] = [(both[0].0, of_a), (both[1].0, of_b)]
                .map(|(link, sphere)| sample.poses[link].place(sphere.centre));
            let between = sub(p, q);
            let gap = norm(between) - of_a.radius - of_b.radius;
            if !sample.collides() && gap < margin {
                push(*both, between, -active.weight);
            } else if sample.collides() && gap < least {
                least = gap;
                nearest = Some((*both, between));
            }
        }
        if let Some((both, between)) = nearest
            && least + margin > 0.0
        {
            push(both, between, active.weight);
        }
    }
}

/// The sphere with the smallest signed distance to a point, and that distance: negative inside.
#[inline]
pub fn nearest(own: &[Sphere], p: Point) -> Option<(usize, f64)> {
    own.iter().map(|sphere| distance(sphere, p)).enumerate().min_by(|a, b| a.1.total_cmp(&b.1))
}

/// The mean of points; `None` if there are none.
pub fn middle(points: &[Point]) -> Option<Point> {
    let sum = points.iter().copied().reduce(add)?;
    Some(scaled(sum, 1.0 / points.len() as f64))
}
