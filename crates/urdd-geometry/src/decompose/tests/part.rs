use super::*;

#[test]
fn a_cut_triangle_keeps_its_area() {
    let part = Part {
        points: vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]],
        triangles: vec![[0, 1, 2]],
        ..Part::default()
    };
    let [low, high] = part.split(&Plane { normal: [1.0, 0.0, 0.0], offset: 1.0 }, 1e-9, 0.0);
    let area =
        |p: &Part| -> f64 { p.triangles.iter().map(|t| normal(p.corners(*t))[2] / 2.0).sum() };
    assert_eq!((area(&low), area(&high)), (3.5, 4.5));
}

#[test]
fn a_triangle_in_the_plane_goes_with_the_body_behind_it() {
    let part = Part {
        points: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2]],
        ..Part::default()
    };
    let plane = Plane { normal: [0.0, 0.0, 1.0], offset: 0.0 };
    assert_eq!(part.split(&plane, 1e-9, 0.0).map(|p| p.triangles.len()), [1, 0]);
    let turned = Part { triangles: vec![[0, 2, 1]], ..part };
    assert_eq!(turned.split(&plane, 1e-9, 0.0).map(|p| p.triangles.len()), [0, 1]);
}
