//! Convex hulls: closed forms, degenerate and hostile points, and properties that are exact.

use crate::solids::*;
use proptest::prelude::*;
use urdd_geometry::hull::{ConvexHull, HullError};

/// The hull, after checking the properties of every hull.
fn hull_of(points: &[Point]) -> ConvexHull {
    let hull = ConvexHull::new(points).expect("a hull");
    assert_closed_subset(hull.mesh(), points);
    let beyond = outside(hull.mesh(), points);
    let allowed = ConvexHull::OUTSIDE * extent(points);
    assert!(beyond <= allowed, "{beyond:e} outside, {allowed:e} allowed");
    assert_eq!(volume(hull.mesh()) > 0.0, !hull.is_flat());
    hull
}

#[test]
fn a_box_full_of_points_on_its_faces_has_eight_corners() {
    let n = 24;
    let mut grid = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            for k in 0..=n {
                if [i, j, k].iter().any(|x| *x == 0 || *x == n) {
                    grid.push([f64::from(i) / 8.0, f64::from(j) / 8.0, f64::from(k) / 16.0]);
                }
            }
        }
    }
    let hull = hull_of(&grid);
    assert_eq!((hull.mesh().vertices.len(), hull.mesh().triangles.len()), (8, 12));
    assert_eq!(volume(hull.mesh()), 13.5);
    assert_eq!(area(hull.mesh()), 36.0);
    // Rotated, its points are off their planes by single-precision rounding, and the hull has more corners.
    let turned = placed(&grid, [0.3, 0.2, 0.1], [0.0; 3]);
    assert_near(volume(hull_of(&turned).mesh()), 13.5, 1e-6);
}

#[test]
fn a_prism_has_all_its_corners_and_its_volume() {
    let points = placed(&prism(500, 0.2, 0.7), [0.4, -0.8, 2.0], [1.0, -2.0, 3.0]);
    let hull = hull_of(&points);
    let sine = (std::f64::consts::TAU / 500.0).sin();
    assert_near(volume(hull.mesh()), 0.7 * 250.0 * 0.04 * sine, 1e-5);
    assert!(hull.mesh().vertices.len() > 950);
}

#[test]
fn points_of_a_sphere_are_all_corners() {
    let mut random = Random(1);
    let on_sphere = || {
        let p = nalgebra::Vector3::from(random.point()).normalize();
        [p.x, p.y, p.z]
    };
    let points: Vec<Point> = std::iter::repeat_with(on_sphere).take(3000).collect();
    let hull = hull_of(&points);
    assert_eq!(hull.mesh().vertices.len(), 3000);
    assert!(volume(hull.mesh()) > 4.15 && volume(hull.mesh()) < 4.1888);
}

#[test]
fn points_in_a_plane_have_a_polygon_of_two_sides() {
    // x + y + z = 6, a slanted plane without rounding, and points on its border and inside.
    let mut points = Vec::new();
    for i in 0..=6 {
        for j in 0..=6 - i {
            points.push([f64::from(i), f64::from(j), f64::from(6 - i - j)]);
        }
    }
    let hull = hull_of(&points);
    assert!(hull.is_flat());
    assert_eq!((hull.mesh().vertices.len(), hull.mesh().triangles.len()), (3, 2));
    assert_near(area(hull.mesh()), 2.0 * 18.0 * 3f64.sqrt(), 1e-15);
    // A square: two fans, no edge in four triangles.
    let square = hull_of(&[
        [0.0, 0.0, 1.0],
        [2.0, 0.0, 1.0],
        [0.0, 2.0, 1.0],
        [2.0, 2.0, 1.0],
        [1.0, 0.5, 1.0],
    ]);
    assert!(square.is_flat());
    assert_eq!((square.mesh().vertices.len(), square.mesh().triangles.len()), (4, 4));
    assert_eq!(area(square.mesh()), 8.0);
}

#[test]
fn thin_plates_and_needles_are_not_flat() {
    let mut random = Random(2);
    for scale in [1.0, 1e-6, 1e-30, 1e30] {
        for rpy in [[0.0; 3], [0.3, 0.2, 0.1]] {
            for [y, z] in [[1.0, 1e-3], [1.0, 1e-6], [1e-6, 1e-6], [1e-3, 1e-6]] {
                let mut point = |_| {
                    let [a, b, c] = random.point();
                    [scale * a, scale * b * y, scale * c * z]
                };
                let points: Vec<Point> = (0..500).map(&mut point).collect();
                assert!(!hull_of(&placed(&points, rpy, [0.0; 3])).is_flat());
            }
        }
    }
}

