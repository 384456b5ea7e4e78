//! Geometric Jacobians: the velocity of a point of a link for the velocity of each DOF; of all links at once, or of one by
//! the joints that move it. The torques and forces that hold a robot still against gravity follow from them.

use std::ops::AddAssign;

use nalgebra::{Isometry3, Matrix3, Matrix6xX, Point3, UnitQuaternion, Vector3};

use super::error::ConfigurationError;
use super::forward::{ForwardKinematics, Step, is_finite};
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
        Motion::Float { dofs: [.., a, b, c] } | Motion::Ball { dofs: [a, b, c] } => {
            let vector = [*a, *b, *c];
            let columns = left_jacobian(vector.map(|dof| configuration[dof]));
            for (k, dof) in vector.into_iter().enumerate() {
                turn(dof, frame * columns.column(k));
            }
            if let Motion::Float { dofs: [along @ .., _, _, _] } = &step.motion {
                for (axis, dof) in along.iter().enumerate() {
                    add(*dof, frame * Vector3::ith(axis, 1.0), Vector3::zeros());
                }
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

/// The joints from the root to one link.
#[derive(Debug, Clone)]
pub struct Branch<'a> {
    kinematics: &'a ForwardKinematics,
    link: usize,
    /// In order from the root.
    pub(super) steps: Vec<&'a Step>,
}

/// The pose of a branch's link; reusable for further configurations.
#[derive(Debug, Clone, Default)]
pub struct Place {
    /// The pose of the link in the root link's frame.
    pub pose: Isometry3<f64>,
    /// For each joint, the rotation of its frame and the position of its child link.
    pub(super) joints: Vec<(UnitQuaternion<f64>, Vector3<f64>)>,
}

impl ForwardKinematics {
    /// The joints that move a link; none for the root or a link that does not exist.
    pub fn branch(&self, link: usize) -> Branch<'_> {
        let mut steps: Vec<&Step> = self.path(link).collect();
        steps.reverse();
        Branch { kinematics: self, link, steps }
    }

    /// For each link, the link nearest to the root that no DOF moves against it: links with the same one are one body.
    pub fn rigid_bodies(&self) -> Vec<usize> {
        let mut body: Vec<usize> = (0..self.num_links()).collect();
        // Parents come before children.
        for step in &self.steps {
            if step.motion.dofs().is_empty() {
                body[step.child] = body[step.parent];
            }
        }
        body
    }

    /// The DOFs that move one of two links against the other, ascending: those of the joints between them, and those
    /// that mimic joints between them follow.
    pub fn dofs_between(&self, a: usize, b: usize) -> Vec<usize> {
        let steps = self.steps_between([a, b]);
        let moved = steps.iter().flatten().flat_map(|step| self.steps[*step].motion.dofs());
        let mut dofs: Vec<usize> = moved.copied().collect();
        dofs.sort_unstable();
        dofs.dedup();
        dofs
    }
}

impl Branch<'_> {
    /// Computes the pose of the link. The length of `configuration` must be checked already.
    pub(super) fn place(&self, configuration: &[f64], place: &mut Place) {
        place.joints.clear();
        let mut pose = Isometry3::identity();
        for step in &self.steps {
            let frame = pose * step.origin;
            pose = match &step.motion {
                Motion::Fixed => frame,
                motion => frame * motion.at(configuration),
            };
            place.joints.push((frame.rotation, pose.translation.vector));
        }
        place.pose = pose;
    }

    /// The geometric Jacobian of a point of the link, as [`ForwardKinematics::jacobian`]. The point is in the link's
    /// frame, metres. `jacobian` is column-major, 6 numbers for each DOF.
    ///
    /// # Errors
    /// If the configuration has the wrong length or a value that is not finite, or if the link's pose overflows.
    ///
    /// # Panics
    /// If `jacobian` has fewer than 6 numbers for each DOF.
    pub fn jacobian_into(
        &self,
        configuration: &[f64],
        point: &Point3<f64>,
        place: &mut Place,
        jacobian: &mut [f64],
    ) -> Result<(), ConfigurationError> {
        self.kinematics.check(configuration)?;
        self.place(configuration, place);
        if !is_finite(&place.pose) {
            let link_idx = self.link;
            return Err(ConfigurationError::Overflow { link_idx });
        }
        let point = place.pose * point;
        jacobian.fill(0.0);
        // From the link to the root, as in `ForwardKinematics::jacobian`, so that sums are bit-identical.
        for (step, (frame, child)) in self.steps.iter().zip(&place.joints).rev() {
            columns(step, frame, child, &point, configuration, |dof, linear, angular| {
                add_to(&mut jacobian[6 * dof..6 * dof + 6], linear, angular);
            });
        }
        Ok(())
    }
}

/// A mass, kg, and its moment: the sum of mass times position over its parts, kg m.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Load {
    /// kg.
    pub mass: f64,
    /// kg m, in the root link's frame.
    pub moment: Vector3<f64>,
}

impl Load {
    /// A mass with its centre in the frame of a link with this pose.
    pub fn new(mass: f64, centre: Point3<f64>, pose: &Isometry3<f64>) -> Self {
        Load { mass, moment: mass * (pose * centre).coords }
    }

    /// The centre of mass; `None` without a mass.
    pub fn centre(&self) -> Option<Point3<f64>> {
        (self.mass != 0.0).then(|| Point3::from(self.moment / self.mass))
    }
}

impl AddAssign for Load {
    fn add_assign(&mut self, other: Load) {
        self.mass += other.mass;
        self.moment += other.moment;
    }
}

/// Adds to the load of each link those of all links beyond it. `joints` are the parent and the child link of each joint,
/// from the leaves to the root.
pub fn gather(loads: &mut [Load], joints: impl Iterator<Item = (usize, usize)>) {
    for (parent, child) in joints {
        let beyond = loads[child];
        loads[parent] += beyond;
    }
}

impl ForwardKinematics {
    /// Writes the torque or force of each DOF, N m or N, that holds the robot still against `gravity`, m/s², in the root
    /// link's frame: the derivative of the potential energy with respect to the DOF. A mimic joint counts for the DOF that
    /// it follows.
    ///
    /// `poses` are those of [`link_poses`](Self::link_poses) at `configuration`; `loads` has one entry for each link, and
    /// afterwards what each link carries, itself included.
    ///
    /// # Panics
    /// If `loads` has fewer entries than there are links, or `out` fewer than there are DOFs.
    pub fn gravity_torques_into(
        &self,
        configuration: &[f64],
        poses: &[Isometry3<f64>],
        gravity: &Vector3<f64>,
        loads: &mut [Load],
        out: &mut [f64],
    ) {
        out.fill(0.0);
        gather(loads, self.steps.iter().rev().map(|step| (step.parent, step.child)));
        for step in &self.steps {
            let load = loads[step.child];
            let Some(centre) = load.centre() else { continue };
            let frame = poses[step.parent].rotation * step.origin.rotation;
            let child = &poses[step.child].translation.vector;
            columns(step, &frame, child, &centre, configuration, |dof, linear, _| {
                out[dof] -= load.mass * gravity.dot(&linear);
            });
        }
    }
}
