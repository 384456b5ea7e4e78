//! Configurations that a program sends for a robot.

use serde::Deserialize;

use crate::collection::Shown;
use crate::reply::Reply;

/// The most values of a configuration of a robot that is not generated yet.
const MAX_VALUES: usize = 100_000;

/// What a program sends.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sent {
    q: Vec<f64>,
}

/// Takes a configuration for a robot from a request.
pub fn take(robot: &Shown, body: &[u8]) -> Reply {
    let Ok(Sent { q }) = serde_json::from_slice::<Sent>(body) else {
        return Reply::failure(400, "expected {\"q\": [...]}, a number for each DOF\n");
    };
    // Of one that is not generated yet, nothing is known.
    let dofs = robot.open().ok().and_then(|(_, opened)| Some(opened.robot.dof_names().ok()?.len()));
    match dofs {
        Some(dofs) if dofs != q.len() => {
            let found = q.len();
            let why = format!("expected one value for each DOF, so {dofs}; found {found}\n");
            Reply::failure(400, why)
        }
        None if q.len() > MAX_VALUES => Reply::failure(400, "too many values\n"),
        _ => {
            robot.states.set(&q);
            Reply::nothing()
        }
    }
}
