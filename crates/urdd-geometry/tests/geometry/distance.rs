//! Distances of convex shapes, compared with closed forms and with brute force.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use urdd_geometry::convex::{ConvexShape, OrientedBox, ShapeError, Sphere, TOLERANCE, distance};
use urdd_geometry::mesh::Mesh;

use crate::brute_force;
use crate::dice::trials;

fn hull(points: &[[f64; 3]]) -> ConvexShape {
    ConvexShape::of_points(points).expect("a shape")
}

/// The corners of a box about the origin.
fn corners([x, y, z]: [f64; 3]) -> Vec<[f64; 3]> {
    let sign = |k: usize, bit: usize, v: f64| if k >> bit & 1 == 0 { -v } else { v };
    (0..8).map(|k| [sign(k, 0, x), sign(k, 1, y), sign(k, 2, z)]).collect()
}

fn turn(roll: f64, pitch: f64, yaw: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_euler_angles(roll, pitch, yaw)
}

#[track_caller]
fn near(found: f64, expected: f64) {
    // Rounding of the sizes adds to the stated tolerance.
    assert!(
        (found - expected).abs() <= TOLERANCE + 1e-14 * (1.0 + expected),
        "found {found}, expected {expected}"
    );
}

/// The distance of two shapes given in one frame, measured in a few frames and in both orders.
#[track_caller]
fn check(a: &[[f64; 3]], b: &[[f64; 3]], expected: f64) {
    for q in [turn(0.0, 0.0, 0.0), turn(0.3, -1.1, 2.0), turn(-2.0, 0.4, 0.1)] {
        let moved: Vec<[f64; 3]> = b.iter().map(|p| (q * Vector3::from(*p)).into()).collect();
        let b_in_a = Isometry3::from_parts(Translation3::identity(), q.inverse());
        near(distance(&hull(a), &hull(&moved), &b_in_a), expected);
        near(distance(&hull(&moved), &hull(a), &b_in_a.inverse()), expected);
    }
}

fn shifted(points: &[[f64; 3]], by: [f64; 3]) -> Vec<[f64; 3]> {
    points.iter().map(|p| std::array::from_fn(|k| p[k] + by[k])).collect()
}

#[test]
fn parallel_faces() {
    // Boxes of half extents (1, 2, 3) and (0.5, 0.5, 0.5): partially overlapping faces 0.25 apart.
    check(&corners([1.0, 2.0, 3.0]), &shifted(&corners([0.5; 3]), [1.75, 1.9, -2.8]), 0.25);
}

#[test]
fn parallel_edges_and_corners() {
    let (a, b) = (corners([1.0, 2.0, 3.0]), corners([0.5; 3]));
    // Gaps of 0.3 and 0.4 along two axes: edges 0.5 apart.
    check(&a, &shifted(&b, [1.8, -2.9, 1.0]), 0.5);
    // Gaps of 0.2, 0.3 and 0.6: corners 0.7 apart.
    check(&a, &shifted(&b, [1.7, 2.8, 4.1]), 0.7);
}

#[test]
fn crossed_edges() {
    // The long edges of two roofs cross at right angles, 0.125 apart.
    let below = [[-5.0, 0.0, 0.0], [5.0, 0.0, 0.0], [0.0, -1.0, -2.0], [0.0, 1.0, -2.0]];
    let above = [[0.7, -5.0, 0.125], [0.7, 5.0, 0.125], [-1.0, 0.0, 3.0], [1.0, 0.0, 3.0]];
    check(&below, &above, 0.125);
}

