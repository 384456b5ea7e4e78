//! A tree over the spheres of a link, so that not each of them is looked at. Equal spheres are in it once.

use std::collections::HashSet;
use std::ops::Range;

use crate::frame::{Point, Pose, add, dot, norm, scaled, sub};
use urdd_geometry::bounding_sphere::BoundingSphere as Sphere;

/// The most spheres of a part that is not parted again.
const LEAF: usize = 8;
/// By which part of coordinates spheres around others are larger, so that rounding leaves nothing outside.
const LARGER: f64 = 1e-12;

/// Spheres, parted.
#[derive(Debug)]
pub struct SphereTree<'s> {
    spheres: &'s [Sphere],
    /// The indices of spheres, those of a part one after another.
    order: Vec<usize>,
    /// The whole first; none without spheres.
    parts: Vec<Part>,
}

#[derive(Debug)]
struct Part {
    around: Sphere,
    own: Range<usize>,
    /// Its two halves; of a small part none.
    halves: Option<[usize; 2]>,
}

/// The numbers of a sphere, which equal ones share.
pub fn bits(sphere: &Sphere) -> [u64; 4] {
    let [x, y, z] = sphere.centre;
    [x, y, z, sphere.radius].map(f64::to_bits)
}

/// A sphere around spheres.
pub fn around<'s>(own: impl Iterator<Item = &'s Sphere> + Clone) -> Option<Sphere> {
    let mut low = own.clone().next()?.centre;
    let mut high = low;
    for sphere in own.clone() {
        for k in 0..3 {
            low[k] = low[k].min(sphere.centre[k] - sphere.radius);
            high[k] = high[k].max(sphere.centre[k] + sphere.radius);
        }
    }
    let centre = scaled(add(low, high), 0.5);
    let reach = |sphere: &Sphere| norm(sub(sphere.centre, centre)) + sphere.radius;
    Some(Sphere { centre, radius: own.map(reach).fold(0.0, f64::max) })
}

/// The signed distance of a point to a sphere; negative inside.
#[inline]
pub fn distance(sphere: &Sphere, p: Point) -> f64 {
    norm(sub(p, sphere.centre)) - sphere.radius
}

/// What rounding may take from the distance of two points.
fn slack(p: Point, q: Point) -> f64 {
    LARGER * p.iter().chain(&q).fold(0.0, |sum: f64, x| sum + x.abs())
}

fn touch((p, r): (Point, f64), (q, s): (Point, f64)) -> bool {
    let between = sub(p, q);
    let reach = r + s;
    dot(between, between) < reach * reach && norm(between) <= reach
}

impl<'s> SphereTree<'s> {
    /// Of the spheres of a link.
    pub fn new(spheres: &'s [Sphere]) -> Self {
        let mut known = HashSet::new();
        let order = (0..spheres.len()).filter(|one| known.insert(bits(&spheres[*one])));
        let mut tree = SphereTree { spheres, order: order.collect(), parts: Vec::new() };
        let whole = 0..tree.order.len();
        tree.parts.extend(tree.part(whole));
        let mut next = 0;
        while next < tree.parts.len() {
            let own = tree.parts[next].own.clone();
            if own.len() > LEAF {
                let middle = tree.cut(own.clone());
                tree.parts[next].halves = Some([tree.parts.len(), tree.parts.len() + 1]);
                for half in [own.start..middle, middle..own.end] {
                    let half = tree.part(half);
                    tree.parts.extend(half);
                }
            }
            next += 1;
        }
        tree
    }

    fn part(&self, own: Range<usize>) -> Option<Part> {
        let around = around(self.order[own.clone()].iter().map(|one| &self.spheres[*one]))?;
        Some(Part { around, own, halves: None })
    }

    /// Cuts a part in the middle along the axis on which its centres are farthest apart.
    fn cut(&mut self, own: Range<usize>) -> usize {
        let SphereTree { spheres, order, .. } = self;
        let order = &mut order[own.clone()];
        let width = |axis: usize| {
            let along = order.iter().map(|one| spheres[*one].centre[axis]);
            along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
        };
        let axis = [1, 2].into_iter().fold(0, |a, b| if width(b) > width(a) { b } else { a });
        let middle = order.len() / 2;
        order.select_nth_unstable_by(middle, |a, b| {
            spheres[*a].centre[axis].total_cmp(&spheres[*b].centre[axis]).then(a.cmp(b))
        });
        own.start + middle
    }

