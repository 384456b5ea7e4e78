//! Parts of obstacles at their poses, and which shapes of a robot are tested against them.

use nalgebra::{Isometry3, UnitQuaternion};

use super::obstacle::Part;
use super::proximity::{Shape, to_root};
use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_geometry::convex::across::columns;
use urdd_geometry::vector::{dot, norm, sub};

/// A part of an obstacle, at its pose.
#[derive(Debug, Clone)]
pub(super) struct PlacedPart {
    pub obstacle: usize,
    pub part: Part,
    /// The columns of the rotation of the obstacle's frame, then its translation.
    pub frame: [[f64; 3]; 4],
    /// Whether that is a rotation.
    is_turned: bool,
    /// More than what is rounded in its frame, m.
    pub rounding: f64,
    /// Around the part, in the root link's frame.
    sphere: BoundingSphere,
}

impl PlacedPart {
    pub fn new(obstacle: usize, part: Part, pose: &Isometry3<f64>) -> Self {
        let (frame, is_turned, rounding, sphere) = ([[0.0; 3]; 4], false, 0.0, part.sphere);
        let mut placed = PlacedPart { obstacle, part, frame, is_turned, rounding, sphere };
        placed.place(pose);
        placed
    }

    pub fn place(&mut self, pose: &Isometry3<f64>) {
        self.frame = columns(pose);
        self.is_turned = pose.rotation != UnitQuaternion::identity();
        self.rounding = 1e-12 * norm(self.frame[3]);
        let BoundingSphere { centre, radius } = self.part.sphere;
        let centre = to_root(&self.frame, centre);
        self.sphere = BoundingSphere { centre, radius: radius + self.rounding };
    }

    /// A point of the root link's frame in its frame.
    pub fn local(&self, point: [f64; 3]) -> [f64; 3] {
        let from = sub(point, self.frame[3]);
        match self.is_turned {
            true => [0, 1, 2].map(|k| dot(self.frame[k], from)),
            false => from,
        }
    }

    /// A lower bound of the distance from a sphere, m; not positive if they may touch.
    pub fn bound(&self, centre: [f64; 3], radius: f64) -> f64 {
        let centre = self.local(centre);
        self.part.bound(&BoundingSphere { centre, radius: radius + self.rounding })
    }

    /// Whether it is certainly farther from a sphere than `distance`, m.
    pub fn is_beyond(&self, centre: [f64; 3], radius: f64, distance: f64) -> bool {
        let from = sub(centre, self.sphere.centre);
        let reach = radius + self.sphere.radius + distance;
        dot(from, from) * (1.0 - 1e-12) > reach * reach || self.bound(centre, radius) > distance
    }
}

/// The pairs of the shapes of one link, or of an attached object, and one part of an obstacle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Group {
    pub link: u32,
    pub part: u32,
    /// The first pair, how many there are, and how far it is from one to the next.
    first: usize,
    count: u32,
    step: u32,
}

impl Group {
    /// The places of its pairs.
    pub fn pairs(self) -> impl Iterator<Item = usize> {
        (0..self.count as usize).map(move |k| self.first + k * self.step as usize)
    }
}

/// The shapes and the parts that are tested against each other.
#[derive(Debug)]
pub(super) struct Tested {
    /// By shape, then by part.
    pub pairs: Vec<[u32; 2]>,
    /// The same pairs in groups.
    pub groups: Vec<Group>,
}

impl Tested {
    /// `ignored` has for each obstacle the bodies that may touch it.
    pub fn new(shapes: &[Shape], parts: &[PlacedPart], ignored: &[Vec<usize>]) -> Self {
        let mut pairs = Vec::with_capacity(shapes.len().saturating_mul(parts.len()));
        let (mut groups, mut begin) = (Vec::new(), 0);
        for own in shapes.chunk_by(|a, b| (a.link, a.owner) == (b.link, b.owner)) {
            let Shape { link, owner, .. } = own[0];
            let others = parts.iter().enumerate();
            let others = others.filter(|(_, part)| !ignored[part.obstacle].contains(&owner));
            let others: Vec<u32> = others.map(|(part, _)| part as u32).collect();
            let (begins, count) = (pairs.len(), own.len());
            groups.extend(others.iter().enumerate().map(|(place, part)| Group {
                link: link as u32,
                part: *part,
                first: begins + place,
                count: count as u32,
                step: others.len() as u32,
            }));
            for shape in begin..begin + count {
                pairs.extend(others.iter().map(|part| [shape as u32, *part]));
            }
            begin += count;
        }
        Tested { pairs, groups }
    }
}
