//! Pairs computed together, each compared with its closed form: parallel faces apart, where rounding stops the descent
//! most often.

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::ConvexPolyhedron;
use urdd_geometry::convex::across::{PlacedPair, any_touches, distances, witnesses};
use urdd_geometry::convex::{ConvexShape, Level, TOLERANCE, distance};

use crate::dice::Dice;

/// A prism with its corners on a circle, from z = -half to half. It contains the circle of radius `inner`.
#[derive(Clone)]
struct Prism {
    corners: Vec<[f64; 3]>,
    half: f64,
    inner: f64,
}

impl Prism {
    fn new(dice: &mut Dice) -> Self {
        let sides = 3 + (dice.roll() * 30.0) as usize;
        let (radius, half) = (dice.within(0.02, 0.3), dice.within(0.01, 0.3));
        let start = dice.within(0.0, 3.0);
        let corner = |k: usize| {
            let angle = start + std::f64::consts::TAU * (k % sides) as f64 / sides as f64;
            let z = if k < sides { -half } else { half };
            [radius * angle.cos(), radius * angle.sin(), z]
        };
        Self {
            corners: (0..2 * sides).map(corner).collect(),
            half,
            inner: radius * (std::f64::consts::PI / sides as f64).cos(),
        }
    }

    /// The corners, moved, and rounded as in files.
    fn moved(&self, by: &Isometry3<f64>) -> Vec<[f64; 3]> {
        let rounded = |x: f64| f64::from(x as f32);
        let corner = |p: &[f64; 3]| (by * Point3::from(*p)).coords.map(rounded).into();
        self.corners.iter().map(corner).collect()
    }
}

/// More than rounding to 32 bits can move faces of this size, metres.
const ROUNDED: f64 = 2e-7;

/// Two prisms with partially overlapping parallel faces, a gap apart.
struct Case {
    points: [Vec<[f64; 3]>; 2],
    b_in_a: Isometry3<f64>,
    gap: f64,
}

fn cases(count: usize) -> Vec<Case> {
    let mut dice = Dice(5);
    let mut cases = Vec::new();
    for k in 0..count {
        let a = Prism::new(&mut dice);
        // Half of them are two equal prisms on one axis, like the discs of a robot's motors.
        let alike = k % 2 == 0;
        let b = match alike {
            true => a.clone(),
            false => Prism::new(&mut dice),
        };
        let gap = [0.0, 1e-6, 1e-3, 0.05, 0.7][k % 5] * dice.within(0.5, 1.0);
        // The middle of b's face is over a's.
        let away = match alike {
            true => 0.0,
            false => 0.9 * a.inner * dice.roll(),
        };
        let shift = Vector3::new(away, 0.0, a.half + b.half + gap);
        let above = Isometry3::from_parts(
            Translation3::from(shift),
            UnitQuaternion::from_axis_angle(&Vector3::z_axis(), dice.within(-3.0, 3.0)),
        );
        // A quarter of them along the axes of their frames, the others turned.
        let turn = |dice: &mut Dice| match k % 4 {
            0 => Isometry3::identity(),
            _ => {
                let shift = [0, 1, 2].map(|_| dice.within(-0.3, 0.3));
                Isometry3::from_parts(Translation3::from(shift), dice.turn())
            }
        };
        let (of_a, of_b) = (turn(&mut dice), turn(&mut dice));
        cases.push(Case {
            points: [a.moved(&of_a), b.moved(&of_b)],
            b_in_a: of_a * above * of_b.inverse(),
            gap,
        });
    }
    cases
}

#[test]
fn parallel_faces_apart() {
    let cases = cases(1600);
    let shape = |points: &Vec<[f64; 3]>| ConvexShape::of_points(points).expect("a shape");
    let shapes: Vec<[ConvexShape; 2]> =
        cases.iter().map(|case| case.points.each_ref().map(shape)).collect();
    let pairs: Vec<PlacedPair> = shapes
        .iter()
        .zip(&cases)
        .map(|([a, b], case)| PlacedPair::new(a, b, &case.b_in_a))
        .collect();
    let mut found = vec![f64::NAN; pairs.len()];
    distances(Level::new(), &pairs, &mut found);
    let seen = witnesses(Level::new(), &pairs);
    for (k, case) in cases.iter().enumerate() {
        let gap = case.gap;
        assert!((found[k] - gap).abs() <= ROUNDED, "{k}: {} of {gap}", found[k]);
        let [a, b] = &shapes[k];
        let alone = distance(a, b, &case.b_in_a);
        assert!((found[k] - alone).abs() <= 2.0 * TOLERANCE, "{k}: {} and {alone}", found[k]);
        assert_eq!(seen[k].distance.to_bits(), found[k].to_bits());
        let [p, q] = seen[k].points.map(Point3::from);
        assert!(((q - p).norm() - alone).abs() <= 2.0 * TOLERANCE, "{k}: {:?}, {gap}", seen[k]);
        // Eight at a time, as in the lanes.
        if k % 8 == 0 {
            let eight = k..(k + 8).min(pairs.len());
            let touching = found[eight.clone()].contains(&0.0);
            assert_eq!(any_touches(Level::new(), &pairs[eight]), touching, "{k}");
        }
    }
}

#[test]
fn parallel_faces_apart_as_parry_has_them() {
    let vector = |[x, y, z]: [f64; 3]| Vector::new(x, y, z);
    for (k, case) in cases(400).iter().enumerate() {
        let theirs = case.points.each_ref().map(|points| {
            let points: Vec<Vector> = points.iter().copied().map(vector).collect();
            ConvexPolyhedron::from_convex_hull(&points).expect("a hull")
        });
        let pose = Pose::new(
            vector(case.b_in_a.translation.vector.into()),
            vector(case.b_in_a.rotation.scaled_axis().into()),
        );
        let found = query::distance(&Pose::identity(), &theirs[0], &pose, &theirs[1]);
        let found = found.expect("a distance").distance;
        assert!((found - case.gap).abs() < 1e-6, "{k}: parry {found}, {}", case.gap);
    }
}

/// What boxes around shapes tell apart is apart, and they tell most of what is far apart.
#[test]
fn shapes_are_beyond_what_their_boxes_are_beyond() {
    let mut dice = Dice(11);
    let (mut told, mut far) = (0, 0);
    for _ in 0..20_000 {
        let mut shape = || {
            let by = Isometry3::translation(dice.within(-0.2, 0.2), dice.within(-0.2, 0.2), 0.1);
            ConvexShape::of_points(&Prism::new(&mut dice).moved(&by)).unwrap()
        };
        let (a, b) = (shape(), shape());
        let turn = Vector3::from_fn(|_, _| dice.within(-2.0, 2.0));
        let shift = Vector3::from_fn(|_, _| dice.within(-0.6, 0.6));
        let pose = Isometry3::new(shift, turn);
        let pair = PlacedPair::new(&a, &b, &pose);
        let mut apart = [0.0];
        distances(Level::new(), &[pair], &mut apart);
        for distance in [0.0, 0.05] {
            let is_told = pair.boxes_are_beyond(distance);
            assert!(!is_told || apart[0] > distance, "{apart:?} {pose:?}");
            told += usize::from(is_told);
            far += usize::from(apart[0] > distance);
        }
    }
    assert!(far > 10_000 && 10 * told > 6 * far, "{told} of {far}");
}
