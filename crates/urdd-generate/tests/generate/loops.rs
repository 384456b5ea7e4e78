//! `loops_module`, from each of its sources.

use std::fs;
use std::path::Path;

use serde_json::Value;
use urdd_format::loops::{LoopKind, LoopsModule};
use urdd_generate::note::NoteKind;
use urdd_generate::{GenerateError, Generated, Selection, Settings, generate};

/// A parallelogram of hinges. The loop of its coupler and rocker is `closing`.
fn parallelogram(closing: &str) -> String {
    let link = |name: &str| format!("<link name=\"{name}\"/>");
    let joint = |name: &str, parent: &str, child: &str, x: f64, more: &str| {
        format!(
            "<joint name=\"{name}\" type=\"continuous\"{more}><parent link=\"{parent}\"/><child link=\"{child}\"/>
            <origin xyz=\"{x} 0 0\"/><axis xyz=\"0 0 1\"/></joint>"
        )
    };
    format!(
        "<robot name=\"p\">{}{}{}{}{}{}{}{closing}</robot>",
        link("ground"),
        link("crank"),
        link("coupler"),
        link("rocker"),
        joint("a", "ground", "crank", 0.0, " independent=\"true\""),
        joint("b", "crank", "coupler", 0.1, " independent=\"false\""),
        joint("c", "ground", "rocker", 0.3, " independent=\"false\"")
    )
}

const URDF_PLUS: &str = r#"<loop name="pin" type="revolute"><predecessor link="coupler"><origin xyz="0.3 0 0"/></predecessor>
    <successor link="rocker"><origin xyz="0.1 0 0"/></successor><axis xyz="0 0 1"/></loop>"#;

fn settings() -> Settings {
    let selection = Selection::parse(["core"]).unwrap();
    Settings { selection, ..Settings::default() }
}

fn made(folder: &Path, urdf: &str) -> Result<Generated, GenerateError> {
    fs::write(folder.join("p.urdf"), urdf).unwrap();
    generate(&folder.join("p.urdf"), &folder.join("urdd"), &settings(), &())
}

fn module(folder: &Path) -> LoopsModule {
    let text = fs::read(folder.join("urdd/loops_module/module.json")).expect("the module");
    serde_json::from_slice(&text).unwrap()
}

fn metadata(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("urdd/urdd.json")).unwrap()).unwrap()
}

/// A parallelogram's coupler turns back by what its crank turns, and its rocker turns with that.
fn is_parallelogram(q: &[f64]) -> bool {
    let apart = |a: f64, b: f64| (a - b).sin().abs();
    apart(q[1], -q[0]) < 1e-8 && apart(q[2], q[0]) < 1e-8
}

#[test]
fn urdf_plus_makes_a_module_and_states_its_version() {
    let folder = tempfile::tempdir().unwrap();
    let generated = made(folder.path(), &parallelogram(URDF_PLUS)).expect("a URDD");
    assert!(generated.notes.iter().all(|note| !note.kind.changes_robot()), "{:?}", generated.notes);
    let module = module(folder.path());
    assert_eq!((module.loops.len(), module.loops[0].kind), (1, LoopKind::Revolute));
    assert_eq!(module.loops[0].frame_a.position, [0.3, 0.0, 0.0]);
    assert_eq!(module.independent_dof_idxs.len(), 1);
    assert_eq!(module.independent_dof_idxs[0].get(), 0, "the one that the source says");
    // At zero it is folded flat, where two move freely.
    let reference = &module.reference_configuration;
    assert!(reference[0].sin().abs() > 1e-3, "{reference:?}");
    let samples: Vec<&Vec<f64>> =
        module.closed_samples.iter().filter_map(|sample| sample.configuration.as_ref()).collect();
    assert_eq!(samples.len(), module.closed_samples.len(), "every angle of the crank closes");
    assert_eq!(metadata(folder.path())["urdd_version"], "1.1.0");
    // The same again: nothing changes.
    assert!(!made(folder.path(), &parallelogram(URDF_PLUS)).expect("a URDD").changed);
    // Without loops it is a URDD of 1.0.
    made(folder.path(), &parallelogram("")).expect("a URDD");
    assert_eq!(metadata(folder.path())["urdd_version"], "1.0.0");
    assert!(!folder.path().join("urdd/loops_module").exists());
}

