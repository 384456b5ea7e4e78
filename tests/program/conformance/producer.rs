//! `urdd conformance producer`, with the reference generator as the producer under test.

use std::collections::BTreeSet;
use std::fs;

use urdd_conformance::refused;

use crate::conformance::{conformance, result, stderr};

const URDD: &str = env!("CARGO_BIN_EXE_urdd");

#[test]
fn the_reference_generator_passes() {
    let command = ["--", URDD, "generate", "--samples", "20", "{urdf}", "-o", "{out}"];
    let arguments = [
        &["producer", "--class", "shapes", "--format", "json"][..],
        &["--robot", "gripper", "--robot", "welding_arm"],
        &command,
    ];
    let (status, result) = result(&arguments.concat());
    assert_eq!((status, &result["passed"]), (0, &true.into()), "{result:#}");
    let robots = result["robots"].as_array().expect("a list");
    assert_eq!(robots.len(), 2);
    for class in result["classes"].as_array().expect("a list") {
        assert_eq!((&class["passed"], &class["of"]), (&2.into(), &2.into()));
    }
    assert_eq!(result["classes"].as_array().map(Vec::len), Some(3));
}

/// Core modules only, although more are requested.
#[test]
fn what_is_missing_is_told_by_class_and_module() {
    let folder = testkit::temporary::folder();
    let skips = folder.path().join("skips");
    let command = ["--", URDD, "generate", "--modules", "core", "{urdf}", "-o", "{out}"];
    let arguments = [
        &["producer", "--class", "geometry", "--format", "json", "--robot", "gripper"][..],
        &["--skip", skips.to_str().expect("UTF-8")],
        &command,
    ]
    .concat();
    fs::write(&skips, "# nothing\n").expect("written");
    let (status, found) = result(&arguments);
    assert_eq!((status, &found["passed"]), (1, &false.into()));
    assert_eq!(found["classes"][0]["passed"], 1, "{found:#}");
    assert_eq!(found["classes"][1]["passed"], 0);
    let modules = found["modules"].as_array().expect("a list");
    let module = |name: &str| modules.iter().find(|module| module["name"] == name);
    assert_eq!(module("dof_module").expect("there")["passed"], 1);
    assert_eq!(module("plain_meshes_module").expect("asked")["present"], 0);

    // With all four skipped nothing is left; a fifth, which passes, is stale.
    let missing = ["original", "plain", "convex_hull", "convex_decomposition"];
    let lines = missing.map(|name| format!("gripper {name}_meshes_module # no meshes yet\n"));
    fs::write(&skips, lines.concat()).expect("written");
    let (status, found) = result(&arguments);
    assert_eq!((status, &found["robots"][0]["status"]), (0, &"skipped".into()));
    fs::write(&skips, lines.concat() + "gripper dof_module # old\n").expect("written");
    let (status, found) = result(&arguments);
    assert_eq!(status, 1);
    assert_eq!(found["stale_skips"], serde_json::json!(["gripper dof_module"]));
    // A robot that was not run is neither passed nor failed.
    fs::write(&skips, lines.concat() + "hand # slow\n").expect("written");
    assert_eq!(result(&arguments).0, 0);

    fs::write(&skips, "gripper\n").expect("written");
    let output = conformance(&arguments);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("line 1: say why"), "{}", stderr(&output));
    fs::write(&skips, "griper # why\n").expect("written");
    let output = conformance(&arguments);
    assert!(stderr(&output).contains("there is no `griper`"), "{}", stderr(&output));
}

