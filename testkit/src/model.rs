//! A robot with a handwritten, untrained self-collision model. Its predictions are compared with contacts of boxes that
//! are computed here.

use std::sync::{Arc, Mutex};

use rayon::prelude::*;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::JointType;

use super::core::{Core, default_configuration, link_transforms, sampled_configuration};
use super::fixture::{Fixture, size_and_hash};
use super::meshes::{Meshes, Point};
use super::robot::{Robot, collision, cuboid, joint, limit, link, origin, solid_box};
use super::shapes::boxes_touch;
use super::transform::{Transform, apply, norm, rotation_about, unit};

/// Name of the module.
pub const MODEL: &str = "self_collision_model_module";

/// Number of network inputs: four per angle of the arm, one for the slide, nine for the ball's rotation matrix.
const WIDTH: usize = 4 + 4 + 1 + 9;

/// Range of the arm's joints, rad, and upper limit of the slider, metres.
const REACH: [f64; 2] = [2.5, 0.6];

/// A post with a two-link arm that can fold back onto it, a slider next to it, and a ball on the slider.
fn robot_with([turn, high]: [f64; 2]) -> Robot {
    let mut robot = Robot::new("folding arm");
    for (name, size, at) in [
        ("post", [0.2, 0.2, 0.2], [0.0; 3]),
        ("arm", [0.3, 0.05, 0.05], [0.15, 0.0, 0.0]),
        ("tip", [0.3, 0.04, 0.04], [0.15, 0.0, 0.0]),
        ("slider", [0.1, 0.1, 0.1], [0.0; 3]),
        ("ball", [0.1, 0.04, 0.04], [0.0; 3]),
    ] {
        let mut link = link(name);
        link.inertial = Some(solid_box(1.0, size));
        link.collision = vec![collision(origin(at, [0.0; 3]), cuboid(size))];
        robot.urdf.links.push(link);
    }
    for (name, joint_type, parent, child, at) in [
        ("shoulder", JointType::Revolute, "post", "arm", [0.0, 0.0, 0.3]),
        ("elbow", JointType::Revolute, "arm", "tip", [0.3, 0.0, 0.0]),
        ("slide", JointType::Prismatic, "post", "slider", [0.4, 0.0, 0.0]),
        ("socket", JointType::Spherical, "slider", "ball", [0.0, 0.0, 0.12]),
    ] {
        let mut joint = joint(name, joint_type, parent, child);
        joint.origin = origin(at, [0.0; 3]);
        match name {
            "slide" => {
                joint.axis = Some(urdd_format::urdf::Axis { xyz: Some([0.0, 0.0, 1.0]) });
                joint.limit = limit(-0.2, high);
            }
            "socket" => {}
            _ => {
                joint.axis = Some(urdd_format::urdf::Axis { xyz: Some([0.0, 1.0, 0.0]) });
                joint.limit = limit(-turn, turn);
            }
        }
        robot.urdf.joints.push(joint);
    }
    robot
}

/// Parameters of the model and its robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Said {
    /// Added to the margin of each pair, metres.
    pub margin: f64,
    /// Range of the arm's two joints to each side, rad, and upper limit of the slider, metres.
    pub reach: [f64; 2],
    /// Whether the network has memorised the configurations of the evaluation that it would otherwise miss.
    pub by_heart: bool,
}

impl Default for Said {
    fn default() -> Self {
        Said { margin: 0.0, reach: REACH, by_heart: false }
    }
}

/// The robot with its model.
pub fn fixture() -> Fixture {
    fixture_with(Said::default())
}

/// The robot with a model of these parameters and the resulting counts.
pub fn fixture_with(said: Said) -> Fixture {
    let robot = robot_with(said.reach);
    let mut fixture = Fixture::full_with_edits(&robot, Vec::new());
    fixture.add_module(ModuleKind::SelfCollisionModel.folder(), Value::Null);
    let modules = fixture.doc_mut("urdd.json")["modules"].as_array_mut();
    let own = modules.and_then(|modules| modules.last_mut()).expect("the module");
    let kind = ModuleKind::SelfCollisionModel;
    own["depends_on"] = json!(kind.depends_on().iter().map(|k| k.name()).collect::<Vec<_>>());
    fixture.canonical = true;
    fixture.seal();
    let mut document = document(&robot, said);
    document["trained_on"] = json!(trained_on(&fixture));
    *fixture.doc_mut(MODEL) = document;
    fixture.relist();
    fixture.seal();
    fixture
}