#[test]
fn a_toml_beside_a_urdf_says_its_loops_and_couplings() {
    let folder = tempfile::tempdir().unwrap();
    let text = r#"
        independent = ["c"]
        [[loop]]
        name = "pin"
        kind = "Spherical"
        link_a = "coupler"
        frame_a = { xyz = [0.3, 0.0, 0.0] }
        link_b = "rocker"
        frame_b = { xyz = [0.1, 0.0, 0.0], rpy = [0.0, 0.0, 1.0] }
    "#;
    fs::write(folder.path().join("p.loops.toml"), text).unwrap();
    made(folder.path(), &parallelogram("")).expect("a URDD");
    let module = module(folder.path());
    assert_eq!(module.independent_dof_idxs[0].get(), 2);
    let [w, x, y, z] = module.loops[0].frame_b.quaternion_wxyz;
    assert!(
        (w - 0.5_f64.cos()).abs() < 1e-15
            && (z - 0.5_f64.sin()).abs() < 1e-15
            && x == 0.0
            && y == 0.0
    );
    let configurations =
        module.closed_samples.iter().filter_map(|sample| sample.configuration.as_ref());
    let mut parallel =
        configurations.chain([&module.reference_configuration]).filter(|q| is_parallelogram(q));
    assert!(parallel.next().is_some());
}

#[test]
fn couplings_fold_mimics_and_fixed_joints() {
    let folder = tempfile::tempdir().unwrap();
    let joints = r#"<link name="w"/><link name="m"/><link name="f"/>
        <joint name="drive" type="continuous"><parent link="ground"/><child link="w"/><axis xyz="0 0 1"/></joint>
        <joint name="follow" type="continuous"><parent link="ground"/><child link="m"/><axis xyz="0 0 1"/>
        <mimic joint="drive" multiplier="2" offset="0.5"/></joint>
        <joint name="still" type="fixed"><parent link="ground"/><child link="f"/></joint>"#;
    let text = r#"
        [[coupling]]
        name = "gear"
        constant = 0.25
        terms = { a = [1.0], follow = [3.0, 1.0], still = [7.0] }
    "#;
    fs::write(folder.path().join("p.loops.toml"), text).unwrap();
    made(folder.path(), &parallelogram(joints)).expect("a URDD");
    let coupling = &module(folder.path()).couplings[0];
    // 3 (2 q + 0.5) + (2 q + 0.5)^2 = 1.75 + 8 q + 4 q^2
    assert_eq!(coupling.constant, 2.0);
    let terms: Vec<(usize, [f64; 4])> =
        coupling.terms.iter().map(|term| (term.dof_idx.get(), term.coefficients)).collect();
    assert_eq!(terms, [(0, [1.0, 0.0, 0.0, 0.0]), (3, [8.0, 4.0, 0.0, 0.0])]);
}

#[test]
fn extended_urdf_names_joints_and_makes_universal_ones() {
    let folder = tempfile::tempdir().unwrap();
    // The rocker's end is a link of its own, as this format has it.
    let ends = r#"<link name="end_a"/><link name="end_b"/>
        <joint name="fix_a" type="fixed"><parent link="coupler"/><child link="end_a"/><origin xyz="0.3 0 0"/></joint>
        <joint name="fix_b" type="fixed"><parent link="rocker"/><child link="end_b"/><origin xyz="0.1 0 0"/></joint>"#;
    let yaml = "closed_loop: [[end_a, fix_b]]\ntype: ['3d']\nname_mot: [a]\njoint_name: [b, none]\njoint_type: [UJOINT_ZY, SPHERICAL]\n";
    fs::write(folder.path().join("p.yaml"), yaml).unwrap();
    let generated = made(folder.path(), &parallelogram(ends)).expect("a URDD");
    let module = module(folder.path());
    assert_eq!(module.loops[0].kind, LoopKind::Spherical);
    let urdf: Value = serde_json::from_slice(
        &fs::read(folder.path().join("urdd/urdf_module/module.json")).unwrap(),
    )
    .unwrap();
    let names: Vec<&str> =
        urdf["joints"].as_array().unwrap().iter().filter_map(|j| j["name"].as_str()).collect();
    assert!(names.contains(&"b_Z") && names.contains(&"b_Y") && !names.contains(&"b"), "{names:?}");
    assert!(generated.notes.iter().any(|note| note.problem.contains("no joint `none`")));
    // What was found stays beside what is carried.
    assert!(folder.path().join("urdd/p.urdf.as-found").is_file());
    // A YAML about something else is passed over.
    fs::write(folder.path().join("p.yaml"), "robot: p\n").unwrap();
    made(folder.path(), &parallelogram("")).expect("a URDD");
}

