//! Compares plain meshes with the robot's elements at their places (SPEC 7.8).

use nalgebra::{Matrix3, Rotation3};
use urdd_format::urdf::{Capsule, Cuboid, Cylinder, Geometry, Sphere};
use urdd_geometry::{Mesh, primitives};
use urdd_validate::solids::expected::{Expected, Primitive};
use urdd_validate::solids::placed::*;

/// A cylinder's triangles with this many corners per circle.
fn coarse(corners: usize, radius: f64, length: f64) -> Mesh {
    let mut mesh = Mesh::default();
    for end in [-0.5, 0.5] {
        for i in 0..corners {
            let angle = std::f64::consts::TAU * i as f64 / corners as f64;
            mesh.vertices.push([radius * angle.cos(), radius * angle.sin(), end * length]);
        }
    }
    let n = corners as u32;
    for i in 0..n {
        let next = (i + 1) % n;
        mesh.triangles.extend([[i, next, next + n], [i, next + n, i + n]]);
        if i > 0 && next > 0 {
            mesh.triangles.extend([[0, next, i], [n, i + n, next + n]]);
        }
    }
    mesh
}

fn of(geometries: &[(Geometry, Mesh, [f64; 3])]) -> (Expected, Mesh) {
    let turn = Rotation3::from_euler_angles(0.3, -1.1, 2.4).into_inner();
    let rows = [0, 1, 2].map(|r| [0, 1, 2].map(|c| turn[(r, c)]));
    let mut expected = Expected::default();
    let mut found = Mesh::default();
    for (geometry, mesh, at) in geometries {
        let primitive = Primitive::new(geometry, turn, *at).expect("no mesh");
        expected.extent = expected.extent.max(primitive.extent());
        expected.primitives.push(primitive);
        let mut placed = mesh.clone();
        placed.transform(&urdd_geometry::mesh::placement([1.0; 3], rows, *at));
        placed.round_to_f32();
        found.append(&placed);
    }
    (expected, found)
}

fn shapes() -> Vec<(Geometry, Mesh, [f64; 3])> {
    let cylinder = Cylinder { radius: 0.1, length: 0.4 };
    vec![
        (
            Geometry::Box(Cuboid { size: [0.1, 0.2, 0.3] }),
            primitives::cuboid([0.1, 0.2, 0.3]),
            [0.0; 3],
        ),
        (Geometry::Cylinder(cylinder.clone()), primitives::cylinder(0.1, 0.4), [0.3, 0.0, 0.0]),
        (Geometry::Cylinder(cylinder), coarse(17, 0.1, 0.4), [0.0, 0.9, 0.0]),
        (
            Geometry::Capsule(Capsule { radius: 0.1, length: 0.4 }),
            primitives::capsule(0.1, 0.4),
            [0.0, 0.1, 0.2],
        ),
        (Geometry::Sphere(Sphere { radius: 0.25 }), primitives::sphere(0.25), [-0.4, 0.0, 0.1]),
    ]
}

#[test]
fn tessellated_shapes_pass_alone_and_together() {
    let all = shapes();
    for one in &all {
        let (expected, found) = of(std::slice::from_ref(one));
        assert_eq!(fault(&expected, &found), None, "{:?}", one.0);
    }
    let (expected, found) = of(&all);
    assert_eq!(fault(&expected, &found), None);
}

/// The faces of a disk's rim are nearer to its flat sides than to the rim's surface.
#[test]
fn thin_shapes_pass_and_their_turned_faces_do_not() {
    for length in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        let disk = Geometry::Cylinder(Cylinder { radius: 1.5, length });
        let plate = Geometry::Box(Cuboid { size: [3.0, length, 2.0] });
        for (shape, mesh) in [
            (disk.clone(), primitives::cylinder(1.5, length)),
            (disk, coarse(17, 1.5, length)),
            (plate, primitives::cuboid([3.0, length, 2.0])),
        ] {
            let (expected, found) = of(&[(shape, mesh, [0.1, 0.0, -0.2])]);
            assert_eq!(fault(&expected, &found), None, "{length}");
            // Thinner than rounding can resolve.
            if length < 1e-3 {
                continue;
            }
            for at in [0, found.triangles.len() / 2, found.triangles.len() - 1] {
                let mut turned = found.clone();
                turned.triangles[at].swap(0, 1);
                assert!(fault(&expected, &turned).is_some(), "{length}: {at}");
            }
        }
    }
}

#[test]
fn what_is_missing_coarse_or_moved_does_not() {
    let all = shapes();
    let (expected, found) = of(&all);
    for at in [0, 20, found.triangles.len() - 1] {
        // A corner moved by a millimetre.
        let mut moved = found.clone();
        moved.vertices[found.triangles[at][0] as usize][1] += 1e-3;
        assert!(fault(&expected, &moved).is_some(), "{at}");
    }
    for at in [0, 20, found.triangles.len() - 1] {
        let mut turned = found.clone();
        turned.triangles[at].swap(0, 1);
        assert!(fault(&expected, &turned).is_some(), "{at}");
    }
    let (_, fewer) = of(&all[..4]);
    assert!(fault(&expected, &fewer).is_some());
    let (one, mut twice) = of(&all[..1]);
    let again = twice.clone();
    twice.append(&again);
    assert!(fault(&one, &twice).is_some());
    let rough = (all[2].0.clone(), coarse(12, 0.1, 0.4), [0.0; 3]);
    let (expected, found) = of(&[rough]);
    assert!(fault(&expected, &found).is_some());
    let inside = Primitive::new(&all[4].0, Matrix3::identity(), [0.0; 3]).expect("a sphere");
    assert!(inside.distance([0.0, 0.0, 0.2]) < 0.0);
}
