//! Queries on a robot.

use std::collections::BTreeSet;

use nalgebra::Isometry3;
use serde::Deserialize;
use serde_json::{Value, json};
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_robot::{
    CollisionModel, GravitySettings, LinkMass, LinkShape, PairDistance, Payload, Proximity,
    Queries, Robot, RobotError, ShapeKind, Solid, World,
};

use crate::about::about;
use crate::bodies::{Obstacles, carrying};
use crate::collisions::{About, Among, Kind, pair, to_obstacle};
use crate::files::Files;
use crate::inverse::InverseQuestion;
use crate::loops::LoopQuestion;
use crate::pairs::Pairs;
use crate::sources::sources;
use crate::{answer, memory, model};

/// A robot, and its cached data.
pub struct Handle {
    files: Files,
    pub robot: Robot,
    proximity: Vec<Proximity>,
    /// By kind: the pairs that are skipped because they touch at rest, if there are any.
    skipped: Vec<(ShapeKind, Option<Proximity>)>,
    obstacles: Obstacles,
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
        robot: Robot::of(files.root.clone()),
        files,
        proximity: Vec::new(),
        skipped: Vec::new(),
        obstacles: Obstacles::default(),
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
pub unsafe extern "C" fn urdd_robot_link_poses_batch(
    handle: *mut Handle,
    values: *const u8,
    count: usize,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (handle, values) = unsafe { (&*handle, memory::numbers(values, count)) };
    let poses = handle.robot.link_poses_batch(&values);
    answer::bytes_or_error(poses.map_err(|error| error.to_string()).map(|poses| {
        let seven = |pose: &Isometry3<f64>| {
            let (t, q) = (pose.translation.vector, pose.rotation.quaternion());
            [t.x, t.y, t.z, q.w, q.i, q.j, q.k]
        };
        let numbers = poses.iter().flat_map(seven);
        numbers.flat_map(f64::to_le_bytes).collect()
    }))
}

/// A query, such as `{"ask": "proximity", "q": [...], "k": 3}`. `q` is a configuration, in rad or m; `kind` is a kind of
/// shapes, `pieces` by default.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case")]
enum Question {
    /// The description of the robot: [`about`].
    About,
    /// `position` (m) and `quaternion_wxyz` of each link.
    LinkPoses { q: Vec<f64> },
    /// Random configuration `k` of SPEC 9.3.
    Random {
        #[serde(default)]
        k: u64,
    },
    /// `q` with each value clamped to its bounds.
    Clamp { q: Vec<f64> },
    /// [`crate::inverse`].
    InverseKinematics(InverseQuestion),
    /// [`crate::loops`].
    Loops { about: LoopQuestion },
    /// The visual and collision elements of the URDF, with the files of meshes.
    Sources,
    /// `link`, `piece`, and a box or a sphere as `solid`, for each shape.
    Shapes {
        #[serde(default)]
        kind: Kind,
    },
    /// The distance and the closest points of each pair that is not skipped.
    ClosestPoints {
        q: Vec<f64>,
        #[serde(default)]
        kind: Kind,
    },
    /// [`crate::collisions`].
    Collisions {
        about: About,
        #[serde(flatten)]
        among: Among,
    },
    /// `velocity` and `effort`: the largest of each DOF, rad/s or m/s, N m or N; null without a limit.
    Limits,
    /// `mass` (kg) and `centre` (m, in the link's frame) of each link.
    LinkMasses,
    /// The centre of mass in the root link's frame, m; null for a robot without masses.
    CentreOfMass { q: Vec<f64> },
    /// The torque or force of each DOF that holds the robot still, N m or N.
    GravityTorques { q: Vec<f64>, gravity: Option<[f64; 3]>, payload: Option<Carried> },
    /// `nearest`, each with its statistics; `in_collision`, `pairs` (the number checked) and `of` (their total number);
    /// `skipped_touching`: the links of each pair that touches and is skipped because it touches at rest.
    Proximity {
        q: Vec<f64>,
        #[serde(default)]
        kind: Kind,
        #[serde(default = "one")]
        k: u64,
    },
    /// The names of the links of each pair that is skipped because it touches at rest.
    SkippedContacts {
        #[serde(default)]
        kind: Kind,
    },
    /// The learned self-collision model and its error rates: [`model::about`]. Null if there is none.
    CollisionModel,
    /// The model's estimates: [`model::clearances`]. Null if there is none.
    Clearances { q: Vec<f64> },
    /// The matrices of skips and reasons, and the edits.
    Skips {
        #[serde(default)]
        kind: Kind,
    },
    /// As `skips` with these edits, and `files`: the text of each file of the URDD that changes.
    EditSkips {
        #[serde(default)]
        kind: Kind,
        edits: Vec<SkipEdit>,
        skipped_reasons: Option<Vec<SkippedReason>>,
    },
    /// Reads the shapes, so that the next query is fast.
    Prepare {
        #[serde(default)]
        kind: Kind,
    },
    /// The document of `kinematics_samples_module`.
    Samples,
}

/// A mass that a link carries.
#[derive(Deserialize)]
struct Carried {
    link: usize,
    mass: f64,
    #[serde(default)]
    point: [f64; 3],
}

fn one() -> u64 {
    1
}

/// Answers a [`Question`]: JSON in, JSON out.
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
    let question = serde_json::from_slice(question).map_err(|error| error.to_string());
    answer::result(question.and_then(|question| ask(handle, question)))
}

