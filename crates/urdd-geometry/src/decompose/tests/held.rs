use super::*;

fn hull(points: &[[f64; 3]]) -> ConvexHull {
    ConvexHull::new(points).expect("a hull")
}

/// A cube from 0 to 10 cm, and a 2 cm square at the given height.
fn count(height: f64, left: f64) -> usize {
    let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { 0.0 } else { 0.1 });
    let cube: Vec<[f64; 3]> = (0..8).map(corner).collect();
    let square = [(0.0, 0.0), (0.02, 0.0), (0.02, 0.02), (0.0, 0.02)];
    let square = square.map(|(x, y)| [left + x, 0.04 + y, height]);
    without_held(vec![hull(&square), hull(&cube)], 2e-6, 2e-4).len()
}

#[test]
fn a_square_in_a_face_goes() {
    assert_eq!(count(0.1, 0.04), 1, "in the lid");
    assert_eq!(count(0.1 + 1e-6, 0.04), 1, "over the lid, by rounding");
    assert_eq!(count(0.05, 0.04), 1, "inside");
}

#[test]
fn what_no_other_piece_holds_stays() {
    assert_eq!(count(0.1 + 1e-5, 0.04), 2, "over the lid");
    assert_eq!(count(0.1, 0.09), 2, "beyond the edge");
    let square = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let both = vec![hull(&square), hull(&square)];
    assert_eq!(without_held(both, 2e-6, 2e-4).len(), 2, "flat bodies alone");
}

/// A cube from 0 to 10 cm, 5 m along x, and a splinter over its lid, some 1 mm long and 1e-7 m wide.
fn splintered(above: f64) -> Vec<Mesh> {
    let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { 0.0 } else { 0.1 });
    let moved = |[x, y, z]: [f64; 3]| [x + 5.0, y, z];
    let cube: Vec<[f64; 3]> = (0..8).map(corner).map(moved).collect();
    let splinter = [(0.04, 0.04), (0.041, 0.04), (0.0405, 0.04 + 1e-7)];
    let splinter = splinter.map(|(x, y)| moved([x, y, 0.1 + above]));
    without_held(vec![hull(&splinter), hull(&cube)], 2e-6, 2e-4)
}

#[test]
fn a_splinter_joins_the_piece_that_it_is_near() {
    let [joined] = &splintered(1e-5)[..] else {
        panic!("one piece");
    };
    let highest = joined.vertices.iter().map(|v| v[2]);
    assert_eq!(highest.fold(0.0, f64::max), 0.1 + 1e-5);
    let [_, widened] = &splintered(1e-3)[..] else {
        panic!("too far away");
    };
    let rounded = widened.vertices.iter().map(|v| v.map(|x| f64::from(x as f32)));
    let rounded = Mesh { vertices: rounded.collect(), triangles: widened.triangles.clone() };
    assert!(!is_thin(&rounded), "{rounded:?}");
    let x = rounded.vertices.iter().map(|v| v[0]);
    assert!((x.clone().fold(f64::MAX, f64::min) - 5.04).abs() < 1e-4);
    assert!((x.fold(f64::MIN, f64::max) - 5.041).abs() < 1e-4);
}
