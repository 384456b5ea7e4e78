//! A robot with a self-collision model that is written down, not trained: what it says is compared with distances of
//! boxes, computed here.

use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use urdd::format::registry::ModuleKind;
use urdd::format::urdf::JointType;

use super::core::{
    Core, Transform, apply, default_configuration, link_transforms, rotation_about,
    sampled_configuration,
};
use super::fixture::{Fixture, size_and_hash};
use super::meshes::{Meshes, Point};
use super::robot::{Robot, collision, cuboid, joint, limit, link, origin, solid_box};
use super::shapes::box_distance;

/// The module, by name.
pub const MODEL: &str = "self_collision_model_module";

/// What the network is told: numbers of all four DOFs that are not of the ball, and the ball's matrix.
const WIDTH: usize = 4 + 4 + 1 + 9;

/// A post with an arm of two links that can fold back onto it, a slider beside it, and a ball on that.
pub fn robot() -> Robot {
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
        (
            "shoulder",
            JointType::Revolute,
            "post",
            "arm",
            [0.0, 0.0, 0.3],
        ),
        ("elbow", JointType::Revolute, "arm", "tip", [0.3, 0.0, 0.0]),
        (
            "slide",
            JointType::Prismatic,
            "post",
            "slider",
            [0.4, 0.0, 0.0],
        ),
        (
            "socket",
            JointType::Spherical,
            "slider",
            "ball",
            [0.0, 0.0, 0.12],
        ),
    ] {
        let mut joint = joint(name, joint_type, parent, child);
        joint.origin = origin(at, [0.0; 3]);
        match name {
            "slide" => {
                joint.axis = Some(urdd::format::urdf::Axis {
                    xyz: Some([0.0, 0.0, 1.0]),
                });
                joint.limit = limit(-0.2, 0.6);
            }
            "socket" => {}
            _ => {
                joint.axis = Some(urdd::format::urdf::Axis {
                    xyz: Some([0.0, 1.0, 0.0]),
                });
                joint.limit = limit(-2.5, 2.5);
            }
        }
        robot.urdf.joints.push(joint);
    }
    robot
}

/// What is said of the model.
#[derive(Debug, Clone, Copy)]
pub struct Said {
    /// Added to the margin of each pair, metres.
    pub margin: f64,
    /// The held-out configurations: the first, and their number.
    pub held_out: [u32; 2],
}

impl Default for Said {
    fn default() -> Self {
        Said {
            margin: 0.0,
            held_out: [500, 400],
        }
    }
}

/// The robot with its model.
pub fn fixture() -> Fixture {
    fixture_with(Said::default())
}

/// The robot with a model of which this is said; the counts are what comes of it.
pub fn fixture_with(said: Said) -> Fixture {
    let robot = robot();
    let mut fixture = Fixture::full_with_edits(&robot, Vec::new());
    fixture.add_module(ModuleKind::SelfCollisionModel.folder(), Value::Null);
    let modules = fixture.doc_mut("urdd.json")["modules"].as_array_mut();
    let own = modules
        .and_then(|modules| modules.last_mut())
        .expect("the module");
    let kind = ModuleKind::SelfCollisionModel;
    own["depends_on"] = json!(
        kind.depends_on()
            .iter()
            .map(|k| k.name())
            .collect::<Vec<_>>()
    );
    fixture.canonical = true;
    fixture.seal();
    let mut document = document(&robot, said);
    document["trained_on"] = json!(trained_on(&fixture));
    *fixture.doc_mut(MODEL) = document;
    fixture.relist();
    fixture.seal();
    fixture
}

