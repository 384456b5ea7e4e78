//! Shapes prepared for distance queries, and pairs of them (of robots, obstacles, attached objects) that are swept by spheres.

use std::sync::Arc;

use arrayvec::ArrayVec;

use crate::kept::Solid;
use urdd_geometry::bounding_sphere::{BoundingSphere, about, about_spheres};
use urdd_geometry::convex::across::{self, AT_ONCE, PlacedPair};
use urdd_geometry::convex::{ConvexShape, Level, Penetration, ShapeError, Witness, penetration};
use urdd_geometry::oriented_box::corners;
use urdd_geometry::vector::{dot, norm, sub};

/// A shape prepared for distance queries, with its bounding sphere.
#[derive(Debug, Clone)]
pub(crate) struct Shape {
    pub link: usize,
    /// Whose it is: the link, or, from the number of links on, an attached object.
    pub owner: usize,
    pub piece: usize,
    /// A hull, a piece, the corners of a box, or the centre of a ball. Shared with those who attach objects.
    pub core: Arc<ConvexShape>,
    /// The shape is all points that are at most this far from `core`, m.
    pub radius: f64,
    pub sphere: BoundingSphere,
    /// Whether its bounding sphere is the shape itself.
    pub is_ball: bool,
}

impl Shape {
    /// A shape of a link.
    pub fn of(link: usize, piece: usize, solid: &Solid) -> Result<Self, ShapeError> {
        let shape = |core, sphere: BoundingSphere, is_ball| Shape {
            link,
            owner: link,
            piece,
            core: Arc::new(core),
            radius: if is_ball { sphere.radius } else { 0.0 },
            sphere,
            is_ball,
        };
        let of_points = |points: &[[f64; 3]]| {
            let core = ConvexShape::of_points(points)?;
            let sphere = about(core.centre(), points);
            Ok(shape(core, sphere, false))
        };
        match solid {
            Solid::Mesh(mesh) => of_points(&mesh.vertices),
            Solid::Box { pose, half_extents } => {
                let placed = |p: [f64; 3]| (pose * nalgebra::Point3::from(p)).coords.into();
                of_points(&corners(*half_extents).map(placed))
            }
            Solid::Sphere { centre, radius } => {
                let (centre, radius) = (*centre, *radius);
                // The same limits as for points.
                ConvexShape::of_points(&[centre, centre.map(|x| x + radius)])?;
                let core = ConvexShape::of_points(&[centre])?;
                Ok(shape(core, BoundingSphere { centre, radius }, true))
            }
        }
    }
}

/// A bounding sphere of all shapes of a link; `None` if it has none.
pub(super) fn about_link(shapes: &[Shape], link: usize) -> Option<BoundingSphere> {
    let own = shapes.iter().filter(|shape| shape.link == link);
    about_spheres(own.map(|shape| &shape.sphere))
}

/// Transforms a point from a link's frame to the root link's frame.
pub(crate) fn to_root(link: &[[f64; 3]; 4], p: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| link[0][k] * p[0] + link[1][k] * p[1] + link[2][k] * p[2] + link[3][k])
}

/// The pose of frame `b` in frame `a`, both in the root link's frame.
pub(crate) fn relative(a: &[[f64; 3]; 4], b: &[[f64; 3]; 4]) -> [[f64; 3]; 4] {
    let back = |v: [f64; 3]| [0, 1, 2].map(|k| dot(a[k], v));
    [back(b[0]), back(b[1]), back(b[2]), back(sub(b[3], a[3]))]
}

/// Two placed shapes.
#[derive(Clone, Copy)]
pub struct SweptPair<'a> {
    pub cores: PlacedPair<'a>,
    /// The shapes are all points that are at most this far from their cores, m.
    pub radii: [f64; 2],
}

/// The distances of some pairs, at most [`AT_ONCE`], m, and their closest points in the frame of the first shape.
pub(crate) fn witnesses(
    level: Level,
    pairs: &[SweptPair],
) -> ArrayVec<(f64, [[f64; 3]; 2]), AT_ONCE> {
    let cores: ArrayVec<PlacedPair, AT_ONCE> = pairs.iter().map(|pair| pair.cores).collect();
    let found = across::some_witnesses(level, &cores);
    let each = found.iter().zip(pairs);
    each.map(|(witness, pair)| rounded(witness, pair.radii)).collect()
}

/// How far two shapes overlap, in the frame of the first; `None` if they are apart.
pub(crate) fn penetration_of(level: Level, pair: &SweptPair) -> Option<Penetration> {
    let [a, b] = pair.radii;
    let (depth, direction, [p, q]) = match penetration(&pair.cores) {
        Some(found) => (found.depth + a + b, found.direction, found.points),
        None if a + b == 0.0 => return None,
        None => {
            // The cores are apart.
            let [Witness { points, .. }] = across::witnesses(level, &[pair.cores])[..] else {
                return None;
            };
            let between = sub(points[1], points[0]);
            let length = norm(between);
            if !(length > 0.0 && length <= a + b) {
                return None;
            }
            (a + b - length, between.map(|x| x / length), points)
        }
    };
    let along = |point: [f64; 3], by: f64| [0, 1, 2].map(|k| point[k] + by * direction[k]);
    Some(Penetration { depth, direction, points: [along(p, a), along(q, -b)] })
}

