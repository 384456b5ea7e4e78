//! The mass of a body, in the axes of its link.

use nalgebra::{Matrix3, Vector3};

use super::super::element::Element;
use super::super::numbers::{number, numbers};
use crate::document::robot::Origin;
use crate::format::urdf::Inertial;

/// Smaller masses and moments MuJoCo takes for none (its mjMINVAL).
const SMALLEST: f64 = 1e-15;

/// An `inertial` element, and whether its moments break the triangle inequality.
pub(super) fn inertial(
    inertial: &Inertial,
    quaternions: bool,
) -> Result<(Element, bool), &'static str> {
    let mass = inertial.mass.as_ref().map_or(0.0, |mass| mass.value);
    if mass < SMALLEST {
        return Err("its mass is not positive, which MuJoCo refuses");
    }
    let origin = Origin::of_v1(inertial.origin.as_ref(), quaternions);
    let i = inertial.inertia.as_ref();
    let i = i.map_or([0.0; 6], |i| {
        [i.ixx, i.iyy, i.izz, i.ixy, i.ixz, i.iyz].map(|element| element.unwrap_or(0.0))
    });
    let rotation = origin.rotation();
    let tensor = Matrix3::new(i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2]);
    let moments = tensor.symmetric_eigenvalues();
    if moments.min() < SMALLEST {
        return Err("its inertia is not positive definite, which MuJoCo refuses");
    }
    let turned = rotation * tensor * rotation.transpose();
    let full = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|at| turned[at]);
    let element = Element::new("inertial")
        .with("pos", numbers(&origin.xyz))
        .with("mass", number(mass))
        .with("fullinertia", numbers(&full));
    Ok((element, breaks_triangle(moments)))
}

/// Whether the largest moment is more than the other two together.
fn breaks_triangle(moments: Vector3<f64>) -> bool {
    2.0 * moments.max() > moments.sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::urdf::{Inertia, Mass};

    fn of(mass: f64, [ixx, iyy, izz]: [f64; 3]) -> Inertial {
        Inertial {
            origin: None,
            mass: Some(Mass { value: mass }),
            inertia: Some(Inertia {
                ixx: Some(ixx),
                ixy: None,
                ixz: None,
                iyy: Some(iyy),
                iyz: None,
                izz: Some(izz),
            }),
        }
    }

    #[test]
    fn what_mujoco_refuses_is_left_out() {
        assert!(inertial(&of(0.0, [1.0; 3]), false).is_err());
        assert!(inertial(&of(1.0, [1.0, 1.0, 0.0]), false).is_err());
        let right = inertial(&of(1.0, [1.0, 1.0, 2.0]), false).expect("inertia");
        assert!(!right.1);
        let broken = inertial(&of(1.0, [1.0, 1.0, 2.1]), false).expect("inertia");
        assert!(broken.1);
    }
}
