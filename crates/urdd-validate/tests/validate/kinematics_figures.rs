//! Kinematics compared with figures from Pinocchio, MuJoCo and plain Python: those of our robots are in
//! `conformance/vectors`, those of others in `tests/figures`.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use nalgebra::{Isometry3, UnitQuaternion};
use serde::Deserialize;
use sha2::{Digest, Sha256};
use testkit::core_modules::{Joint, chain_of, core_modules, dof_count};
use urdd_format::bounds::BoundsModule;
use urdd_format::pose::Pose;
use urdd_kinematics::pose::to_isometry;
use urdd_kinematics::rotation::{rotation_distance, to_rotation_vector, uniform_rotation};
use urdd_kinematics::{ConfigurationSpace, ForwardKinematics, unit};
use urdd_validate::reference::{MimicDofs, Reference};

const VECTORS: &str = "conformance/vectors";

/// The other implementations differ from each other by 2e-15.
const TOLERANCE: f64 = 1e-13;

#[derive(Deserialize)]
struct Figures {
    robots: Vec<Robot>,
}

#[derive(Deserialize)]
struct Robot {
    source: String,
    path: PathBuf,
    sha256: String,
    links_in_robot: usize,
    root: String,
    configurations: Vec<Configuration>,
}

#[derive(Deserialize)]
struct Configuration {
    label: String,
    joints: HashMap<String, Vec<f64>>,
    /// The same in DOF order: in the vectors.
    configuration: Option<Vec<f64>>,
    links: HashMap<String, Pose>,
}

fn repository() -> &'static Path {
    testkit::repository()
}

