//! MJCF, SDF and USD as sources, from outside.

use std::fs;
use std::path::Path;

use serde_json::Value;
use testkit::page::assert_between;
use testkit::repository;
use urdd_import::imported_table;

use crate::program::urdd;

const MARKS: [&str; 2] =
    ["<!-- table: what is carried of each format -->\n", "<!-- end of table -->"];

#[test]
fn the_page_of_imports_has_the_table() {
    let how = "cargo test --test program imports";
    assert_between("docs/import.md", MARKS, &imported_table(), how);
}

fn example(name: &str) -> String {
    repository().join("examples").join(name).display().to_string()
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("a file")).expect("JSON")
}

#[test]
fn files_are_written_once_and_never_over_those_of_a_person() {
    let folder = tempfile::tempdir().expect("a folder");
    let arm = example("mjcf/arm.xml");
    let import = |more: &[&str]| {
        urdd(
            &[&["import", &arm, "-o", "arm", "--report", "report.json"], more].concat(),
            folder.path(),
        )
    };
    let (status, out, notes) = import(&[]);
    assert_eq!(status, 0, "{notes}");
    assert!(out.contains("tabletop_arm.urdf: 9 links, 8 joints"), "{out}");
    let there = |name: &str| folder.path().join("arm").join(name);
    for name in ["tabletop_arm.urdf", "tabletop_arm.srdf", "tabletop_arm.export.toml"] {
        assert!(there(name).is_file(), "{name}");
    }
    assert!(there("meshes/turret.obj").is_file());
    let report = json(&folder.path().join("report.json"));
    for key in ["carried", "otherwise", "lost", "notes"] {
        assert!(report[key].is_array(), "{key}");
    }
    assert_eq!(report["format"], "mjcf");
    // The same again is no change.
    assert_eq!(import(&[]).0, 0);
    fs::write(there("tabletop_arm.srdf"), "<robot name=\"mine\"/>").expect("written");
    let (status, _, said) = import(&[]);
    assert_eq!(status, 2);
    assert!(said.contains("tabletop_arm.srdf already exists: --force overwrites it"), "{said}");
    assert_eq!(import(&["--force"]).0, 0);
    // A companion of another import would be read with this URDF.
    fs::write(there("tabletop_arm.loops.toml"), "[[loop]]").expect("written");
    let (status, _, said) = import(&[]);
    assert!(
        status == 0 && said.contains("tabletop_arm.loops.toml: is not of this import"),
        "{said}"
    );
}

