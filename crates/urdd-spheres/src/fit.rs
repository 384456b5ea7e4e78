//! Fits spheres to surfaces and contacts.
//!
//! Each link begins with one sphere. Gradient descent (Adam) on the surface loss alone alternates with splitting the
//! spheres with the highest cost, until half of the budget is used. From then on, pairs of links without a sampled
//! collision whose spheres touch anyway are ignored. Then the contact loss is added. Each round removes the spheres
//! that contribute least and splits those with the largest share in wrong contacts, so that spheres concentrate where
//! links approach each other. The algorithm is deterministic, with a fixed order of summation.

use super::frame::{Point, add, norm, scaled, sub};
pub use super::loss::Goal;
use super::loss::{Looked, middle, nearest, sum_up};
use super::model::{Sphere, Spheres, count, distance};
use super::samples::Sample;

/// Limits on the number of spheres.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    pub total: usize,
    pub per_link: usize,
}

/// Rounds of splitting by the surface loss alone, and steps in each.
const SURFACE_ROUNDS: usize = 4;
const SURFACE_STEPS: usize = 30;
/// The fraction of the spheres that are placed by the surface loss alone.
const BY_SURFACE: f64 = 0.5;

/// Rounds of splitting by contacts, and steps in each; then the final steps.
const CONTACT_ROUNDS: usize = 10;
const CONTACT_STEPS: usize = 20;
const LAST_STEPS: usize = 160;
/// The fraction of the spheres that each round removes, to place them where they are more useful.
const MOVED: f64 = 0.05;
/// The share of contacts, as opposed to the surface, in a sphere's blame.
const CONTACT_SHARE: f64 = 0.8;
/// Contact rounds use every `STRIDE`-th sample; the final steps use all.
const STRIDE: usize = 3;

/// In a free configuration, links that are farther apart than this are ignored, in units of `Goal::size`.
const NEAR: f64 = 1.0;

/// Number of steps after which the relevant configurations are selected again.
const LOOK_AGAIN: usize = 10;
/// Number of steps at the end of a round over which blame is summed.
const BLAMED: usize = 5;

/// Step sizes at the beginning and at the end, in units of `Goal::size`.
const SURFACE_STEP: [f64; 2] = [0.02, 0.005];
const LAST_STEP: [f64; 2] = [0.01, 0.0005];
/// Step sizes in rounds of splitting by contacts. The result of a fit depends on them: the second is tried if the first
/// does not reach the goals.
pub const CONTACT_STEP: [[f64; 2]; 2] = [[0.02, 0.005], [0.01, 0.003]];

/// Minimum radius, in units of `Goal::size`.
const SMALLEST: f64 = 0.02;

/// Fits spheres. `ignored` marks the pairs to ignore; the fit adds those that need no check.
pub fn fit(
    surface: &[Vec<Point>],
    samples: &[Sample],
    pairs: &[[usize; 2]],
    ignored: &mut [bool],
    limits: Limits,
    contact_step: [f64; 2],
) -> Spheres {
    let mut spheres: Spheres = surface.iter().map(|points| one_sphere(points)).collect();
    let links = count(&spheres);
    if links == 0 {
        return spheres;
    }
    let size = spheres.iter().flatten().map(|s| s.radius).sum::<f64>() / links as f64;
    // All links are points, so there is nothing to fit.
    if size <= 0.0 {
        return spheres;
    }
    let total = limits.total.max(links);
    let first = ((total as f64 * BY_SURFACE) as usize).max(links);
    let of_surface = Goal { surface, samples, pairs, size };
    for round in 1..=SURFACE_ROUNDS {
        let blame = descend(&of_surface, &mut spheres, SURFACE_STEPS, SURFACE_STEP, None);
        let part = round as f64 / SURFACE_ROUNDS as f64;
        let goal = links as f64 * (first as f64 / links as f64).powf(part);
        split(&mut spheres, surface, blame, goal.round() as usize, limits.per_link);
    }
    descend(&of_surface, &mut spheres, SURFACE_STEPS, SURFACE_STEP, None);
    let goal = of_surface;
    let looked = goal.look(&spheres, ignored, NEAR * size);
    let some: Vec<Looked> = looked.into_iter().step_by(STRIDE).collect();
    for round in 1..=CONTACT_ROUNDS {
        let mut blame =
            descend(&goal, &mut spheres, CONTACT_STEPS, contact_step, Some(some.clone()));
        drop_idle(&goal, &mut spheres, &mut blame);
        let now = first + (total - first) * round / CONTACT_ROUNDS;
        split(&mut spheres, surface, blame, now, limits.per_link);
    }
    let all = goal.look(&spheres, ignored, NEAR * size);
    descend(&goal, &mut spheres, LAST_STEPS, LAST_STEP, Some(all));
    goal.look(&spheres, ignored, f64::MIN_POSITIVE);
    spheres
}

