//! Where the robot stands on a floor.

use nalgebra::{Isometry3, Point3, Quaternion, UnitQuaternion};

use crate::{ExportError, Options, Shape, Solid, Subject};
use urdd_directory::account::Account;
use urdd_robot::Robot;

/// Where a free base is in a configuration, as keyframes of MJCF have it: x, y, z in m, and the quaternion w, x, y, z. In a
/// named configuration, where the setup says; otherwise on the floor. `None` where the base is fixed.
///
/// # Errors
/// Those of [`export`](crate::export).
pub fn base_pose(
    robot: &Robot,
    options: &Options,
    name: Option<&str>,
    configuration: &[f64],
) -> Result<Option<[f64; 7]>, ExportError> {
    options.check()?;
    let account = Account::default();
    let subject = Subject::new(robot, options, false, &account)?;
    if !subject.has_free_base() {
        return Ok(None);
    }
    Stand::new(&subject, false)?.base(&subject, name, configuration).map(Some)
}

pub(super) struct Stand {
    /// Height of a free base in the default configuration, m: the lowest shape touches z = 0. 0 without a free base.
    pub base_height: f64,
    /// Height of the floor, m: 0 for a free base, and otherwise at most as high as the lowest shape.
    pub floor: f64,
    /// The shapes of each link, where they are needed.
    shapes: Vec<Vec<Shape>>,
}

impl Stand {
    /// The floor is needed for a scene.
    pub fn new(subject: &Subject, has_floor: bool) -> Result<Self, ExportError> {
        let mut stand = Stand { base_height: 0.0, floor: 0.0, shapes: Vec::new() };
        let is_free = subject.has_free_base();
        if is_free || has_floor {
            let zero = subject.robot.configurations()?.zero();
            stand.shapes = subject.shapes_by_link()?;
            let up = stand.height(subject, &zero)?;
            if is_free { stand.base_height = up } else { stand.floor = (-up).min(0.0) }
        }
        Ok(stand)
    }

    /// Where a free base is in a configuration: x, y, z in m, and the quaternion w, x, y, z. In a named one, where a person
    /// or an import says; otherwise on the floor.
    pub fn base(
        &self,
        subject: &Subject,
        name: Option<&str>,
        configuration: &[f64],
    ) -> Result<[f64; 7], ExportError> {
        let poses = subject.given.as_ref().map(|setup| &setup.base_poses);
        if let Some(pose) = poses.and_then(|poses| poses.get(name?)) {
            if subject.layout.is_empty() {
                return Ok(*pose);
            }
            // Said of the root of the source.
            let [x, y, z, w, i, j, k] = *pose;
            let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k));
            let own = subject.layout.root_at(&subject.robot.link_poses(configuration)?);
            let at = Isometry3::from_parts([x, y, z].into(), turn) * own;
            let (p, q) = (at.translation, at.rotation);
            return Ok([p.x, p.y, p.z, q.w, q.i, q.j, q.k]);
        }
        Ok([0.0, 0.0, self.height(subject, configuration)?, 1.0, 0.0, 0.0, 0.0])
    }

    /// The height of a free base at which the lowest shape touches z = 0, m, to a micrometre.
    fn height(&self, subject: &Subject, configuration: &[f64]) -> Result<f64, ExportError> {
        let poses = subject.link_poses(configuration)?;
        let each = self.shapes.iter().zip(&poses);
        let lowest = each
            .flat_map(|(shapes, pose)| shapes.iter().map(move |shape| lowest(&shape.solid, pose)))
            .fold(f64::INFINITY, f64::min);
        // No shape touches anything.
        Ok(if lowest.is_finite() { (-lowest * 1e6).round() / 1e6 } else { 0.0 })
    }
}

/// The smallest z of a solid, m.
fn lowest(solid: &Solid, pose: &Isometry3<f64>) -> f64 {
    match solid {
        Solid::Convex(mesh) | Solid::Mesh(mesh) => {
            let heights = mesh.vertices.iter().map(|vertex| (pose * Point3::from(*vertex)).z);
            heights.fold(f64::INFINITY, f64::min)
        }
        Solid::Primitive(own, primitive) => {
            let placed = pose * own;
            let rotation = placed.rotation.to_rotation_matrix();
            placed.translation.z - primitive.half_extents(rotation.matrix())[2]
        }
    }
}