#[test]
fn what_has_no_area_is_refused() {
    let line: Vec<Point> = (0..9).map(|i| [1.0, 2.0, 3.0].map(|x| x * f64::from(i))).collect();
    let nan = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, f64::NAN, 0.0]];
    assert_eq!(ConvexHull::new(&[]), Err(HullError::Empty));
    assert_eq!(ConvexHull::new(&[[1.0, 2.0, 3.0]; 5]), Err(HullError::Point));
    assert_eq!(ConvexHull::new(&[[0.0; 3], [-0.0; 3]]), Err(HullError::Point));
    assert_eq!(ConvexHull::new(&line), Err(HullError::Line));
    assert_eq!(ConvexHull::new(&nan), Err(HullError::OutOfRange { point: 2 }));
    for bad in [f64::INFINITY, f64::NEG_INFINITY, 1e61, 1e-61, 5e-324] {
        let points = [[0.0; 3], [1.0, bad, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert_eq!(ConvexHull::new(&points), Err(HullError::OutOfRange { point: 1 }));
    }
    for extreme in [f64::from(f32::MAX), f64::from(f32::from_bits(1))] {
        let points = [[0.0; 3], [extreme, 0.0, 0.0], [0.0, extreme, 0.0], [0.0, 0.0, extreme]];
        assert_eq!(hull_of(&points).mesh().triangles.len(), 4);
    }
}

#[test]
fn a_corner_within_rounding_of_an_edge_is_left_out() {
    let mut points = box_corners([2.0; 3]);
    // Above the top, at h beside the middle of an edge: the triangle between is that thin.
    let with = |h: f64| [0.125, 1.0 - h, 1.0 + h];
    points.push(with(1e-10));
    assert_eq!(hull_of(&points).mesh().vertices.len(), 8);
    points.push(with(1e-6));
    assert_eq!(hull_of(&points).mesh().vertices.len(), 9);
}

/// Six times the volume of a tetrahedron, in whole numbers.
fn determinant([a, b, c]: [[i64; 3]; 3], p: [i64; 3]) -> i64 {
    let minus = |q: [i64; 3]| [0, 1, 2].map(|k| q[k] - a[k]);
    let ([ux, uy, uz], [vx, vy, vz], [wx, wy, wz]) = (minus(b), minus(c), minus(p));
    wx * (uy * vz - uz * vy) + wy * (uz * vx - ux * vz) + wz * (ux * vy - uy * vx)
}

proptest! {
    /// On a small lattice nearly everything is degenerate: many points on faces, edges and corners.
    #[test]
    fn lattice_hulls_are_exact(
        lattice in prop::collection::vec(prop::array::uniform3(-2i64..3), 4..80),
        seed: u64,
    ) {
        let points: Vec<Point> = lattice.iter().map(|p| p.map(|x| x as f64)).collect();
        let Ok(hull) = ConvexHull::new(&points) else { return Ok(()) };
        assert_closed_subset(hull.mesh(), &points);
        let whole = |i: u32| hull.mesh().vertices[i as usize].map(|x| x as i64);
        for triangle in &hull.mesh().triangles {
            let corners = triangle.map(whole);
            let sides = lattice.iter().map(|p| determinant(corners, *p));
            prop_assert!(sides.clone().all(|side| side <= 0));
            prop_assert!(hull.is_flat() || sides.clone().any(|side| side < 0));
        }
        // Each vertex is a corner: without it the hull is smaller.
        for vertex in &hull.mesh().vertices {
            let rest: Vec<Point> = points.iter().copied().filter(|p| p != vertex).collect();
            let smaller = ConvexHull::new(&rest).map_or(true, |rest| {
                volume(rest.mesh()) < volume(hull.mesh()) - 0.1
                    || hull.is_flat() && area(rest.mesh()) < area(hull.mesh()) - 0.1
            });
            prop_assert!(smaller);
        }
        // The order of the points and their repetition change no bit.
        let mut shuffled = [&points[..], &points[..points.len() / 2]].concat();
        Random(seed).shuffle(&mut shuffled);
        prop_assert_eq!(ConvexHull::new(&shuffled), Ok(hull));
    }

    #[test]
    fn clouds_are_held(
        seed: u64,
        count in 4usize..300,
        stretch in prop::array::uniform3(-6i32..1),
        rpy in prop::array::uniform3(-3.0..3.0),
        xyz in prop::array::uniform3(-10.0..10.0),
    ) {
        let mut random = Random(seed);
        let mut point = |_| {
            let [x, y, z] = random.point();
            let [a, b, c] = stretch.map(|e| 10f64.powi(e));
            [x * a, y * b, z * c]
        };
        let points: Vec<Point> = (0..count).map(&mut point).collect();
        let points = placed(&points, rpy, xyz);
        if let Ok(hull) = ConvexHull::new(&points) {
            prop_assert_eq!(&hull_of(&points), &hull);
            let mut shuffled = points.clone();
            random.shuffle(&mut shuffled);
            prop_assert_eq!(&hull_of(&shuffled), &hull);
            // The hull of a hull is itself.
            prop_assert_eq!(&hull_of(&hull.mesh().vertices), &hull);
        }
    }
}