fn figures<T: for<'de> Deserialize<'de>>(folder: &str, name: &str) -> T {
    let path = repository().join(folder).join(name);
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// Compares every robot of `source`, whose files are below `folder`.
fn compare(source: &str, folder: &Path) {
    let place = match source {
        "urdd" => VECTORS,
        _ => "tests/figures",
    };
    let figures: Figures = figures(place, "forward_kinematics.json");
    let mut compared = 0;
    for robot in figures.robots.iter().filter(|robot| robot.source == source) {
        let path = folder.join(&robot.path);
        let text =
            fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let hash: String = Sha256::digest(&text).iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(
            hash,
            robot.sha256,
            "{} is not the file that the figures were made of",
            path.display()
        );
        compare_robot(robot, &text);
        compared += 1;
    }
    assert!(compared > 0, "no robots of source {source}");
}

fn compare_robot(robot: &Robot, text: &str) {
    let (links, joints) = testkit::urdf_to_core::read(text);
    let (chain, dof) = core_modules(&links, &joints);
    let kinematics = ForwardKinematics::new(&chain, &dof).unwrap();
    assert_eq!(kinematics.num_links(), robot.links_in_robot);
    assert_eq!(links[kinematics.root()], robot.root);
    for configuration in &robot.configurations {
        let moving = joints.iter().filter(|joint| dof_count(joint) > 0);
        let q: Vec<f64> =
            moving.flat_map(|joint| configuration.joints[&joint.name].clone()).collect();
        if let Some(in_dof_order) = &configuration.configuration {
            assert_eq!(&q, in_dof_order, "{}", robot.path.display());
            // The validator's reference too, which shares no code with the consumer's kinematics.
            let reference = Reference::new(
                &urdd_validate::urdf_text::read(text).robot.unwrap(),
                MimicDofs::Follow,
            )
            .unwrap();
            compare_poses(robot, configuration, &links, &reference.link_poses(&q).unwrap());
            assert_eq!(configuration.links.len(), links.len());
        }
        let poses = kinematics.link_poses(&q).unwrap();
        compare_poses(robot, configuration, &links, &poses);
    }
}

fn compare_poses(
    robot: &Robot,
    configuration: &Configuration,
    links: &[String],
    poses: &[Isometry3<f64>],
) {
    for (name, pose) in &configuration.links {
        let found = &poses[links.iter().position(|link| link == name).unwrap()];
        let expected = to_isometry(pose).unwrap();
        let place = format!("{}, {}, link {name}", robot.path.display(), configuration.label);
        let (position, rotation) = (
            (found.translation.vector - expected.translation.vector).norm(),
            rotation_distance(&found.rotation, &expected.rotation),
        );
        assert!(position < TOLERANCE, "{place}: {position:e} m off");
        assert!(rotation < TOLERANCE, "{place}: turned by {rotation:e}");
    }
}

/// A folder outside this repository, named by an environment variable.
fn elsewhere(variable: &str, default: &str) -> PathBuf {
    std::env::var_os(variable).map_or_else(|| repository().join(default), PathBuf::from)
}

#[test]
fn our_own_robots() {
    compare("urdd", repository());
}

#[test]
#[ignore = "needs ../shared, or what URDD_SHARED names"]
fn published_urdds() {
    compare("corpus", &elsewhere("URDD_SHARED", "../shared").join("corpus"));
}

#[test]
#[ignore = "needs ../shared, or what URDD_SHARED names"]
fn robots_of_the_timing_table() {
    compare("robots", &elsewhere("URDD_SHARED", "../shared").join("robots"));
}

#[test]
#[ignore = "needs the data of PyPI's example-robot-data, which EXAMPLE_ROBOT_DATA names"]
fn example_robot_data() {
    compare("example-robot-data", &elsewhere("EXAMPLE_ROBOT_DATA", "../example-robot-data"));
}

#[derive(Deserialize)]
struct Samples {
    u: Vec<Unit>,
    rotations: Vec<Rotation>,
    joints: Vec<SampledJoint>,
    configurations: Vec<SampledConfiguration>,
}

#[derive(Deserialize)]
struct SampledJoint {
    joint_type: String,
    bounds: Vec<[f64; 2]>,
}

#[derive(Deserialize)]
struct SampledConfiguration {
    name: String,
    sample_idx: Option<u64>,
    configuration: Vec<f64>,
}

#[derive(Deserialize)]
struct Unit {
    k: u64,
    i: u64,
    mantissa: u64,
    u: f64,
}

#[derive(Deserialize)]
struct Rotation {
    u: [f64; 3],
    quaternion_wxyz: [f64; 4],
    rotation_vector: [f64; 3],
}

#[test]
fn units() {
    let samples: Samples = figures(VECTORS, "sampled_configurations.json");
    assert!(!samples.u.is_empty());
    for figure in samples.u {
        let found = unit(figure.k, figure.i);
        assert_eq!(found, figure.u, "u({}, {})", figure.k, figure.i);
        assert_eq!(found * 2_f64.powi(53), figure.mantissa as f64);
    }
}

#[test]
fn uniform_rotations() {
    let samples: Samples = figures(VECTORS, "sampled_configurations.json");
    assert!(!samples.rotations.is_empty());
    for figure in samples.rotations {
        let q: UnitQuaternion<f64> = uniform_rotation(figure.u);
        let found = [q.w, q.i, q.j, q.k];
        assert_near(&found, &figure.quaternion_wxyz);
        assert_near(&to_rotation_vector(&q), &figure.rotation_vector);
    }
}

/// Joints of every type, a ball whose first DOF is not 0 among them.
#[test]
fn whole_configurations() {
    let samples: Samples = figures(VECTORS, "sampled_configurations.json");
    let joint = |(i, joint): (usize, &SampledJoint)| {
        let joint_type = serde_json::from_value(joint.joint_type.clone().into()).unwrap();
        Joint::after(i, joint_type, [1.0, 0.0, 0.0])
    };
    let joints: Vec<Joint> = samples.joints.iter().enumerate().map(joint).collect();
    let (chain, dof) = chain_of(&joints);
    let bounds: Vec<[f64; 2]> = samples.joints.iter().flat_map(|j| j.bounds.clone()).collect();
    let bounds = BoundsModule {
        dof_lower_bounds: bounds.iter().map(|[lower, _]| *lower).collect(),
        dof_upper_bounds: bounds.iter().map(|[_, upper]| *upper).collect(),
        dof_limited: vec![true; bounds.len()],
        dof_velocity_limits: vec![None; bounds.len()],
        dof_effort_limits: vec![None; bounds.len()],
        bounds,
    };
    let space = ConfigurationSpace::new(&dof, &chain, &bounds.bounds).unwrap();
    assert!(samples.configurations.len() > 6);
    for figure in &samples.configurations {
        let found = match (figure.name.as_str(), figure.sample_idx) {
            ("Zero", None) => space.zero(),
            ("Middle", None) => space.middle(),
            ("Lower", None) => space.lower(),
            ("Upper", None) => space.upper(),
            ("Sampled", Some(k)) => space.sampled(k),
            other => panic!("{other:?}"),
        };
        assert_near(&found, &figure.configuration);
    }
}

#[track_caller]
fn assert_near(found: &[f64], expected: &[f64]) {
    let near = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-14);
    assert!(near && found.len() == expected.len(), "{found:?}, expected {expected:?}");
}