#[test]
fn vertex_and_face() {
    // An octahedron's vertex (0, 0, 1) below the face z = 1.5 of a box that is off centre.
    let octahedron = [
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    let plate = shifted(&corners([4.0, 3.0, 0.5]), [2.0, -1.0, 2.0]);
    check(&octahedron, &plate, 0.5);
    // The point (1, 1, 1) is (3 - 1) / sqrt(3) from the octahedron's face x + y + z = 1.
    check(&octahedron, &[[1.0, 1.0, 1.0]], 2.0 / 3.0_f64.sqrt());
}

#[test]
fn contact_is_zero() {
    let a = corners([1.0, 2.0, 3.0]);
    // Touching by face, edge and corner; overlapping a little and much; contained; identical.
    for by in [
        [1.5, 0.0, 0.0],
        [1.5, 2.5, 0.0],
        [1.5, 2.5, 3.5],
        [1.4, 2.4, 3.4],
        [0.3, 0.2, 0.1],
        [0.0; 3],
    ] {
        check(&a, &shifted(&corners([0.5; 3]), by), 0.0);
    }
    check(&a, &a, 0.0);
    check(&a, &corners([100.0; 3]), 0.0);
}

#[test]
fn near_contact_is_not_zero() {
    for gap in [1e-3, 1e-5, 1e-7, 1e-8, 2e-9] {
        let a = corners([0.1, 0.2, 0.3]);
        let b = shifted(&corners([0.05; 3]), [0.15 + gap, 0.19, -0.28]);
        for q in [turn(0.0, 0.0, 0.0), turn(0.3, -1.1, 2.0)] {
            let moved: Vec<[f64; 3]> = b.iter().map(|p| (q * Vector3::from(*p)).into()).collect();
            let pose = Isometry3::from_parts(Translation3::identity(), q.inverse());
            let found = distance(&hull(&a), &hull(&moved), &pose);
            assert!((found - gap).abs() <= TOLERANCE, "gap {gap}, found {found}");
        }
    }
}

#[test]
fn flat_thin_and_single() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    check(&triangle, &[[0.2, 0.2, 0.5]], 0.5);
    check(&triangle, &shifted(&triangle, [0.0, 0.0, 0.25]), 0.25);
    // In one plane: legs 1 apart, and overlapping.
    check(&triangle, &shifted(&triangle, [2.0, 0.0, 0.0]), 1.0);
    check(&triangle, &shifted(&triangle, [0.25, 0.25, 0.0]), 0.0);
    // Two segments that cross, and two that are parallel; two points.
    check(&[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]], &[[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]], 0.0);
    check(&[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]], &[[-1.0, 2.0, 0.0], [3.0, 2.0, 0.0]], 2.0);
    check(&[[1.0, 2.0, 3.0]], &[[1.0, 5.0, 7.0]], 5.0);
    check(&[[1.0, 2.0, 3.0]], &[[1.0, 2.0, 3.0]], 0.0);
    // A sliver 1 m long and 1e-9 m wide.
    check(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 1e-9, 0.0]], &[[0.5, 0.3, 0.4]], 0.5);
}

#[test]
fn small_and_large() {
    // From 1e6 m rounding keeps the bounds farther apart than the tolerance.
    for size in [1e-4, 1e-2, 1.0, 100.0, 1e4, 1e6, 1e8] {
        let a: Vec<[f64; 3]> = corners([size, 2.0 * size, 3.0 * size]);
        let b = shifted(&corners([0.5 * size; 3]), [1.7 * size, 2.8 * size, 4.1 * size]);
        for q in [turn(0.0, 0.0, 0.0), turn(0.3, -1.1, 2.0), turn(-2.0, 0.4, 0.1)] {
            let moved: Vec<[f64; 3]> = b.iter().map(|p| (q * Vector3::from(*p)).into()).collect();
            let b_in_a = Isometry3::from_parts(Translation3::identity(), q.inverse());
            let found = distance(&hull(&a), &hull(&moved), &b_in_a);
            let error = (found - 0.7 * size).abs();
            assert!(error <= TOLERANCE + 1e-13 * size, "size {size}, error {error}");
        }
    }
}

#[test]
fn many_vertices() {
    // Two spheres of 5,000 points about radius 1, centres 3 apart: at least 1 apart, and at most by the
    // sagitta of the points' spacing more. Fibonacci points: neighbours are nearer than 0.06.
    let points: Vec<[f64; 3]> = (0..5000)
        .map(|i| {
            let z = 1.0 - (2.0 * f64::from(i) + 1.0) / 5000.0;
            let (r, phi) = ((1.0 - z * z).sqrt(), f64::from(i) * 2.399963229728653);
            [r * phi.cos(), r * phi.sin(), z]
        })
        .collect();
    let ball = hull(&points);
    let found = distance(&ball, &ball, &Isometry3::translation(0.0, 3.0, 0.0));
    assert!((1.0..1.0 + 2.0 * 0.06 * 0.06).contains(&found), "{found}");
    let least = points
        .iter()
        .map(|p| (Vector3::from(*p) - Vector3::new(0.0, 0.0, 2.5)).norm())
        .fold(9.0, f64::min);
    let found = distance(&ball, &hull(&[[0.0, 0.0, 2.5]]), &Isometry3::identity());
    assert!(found <= least + TOLERANCE && found >= 1.5, "{found} {least}");
}

