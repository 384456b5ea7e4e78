//! What spheres cost, and which way each should move.
//!
//! Two terms. *Surface*: the surface of a link's spheres together should be where the link's is, so each point of the
//! link's surface costs the square of its distance from it, outside or inside. *Contacts*: the spheres should answer as
//! the exact shapes do. In a free configuration each pair of spheres costs as far as it reaches beyond a margin; in a
//! colliding one, the pair of spheres that is nearest to contact (of the pairs of links that are in contact) costs as far
//! as it misses a margin.

use rayon::prelude::*;

use super::frame::{Point, add, dot, length, scaled, sub};
use super::model::{Placeable, Placed, Spheres};
use super::samples::Sample;

/// Configurations that are summed up together, in order: so sums do not depend on the number of threads.
const BLOCK: usize = 256;

/// What spheres are fitted to.
pub(super) struct Goal<'a> {
    /// Points on the surface of each link.
    pub surface: &'a [Vec<Point>],
    /// The configurations; the first counts as much as [`FIRST`] others.
    pub samples: &'a [Sample],
    /// The pairs of links that are checked.
    pub pairs: &'a [[usize; 2]],
    /// Whether each is written as ignored.
    pub ignored: &'a [bool],
    /// A typical radius, metres: the unit of lengths.
    pub size: f64,
}

/// How often the default configuration counts.
const FIRST: f64 = 50.0;

/// What all collisions count together, and all free configurations, beside a surface that is off by the unit of lengths:
/// as one to the parts of them that may be wrong.
const COLLIDING: f64 = 100.0;
const FREE: f64 = 20.0;

/// So far beyond contact, and so far apart, spheres should be: in units of lengths.
const MARGIN: f64 = 0.01;

/// A configuration whose pairs of links are near enough to contact to matter, and these pairs.
pub(super) struct Active {
    sample: usize,
    pairs: Vec<usize>,
    weight: f64,
}

/// The slope of the loss, 4 numbers a sphere (centre, radius), and each sphere's part in the loss.
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

    /// Adds another slope, of spheres from number `first` on.
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

/// The number of the first sphere of each link, and of all.
fn firsts(spheres: &Spheres) -> (Vec<usize>, usize) {
    let mut all = 0;
    let first = |own: &Vec<_>| {
        all += own.len();
        all - own.len()
    };
    (spheres.iter().map(first).collect(), all)
}

impl Goal<'_> {
    /// The slope of the surface's term.
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
                // The distance falls as the centre moves toward the point, and as the sphere grows.
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

    /// The configurations that matter as long as no sphere moves or grows by more than about half of `band`, metres.
    /// `looked_at` are the samples to look at; those that will not matter before spheres did so by half of `far` go.
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
        // The pairs that matter; `None` where none will.
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

    /// The slope of the contacts' term.
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
        // Two spheres, by link and number, and the vector from the second centre to the first.
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

/// The sphere whose surface is nearest outside of a point, or under which it is deepest, and how far: negative inside.
pub(super) fn nearest(own: &[super::model::Sphere], p: Point) -> Option<(usize, f64)> {
    let each = own.iter().map(|sphere| sphere.to(p)).enumerate();
    each.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// The middle of points; `None` without any.
pub(super) fn middle(points: &[Point]) -> Option<Point> {
    let sum = points.iter().copied().reduce(add)?;
    Some(scaled(sum, 1.0 / points.len() as f64))
}
