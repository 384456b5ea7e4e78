//! Orientations: quat, axisangle, xyaxes, zaxis, euler.

use nalgebra::{
    Isometry3, Matrix3, Quaternion, Rotation3, Translation3, Unit, UnitQuaternion, Vector3,
};

use super::super::refusal::{Fallible, at};
use super::compiler::Compiler;
use super::element::Element;
use super::fault::MjcfFault;
use super::reading::{Attributes, View, wrong};

const WAYS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];
/// Vectors that are shorter have no direction.
const SHORT: f64 = 1e-14;

/// Where an element is: `pos` and its orientation.
pub fn pose(view: View<'_>, compiler: &Compiler) -> Fallible<Isometry3<f64>> {
    let position = view.numbers::<3>("pos")?.unwrap_or_default();
    let rotation = orientation(view, compiler)?.unwrap_or_default();
    Ok(Isometry3::from_parts(Translation3::from(position), rotation))
}

/// The orientation of an element, if it or its class says one.
pub fn orientation(view: View<'_>, compiler: &Compiler) -> Fallible<Option<UnitQuaternion<f64>>> {
    for element in view.chain() {
        let mut ways = WAYS.iter().filter(|way| element.get(way).is_some());
        let Some(way) = ways.next() else { continue };
        if ways.next().is_some() {
            let element_name = element.tag.clone();
            return Err(at(element.place, MjcfFault::TwoOrientations { element: element_name }));
        }
        return Ok(Some(match *way {
            "quat" => quaternion(element, "quat")?.unwrap_or_default(),
            "axisangle" => axis_angle(element, compiler)?,
            "xyaxes" => xy_axes(element)?,
            "zaxis" => {
                let [x, y, z] = element.numbers("zaxis")?.unwrap_or_default();
                z_to(direction(element, "zaxis", Vector3::new(x, y, z))?)
            }
            _ => euler(element.numbers("euler")?.unwrap_or_default(), compiler),
        }));
    }
    Ok(None)
}

/// A quaternion, w first.
pub fn quaternion(element: &Element, name: &str) -> Fallible<Option<UnitQuaternion<f64>>> {
    let Some([w, x, y, z]) = element.numbers::<4>(name)? else { return Ok(None) };
    if [w, x, y, z] == [0.0; 4] {
        return Err(wrong(element, name, "a quaternion that is not zero"));
    }
    Ok(Some(unit(Quaternion::new(w, x, y, z))))
}

/// A quaternion of length 1.
pub fn unit(quaternion: Quaternion<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::try_new(quaternion, 1e-15).unwrap_or_default()
}

/// The rotation of Euler angles.
pub fn euler(angles: [f64; 3], compiler: &Compiler) -> UnitQuaternion<f64> {
    let mut rotation = UnitQuaternion::identity();
    for (axis, angle) in compiler.euler.into_iter().zip(angles) {
        let about = match axis.to_ascii_lowercase() {
            'x' => Vector3::x_axis(),
            'y' => Vector3::y_axis(),
            _ => Vector3::z_axis(),
        };
        let turn = UnitQuaternion::from_axis_angle(&about, angle * compiler.angle);
        rotation = if axis.is_ascii_lowercase() { rotation * turn } else { turn * rotation };
    }
    rotation
}

/// The least rotation that takes z to a direction; from -z, half a turn about x.
pub fn z_to(direction: Unit<Vector3<f64>>) -> UnitQuaternion<f64> {
    let across = Vector3::z().cross(&direction);
    let sine = across.norm();
    let axis = if sine < 1e-10 { Vector3::x_axis() } else { Unit::new_normalize(across) };
    UnitQuaternion::from_axis_angle(&axis, sine.atan2(direction.z))
}

fn axis_angle(element: &Element, compiler: &Compiler) -> Fallible<UnitQuaternion<f64>> {
    let [x, y, z, angle] = element.numbers("axisangle")?.unwrap_or_default();
    let axis = direction(element, "axisangle", Vector3::new(x, y, z))?;
    Ok(UnitQuaternion::from_axis_angle(&axis, angle * compiler.angle))
}

fn xy_axes(element: &Element) -> Fallible<UnitQuaternion<f64>> {
    let [a, b, c, d, e, f] = element.numbers("xyaxes")?.unwrap_or_default();
    let x = direction(element, "xyaxes", Vector3::new(a, b, c))?;
    let y = Vector3::new(d, e, f);
    let y = direction(element, "xyaxes", y - x.into_inner() * x.dot(&y))?;
    let axes = Matrix3::from_columns(&[x.into_inner(), y.into_inner(), x.cross(&y)]);
    Ok(UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes)))
}

fn direction(
    element: &Element,
    attribute: &str,
    vector: Vector3<f64>,
) -> Fallible<Unit<Vector3<f64>>> {
    let wanted = "axes that have a direction, and differ";
    Unit::try_new(vector, SHORT).ok_or_else(|| wrong(element, attribute, wanted))
}