/// The distance and closest points of two shapes enlarged by radii.
fn rounded(witness: &Witness, [a, b]: [f64; 2]) -> (f64, [[f64; 3]; 2]) {
    let [p, q] = witness.points;
    let between = sub(q, p);
    let length = norm(between);
    let distance = (witness.distance - (a + b)).max(0.0);
    if length == 0.0 {
        return (distance, [p, q]);
    }
    // Positions along the line from p to q. If the bodies overlap, the middle of their common segment.
    let along = match distance > 0.0 {
        true => [a, length - b],
        false => [0.5 * ((length - b).max(0.0) + a.min(length)); 2],
    };
    let points = along.map(|t| [0, 1, 2].map(|k| p[k] + between[k] * (t / length)));
    (distance, points)
}

/// Pairs that may touch, which wait for others: as many as possible are computed at once.
pub(crate) struct Waiting<'a> {
    level: Level,
    /// Without radii: whether they touch is known sooner than their distance.
    flat: ArrayVec<PlacedPair<'a>, AT_ONCE>,
    swept: ArrayVec<PlacedPair<'a>, AT_ONCE>,
    /// The sums of the radii of `swept`.
    radii: ArrayVec<f64, AT_ONCE>,
}

impl<'a> Waiting<'a> {
    pub fn new(level: Level) -> Self {
        Waiting { level, flat: ArrayVec::new(), swept: ArrayVec::new(), radii: ArrayVec::new() }
    }

    /// Adds a pair, whose radii have this sum. True if one of those that waited touches.
    pub fn touches_with(&mut self, cores: PlacedPair<'a>, radii: f64) -> bool {
        if cores.boxes_are_beyond(radii) {
            return false;
        }
        let is_full = if radii == 0.0 {
            self.flat.push(cores);
            self.flat.is_full()
        } else {
            self.swept.push(cores);
            self.radii.push(radii);
            self.swept.is_full()
        };
        is_full && self.any_touches()
    }

    /// Whether one of those that wait touches. None waits any longer.
    pub fn any_touches(&mut self) -> bool {
        let mut values = [f64::INFINITY; AT_ONCE];
        across::distances(self.level, &self.swept, &mut values[..self.swept.len()]);
        let mut swept = values.iter().zip(&self.radii);
        let touches = swept.any(|(value, radii)| value <= radii)
            || across::any_touches(self.level, &self.flat);
        self.swept.clear();
        self.radii.clear();
        self.flat.clear();
        touches
    }
}

/// The distance of a pair, and how it changes with the configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient<P> {
    /// The pair, its distance and its closest points.
    pub pair: P,
    /// The derivative of the distance for each DOF, m/rad or m/m. `None` if the shapes touch or overlap, where the
    /// distance is 0 and has no gradient.
    ///
    /// It is that of the closest points as they are: n (J_b - J_a), with the unit vector n from the first point to the
    /// second, and the Jacobians of the two points. Where other points are as close (parallel faces, edges), the
    /// distance is not differentiable, and this is one of its directional derivatives.
    pub gradient: Option<Vec<f64>>,
}

/// Two shapes that touch or overlap.
#[derive(Debug, Clone, PartialEq)]
pub struct Overlap<P> {
    /// The pair. Its distance is 0; its points are those that touch once the second shape has moved, before it moves.
    pub pair: P,
    /// The length of the least translation that separates the two, m; 0 if they touch.
    pub depth: f64,
    /// The unit vector, in the root link's frame, along which the second shape would move.
    pub direction: [f64; 3],
    /// The derivative of the depth for each DOF, m/rad or m/m, of the two points as they are. Where another translation is
    /// as short, the depth is not differentiable, and this is one of its directional derivatives.
    pub gradient: Vec<f64>,
}

/// The direction and the points of a penetration in the root link's frame, from the frame of a link.
pub(crate) fn in_root(link: &[[f64; 3]; 4], found: &Penetration) -> ([f64; 3], [[f64; 3]; 2]) {
    let turned = [link[0], link[1], link[2], [0.0; 3]];
    let points = found.points.map(|p| to_root(link, p));
    (to_root(&turned, found.direction), points)
}

/// The unit vector from the first of two closest points to the second; `None` if the shapes touch or overlap.
pub(crate) fn toward(points: &[[f64; 3]; 2], distance: f64) -> Option<[f64; 3]> {
    let between = sub(points[1], points[0]);
    let length = norm(between);
    (distance > 0.0).then(|| between.map(|x| x / length))
}