/// The digest defined in SPEC 8.8.7.
pub fn trained_on(fixture: &Fixture) -> String {
    let documents = ["dof_module", "chain_module", "bounds_module", "link_shapes_skips_module"];
    let mut files: Vec<String> =
        documents.iter().map(|module| format!("{}/module.json", fixture.folder(module))).collect();
    let pieces = fixture.get("convex_decomposition_meshes_module", "/link_pieces");
    for piece in pieces.as_array().into_iter().flatten() {
        let glbs = piece.as_array().into_iter().flatten();
        files.extend(glbs.filter_map(|files| Some(files["glb"].as_str()?.to_owned())));
    }
    let text: String =
        files.iter().map(|path| size_and_hash(fixture.file(path)).1 + "\n").collect();
    let digest = Sha256::digest(text);
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The pairs that are not skipped, listed by hand. Neighbours are skipped as `Adjacent`; no other pair touches at rest.
const PAIRS: [[usize; 2]; 5] = [[0, 2], [1, 3], [1, 4], [2, 3], [2, 4]];
/// The post and the ball never touch.
const OTHER: [usize; 2] = [0, 4];

/// Weights, row by row, and biases.
type Layer = (Vec<Vec<f64>>, Vec<f64>);

/// The layers: three hidden values of the inputs and an unused one, then one distance per pair.
fn layers() -> [Layer; 2] {
    let row = |at: &[(usize, f64)]| {
        let mut row = vec![0.0; WIDTH];
        for (place, weight) in at {
            row[*place] = *weight;
        }
        row
    };
    let hidden = vec![
        row(&[(1, 0.5), (5, 1.5), (7, 0.25)]),
        row(&[(0, -1.25), (4, -0.5), (8, -0.75), (9, 0.01)]),
        row(&[(0, 0.75), (2, 0.5), (6, -0.5), (8, 1.5), (17, 0.02)]),
        row(&[]),
    ];
    let outputs = vec![
        vec![0.25, 0.02, -0.01, 0.0],
        vec![-0.125, 0.25, 0.125, 0.0],
        vec![-0.0625, 0.25, 0.25, 0.0],
        vec![-0.125, 0.125, 0.25, 0.0],
        vec![-0.0625, 0.125, 0.375, 0.0],
    ];
    [(hidden, vec![0.125, -0.25, 0.0, 0.0]), (outputs, vec![0.2, 0.15, 0.15, 0.1, 0.1])]
}

/// A model: its two layers and the margin of each pair.
struct Network {
    layers: [Layer; 2],
    margins: Vec<f64>,
}

impl Network {
    fn new(margin: f64) -> Self {
        Network {
            layers: layers(),
            margins: [0.02, 0.03, 0.04, 0.05, 0.06].map(|of| of + margin).to_vec(),
        }
    }

    /// Adds a hidden value for each given configuration. It reports contact in that configuration and very near it.
    ///
    /// Sines, cosines and a matrix form a vector of constant length. No other configuration projects as far onto it.
    fn knowing<'a>(mut self, by_heart: impl Iterator<Item = &'a Vec<f64>>) -> Self {
        const STEEP: f64 = 3e4;
        let [(hidden, biases), (outputs, _)] = &mut self.layers;
        for q in by_heart {
            let mut direction = inputs(q);
            // The slide input is not part of that vector.
            direction[8] = 0.0;
            let along: f64 = direction.iter().map(|x| x * x).sum();
            hidden.push(direction.iter().map(|x| STEEP * x).collect());
            biases.push(-STEEP * (along - 1e-3));
            for (place, output) in outputs.iter_mut().enumerate() {
                output.push(if place == 0 { -5.0 } else { 0.0 });
            }
        }
        let known = hidden.len() - 4;
        // Compensates for the hyperbolic tangents of -1 of all other configurations.
        self.layers[1].1[0] -= 5.0 * known as f64;
        self
    }

    /// The clearances of SPEC 8.8.3 and 8.8.4.
    fn clearances(&self, q: &[f64]) -> Vec<f64> {
        let layer = |values: &[f64], (weights, biases): &Layer| -> Vec<f64> {
            let sums = weights.iter().zip(biases).map(|(row, bias)| {
                let products = row.iter().zip(values).map(|(w, x)| w * x);
                products.sum::<f64>() + bias
            });
            sums.collect()
        };
        let hidden = layer(&inputs(q), &self.layers[0]);
        let hidden: Vec<f64> = hidden.into_iter().map(f64::tanh).collect();
        let outputs = layer(&hidden, &self.layers[1]).into_iter();
        outputs.zip(&self.margins).map(|(x, of)| x - of).collect()
    }

    fn clears(&self, q: &[f64]) -> bool {
        self.clearances(q).into_iter().all(|clearance| clearance > 0.0)
    }
}

/// The network inputs of SPEC 8.8.3.
fn inputs(q: &[f64]) -> Vec<f64> {
    let mut values: Vec<f64> = Vec::new();
    for angle in [q[0], q[1]] {
        values.extend([angle.sin(), angle.cos(), (2.0 * angle).sin(), (2.0 * angle).cos()]);
    }
    values.push((q[2] - 0.2) / 0.4);
    let angle = norm([q[3], q[4], q[5]]);
    let axis = match angle > 0.0 {
        true => unit([q[3], q[4], q[5]]),
        false => [1.0, 0.0, 0.0],
    };
    values.extend(rotation_about(axis, angle).into_iter().flatten());
    values
}

/// The ground truth for contacts.
struct Exact {
    robot: Robot,
    core: Core,
    meshes: Meshes,
}

impl Exact {
    fn new(robot: &Robot) -> Self {
        Exact { core: Core::new(robot), meshes: Meshes::new(robot), robot: robot.clone() }
    }

