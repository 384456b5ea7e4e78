//! Lower bounds of distances from bounding spheres.

use super::vector::to_root;
use super::{Placed, Proximity};
use urdd_geometry::vector::{dot, norm, sub};

impl Proximity {
    /// A lower bound of the distance of a pair of shapes, in metres; not positive if they may touch.
    pub(super) fn bound(&self, placed: &Placed, pair: usize) -> f64 {
        let [a, b] = self.pairs[pair].shapes;
        let apart = norm(sub(placed.centres[b], placed.centres[a]));
        apart - self.shapes[a].sphere.radius - self.shapes[b].sphere.radius
    }

    /// Whether the bounding spheres of two links are disjoint. True if a link has no shapes.
    pub(super) fn are_apart(&self, placed: &Placed, links: [usize; 2]) -> bool {
        let [Some(a), Some(b)] = links.map(|link| self.spheres[link]) else {
            return true;
        };
        let p = to_root(&placed.links[links[0]], a.centre);
        let q = to_root(&placed.links[links[1]], b.centre);
        let between = sub(q, p);
        let reach = a.radius + b.radius;
        dot(between, between) > reach * reach * (1.0 + 1e-12)
    }
}
