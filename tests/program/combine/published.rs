//! Published composed URDDs, read into recipes. They are not in this repository: `URDD_CORPUS` names their folder.

use std::collections::BTreeSet;
use std::path::PathBuf;

use urdd_generate::Settings;
use urdd_generate::combine::{Recipe, combine};
use urdd_robot::Robot;

use crate::combine::support::findings;

#[test]
#[ignore = "needs ../shared/corpus, or what URDD_CORPUS names"]
fn a_published_composition_becomes_a_urdd_that_passes() {
    let corpus = std::env::var_os("URDD_CORPUS").map(PathBuf::from);
    let corpus = corpus.unwrap_or_else(|| PathBuf::from("../shared/corpus"));
    let folder = testkit::temporary::folder();
    let target = folder.path().join("robot");
    let legacy = corpus.join("z1_robotiq_140");
    let (recipe, notes) = Recipe::of_legacy(&legacy).expect("a recipe");
    assert_eq!(notes, []);
    let legacy_part = corpus.join("z1");
    let settings = Settings { num_samples: 50, ..Settings::default() };
    let made = combine(&recipe, &target, &settings, &BTreeSet::new(), &()).expect("a URDD");
    assert_eq!(findings(&target), [] as [String; 0]);
    // The file of one mesh is missing from our copy: the plain mesh replaces it.
    let plain = (made.notes.iter()).filter(|note| note.kind == "plain-mesh");
    let plain: Vec<String> = plain.map(ToString::to_string).collect();
    let expected = "part `z1`: its URDD lacks the original mesh of link `link01`; the plain mesh is used, without colours";
    assert_eq!(plain, [expected]);
    // All plain meshes are those that the authors published, each in its link's frame.
    let robot = Robot::open(&target).expect("a robot");
    let published = Robot::open(&legacy_part).expect("a robot");
    for name in ["link00", "link01", "link02", "link03", "link04", "link05", "link06"] {
        let extent = |robot: &Robot, name: &str| {
            let link = robot.link(name).expect("a link");
            let visuals = robot.visuals().expect("plain meshes");
            let visual = visuals.into_iter().find(|visual| visual.link == link);
            let parts = visual.expect("a mesh").parts.into_iter();
            let points: Vec<[f64; 3]> = parts.flat_map(|part| part.mesh.vertices).collect();
            let end = |axis: usize, pick: fn(f64, f64) -> f64, from: f64| {
                points.iter().map(|point| point[axis]).fold(from, pick)
            };
            let low = [0, 1, 2].map(|axis| end(axis, f64::min, f64::INFINITY));
            let high = [0, 1, 2].map(|axis| end(axis, f64::max, f64::NEG_INFINITY));
            [low, high]
        };
        let own = extent(&robot, &format!("robot_0_{name}"));
        let theirs = extent(&published, name);
        for (own, theirs) in own.iter().flatten().zip(theirs.iter().flatten()) {
            assert!((own - theirs).abs() < 1e-5, "{name}: {own} {theirs}");
        }
    }
    // The names are those of the published robot.
    let names = |file: PathBuf, key: &str| {
        let text = std::fs::read_to_string(file).expect("a module");
        let module: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let list = module[key].as_array().expect("a list").clone();
        let names = list.into_iter().map(|of| of["name"].to_string());
        names.collect::<BTreeSet<String>>()
    };
    for key in ["links", "joints"] {
        let module = "urdf_module/module.json";
        assert_eq!(names(target.join(module), key), names(legacy.join(module), key));
    }
    // A robot that was not composed is not a composition.
    let error = Recipe::of_legacy(&corpus.join("ur5")).expect_err("no recipe");
    assert!(error.to_string().contains("this URDD has no combined_robot_module"), "{error}");
}
