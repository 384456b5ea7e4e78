//! Named configurations: the command that edits them, and a new run, which keeps them.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use urdd_generate::{Generated, Selection, Settings, generate};
use urdd_robot::{Robot, RobotError};

use crate::generate::{bytes_below, findings_of, read_json};
use crate::program::urdd;

/// A lift from 0.5 m to 2 m, an arm on it, and a wheel that turns without end.
const ROBOT: &str = r#"<robot name="r">
  <link name="a"/><link name="b"/><link name="c"/><link name="d"/>
  <joint name="lift" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/><limit lower="0.5" upper="2" effort="1" velocity="1"/></joint>
  <joint name="arm" type="revolute"><parent link="b"/><child link="c"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="wheel" type="continuous"><parent link="a"/><child link="d"/><axis xyz="0 1 0"/></joint>
</robot>
"#;
const MODULE: &str = "named_configurations_module";

fn settings() -> Settings {
    Settings { selection: Selection::parse(["core"]).expect("a class"), ..Settings::default() }
}

/// A URDD of the robot in the folder `out`.
fn made() -> (tempfile::TempDir, PathBuf) {
    let folder = testkit::temporary::folder();
    let target = folder.path().join("out");
    again(folder.path(), ROBOT).expect("a robot");
    (folder, target)
}

fn again(folder: &Path, robot: &str) -> Result<Generated, urdd_generate::GenerateError> {
    let source = folder.join("r.urdf");
    fs::write(&source, robot).expect("a file");
    generate(&source, &folder.join("out"), &settings(), &())
}

fn set(folder: &Path, arguments: &[&str]) {
    let words = [&["configurations", "set", "out"], arguments].concat();
    let (status, _, error) = urdd(&words, folder);
    assert_eq!((status, error.as_str()), (0, ""), "{arguments:?}");
}

fn document(target: &Path) -> Value {
    read_json(&target.join(MODULE).join("module.json"))
}

fn position(dof: &str, position: f64) -> Value {
    json!({"dof_name": dof, "position": position})
}

#[test]
fn configurations_are_set_listed_and_removed() {
    let (folder, target) = made();
    let folder = folder.path();
    let list = || urdd(&["configurations", "list", "out"], folder).1;
    assert_eq!(list(), "out: no named configurations\n");
    set(folder, &["home", "wheel=-7.5", "arm=0.25"]);
    set(folder, &["ready"]);
    assert_eq!(list(), "home: arm=0.25 wheel=-7.5\nready:\n");
    assert_eq!(findings_of(&target), []);
    // Positions are in DOF order. A DOF without one is at 0, or at its bound nearest to 0.
    let ready = json!({"name": "ready", "positions": [], "configuration": [0.5, 0.0, 0.0]});
    let home = json!({
        "name": "home",
        "positions": [position("arm", 0.25), position("wheel", -7.5)],
        "configuration": [0.5, 0.25, -7.5],
    });
    assert_eq!(document(&target), json!({"configurations": [home, ready]}));
    // A configuration that is replaced keeps its place.
    set(folder, &["home", "lift=2"]);
    assert_eq!(list(), "home: lift=2\nready:\n");
    let robot = Robot::open(&target).expect("a robot");
    assert_eq!(robot.named_configuration("home"), Ok(&[2.0, 0.0, 0.0][..]));
    let Err(RobotError::Unknown { nearest, .. }) = robot.named_configuration("hom") else {
        panic!("there is no such configuration");
    };
    assert_eq!(nearest.as_deref(), Some("home"));
    let (status, out, _) = urdd(&["configurations", "remove", "out", "home"], folder);
    assert_eq!((status, out.as_str()), (0, "out: removed; 1 named configuration\n"));
    assert_eq!(list(), "ready:\n");
    assert_eq!(findings_of(&target), []);
    let (status, ..) = urdd(&["configurations", "remove", "out", "ready"], folder);
    assert_eq!((status, list().as_str()), (0, "out: no named configurations\n"));
    assert_eq!(findings_of(&target), []);
    // A new run writes no empty module.
    again(folder, ROBOT).expect("a robot");
    assert!(!target.join(MODULE).exists());
    assert_eq!(findings_of(&target), []);
}

#[test]
fn what_cannot_be_set_changes_nothing() {
    let (folder, target) = made();
    let folder = folder.path();
    set(folder, &["home", "arm=0.25"]);
    let before = bytes_below(&target);
    let refused: [(&[&str], &str); 10] = [
        (&["list", "."], "chain_module is missing"),
        (&["set", "out", "home", "am=1"], "there is no DOF `am`; did you mean `arm`?"),
        (
            &["set", "out", "home", "arm=1.5"],
            "the DOF `arm` cannot be at 1.5: its bounds are -1 and 1",
        ),
        (
            &["set", "out", "home", "lift=0"],
            "the DOF `lift` cannot be at 0: its bounds are 0.5 and 2",
        ),
        (&["set", "out", "home", "arm"], "`arm` is not DOF=POSITION"),
        (&["set", "out", "home", "arm=90deg"], "`90deg` is not a number"),
        (&["set", "out", "home", "arm=nan"], "`nan` is not a number"),
        (&["set", "out", "home", "arm=1", "arm=1"], "the DOF `arm` is given twice"),
        (&["set", "out", "", "arm=1"], "the name of a configuration is empty"),
        (&["remove", "out", "hom"], "there is no configuration `hom`; did you mean `home`?"),
    ];
    for (words, message) in refused {
        let words = [&["configurations"], words].concat();
        let (status, out, error) = urdd(&words, folder);
        assert_eq!((status, out.as_str()), (2, ""), "{words:?}");
        assert!(error.contains(message), "{error}");
        assert_eq!(bytes_below(&target), before, "{words:?}");
    }
}

