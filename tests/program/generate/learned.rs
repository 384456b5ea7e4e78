//! `self_collision_model_module`: trained, the same with any number of threads, and refused where it is useless.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use serde_json::Value;
use urdd_generate::note::NoteKind;
use urdd_generate::{Effort, Generated, Selection, Settings, generate};
use urdd_robot::Robot;

use super::{findings_of, read_json};

/// Enough training for a useful model, in a short time.
const LITTLE: Effort = Effort { training: 4_000, calibration: 3_000, epochs: 4 };
/// Enough for some model.
const LEAST: Effort = Effort { training: 500, calibration: 500, epochs: 1 };

const MODULE: &str = "link_shapes_modules/self_collision_model_module/module.json";

fn settings() -> Settings {
    with(LITTLE)
}

fn with(model_effort: Effort) -> Settings {
    Settings {
        selection: Selection::parse(["shapes", "self_collision_model"]).unwrap(),
        model_effort,
        ..Settings::default()
    }
}

fn robot(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/robots");
    folder.join(name)
}

/// A robot with two long boxes on joints, which meet half of the time; written to a given path.
fn pair(folder: &Path, joint: &str) -> PathBuf {
    let link = |name: &str| {
        format!(
            "<link name='{name}'><collision><origin xyz='0.2 0 0'/><geometry><box size='0.4 0.1 0.1'/></geometry></collision></link>"
        )
    };
    let joint = |name: &str, at: &str| {
        format!(
            "<joint name='{name}_joint' type='{joint}'><parent link='base'/><child link='{name}'/><origin xyz='{at}'/><axis xyz='0 0 1'/><limit lower='-3' upper='3' effort='1' velocity='1'/></joint>"
        )
    };
    let text = format!(
        "<robot name='pair'><link name='base'/>{}{}{}{}</robot>",
        link("left"),
        link("right"),
        joint("left", "0 0.3 0"),
        joint("right", "0 -0.3 0"),
    );
    let path = folder.join("pair.urdf");
    std::fs::write(&path, text).unwrap();
    path
}

/// The URDD of [`pair`] on hinges, with a model: trained once, by one thread.
fn trained(urdf: &Path, target: &Path) {
    static FILES: OnceLock<BTreeMap<String, Vec<u8>>> = OnceLock::new();
    let train = || {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        pool.unwrap().install(|| make(urdf, target, &settings()));
        testkit::files::below(target)
    };
    for (path, bytes) in FILES.get_or_init(train) {
        let file = target.join(path);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(file, bytes).unwrap();
    }
}

fn make(urdf: &Path, folder: &Path, settings: &Settings) -> Generated {
    generate(urdf, folder, settings, &()).unwrap_or_else(|error| panic!("{error}"))
}

fn count(model: &Value, key: &str) -> u64 {
    model["evaluation"][key].as_u64().unwrap()
}

#[test]
fn a_model_says_how_often_it_is_right_and_a_validator_agrees() {
    let folder = testkit::temporary::folder();
    let (urdf, made) = (pair(folder.path(), "revolute"), folder.path().join("made"));
    trained(&urdf, &made);
    assert_eq!(findings_of(&made), []);
    let model = read_json(&made.join(MODULE));
    let [colliding, missed, near, near_missed, free, cleared] = [
        "num_colliding",
        "num_missed",
        "num_near_contact",
        "num_near_contact_missed",
        "num_free",
        "num_cleared",
    ]
    .map(|key| count(&model, key));
    // Far better than chance.
    assert!(colliding > free / 60, "{colliding}");
    assert!(missed * 5 < colliding, "{missed} of {colliding}");
    assert!(cleared * 10 > free * 8, "{cleared}");
    // Misses are close to contact.
    assert!(near > 50 && near * 5 < colliding, "{near}");
    assert!(near_missed * colliding > missed * near, "{near_missed}");

    // A number of cleared configurations below the true one is detected.
    let text = std::fs::read_to_string(made.join(MODULE)).unwrap();
    let (from, to) =
        (format!("\"num_cleared\": {cleared}"), format!("\"num_cleared\": {}", cleared - 20));
    assert!(text.contains(&from));
    std::fs::write(made.join(MODULE), text.replace(&from, &to)).unwrap();
    let codes: Vec<String> = findings_of(&made).into_iter().map(|of| of.0).collect();
    assert!(codes.contains(&"LRN010".to_owned()), "{codes:?}");
}

#[test]
fn the_same_bytes_by_one_thread_and_by_three() {
    let folder = testkit::temporary::folder();
    let urdf = pair(folder.path(), "revolute");
    let [one, three] = ["one", "three"].map(|name| folder.path().join(name));
    trained(&urdf, &one);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build();
    pool.unwrap().install(|| make(&urdf, &three, &settings()));
    let [one, three] = [one, three].map(|made| std::fs::read_to_string(made.join(MODULE)).unwrap());
    assert_eq!(one, three);
}

