//! Robots with loops, from outside: from each source to a URDD that passes, and on to MuJoCo.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::urdd;

/// A slider-crank: a crank of 0.1 m, a rod of 0.3 m, and a slide along x that the rod's end is a ball on. The base stands.
const SLIDER_CRANK: &str = r#"<mujoco model="slider"><compiler angle="radian"/><worldbody><body name="base"><geom size="0.02" mass="1"/>
<body name="crank"><joint name="turn" axis="0 0 1"/><geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.01" mass="1"/>
<body name="rod" pos="0.1 0 0"><joint name="swing" axis="0 0 1"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.01" mass="1"/></body></body>
<body name="block" pos="0.4 0 0"><joint name="slide" type="slide" axis="1 0 0" range="-0.3 0.1"/><geom type="box" size="0.02 0.02 0.02" mass="1"/></body>
</body></worldbody><equality><connect name="pin" body1="rod" body2="block" anchor="0.3 0 0"/>
<joint name="cam" joint1="slide" joint2="turn" polycoef="0 0 -0.06666666666666667 0 0" active="false"/></equality></mujoco>"#;

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("a file")).expect("JSON")
}

fn run(folder: &Path, arguments: &[&str]) -> String {
    let (status, out, said) = urdd(arguments, folder);
    assert_eq!(status, 0, "{arguments:?}: {out}{said}");
    out + &said
}

/// Where the slide is, from its start at 0.4 m: the triangle of crank and rod.
fn slide_at(turn: f64) -> f64 {
    0.1 * turn.cos() + (0.09 - 0.01 * turn.sin().powi(2)).sqrt() - 0.4
}

#[test]
fn an_mjcf_with_a_pin_is_a_urdd_that_closes_and_an_mjcf_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    fs::write(at("slider.xml"), SLIDER_CRANK).expect("written");
    run(folder.path(), &["import", "slider.xml", "-o", "imported"]);
    let toml = fs::read_to_string(at("imported/slider.loops.toml")).expect("what closes it");
    assert!(toml.contains("name = \"pin\"") && toml.contains("kind = \"Spherical\""), "{toml}");
    // At once, and by way of the imported files.
    run(folder.path(), &["generate", "slider.xml", "-o", "one", "--samples", "5"]);
    run(folder.path(), &["generate", "imported/slider.urdf", "-o", "two", "--samples", "5"]);
    let loops = json(&at("one/loops_module/module.json"));
    assert_eq!(loops, json(&at("two/loops_module/module.json")));
    let dofs = json(&at("one/dof_module/module.json"));
    let index = |name: &str| {
        let mut dofs = dofs["dofs"].as_array().expect("DOFs").iter();
        dofs.position(|dof| dof["name"] == name).expect("a DOF")
    };
    let (turn, slide) = (index("turn"), index("slide"));
    let samples = loops["closed_samples"].as_array().expect("samples");
    let closed = samples.iter().filter(|sample| sample["configuration"].is_array());
    assert!(closed.clone().count() > 10, "{samples:?}");
    for sample in closed {
        let q = |dof: usize| sample["configuration"][dof].as_f64().expect("a number");
        let apart = q(slide) - slide_at(q(turn));
        assert!(apart.abs() < 1e-9, "{apart} at {}", q(turn));
    }
    let out = run(folder.path(), &["validate", "one"]);
    assert!(out.contains("0 errors"), "{out}");
    run(folder.path(), &["export", "mjcf", "one", "-o", "again.xml"]);
    let text = fs::read_to_string(at("again.xml")).expect("the export");
    for words in
        ["<connect name=\"pin\" site1=\"loop/0/a0\" site2=\"loop/0/b0\"", "<key name=\"closed\""]
    {
        assert!(text.contains(words), "{words}: {text}");
    }
    // Read back, the pin is between the same points.
    run(folder.path(), &["generate", "again.xml", "-o", "three", "--samples", "5"]);
    let again = json(&at("three/loops_module/module.json"));
    assert_eq!(again["loops"][0]["kind"], "Spherical");
    assert_eq!(again["loops"][0]["name"], "pin");
    assert_eq!(again["independent_dof_idxs"], loops["independent_dof_idxs"]);
}

