//! Inverse kinematics queries in JSON.

use serde::Deserialize;
use serde_json::{Value, json};
use urdd_robot::{InverseSettings, Proximity, Robot, Target, Verdict};

use crate::kind::Kind;
use crate::pose::pose;

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
    /// Weights of the translation and of the rotation about the axes of the target: [`Target::weighted`].
    weights: Option<[f64; 6]>,
    /// A configuration that the solution should be near.
    posture: Option<Vec<f64>>,
    /// The shapes that must not touch one another in the solution.
    pub free_of: Option<Kind>,
    /// Whether to find out why a target is not reached.
    #[serde(default)]
    explain: bool,
    /// Maximum number of restarts.
    #[serde(default)]
    restarts: usize,
}

impl InverseQuestion {
    /// `configuration`, `position_error`, `rotation_error`, `reached`, `verdict`.
    pub fn solve(&self, robot: &Robot, free_of: Option<&Proximity>) -> Result<Value, String> {
        let target = match self.quaternion_wxyz {
            None => Target::position(self.link, self.position),
            Some(quaternion) => Target::pose(self.link, pose(self.position, quaternion)?),
        };
        let settings = InverseSettings {
            restarts: self.restarts,
            locked: self.locked(),
            posture: self.posture.clone(),
            explain: self.explain,
            ..InverseSettings::default()
        };
        let target = match self.weights {
            Some(weights) => target.weighted(weights),
            None => target,
        };
        let target = target.of_point(self.point);
        let is_free = |q: &[f64]| free_of.is_none_or(|shapes| shapes.in_collision(q) == Ok(false));
        let never = Default::default();
        let found = robot.inverse_kinematics_where(&target, &self.q, &settings, &is_free, &never);
        let found = found.map_err(|error| error.to_string())?;
        let solution = found.nearest();
        Ok(json!({
            "configuration": solution.configuration,
            "position_error": solution.position_error,
            "rotation_error": solution.rotation_error,
            "reached": found.is_reached(),
            "verdict": match solution.verdict {
                Verdict::Reached => "reached",
                Verdict::Refused => "refused",
                Verdict::Limits => "limits",
                Verdict::OutOfReach => "out of reach",
                Verdict::Unknown => "unknown",
            },
        }))
    }

    /// The DOFs that may not change: they keep their values in `q`.
    fn locked(&self) -> Vec<usize> {
        let all = 0..self.q.len();
        all.filter(|dof| self.dofs.as_ref().is_some_and(|free| !free.contains(dof))).collect()
    }
}
