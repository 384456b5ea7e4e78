//! Hulls, smallest boxes and spheres, and distances.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use serde::Deserialize;
use urdd_format::pose::Pose;
use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_geometry::convex::{ConvexShape, OrientedBox, Shape, Sphere, TOLERANCE, distance};
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::oriented_box;

use super::{assert_near, vectors};

#[derive(Deserialize)]
struct Hulls {
    hulls: Vec<Hull>,
}

#[derive(Deserialize)]
struct Hull {
    name: String,
    points: Vec<[f64; 3]>,
    corners: Vec<usize>,
    volume: f64,
}

#[test]
fn hulls() {
    let hulls: Hulls = vectors("hulls.json");
    assert!(hulls.hulls.len() > 5);
    for case in hulls.hulls {
        let hull = ConvexHull::new(&case.points).unwrap();
        let mut corners: Vec<[f64; 3]> = case.corners.iter().map(|i| case.points[*i]).collect();
        corners.sort_by(|a, b| a.partial_cmp(b).unwrap());
        assert_eq!(hull.mesh().vertices, corners, "{}", case.name);
        let volume = hull.mesh().signed_volume();
        assert_near(&[volume / case.volume], &[1.0], 1e-12, &case.name);
    }
}

#[derive(Deserialize)]
struct Bodies {
    bodies: Vec<Body>,
}

#[derive(Deserialize)]
struct Body {
    name: String,
    points: Vec<[f64; 3]>,
    smallest_box: SmallestBox,
    smallest_sphere: SmallestSphere,
}

#[derive(Deserialize)]
struct SmallestBox {
    volume: f64,
    from: String,
}

#[derive(Deserialize)]
struct SmallestSphere {
    centre: [f64; 3],
    radius: f64,
}

#[test]
fn smallest_boxes_and_spheres() {
    let bodies: Bodies = vectors("boxes_and_spheres.json");
    assert!(bodies.bodies.len() > 5);
    for case in bodies.bodies {
        let hull = ConvexHull::new(&case.points).unwrap();
        let found = oriented_box::OrientedBox::around(&hull).volume() / case.smallest_box.volume;
        // The search for boxes may stop at 1e-6 above the minimum. Ours may beat boxes that were found by search.
        assert!(found < 1.0 + 2e-6, "{}: box {found} times as large", case.name);
        let least = if case.smallest_box.from == "closed form" { 1e-12 } else { 1e-3 };
        assert!(found > 1.0 - least, "{}: box {found} times as large", case.name);
        let sphere = BoundingSphere::around(&hull);
        let SmallestSphere { centre, radius } = case.smallest_sphere;
        assert_near(&[sphere.radius], &[radius], 1e-12 * radius, &case.name);
        assert_near(&sphere.centre, &centre, 1e-7 * radius, &case.name);
    }
}

#[derive(Deserialize)]
struct Distances {
    spheres: Vec<Pair<Ball>>,
    boxes: Vec<Pair<Cuboid>>,
    hulls: Vec<Pair<Points>>,
}

#[derive(Deserialize)]
struct Pair<T> {
    name: String,
    a: T,
    b: T,
    b_in_a: Pose,
    distance: f64,
}

#[derive(Deserialize)]
struct Ball {
    centre: [f64; 3],
    radius: f64,
}

#[derive(Deserialize)]
struct Cuboid {
    half_extents: [f64; 3],
}

#[derive(Deserialize)]
struct Points {
    points: Vec<[f64; 3]>,
}

fn isometry(pose: &Pose) -> Isometry3<f64> {
    let [w, x, y, z] = pose.quaternion_wxyz;
    Isometry3::from_parts(
        Translation3::from(pose.position),
        UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)),
    )
}

fn compare<T, S: Shape>(pairs: &[Pair<T>], shape: impl Fn(&T) -> S) {
    assert!(pairs.len() > 4);
    for pair in pairs {
        let (a, b) = (shape(&pair.a), shape(&pair.b));
        let pose = isometry(&pair.b_in_a);
        for (found, way) in
            [(distance(&a, &b, &pose), "a to b"), (distance(&b, &a, &pose.inverse()), "b to a")]
        {
            let place = format!("{}, {way}", pair.name);
            assert_near(&[found], &[pair.distance], TOLERANCE, &place);
        }
    }
}

#[test]
fn distances() {
    let distances: Distances = vectors("distances.json");
    compare(&distances.spheres, |ball| {
        Sphere::new(Vector3::from(ball.centre), ball.radius).unwrap()
    });
    compare(&distances.boxes, |cuboid| {
        OrientedBox::new(Isometry3::identity(), cuboid.half_extents).unwrap()
    });
    compare(&distances.hulls, |points| ConvexShape::of_points(&points.points).unwrap());
    // Boxes as hulls, which is another way to their distance.
    compare(&distances.boxes, |cuboid| {
        let [x, y, z] = cuboid.half_extents;
        let corners = (0..8).map(|i| {
            let sign = |bit: usize| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
            [x * sign(0), y * sign(1), z * sign(2)]
        });
        ConvexShape::of_points(&corners.collect::<Vec<_>>()).unwrap()
    });
}