#[test]
fn it_is_kept_while_nothing_changes_and_not_made_unless_asked_for() {
    let folder = testkit::temporary::folder();
    let (urdf, made) = (pair(folder.path(), "revolute"), folder.path().join("made"));
    trained(&urdf, &made);
    let again = make(&urdf, &made, &settings());
    assert!(!again.changed);
    assert!(again.modules.last().is_some_and(|module| module.kept));
    make(&urdf, &made, &Settings::default());
    assert!(!made.join(MODULE).exists());
    assert_eq!(findings_of(&made), []);
    let error = Robot::open(&made).unwrap().collision_model().unwrap_err();
    assert_eq!(
        error.to_string(),
        "self_collision_model_module is missing: generate it with `urdd generate ROBOT.urdf -o DIR --modules self_collision_model`"
    );
}

/// A kept module is read back from its files.
#[test]
fn the_same_bytes_whether_the_rest_is_made_or_kept() {
    let folder = testkit::temporary::folder();
    let urdf = robot("six_axis_arm.urdf");
    let [at_once, later] = ["at_once", "later"].map(|name| folder.path().join(name));
    make(&urdf, &at_once, &with(LEAST));
    make(&urdf, &later, &Settings::default());
    make(&urdf, &later, &with(LEAST));
    let [at_once, later] = [at_once, later].map(|made| std::fs::read(made.join(MODULE)).unwrap());
    assert!(at_once == later, "other bytes");
}

#[test]
fn robots_for_which_it_is_of_no_use_go_without() {
    let folder = testkit::temporary::folder();
    let apart = folder.path().join("apart.urdf");
    let text = std::fs::read_to_string(pair(folder.path(), "revolute")).unwrap();
    std::fs::write(&apart, text.replace("0.3 0", "3 0")).unwrap();
    let fixed = folder.path().join("fixed.urdf");
    std::fs::write(&fixed, text.replace("'revolute'", "'fixed'")).unwrap();
    let planar = pair(folder.path(), "planar");
    for (urdf, why) in [
        (&planar, "DOF `left_joint/trans_x` is a length without limits"),
        (&apart, "0 of 4000 sampled configurations are in collision"),
        (&fixed, "no two links that are not skipped move relative to each other"),
    ] {
        let made = folder.path().join("made");
        let outcome = make(urdf, &made, &settings());
        let notes: Vec<_> = outcome.notes.iter().filter(|n| n.kind == NoteKind::OfNoUse).collect();
        assert_eq!(notes.len(), 1, "{:?}", outcome.notes);
        assert!(notes[0].problem.contains(why), "{}", notes[0].problem);
        assert!(!made.join(MODULE).exists());
        assert_eq!(findings_of(&made), []);
        std::fs::remove_dir_all(&made).unwrap();
    }
}

/// Links of one box each; `parent` gives each link's parent, and `at` its position. All of them turn about z.
fn boxes(count: usize, parent: impl Fn(usize) -> String, at: impl Fn(usize) -> String) -> String {
    let link = |k: usize| {
        let (parent, at) = (parent(k), at(k));
        format!(
            "<link name='l{k}'><collision><origin xyz='0.3 0 0'/><geometry><box size='0.6 0.05 0.05'/></geometry></collision></link><joint name='j{k}' type='revolute'><parent link='{parent}'/><child link='l{k}'/><origin xyz='{at}'/><axis xyz='0 0 1'/><limit lower='-3' upper='3' effort='1' velocity='1'/></joint>"
        )
    };
    let links: String = (0..count).map(link).collect();
    format!("<robot name='boxes'><link name='base'/>{links}</robot>")
}

#[test]
fn robots_that_are_too_large_go_without() {
    let folder = testkit::temporary::folder();
    let round = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / 40.0;
        format!("{} {} 0", angle.cos(), angle.sin())
    };
    let star = boxes(40, |_| "base".to_owned(), round);
    let before = |k: usize| match k {
        0 => "base".to_owned(),
        k => format!("l{}", k - 1),
    };
    // Only the first and the last have a shape.
    let line = boxes(103, before, |_| "0.01 0 0".to_owned());
    let (first, rest) = line.split_once("<link name='l1'>").unwrap();
    let (middle, last) = rest.split_once("<link name='l102'>").unwrap();
    let shape = &first[first.find("<collision>").unwrap()..first.find("</link><joint").unwrap()];
    let middle = middle.replace(shape, "");
    let line = format!("{first}<link name='l1'>{middle}<link name='l102'>{last}");
    for (name, text, why) in [
        ("star", star, "more than 512 pairs of links are not skipped"),
        ("line", line, "the robot has 103 DOFs, but a model supports at most 100"),
    ] {
        let urdf = folder.path().join(format!("{name}.urdf"));
        std::fs::write(&urdf, text).unwrap();
        let made = folder.path().join(name);
        let outcome = make(&urdf, &made, &settings());
        let notes = outcome.notes.iter();
        let notes: Vec<_> = notes.filter(|n| n.kind == NoteKind::OfNoUse).collect();
        assert_eq!(notes.len(), 1, "{:?}", outcome.notes);
        assert!(notes[0].problem.contains(why), "{}", notes[0].problem);
        assert!(!made.join(MODULE).exists());
    }
}

#[test]
fn a_robot_of_ours_with_lengths_turns_and_mimics() {
    let folder = testkit::temporary::folder();
    let made = folder.path().join("made");
    let outcome = make(&robot("scaled_parts.urdf"), &made, &with(LEAST));
    assert_eq!(findings_of(&made), []);
    let refused = outcome.notes.iter().any(|note| note.kind == NoteKind::OfNoUse);
    assert_eq!(refused, !made.join(MODULE).exists());
}