fn ask(handle: &mut Handle, question: Question) -> Result<Value, String> {
    let said = |error: RobotError| error.to_string();
    let count = |k: u64| usize::try_from(k).unwrap_or(usize::MAX);
    match question {
        Question::About => about(&handle.robot),
        Question::LinkPoses { q } => {
            let poses = handle.robot.link_poses(&q).map_err(said)?;
            Ok(poses.iter().map(pose).collect())
        }
        Question::Random { k } => {
            let configurations = handle.robot.configurations().map_err(said)?;
            Ok(json!(configurations.random(k)))
        }
        Question::Clamp { mut q } => {
            let configurations = handle.robot.configurations().map_err(said)?;
            configurations.clamp(&mut q);
            Ok(json!(q))
        }
        Question::InverseKinematics(question) => {
            let Handle { proximity, robot, obstacles, .. } = handle;
            if question.free_of.is_none() && question.obstacles.is_none() {
                return question.solve(robot, None, &World::default());
            }
            let own = prepared(proximity, robot, question.free_of.unwrap_or_default())?;
            let carried = carrying(own, &question.attached, &[], &[])?;
            match &question.obstacles {
                Some(bodies) => question.solve(robot, Some(&carried), obstacles.world(bodies)?),
                None => question.solve(robot, Some(&carried), &World::default()),
            }
        }
        Question::Loops { about } => about.answer(&handle.robot).map_err(said),
        Question::Sources => sources(&handle.robot),
        Question::Shapes { kind } => shapes(&handle.robot, kind.0).map_err(said),
        Question::ClosestPoints { q, kind } => {
            let pairs = proximity(handle, kind)?.closest_points(&q).map_err(said)?;
            Ok(pairs.iter().map(pair).collect())
        }
        Question::Collisions { about, among } => collisions(handle, &about, &among),
        Question::Limits => {
            let numbers = |found: Result<&[f64], RobotError>| {
                let found = found.map_err(said)?.iter();
                Ok::<Value, String>(found.map(|most| most.is_finite().then_some(*most)).collect())
            };
            let velocity = numbers(handle.robot.velocity_limits())?;
            Ok(json!({ "velocity": velocity, "effort": numbers(handle.robot.effort_limits())? }))
        }
        Question::LinkMasses => {
            let masses = handle.robot.link_masses().map_err(said)?;
            let mass =
                |LinkMass { mass, centre }: &LinkMass| json!({ "mass": mass, "centre": centre });
            Ok(masses.iter().map(mass).collect())
        }
        Question::CentreOfMass { q } => {
            let found = handle.robot.centre_of_mass(&q);
            found.map(|centre| json!(centre)).map_err(said)
        }
        Question::GravityTorques { q, gravity, payload } => {
            let mut settings = GravitySettings::default();
            settings.gravity = gravity.unwrap_or(settings.gravity);
            let carried = |Carried { link, mass, point }| Payload { link, mass, point };
            settings.payload = payload.map(carried);
            let found = handle.robot.gravity_torques(&q, &settings);
            found.map(|torques| json!(torques)).map_err(said)
        }
        Question::Proximity { q, kind, k } => {
            let shapes = proximity(handle, kind)?;
            let nearest = shapes.nearest(&q, count(k)).map_err(said)?;
            let (kind, checked) = (kind.0, shapes.num_pairs());
            let in_collision = match nearest.first() {
                Some(pair) => pair.distance <= 0.0,
                None => shapes.in_collision(&q).map_err(said)?,
            };
            let unseen = match skipped(handle, kind)? {
                Some(skipped) => skipped.collisions(&q).map_err(said)?,
                None => Vec::new(),
            };
            let unseen: BTreeSet<[usize; 2]> = unseen.iter().map(|pair| pair.link_idxs).collect();
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
                "skipped_touching": unseen,
            }))
        }
        Question::SkippedContacts { kind } => {
            let skipped = skipped(handle, kind.0)?;
            let names: BTreeSet<[&str; 2]> =
                skipped.iter().flat_map(|shapes| shapes.pair_names()).collect();
            Ok(json!(names))
        }
        Question::CollisionModel => {
            let model = learned(&mut handle.model, &handle.robot)?;
            Ok(model.map_or(Value::Null, model::about))
        }
        Question::Clearances { q } => match learned(&mut handle.model, &handle.robot)? {
            Some(model) => model::clearances(model, &handle.robot, &q),
            None => Ok(Value::Null),
        },
        Question::Skips { kind: Kind(kind) } => {
            let skips = handle.robot.skips(kind).map_err(said)?;
            Ok(pairs(handle)?.skips(kind, &skips))
        }
        Question::EditSkips { kind: Kind(kind), edits, skipped_reasons } => {
            let edited = handle.robot.with_skip_edits(edits, skipped_reasons);
            let edited = edited.map_err(said)?;
            let skips = handle.robot.skips(kind).map_err(said)?;
            Ok(pairs(handle)?.edited(kind, &skips, &edited))
        }
        Question::Prepare { kind } => Ok(json!(proximity(handle, kind)?.num_pairs())),
        Question::Samples => {
            let bytes = handle.files.read(
                "kinematics_samples_module/module.json",
                urdd_directory::limits::MAX_DOCUMENT_BYTES,
            )?;
            serde_json::from_slice(&bytes).map_err(|error| error.to_string())
        }
    }
}