#[test]
fn a_new_run_keeps_them_and_computes_their_values_again() {
    let (folder, target) = made();
    let folder = folder.path();
    set(folder, &["home", "arm=0.25", "wheel=-7.5"]);
    set(folder, &["up", "lift=2", "arm=-1"]);
    // The DOFs are in another order, the lift is lower, the arm has smaller limits, and the wheel is gone.
    let other = ROBOT
        .replace("lower=\"0.5\" upper=\"2\"", "lower=\"-0.5\" upper=\"-0.25\"")
        .replace("lower=\"-1\" upper=\"1\"", "lower=\"-0.5\" upper=\"1\"")
        .replace("name=\"wheel\" type=\"continuous\"", "name=\"wheel\" type=\"fixed\"");
    let generated = again(folder, &other).expect("a robot");
    let notes: Vec<String> = generated.notes.iter().map(ToString::to_string).collect();
    let lost: Vec<&String> = notes.iter().filter(|note| note.contains("configuration `")).collect();
    assert_eq!(lost.len(), 3, "{notes:?}");
    for (note, words) in lost.iter().zip([
        "the configuration `home` has a position of the DOF `wheel`, but the robot has no such DOF",
        "the configuration `up` has the DOF `lift` at 2, but its bounds are -0.5 and -0.25",
        "the configuration `up` has the DOF `arm` at -1, but its bounds are -0.5 and 1",
    ]) {
        assert!(note.contains(words), "{note}");
    }
    let home = json!({
        "name": "home", "positions": [position("arm", 0.25)], "configuration": [-0.25, 0.25],
    });
    let up = json!({"name": "up", "positions": [], "configuration": [-0.25, 0.0]});
    assert_eq!(document(&target), json!({"configurations": [home, up]}));
    assert_eq!(findings_of(&target), []);
    // Nothing changes from then on.
    assert!(!again(folder, &other).expect("a robot").changed);
    // A person edits the positions alone.
    let file = target.join(MODULE).join("module.json");
    let mut edited = document(&target);
    edited["configurations"][1]["positions"] = json!([position("arm", 0.75)]);
    fs::write(&file, edited.to_string()).expect("a file");
    again(folder, &other).expect("a robot");
    assert_eq!(document(&target)["configurations"][1]["configuration"], json!([-0.25, 0.75]));
    assert_eq!(findings_of(&target), []);
}

#[test]
fn configurations_that_cannot_be_read_stop_the_run() {
    let (folder, target) = made();
    let folder = folder.path();
    set(folder, &["home", "arm=0.25"]);
    let file = target.join(MODULE).join("module.json");
    let good = document(&target);
    let with = |pointer: &str, value: Value| {
        let mut document = good.clone();
        *document.pointer_mut(pointer).expect("a place") = value;
        document.to_string()
    };
    let at = "/configurations/0";
    let twice = json!([good["configurations"][0], good["configurations"][0]]);
    let both = json!([position("arm", 0.25), position("arm", 0.5)]);
    let cases = [
        ("{".to_owned(), "module.json:1:"),
        ("{}".to_owned(), "`configurations` must be a list"),
        (with("/configurations", Value::Null), "`configurations` must be a list"),
        (with("/configurations", json!([{"name": "x"}])), "`positions` is missing"),
        (with("/configurations", twice), "an earlier one has this name"),
        (with(&format!("{at}/name"), json!("")), "expected a string matching"),
        (with(&format!("{at}/positions/0/position"), Value::Null), "invalid type: null"),
        (
            with(&format!("{at}/positions/0/dof_name"), json!("amr")),
            "the robot of this URDD has no DOF `amr`",
        ),
        (with(&format!("{at}/positions"), both), "it sets the DOF `arm` twice"),
    ];
    for (text, words) in cases {
        fs::write(&file, &text).expect("a file");
        let before = bytes_below(&target);
        let error = again(folder, ROBOT).expect_err("a refusal").to_string();
        assert!(error.contains(words), "{text}: {error}");
        let lost = "a new run would lose a person's named configurations in it";
        assert!(error.contains(lost), "{error}");
        assert_eq!(bytes_below(&target), before, "{text}");
    }
    // The YAML alone was edited.
    fs::write(&file, good.to_string()).expect("a file");
    let yaml = file.with_extension("yaml");
    let text = fs::read_to_string(&yaml).expect("a file");
    fs::write(&yaml, text.replace("0.25", "0.5")).expect("a file");
    let error = again(folder, ROBOT).expect_err("a refusal").to_string();
    assert!(error.contains("module.yaml"), "{error}");
    let dropped = Settings { drop_edits: true, ..settings() };
    generate(&folder.join("r.urdf"), &target, &dropped, &()).expect("a robot");
    assert!(!target.join(MODULE).exists());
}
