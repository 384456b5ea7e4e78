//! How far shapes overlap: beside closed forms, the definition, and parry3d-f64.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use parry3d_f64::math::Pose;
use parry3d_f64::query;
use urdd_geometry::convex::across::PlacedPair;
use urdd_geometry::convex::{ConvexShape, Penetration, distance, penetration};
use urdd_geometry::oriented_box::corners;

use crate::dice::Dice;
use crate::parry::{their_pose, theirs};

fn shape(points: &[[f64; 3]]) -> ConvexShape {
    ConvexShape::of_points(points).expect("a shape")
}

fn found(a: &[[f64; 3]], b: &[[f64; 3]], pose: &Isometry3<f64>) -> Option<Penetration> {
    penetration(&PlacedPair::new(&shape(a), &shape(b), pose))
}

fn at(x: f64, y: f64, z: f64) -> Isometry3<f64> {
    Isometry3::translation(x, y, z)
}

#[test]
fn boxes_have_closed_forms() {
    let [a, b] = [corners([0.5, 0.4, 0.3]), corners([0.1, 0.2, 0.3])];
    for ([x, y, z], depth, direction) in [
        ([0.55, 0.1, 0.0], 0.05, [1.0, 0.0, 0.0]),
        ([-0.55, 0.1, 0.0], 0.05, [-1.0, 0.0, 0.0]),
        ([0.3, 0.59, 0.2], 0.01, [0.0, 1.0, 0.0]),
        ([0.0, 0.0, -0.5], 0.1, [0.0, 0.0, -1.0]),
        // They touch.
        ([0.6, 0.0, 0.1], 0.0, [1.0, 0.0, 0.0]),
    ] {
        let found = found(&a, &b, &at(x, y, z)).expect("an overlap");
        assert!((found.depth - depth).abs() < 1e-12, "{found:?}");
        let off = Vector3::from(found.direction) - Vector3::from(direction);
        assert!(off.norm() < 1e-12, "{found:?}");
    }
    assert_eq!(found(&a, &b, &at(0.6 + 1e-8, 0.0, 0.0)), None);
    // A corner against a face: a box on its corner, whose half diagonal is 0.1 sqrt 3.
    let cube = corners([0.1; 3]);
    let diagonal = Vector3::new(1.0, 1.0, 1.0).normalize();
    let turn = UnitQuaternion::rotation_between(&diagonal, &-Vector3::z()).expect("a rotation");
    let on_corner = Isometry3::from_parts(Translation3::new(0.05, 0.03, 0.4), turn);
    let found = found(&a, &cube, &on_corner).expect("an overlap");
    assert!((found.depth - (0.3 + 0.1 * 3f64.sqrt() - 0.4)).abs() < 1e-12, "{found:?}");
    assert!((found.points[1][2] - (0.4 - 0.1 * 3f64.sqrt())).abs() < 1e-9, "{found:?}");
    assert!((found.points[0][2] - 0.3).abs() < 1e-9, "{found:?}");
}

/// A spindle about a point: along each axis its tips are farthest, and they are on a line, so that what it has inside is
/// found beside the line.
#[test]
fn a_spindle_has_an_inside() {
    for (half, radius) in [(1.0, 1e-3), (0.5, 1e-6), (100.0, 0.01)] {
        let tip = Vector3::new(1.0, 0.3, 0.2).normalize();
        let side = tip.cross(&Vector3::x()).normalize();
        let ring = [side, tip.cross(&side)];
        let points = ring.map(|of| of * radius).into_iter().chain([tip * half]);
        let points: Vec<[f64; 3]> = points.flat_map(|p| [p.into(), (-p).into()]).collect();
        // The distance of a plane from its middle, by where it cuts the axes.
        let depth = 1.0 / (2.0 / (radius * radius) + 1.0 / (half * half)).sqrt();
        let found = found(&points, &[[0.0; 3]], &at(0.0, 0.0, 0.0)).expect("an overlap");
        assert!((found.depth - depth).abs() < 1e-9 * half, "{found:?} {depth}");
    }
}

