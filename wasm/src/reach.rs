//! Inverse kinematics queries in JSON.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use serde_json::{Value, json};
use urdd_robot::{InverseSettings, Robot, Target};

/// Searches from `q` for a configuration in which a point of a link is at `position`, and the link has the rotation
/// `quaternion_wxyz`, if given. `dofs` lists those that may change (default: all). `restarts` is the maximum number of
/// restarts.
pub fn reach(robot: &Robot, q: &[f64], question: &Value) -> Result<Value, String> {
    let link = usize::try_from(question["link"].as_u64().ok_or("`link` is no index")?);
    let link = link.map_err(|error| error.to_string())?;
    let position: [f64; 3] = numbers(question, "position")?.ok_or("`position` is missing")?;
    let point = numbers(question, "point")?.unwrap_or([0.0; 3]);
    let target = match numbers(question, "quaternion_wxyz")? {
        None => Target::position(link, position),
        Some([w, x, y, z]) => {
            let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9);
            let turn = turn.ok_or("`quaternion_wxyz` is no rotation")?;
            let [x, y, z] = position;
            let pose = Isometry3::from_parts(Translation3::new(x, y, z), turn);
            Target::pose(link, pose)
        }
    };
    let restarts = question["restarts"].as_u64().unwrap_or(0);
    let settings = InverseSettings {
        restarts: usize::try_from(restarts).unwrap_or(usize::MAX),
        bounds: bounds(robot, q, question)?,
        ..InverseSettings::default()
    };
    let found = robot.inverse_kinematics(&target.of_point(point), q, &settings);
    let found = found.map_err(|error| error.to_string())?;
    let solution = found.nearest();
    Ok(json!({
        "configuration": solution.configuration,
        "position_error": solution.position_error,
        "rotation_error": solution.rotation_error,
        "reached": found.is_reached(),
    }))
}

/// The robot's bounds, where a DOF that may not change is fixed to its value in `q`.
fn bounds(robot: &Robot, q: &[f64], question: &Value) -> Result<Option<Vec<[f64; 2]>>, String> {
    let Some(list) = question["dofs"].as_array() else {
        return Ok(None);
    };
    let configurations = robot.configurations().map_err(|error| error.to_string())?;
    let free: Vec<u64> = list.iter().filter_map(Value::as_u64).collect();
    let own = |(dof, bounds): (usize, &[f64; 2])| match (free.contains(&(dof as u64)), q.get(dof)) {
        (false, Some(value)) => [*value, *value],
        _ => *bounds,
    };
    let all = configurations.bounds().iter().enumerate().map(own);
    Ok(Some(all.collect()))
}

fn numbers<const N: usize>(question: &Value, key: &str) -> Result<Option<[f64; N]>, String> {
    match &question[key] {
        Value::Null => Ok(None),
        value => {
            let found = serde_json::from_value::<Vec<f64>>(value.clone()).ok();
            let found = found.and_then(|list| <[f64; N]>::try_from(list).ok());
            found
                .map(Some)
                .ok_or_else(|| format!("`{key}` is no list of {N} numbers"))
        }
    }
}