#[cfg(unix)]
#[test]
fn what_a_producer_does_wrong_is_told() {
    let run_for = |seconds: &str, script: &str| {
        let arguments = [
            &["producer", "--format", "json", "--robot", "gripper", "--timeout", seconds][..],
            &["--", "sh", "-c", script, "sh", "{urdf}", "{out}"],
        ];
        let (status, result) = result(&arguments.concat());
        assert_eq!(status, 1, "{script}");
        result["robots"][0].clone()
    };
    let run = |script: &str| run_for("60", script);
    let robot = run("echo no idea >&2; exit 7");
    assert_eq!(robot["end"], "exit status 7");
    assert_eq!(robot["stderr"], "no idea\n");
    assert!(robot["unreadable"].is_null());
    let text = |robot: &serde_json::Value| robot["unreadable"].as_str().unwrap_or("").to_owned();
    assert!(text(&run("true")).contains("created no folder"));
    assert!(text(&run("mkdir \"$2\"")).contains("no URDD here"));
    let nested = format!("'{URDD}' generate --modules core \"$1\" -o \"$2/inside\"");
    assert!(text(&run(&nested)).contains("itself must be the URDD"));
    assert_eq!(run_for("1", "sleep 60")["end"], "stopped at the time limit");
}

#[test]
fn usage() {
    for (arguments, message) in [
        (&["producer", "--", "make", "{urdf}"][..], "{out}"),
        (&["producer", "--class", "best", "--", "a", "{urdf}", "{out}"], "best"),
        (&["producer", "--robot", "r2", "--", "a", "{urdf}", "{out}"], "gripper"),
        (&["producer"], "COMMAND"),
    ] {
        let output = conformance(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains(message), "{}", stderr(&output));
    }
}

/// The worked example of the README: a producer in Python, scored.
#[test]
#[ignore = "needs python3; .ci/run runs it"]
fn the_python_example_passes() {
    let command = ["python3", "examples/minimal_producer.py", "{urdf}", "{out}"];
    let (status, result) =
        result(&[&["producer", "--format", "json", "--"][..], &command].concat());
    assert_eq!(status, 0, "{result:#}");
    assert_eq!(result["robots"].as_array().map(Vec::len), Some(9));
    assert_eq!(result["classes"][0]["passed"], 9);
    let refused = result["refused"].as_array().expect("a list");
    assert_eq!(refused.len(), to_refuse().len());
    for urdf in refused {
        // It repairs nothing.
        assert_eq!(urdf["outcome"], "refused", "{urdf:#}");
    }
}

fn to_refuse() -> Vec<String> {
    let suite = urdd::suite::carried().expect("the suite reads");
    let all = refused::all(&suite).expect("no damaged case");
    all.into_iter().map(|urdf| urdf.id).collect()
}

/// Also that the reference generator refuses or repairs each, and that there is one for each clause.
#[test]
fn what_has_no_urdd_is_refused_or_repaired() {
    let names = to_refuse();
    assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len());
    let codes: BTreeSet<&str> = names.iter().map(|name| &name[..6]).collect();
    let rules = (2..=12).map(|rule| format!("URD{rule:03}"));
    let expected: BTreeSet<String> = rules.chain(["DOF007".into(), "KIN001".into()]).collect();
    assert_eq!(codes, expected.iter().map(String::as_str).collect());

    let line = format!("URDFs to refuse: {0} of {0}", names.len());
    let page = include_str!("../../../conformance/README.md");
    assert!(page.contains(&line), "conformance/README.md does not say `{line}`: write it");

    let asked: Vec<&str> = names.iter().flat_map(|name| ["--robot", name]).collect();
    let start = ["producer", "--format", "json", "--jobs", "2"];
    let command = ["--", URDD, "generate", "--modules", "core", "{urdf}", "-o", "{out}"];
    let (status, result) = result(&[&start[..], &asked, &command].concat());
    assert_eq!(status, 0, "{result:#}");
    let refused = result["refused"].as_array().expect("a list");
    assert_eq!(refused.len(), names.len());
    let count = |outcome: &str| {
        let found = refused.iter().filter(|urdf| urdf["outcome"] == outcome);
        found.count()
    };
    assert!(count("refused") > 20 && count("repaired") > 3);
}

