//! Spheres of links, from outside: made, checked, told, exported, and a person's list in their place.

use std::fs;
use std::path::Path;

use serde_json::Value;
use testkit::robots::BARS;

use crate::program::urdd;

fn run(folder: &Path, arguments: &[&str]) -> String {
    let (status, out, said) = urdd(arguments, folder);
    assert_eq!(status, 0, "{arguments:?}: {out}{said}");
    out + &said
}

#[test]
fn spheres_go_from_a_urdf_to_a_planner_and_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::write(folder.join("bars.urdf"), BARS).expect("written");
    let generate = ["generate", "bars.urdf", "-o", "bars", "--modules", "all,spheres"];
    run(folder, &generate);
    run(folder, &["validate", "bars", "--fail-on", "info"]);
    let info = run(folder, &["info", "bars"]);
    assert!(info.contains("levels of 3, 12, 48 that cover the links"), "{info}");
    assert!(info.contains(" fitted; missed collisions "), "{info}");
    for (format, file) in [("curobo", "s.yml"), ("foam", "s.json"), ("spherized", "s.urdf")] {
        run(folder, &["export", format, "bars", "-o", file, "--samples", "100"]);
        let before = fs::read_to_string(folder.join("bars/urdd.json")).expect("metadata");
        let told = run(folder, &["spheres", "import", file, "bars"]);
        assert!(told.contains("spheres imported") && told.contains("missed collisions"), "{told}");
        run(folder, &["validate", "bars", "--fail-on", "info"]);
        let info: Value = serde_json::from_str(&run(folder, &["info", "bars", "--format", "json"]))
            .expect("JSON");
        let last = &info[0]["spheres"][3];
        assert_eq!((&last["origin"], &last["covers"]), (&"Given".into(), &false.into()));
        let after = fs::read_to_string(folder.join("bars/urdd.json")).expect("metadata");
        // The same spheres in another form are the same module.
        assert_eq!(before == after, format != "curobo");
    }
    let (status, _, said) = urdd(&["generate", "bars.urdf", "-o", "bars"], folder);
    assert_eq!(status, 1);
    assert!(said.contains("given spheres") && said.contains("--drop-edits"), "{said}");
    run(folder, &generate);
    let info = run(folder, &["info", "bars"]);
    assert!(info.contains(" given; missed collisions "), "{info}");
    // A list that is of no use says why.
    let large = "collision_spheres: {a: [{center: [0, 0, 0], radius: 1}], c: [{center: [0, 0, 0], radius: 1}]}";
    fs::write(folder.join("large.yml"), large).expect("written");
    let told = run(folder, &["spheres", "import", "large.yml", "bars", "--alone"]);
    assert!(told.contains("these links touch") && told.contains(": `a` with `c`\n"), "{told}");
    // A list of one link empties no other: a check by spheres would call free what touches them.
    run(folder, &["spheres", "import", "s.yml", "bars"]);
    const MODULE: &str = "link_shapes_modules/link_shapes_spheres_module/module.json";
    let count = |link: usize| {
        let text = fs::read_to_string(folder.join("bars").join(MODULE));
        let module: Value = serde_json::from_str(&text.expect("read")).expect("JSON");
        module["levels"][3]["spheres"][link].as_array().expect("a list").len()
    };
    let before = [count(1), count(2)];
    assert!(before.iter().all(|count| *count > 1), "{before:?}");
    let one = "collision_spheres: {a: [{center: [0, 0, 0], radius: 0.05}]}";
    fs::write(folder.join("one.yml"), one).expect("written");
    let told = run(folder, &["spheres", "import", "one.yml", "bars"]);
    assert!(told.contains("keep their spheres (--alone removes them): `b`, `c`\n"), "{told}");
    assert_eq!(([count(1), count(2)], count(0)), (before, 1));
    let told = run(folder, &["spheres", "import", "one.yml", "bars", "--alone"]);
    assert!(told.contains("touches them free: `b`, `c`\n"), "{told}");
    assert_eq!([count(0), count(1), count(2)], [1, 0, 0]);
    run(folder, &["spheres", "import", "large.yml", "bars", "--alone"]);
    // What rests on skips follows them when the URDD is made again.
    let srdf =
        "<robot name=\"bars\"><disable_collisions link1=\"a\" link2=\"c\" reason=\"x\"/></robot>";
    fs::write(folder.join("bars.srdf"), srdf).expect("written");
    let told = run(folder, &["skips", "import", "bars.srdf", "bars"]);
    assert!(told.contains("`--modules all,spheres` counts again"), "{told}");
    let (status, out, said) = urdd(&["validate", "bars"], folder);
    assert!(status == 1 && out.contains("SPH012"), "{out}{said}");
    run(folder, &generate);
    run(folder, &["validate", "bars", "--fail-on", "info"]);
    for (text, words) in [
        ("collision_spheres: {z: [{center: [0, 0, 0], radius: 1}]}", "there is no link `z`"),
        (
            "{\"a\": {\"spheres\": [{\"origin\": [0, 0, 0], \"radius\": 0}]}}",
            "sphere 0 of link `a`: the radius 0",
        ),
        ("a: b", "it has no spheres"),
    ] {
        fs::write(folder.join("bad.yml"), text).expect("written");
        let (status, out, said) = urdd(&["spheres", "import", "bad.yml", "bars"], folder);
        assert_eq!((status, out.as_str()), (2, ""));
        assert!(said.contains("bad.yml") && said.contains(words), "{said}");
    }
}

/// The third bar stands on the first, 2 mm away: near enough that spheres touch unless the fit looks there.
#[test]
fn fitted_spheres_are_free_in_the_reference_configuration() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::write(folder.join("bars.urdf"), BARS).expect("written");
    let generate = ["generate", "bars.urdf", "-o", "bars", "--modules", "all,spheres"];
    run(folder, &generate);
    // The tip of the third bar is at 0.427 m - 0.4 m above the middle of the first, whose half height is 0.025 m.
    let shoulder = std::f64::consts::PI - (0.427f64 / 0.5).asin();
    let elbow = 1.5 * std::f64::consts::PI - shoulder;
    let bent = [shoulder, elbow];
    let touches = || {
        let robot = urdd_robot::Robot::open(folder.join("bars")).expect("a URDD");
        let pieces = robot.proximity(urdd_robot::ShapeKind::Pieces).expect("pieces");
        let apart = urdd_robot::Queries::min_distance(&pieces, &bent).expect("a distance");
        assert!(apart.is_some_and(|apart| (apart - 0.002).abs() < 1e-6), "{apart:?}");
        robot.approximating_checker().expect("spheres").in_collision(&bent).expect("an answer")
    };
    let positions = [format!("ab={shoulder}"), format!("bc={elbow}")];
    run(folder, &["configurations", "set", "bars", "bent", &positions[0], &positions[1]]);
    assert_eq!(touches(), urdd_robot::spheres::ApproximateAnswer::Contact);
    run(folder, &[&generate[..], &["--reference", "bent"]].concat());
    assert_eq!(touches(), urdd_robot::spheres::ApproximateAnswer::Free);
    run(folder, &["validate", "bars", "--fail-on", "info"]);
}
