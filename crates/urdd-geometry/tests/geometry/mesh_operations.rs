//! Operations on meshes, against closed forms.

use nalgebra::{Matrix4, Rotation3, Vector3};
use urdd_geometry::Mesh;
use urdd_geometry::mesh::placement;
use urdd_geometry::primitives;

const NO_TURN: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{found} for {expected}");
}

#[test]
fn a_box_has_its_area_volume_and_bounds() {
    let mesh = primitives::cuboid([1.0, 2.0, 3.0]);
    near(mesh.area(), 22.0);
    near(mesh.signed_volume(), 6.0);
    let bounds = mesh.bounds().unwrap();
    assert_eq!((bounds.min, bounds.max), ([-0.5, -1.0, -1.5], [0.5, 1.0, 1.5]));
}

#[test]
fn the_volume_does_not_suffer_from_distance() {
    let mut mesh = primitives::cuboid([1.0, 1.0, 1.0]);
    mesh.transform(&Matrix4::new_translation(&Vector3::new(1e6 / 3.0, -1e6 / 7.0, 1e6 / 9.0)));
    assert!((mesh.signed_volume() - 1.0).abs() < 1e-8, "{}", mesh.signed_volume());
}

#[test]
fn scale_comes_before_rotation_and_translation() {
    let quarter_turn = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let mut mesh = primitives::cuboid([1.0, 1.0, 1.0]);
    mesh.transform(&placement([2.0, 4.0, 6.0], quarter_turn, [10.0, 20.0, 30.0]));
    let bounds = mesh.bounds().unwrap();
    assert_eq!((bounds.min, bounds.max), ([8.0, 19.0, 27.0], [12.0, 21.0, 33.0]));
    near(mesh.signed_volume(), 48.0);
}

#[test]
fn a_mirrored_mesh_still_faces_outward() {
    for scale in [[-1.0, 1.0, 1.0], [1.0, -2.0, 1.0], [-1.0, -1.0, -1.0], [-1.0, -1.0, 1.0]] {
        let mut mesh = primitives::cuboid([1.0, 2.0, 3.0]);
        mesh.transform(&placement(scale, NO_TURN, [0.0; 3]));
        near(mesh.signed_volume(), 6.0 * scale.iter().product::<f64>().abs());
    }
}

#[test]
fn the_identity_changes_no_bit() {
    let mut mesh = primitives::sphere(0.1234567);
    let before = mesh.clone();
    mesh.transform(&placement([1.0; 3], NO_TURN, [0.0; 3]));
    assert_eq!(mesh, before);
}

#[test]
fn a_rotation_keeps_area_and_volume() {
    let mut mesh = primitives::capsule(0.2, 0.7);
    let (area, volume) = (mesh.area(), mesh.signed_volume());
    mesh.transform(&Rotation3::from_euler_angles(0.3, -1.1, 2.0).to_homogeneous());
    near(mesh.area(), area);
    near(mesh.signed_volume(), volume);
}

#[test]
fn appending_shifts_indices() {
    let mut mesh = primitives::cuboid([1.0; 3]);
    let mut other = primitives::cuboid([2.0; 3]);
    other.transform(&Matrix4::new_translation(&Vector3::new(5.0, 0.0, 0.0)));
    mesh.append(&other);
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (16, 24));
    near(mesh.signed_volume(), 9.0);
    assert_eq!(mesh.bounds().unwrap().max, [6.0, 1.0, 1.0]);
}

#[test]
fn rounding_gives_binary32_without_negative_zero() {
    let mut mesh = Mesh {
        vertices: vec![[0.1, -0.0, 1e-50], [1.0, -1e-60, 0.0], [0.0, 1.0, 1e300]],
        triangles: vec![[0, 1, 1], [0, 1, 2]],
    };
    assert_eq!(mesh.round_to_f32(), 1, "the triangle with 1e300 goes");
    assert_eq!(mesh.vertices, [[f64::from(0.1_f32), 0.0, 0.0], [1.0, 0.0, 0.0]]);
    assert!(mesh.vertices.iter().flatten().all(|value| value.is_sign_positive()));
    assert_eq!(mesh.triangles, [[0, 1, 1]]);
}

#[test]
fn welding_keeps_the_first_of_equal_places() {
    let mut mesh = Mesh {
        vertices: vec![
            [1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0],
            [1.0, -0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0],
        ],
        triangles: vec![[0, 3, 1], [2, 3, 4], [1, 4, 3]],
    };
    assert_eq!(mesh.weld(), 2);
    assert_eq!(mesh.vertices, [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(mesh.triangles, [[0, 2, 1], [0, 2, 1], [1, 1, 2]]);
    assert_eq!(mesh.drop_degenerate(), 1);
    assert_eq!(mesh.triangles, [[0, 2, 1], [0, 2, 1]]);
}

#[test]
fn a_soup_of_many_triangles_welds_to_its_vertices() {
    let solid = primitives::sphere(1.0);
    let mut soup = Mesh::default();
    for triangle in &solid.triangles {
        soup.append(&Mesh {
            vertices: solid.corners(*triangle).to_vec(),
            triangles: vec![[0, 1, 2]],
        });
    }
    assert_eq!(soup.weld(), 1280 * 3 - 642);
    assert_eq!(soup.signed_volume(), solid.signed_volume());
}

#[test]
fn degenerate_is_no_area_and_no_less() {
    let line = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0], [2.0, 2.0, 2.0 + 1e-9]];
    let mut mesh =
        Mesh { vertices: line.to_vec(), triangles: vec![[0, 1, 2], [0, 1, 3], [0, 0, 3]] };
    assert_eq!(mesh.drop_degenerate(), 2);
    assert_eq!(mesh.triangles, [[0, 1, 3]]);
    assert_eq!(mesh.drop_unused_vertices(), 1);
    assert_eq!(mesh.vertices, [line[0], line[1], line[3]]);
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
}

#[test]
fn unused_vertices_are_not_in_the_bounds() {
    let mut mesh = primitives::cuboid([1.0; 3]);
    mesh.vertices.push([9.0; 3]);
    assert_eq!(mesh.bounds().unwrap().max, [0.5; 3]);
    assert!(Mesh { vertices: vec![[1.0; 3]], triangles: vec![] }.bounds().is_none());
}
