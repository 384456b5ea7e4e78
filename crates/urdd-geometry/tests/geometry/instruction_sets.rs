//! Distances on each instruction set of this machine.

use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use urdd_geometry::convex::{ConvexShape, OrientedBox, PlacedShape, PoseLanes, ShapeList};

use crate::levels::levels;

#[test]
fn the_same_bits_on_each_instruction_set() {
    let point = |i: u32| {
        let x = f64::from(i);
        [(1.7 * x).sin(), (2.3 * x).cos(), (0.9 * x).sin() * 0.3]
    };
    let hull = |from| ConvexShape::of_points(&(from..from + 60).map(point).collect::<Vec<_>>());
    let (a, b) = (hull(0).expect("a shape"), hull(100).expect("a shape"));
    let poses: Vec<Isometry3<f64>> = (0..999)
        .map(|k| {
            let p = point(1000 + k).map(|x| 4.0 * x);
            let q = UnitQuaternion::from_euler_angles(p[1], p[2], p[0]);
            Isometry3::from_parts(Translation3::from(p), q)
        })
        .collect();
    let lanes = PoseLanes::new(poses.iter());
    let of_boxes = [0.3, 0.7].map(|h| OrientedBox::new(poses[3], [h, 0.5, 0.1]).expect("a box"));
    let hulls = [a, b].map(|shape| PlacedShape { body: 0, shape });
    let boxes = of_boxes.map(|shape| PlacedShape { body: 0, shape });
    let kinds: [&dyn ShapeList; 2] = [&&hulls[..], &&boxes[..]];
    let all = levels().into_iter().map(|level| {
        let of = |shapes: &dyn ShapeList| {
            let mut found = vec![0.0; 1000];
            // An empty range: all are exact.
            shapes.distances(level, [0, 1], &lanes, [0.0, -1.0], &mut found);
            found.into_iter().map(f64::to_bits)
        };
        kinds.into_iter().flat_map(of).collect::<Vec<u64>>()
    });
    let all: Vec<_> = all.collect();
    assert!(all.iter().all(|found| *found == all[0]));
    let touching = all[0][..999].iter().filter(|&&x| x == 0).count();
    assert!((50..950).contains(&touching), "{touching} of 999 touch");
}