fn collisions(handle: &mut Handle, about: &About, among: &Among) -> Result<Value, String> {
    let own = prepared(&mut handle.proximity, &handle.robot, among.kind)?;
    let Among { attached, without, without_bodies, .. } = among;
    let shapes = &*carrying(own, attached, without, without_bodies)?;
    let answer = match &among.obstacles {
        None => about.answer(shapes, pair),
        Some(bodies) => {
            let world = shapes.world_proximity(handle.obstacles.world(bodies)?);
            world.and_then(|world| about.answer(&world, to_obstacle))
        }
    };
    answer.map_err(|error| error.to_string())
}

fn pose(pose: &Isometry3<f64>) -> Value {
    let q = pose.rotation.quaternion();
    json!({
        "position": pose.translation.vector.as_slice(),
        "quaternion_wxyz": [q.w, q.i, q.j, q.k],
    })
}

/// The boxes or spheres of a kind.
fn shapes(robot: &Robot, kind: ShapeKind) -> Result<Value, RobotError> {
    let shapes = robot.shapes(kind)?;
    let shape = |shape: &LinkShape| {
        let solid = match &shape.solid {
            Solid::Mesh(_) => Value::Null,
            Solid::Box { pose: at, half_extents } => {
                let mut solid = pose(at);
                solid["half_extents"] = json!(half_extents);
                solid
            }
            Solid::Sphere { centre, radius } => json!({ "position": centre, "radius": radius }),
        };
        json!({ "link": shape.link, "piece": shape.piece, "solid": solid })
    };
    Ok(shapes.iter().map(shape).collect())
}

/// The shapes of a kind, prepared on first use.
fn prepared<'a>(
    known: &'a mut Vec<Proximity>,
    robot: &Robot,
    Kind(kind): Kind,
) -> Result<&'a Proximity, String> {
    let at = match known.iter().position(|known| known.kind() == kind) {
        Some(at) => at,
        None => {
            let prepared = robot.proximity(kind);
            known.push(prepared.map_err(|error| error.to_string())?);
            known.len() - 1
        }
    };
    Ok(&known[at])
}

fn proximity(handle: &mut Handle, kind: Kind) -> Result<&Proximity, String> {
    prepared(&mut handle.proximity, &handle.robot, kind)
}

/// The pairs of a kind that are skipped because they touch at rest, prepared on first use.
fn skipped(handle: &mut Handle, kind: ShapeKind) -> Result<Option<&Proximity>, String> {
    let known = handle.skipped.iter().position(|(known, _)| *known == kind);
    let at = match known {
        Some(at) => at,
        None => {
            let found = handle.robot.skipped_contacts(kind).map_err(|error| error.to_string())?;
            handle.skipped.push((kind, found));
            handle.skipped.len() - 1
        }
    };
    Ok(handle.skipped[at].1.as_ref())
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
        handle.pairs = Some(Pairs::read(&handle.robot)?);
    }
    handle.pairs.as_ref().ok_or_else(String::new)
}
