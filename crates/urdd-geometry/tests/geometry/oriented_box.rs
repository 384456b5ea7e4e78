//! Oriented boxes: closed forms, brute force, and properties.

use crate::solids::*;
use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use urdd_geometry::{farthest, hull::ConvexHull, oriented_box::OrientedBox};

/// The box around points, after checking the properties of every box.
fn box_of(points: &[Point]) -> OrientedBox {
    let hull = ConvexHull::new(points).expect("a hull");
    let found = OrientedBox::around(&hull);
    assert!((found.rotation.quaternion().norm() - 1.0).abs() < 1e-15);
    assert!(found.rotation.w >= 0.0 && found.rotation.angle() < 63f64.to_radians());
    let to_box = found.rotation.to_rotation_matrix().inverse();
    let reach = extent(points) + Vector3::from(found.centre).norm();
    for p in points {
        let inside = to_box * (Vector3::from(*p) - Vector3::from(found.centre));
        for k in 0..3 {
            let beyond = inside[k].abs() - found.half_extents[k];
            assert!(beyond <= ConvexHull::THINNEST * extent(points), "{beyond:e} beyond");
        }
    }
    for p in &hull.mesh().vertices {
        let inside = to_box * (Vector3::from(*p) - Vector3::from(found.centre));
        for k in 0..3 {
            assert!(inside[k].abs() <= found.half_extents[k] + 1e-15 * reach);
        }
    }
    found
}

/// The volume of the axis-aligned box of points that are rotated back by a rotation.
fn volume_across(points: &[Point], rotation: &Rotation3<f64>) -> f64 {
    let mut volume = 1.0;
    for k in 0..3 {
        let axis = rotation.matrix().column(k).into_owned();
        let along = || points.iter().map(|p| axis.dot(&Vector3::from(*p)));
        volume *= along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min);
    }
    volume
}

/// Another search: descent from many rotations by small random turns of decreasing size.
fn brute_force(points: &[Point], starts: usize) -> f64 {
    let mut random = Random(99);
    let mut best = f64::INFINITY;
    for _ in 0..starts {
        let turn = Vector3::from(random.point()) * std::f64::consts::PI;
        let mut rotation = Rotation3::from_scaled_axis(turn);
        let mut volume = volume_across(points, &rotation);
        let mut step = 0.3;
        while step > 1e-7 {
            let mut improved = false;
            for _ in 0..12 {
                let nudge = Vector3::from(random.point()) * step;
                let other = Rotation3::from_scaled_axis(nudge) * rotation;
                let less = volume_across(points, &other);
                if less < volume {
                    (rotation, volume, improved) = (other, less, true);
                }
            }
            if !improved {
                step *= 0.6;
            }
        }
        best = best.min(volume);
    }
    best
}

#[test]
fn an_aligned_box_is_itself() {
    let points = placed(&box_corners([1.0, 1.0, 1.0]), [0.0; 3], [4.0, -2.0, 0.5]);
    let found = box_of(&points);
    assert_eq!(found.rotation, UnitQuaternion::identity());
    assert_eq!((found.centre, found.half_extents), ([4.0, -2.0, 0.5], [0.5; 3]));
}

#[test]
fn a_turned_box_is_found() {
    let sides = [1.0, 2.0, 3.0];
    let rpy = [0.3, -0.2, 0.4];
    let found = box_of(&placed(&box_corners(sides), rpy, [0.5, 0.25, -8.0]));
    assert_near(found.volume(), 6.0, 1e-5);
    let expected = UnitQuaternion::from_euler_angles(rpy[0], rpy[1], rpy[2]);
    assert!(found.rotation.angle_to(&expected) < 1e-5);
    for (half, side) in found.half_extents.iter().zip(sides) {
        assert_near(2.0 * half, side, 1e-5);
    }
    // If the rotation is larger than its symmetries require, the smallest equivalent one is reported.
    let quarter = box_of(&placed(&box_corners(sides), [0.0, 0.0, 1.5], [0.0; 3]));
    assert_near(quarter.rotation.angle(), std::f64::consts::FRAC_PI_2 - 1.5, 1e-5);
    assert_near(2.0 * quarter.half_extents[0], 2.0, 1e-6);
}

#[test]
fn regular_solids() {
    // The tetrahedron of edge 1 fits the cube of edge 1 / sqrt 2, on every other corner.
    let every_other = |i: &usize| i.count_ones().is_multiple_of(2);
    let cube = box_corners([0.5f64.sqrt(); 3]);
    let tetrahedron: Vec<Point> = (0..8).filter(every_other).map(|i| cube[i]).collect();
    let turned = placed(&tetrahedron, [0.5, 1.1, -2.0], [1.0, 1.0, 1.0]);
    assert_near(box_of(&turned).volume(), 0.5f64.powf(1.5), 1e-6);

    let octahedron: Vec<Point> = (0..6)
        .map(|i| [0, 1, 2].map(|k| if i / 2 == k { [1.0, -1.0][i % 2] } else { 0.0 }))
        .collect();
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let rectangle = box_corners([0.0, 2.0, 2.0 * golden]);
    let turn = |k: usize| rectangle.iter().map(move |p| [p[k], p[(k + 1) % 3], p[(k + 2) % 3]]);
    let icosahedron: Vec<Point> = turn(0).chain(turn(1)).chain(turn(2)).collect();
    for solid in [octahedron, icosahedron] {
        let turned = placed(&solid, [0.5, 1.1, -2.0], [0.0; 3]);
        let (found, brute) = (box_of(&turned).volume(), brute_force(&turned, 25));
        assert!(found <= brute * (1.0 + 1e-6), "{found} above {brute}");
        assert!(found >= brute * (1.0 - 1e-2), "{found} far below {brute}");
    }
}

