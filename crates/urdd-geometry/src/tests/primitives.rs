use super::*;
use nalgebra::Rotation3;

/// The extents agree with those of tessellated shapes, up to the tessellation.
#[test]
fn extents_are_those_of_the_surfaces() {
    let (radius, half) = (0.3, 0.25);
    let turn = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
    for (shape, mut mesh) in [
        (Primitive::Box([0.1, 0.2, 0.3]), cuboid([0.2, 0.4, 0.6])),
        (Primitive::Cylinder { radius, half }, cylinder(0.3, 0.5)),
        (Primitive::Capsule { radius, half }, capsule(0.3, 0.5)),
        (Primitive::Sphere { radius }, sphere(0.3)),
    ] {
        mesh.transform(&turn.to_homogeneous());
        let (found, bounds) = (shape.half_extents(turn.matrix()), mesh.bounds().unwrap());
        for (axis, reach) in found.into_iter().enumerate() {
            for end in [-bounds.min[axis], bounds.max[axis]] {
                let beyond = reach - end;
                assert!((-1e-12..0.004).contains(&beyond), "{shape:?}: {found:?}");
            }
        }
    }
}