#[cfg(unix)]
#[test]
fn a_disorderly_refusal_fails() {
    let run = |script: &str, more: &[&str]| {
        let robot = "URD005/link-held-by-two-joints";
        let timeout = if script.starts_with("sleep") { "1" } else { "20" };
        let start = ["producer", "--format", "json", "--robot", robot, "--timeout", timeout];
        let command = ["--", "sh", "-c", script, "sh", "{urdf}", "{out}", URDD];
        let (status, result) = result(&[&start[..], more, &command].concat());
        assert_eq!(result["robots"], serde_json::json!([]));
        assert_eq!(result["passed"], status == 0);
        (status, result["refused"][0].clone())
    };
    // `sound` is a URDF that has a URDD: in place of the other it stands for a repaired one.
    let sound = "conformance/robots/single_link.urdf";
    let folder = testkit::temporary::folder();
    let made = folder.path().join("made");
    let shown = made.to_str().expect("UTF-8");
    let arguments = ["generate", "--modules", "core", sound, "-o", shown];
    let output = crate::program::output(&arguments, testkit::repository());
    assert!(output.status.success(), "{}", stderr(&output));
    let metadata = fs::read(made.join("urdd.json")).expect("urdd.json");
    let mut metadata: serde_json::Value = serde_json::from_slice(&metadata).expect("JSON");
    metadata["source"] = serde_json::Value::Null;
    fs::write(made.join("urdd.json"), metadata.to_string()).expect("written");
    fs::remove_file(made.join("single_link.urdf")).expect("the source");
    let without_source = format!("cp -r {shown} $2");
    for (script, status, outcome) in [
        ("echo two parents >&2; exit 3", 0, "refused"),
        ("echo two parents; exit 1", 0, "refused"),
        (&format!("$3 generate --modules core {sound} -o $2"), 0, "repaired"),
        (&without_source, 1, "written"),
        ("mkdir $2", 1, "written"),
        ("true", 1, "written"),
        ("echo two parents >&2; mkdir $2; exit 3", 1, "left_over"),
        ("echo two parents >&2; ln -s nowhere $2; exit 3", 1, "left_over"),
        ("exit 3", 1, "silent"),
        ("echo 'Traceback (most recent call last):' >&2; exit 1", 1, "crashed"),
        ("kill -9 $$", 1, "crashed"),
        ("sleep 60", 1, "crashed"),
    ] {
        let found = run(script, &[]);
        assert_eq!(
            (found.0, &found.1["outcome"]),
            (status, &outcome.into()),
            "{script}: {found:#?}"
        );
    }
    let (_, urdf) = run(&without_source, &[]);
    let why = urdf["unreadable"].as_str().unwrap_or_default();
    assert!(why.contains("carries no source"), "{urdf:#}");
    // A URDD of another robot's URDF, which has faults.
    let stale = "cp -r conformance/valid/single_link $2";
    let (_, urdf) = run(stale, &[]);
    assert_eq!(urdf["outcome"], "written");
    assert!(urdf["codes"].as_array().is_some_and(|codes| !codes.is_empty()), "{urdf:#}");

    let file = folder.path().join("skips");
    fs::write(&file, "URD005/link-held-by-two-joints # soon\n").expect("written");
    let skip = ["--skip", file.to_str().expect("UTF-8")];
    let (status, urdf) = run("exit 3", &skip);
    assert_eq!((status, &urdf["skipped_since"]), (0, &"soon".into()));
    assert_eq!(run("echo two parents; exit 3", &skip).0, 1, "a stale skip");
}

