//! `urdd info --statics` and `--order`.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::program::urdd;
use testkit::robots::made_of;

/// 2 kg at 0.2 m of a joint between 0.5 and 1 rad, which carries 1 kg at 0.1 m of a continuous one at 0.4 m. With angles of 0
/// both point along x, and positive ones lower them. A slide carries 3 kg.
const ARM: &str = r#"<robot name="arm"><link name="base"/>
  <link name="upper"><inertial><origin xyz="0.2 0 0"/><mass value="2"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="fore"><inertial><origin xyz="0.1 0 0"/><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="plate"><inertial><mass value="3"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="0.5" upper="1" effort="20" velocity="1"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="fore"/><origin xyz="0.4 0 0"/>
    <axis xyz="0 1 0"/><limit effort="0.9" velocity="1"/></joint>
  <joint name="lift" type="prismatic"><parent link="base"/><child link="plate"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" effort="0" velocity="1"/></joint></robot>"#;

fn statics(folder: &Path, more: &[&str]) -> Value {
    let (status, out, error) =
        urdd(&[&["info", "robot", "--statics", "--format", "json"], more].concat(), folder);
    assert_eq!((status, error.as_str()), (0, ""));
    let all: Value = serde_json::from_str(&out).expect("JSON");
    all[0]["statics"].clone()
}

fn near(found: &Value, expected: f64, tolerance: f64) {
    let found = found.as_f64().expect("a number");
    assert!((found - expected).abs() <= tolerance, "{found}, expected {expected}");
}

#[test]
fn statics_are_those_of_the_textbook() {
    let (folder, _) = made_of(ARM);
    let found = statics(folder.path(), &[]);
    assert_eq!(found["gravity"], json!([0.0, 0.0, -9.81]));
    assert_eq!([&found["payload"], &found["mass"]], [&Value::Null, &json!(6.0)]);
    let samples = found["num_samples"].as_f64().expect("a number");
    assert_eq!(samples, 1000.0);
    let [shoulder, elbow, lift] = [0, 1, 2].map(|dof| found["dofs"][dof].clone());
    // The default of the shoulder is its lower limit, where it also needs the most: but for the elbow, which is at 0.
    let hold = |elbow: f64| -9.81 * ((2.0 * 0.2 + 0.4) * 0.5_f64.cos() + 0.1 * elbow.cos());
    near(&shoulder["default"], hold(0.5), 1e-12);
    let worst = shoulder["worst"].as_f64().expect("a number");
    assert!(worst < hold(0.5) && worst > hold(0.0), "{worst}");
    assert_eq!(shoulder["limit"], 20.0);
    near(&shoulder["default_share"], -hold(0.5) / 20.0, 1e-12);
    near(&shoulder["worst_share"], -worst / 20.0, 1e-12);
    // Of 1,000 samples all around, one is within a hundredth of a turn of the horizontal.
    near(&elbow["default"], -9.81 * 0.1 * 0.5_f64.cos(), 1e-12);
    let most = elbow["worst"].as_f64().expect("a number").abs() / 0.981;
    assert!(most <= 1.0 && most > (PI / 50.0).cos(), "{most}");
    assert!(elbow["worst_share"].as_f64().expect("a number") > 1.0);
    // Without a limit above 0, there is no share of it.
    near(&lift["worst"], 3.0 * 9.81, 1e-12);
    assert_eq!(
        [&lift["unit"], &lift["limit"], &lift["worst_share"]],
        [&json!("N"), &json!(0.0), &Value::Null]
    );

    let loaded = statics(folder.path(), &["--payload", "2", "--at", "fore"]);
    assert_eq!(loaded["payload"], json!({"link": "fore", "mass": 2.0}));
    let more = -9.81 * 2.0 * 0.4 * 0.5_f64.cos();
    near(&loaded["dofs"][0]["default"], hold(0.5) + more, 1e-12);
    near(&loaded["dofs"][1]["default"], -9.81 * 0.1 * 0.5_f64.cos(), 1e-12);
}

#[test]
fn statics_are_a_table_for_people() {
    let (folder, _) = made_of(ARM);
    let (_, out, _) = urdd(&["info", "--statics", "robot"], folder.path());
    let table = out.split_once("  statics   ").expect("a table").1;
    let rows: Vec<Vec<&str>> = table
        .lines()
        .map(|line| line.split("  ").map(str::trim).filter(|word| !word.is_empty()).collect())
        .collect();
    assert_eq!(rows[0], ["what holds 6 kg still"]);
    assert_eq!(rows[3], ["DOF", "default", "worst of 1000", "limit", "used"]);
    assert_eq!([rows[4][0], rows[4][1], rows[4][3]], ["shoulder", "-7.75 N m", "20 N m"]);
    assert!(rows[5][4].ends_with(" %, too much"), "{rows:?}");
    assert_eq!(rows[6], ["lift", "29.4 N", "29.4 N", "0 N"]);
    let (_, without, _) = urdd(&["info", "robot"], folder.path());
    assert!(!without.contains("statics"));
}

