use super::super::mesh::Mesh;
use super::super::primitives::{capsule, cuboid, cylinder, sphere};
use super::*;

fn turned(mut mesh: Mesh) -> (ConvexHull, Isometry3<f64>) {
    let turn = UnitQuaternion::from_euler_angles(0.3, -1.1, 2.0);
    let pose = Isometry3::from_parts(Translation3::new(0.5, -0.2, 3.0), turn);
    mesh.transform(&pose.to_homogeneous());
    (ConvexHull::new(&mesh.vertices).unwrap(), pose)
}

/// Of the primitives around a tessellated one, the smallest is that one: its vertices are on the true surface.
#[test]
fn the_smallest_is_the_one_that_was_tessellated() {
    let (radius, half) = (0.3, 0.25);
    for (shape, mesh) in [
        (Primitive::Box([0.1, 0.2, 0.3]), cuboid([0.2, 0.4, 0.6])),
        (Primitive::Cylinder { radius, half }, cylinder(0.3, 0.5)),
        (Primitive::Cylinder { radius: 0.5, half: 0.02 }, cylinder(0.5, 0.04)),
        (Primitive::Capsule { radius, half }, capsule(0.3, 0.5)),
        (Primitive::Sphere { radius }, sphere(0.3)),
    ] {
        let (hull, pose) = turned(mesh);
        let all = Enclosing::around(&hull);
        let least = all
            .iter()
            .min_by(|a, b| a.primitive.volume().partial_cmp(&b.primitive.volume()).unwrap());
        let least = least.unwrap();
        let axes = |of: &Isometry3<f64>, primitive: &Primitive| {
            primitive.half_extents(of.rotation.to_rotation_matrix().matrix())
        };
        assert_eq!(
            std::mem::discriminant(&least.primitive),
            std::mem::discriminant(&shape),
            "{least:?}"
        );
        let away = (least.pose.translation.vector - pose.translation.vector).norm();
        assert!(away < 1e-6, "{shape:?}: {least:?}");
        let [found, known] =
            [axes(&least.pose, &least.primitive), axes(&pose, &shape)].map(Vector3::from);
        assert!((found - known).amax() < 2e-6, "{shape:?}: {least:?}");
        assert!((least.primitive.volume() / shape.volume() - 1.0).abs() < 1e-5);
    }
}

/// No point of a body is outside one of its primitives.
#[test]
fn every_point_is_inside() {
    let mut seed = 7_u64;
    let mut next = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        f64::from(u32::try_from(seed >> 33).unwrap()) / f64::from(1_u32 << 31)
    };
    for size in [4, 5, 20, 100] {
        let points: Vec<[f64; 3]> =
            (0..size).map(|_| [next(), 0.3 * next(), 5.0 * next()]).collect();
        let hull = ConvexHull::new(&points).unwrap();
        for of in Enclosing::around(&hull) {
            for point in &points {
                let p = of.pose.inverse_transform_point(&Point3::from(*point));
                let out = match of.primitive {
                    Primitive::Box(half) => {
                        (0..3).map(|k| p[k].abs() - half[k]).fold(f64::MIN, f64::max)
                    }
                    Primitive::Sphere { radius } => p.coords.norm() - radius,
                    Primitive::Cylinder { radius, half } => {
                        (p.x.hypot(p.y) - radius).max(p.z.abs() - half)
                    }
                    Primitive::Capsule { radius, half } => {
                        let beyond = (p.z.abs() - half).max(0.0);
                        p.x.hypot(p.y).hypot(beyond) - radius
                    }
                };
                assert!(out < 1e-9, "{of:?}: {point:?} is {out} outside");
            }
        }
    }
}

/// What the smallest box may be too large, m: [`OrientedBox::around`] ends its search at 1e-6 of the volume.
const BOX: f64 = 2e-6;

/// Closed forms: how far each kind stands off a cube.
#[test]
fn standoff_is_that_of_the_farthest_point() {
    let (cube, _) = turned(cuboid([2.0, 2.0, 2.0]));
    let (mut kinds, root) = ([0; 4], 2.0_f64.sqrt());
    for of in Enclosing::around(&cube) {
        let found = of.standoff(&cube).unwrap();
        let (kind, low, high) = match of.primitive {
            Primitive::Box(_) => (0, 0.0, BOX),
            // The pole of a sphere is above the middle of a face.
            Primitive::Sphere { radius } => (1, radius - 1.0 - BOX, radius - 1.0 + BOX),
            // A rim is above the middle of a side.
            Primitive::Cylinder { .. } => (2, root - 1.0 - BOX, (root - 1.0) * 1.01),
            // The corners are at the ends of the axis: a half ball of the corners' circle stands on each face.
            Primitive::Capsule { half, .. } => {
                // As far along the axis as a corner is inside the radius, at the square root.
                assert!((half - 1.0).abs() < BOX.sqrt());
                (3, root - BOX.sqrt(), root + BOX)
            }
        };
        kinds[kind] += 1;
        assert!((low..high).contains(&found), "{of:?}: {found}");
        assert!((3.9..26.0).contains(&of.primitive.volume()));
    }
    assert_eq!(kinds, [1, 1, 3, 3]);
}

/// A point that is no part of the body is as far off as it is.
#[test]
fn a_primitive_beside_a_body_stands_off_by_its_distance() {
    let hull = ConvexHull::new(&cuboid([2.0, 2.0, 2.0]).vertices).unwrap();
    let pose = Isometry3::translation(5.0, 0.0, 0.0);
    let of = Enclosing { pose, primitive: Primitive::Sphere { radius: 0.5 } };
    assert!((of.standoff(&hull).unwrap() - 4.5).abs() < 1e-9);
}
