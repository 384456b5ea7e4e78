//! Queries on kinematic loops in JSON.

use serde::Deserialize;
use serde_json::{Value, json};
use urdd_format::loops::{Coupling, Loop};
use urdd_robot::{CloseSettings, Robot, RobotError};

/// A query. `q` is a configuration, rad or m.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LoopQuestion {
    /// `gaps` (`position` in m, `rotation` in rad), `sums` of the couplings, `is_closed`.
    Errors { q: Vec<f64> },
    /// The nearest closed configuration: `configuration`, `is_closed`. The DOFs of `held` keep their values.
    Close {
        q: Vec<f64>,
        #[serde(default)]
        held: Vec<usize>,
    },
    /// The DOFs that move freely there, and those that follow: `independent`, `dependent`.
    FreeDofs { q: Vec<f64> },
    /// What is not 0 that should be, of each equation.
    Residuals { q: Vec<f64> },
    /// The derivatives of the equations: a list of one number for each DOF, for each equation.
    Jacobian { q: Vec<f64> },
    /// The velocities of all DOFs for those of the independent ones; null where they do not follow.
    Velocities { q: Vec<f64>, independent: Vec<f64> },
}

impl LoopQuestion {
    /// The answer.
    pub fn answer(&self, robot: &Robot) -> Result<Value, RobotError> {
        Ok(match self {
            LoopQuestion::Errors { q } => {
                let errors = robot.loop_errors(q)?;
                let gaps = errors.gaps.iter();
                let gap = gaps
                    .map(|gap| json!({ "position": gap.position, "rotation": gap.rotation }))
                    .collect::<Vec<_>>();
                json!({ "gaps": gap, "sums": errors.sums, "is_closed": errors.is_closed })
            }
            LoopQuestion::Close { q, held } => {
                let mut configuration = q.clone();
                let settings = CloseSettings { held, ..CloseSettings::default() };
                let is_closed = robot.close_into(&mut configuration, &settings)?;
                json!({ "configuration": configuration, "is_closed": is_closed })
            }
            LoopQuestion::FreeDofs { q } => {
                let mobility = robot.free_dofs(q)?;
                json!({ "independent": mobility.independent, "dependent": mobility.dependent })
            }
            LoopQuestion::Residuals { q } => json!(robot.loop_residuals(q)?),
            LoopQuestion::Jacobian { q } => {
                let jacobian = robot.loop_jacobian(q)?;
                let rows = jacobian.row_iter();
                rows.map(|row| json!(row.iter().collect::<Vec<_>>())).collect()
            }
            LoopQuestion::Velocities { q, independent } => {
                json!(robot.loop_velocities(q, independent)?)
            }
        })
    }
}

/// What closes the loops of a robot, for its description; null for a tree.
/// `loops`: `name`, `kind`, `links`, `frames` (each with `position` and `quaternion_wxyz`, in its link's frame), and
/// `tolerances` (m, rad); `couplings`: `name`; `independent` DOFs, and the closed `reference`.
pub fn about(robot: &Robot) -> Result<Value, RobotError> {
    let Some(module) = robot.loops()? else { return Ok(Value::Null) };
    let of_loop = |one: &Loop| {
        json!({
            "name": one.name,
            "kind": one.kind,
            "links": [one.link_a_idx, one.link_b_idx],
            "frames": [one.frame_a, one.frame_b],
            "tolerances": [one.position_tolerance, one.rotation_tolerance],
        })
    };
    let of_coupling = |one: &Coupling| {
        let dofs: Vec<_> = one.terms.iter().map(|term| term.dof_idx).collect();
        json!({ "name": one.name, "dofs": dofs })
    };
    Ok(json!({
        "loops": module.loops.iter().map(of_loop).collect::<Vec<_>>(),
        "couplings": module.couplings.iter().map(of_coupling).collect::<Vec<_>>(),
        "independent": module.independent_dof_idxs,
        "reference": module.reference_configuration,
    }))
}