/// A translation by the depth separates the two, and no shorter one along any of many directions.
#[test]
fn random_bodies_are_separated_by_the_depth_and_not_by_less() {
    let mut dice = Dice(11);
    let mut overlapping = 0;
    for round in 0..300 {
        let bodies = [dice.body(4 + round % 40), dice.body(4 + round % 31)];
        let mut pose = dice.pose();
        // About the centres of the bodies.
        let centre = Vector3::repeat(0.3);
        let shift = pose.translation.vector * 0.3;
        pose.translation = (centre - pose.rotation * centre + shift).into();
        let found = found(&bodies[0], &bodies[1], &pose);
        let ours = bodies.each_ref().map(|points| shape(points));
        let after = |by: Vector3<f64>| {
            let moved = Translation3::from(by) * pose;
            distance(&ours[0], &ours[1], &moved)
        };
        let Some(found) = found else {
            assert!(after(Vector3::zeros()) > 0.0, "{round}");
            continue;
        };
        overlapping += 1;
        let n = Vector3::from(found.direction);
        assert!((n.norm() - 1.0).abs() < 1e-12);
        let left = after(n * (found.depth + 1e-4));
        assert!((left - 1e-4).abs() < 2e-9, "{round}: {left}");
        if found.depth < 1e-6 {
            continue;
        }
        for _ in 0..200 {
            let other = dice.turn() * Vector3::x();
            assert_eq!(after(other * (found.depth - 1e-8)), 0.0, "{round}");
        }
        // The two points are the depth apart.
        let [p, q] = found.points.map(Vector3::from);
        assert!((p - q - n * found.depth).norm() < 1e-9, "{round}");
        let expected = query::contact(
            &Pose::identity(),
            &theirs(&bodies[0]),
            &their_pose(&pose),
            &theirs(&bodies[1]),
            0.0,
        );
        let expected = expected.expect("an answer").expect("a contact").dist;
        assert!((found.depth + expected).abs() < 1e-6, "{round}: {} {expected}", found.depth);
    }
    assert!(overlapping > 150, "{overlapping}");
}

#[test]
fn flat_and_thin_shapes() {
    let square = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    let cube = corners([0.1; 3]);
    let turned = Isometry3::from_parts(
        Translation3::new(0.2, 0.0, 0.04),
        UnitQuaternion::from_euler_angles(0.0, 0.0, 0.7),
    );
    let depth = found(&square, &cube, &turned).expect("an overlap").depth;
    assert!((depth - 0.06).abs() < 1e-12, "{depth}");
    // Two flat shapes in one plane, two segments that cross, and points: none has an inside, so they touch.
    for (a, b) in [
        (&square[..], &square[..]),
        (&square[..2], &[[0.0, -1.0, -1.0], [0.0, -1.0, 1.0]][..]),
        (&square[..1], &square[..1]),
        (&square[..2], &[[0.3, -1.0, 0.0]][..]),
        (&square[..], &[[0.3, 0.2, 0.0]][..]),
    ] {
        let found = found(a, b, &Isometry3::identity()).expect("a touch");
        assert!(found.depth.abs() < 1e-15, "{found:?}");
        let distance = distance(&shape(a), &shape(b), &at(0.0, 0.0, 0.0));
        assert_eq!(distance, 0.0);
    }
    assert_eq!(found(&square[..1], &square[1..2], &Isometry3::identity()), None);
    assert_eq!(found(&square[..2], &[[1.3, -1.0, 0.0]], &Isometry3::identity()), None);
    // A needle through a box: out through the nearest side.
    let needle = [[-5.0, 0.0, 0.0], [5.0, 0.0, 0.0], [0.0, 1e-6, 0.0], [0.0, 0.0, 1e-6]];
    let depth = found(&cube, &needle, &at(0.0, 0.02, 0.0)).expect("an overlap").depth;
    assert!((depth - 0.08).abs() < 2e-6, "{depth}");
}
