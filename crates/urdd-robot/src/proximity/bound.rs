//! Lower bounds of distances, by spheres.

use super::{Placed, Proximity, dot, to_root};

impl Proximity {
    /// Places the centre of the sphere about each shape.
    pub(crate) fn place_centres(&self, placed: &mut Placed) {
        placed.centres.clear();
        let centre = |shape: &super::Shape| to_root(&placed.links[shape.link], shape.sphere.centre);
        placed.centres.extend(self.shapes.iter().map(centre));
    }

    /// No less than this are the shapes of a pair apart, metres; not positive where they may touch.
    pub(super) fn bound(&self, placed: &Placed, pair: usize) -> f64 {
        let [a, b] = self.pairs[pair].shapes;
        let (p, q) = (placed.centres[a], placed.centres[b]);
        let between = [0, 1, 2].map(|k| q[k] - p[k]);
        dot(between, between).sqrt() - self.shapes[a].sphere.radius - self.shapes[b].sphere.radius
    }

    /// Whether the spheres about all shapes of two links are apart.
    pub(super) fn are_apart(&self, placed: &Placed, links: [usize; 2]) -> bool {
        let [Some(a), Some(b)] = links.map(|link| self.spheres[link]) else {
            return true;
        };
        let p = to_root(&placed.links[links[0]], a.centre);
        let q = to_root(&placed.links[links[1]], b.centre);
        let between = [0, 1, 2].map(|k| q[k] - p[k]);
        let reach = a.radius + b.radius;
        dot(between, between) > reach * reach * (1.0 + 1e-12)
    }
}
