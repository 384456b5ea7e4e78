//! What was made of the bodies of a model.

use std::collections::HashMap;

use urdd_directory::account::Charged;

use super::super::model::Body;

/// The bodies of the robot, and what each raw one became.
#[derive(Default)]
pub struct Made {
    pub bodies: Charged<Body>,
    /// Whether the first one moves freely.
    pub is_floating: bool,
    /// The index of a raw body's body.
    pub index: HashMap<usize, usize>,
    /// The body and joint of each raw body's joints.
    pub joints: HashMap<(usize, usize), (usize, usize)>,
    /// The body and joint that each follower follows.
    pub leaders: HashMap<(usize, usize), (usize, usize)>,
}
