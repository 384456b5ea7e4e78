//! Distances and hulls compared with parry3d-f64, another implementation.
//!
//! parry's GJK stops within some 1e-7 of the size of its shapes, ours within 1e-9 m, so the two agree to 1e-6. Its hull
//! treats anything thinner than about 1e-4 of its length as flat, so only round bodies are compared here.

use nalgebra::Isometry3;
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::ConvexPolyhedron;
use urdd_geometry::Mesh;
use urdd_geometry::convex::across::{PlacedPair, any_touches, distances, witnesses};
use urdd_geometry::convex::{ConvexShape, Level, distance};
use urdd_geometry::hull::ConvexHull;

use crate::dice::Dice;

fn vector([x, y, z]: [f64; 3]) -> Vector {
    Vector::new(x, y, z)
}

pub fn theirs(points: &[[f64; 3]]) -> ConvexPolyhedron {
    let points: Vec<Vector> = points.iter().copied().map(vector).collect();
    ConvexPolyhedron::from_convex_hull(&points).expect("a hull")
}

pub fn their_pose(pose: &Isometry3<f64>) -> Pose {
    Pose::new(vector(pose.translation.vector.into()), vector(pose.rotation.scaled_axis().into()))
}

#[test]
fn distances_of_random_bodies() {
    let mut dice = Dice(7);
    let (mut touching, mut apart) = (0, 0);
    for round in 0..400 {
        let bodies = [dice.body(8 + round % 60), dice.body(8 + round % 41)];
        let pose = dice.pose();
        let expected = query::distance(
            &Pose::identity(),
            &theirs(&bodies[0]),
            &their_pose(&pose),
            &theirs(&bodies[1]),
        )
        .expect("a distance")
        .distance;
        let ours = bodies.each_ref().map(|points| ConvexShape::of_points(points).expect("a shape"));
        let found = distance(&ours[0], &ours[1], &pose);
        assert!((found - expected).abs() < 1e-6, "{round}: {found}, parry {expected}");
        // For bodies that touch within parry's precision, either answer is right.
        if expected > 1e-6 {
            apart += 1;
            assert!(found > 0.0);
        } else {
            touching += 1;
        }
    }
    assert!(touching > 50 && apart > 50, "{touching} touch, {apart} are apart");
}

#[test]
fn pairs_side_by_side_are_each_by_itself() {
    let mut dice = Dice(11);
    let bodies: Vec<ConvexShape> =
        (0..23).map(|k| ConvexShape::of_points(&dice.body(4 + 3 * k)).expect("a shape")).collect();
    let poses: Vec<Isometry3<f64>> = (0..200).map(|_| dice.pose()).collect();
    let place = |k: usize| (&bodies[k % 23], &bodies[(k * 7 + 1) % 23], &poses[k]);
    let pairs: Vec<PlacedPair> =
        (0..200).map(place).map(|(a, b, pose)| PlacedPair::new(a, b, pose)).collect();
    let mut found = vec![f64::NAN; 200];
    distances(Level::new(), &pairs, &mut found);
    let seen = witnesses(Level::new(), &pairs);
    for k in 0..200 {
        let (a, b, pose) = place(k);
        // Not the same bits: the centres are subtracted in another order.
        assert!((found[k] - distance(a, b, pose)).abs() < 2e-9, "{k}");
        assert_eq!(any_touches(Level::new(), &pairs[k..=k]), found[k] == 0.0, "{k}");
        let mut alone = [f64::NAN];
        distances(Level::new(), &pairs[k..=k], &mut alone);
        assert_eq!(alone[0].to_bits(), found[k].to_bits(), "{k}");
        let [p, q] = seen[k].points.map(nalgebra::Vector3::from);
        assert!(((p - q).norm() - found[k]).abs() < 2e-9, "{k}: {:?}", seen[k]);
    }
    let touching = found.iter().filter(|distance| **distance == 0.0).count();
    assert!((20..180).contains(&touching), "{touching}");
}

/// The volume within a closed mesh.
fn volume(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> f64 {
    let mesh = Mesh { vertices: vertices.to_vec(), triangles: triangles.to_vec() };
    mesh.signed_volume()
}

#[test]
fn hulls_of_random_points_have_the_same_volume() {
    let mut dice = Dice(13);
    for round in 0..60 {
        let points: Vec<[f64; 3]> = dice.body(10 + 17 * round);
        let hull = ConvexHull::new(&points).expect("a hull").into_mesh();
        let (vertices, triangles) = parry3d_f64::transformation::convex_hull(
            &points.iter().copied().map(vector).collect::<Vec<_>>(),
        );
        let vertices: Vec<[f64; 3]> = vertices.into_iter().map(|v| [v.x, v.y, v.z]).collect();
        let (ours, theirs) =
            (volume(&hull.vertices, &hull.triangles), volume(&vertices, &triangles));
        assert!((ours - theirs).abs() < 1e-9 * ours, "{round}: {ours}, parry {theirs}");
    }
}
