//! Queries on a robot.

use serde_json::{Value, json};
use urdd_robot::{CollisionModel, PairDistance, Proximity, Robot, RobotError, ShapeKind, Solid};

use crate::about::about;
use crate::files::Files;
use crate::pairs::Pairs;
use crate::reach::reach;
use crate::sources::sources;
use crate::{answer, memory, model};

/// A robot, and its cached data.
pub struct Handle {
    files: Files,
    robot: Robot,
    proximity: Vec<Proximity>,
    pairs: Option<Pairs>,
    /// The learned model once read; `Some(None)` if the robot has none.
    model: Option<Option<CollisionModel>>,
}

/// Opens the robot in these files. Reads nothing yet.
///
/// # Safety
/// `files` is open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_open(files: *mut Files) -> *mut Handle {
    // SAFETY: guaranteed by the caller.
    let files = unsafe { (*files).clone() };
    Box::into_raw(Box::new(Handle {
        robot: Robot::of(files.clone()),
        files,
        proximity: Vec::new(),
        pairs: None,
        model: None,
    }))
}

/// Closes a robot.
///
/// # Safety
/// `handle` is an open robot, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_close(handle: *mut Handle) {
    // SAFETY: guaranteed by the caller.
    drop(unsafe { Box::from_raw(handle) });
}

/// Seven numbers (x, y, z; quaternion w, x, y, z) for each link in each of the configurations stored one after another
/// in `values`: an answer of [`answer::bytes_or_error`] with little-endian binary64.
///
/// # Safety
/// `handle` is an open robot that is not used concurrently; there are `count` numbers at `values`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_poses(
    handle: *mut Handle,
    values: *const u8,
    count: usize,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (handle, values) = unsafe { (&*handle, memory::bytes(values, 8 * count)) };
    let number = |bytes: &[u8]| f64::from_le_bytes(bytes.try_into().unwrap_or_default());
    let values: Vec<f64> = values.chunks_exact(8).map(number).collect();
    let poses = handle.robot.link_poses_batch(&values);
    answer::bytes_or_error(poses.map_err(|error| error.to_string()).map(|poses| {
        let seven = |pose: &nalgebra::Isometry3<f64>| {
            let (t, q) = (pose.translation.vector, pose.rotation.quaternion());
            [t.x, t.y, t.z, q.w, q.i, q.j, q.k]
        };
        let numbers = poses.iter().flat_map(seven);
        numbers.flat_map(f64::to_le_bytes).collect()
    }))
}