#[test]
fn faults_of_loops_have_a_place() {
    let refused = |name: &str, text: &str| {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(name), text).unwrap();
        let error = made(folder.path(), &parallelogram("")).expect_err("refused").to_string();
        error.rsplit_once(name).expect("the file").1.to_owned()
    };
    let toml = |more: &str| format!("[[loop]]\nname = \"l\"\nkind = \"Revolute\"\n{more}");
    for (name, text, said) in [
        ("p.loops.toml", "[[loop]]\nname = 1\n".to_owned(), ":2:8: "),
        (
            "p.loops.toml",
            toml("link_a = \"crank\"\nlink_b = \"rocke\"\n"),
            ":5:10: there is no link `rocke`; did you mean `rocker`?",
        ),
        (
            "p.loops.toml",
            toml("link_a = \"crank\"\nlink_b = \"crank\"\n"),
            ":5:10: the loop `l` connects a link with itself",
        ),
        (
            "p.loops.toml",
            toml("link_a = \"crank\"\nlink_b = \"rocker\"\nframe_a = { xyz = [nan, 0.0, 0.0] }\n"),
            "is not finite",
        ),
        (
            "p.loops.toml",
            toml("link_a = \"crank\"\nlink_b = \"rocker\"\n").repeat(2),
            "another loop or coupling is called `l`",
        ),
        (
            "p.loops.toml",
            "[[coupling]]\nname = \"c\"\nterms = { x = [1.0] }\n".to_owned(),
            ":3:11: there is no DOF `x`",
        ),
        (
            "p.loops.toml",
            "[[coupling]]\nname = \"c\"\nterms = { a = [1.0, 2.0, 3.0, 4.0, 5.0] }\n".to_owned(),
            "one to four",
        ),
        (
            "p.yaml",
            "closed_loop: !!python/object:os.system [[a, b]]\n".to_owned(),
            ":1:14: tags and anchors are not read here",
        ),
        ("p.yaml", "closed_loop: [[a, b]]\ntype: &x ['6d']\n".to_owned(), "tags and anchors"),
        (
            "p.yaml",
            "closed_loop: [[crank, rocker]]\ntype: []\n".to_owned(),
            "`closed_loop` and `type` need as many entries: there are 1 and 0",
        ),
        ("p.yaml", "closed_loop: [[crank, rocker]]\ntype: [5d]\n".to_owned(), "neither 6d nor 3d"),
        ("p.yaml", format!("closed_loop: {}\n", "[".repeat(5000)), "recursion limit exceeded"),
    ] {
        let error = refused(name, &text);
        assert!(error.contains(said), "{error}, not {said}");
    }
}