    fn touch(&self, at: &[Transform], [a, b]: [usize; 2]) -> bool {
        let placed = |link: usize| -> Vec<[Point; 8]> {
            let solids = self.meshes.solids[link].iter();
            let pieces = solids.flat_map(|solids| &solids.pieces);
            let place = |corner| apply(&at[link], corner);
            pieces.map(|piece| piece.corners.map(place)).collect()
        };
        let (a, b) = (placed(a), placed(b));
        let mut pairs = a.iter().flat_map(|a| b.iter().map(move |b| (a, b)));
        pairs.any(|(a, b)| boxes_touch(a, b))
    }

    fn collides(&self, q: &[f64]) -> bool {
        let at = link_transforms(&self.robot, &self.core, q);
        let mut pairs = PAIRS.iter().chain(std::iter::once(&OTHER));
        pairs.any(|pair| self.touch(&at, *pair))
    }

    fn sampled(&self, k: u32) -> Vec<f64> {
        sampled_configuration(&self.robot, &self.core, k)
    }

    /// Sampled configuration k, whether it collides, and whether it is near contact.
    fn judge(&self, k: u32) -> (Vec<f64>, bool, bool) {
        let (q, r) = (self.sampled(k), self.sampled(k + 1));
        if !self.collides(&q) {
            return (q, false, false);
        }
        let most = q.iter().zip(&r).map(|(q, r)| (r - q).abs());
        let s = (0.05 / most.fold(f64::MIN_POSITIVE, f64::max)).min(1.0);
        let near: Vec<f64> = q.iter().zip(&r).map(|(q, r)| q + s * (r - q)).collect();
        let near = !self.collides(&near);
        (q, true, near)
    }
}

type Judged = Vec<(Vec<f64>, bool, bool)>;

/// The configurations of the evaluation (SPEC 8.8.9) for a robot with this reach.
fn evaluation(reach: [f64; 2]) -> Arc<Judged> {
    static KNOWN: Mutex<Vec<([f64; 2], Arc<Judged>)>> = Mutex::new(Vec::new());
    let mut known = KNOWN.lock().expect("no test failed in here");
    if let Some((_, judged)) = known.iter().find(|(of, _)| *of == reach) {
        return Arc::clone(judged);
    }
    let exact = Exact::new(&robot_with(reach));
    let all = (1_u32 << 31..(1 << 31) + 50_000).into_par_iter();
    let judged: Arc<Judged> = Arc::new(all.map(|k| exact.judge(k)).collect());
    known.push((reach, Arc::clone(&judged)));
    judged
}

fn document(robot: &Robot, said: Said) -> Value {
    let exact = Exact::new(robot);
    let judged = evaluation(said.reach);
    let mut network = Network::new(said.margin);
    if said.by_heart {
        let missed = judged.iter().filter(|(q, collides, _)| *collides && network.clears(q));
        let missed: Vec<&Vec<f64>> = missed.map(|(q, ..)| q).collect();
        network = network.knowing(missed.into_iter());
    }
    let cleared: Vec<bool> = judged.par_iter().map(|(q, ..)| network.clears(q)).collect();
    let count = |wanted: fn(bool, bool, bool) -> bool| {
        let all = judged.iter().zip(&cleared);
        all.filter(|((_, collides, near), clears)| wanted(*collides, *near, **clears)).count()
    };
    let pairs = PAIRS.iter().zip(&network.margins);
    let pairs =
        pairs.map(|([a, b], margin)| json!({ "link_a_idx": a, "link_b_idx": b, "margin": margin }));
    let layers = network.layers.iter();
    let layers = layers.map(|(weights, biases)| json!({ "weights": weights, "biases": biases }));
    let mut configurations = vec![default_configuration(robot, &exact.core)];
    configurations.extend([3, 4, 5].map(|k| exact.sampled(k)));
    let vectors = configurations
        .iter()
        .map(|q| json!({ "configuration": q, "clearances": network.clearances(q) }));
    json!({
        "trained_on": "",
        "clip_distance": 0.1,
        "inputs": [
            { "Angle": { "dof_idx": 0 } },
            { "Angle": { "dof_idx": 1 } },
            { "Length": { "dof_idx": 2, "middle": 0.2, "half_range": 0.4 } },
            { "RotationVector": { "dof_idxs": [3, 4, 5] } },
        ],
        "layers": layers.collect::<Vec<_>>(),
        "pairs": pairs.collect::<Vec<_>>(),
        "other_pairs": [{ "link_a_idx": OTHER[0], "link_b_idx": OTHER[1] }],
        "training": { "first_sample_idx": 0, "num_configurations": 300 },
        "calibration": { "first_sample_idx": 300, "num_configurations": 200 },
        "evaluation": {
            "num_colliding": count(|collides, _, _| collides),
            "num_missed": count(|collides, _, clears| collides && clears),
            "num_near_contact": count(|_, near, _| near),
            "num_near_contact_missed": count(|_, near, clears| near && clears),
            "num_free": count(|collides, _, _| !collides),
            "num_cleared": count(|collides, _, clears| !collides && clears),
        },
        "test_vectors": vectors.collect::<Vec<_>>(),
    })
}