/// Runs a query on a robot: JSON in, JSON out. `q` is a configuration, in rad or m; `shapes` is a kind of shapes.
///
/// - `{"ask": "about"}`: `about`.
/// - `{"ask": "poses", "q": [...]}`: a list with `position` (m) and `quaternion_wxyz` of each link.
/// - `{"ask": "random", "k": 7}`: random configuration `k` of SPEC 9.3.
/// - `{"ask": "clamp", "q": [...]}`: the nearest configuration within the bounds.
/// - `{"ask": "reach", "q": [...], "link": 5, "point": [x, y, z], "position": [x, y, z], "quaternion_wxyz": [...],
///   "dofs": [...], "restarts": 0}`: a configuration in which a point of the link (in its frame) is at a position (in
///   the root's), and the link has a rotation, if given; `position_error`, `rotation_error`, `reached`.
/// - `{"ask": "sources"}`: the visual and collision elements of the URDF, with the files of meshes.
/// - `{"ask": "volumes", "shapes": "boxes"}`: a list with `link`, `piece`, and a box or a sphere.
/// - `{"ask": "distances", "q": [...], "shapes": "pieces"}`: each pair that is not skipped.
/// - `{"ask": "nearest", "q": [...], "shapes": "pieces", "k": 3}`: the nearest pairs.
/// - `{"ask": "in_collision", "q": [...], "shapes": "pieces"}`: true or false.
/// - `{"ask": "proximity", "q": [...], "shapes": "pieces", "k": 3}`: `nearest`, each with its statistics;
///   `in_collision`, `pairs` (the number checked) and `of` (their total number).
/// - `{"ask": "collision_model"}`: the learned self-collision model and its error rates ([`model::about`]); null if
///   there is none.
/// - `{"ask": "clearances", "q": [...]}`: the model's estimates ([`model::clearances`]); null if there is none.
/// - `{"ask": "skips", "shapes": "pieces"}`: the matrices of skips and reasons, and the edits.
/// - `{"ask": "edit_skips", "shapes": "pieces", "edits": [...], "skipped_reasons": null}`: the matrices with these
///   edits, and `files`: the text of each file of the URDD that changes.
/// - `{"ask": "prepare", "shapes": "pieces"}`: reads the shapes, so that the next query is fast.
/// - `{"ask": "samples"}`: the document of `kinematics_samples_module`.
///
/// # Safety
/// `handle` is an open robot that is not used concurrently; the bytes are valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_ask(
    handle: *mut Handle,
    question: *const u8,
    length: usize,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
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
    let count = || usize::try_from(question["k"].as_u64().unwrap_or(1)).unwrap_or(usize::MAX);
    match question["ask"].as_str().unwrap_or_default() {
        "about" => about(&handle.files, &handle.robot),
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
        "random" => {
            let configurations = handle.robot.configurations().map_err(said)?;
            Ok(json!(
                configurations.random(question["k"].as_u64().unwrap_or(0))
            ))
        }
        "clamp" => {
            let mut q = values()?;
            let configurations = handle.robot.configurations().map_err(said)?;
            configurations.clamp(&mut q);
            Ok(json!(q))
        }
        "reach" => reach(&handle.robot, &values()?, &question),
        "sources" => sources(&handle.files, &handle.robot),
        "volumes" => volumes(&handle.robot, kind(&question)?).map_err(said),
        "distances" => {
            let q = values()?;
            let pairs = proximity(handle, &question)?.distances(&q).map_err(said)?;
            Ok(pairs.iter().map(pair).collect())
        }
        "nearest" => {
            let (q, k) = (values()?, count());
            let pairs = proximity(handle, &question)?.nearest(&q, k).map_err(said)?;
            Ok(pairs.iter().map(pair).collect())
        }
        "in_collision" => {
            let q = values()?;
            let found = proximity(handle, &question)?.in_collision(&q);
            found.map(Value::Bool).map_err(said)
        }
        "proximity" => {
            let (q, k) = (values()?, count());
            let shapes = proximity(handle, &question)?;
            let nearest = shapes.nearest(&q, k).map_err(said)?;
            let (kind, checked) = (shapes.kind(), shapes.num_pairs());
            let in_collision = match nearest.first() {
                Some(pair) => pair.distance <= 0.0,
                None => shapes.in_collision(&q).map_err(said)?,
            };
            let pairs = pairs(handle)?;
            let with = |found: &PairDistance| {
                let mut value = pair(found);
                value["link_idxs"] = json!(found.link_idxs);
                value["statistics"] = pairs.statistics(kind, found.link_idxs, found.pieces);
                value
            };
            Ok(json!({
                "nearest": nearest.iter().map(with).collect::<Vec<_>>(),
                "in_collision": in_collision,
                "pairs": checked,
                "of": pairs.count(kind),
                "num_samples": pairs.num_samples(kind),
            }))
        }
        "collision_model" => {
            let model = learned(&mut handle.model, &handle.robot)?;
            Ok(model.map_or(Value::Null, model::about))
        }
        "clearances" => {
            let q = values()?;
            match learned(&mut handle.model, &handle.robot)? {
                Some(model) => model::clearances(model, &handle.robot, &q),
                None => Ok(Value::Null),
            }
        }
        "skips" => {
            let kind = kind(&question)?;
            let skips = handle.robot.skips(kind).map_err(said)?;
            Ok(pairs(handle)?.skips(kind, &skips))
        }
        "edit_skips" => {
            let kind = kind(&question)?;
            let list = |key: &str| question[key].clone();
            let edits = serde_json::from_value(list("edits")).map_err(|error| error.to_string())?;
            let reasons = serde_json::from_value(list("skipped_reasons"));
            let reasons = reasons.map_err(|error| error.to_string())?;
            let edited = handle.robot.with_skip_edits(edits, reasons).map_err(said)?;
            let skips = handle.robot.skips(kind).map_err(said)?;
            Ok(pairs(handle)?.edited(kind, &skips, &edited))
        }
        "prepare" => Ok(json!(proximity(handle, &question)?.num_pairs())),
        "samples" => {
            let bytes = handle.files.read(
                "kinematics_samples_module/module.json",
                urdd_directory::limits::MAX_DOCUMENT_BYTES,
            )?;
            serde_json::from_slice(&bytes).map_err(|error| error.to_string())
        }
        other => Err(format!("nothing is known of `{}`", other.escape_debug())),
    }
}

fn kind(question: &Value) -> Result<ShapeKind, String> {
    let name = question["shapes"].as_str().unwrap_or("pieces");
    name.parse::<ShapeKind>().map_err(|error| error.to_string())
}

/// The boxes or spheres of a kind.
fn volumes(robot: &Robot, kind: ShapeKind) -> Result<Value, RobotError> {
    let shapes = robot.shapes(kind)?;
    let volume = |shape: &urdd_robot::LinkShape| {
        let solid = match &shape.solid {
            Solid::Mesh(_) => Value::Null,
            Solid::Box { pose, half_extents } => {
                let (t, q) = (pose.translation.vector, pose.rotation.quaternion());
                json!({
                    "position": t.as_slice(),
                    "quaternion_wxyz": [q.w, q.i, q.j, q.k],
                    "half_extents": half_extents,
                })
            }
            Solid::Sphere { centre, radius } => json!({ "position": centre, "radius": radius }),
        };
        json!({ "link": shape.link, "piece": shape.piece, "solid": solid })
    };
    Ok(shapes.iter().map(volume).collect())
}

/// The shapes of a kind, prepared on first use.
fn proximity<'a>(handle: &'a mut Handle, question: &Value) -> Result<&'a Proximity, String> {
    let kind = kind(question)?;
    let known = &mut handle.proximity;
    let at = match known.iter().position(|known| known.kind() == kind) {
        Some(at) => at,
        None => {
            let prepared = handle.robot.proximity(kind);
            known.push(prepared.map_err(|error| error.to_string())?);
            known.len() - 1
        }
    };
    Ok(&handle.proximity[at])
}

/// The learned model, read on first use.
fn learned<'a>(
    known: &'a mut Option<Option<CollisionModel>>,
    robot: &Robot,
) -> Result<Option<&'a CollisionModel>, String> {
    if known.is_none() {
        *known = Some(model::read(robot)?);
    }
    Ok(known.iter().flatten().next())
}

fn pairs(handle: &mut Handle) -> Result<&Pairs, String> {
    if handle.pairs.is_none() {
        handle.pairs = Some(Pairs::read(&handle.files)?);
    }
    handle.pairs.as_ref().ok_or_else(String::new)
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