#[test]
fn a_robot_that_cannot_close_is_that_of_its_tree_and_a_note() {
    let folder = tempfile::tempdir().unwrap();
    // A coupler of 9 m.
    let generated = made(folder.path(), &parallelogram(&URDF_PLUS.replace("0.3 0 0", "9 0 0")))
        .expect("a URDD");
    let note = generated.notes.iter().find(|note| note.problem.contains("`pin`")).expect("a note");
    assert_eq!(note.kind, NoteKind::LeftOut);
    assert!(!folder.path().join("urdd/loops_module").exists());
    // An element of that name that is none.
    let generated = made(folder.path(), &parallelogram("<loop a=\"1\"/>")).expect("a URDD");
    assert!(
        generated.notes.iter().any(|note| note.problem.contains("no loop or coupling of URDF+"))
    );
    for (urdf, said) in [
        (URDF_PLUS.replace("revolute", "helical"), "`helical` is no kind of loop"),
        (URDF_PLUS.replace("0 0 1", "0 0 0"), "this axis has no direction"),
        (URDF_PLUS.replace("0.3 0 0", "0.3 0"), "`xyz` is not three finite numbers"),
    ] {
        let generated = made(folder.path(), &parallelogram(&urdf)).expect("a URDD");
        let notes: Vec<String> = generated.notes.iter().map(ToString::to_string).collect();
        assert!(notes.iter().any(|note| note.contains(said)), "{notes:?}, not {said}");
    }
}

#[test]
fn huge_frames_and_thousands_of_loops_end_soon() {
    let folder = tempfile::tempdir().unwrap();
    let far = URDF_PLUS.replace("0.3 0 0", "1e9 0 0").replace("\"0.1 0 0", "\"1e9 0 0");
    made(folder.path(), &parallelogram(&far)).expect("a URDD");
    // The same pin two thousand times: redundant, and no fault.
    let many: String =
        (0..2000).map(|k| URDF_PLUS.replace("name=\"pin\"", &format!("name=\"pin{k}\""))).collect();
    made(folder.path(), &parallelogram(&many)).expect("a URDD");
    assert_eq!(module(folder.path()).loops.len(), 2000);
    assert_eq!(module(folder.path()).independent_dof_idxs.len(), 1);
}

#[cfg(unix)]
#[test]
fn a_file_beside_that_leads_out_of_the_folder_is_not_opened() {
    let (folder, elsewhere) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    for name in ["p.loops.toml", "p.yaml"] {
        let secret = elsewhere.path().join("secret");
        fs::write(&secret, "closed_loop: [[secret, words]]\n").unwrap();
        std::os::unix::fs::symlink(&secret, folder.path().join(name)).unwrap();
        let error = made(folder.path(), &parallelogram("")).expect_err("refused").to_string();
        assert!(error.contains("outside of the robot's folders"), "{error}");
        assert!(!error.contains("words"), "{error}");
        // Whoever names it may read it.
        let mut named = settings();
        named.source.loops = Some(secret);
        let error = generate(&folder.path().join("p.urdf"), &folder.path().join("u"), &named, &());
        assert!(error.expect_err("no TOML").to_string().contains("secret"));
        fs::remove_file(folder.path().join(name)).unwrap();
    }
}

#[test]
fn a_loop_without_an_axis_has_that_of_a_joint() {
    let folder = tempfile::tempdir().unwrap();
    let about_x = URDF_PLUS.replace("<axis xyz=\"0 0 1\"/>", "").replace("revolute", "spherical");
    made(folder.path(), &parallelogram(&about_x)).expect("a URDD");
    let [w, x, y, z] = module(folder.path()).loops[0].frame_a.quaternion_wxyz;
    // z to x: a quarter turn about y.
    let half = 0.5_f64.sqrt();
    assert!((w - half).abs() < 1e-15 && (y - half).abs() < 1e-15 && x.abs() + z.abs() < 1e-15);
}

#[test]
fn many_loops_on_a_long_chain_are_refused_and_not_stored() {
    let folder = tempfile::tempdir().unwrap();
    let mut urdf = "<robot name=\"p\"><link name=\"l0\"/>".to_owned();
    for k in 1..1900 {
        urdf += &format!(
            "<link name=\"l{k}\"/><joint name=\"j{k}\" type=\"continuous\"><parent link=\"l{}\"/><child link=\"l{k}\"/></joint>",
            k - 1
        );
    }
    for k in 0..11_000 {
        urdf += &format!(
            "<loop name=\"o{k}\" type=\"spherical\"><predecessor link=\"l0\"/><successor link=\"l1899\"/></loop>"
        );
    }
    let error = made(folder.path(), &(urdf + "</robot>")).expect_err("refused").to_string();
    assert!(error.contains("too many joints are in all loops"), "{error}");
}
