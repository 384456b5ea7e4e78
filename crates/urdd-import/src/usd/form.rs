//! What the shapes of USD are in a model: primitives, and meshes where these are stretched.

use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};
use urdd_geometry::mesh::Bounds;
use urdd_geometry::{Mesh, primitives};
use urdd_kinematics::rotation::from_z;
use urdd_usd::Prim;

use super::super::cone::cone;
use super::super::features::{self, Tally};
use super::super::model::Geometry;
use super::scene::{number, word};

/// Two scales that differ by less are one: those of single precision.
const NEAR: f64 = 1e-5;
/// A shape in the frame of its prim.
#[derive(Debug)]
pub enum Form {
    /// Where it is there, and what it is.
    Plain(Isometry3<f64>, Geometry),
    Meshed(Mesh),
    Nothing,
}

/// A shape that is not a mesh, stretched.
pub fn form(of: &Prim, stretch: &Matrix3<f64>, tally: &mut Tally) -> Form {
    let value = |name: &str, none: f64| number(of, name).unwrap_or(none);
    let is_straight = stretch.clone_owned() == Matrix3::from_diagonal(&stretch.diagonal());
    let scale = stretch.diagonal().abs();
    let axis = match word(of, "axis") {
        Some("X") => 0,
        Some("Y") => 1,
        _ => 2,
    };
    let along = from_z(&Vector3::ith(axis, 1.0));
    let pose = Isometry3::from_parts(Translation3::identity(), along);
    let [a, b] = [scale[(axis + 1) % 3], scale[(axis + 2) % 3]];
    let is_round = is_straight && (a - b).abs() <= NEAR * a.max(b);
    let is_even = is_round && (a - scale[axis]).abs() <= NEAR * a.max(scale[axis]);
    // As a mesh along z, which is turned, then stretched.
    let stretched = |mut mesh: Mesh, along: &UnitQuaternion<f64>| {
        mesh.transform(&(stretch * along.to_rotation_matrix().matrix()).to_homogeneous());
        Form::Meshed(mesh)
    };
    let (still, unturned) = (Isometry3::identity(), UnitQuaternion::identity());
    match &*of.type_name {
        "Cube" => {
            let size = value("size", 2.0);
            tally.count(features::BOXES);
            match is_straight {
                true => Form::Plain(still, Geometry::Box((scale * size).into())),
                false => stretched(primitives::cuboid([size; 3]), &unturned),
            }
        }
        "Sphere" => {
            let radius = value("radius", 1.0);
            tally.count(if is_even { features::BOXES } else { features::ELLIPSOIDS });
            match (is_even, is_straight) {
                (true, _) => Form::Plain(still, Geometry::Sphere(radius * scale.x)),
                (_, true) => Form::Plain(still, Geometry::Ellipsoid((scale * radius).into())),
                _ => stretched(primitives::sphere(radius), &unturned),
            }
        }
        "Cylinder" | "Cylinder_1" => {
            let radius = [value("radius", 1.0), value("radiusTop", 1.0)]
                [usize::from(of.type_name.ends_with('1'))];
            let height = value("height", 2.0);
            tally.count(features::BOXES);
            match is_round {
                true => Form::Plain(
                    pose,
                    Geometry::Cylinder { radius: radius * a, length: height * scale[axis] },
                ),
                false => stretched(primitives::cylinder(radius, height), &along),
            }
        }
        "Capsule" | "Capsule_1" => {
            let radius = [value("radius", 0.5), value("radiusTop", 0.5)]
                [usize::from(of.type_name.ends_with('1'))];
            let height = value("height", 1.0);
            tally.count(features::CAPSULES);
            match is_even {
                true => Form::Plain(
                    pose,
                    Geometry::Capsule { radius: radius * a, length: height * scale[axis] },
                ),
                false => stretched(primitives::capsule(radius, height), &along),
            }
        }
        "Cone" => {
            let (radius, height) = (value("radius", 1.0), value("height", 2.0));
            tally.count(features::CONES);
            let mut mesh = cone();
            mesh.transform(
                &Matrix3::from_diagonal(&Vector3::new(radius, radius, height)).to_homogeneous(),
            );
            stretched(mesh, &along)
        }
        "Plane" => {
            tally.count(features::SURFACES);
            Form::Nothing
        }
        _ => {
            tally.count(features::OTHER_SHAPES);
            Form::Nothing
        }
    }
}

/// The box around a mesh, or what is made of its middle.
pub fn bounding(mesh: &Mesh, of: impl Fn([f64; 3]) -> Geometry) -> Form {
    let Some(bounds) = mesh.bounds() else { return Form::Nothing };
    Form::Plain(Translation3::from(middle(&bounds)).into(), of(bounds.size()))
}

fn middle(bounds: &Bounds) -> Vector3<f64> {
    (Vector3::from(bounds.min) + Vector3::from(bounds.max)) / 2.0
}

/// How far a mesh is from the middle of its box.
pub fn reach(mesh: &Mesh) -> f64 {
    let middle = mesh.bounds().map_or_else(Vector3::zeros, |bounds| middle(&bounds));
    mesh.vertices.iter().map(|point| (Vector3::from(*point) - middle).norm()).fold(0.0, f64::max)
}
