//! A robot to ask about itself.

use std::sync::Arc;

use serde_json::{Value, json};
use urdd::directory::source::Archive;
use urdd::robot::{PairDistance, Proximity, Robot, RobotError, ShapeKind};

use crate::{answer, memory};

/// A robot, and the shapes that were prepared for it.
pub struct Handle {
    robot: Robot,
    proximity: Vec<Proximity>,
}

/// Opens the robot in a zip archive; null where it is no archive of a URDD.
///
/// # Safety
/// The bytes are the host's, as [`memory::bytes`] wants them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_open_zip(zip: *const u8, length: usize) -> *mut Handle {
    // SAFETY: as the caller promises.
    let zip = unsafe { memory::bytes(zip, length) };
    match Archive::new("robot", Arc::from(zip)) {
        Ok(source) => Box::into_raw(Box::new(Handle {
            robot: Robot::of(source),
            proximity: Vec::new(),
        })),
        Err(_) => std::ptr::null_mut(),
    }
}

/// Closes a robot.
///
/// # Safety
/// `handle` is an open robot, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_close(handle: *mut Handle) {
    // SAFETY: as the caller promises.
    drop(unsafe { Box::from_raw(handle) });
}

/// Asks a robot something: JSON in, JSON out.
///
/// - `{"ask": "about"}`: `links`, `joints`, `dofs`, `units`, `bounds`, and the configurations `zero` and `middle`.
/// - `{"ask": "poses", "q": [...]}`: a list with `position` (m) and `quaternion_wxyz` of each link.
/// - `{"ask": "distances", "q": [...], "shapes": "pieces"}`: each pair that is not skipped.
/// - `{"ask": "nearest", "q": [...], "shapes": "pieces", "k": 3}`: the nearest pairs.
/// - `{"ask": "in_collision", "q": [...], "shapes": "pieces"}`: true or false.
///
/// # Safety
/// `handle` is an open robot that nobody else uses now; the bytes are the host's, as [`memory::bytes`] wants them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_ask(
    handle: *mut Handle,
    question: *const u8,
    length: usize,
) -> *mut u8 {
    // SAFETY: as the caller promises.
    let (handle, question) = unsafe { (&mut *handle, memory::bytes(question, length)) };
    answer::result(ask(handle, question))
}

fn ask(handle: &mut Handle, question: &[u8]) -> Result<Value, String> {
    let question: Value = serde_json::from_slice(question).map_err(|error| error.to_string())?;
    let said = |error: RobotError| error.to_string();
    let values = || -> Result<Vec<f64>, String> {
        let list = question["q"].as_array().ok_or("`q` is no list")?;
        let number = |value: &Value| value.as_f64().ok_or("`q` has what is no number");
        Ok(list.iter().map(number).collect::<Result<_, _>>()?)
    };
    match question["ask"].as_str().unwrap_or_default() {
        "about" => about(&handle.robot).map_err(said),
        "poses" => {
            let poses = handle.robot.link_poses(&values()?).map_err(said)?;
            let pose = |pose: &nalgebra::Isometry3<f64>| {
                let q = pose.rotation.quaternion();
                json!({
                    "position": pose.translation.vector.as_slice(),
                    "quaternion_wxyz": [q.w, q.i, q.j, q.k],
                })
            };
            Ok(poses.iter().map(pose).collect())
        }
        "distances" => {
            let q = values()?;
            let pairs = proximity(handle, &question)?.distances(&q).map_err(said)?;
            Ok(pairs.iter().map(pair).collect())
        }
        "nearest" => {
            let (q, k) = (values()?, question["k"].as_u64().unwrap_or(1));
            let k = usize::try_from(k).unwrap_or(usize::MAX);
            let pairs = proximity(handle, &question)?.nearest(&q, k).map_err(said)?;
            Ok(pairs.iter().map(pair).collect())
        }
        "in_collision" => {
            let q = values()?;
            let found = proximity(handle, &question)?.in_collision(&q);
            found.map(Value::Bool).map_err(said)
        }
        other => Err(format!("nothing is known of `{}`", other.escape_debug())),
    }
}

fn about(robot: &Robot) -> Result<Value, RobotError> {
    let configurations = robot.configurations()?;
    Ok(json!({
        "links": robot.links()?,
        "joints": robot.joints()?,
        "dofs": robot.dofs()?,
        "units": robot.units()?,
        "bounds": configurations.bounds(),
        "zero": configurations.zero(),
        "middle": configurations.middle(),
    }))
}

/// The shapes of a kind, prepared when they are first asked for.
fn proximity<'a>(handle: &'a mut Handle, question: &Value) -> Result<&'a Proximity, String> {
    let kind: ShapeKind = question["shapes"]
        .as_str()
        .unwrap_or("pieces")
        .parse()
        .map_err(|error: RobotError| error.to_string())?;
    let at = match handle
        .proximity
        .iter()
        .position(|known| known.kind() == kind)
    {
        Some(at) => at,
        None => {
            let prepared = handle.robot.proximity(kind);
            handle
                .proximity
                .push(prepared.map_err(|error| error.to_string())?);
            handle.proximity.len() - 1
        }
    };
    Ok(&handle.proximity[at])
}

fn pair(pair: &PairDistance) -> Value {
    json!({
        "links": pair.links.iter().map(|name| name.to_string()).collect::<Vec<_>>(),
        "pieces": pair.pieces,
        "distance": pair.distance,
        "relative": pair.relative,
        "points": pair.points,
    })
}
