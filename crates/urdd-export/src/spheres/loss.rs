//! The loss of spheres, and its gradient.
//!
//! Two terms. *Surface*: the union of a link's spheres should have the same surface as the link. Each point of the
//! link's surface costs its squared distance to the surface of the spheres, outside or inside. *Contacts*: the spheres
//! should give the same collision results as the exact shapes. In a free configuration, each pair of spheres costs as
//! much as its distance falls short of a margin. In a colliding one, the pair of spheres nearest to contact, among the
//! pairs of links in contact, costs as much as its penetration falls short of a margin.

use rayon::prelude::*;

use super::frame::{Point, add, dot, length, scaled, sub};
use super::model::{Placeable, Placed, Spheres};
use super::samples::Sample;

/// Configurations per block. Blocks are summed in order, so results do not depend on the number of threads.
const BLOCK: usize = 256;

/// The target of the fit.
pub(super) struct Goal<'a> {
    /// Points on the surface of each link.
    pub surface: &'a [Vec<Point>],
    /// The sampled configurations; the first has the weight of [`FIRST`] others.
    pub samples: &'a [Sample],
    /// The pairs of links that are checked.
    pub pairs: &'a [[usize; 2]],
    /// For each pair, whether it is written as ignored.
    pub ignored: &'a [bool],
    /// A typical radius, in metres: the unit of length of the constants.
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

/// A configuration with pairs of links near enough to contact to affect the loss, and these pairs.
pub(super) struct Active {
    sample: usize,
    pairs: Vec<usize>,
    weight: f64,
}

/// The gradient of the loss, 4 numbers per sphere (centre, radius), and each sphere's share of the loss.
pub(super) struct Slope {
    pub by: Vec<[f64; 4]>,
    pub blame: Vec<f64>,
}

impl Slope {
    fn new(count: usize) -> Self {
        Slope {
            by: vec![[0.0; 4]; count],
            blame: vec![0.0; count],
        }
    }

    fn add(&mut self, sphere: usize, direction: Point, by_gap: f64) {
        let [x, y, z, radius] = &mut self.by[sphere];
        for (to, along) in [x, y, z].into_iter().zip(direction) {
            *to += by_gap * along;
        }
        *radius -= by_gap;
    }

    /// Adds another gradient, whose first sphere has index `first`.
    fn merge(&mut self, first: usize, other: &Slope) {
        for (to, from) in self.by[first..].iter_mut().zip(&other.by) {
            for (to, from) in to.iter_mut().zip(from) {
                *to += from;
            }
        }
        for (to, from) in self.blame[first..].iter_mut().zip(&other.blame) {
            *to += from;
        }
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
                let Some((nearest, off)) = nearest(own, *p) else {
                    break;
                };
                let between = sub(*p, own[nearest].centre);
                let toward = scaled(between, 1.0 / length(between).max(f64::MIN_POSITIVE));
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

    /// The configurations that can affect the loss while no sphere moves or grows by more than about half of `band`, in
    /// metres. `looked_at` lists the samples to check. Removes those that cannot affect it until spheres have moved or
    /// grown by half of `far`.
    pub fn active(
        &self,
        spheres: &Spheres,
        looked_at: &mut Vec<usize>,
        [colliding, free]: [usize; 2],
        [band, far]: [f64; 2],
    ) -> Vec<Active> {
        let model = Placeable::new(spheres);
        let weights = [
            FREE / (self.size * free.max(1) as f64),
            COLLIDING / (self.size * colliding.max(1) as f64),
        ];
        // The pairs that can affect the loss; `None` if the sample can be removed.
        let near = |placed: &mut Placed, k: &usize| -> Option<Vec<usize>> {
            let sample = &self.samples[*k];
            model.place(sample, placed);
            let margin = MARGIN * self.size + band;
            let far = margin.max(MARGIN * self.size + far);
            let mut matters = sample.collides();
            let mut pairs = Vec::new();
            if sample.collides() {
                let touching = sample.touching.iter().map(|pair| *pair as usize);
                let mut deepest = f64::INFINITY;
                for pair in touching.filter(|pair| !self.ignored[*pair]) {
                    pairs.push(pair);
                    if model.may_be_near(placed, self.pairs[pair], 0.0) {
                        deepest = deepest.min(model.gap(sample, placed, self.pairs[pair]));
                    }
                    if deepest < -far {
                        return None;
                    }
                }
                matters = !pairs.is_empty();
                if deepest < -margin {
                    pairs.clear();
                }
            } else {
                for (pair, links) in self.pairs.iter().enumerate() {
                    if !self.ignored[pair] && model.may_be_near(placed, *links, far) {
                        let gap = model.gap(sample, placed, *links);
                        matters |= gap < far;
                        if gap < margin {
                            pairs.push(pair);
                        }
                    }
                }
            }
            matters.then_some(pairs)
        };
        let found: Vec<Option<Vec<usize>>> = looked_at
            .par_iter()
            .map_init(Placed::default, near)
            .collect();
        let both = looked_at.iter().copied().zip(found);
        let left: Vec<(usize, Vec<usize>)> = both
            .filter_map(|(sample, pairs)| Some((sample, pairs?)))
            .collect();
        *looked_at = left.iter().map(|(sample, _)| *sample).collect();
        let active = |(sample, pairs): (usize, Vec<usize>)| {
            let first = if sample == 0 { FIRST } else { 1.0 };
            Active {
                sample,
                pairs,
                weight: weights[usize::from(self.samples[sample].collides())] * first,
            }
        };
        let now = left.into_iter().filter(|(_, pairs)| !pairs.is_empty());
        now.map(active).collect()
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
            let toward = scaled(between, 1.0 / length(between).max(f64::MIN_POSITIVE));
            let (first, second) = (firsts[a] + i, firsts[b] + j);
            slope.add(first, sample.poses[a].turn_back(toward), by_gap);
            slope.add(
                second,
                sample.poses[b].turn_back(scaled(toward, -1.0)),
                by_gap,
            );
            slope.blame[first] += by_gap.abs();
            slope.blame[second] += by_gap.abs();
        };
        let mut nearest = None;
        let mut least = f64::INFINITY;
        for pair in &active.pairs {
            let [a, b] = self.pairs[*pair];
            let of_b: Vec<Point> = spheres[b]
                .iter()
                .map(|s| sample.poses[b].place(s.centre))
                .collect();
            for (i, of_a) in spheres[a].iter().enumerate() {
                let p = sample.poses[a].place(of_a.centre);
                for (j, (q, of_b)) in of_b.iter().zip(&spheres[b]).enumerate() {
                    let between = sub(p, *q);
                    let squared = dot(between, between);
                    let reach = of_a.radius + of_b.radius;
                    if sample.collides() {
                        let near = least + reach;
                        if near > 0.0 && squared < near * near {
                            least = squared.sqrt() - reach;
                            nearest = Some(([(a, i), (b, j)], between));
                        }
                    } else if squared < (reach + margin) * (reach + margin) {
                        push([(a, i), (b, j)], between, -active.weight);
                    }
                }
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
pub(super) fn nearest(own: &[super::model::Sphere], p: Point) -> Option<(usize, f64)> {
    let each = own.iter().map(|sphere| sphere.to(p)).enumerate();
    each.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// The mean of points; `None` if there are none.
pub(super) fn middle(points: &[Point]) -> Option<Point> {
    let sum = points.iter().copied().reduce(add)?;
    Some(scaled(sum, 1.0 / points.len() as f64))
}
