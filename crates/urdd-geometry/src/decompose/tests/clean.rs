use super::*;

#[test]
fn equal_vertices_are_one_and_bad_triangles_go() {
    let nan = f64::NAN;
    let mesh = Mesh {
        vertices: vec![
            [0.0; 3],
            [-0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 3.0, 0.0],
            [nan, 0.0, 0.0],
        ],
        triangles: vec![[0, 2, 3], [1, 2, 3], [2, 3, 0], [0, 3, 2], [0, 2, 9], [0, 2, 4]],
    };
    let s = Surface::new(&mesh).unwrap();
    assert_eq!(s.vertices.len(), 3);
    // Three times the same triangle, and once flipped.
    assert_eq!(s.triangles, vec![[0, 1, 2], [0, 2, 1]]);
    assert_eq!(s.ignored, 2);
    assert_eq!(s.scale, 1.5);
    assert!(Surface::new(&Mesh { triangles: vec![[0, 1, 9]], ..mesh }).is_none());
}
