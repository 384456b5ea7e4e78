//! The inertia that an actuator moves: that of all that hangs on a joint, where joints are at their references.

use nalgebra::{Isometry3, Matrix3, Vector3};

use super::super::model::{Body, Joint, JointKind};

/// The bodies of a robot in its root, each with what hangs on it.
pub struct Reflected {
    poses: Vec<Isometry3<f64>>,
    hanging: Vec<Mass>,
}

/// Mass, mass times place, and the sum of mass times place times place.
#[derive(Clone, Copy)]
struct Mass {
    mass: f64,
    first: Vector3<f64>,
    second: Matrix3<f64>,
}

impl Reflected {
    /// What hangs on each body.
    pub fn of(bodies: &[Body]) -> Self {
        let mut poses: Vec<Isometry3<f64>> = Vec::with_capacity(bodies.len());
        for body in bodies {
            poses.push(body.parent.map_or(body.pose, |parent| poses[parent] * body.pose));
        }
        let own = bodies.iter().zip(&poses).map(|(body, pose)| {
            let Some(of) = &body.inertial else {
                return Mass { mass: 0.0, first: Vector3::zeros(), second: Matrix3::zeros() };
            };
            let centre = (pose * of.centre).coords;
            let turn = pose.rotation.to_rotation_matrix();
            let inertia = turn.matrix() * of.inertia * turn.matrix().transpose();
            let spread = Matrix3::identity() * (inertia.trace() / 2.0) - inertia;
            Mass {
                mass: of.mass,
                first: centre * of.mass,
                second: spread + centre * centre.transpose() * of.mass,
            }
        });
        let mut hanging: Vec<Mass> = own.collect();
        for index in (0..bodies.len()).rev() {
            if let Some(parent) = bodies[index].parent {
                let Mass { mass, first, second } = hanging[index];
                hanging[parent].mass += mass;
                hanging[parent].first += first;
                hanging[parent].second += second;
            }
        }
        Reflected { poses, hanging }
    }

    /// What a joint of a body moves, and its armature.
    pub fn inertia(&self, body: usize, joint: &Joint) -> f64 {
        let Mass { mass, first, second } = self.hanging[body];
        let armature = joint.armature.unwrap_or(0.0);
        if joint.kind == JointKind::Slide {
            return mass + armature;
        }
        let frame = self.poses[body] * joint.frame;
        let (at, axis) = (frame.translation.vector, frame.rotation * joint.axis);
        let about = second - first * at.transpose() - at * first.transpose() + at * at.transpose() * mass;
        about.trace() - axis.dot(&(about * axis)) + armature
    }
}