#[test]
fn a_urdd_of_an_mjcf_has_its_poses_pairs_and_origin_and_passes() {
    let folder = tempfile::tempdir().expect("a folder");
    let arm = example("mjcf/arm.xml");
    let (status, _, said) = urdd(&["generate", &arm, "-o", "arm"], folder.path());
    assert_eq!(status, 0, "{said}");
    let (status, out, _) = urdd(&["validate", "arm"], folder.path());
    assert!(status == 0 && out.contains("0 findings"), "{out}");
    let origin = &json(&folder.path().join("arm/urdd.json"))["source"]["x_urdd_imported"];
    assert_eq!(origin["format"], "mjcf");
    assert_eq!(origin["files"][0]["name"], "arm.xml");
    let bytes = fs::read(&arm).expect("a file");
    assert_eq!(origin["files"][0]["size"], bytes.len());
    let named = json(&folder.path().join("arm/named_configurations_module/module.json"));
    let home = &named["configurations"][0];
    assert_eq!(home["name"], "home");
    // The qpos of the file; the fingers follow each other.
    let values: Vec<f64> = home["configuration"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(Value::as_f64)
        .collect();
    assert_eq!(values, [0.0, -0.6, 1.4, 0.8, 0.0, 0.02]);
    let skips =
        json(&folder.path().join("arm/link_shapes_modules/link_shapes_skips_module/module.json"));
    let edits = skips["edits"].as_array().expect("a list");
    let is_excluded = |edit: &Value| edit["link_a"] == "base" && edit["link_b"] == "upper_arm";
    assert!(edits.iter().any(is_excluded), "{edits:?}");
    let setup = fs::read_to_string(folder.path().join("arm.export.toml")).expect("a file");
    assert!(
        setup.contains("[actuators.joint.elbow]\narmature = 0.05\nkp = 400.0\nkv = 40.0"),
        "{setup}"
    );
    // A person's file stays.
    fs::write(folder.path().join("arm.export.toml"), "robot = \"tabletop_arm\"\n")
        .expect("written");
    let (status, _, said) = urdd(&["generate", &arm, "-o", "arm"], folder.path());
    assert!(status == 0 && said.contains("arm.export.toml: "), "{said}");
    let kept = fs::read_to_string(folder.path().join("arm.export.toml")).expect("a file");
    assert_eq!(kept, "robot = \"tabletop_arm\"\n");
    let (status, _, said) = urdd(&["export", "moveit", "arm", "-o", "moveit"], folder.path());
    assert_eq!(status, 0, "{said}");
}

#[test]
fn an_sdf_is_compared_linted_and_generated_as_the_urdf_that_it_becomes() {
    let folder = tempfile::tempdir().expect("a folder");
    let cart = example("sdf/model.sdf");
    let (status, out, said) =
        urdd(&["import", &cart, "-o", "cart", "--ball", "revolute"], folder.path());
    assert_eq!(status, 0, "{said}");
    assert!(out.contains("lift_cart.urdf: 9 links, 8 joints"), "{out}");
    let (status, out, said) =
        urdd(&["diff", &cart, "cart/lift_cart.urdf", "--ball", "revolute"], folder.path());
    assert_eq!(status, 0, "{out}{said}");
    // MuJoCo refuses links between joints that have no mass.
    let refuses = |more: &[&str]| {
        let lint = ["lint", &cart, "--format", "json", "--ball", "revolute", "--for", "mujoco"];
        let (_, out, _) = urdd(&[&lint[..], more].concat(), folder.path());
        let report: Value = serde_json::from_str(&out).expect("JSON");
        report["urdds"][0]["programs"][0]["does"] == "refuses"
    };
    assert!(refuses(&[]) && !refuses(&["--massless", "tiny"]));
    let (_, out, _) = urdd(&["lint", &cart, "--format", "json"], folder.path());
    let report: Value = serde_json::from_str(&out).expect("JSON");
    let cart_of = &report["urdds"][0];
    assert_eq!(cart_of["kind"], "urdf");
    assert_eq!(cart_of["imported"]["format"], "sdf");
    // The ball joint, by its line in the SDF.
    let findings = cart_of["findings"].as_array().expect("a list");
    let ball = findings.iter().find(|finding| finding["code"] == "LNT060").expect("a finding");
    let line = fs::read_to_string(&cart).expect("a file");
    let line = 1 + line.lines().position(|line| line.contains("type=\"ball\"")).expect("a line");
    assert_eq!((&ball["line"], &ball["file"]), (&line.into(), &"model.sdf".into()));
    let (status, _, said) = urdd(&["generate", &cart, "-o", "made"], folder.path());
    assert_eq!(status, 0, "{said}");
    let (status, out, _) = urdd(&["validate", "made"], folder.path());
    assert!(status == 0 && out.contains("0 findings"), "{out}");
}

#[test]
fn a_usd_of_a_folder_is_read_with_its_layers_and_handed_on() {
    let folder = tempfile::tempdir().expect("a folder");
    // Of the folder, which has the layers of the robot too.
    let (status, _, said) = urdd(&["generate", &example("usd"), "-o", "made"], folder.path());
    assert_eq!(status, 0, "{said}");
    let (status, out, _) = urdd(&["validate", "made"], folder.path());
    assert!(status == 0 && out.contains("0 findings"), "{out}");
    let origin = &json(&folder.path().join("made/scara/urdd.json"))["source"]["x_urdd_imported"];
    assert_eq!(origin["format"], "usd");
    let files: Vec<&str> = origin["files"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|file| file["name"].as_str())
        .collect();
    assert_eq!(files, ["scara.usda", "scara_links.usda", "finger.usda"]);
    let bounds = json(&folder.path().join("made/scara/bounds_module/module.json"));
    let degrees = |one: f64| one.to_radians();
    let expected = [
        [degrees(-130.0), degrees(130.0)],
        [degrees(-145.0), degrees(145.0)],
        [-0.18, 0.0],
        [degrees(-180.0), degrees(180.0)],
        [0.0, 0.03],
    ];
    for (k, range) in expected.iter().enumerate() {
        for (side, bound) in range.iter().enumerate() {
            let found = bounds["bounds"][k][side].as_f64().expect("a number");
            assert!((found - bound).abs() < 1e-7, "{k}: {found} for {bound}");
        }
    }
    let (status, _, said) = urdd(
        &["export", "mjcf", "made/scara", "-o", "scara.xml", "--actuators", "position"],
        folder.path(),
    );
    assert_eq!(status, 0, "{said}");
    let mjcf = fs::read_to_string(folder.path().join("scara.xml")).expect("a file");
    // 12 a degree.
    assert!(mjcf.contains("joint=\"shoulder\"") && mjcf.contains("687.549"), "{mjcf}");
    let (status, _, said) =
        urdd(&["export", "moveit", "made/scara", "-o", "moveit"], folder.path());
    assert_eq!(status, 0, "{said}");
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let secret = folder.path().join("secret.xml");
    fs::write(&secret, "<mujoco><worldbody/></mujoco>").expect("written");
    let inside = folder.path().join("model");
    fs::create_dir(&inside).expect("a folder");
    let cases = [
        ("loop.xml", "<mujoco>\n<include file=\"loop.xml\"/></mujoco>", "loop.xml:2:1: "),
        (
            "out.xml",
            "<mujoco>\n <include file=\"../secret.xml\"/></mujoco>",
            "is outside of the folders of the description; `--allow-folder",
        ),
        (
            "mesh.xml",
            "<mujoco><asset><mesh name=\"m\" file=\"no.stl\"/></asset><worldbody><body>\n\
             <geom type=\"mesh\" mesh=\"m\"/></body></worldbody></mujoco>",
            "no.stl` was not found",
        ),
        (
            "nan.xml",
            "<mujoco><worldbody><body pos=\"0 nan 0\"/></worldbody></mujoco>",
            "nan.xml:1:",
        ),
        ("empty.sdf", "<sdf version=\"1.9\"/>", "empty.sdf:1:1: "),
        ("entity.xml", "<!DOCTYPE m [<!ENTITY e \"x\">]><mujoco model=\"&e;\"/>", "entity.xml:1:"),
    ];
    for (name, text, wanted) in cases {
        fs::write(inside.join(name), text).expect("written");
        let (status, out, said) = urdd(&["import", name, "-o", "out"], &inside);
        assert_eq!((status, out.as_str()), (2, ""), "{name}: {said}");
        assert!(said.contains(wanted), "{name}: {said}");
        assert!(!inside.join("out").exists(), "{name}");
    }
}

#[test]
fn ten_thousand_bodies_are_read_or_refused_and_do_not_hang() {
    let folder = tempfile::tempdir().expect("a folder");
    let bodies: String =
        (0..10_000).map(|at| format!("<body name=\"b{at}\"><geom size=\"1\"/></body>")).collect();
    let text =
        format!("<mujoco><worldbody><body name=\"root\">{bodies}</body></worldbody></mujoco>");
    fs::write(folder.path().join("many.xml"), text).expect("written");
    let (status, out, said) = urdd(&["import", "many.xml", "-o", "many"], folder.path());
    assert_eq!(status, 0, "{said}");
    assert!(out.contains("10001 links, 10000 joints"), "{out}");
}