#[test]
fn payloads_that_make_no_sense_are_refused() {
    let (folder, _) = made_of(ARM);
    for (arguments, words) in [
        (&["--statics", "--payload", "1"][..], "--at <LINK>"),
        (&["--payload", "1", "--at", "fore"], "--statics"),
        (&["--statics", "--at", "fore"], "--payload <KG>"),
        (&["--statics", "--payload", "1", "--at", "four"], "did you mean `fore`?"),
        (&["--statics", "--payload=-1", "--at", "fore"], "not below 0 kg"),
        (&["--statics", "--payload", "nan", "--at", "fore"], "finite"),
    ] {
        let (status, out, error) = urdd(&[&["info", "robot"], arguments].concat(), folder.path());
        assert_eq!((status, out.as_str()), (2, ""), "{error}");
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn a_number_of_samples_is_bounded() {
    let (folder, urdd) = made_of(ARM);
    let module =
        urdd.join("link_shapes_modules/link_shapes_distance_statistics_module/module.json");
    let text = fs::read_to_string(&module).expect("a module");
    let more = text.replace("\"num_samples\": 1000", "\"num_samples\": 4294967295");
    assert_ne!(text, more);
    fs::write(&module, more).expect("written");
    assert_eq!(statics(folder.path(), &[])["num_samples"], 100_000);
}

/// The joints of a link come in the order of the file, but for Pinocchio, Newton and Isaac; a program goes down first, or across.
const TREE: &str = r#"<robot name="tree"><link name="root"/><link name="z1"/><link name="a1"/><link name="z2"/><link name="a2"/>
  <joint name="z_second" type="continuous"><parent link="z1"/><child link="z2"/><axis xyz="0 0 1"/></joint>
  <joint name="z_first" type="continuous"><parent link="root"/><child link="z1"/><axis xyz="0 0 1"/></joint>
  <joint name="a_first" type="continuous"><parent link="root"/><child link="a1"/><axis xyz="0 0 1"/></joint>
  <joint name="a_second" type="continuous"><parent link="a1"/><child link="a2"/><axis xyz="0 0 1"/></joint></robot>"#;

#[test]
fn joints_are_in_the_order_of_each_program() {
    let (folder, _) = made_of(TREE);
    let (status, out, error) =
        urdd(&["info", "robot", "--order", "--format", "json"], folder.path());
    assert_eq!((status, error.as_str()), (0, ""));
    let all: Value = serde_json::from_str(&out).expect("JSON");
    let orders = all[0]["order"].as_array().expect("a list");
    let order = |program: &str| {
        orders.iter().find(|order| order["program"] == program).expect(program).clone()
    };
    assert_eq!(order("urdf")["joints"], json!(["z_second", "z_first", "a_first", "a_second"]));
    assert_eq!(order("mujoco")["joints"], json!(["z_first", "z_second", "a_first", "a_second"]));
    assert_eq!(order("pinocchio")["joints"], json!(["a_first", "a_second", "z_first", "z_second"]));
    assert_eq!(order("isaac")["joints"], json!(["a_first", "z_first", "a_second", "z_second"]));
    assert_eq!(
        [&order("isaac")["export"], &order("isaac")["rule"]],
        ["usd", "breadth first, the joints of a link by name"]
    );
    assert_eq!(order("mujoco")["actuators"], order("urdf")["joints"]);
    assert_eq!(order("isaac")["actuators"], Value::Null);

    let (_, out, _) = urdd(&["info", "--order", "robot"], folder.path());
    let table = out.split_once("  order     of joints that move\n").expect("a table").1;
    let rows: Vec<Vec<&str>> = table
        .lines()
        .map(|line| line.split("  ").map(str::trim).filter(|word| !word.is_empty()).collect())
        .collect();
    let heads = ["urdf, libsdformat", "mujoco, pybullet, drake", "pinocchio, newton", "isaac"];
    assert_eq!(rows[0], heads);
    assert_eq!(rows[1], ["0", "z_second", "z_first", "a_first", "a_first"]);
    assert_eq!(rows[4], ["3", "a_second", "a_second", "z_second", "z_second"]);
    assert_eq!(rows[5], ["actuators of exports that have them"]);
    let (_, without, _) = urdd(&["info", "robot"], folder.path());
    assert!(!without.contains("order"));
}