/// A blunt dome with a keel, across a cone's tip on the dome's axis. The vertices that the descent meets, the axis and
/// the origin lie in one plane, so that a simplex has no volume but for rounding.
#[test]
fn what_lies_on_one_axis_is_as_far_as_it_is() {
    const SIDES: u32 = 24;
    let at = |side: u32, x: f64, radius: f64| {
        let angle = std::f64::consts::TAU * f64::from(side) / f64::from(SIDES);
        [x, radius * angle.cos(), radius * angle.sin()]
    };
    let shape = |points: Vec<[f64; 3]>| ConvexShape::of_points(&points).expect("a shape");
    let base = (0..SIDES).map(|side| at(side, 0.1, 0.05));
    let tip = shape(base.chain([[0.0; 3]]).collect());
    for keel in 0..SIDES {
        let rings = (1..=12).map(|k| 0.005 * f64::from(k));
        let cap = rings.flat_map(|r| (0..SIDES).map(move |side| at(side, 25e-6 - r * r, r)));
        let dome = shape(cap.chain([at(keel, -0.1, 0.15)]).collect());
        for k in 0..5_000 {
            let x = f64::from(k);
            let placed = |at: f64, angle: f64| {
                let turn = UnitQuaternion::from_euler_angles(angle, 0.0, 0.0);
                Isometry3::from_parts(Translation3::new(at, 0.051, 0.0), turn)
            };
            let [p, q] = [(1.1 * x).sin(), (0.37 * x + 0.3).sin()];
            let pose = placed(-0.09, 1.2 * p).inv_mul(&placed(0.24, 1.2 * q));
            let found = distance(&dome, &tip, &pose);
            assert!((found - 0.33).abs() < 1e-9, "{keel}, {k}: {found}");
        }
    }
}

#[test]
fn boxes_and_spheres() {
    let pose = |x, y, z| Isometry3::from_parts(Translation3::new(x, y, z), turn(0.0, 0.0, 0.0));
    let a = OrientedBox::new(pose(5.0, 0.0, 0.0), [1.0, 2.0, 3.0]).expect("a box");
    let b = OrientedBox::new(pose(0.0, 0.0, -1.0), [0.5; 3]).expect("a box");
    // As in parallel_edges_and_corners, the frames of the boxes being shifted in those of the bodies.
    near(distance(&a, &b, &Isometry3::translation(6.7, 2.8, 5.1)), 0.7);
    // Turned by an eighth about z, b's corner is sqrt(0.5) towards a.
    let eighth = Isometry3::from_parts(
        Translation3::new(8.0, 0.0, 0.0),
        turn(0.0, 0.0, std::f64::consts::FRAC_PI_4),
    );
    near(distance(&a, &b, &eighth), 2.0 - 0.5_f64.sqrt());

    let s = Sphere::new(Vector3::new(0.0, 1.0, 0.0), 0.5).expect("a sphere");
    let t = Sphere::new(Vector3::new(0.0, 0.0, 1.0), 0.25).expect("a sphere");
    near(distance(&s, &t, &Isometry3::translation(3.0, 5.0, -1.0)), 4.25);
    near(distance(&s, &t, &Isometry3::translation(0.0, 1.5, -1.0)), 0.0);
}

#[test]
fn what_is_no_shape() {
    assert_eq!(ConvexShape::new(&Mesh::default()).err(), Some(ShapeError::Empty));
    let points = [[0.0; 3], [0.0, f64::NAN, 0.0]];
    assert_eq!(ConvexShape::of_points(&points).err(), Some(ShapeError::OutOfRange { vertex: 1 }));
    let points = [[f64::INFINITY, 0.0, 0.0]];
    assert_eq!(ConvexShape::of_points(&points).err(), Some(ShapeError::OutOfRange { vertex: 0 }));
    let size = OrientedBox::new(Isometry3::identity(), [1.0, -1.0, 1.0]).err();
    assert_eq!(size, Some(ShapeError::Size { size: -1.0 }));
    assert_eq!(
        Sphere::new(Vector3::zeros(), f64::INFINITY).err(),
        Some(ShapeError::Size { size: f64::INFINITY })
    );
    assert_eq!(Sphere::new(Vector3::new(0.0, f64::NAN, 0.0), 1.0).err(), Some(ShapeError::Pose));
}

