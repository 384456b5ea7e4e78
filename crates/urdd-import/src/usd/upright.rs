//! Turns a robot of a stage whose y is up, so that z is.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

use super::super::mass;
use super::super::model::Model;

/// Turns the axes of all frames alike: what was along y is along z.
pub fn turn(model: &mut Model) {
    let up = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2);
    // Exactly, and not by a quaternion: (x, y, z) becomes (x, -z, y).
    let point = |of: Vector3<f64>| Vector3::new(of.x, -of.z, of.y);
    let turned = |frame: &Isometry3<f64>| {
        let vector = frame.rotation.into_inner().vector().into_owned();
        let [i, j, k]: [f64; 3] = point(vector).into();
        let rotation = nalgebra::Quaternion::new(frame.rotation.w, i, j, k);
        let place = point(frame.translation.vector);
        Isometry3::from_parts(place.into(), UnitQuaternion::new_unchecked(rotation))
    };
    for body in model.bodies.iter_mut() {
        body.pose = turned(&body.pose);
        for joint in body.joints.iter_mut() {
            joint.frame = turned(&joint.frame);
            joint.axis = point(joint.axis);
        }
        for shape in body.shapes.iter_mut() {
            let place = point(shape.pose.translation.vector);
            shape.pose = Isometry3::from_parts(place.into(), up * shape.pose.rotation);
        }
        if let Some(inertial) = &mut body.inertial {
            inertial.centre = Point3::from(point(inertial.centre.coords));
            inertial.inertia = mass::turned(&inertial.inertia, &up);
        }
    }
    for closing in model.closings.iter_mut() {
        for end in &mut closing.ends {
            // Its z is an axis of the loop, which turns with the body.
            let place = point(end.frame.translation.vector);
            end.frame = Isometry3::from_parts(place.into(), up * end.frame.rotation);
        }
    }
}