    /// Whether a point is in one of the spheres, each smaller by a factor, other than those that equal `own`; and how many
    /// were looked at.
    pub fn holds(&self, point: Point, factor: f64, own: &Sphere) -> (bool, usize) {
        let mut steps = 0;
        let mut waiting = Vec::from_iter((!self.parts.is_empty()).then_some(0));
        while let Some(part) = waiting.pop() {
            let Part { around, own: range, halves } = &self.parts[part];
            steps += 1;
            let apart = norm(sub(point, around.centre));
            if apart > around.radius + slack(point, around.centre) {
                continue;
            }
            if let Some(halves) = halves {
                waiting.extend(halves);
                continue;
            }
            for sphere in self.order[range.clone()].iter().map(|one| &self.spheres[*one]) {
                steps += 1;
                let is_in = norm(sub(point, sphere.centre)) < factor * sphere.radius;
                if is_in && bits(sphere) != bits(own) {
                    return (true, steps);
                }
            }
        }
        (false, steps)
    }

    /// The signed distance of a point to the nearest sphere; and how many were looked at.
    pub fn distance(&self, point: Point) -> (f64, usize) {
        let mut steps = 0;
        let mut least = f64::INFINITY;
        let mut waiting = Vec::from_iter((!self.parts.is_empty()).then_some(0));
        let beyond = |part: usize| {
            let around = &self.parts[part].around;
            distance(around, point) - slack(point, around.centre)
        };
        while let Some(part) = waiting.pop() {
            steps += 1;
            if beyond(part) > least {
                continue;
            }
            match self.parts[part].halves {
                // The nearer one is looked at first.
                Some([a, b]) if beyond(a) < beyond(b) => waiting.extend([b, a]),
                Some(halves) => waiting.extend(halves),
                None => {
                    for one in &self.order[self.parts[part].own.clone()] {
                        steps += 1;
                        least = least.min(distance(&self.spheres[*one], point));
                    }
                }
            }
        }
        (least, steps)
    }

    /// Places the spheres of a small part.
    fn place<'p>(
        &self,
        part: &Part,
        pose: &Pose,
        placed: &'p mut [(Point, f64); LEAF],
    ) -> &'p [(Point, f64)] {
        let own = &self.order[part.own.clone()];
        for (placed, one) in placed.iter_mut().zip(own) {
            *placed = (pose.place(self.spheres[*one].centre), self.spheres[*one].radius);
        }
        &placed[..own.len()]
    }

    /// Whether spheres of two links touch, in poses of both; and how many pairs were looked at.
    pub fn touches(&self, pose: &Pose, other: &SphereTree, other_pose: &Pose) -> (bool, usize) {
        let mut steps = 0;
        let both = !self.parts.is_empty() && !other.parts.is_empty();
        let mut waiting = Vec::from_iter(both.then_some((0, 0)));
        while let Some((i, j)) = waiting.pop() {
            steps += 1;
            let (a, b) = (&self.parts[i], &other.parts[j]);
            let (p, q) = (pose.place(a.around.centre), other_pose.place(b.around.centre));
            let reach = a.around.radius + b.around.radius + slack(p, q);
            if dot(sub(p, q), sub(p, q)) > reach * reach {
                continue;
            }
            match (a.halves, b.halves) {
                (Some(halves), None) => waiting.extend(halves.map(|half| (half, j))),
                (Some(halves), _) if a.around.radius >= b.around.radius => {
                    waiting.extend(halves.map(|half| (half, j)));
                }
                (_, Some(halves)) => waiting.extend(halves.map(|half| (i, half))),
                (None, None) => {
                    let [mut own, mut theirs] = [[([0.0; 3], 0.0); LEAF]; 2];
                    let own = self.place(a, pose, &mut own);
                    let theirs = other.place(b, other_pose, &mut theirs);
                    steps += own.len() * theirs.len();
                    if own.iter().any(|one| theirs.iter().any(|other| touch(*one, *other))) {
                        return (true, steps);
                    }
                }
            }
        }
        (false, steps)
    }
}
