//! The bodies of a robot, while they are made.

use std::collections::HashMap;

use nalgebra::Vector3;
use urdd_directory::account::Charged;

use super::super::model::Body;

/// The bodies of the robot, while they are made.
pub struct Made {
    pub bodies: Charged<Body>,
    /// The body of each prim that is one.
    pub index: HashMap<usize, usize>,
    /// Where the frame of each link is in its body: the joint that leads to it is there.
    pub shifts: Vec<Vector3<f64>>,
}