/// Some points: anywhere, on a coarse grid (many ties, coplanar and repeated points), or flat; of some size.
fn points() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let anywhere = prop::collection::vec(prop::array::uniform3(-1.0..1.0), 1..7);
    let whole = (-2..=2).prop_map(f64::from);
    let grid = prop::collection::vec(prop::array::uniform3(whole), 1..7);
    let flat = prop::collection::vec(prop::array::uniform2(-1.0..1.0), 1..7)
        .prop_map(|list| list.into_iter().map(|[x, y]| [x, y, 0.5 * x]).collect());
    let size = prop::sample::select(vec![1e-4, 0.05, 1.0, 100.0]);
    (prop_oneof![anywhere, grid, flat], size).prop_map(|(list, size): (Vec<[f64; 3]>, f64)| {
        list.iter().map(|p| p.map(|x| x * size)).collect()
    })
}

/// A pose; half of them on a grid and without a rotation.
fn pose() -> impl Strategy<Value = Isometry3<f64>> {
    let angle = -3.1..3.1;
    let any = (prop::array::uniform3(-3.0..3.0), prop::array::uniform3(angle)).prop_map(
        |([x, y, z], [r, p, w])| Isometry3::from_parts(Translation3::new(x, y, z), turn(r, p, w)),
    );
    let whole = (-4..=4).prop_map(f64::from);
    let grid = prop::array::uniform3(whole).prop_map(|[x, y, z]| Isometry3::translation(x, y, z));
    prop_oneof![any, grid]
}

fn size(a: &[[f64; 3]], b: &[[f64; 3]], pose: &Isometry3<f64>) -> f64 {
    let far = a.iter().chain(b).flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    far + pose.translation.vector.norm()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(trials(100)))]

    #[test]
    fn agrees_with_trying_everything(a in points(), b in points(), pose in pose()) {
        let found = distance(&hull(&a), &hull(&b), &pose);
        let in_a: Vec<_> = a.iter().map(|p| Vector3::from(*p)).collect();
        let in_b: Vec<_> = b.iter().map(|p| (pose * nalgebra::Point3::from(*p)).coords).collect();
        let expected = brute_force::distance(&in_a, &in_b);
        prop_assert!((found - expected).abs() <= TOLERANCE + 1e-13 * size(&a, &b, &pose), "{found} {expected}");
    }

    #[test]
    fn symmetric_and_the_same_after_any_motion(a in points(), b in points(), pose in pose(), by in pose()) {
        let found = distance(&hull(&a), &hull(&b), &pose);
        let slack = 2.0 * TOLERANCE + 1e-13 * (size(&a, &b, &pose) + size(&a, &b, &by));
        let back = distance(&hull(&b), &hull(&a), &pose.inverse());
        prop_assert!((found - back).abs() <= slack, "{found} {back}");
        let moved: Vec<[f64; 3]> = b.iter().map(|p| (by * nalgebra::Point3::from(*p)).coords.into()).collect();
        let there = distance(&hull(&a), &hull(&moved), &(pose * by.inverse()));
        prop_assert!((found - there).abs() <= slack, "{found} {there}");
    }

    #[test]
    fn a_box_is_the_hull_of_its_corners(h in prop::array::uniform3(0.0..1.0), k in prop::array::uniform3(0.0..1.0), pose in pose(), at in pose()) {
        let boxes = [OrientedBox::new(at, h), OrientedBox::new(Isometry3::identity(), k)].map(|b| b.expect("a box"));
        let turned: Vec<[f64; 3]> = corners(h).iter().map(|p| (at * nalgebra::Point3::from(*p)).coords.into()).collect();
        let found = distance(&boxes[0], &boxes[1], &pose);
        let expected = distance(&hull(&turned), &hull(&corners(k)), &pose);
        prop_assert!((found - expected).abs() <= 2.0 * TOLERANCE + 1e-13, "{found} {expected}");
    }
}