/// A robot of URDF+ as a part twice: each has its own loop.
#[test]
fn loops_of_a_urdf_are_those_of_its_parts() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let joint = |name: &str, parent: &str, child: &str, x: f64| {
        format!(
            r#"<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{child}"/><origin xyz="{x} 0 0"/><axis xyz="0 0 1"/></joint>"#
        )
    };
    let urdf = format!(
        r#"<robot name="p"><link name="ground"/><link name="crank"/><link name="coupler"/><link name="rocker"/>{}{}{}
        <loop name="pin" type="revolute"><predecessor link="coupler"><origin xyz="0.3 0 0"/></predecessor>
        <successor link="rocker"><origin xyz="0.1 0 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#,
        joint("a", "ground", "crank", 0.0),
        joint("b", "crank", "coupler", 0.1),
        joint("c", "ground", "rocker", 0.3)
    );
    fs::write(at("p.urdf"), urdf).expect("written");
    run(folder.path(), &["generate", "p.urdf", "-o", "p", "--modules", "core"]);
    run(
        folder.path(),
        &["combine", "p", "p", "--at", "coupler", "-o", "both", "--modules", "core"],
    );
    let loops = json(&at("both/loops_module/module.json"));
    let names: Vec<&str> = loops["loops"]
        .as_array()
        .expect("loops")
        .iter()
        .filter_map(|of| of["name"].as_str())
        .collect();
    assert_eq!(names, ["pin", "p_2_pin"]);
    assert_eq!(loops["independent_dof_idxs"].as_array().expect("DOFs").len(), 2);
    run(folder.path(), &["validate", "both"]);
    let said = run(folder.path(), &["info", "both"]);
    assert!(said.contains("  loops     2 Revolute; 2 DOFs move freely: a, p_2_"), "{said}");
    // What stands beside the URDF alone is not in the combined one, and a note says so.
    fs::write(at("p.loops.toml"), "[[loop]]\nname = \"pin\"\nkind = \"Spherical\"\nlink_a = \"coupler\"\nframe_a = { xyz = [0.3, 0.0, 0.0] }\nlink_b = \"rocker\"\nframe_b = { xyz = [0.1, 0.0, 0.0] }\n").expect("written");
    let text = fs::read_to_string(at("p.urdf")).expect("the URDF");
    let (head, tail) = text.split_once("<loop").expect("a loop");
    let (_, tail) = tail.split_once("</loop>").expect("its end");
    fs::write(at("p.urdf"), format!("{head}{tail}")).expect("written");
    run(folder.path(), &["generate", "p.urdf", "-o", "p", "--modules", "core"]);
    let said = run(
        folder.path(),
        &["combine", "p", "p", "--at", "coupler", "-o", "bare", "--modules", "core"],
    );
    assert!(said.contains("its loops are not in its URDF"), "{said}");
    assert!(!at("bare/loops_module").exists());
    // Another file by its name.
    fs::rename(at("p.loops.toml"), at("mine.toml")).expect("renamed");
    run(
        folder.path(),
        &["generate", "p.urdf", "-o", "named", "--modules", "core", "--loops", "mine.toml"],
    );
    assert!(at("named/loops_module").is_dir());
    let (status, _, said) =
        urdd(&["generate", "p.urdf", "-o", "none", "--loops", "nowhere.toml"], folder.path());
    assert!(status == 1 && said.contains("nowhere.toml"), "{status}: {said}");
}

/// What an export writes is what `urdd generate` reads: one file for URDF+, and a YAML beside the URDF for Extended URDF.
#[test]
fn exports_of_loops_are_sources_of_loops() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    fs::write(at("slider.xml"), SLIDER_CRANK).expect("written");
    run(folder.path(), &["generate", "slider.xml", "-o", "one", "--samples", "5"]);
    let loops = json(&at("one/loops_module/module.json"));
    for format in ["urdf-plus", "extended-urdf"] {
        let file = format!("{format}.urdf");
        run(folder.path(), &["export", format, "one", "-o", &file]);
        assert_eq!(at("extended-urdf.yaml").exists(), format == "extended-urdf");
        run(folder.path(), &["generate", &file, "-o", format, "--modules", "core"]);
        let again = json(&at(format).join("loops_module/module.json"));
        assert_eq!(again["loops"][0]["kind"], "Spherical");
        assert_eq!(again["independent_dof_idxs"], loops["independent_dof_idxs"], "{format}");
        let out = run(folder.path(), &["validate", format]);
        assert!(out.contains("0 errors"), "{out}");
    }
}
