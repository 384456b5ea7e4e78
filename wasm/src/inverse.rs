//! Inverse kinematics queries in JSON.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use serde::Deserialize;
use serde_json::{Value, json};
use urdd_robot::{InverseSettings, Robot, Target};

/// Searches from `q` for a configuration in which a point of a link is at a position, and the link has a rotation, if
/// given.
#[derive(Deserialize)]
pub struct InverseQuestion {
    q: Vec<f64>,
    link: usize,
    /// In the link's frame; its origin by default.
    #[serde(default)]
    point: [f64; 3],
    /// In the root link's frame.
    position: [f64; 3],
    quaternion_wxyz: Option<[f64; 4]>,
    /// The DOFs that may change; all by default.
    dofs: Option<Vec<usize>>,
    /// Maximum number of restarts.
    #[serde(default)]
    restarts: usize,
}

impl InverseQuestion {
    /// `configuration`, `position_error`, `rotation_error`, `reached`.
    pub fn solve(&self, robot: &Robot) -> Result<Value, String> {
        let target = match self.quaternion_wxyz {
            None => Target::position(self.link, self.position),
            Some([w, x, y, z]) => {
                let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9);
                let turn = turn.ok_or("`quaternion_wxyz` is not a rotation")?;
                let pose = Isometry3::from_parts(Translation3::from(self.position), turn);
                Target::pose(self.link, pose)
            }
        };
        let settings = InverseSettings {
            restarts: self.restarts,
            locked: self.locked(),
            explain: false,
            ..InverseSettings::default()
        };
        let found = robot.inverse_kinematics(&target.of_point(self.point), &self.q, &settings);
        let found = found.map_err(|error| error.to_string())?;
        let solution = found.nearest();
        Ok(json!({
            "configuration": solution.configuration,
            "position_error": solution.position_error,
            "rotation_error": solution.rotation_error,
            "reached": found.is_reached(),
        }))
    }

    /// The DOFs that may not change: they keep their values in `q`.
    fn locked(&self) -> Vec<usize> {
        let all = 0..self.q.len();
        all.filter(|dof| self.dofs.as_ref().is_some_and(|free| !free.contains(dof)))
            .collect()
    }
}