/// The digest of SPEC 8.8.7.
pub fn trained_on(fixture: &Fixture) -> String {
    let documents = [
        "dof_module",
        "chain_module",
        "bounds_module",
        "link_shapes_skips_module",
    ];
    let mut files: Vec<String> = documents
        .iter()
        .map(|module| format!("{}/module.json", fixture.folder(module)))
        .collect();
    let pieces = fixture.get("convex_decomposition_meshes_module", "/link_pieces");
    for piece in pieces.as_array().into_iter().flatten() {
        let glbs = piece.as_array().into_iter().flatten();
        files.extend(glbs.filter_map(|files| Some(files["glb"].as_str()?.to_owned())));
    }
    let text: String = files
        .iter()
        .map(|path| size_and_hash(fixture.file(path)).1 + "\n")
        .collect();
    let digest = Sha256::digest(text);
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The pairs that are not skipped: by hand. Neighbours are, by `Adjacent`; nothing else touches at rest.
const PAIRS: [[usize; 2]; 5] = [[0, 2], [1, 3], [1, 4], [2, 3], [2, 4]];
/// The post and the ball are apart always.
const OTHER: [usize; 2] = [0, 4];

/// The layers: three values of the angles and the slide, and one that nothing depends on, then a distance for each pair.
fn layers() -> [(Vec<Vec<f64>>, Vec<f64>); 2] {
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
    [
        (hidden, vec![0.125, -0.25, 0.0, 0.0]),
        (outputs, vec![0.2, 0.15, 0.15, 0.1, 0.1]),
    ]
}

fn margins(said: Said) -> Vec<f64> {
    [0.02, 0.03, 0.04, 0.05, 0.06]
        .map(|margin| margin + said.margin)
        .to_vec()
}

/// The clearances of SPEC 8.8.3 and 8.8.4.
fn clearances(q: &[f64], said: Said) -> Vec<f64> {
    let mut values: Vec<f64> = Vec::new();
    for angle in [q[0], q[1]] {
        values.extend([
            angle.sin(),
            angle.cos(),
            (2.0 * angle).sin(),
            (2.0 * angle).cos(),
        ]);
    }
    values.push((q[2] - 0.2) / 0.4);
    let angle = super::core::norm([q[3], q[4], q[5]]);
    let axis = match angle > 0.0 {
        true => super::core::unit([q[3], q[4], q[5]]),
        false => [1.0, 0.0, 0.0],
    };
    values.extend(rotation_about(axis, angle).into_iter().flatten());
    let [hidden, outputs] = layers();
    let layer = |values: &[f64], (weights, biases): &(Vec<Vec<f64>>, Vec<f64>)| -> Vec<f64> {
        let sums = weights.iter().zip(biases).map(|(row, bias)| {
            let products = row.iter().zip(values).map(|(w, x)| w * x);
            products.sum::<f64>() + bias
        });
        sums.collect()
    };
    let hidden: Vec<f64> = layer(&values, &hidden).into_iter().map(f64::tanh).collect();
    let outputs = layer(&hidden, &outputs).into_iter();
    outputs
        .zip(margins(said))
        .map(|(x, margin)| x - margin)
        .collect()
}

/// What distances are taken of.
struct Exact {
    robot: Robot,
    core: Core,
    meshes: Meshes,
}

impl Exact {
    fn touch(&self, at: &[Transform], [a, b]: [usize; 2]) -> bool {
        let placed = |link: usize| -> Vec<[Point; 8]> {
            let solids = self.meshes.solids[link].iter();
            let pieces = solids.flat_map(|solids| &solids.pieces);
            let place = |corner| apply(&at[link], corner);
            pieces.map(|piece| piece.corners.map(place)).collect()
        };
        let (a, b) = (placed(a), placed(b));
        let mut pairs = a.iter().flat_map(|a| b.iter().map(move |b| (a, b)));
        pairs.any(|(a, b)| box_distance(a, b) == 0.0)
    }

    /// Whether sampled configuration k is in collision, and whether the model clears it.
    fn judge(&self, k: u32, said: Said) -> (bool, bool) {
        let q = sampled_configuration(&self.robot, &self.core, k);
        let at = link_transforms(&self.robot, &self.core, &q);
        let mut pairs = PAIRS.iter().chain(std::iter::once(&OTHER));
        let collides = pairs.any(|pair| self.touch(&at, *pair));
        let clears = clearances(&q, said)
            .into_iter()
            .all(|clearance| clearance > 0.0);
        (collides, clears)
    }
}

fn exact(robot: &Robot) -> Exact {
    Exact {
        core: Core::new(robot),
        meshes: Meshes::new(robot),
        robot: robot.clone(),
    }
}

fn document(robot: &Robot, said: Said) -> Value {
    let exact = exact(robot);
    let [first, count] = said.held_out;
    let (mut colliding, mut missed, mut cleared) = (0, 0, 0);
    for k in first..first + count {
        let (collides, clears) = exact.judge(k, said);
        colliding += u32::from(collides);
        missed += u32::from(collides && clears);
        cleared += u32::from(!collides && clears);
    }
    let pairs = PAIRS.iter().zip(margins(said));
    let pairs =
        pairs.map(|([a, b], margin)| json!({ "link_a_idx": a, "link_b_idx": b, "margin": margin }));
    let layers = layers().map(|(weights, biases)| json!({ "weights": weights, "biases": biases }));
    let mut configurations = vec![default_configuration(robot, &exact.core)];
    configurations.extend([3, 4, 5].map(|k| sampled_configuration(robot, &exact.core, k)));
    let vectors = configurations
        .iter()
        .map(|q| json!({ "configuration": q, "clearances": clearances(q, said) }));
    json!({
        "trained_on": "",
        "clip_distance": 0.1,
        "inputs": [
            { "Angle": { "dof_idx": 0 } },
            { "Angle": { "dof_idx": 1 } },
            { "Length": { "dof_idx": 2, "middle": 0.2, "half_range": 0.4 } },
            { "RotationVector": { "dof_idxs": [3, 4, 5] } },
        ],
        "layers": layers,
        "pairs": pairs.collect::<Vec<_>>(),
        "other_pairs": [{ "link_a_idx": OTHER[0], "link_b_idx": OTHER[1] }],
        "training": { "first_sample_idx": 0, "num_configurations": 300 },
        "calibration": { "first_sample_idx": 300, "num_configurations": 200 },
        "held_out": {
            "first_sample_idx": first, "num_configurations": count,
            "num_colliding": colliding, "num_missed": missed, "num_cleared": cleared,
        },
        "test_vectors": vectors.collect::<Vec<_>>(),
    })
}