#[test]
fn a_cylinder_is_boxed_along_its_axis() {
    for (corners, rpy) in [(64, [0.0; 3]), (64, [0.7, 0.5, -1.0]), (400, [0.7, 0.5, -1.0])] {
        let found = box_of(&placed(&prism(corners, 0.5, 3.0), rpy, [0.0; 3]));
        // Two sides along edges of the polygon, and two at right angles.
        let across = (std::f64::consts::PI / f64::from(corners)).cos();
        assert_near(found.volume(), across * across * 3.0, 2e-6);
    }
}

#[test]
fn flat_hulls_have_flat_boxes() {
    // In the plane x + y + z = 0 a rectangle of 3 sqrt 2 by 2 sqrt 6, and points in it.
    let at = |a: f64, b: f64| [a + b, b - a, -2.0 * b];
    let points = [at(0.0, 0.0), at(3.0, 0.0), at(0.0, 2.0), at(3.0, 2.0), at(1.0, 1.5)];
    let found = box_of(&points);
    assert_near(found.area(), 2.0 * (3.0 * 2f64.sqrt()) * (2.0 * 6f64.sqrt()), 1e-14);
    assert!(found.half_extents.iter().any(|h| *h < 1e-15));
    let aligned = box_of(&[[0.0, 1.0, 2.0], [4.0, 1.0, 2.0], [0.0, 1.0, 8.0], [4.0, 1.0, 8.0]]);
    assert_eq!((aligned.centre, aligned.half_extents), ([2.0, 1.0, 5.0], [2.0, 0.0, 3.0]));
    assert_eq!(aligned.rotation, UnitQuaternion::identity());
}

#[test]
fn nothing_smaller_is_found_by_brute_force() {
    let mut random = Random(5);
    for stretch in [[1.0; 3], [3.0, 1.0, 1.0], [10.0, 3.0, 1.0], [1.0, 1.0, 0.1], [1.0, 0.02, 0.02]]
    {
        for count in [4, 6, 20] {
            let mut point = |_| {
                let p = random.point();
                [0, 1, 2].map(|k| p[k] * stretch[k])
            };
            let points: Vec<Point> = (0..count).map(&mut point).collect();
            let points = placed(&points, random.point(), [0.0; 3]);
            let (found, brute) = (box_of(&points).volume(), brute_force(&points, 20));
            assert!(found <= brute * (1.0 + 2e-6), "{stretch:?} {count}: {found} above {brute}");
        }
    }
}

#[test]
fn size_and_place_do_not_matter() {
    let mut random = Random(6);
    let points: Vec<Point> = (0..30).map(|_| single(random.point())).collect();
    let reference = box_of(&points);
    // Powers of two, so that points scale without rounding.
    for exponent in [-100, -40, 40, 100] {
        let scale = 2f64.powi(exponent);
        let scaled: Vec<Point> = points.iter().map(|p| p.map(|x| x * scale)).collect();
        let found = box_of(&scaled);
        assert_eq!(found.half_extents.map(|h| h / scale), reference.half_extents);
        assert_eq!(found.rotation, reference.rotation);
    }
}

#[test]
fn the_farthest_point_of_a_box_is_a_corner() {
    let found = box_of(&placed(&box_corners([2.0, 4.0, 6.0]), [0.0; 3], [10.0, -20.0, 30.0]));
    assert_eq!(farthest::of_box(&found), (121f64 + 484.0 + 1089.0).sqrt());
    let turned = box_of(&placed(&box_corners([2.0, 4.0, 6.0]), [0.3, 0.2, 0.4], [0.0; 3]));
    assert_near(farthest::of_box(&turned), 14f64.sqrt(), 1e-6);
}

proptest! {
    #[test]
    fn turning_the_points_turns_the_box(
        seed: u64,
        count in 4usize..60,
        stretch in prop::array::uniform3(-2i32..1),
        rpy in prop::array::uniform3(-3.0..3.0),
    ) {
        let mut random = Random(seed);
        let mut point = |_| {
            let p = random.point();
            single([0, 1, 2].map(|k| p[k] * 10f64.powi(stretch[k])))
        };
        let mut points: Vec<Point> = (0..count).map(&mut point).collect();
        let found = box_of(&points);
        // In doubles: single precision would change the volume of a thin hull.
        let rotation = Rotation3::from_euler_angles(rpy[0], rpy[1], rpy[2]);
        let place = |p: &Point| (rotation * Vector3::from(*p) + Vector3::new(1.0, 2.0, 3.0)).into();
        let placed: Vec<Point> = points.iter().map(place).collect();
        let turned = box_of(&placed);
        assert_near(turned.volume(), found.volume(), 1e-4);
        random.shuffle(&mut points);
        prop_assert_eq!(box_of(&points), found);
    }
}
