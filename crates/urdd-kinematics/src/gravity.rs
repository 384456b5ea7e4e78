//! The torques and forces that hold a robot still against gravity.

use std::ops::AddAssign;

use nalgebra::{Isometry3, Point3, Vector3};

use super::forward::ForwardKinematics;
use super::jacobian::columns;

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
            let Some(centre) = load.centre() else {
                continue;
            };
            let frame = poses[step.parent].rotation * step.origin.rotation;
            let child = &poses[step.child].translation.vector;
            columns(step, &frame, child, &centre, configuration, |dof, linear, _| {
                out[dof] -= load.mass * gravity.dot(&linear);
            });
        }
    }
}
