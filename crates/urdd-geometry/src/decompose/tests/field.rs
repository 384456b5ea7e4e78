use super::*;

/// The cube from -1 to 1, with or without its top.
fn cube(top: bool) -> Part {
    let points =
        (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2 & 1].map(|b| 2.0 * f64::from(b) - 1.0)).collect();
    let mut triangles = vec![
        [0, 2, 1],
        [1, 2, 3],
        [0, 1, 4],
        [1, 5, 4],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
        [2, 6, 3],
        [3, 6, 7],
    ];
    if top {
        triangles.extend([[4, 5, 6], [5, 7, 6]]);
    }
    Part { points, triangles, ..Part::default() }
}

#[test]
fn a_closed_box_has_an_inside_and_an_open_one_none() {
    // 20 cells along each side; the outer ones contain the surface.
    let inside = |top| Flood::new(&cube(top)).map_or(0, |flood| flood.centres().len());
    assert_eq!(inside(true), 18 * 18 * 18);
    assert_eq!(inside(false), 0);
}
