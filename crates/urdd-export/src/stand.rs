//! Where the robot stands on a floor.

use nalgebra::{Isometry3, Point3};

use super::error::ExportError;
use super::subject::Subject;
use urdd_robot::{LinkShape, Solid};

/// Where the robot stands.
pub(super) struct Stand {
    /// Height of a free base in the default configuration, m: the lowest shape touches z = 0. 0 without a free base.
    pub base_height: f64,
    /// Height of the floor, m: 0 for a free base, and otherwise at most as high as the lowest shape.
    pub floor: f64,
    /// All shapes, where they are needed.
    shapes: Vec<LinkShape>,
}

impl Stand {
    /// The floor is needed for a scene.
    pub fn new(subject: &Subject, has_floor: bool) -> Result<Self, ExportError> {
        let mut stand = Stand { base_height: 0.0, floor: 0.0, shapes: Vec::new() };
        let is_free = subject.has_free_base();
        if is_free || has_floor {
            let zero = subject.robot.configurations()?.zero();
            stand.shapes = subject.shapes(subject.shapes)?;
            let up = stand.height(subject, &zero)?;
            if is_free { stand.base_height = up } else { stand.floor = (-up).min(0.0) }
        }
        Ok(stand)
    }

    /// The height of a free base at which the lowest shape touches z = 0, m, to a micrometre.
    pub fn height(&self, subject: &Subject, configuration: &[f64]) -> Result<f64, ExportError> {
        let poses = subject.link_poses(configuration)?;
        let lowest = self
            .shapes
            .iter()
            .map(|shape| lowest(&shape.solid, &poses[shape.link]))
            .fold(f64::INFINITY, f64::min);
        // No shape touches anything.
        Ok(if lowest.is_finite() { (-lowest * 1e6).round() / 1e6 } else { 0.0 })
    }
}

/// The smallest z of a solid, m.
fn lowest(solid: &Solid, pose: &Isometry3<f64>) -> f64 {
    match solid {
        Solid::Mesh(mesh) => {
            let heights = mesh.vertices.iter().map(|vertex| (pose * Point3::from(*vertex)).z);
            heights.fold(f64::INFINITY, f64::min)
        }
        Solid::Box { pose: own, half_extents } => {
            let placed = pose * own;
            let axes = placed.rotation.to_rotation_matrix();
            let reach = (0..3).map(|k| axes[(2, k)].abs() * half_extents[k]);
            placed.translation.z - reach.sum::<f64>()
        }
        Solid::Sphere { centre, radius } => (pose * Point3::from(*centre)).z - radius,
    }
}