/// One sphere for all points of a link: centred at their mean, with their mean distance as radius.
fn one_sphere(points: &[Point]) -> Vec<Sphere> {
    let sphere = |centre: Point| {
        let far = points.iter().map(|p| norm(sub(*p, centre))).sum::<f64>();
        let radius = far / points.len() as f64;
        Sphere { centre, radius }
    };
    middle(points).map(sphere).into_iter().collect()
}

/// Gradient descent. The contact loss counts if configurations for it are given. Returns each sphere's blame.
fn descend(
    goal: &Goal,
    spheres: &mut Spheres,
    steps: usize,
    [from, to]: [f64; 2],
    looked_at: Option<Vec<Looked>>,
) -> Vec<f64> {
    let number = count(spheres);
    let mut adam = Adam::new(number);
    let mut active = Vec::new();
    let by_contact = looked_at.is_some();
    let mut looked_at = looked_at.unwrap_or_default();
    let colliding =
        looked_at.iter().filter(|looked| goal.samples[looked.sample].collides()).count();
    let classes = [colliding, looked_at.len() - colliding];
    let length_of = |step: usize| goal.size * from * (to / from).powf(step as f64 / steps as f64);
    let mut by_surface = vec![0.0; number];
    let mut by_contacts = vec![0.0; number];
    for step in 0..steps {
        let length = length_of(step);
        let mut slope = goal.of_surface(spheres);
        let is_blamed = step + BLAMED >= steps;
        if is_blamed {
            sum_up(&mut by_surface, &slope.blame);
        }
        if by_contact {
            if step.is_multiple_of(LOOK_AGAIN) {
                let left: f64 = (step..steps).map(length_of).sum();
                active = goal.active(
                    spheres,
                    &mut looked_at,
                    classes,
                    [LOOK_AGAIN as f64 * length, left],
                );
            }
            let contacts = goal.of_contacts(spheres, &active);
            if is_blamed {
                sum_up(&mut by_contacts, &contacts.blame);
            }
            slope.merge(0, &contacts);
        }
        adam.step(spheres, &slope.by, length, SMALLEST * goal.size);
    }
    let share = if by_contact { CONTACT_SHARE } else { 0.0 };
    let [of_surface, of_contacts] =
        [&by_surface, &by_contacts].map(|blame| blame.iter().sum::<f64>().max(f64::MIN_POSITIVE));
    let both = by_surface.iter().zip(&by_contacts);
    both.map(|(s, c)| (1.0 - share) * s / of_surface + share * c / of_contacts).collect()
}

/// Adam (D. P. Kingma, J. Ba, ICLR 2015).
struct Adam {
    mean: Vec<[f64; 4]>,
    square: Vec<[f64; 4]>,
    steps: i32,
}

const MEAN: f64 = 0.9;
const SQUARE: f64 = 0.99;
const TINY: f64 = 1e-8;

impl Adam {
    fn new(number: usize) -> Self {
        Adam { mean: vec![[0.0; 4]; number], square: vec![[0.0; 4]; number], steps: 0 }
    }

    fn step(&mut self, spheres: &mut Spheres, slope: &[[f64; 4]], length: f64, smallest: f64) {
        self.steps += 1;
        let [mean, square] = [MEAN, SQUARE].map(|decay| 1.0 - decay.powi(self.steps));
        for (number, sphere) in spheres.iter_mut().flatten().enumerate() {
            let (m, v) = (&mut self.mean[number], &mut self.square[number]);
            let by: [f64; 4] = std::array::from_fn(|k| {
                let slope = slope[number][k];
                m[k] = MEAN * m[k] + (1.0 - MEAN) * slope;
                v[k] = SQUARE * v[k] + (1.0 - SQUARE) * slope * slope;
                length * (m[k] / mean) / ((v[k] / square).sqrt() + TINY)
            });
            sphere.centre = sub(sphere.centre, [by[0], by[1], by[2]]);
            sphere.radius = (sphere.radius - by[3]).max(smallest);
        }
    }
}

