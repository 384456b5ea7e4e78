//! Inverse kinematics queries in JSON.

use serde::Deserialize;
use serde_json::{Value, json};
use urdd_robot::{InverseSettings, Proximity, Queries, Robot, RobotError, Target, Verdict, World};

use crate::bodies::{Attached, Body, pose};
use crate::collisions::Kind;

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
    /// Obstacles that the shapes of `free_of`, or pieces, must not touch in the solution.
    pub obstacles: Option<Vec<Body>>,
    /// What links carry: it counts with the shapes.
    #[serde(default)]
    pub attached: Vec<Attached>,
    /// The distance that the solution keeps from obstacles, metres.
    #[serde(default)]
    margin: f64,
    /// Whether the kinematic loops of the robot may be open in the solution.
    #[serde(default)]
    open_loops: bool,
    /// Whether to find out why a target is not reached.
    #[serde(default)]
    explain: bool,
    /// Maximum number of restarts.
    #[serde(default)]
    restarts: usize,
}

impl InverseQuestion {
    /// `configuration`, `position_error`, `rotation_error`, `reached`, `verdict`. `shapes` are those of `free_of`, and
    /// `world` has the obstacles.
    pub fn solve(
        &self,
        robot: &Robot,
        shapes: Option<&Proximity>,
        world: &World,
    ) -> Result<Value, String> {
        let said = |error: RobotError| error.to_string();
        let count = self.q.len();
        if let Some(dof) = self.dofs.iter().flatten().find(|dof| **dof >= count) {
            return Err(format!("DOF {dof} is out of range: there are {count}"));
        }
        let around =
            shapes.map(|shapes| shapes.world_proximity(world)).transpose().map_err(said)?;
        if let Some(around) = &around {
            around.is_within(&self.q, self.margin).map_err(said)?;
        }
        let target = match self.quaternion_wxyz {
            None => Target::position(self.link, self.position),
            Some(quaternion) => Target::pose(self.link, pose(self.position, quaternion)?),
        };
        let settings = InverseSettings {
            restarts: self.restarts,
            locked: self.locked(),
            posture: self.posture.clone(),
            explain: self.explain,
            open_loops: self.open_loops,
            ..InverseSettings::default()
        };
        let target = match self.weights {
            Some(weights) => target.weighted(weights),
            None => target,
        };
        let target = target.of_point(self.point);
        let itself = shapes.filter(|_| self.free_of.is_some());
        let is_free = |q: &[f64]| {
            itself.is_none_or(|shapes| shapes.in_collision(q) == Ok(false))
                && (around.as_ref())
                    .is_none_or(|world| world.is_within(q, self.margin) == Ok(false))
        };
        let never = Default::default();
        let found = robot.inverse_kinematics_where(&target, &self.q, &settings, &is_free, &never);
        let found = found.map_err(said)?;
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
                Verdict::Loops => "loops",
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
