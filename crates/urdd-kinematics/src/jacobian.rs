//! Geometric Jacobians: the velocity of a point of a link for the velocity of each DOF.

use nalgebra::{Isometry3, Matrix3, Matrix6xX, Point3, UnitQuaternion, Vector3};

use super::forward::{ForwardKinematics, Step};
use super::joint::Motion;

impl ForwardKinematics {
    /// The geometric Jacobian of a point that moves with a link: 6 rows, one column per DOF.
    ///
    /// Multiplied by the DOF velocities, it gives the velocity of the point (rows 0 to 2, m/s) and the angular velocity
    /// of the link (rows 3 to 5, rad/s), both in the axes of the root link's frame. `poses` are those of
    /// [`link_poses`](Self::link_poses) at `configuration`; `point` is in the root link's frame, metres. The
    /// coordinates of floating and spherical joints are rotation vectors; their columns are derivatives with respect to
    /// the vector's components. The Jacobian of a link that does not exist is zero.
    pub fn jacobian(
        &self,
        configuration: &[f64],
        poses: &[Isometry3<f64>],
        link: usize,
        point: &Point3<f64>,
    ) -> Matrix6xX<f64> {
        let mut jacobian = Matrix6xX::zeros(self.num_dofs());
        self.jacobian_into(configuration, poses, link, point, jacobian.as_mut_slice());
        jacobian
    }

    /// As [`ForwardKinematics::jacobian`], into `out`: column-major, 6 numbers for each DOF.
    ///
    /// # Panics
    /// If `out` has fewer than 6 numbers for each DOF.
    pub fn jacobian_into(
        &self,
        configuration: &[f64],
        poses: &[Isometry3<f64>],
        link: usize,
        point: &Point3<f64>,
        out: &mut [f64],
    ) {
        out.fill(0.0);
        let mut add = |dof: usize, linear, angular| {
            add_to(&mut out[6 * dof..6 * dof + 6], linear, angular);
        };
        for step in self.path(link) {
            let frame = poses[step.parent].rotation * step.origin.rotation;
            let child = &poses[step.child].translation.vector;
            columns(step, &frame, child, point, configuration, &mut add);
        }
    }
}

/// Adds a linear and an angular velocity to a column of 6 numbers.
pub(super) fn add_to(column: &mut [f64], linear: Vector3<f64>, angular: Vector3<f64>) {
    for axis in 0..3 {
        column[axis] += linear[axis];
        column[axis + 3] += angular[axis];
    }
}

/// Calls `add` for each DOF of one joint between the point's link and the root, with the velocity of the point and the
/// angular velocity of the link.
///
/// `frame` is the rotation of the joint frame and `child` the position of its child link, both in the root link's
/// frame.
pub(super) fn columns(
    step: &Step,
    frame: &UnitQuaternion<f64>,
    child: &Vector3<f64>,
    point: &Point3<f64>,
    configuration: &[f64],
    mut add: impl FnMut(usize, Vector3<f64>, Vector3<f64>),
) {
    let arm = point.coords - child;
    let mut turn = |dof: usize, angular: Vector3<f64>| add(dof, angular.cross(&arm), angular);
    match &step.motion {
        Motion::Fixed => {}
        Motion::Turn { axis, position } => {
            if let Some(dof) = position.dof {
                turn(dof, frame * axis.into_inner() * position.multiplier);
            }
        }
        Motion::Slide { axis, position } => {
            if let Some(dof) = position.dof {
                let along = frame * axis.into_inner() * position.multiplier;
                add(dof, along, Vector3::zeros());
            }
        }
        Motion::Plane { axis, basis: [x, y], dofs: [along_x, along_y, angle] } => {
            turn(*angle, frame * axis.into_inner());
            add(*along_x, frame * x, Vector3::zeros());
            add(*along_y, frame * y, Vector3::zeros());
        }
        Motion::Float { dofs: [x, y, z, a, b, c] } => {
            let vector = [*a, *b, *c].map(|dof| configuration[dof]);
            let columns = left_jacobian(vector);
            for (k, dof) in [*a, *b, *c].into_iter().enumerate() {
                turn(dof, frame * columns.column(k));
            }
            for (axis, dof) in [*x, *y, *z].into_iter().enumerate() {
                add(dof, frame * Vector3::ith(axis, 1.0), Vector3::zeros());
            }
        }
        Motion::Ball { dofs } => {
            let columns = left_jacobian(dofs.map(|dof| configuration[dof]));
            for (k, dof) in dofs.iter().enumerate() {
                turn(*dof, frame * columns.column(k));
            }
        }
    }
}

/// The angular velocity for the derivative of each component of a rotation vector, as columns.
///
/// Source: T. Barfoot, State Estimation for Robotics (2017), 7.1.5: the left Jacobian of SO(3).
fn left_jacobian(vector: [f64; 3]) -> Matrix3<f64> {
    let vector = Vector3::from(vector);
    let angle = vector.norm();
    let cross = vector.cross_matrix();
    let square = angle * angle;
    // Use series for small angles, where the differences would lose precision.
    let (first, second) = if angle < 1e-2 {
        (
            0.5 - square / 24.0 + square * square / 720.0,
            1.0 / 6.0 - square / 120.0 + square * square / 5040.0,
        )
    } else {
        ((1.0 - angle.cos()) / square, (angle - angle.sin()) / (square * angle))
    };
    Matrix3::identity() + cross * first + cross * cross * second
}
