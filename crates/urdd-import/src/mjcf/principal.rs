//! Principal moments and axes of inertia, in the order in which MuJoCo has them.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};

/// Elements beside the diagonal that are smaller, as a part of the greatest moment, are 0.
const SMALL: f64 = 1e-16;
/// Moments that differ by less, as a part of the greatest, are equal.
const EQUAL: f64 = 1e-12;
/// Rounds of Jacobi's method. A handful is enough.
const MOST: usize = 100;

/// The moments, the greatest first, and the rotation to their axes. It matters which axes of equal moments are chosen
/// where a primitive is fitted to a mesh; so this is Jacobi's method, which turns away the greatest element first.
pub fn principal(inertia: &Matrix3<f64>) -> ([f64; 3], UnitQuaternion<f64>) {
    let mut axes = UnitQuaternion::identity();
    let mut values = [0.0; 3];
    let size = inertia.amax();
    for _ in 0..MOST {
        let basis = axes.to_rotation_matrix();
        let turned = basis.matrix().transpose() * inertia * basis.matrix();
        values = [0, 1, 2].map(|axis| turned[(axis, axis)]);
        let beside = |row, column| turned[(row, column)].abs();
        let (row, column, about) = if beside(0, 1) > beside(0, 2) && beside(0, 1) > beside(1, 2) {
            (0, 1, 2)
        } else if beside(0, 2) > beside(1, 2) {
            (0, 2, 1)
        } else {
            (1, 2, 0)
        };
        if beside(row, column) <= SMALL * size {
            break;
        }
        let tau = (values[column] - values[row]) / (2.0 * turned[(row, column)]);
        let tangent = tau.signum() / (tau.abs() + (1.0 + tau * tau).sqrt());
        let angle = if about == 1 { tangent.atan() } else { -tangent.atan() };
        axes *= turn(about, angle);
    }
    for first in [0, 1, 0] {
        if values[first] + EQUAL * size < values[first + 1] {
            values.swap(first, first + 1);
            axes *= turn((first + 2) % 3, std::f64::consts::FRAC_PI_2);
        }
    }
    (values, axes)
}

fn turn(about: usize, angle: f64) -> UnitQuaternion<f64> {
    let axes = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()];
    UnitQuaternion::from_axis_angle(&axes[about], angle)
}