/// Splits the spheres with the most blame until there are `wanted`: each at most once, and none of a link at its limit.
fn split(
    spheres: &mut Spheres,
    surface: &[Vec<Point>],
    blame: Vec<f64>,
    wanted: usize,
    per_link: usize,
) {
    let mut order: Vec<(f64, usize, usize)> = numbered(spheres, &blame);
    order.sort_by(|a, b| b.0.total_cmp(&a.0));
    let old = spheres.clone();
    let mut left = wanted.saturating_sub(count(spheres));
    for (_, link, number) in order {
        if left == 0 {
            break;
        }
        if spheres[link].len() < per_link {
            let [one, other] = halves(&old[link], number, &surface[link]);
            spheres[link][number] = one;
            spheres[link].push(other);
            left -= 1;
        }
    }
}

/// The value of each sphere, with its link and its index in the link.
fn numbered(spheres: &Spheres, values: &[f64]) -> Vec<(f64, usize, usize)> {
    let places = spheres.iter().enumerate();
    let places = places.flat_map(|(link, own)| (0..own.len()).map(move |number| (link, number)));
    values.iter().zip(places).map(|(value, (link, number))| (*value, link, number)).collect()
}

/// Replaces a sphere by two, separated along the direction of greatest spread of the points nearest to it.
fn halves(own: &[Sphere], number: usize, surface: &[Point]) -> [Sphere; 2] {
    let sphere = own[number];
    let is_its_own = |p: &&Point| nearest(own, **p).is_some_and(|(found, _)| found == number);
    let points: Vec<Point> = surface.iter().filter(is_its_own).copied().collect();
    let mut shift = [0.4 * sphere.radius, 0.0, 0.0];
    if let (Some(middle), 4..) = (middle(&points), points.len()) {
        let mut spread = nalgebra::Matrix3::zeros();
        for p in &points {
            let from = nalgebra::Vector3::from(sub(*p, middle));
            spread += from * from.transpose();
        }
        let eigen = spread.symmetric_eigen();
        let most = eigen.eigenvalues.imax();
        let deviation = (eigen.eigenvalues[most].max(0.0) / points.len() as f64).sqrt();
        let axis: Point = eigen.eigenvectors.column(most).into_owned().into();
        if axis.iter().all(|x| x.is_finite()) {
            shift = scaled(axis, 0.8 * deviation);
        }
    }
    let radius = 0.8 * sphere.radius;
    [add(sphere.centre, shift), sub(sphere.centre, shift)].map(|centre| Sphere { centre, radius })
}

/// Removes the spheres that contribute least to the surface and have no part in contacts.
fn drop_idle(goal: &Goal, spheres: &mut Spheres, blame: &mut Vec<f64>) {
    let mut costs = Vec::new();
    for (own, points) in spheres.iter().zip(goal.surface) {
        let mut cost = vec![0.0; own.len()];
        let weight = 1.0 / (goal.size * goal.size * points.len().max(1) as f64);
        for p in points {
            let mut least = (f64::INFINITY, 0);
            let mut second = f64::INFINITY;
            for (number, sphere) in own.iter().enumerate() {
                let off = distance(sphere, *p);
                if off < least.0 {
                    second = least.0;
                    least = (off, number);
                } else if off < second {
                    second = off;
                }
            }
            cost[least.1] += weight * (second * second - least.0 * least.0);
        }
        costs.extend(cost);
    }
    // Blame outweighs any surface cost.
    let costs: Vec<f64> =
        costs.iter().zip(&*blame).map(|(cost, blame)| cost + 1e3 * blame).collect();
    let mut order = numbered(spheres, &costs);
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    order.truncate((count(spheres) as f64 * MOVED) as usize);
    let mut gone: Vec<(usize, usize)> =
        order.into_iter().map(|(_, link, number)| (link, number)).collect();
    gone.sort_unstable();
    let mut blames = numbered(spheres, blame);
    for (link, number) in gone.into_iter().rev() {
        if spheres[link].len() > 1 {
            spheres[link].remove(number);
            blames.retain(|(_, of, place)| (*of, *place) != (link, number));
        }
    }
    *blame = blames.into_iter().map(|(blame, _, _)| blame).collect();
}