#[test]
fn robots_are_run_at_a_time_and_can_be_kept() {
    let folder = testkit::temporary::folder();
    let (log, kept) = (folder.path().join("log"), folder.path().join("kept"));
    let more = [
        "--jobs",
        "2",
        "--log",
        log.to_str().expect("UTF-8"),
        "--keep",
        kept.to_str().expect("UTF-8"),
    ];
    let start = ["producer", "--format", "json", "--robot", "gripper", "--robot", "single_link"];
    let command = ["--", URDD, "generate", "--modules", "core", "{urdf}", "-o", "{out}"];
    let (status, result) = result(&[&start[..], &more, &command].concat());
    assert_eq!(status, 0, "{result:#}");
    // In the order of the robots, regardless of when they finished.
    let names: Vec<&serde_json::Value> =
        result["robots"].as_array().expect("a list").iter().map(|robot| &robot["robot"]).collect();
    assert_eq!(names, ["gripper", "single_link"]);
    assert_eq!(fs::read_to_string(&log).expect("a log").lines().count(), 2);
    assert!(kept.join("gripper/gripper/urdd.json").is_file());
    assert!(kept.join("single_link/robots/single_link.urdf").is_file());
}

/// What is taken out of a robot's URDF+, or changed in it, before the reference generator sees it, is a fault of the URDD.
#[cfg(unix)]
#[test]
fn loops_are_those_that_the_urdf_says() {
    let run = |robot: &str, change: &str| {
        let script = format!(
            "sed '{change}' \"$1\" > \"$1.urdf\" && '{URDD}' generate --modules core \"$1.urdf\" -o \"$2\""
        );
        let start = ["producer", "--format", "json", "--module", "loops_module", "--robot", robot];
        let (status, result) =
            result(&[&start[..], &["--", "sh", "-c", &script, "sh", "{urdf}", "{out}"]].concat());
        assert_eq!(result["passed"], status == 0, "{result:#}");
        assert_eq!(result["robots"].as_array().map(Vec::len), Some(1));
        let mut modules = result["robots"][0]["modules"].as_array().expect("a list").iter();
        let module = modules.find(|module| module["name"] == "loops_module").expect("asked for");
        (status, module["status"].as_str().map(str::to_owned), module["first"].clone())
    };
    let without = |element: &str| format!("/<{element} /,/<\\/{element}>/d");
    let failed = |message: &str| (1, Some("failed".to_owned()), message.into());
    for robot in ["ball_slide", "four_bar"] {
        assert_eq!(run(robot, "").0, 0, "{robot}");
    }
    assert_eq!(
        run("four_bar", &without("loop")),
        failed("no loop between `coupler` and `rocker`, as the URDF says")
    );
    assert_eq!(
        run("four_bar", &without("coupling")),
        failed("no coupling of `crank_joint` and `wheel_joint`, as the URDF says")
    );
    // A plane and its normal hold less than a hinge.
    assert_eq!(
        run("four_bar", "s/\"pin\" type=\"revolute\"/\"pin\" type=\"planar\"/"),
        failed("3 independent DOFs, where the robot has 1")
    );
    assert_eq!(run("ball_slide", &without("loop")).1.as_deref(), Some("missing"));
}

#[test]
fn spheres_are_asked_for() {
    let run = |modules: &str, class: &str| {
        let start = ["producer", "--format", "json", "--class", class, "--robot", "single_link"];
        let asked = ["--module", "link_shapes_spheres_module"];
        let command = ["--", URDD, "generate", "--samples", "20", "--modules", modules];
        conformance(&[&start[..], &asked, &command, &["{urdf}", "-o", "{out}"]].concat())
    };
    let result = |modules: &str| -> serde_json::Value {
        serde_json::from_slice(&run(modules, "shapes").stdout).expect("JSON")
    };
    assert_eq!(result("all,link_shapes_spheres")["passed"], true);
    let missing = result("all");
    let modules = missing["modules"].as_array().expect("a list");
    let spheres = modules.iter().find(|module| module["name"] == "link_shapes_spheres_module");
    let spheres = spheres.expect("asked for");
    assert_eq!(
        (&missing["passed"], &spheres["present"], &spheres["of"]),
        (&false.into(), &0.into(), &1.into())
    );
    assert!(stderr(&run("all", "core")).contains("needs --class shapes"));
}
