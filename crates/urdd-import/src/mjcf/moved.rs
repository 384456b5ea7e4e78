//! What joints move: the mass that an actuator feels, which MuJoCo makes ratios of damping with.

use std::collections::HashMap;

use nalgebra::{Isometry3, Matrix3, Matrix6, Vector3, Vector6};

use super::super::mass::turned;
use super::super::model::{Body, Inertial, Joint, JointKind};

/// What the joints of a robot move, where all are at their references. Six numbers are a turn and a shift in the frame of
/// the first body, or a torque about its origin and a force.
pub struct Moved {
    freedoms: Vec<Freedom>,
    /// The last freedom of each joint.
    of: HashMap<(usize, usize), usize>,
}

/// One degree of freedom.
struct Freedom {
    /// The next one on the way to the base.
    above: Option<usize>,
    axis: Vector6<f64>,
    /// The inertia of what hangs on it, while all freedoms further out are free.
    inertia: Matrix6<f64>,
    /// What a unit of acceleration along its axis takes, and the part of it along the axis, with that of its motor.
    force: Vector6<f64>,
    mass: f64,
}

impl Moved {
    pub fn of(bodies: &[Body], is_floating: bool) -> Self {
        let mut moved = Moved { freedoms: Vec::new(), of: HashMap::new() };
        let mut known: Vec<(Isometry3<f64>, Option<usize>)> = Vec::new();
        for (index, Body { parent, pose, joints, inertial, .. }) in bodies.iter().enumerate() {
            let above = parent.and_then(|parent| known.get(parent).copied());
            let (above, mut last) = above.unwrap_or_default();
            let pose = above * pose;
            if parent.is_none() && is_floating {
                let all = Matrix6::<f64>::identity();
                last = moved.push(last, all.column_iter().map(|axis| axis.into_owned()), 0.0);
            }
            for (number, joint) in joints.iter().enumerate() {
                let armature = joint.armature.unwrap_or(0.0);
                last = moved.push(last, axes(joint, &pose).into_iter(), armature);
                moved.of.extend(last.map(|last| ((index, number), last)));
            }
            if let (Some(last), Some(inertial)) = (last, inertial) {
                moved.freedoms[last].inertia += rigid(inertial, &pose);
            }
            known.push((pose, last));
        }
        moved.pass_on();
        moved
    }

    /// Adds freedoms behind one, and returns the last.
    fn push(
        &mut self,
        mut above: Option<usize>,
        axes: impl Iterator<Item = Vector6<f64>>,
        armature: f64,
    ) -> Option<usize> {
        for axis in axes {
            let (inertia, force) = (Matrix6::zeros(), Vector6::zeros());
            self.freedoms.push(Freedom { above, axis, inertia, force, mass: armature });
            above = Some(self.freedoms.len() - 1);
        }
        above
    }

    /// Adds to each freedom what those further out do not take: the articulated inertias of Featherstone's algorithm.
    fn pass_on(&mut self) {
        for index in (0..self.freedoms.len()).rev() {
            let of = &mut self.freedoms[index];
            of.force = of.inertia * of.axis;
            of.mass += of.axis.dot(&of.force);
            let mut passed = of.inertia;
            if of.mass > 0.0 {
                passed -= of.force * of.force.transpose() / of.mass;
            } else {
                // Nothing moves along it.
                (of.force, of.mass) = (Vector6::zeros(), f64::INFINITY);
            }
            if let Some(above) = of.above {
                self.freedoms[above].inertia += passed;
            }
        }
    }

    /// The inertia about the axis of a joint, kg m², or the mass along it, kg, that a force at it feels while all other
    /// joints are free; 0 if there is none.
    pub fn by(&self, joint: (usize, usize)) -> f64 {
        let mut next = self.of.get(&joint).copied();
        let (mut forces, mut felt) = (Vec::new(), Vector6::zeros());
        while let Some(of) = next.map(|index| &self.freedoms[index]) {
            let force = if forces.is_empty() { 1.0 } else { -of.axis.dot(&felt) };
            felt += of.force * (force / of.mass);
            forces.push((of, force));
            next = of.above;
        }
        let (mut motion, mut speed) = (Vector6::zeros(), 0.0);
        for (of, force) in forces.into_iter().rev() {
            speed = (force - of.force.dot(&motion)) / of.mass;
            motion += of.axis * speed;
        }
        if speed > 0.0 { speed.recip() } else { 0.0 }
    }
}

/// The axes of a joint of a body that is at a pose.
fn axes(joint: &Joint, pose: &Isometry3<f64>) -> Vec<Vector6<f64>> {
    let frame = pose * joint.frame;
    let axis = frame.rotation * joint.axis.try_normalize(0.0).unwrap_or_default();
    let six = |turn: Vector3<f64>, shift: Vector3<f64>| {
        Vector6::new(turn.x, turn.y, turn.z, shift.x, shift.y, shift.z)
    };
    let about = |axis: Vector3<f64>| six(axis, frame.translation.vector.cross(&axis));
    match joint.kind {
        JointKind::Hinge => vec![about(axis)],
        JointKind::Slide => vec![six(Vector3::zeros(), axis)],
        JointKind::Ball => [Vector3::x(), Vector3::y(), Vector3::z()].map(about).into(),
        // MJCF has neither.
        JointKind::Planar | JointKind::Floating => Vec::new(),
    }
}

/// The inertia of a body that is at a pose.
fn rigid(inertial: &Inertial, pose: &Isometry3<f64>) -> Matrix6<f64> {
    let arm = (pose * inertial.centre).coords.cross_matrix();
    let moments = turned(&inertial.inertia, &pose.rotation);
    let mut all = Matrix6::zeros();
    let parts: [(_, Matrix3<f64>); 4] = [
        ((0, 0), moments + arm * arm.transpose() * inertial.mass),
        ((0, 3), arm * inertial.mass),
        ((3, 0), arm.transpose() * inertial.mass),
        ((3, 3), Matrix3::identity() * inertial.mass),
    ];
    for (at, part) in parts {
        all.fixed_view_mut::<3, 3>(at.0, at.1).copy_from(&part);
    }
    all
}
