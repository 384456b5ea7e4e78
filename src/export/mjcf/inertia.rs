//! The mass of a body, in the axes of its link.

use nalgebra::{Matrix3, Vector3};

use super::super::element::Element;
use super::super::numbers::{number, numbers};
use crate::document::robot::Inertial;

/// Smaller masses and moments MuJoCo takes for none (its mjMINVAL).
const SMALLEST: f64 = 1e-15;

/// An `inertial` element, and whether its moments break the triangle inequality.
pub(super) fn inertial(inertial: &Inertial) -> Result<(Element, bool), &'static str> {
    let mass = inertial.mass.unwrap_or(0.0);
    if mass < SMALLEST {
        return Err("its mass is not positive, which MuJoCo refuses");
    }
    let [xx, xy, xz, yy, yz, zz] = inertial.inertia.unwrap_or_default();
    let rotation = inertial.origin.rotation();
    let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let moments = tensor.symmetric_eigenvalues();
    if moments.min() < SMALLEST {
        return Err("its inertia is not positive definite, which MuJoCo refuses");
    }
    let turned = rotation * tensor * rotation.transpose();
    let full = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|at| turned[at]);
    let element = Element::new("inertial")
        .with("pos", numbers(&inertial.origin.xyz))
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
    use crate::document::robot::Origin;

    fn of(mass: f64, [xx, yy, zz]: [f64; 3]) -> Inertial {
        Inertial {
            origin: Origin::default(),
            mass: Some(mass),
            inertia: Some([xx, 0.0, 0.0, yy, 0.0, zz]),
        }
    }

    #[test]
    fn what_mujoco_refuses_is_left_out() {
        assert!(inertial(&of(0.0, [1.0; 3])).is_err());
        assert!(inertial(&of(1.0, [1.0, 1.0, 0.0])).is_err());
        let right = inertial(&of(1.0, [1.0, 1.0, 2.0])).expect("inertia");
        assert!(!right.1);
        let broken = inertial(&of(1.0, [1.0, 1.0, 2.1])).expect("inertia");
        assert!(broken.1);
    }
}
