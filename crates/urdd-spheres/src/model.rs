//! Spheres of links, those that a person gave, and their placement in sampled configurations.

use std::collections::HashMap;
use std::sync::OnceLock;

use crate::frame::{Point, Pose, dot, norm, sub};
use crate::samples::Sample;
use crate::tree::{SphereTree, around};

pub use crate::tree::distance;
pub use urdd_geometry::bounding_sphere::BoundingSphere as Sphere;

/// The spheres of each link that has shapes.
pub type Spheres = Vec<Vec<Sphere>>;

pub fn count(spheres: &Spheres) -> usize {
    spheres.iter().map(Vec::len).sum()
}

/// Spheres, with bounding spheres for fast rejection of distant pairs.
pub struct Placeable<'a> {
    spheres: &'a Spheres,
    about: Vec<Option<Sphere>>,
    trees: Vec<OnceLock<SphereTree<'a>>>,
}

/// The spheres placed in one configuration. Reusable for the next configuration.
#[derive(Default)]
pub struct Placed {
    about: Vec<Option<Point>>,
    centres: Vec<Vec<Point>>,
}

impl<'a> Placeable<'a> {
    pub fn new(spheres: &'a Spheres) -> Self {
        let about = spheres.iter().map(|own| around(own.iter())).collect();
        Placeable { spheres, about, trees: spheres.iter().map(|_| OnceLock::new()).collect() }
    }

    /// Places the links' bounding spheres. The spheres themselves are placed on demand.
    pub fn place(&self, sample: &Sample, placed: &mut Placed) {
        let centre = |(about, pose): (&Option<Sphere>, &Pose)| Some(pose.place((*about)?.centre));
        placed.about.clear();
        placed.about.extend(self.about.iter().zip(&sample.poses).map(centre));
        placed.centres.resize(self.spheres.len(), Vec::new());
        placed.centres.iter_mut().for_each(Vec::clear);
    }

    /// Whether the distance of two links' spheres may be `limit` or less.
    pub fn may_be_near(&self, placed: &Placed, [a, b]: [usize; 2], limit: f64) -> bool {
        let centres = placed.about[a].zip(placed.about[b]);
        let spheres = self.about[a].zip(self.about[b]);
        let Some(((p, q), (a, b))) = centres.zip(spheres) else { return false };
        let between = sub(p, q);
        let reach = a.radius + b.radius + limit;
        reach > 0.0 && dot(between, between) <= reach * reach
    }

    /// Whether spheres of two links touch; and how many pairs of spheres were looked at.
    pub fn touches(&self, sample: &Sample, placed: &Placed, links: [usize; 2]) -> (bool, usize) {
        if !self.may_be_near(placed, links, 0.0) {
            return (false, 0);
        }
        let tree =
            |link: usize| self.trees[link].get_or_init(|| SphereTree::new(&self.spheres[link]));
        let ([a, b], [p, q]) = (links.map(tree), links.map(|link| &sample.poses[link]));
        a.touches(p, b, q)
    }

    /// The minimum distance of two links' spheres, negative if they overlap; at most `limit`.
    pub fn gap(&self, sample: &Sample, placed: &mut Placed, links: [usize; 2], limit: f64) -> f64 {
        let mut least = limit;
        self.near(sample, placed, links, limit, |gap, _| {
            least = gap;
            gap
        });
        least
    }

    /// Finds spheres of two links that are nearer than `limit`, with their distance and their indices in their links.
    /// The return value of `found` is the new limit.
    pub fn near(
        &self,
        sample: &Sample,
        placed: &mut Placed,
        [a, b]: [usize; 2],
        mut limit: f64,
        mut found: impl FnMut(f64, [usize; 2]) -> f64,
    ) {
        for link in [a, b] {
            if placed.centres[link].is_empty() {
                let own = self.spheres[link].iter();
                placed.centres[link].extend(own.map(|s| sample.poses[link].place(s.centre)));
            }
        }
        let Some((about, of_all)) = placed.about[b].zip(self.about[b]) else { return };
        for (i, (p, of_a)) in placed.centres[a].iter().zip(&self.spheres[a]).enumerate() {
            if !is_nearer(*p, about, of_a.radius + of_all.radius + limit) {
                continue;
            }
            for (j, (q, of_b)) in placed.centres[b].iter().zip(&self.spheres[b]).enumerate() {
                let reach = of_a.radius + of_b.radius;
                if is_nearer(*p, *q, reach + limit) {
                    limit = found(norm(sub(*p, *q)) - reach, [i, j]);
                }
            }
        }
    }
}

#[inline]
fn is_nearer(p: Point, q: Point, than: f64) -> bool {
    let between = sub(p, q);
    than > 0.0 && dot(between, between) < than * than
}

/// Shrinks the spheres of pairs of links that are nearer than `apart` in a sample, so that they are that far apart.
pub fn part(spheres: &mut Spheres, pairs: &[[usize; 2]], sample: &Sample, apart: f64) {
    for [a, b] in pairs.iter().copied() {
        for i in 0..spheres[a].len() {
            for j in 0..spheres[b].len() {
                let (of_a, of_b) = (spheres[a][i], spheres[b][j]);
                let p = sample.poses[a].place(of_a.centre);
                let q = sample.poses[b].place(of_b.centre);
                let excess = of_a.radius + of_b.radius + apart - norm(sub(p, q));
                // Each sphere shrinks by half of the shortfall, but keeps at least half of its radius.
                if excess > 0.0 {
                    spheres[a][i].radius = (of_a.radius - 0.5 * excess).max(0.5 * of_a.radius);
                    spheres[b][j].radius = (of_b.radius - 0.5 * excess).max(0.5 * of_b.radius);
                }
            }
        }
    }
}

/// The spheres of some links, each in its link's frame, in metres.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SphereList {
    /// Links by name, each with its spheres.
    pub links: Vec<(String, Vec<Sphere>)>,
    /// What of the list was left out, each with the reason.
    pub left_out: Vec<String>,
}

impl SphereList {
    /// For each link of a robot, its spheres. A link that stands twice has those of both.
    pub fn by_link<T: AsRef<str>>(&self, names: &[T]) -> Vec<Vec<Sphere>> {
        let mut found = vec![Vec::new(); names.len()];
        let places = names.iter().enumerate().rev().map(|(place, name)| (name.as_ref(), place));
        let places: HashMap<&str, usize> = places.collect();
        for (name, spheres) in &self.links {
            if let Some(link) = places.get(name.as_str()) {
                found[*link].extend(spheres.iter().copied());
            }
        }
        found
    }

    /// How many spheres there are.
    pub fn count(&self) -> usize {
        self.links.iter().map(|(_, spheres)| spheres.len()).sum()
    }
}
