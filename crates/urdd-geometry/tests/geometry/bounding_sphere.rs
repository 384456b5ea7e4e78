//! Bounding spheres and farthest points: closed forms, optimality, and properties.

use crate::solids::*;
use nalgebra::Vector3;
use proptest::prelude::*;
use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_geometry::mesh::Mesh;
use urdd_geometry::{farthest, hull::ConvexHull};

/// The radius that a sphere around `centre` needs.
fn reach(points: &[Point], centre: Vector3<f64>) -> f64 {
    points.iter().map(|p| (Vector3::from(*p) - centre).norm()).fold(0.0, f64::max)
}

/// The sphere around points, after checking that it contains them and is the smallest: the radius is a convex function
/// of the centre, so it is minimal if it is not smaller nearby.
fn sphere_of(points: &[Point]) -> BoundingSphere {
    let hull = ConvexHull::new(points).expect("a hull");
    let sphere = BoundingSphere::around(&hull);
    let centre = Vector3::from(sphere.centre);
    assert!(reach(&hull.mesh().vertices, centre) <= sphere.radius);
    assert!(reach(points, centre) <= sphere.radius * (1.0 + 2.0 * ConvexHull::THINNEST));
    let mut random = Random(11);
    for step in [1e-1, 1e-3, 1e-5] {
        for _ in 0..100 {
            let aside = centre + Vector3::from(random.point()) * step * sphere.radius;
            assert!(
                reach(points, aside) >= sphere.radius * (1.0 - 1e-9),
                "smaller by {step} aside"
            );
        }
    }
    sphere
}

#[test]
fn two_three_or_four_points_carry_it() {
    // A segment: the third point is inside.
    let two = sphere_of(&[[-2.0, 0.0, 1.0], [2.0, 0.0, 1.0], [0.0, 1.0, 1.0]]);
    assert_eq!((two.centre, two.radius), ([0.0, 0.0, 1.0], 2.0));
    // A triangle of edge 2: its circumcircle.
    let height = 3f64.sqrt();
    let three = sphere_of(&[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, height, 0.0]]);
    assert_near(three.radius, 2.0 / height, 1e-15);
    assert_near(three.centre[1], 1.0 / height, 1e-15);
    // An obtuse one: its longest edge.
    let obtuse = sphere_of(&[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.1, 0.0]]);
    assert_eq!(obtuse.radius, 1.0);
    // Every other corner of a cube of edge 2.
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let four = sphere_of(&corners);
    assert_near(four.radius, height, 1e-15);
    assert!(Vector3::from(four.centre).norm() < 1e-15);
}

#[test]
fn many_points_on_one_sphere() {
    let cube = sphere_of(&box_corners([2.0, 4.0, 4.0]));
    assert_eq!((cube.centre, cube.radius), ([0.0; 3], 3.0));
    let cylinder = sphere_of(&placed(&prism(500, 0.3, 0.8), [0.5, 0.6, 0.7], [1.0, 2.0, 3.0]));
    assert_near(cylinder.radius, 0.5, 1e-6);
    // Points all over the unit sphere, and others inside.
    let mut random = Random(3);
    let mut points = Vec::new();
    for i in 0..2000 {
        let direction = Vector3::from(random.point()).normalize();
        let radius = if i % 4 == 0 { 1.0 } else { random.unit() };
        points.push(single((direction * radius + Vector3::new(5.0, 6.0, 7.0)).into()));
    }
    let ball = sphere_of(&points);
    assert_near(ball.radius, 1.0, 1e-6);
    assert!((Vector3::from(ball.centre) - Vector3::new(5.0, 6.0, 7.0)).norm() < 1e-6);
}

#[test]
fn size_does_not_matter() {
    let mut random = Random(4);
    let points: Vec<Point> = (0..50).map(|_| single(random.point())).collect();
    let reference = sphere_of(&points);
    for exponent in [-120, -40, 40, 120] {
        let scale = 2f64.powi(exponent);
        let scaled: Vec<Point> = points.iter().map(|p| p.map(|x| x * scale)).collect();
        let sphere = sphere_of(&scaled);
        assert_eq!(sphere.radius / scale, reference.radius);
        assert_eq!(sphere.centre.map(|x| x / scale), reference.centre);
    }
}

#[test]
fn farthest_points() {
    let vertices = vec![[1.0, 2.0, 2.0], [0.0, -4.0, 3.0], [0.0; 3]];
    assert_eq!(farthest::of_mesh(&Mesh { vertices, triangles: vec![] }), 5.0);
    assert_eq!(farthest::of_mesh(&Mesh::default()), 0.0);
    let sphere = BoundingSphere { centre: [2.0, 3.0, -6.0], radius: 0.5 };
    assert_eq!(farthest::of_sphere(&sphere), 7.5);
}

proptest! {
    #[test]
    fn clouds(
        seed: u64,
        count in 4usize..200,
        stretch in prop::array::uniform3(-4i32..1),
        rpy in prop::array::uniform3(-3.0..3.0),
        xyz in prop::array::uniform3(-3.0..3.0),
    ) {
        let mut random = Random(seed);
        let mut point = |_| {
            let p = random.point();
            [0, 1, 2].map(|k| p[k] * 10f64.powi(stretch[k]))
        };
        let points: Vec<Point> = (0..count).map(&mut point).collect();
        let mut points = placed(&points, rpy, xyz);
        let sphere = sphere_of(&points);
        random.shuffle(&mut points);
        prop_assert_eq!(sphere_of(&points), sphere);
    }

    /// Points of a small lattice: many on one sphere, in one plane, on one line.
    #[test]
    fn lattices(lattice in prop::collection::vec(prop::array::uniform3(-2i32..3), 3..40)) {
        let points: Vec<Point> = lattice.iter().map(|p| p.map(f64::from)).collect();
        if ConvexHull::new(&points).is_ok() {
            sphere_of(&points);
        }
    }
}
