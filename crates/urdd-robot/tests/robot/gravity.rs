//! What holds a robot still: held to the textbook and to Pinocchio.

use serde::Deserialize;
use urdd_robot::{GravitySettings, Payload, Robot, RobotError};

use testkit::robots::{made, made_of};

/// Two links that turn in the x-z plane: 2 kg at 0.25 m of 0.5 m, and 1 kg at 0.2 m. With q = 0 they point along x, and
/// positive angles lower them.
const ARM: &str = r#"<robot name="arm"><link name="base"/>
  <link name="upper"><inertial><origin xyz="0.25 0 0"/><mass value="2"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="fore"><inertial><origin xyz="0.2 0 0"/><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="fore"/><origin xyz="0.5 0 0"/>
    <axis xyz="0 1 0"/></joint></robot>"#;

fn near(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    let scale = expected.iter().fold(1e-3_f64, |most, x| most.max(x.abs()));
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= tolerance * scale, "{found:?}, expected {expected:?}");
    }
}

#[test]
fn an_arm_as_the_textbook_has_it() {
    let (_folder, path) = made_of(ARM);
    let robot = Robot::open(path).unwrap();
    let (a, b) = (0.3_f64, -0.9_f64);
    let settings = GravitySettings::default();
    let elbow = -9.81 * 0.2 * (a + b).cos();
    let shoulder = elbow - 9.81 * (2.0 * 0.25 + 1.0 * 0.5) * a.cos();
    let found = robot.gravity_torques(&[a, b], &settings).unwrap();
    near(&found, &[shoulder, elbow], 1e-15);

    // A payload that hangs 0.1 m below the second link's axis, on another planet.
    let fore = robot.link("fore").unwrap();
    let payload = Some(Payload { link: fore, mass: 3.0, point: [0.4, 0.0, -0.1] });
    let other = GravitySettings { gravity: [0.0, 0.0, -3.7], payload };
    let (c, s) = ((a + b).cos(), (a + b).sin());
    let elbow = -3.7 * (0.2 * c + 3.0 * (0.4 * c - 0.1 * s));
    let shoulder = elbow - 3.7 * (2.0 * 0.25 + 4.0 * 0.5) * a.cos();
    let loaded = robot.gravity_torques(&[a, b], &other).unwrap();
    near(&loaded, &[shoulder, elbow], 1e-15);

    let batch = robot.gravity_torques_batch(&[a, b, 0.0, 0.0, a, b], &settings).unwrap();
    assert_eq!([&batch[..2], &batch[4..]], [&found[..], &found[..]]);
    near(&batch[2..4], &[-9.81 * 1.2, -9.81 * 0.2], 1e-15);
}

#[test]
fn settings_that_make_no_sense_are_refused() {
    let (_folder, path) = made_of(ARM);
    let robot = Robot::open(path).unwrap();
    let ask =
        |gravity, payload| robot.gravity_torques(&[0.0; 2], &GravitySettings { gravity, payload });
    let down = [0.0, 0.0, -9.81];
    let carried = |link, mass, point| Some(Payload { link, mass, point });
    assert!(ask(down, carried(2, 0.0, [0.0; 3])).is_ok());
    for (gravity, payload) in [
        ([f64::NAN, 0.0, 0.0], None),
        (down, carried(1, -1.0, [0.0; 3])),
        (down, carried(1, f64::INFINITY, [0.0; 3])),
        (down, carried(1, 1.0, [0.0, f64::NAN, 0.0])),
    ] {
        let found = ask(gravity, payload);
        assert!(matches!(found, Err(RobotError::Setting(_))), "{gravity:?} {payload:?}: {found:?}");
    }
    let out_of_range = RobotError::OutOfRange { what: "link", index: 3, count: 3 };
    assert_eq!(ask(down, carried(3, 1.0, [0.0; 3])), Err(out_of_range));
    let room = robot.gravity_torques_into(&[0.0; 2], &GravitySettings::default(), &mut [0.0; 3]);
    assert_eq!(room, Err(RobotError::Room { found: 3, count: 1, width: 2 }));
    let short = robot.gravity_torques(&[0.0], &GravitySettings::default());
    assert!(matches!(short, Err(RobotError::Configuration(_))), "{short:?}");
}

#[derive(Deserialize)]
struct Figures {
    robots: Vec<Figure>,
}

#[derive(Deserialize)]
struct Figure {
    path: String,
    configurations: Vec<Configuration>,
}

#[derive(Deserialize)]
struct Configuration {
    configuration: Vec<f64>,
    gravity: [f64; 3],
    payload: Option<Carried>,
    torques: Vec<f64>,
}

#[derive(Deserialize)]
struct Carried {
    link: String,
    mass: f64,
    point: [f64; 3],
}

/// `tests/figures/make_gravity_torques.py` wrote the numbers.
#[test]
fn torques_are_those_of_pinocchio() {
    let file = testkit::repository().join("tests/figures/gravity_torques.json");
    let figures: Figures = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    assert_eq!(figures.robots.len(), 9);
    for Figure { path, configurations } in &figures.robots {
        let (_folder, urdd) = made(&testkit::repository().join(path));
        let robot = Robot::open(urdd).unwrap();
        for one in configurations {
            let payload = one.payload.as_ref().map(|Carried { link, mass, point }| Payload {
                link: robot.link(link).unwrap(),
                mass: *mass,
                point: *point,
            });
            let settings = GravitySettings { gravity: one.gravity, payload };
            let found = robot.gravity_torques(&one.configuration, &settings).unwrap();
            near(&found, &one.torques, 1e-9);
        }
    }
}
