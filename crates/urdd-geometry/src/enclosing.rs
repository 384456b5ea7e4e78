//! Primitives that enclose a convex body.

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};

use super::bounding_sphere::BoundingSphere;
use super::convex::{ConvexShape, distance};
use super::hull::ConvexHull;
use super::oriented_box::OrientedBox;
use super::primitives::{Primitive, Prism};
use super::vector::{dot, norm, normal, sub};

/// A primitive around a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Enclosing {
    /// The pose of its centre and axes.
    pub pose: Isometry3<f64>,
    /// Its shape and sizes.
    pub primitive: Primitive,
}

impl Enclosing {
    /// A box, a sphere, and three cylinders and three capsules along the axes of the smallest box. Every vertex of the hull
    /// is inside each, up to rounding.
    pub fn around(hull: &ConvexHull) -> [Self; 8] {
        let of = OrientedBox::around(hull);
        let centre = Translation3::from(of.centre);
        let cuboid = Enclosing {
            pose: Isometry3::from_parts(centre, of.rotation),
            primitive: Primitive::Box(of.half_extents),
        };
        let sphere = BoundingSphere::around(hull);
        let sphere = Enclosing {
            pose: Isometry3::from(Translation3::from(sphere.centre)),
            primitive: Primitive::Sphere { radius: sphere.radius },
        };
        let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| {
            // Half a turn never happens: the axes are those of the box.
            let turn = UnitQuaternion::rotation_between(&Vector3::z(), &axis).unwrap_or_default();
            long(&hull.mesh().vertices, Isometry3::from_parts(centre, of.rotation * turn))
        });
        [cuboid, sphere, x[0], y[0], z[0], x[1], y[1], z[1]]
    }

    /// The greatest distance of a point of the primitive from the body, m. For a cylinder it is up to 0.13 % of the radius
    /// too large. `None` if the hull is too large or too thin to measure it.
    pub fn standoff(&self, hull: &ConvexHull) -> Option<f64> {
        let body = ConvexShape::new(hull.mesh()).ok()?;
        // The body is convex, so the farthest points are corners, or a radius beyond the ends of an axis.
        let (points, radius) = self.primitive.core(Prism::Around);
        let mut most = 0.0_f64;
        for point in points {
            let point = (self.pose * Point3::from(point)).into();
            let own = ConvexShape::of_points(&[point]).ok()?;
            let away = distance(&body, &own, &Isometry3::identity());
            let away = if away > 0.0 || radius == 0.0 { away } else { -depth(hull, point) };
            most = most.max(radius + away);
        }
        Some(most)
    }
}

/// A cylinder and a capsule along z of a frame. The capsule has the radius of the cylinder, and the shortest axis.
fn long(points: &[[f64; 3]], frame: Isometry3<f64>) -> [Enclosing; 2] {
    let own = |point: &[f64; 3]| frame.inverse_transform_point(&Point3::from(*point));
    let points: Vec<Point3<f64>> = points.iter().map(own).collect();
    let flat: Vec<[f64; 3]> = points.iter().map(|point| [point.x, point.y, 0.0]).collect();
    let BoundingSphere { centre: [x, y, _], radius } = BoundingSphere::of_points(&flat);
    let bound = |of: &dyn Fn(&Point3<f64>) -> [f64; 2]| {
        let wider = |[low, high]: [f64; 2], [a, b]: [f64; 2]| [low.min(a), high.max(b)];
        points.iter().map(of).fold([f64::INFINITY, f64::NEG_INFINITY], wider)
    };
    let placed = |[low, high]: [f64; 2]| frame * Translation3::new(x, y, f64::midpoint(low, high));
    let ends = bound(&|point| [point.z, point.z]);
    let half = 0.5 * (ends[1] - ends[0]);
    let cylinder =
        Enclosing { pose: placed(ends), primitive: Primitive::Cylinder { radius, half } };
    // A point is inside if a point of the axis is at most this far along z.
    let reach = |point: &Point3<f64>| {
        let away = (point.x - x).hypot(point.y - y);
        (radius * radius - away * away).max(0.0).sqrt()
    };
    let ends = bound(&|point| [point.z + reach(point), point.z - reach(point)]);
    let half = (0.5 * (ends[1] - ends[0])).max(0.0);
    let capsule = Enclosing { pose: placed(ends), primitive: Primitive::Capsule { radius, half } };
    [cylinder, capsule]
}

/// How far a point within a hull is from its faces, m.
fn depth(hull: &ConvexHull, point: [f64; 3]) -> f64 {
    let mesh = hull.mesh();
    let gaps = mesh.triangles.iter().map(|triangle| {
        let corners = mesh.corners(*triangle);
        let normal = normal(corners);
        dot(normal, sub(corners[0], point)) / norm(normal)
    });
    gaps.fold(f64::INFINITY, f64::min).max(0.0)
}

#[cfg(test)]
#[path = "tests/enclosing.rs"]
mod tests;
