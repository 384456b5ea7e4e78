//! URDDs of composed robots.

use std::collections::BTreeMap;
use std::path::Path;

use nalgebra::Isometry3;
use serde_json::Value;
use urdd_format::link_shapes_skips::SkipEdit;
use urdd_generate::{Settings, generate, generate_text};
use urdd_robot::{Robot, ShapeKind};

use testkit::files;

use crate::combine::support::{core, findings, ours, put_together, with_ours};

/// Few samples: these tests do not check distances.
fn quick() -> Settings {
    Settings { num_samples: 20, ..with_ours() }
}

/// The edits of the skips that a URDD has.
fn edits_of(urdd: &Path) -> Vec<SkipEdit> {
    let robot = Robot::open(urdd).expect("a robot");
    let skips = robot.skips(ShapeKind::Hulls).expect("skips");
    skips.edits().to_vec()
}

/// A quadruped with a welding arm, and a gripper on the arm, all as URDDs, in `folder`.
fn parts(folder: &Path) {
    for name in ["quadruped", "welding_arm", "gripper"] {
        generate(&ours(name), &folder.join(name), &quick(), &()).expect("a URDD");
    }
}

const DOG: &str = r#"name = "dog"
[base]
link = "odom"
joint = "floating"
[[part]]
id = "dog"
source = "quadruped"
prefix = ""
[[part]]
id = "arm"
source = "welding_arm"
attach = { to = "dog/trunk", xyz = [0.1, 0, 0.08], rpy = [0, 0, 3] }
drop = ["torch"]
[[part]]
id = "left"
source = "gripper"
attach = { to = "arm/flange", joint = "revolute", axis = [0, 0, 1], limit = { lower = -1, upper = 1 } }
skip = [["gripper_base", "dog/trunk"]]
[[part]]
id = "right"
source = "gripper"
freeze = { motor = 1.5 }
attach = { to = "dog/trunk", xyz = [-0.1, 0, 0.1] }
"#;

const STATISTICS: &str = "link_shapes_distance_statistics_module";

/// Whether documents are equal to within 1e-15 m.
fn are_near(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => match (a.as_f64(), b.as_f64()) {
            (Some(a), Some(b)) => (a - b).abs() <= 1e-15,
            _ => a == b,
        },
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| are_near(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            let near = |(key, value): (&String, &Value)| {
                b.get(key).is_some_and(|other| are_near(value, other))
            };
            a.len() == b.len() && a.iter().all(near)
        }
        _ => a == b,
    }
}

#[test]
fn the_urdd_of_a_composed_robot_is_the_one_that_is_made_of_its_urdf() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    parts(folder);
    let (made, target) = put_together(DOG, folder, &quick()).expect("a robot");
    assert_eq!(findings(&target), [] as [String; 0]);
    assert_eq!(made.generated.num_links, 1 + 19 + 7 + 8 + 8);
    // Its references are resolved from the URDD's own folder.
    let text = std::fs::read(target.join("dog.urdf")).expect("the URDF");
    let again = folder.join("again");
    let from_nothing = generate_text(text, "dog", &target, &again, &quick(), &());
    assert_eq!(from_nothing.expect("a URDD").robot_name, "dog");
    let (mut ours, mut theirs) = (files::below(&target), files::below(&again));
    // The vertices of meshes read from files are in another order than those of generated meshes: where faces touch,
    // the last bit of a distance may differ.
    let distances = |files: &BTreeMap<String, Vec<u8>>| -> Value {
        let module = format!("link_shapes_modules/{STATISTICS}/module.json");
        serde_json::from_slice(&files[&module]).expect("JSON")
    };
    assert!(are_near(&distances(&ours), &distances(&theirs)));
    let known = |path: &String| {
        !path.starts_with("composition_module/")
            && !path.contains(STATISTICS)
            // Only the recipe supplies edits.
            && !path.contains("link_shapes_skips_module")
            && !path.ends_with(".urdf")
            && path != "urdd.json"
    };
    ours.retain(|path, _| known(path));
    theirs.retain(|path, _| known(path));
    assert!(ours.len() > 300, "{}", ours.len());
    let differ: Vec<&String> = (ours.keys().chain(theirs.keys()))
        .filter(|path| ours.get(*path) != theirs.get(*path))
        .collect();
    assert_eq!(differ, [] as [&String; 0]);
}

#[test]
fn meshes_are_carried_once() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    generate(&ours("hand"), &folder.join("hand"), &quick(), &()).expect("a URDD");
    let recipe = "[base]\n[[part]]\nid = \"left\"\nsource = \"hand\"\n[[part]]\nid = \"right\"\nsource = \"hand\"\nattach = { to = \"left/palm\", xyz = [0, 1, 0] }";
    let (_, target) = put_together(recipe, folder, &quick()).expect("a robot");
    let meshes = |urdd: &Path| {
        let all = files::below(&urdd.join("mesh_modules/original_meshes_module/meshes"));
        let mut contents: Vec<Vec<u8>> = all.into_values().collect();
        contents.sort();
        contents
    };
    assert_eq!(meshes(&target), meshes(&folder.join("hand")));
}

#[test]
fn edits_of_parts_come_along_by_name_and_a_persons_edits_stay() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    parts(folder);
    let edit = |link_a: &str, link_b: &str, skip: bool, reason: &str| SkipEdit {
        link_a: link_a.to_owned(),
        link_b: link_b.to_owned(),
        skip,
        reason: reason.to_owned(),
    };
    let edits = vec![edit("base", "flange", true, "seen"), edit("torch", "flange", false, "lost")];
    let write = |urdd: &Path, edits: Vec<SkipEdit>| {
        let edited = Robot::open(urdd).expect("a robot").with_skip_edits(edits, None);
        for (path, bytes) in edited.expect("edits").files {
            // Kept files may be links to those of other runs.
            let path = urdd.join(path);
            std::fs::remove_file(&path).expect("a file");
            std::fs::write(path, bytes).expect("a file");
        }
    };
    write(&folder.join("welding_arm"), edits);
    let (made, target) = put_together(DOG, folder, &quick()).expect("a robot");
    let lost = made.notes.iter().filter(|note| note.kind == "edit-lost");
    assert_eq!(lost.count(), 1, "{:?}", made.notes);
    let of_parts = vec![
        edit("arm_base", "arm_flange", true, "seen"),
        edit("left_gripper_base", "trunk", true, "the recipe skips it"),
    ];
    assert_eq!(edits_of(&target), of_parts);
    // A user edits the composed URDD; another run keeps these edits, after those of the parts.
    let own = edit("odom", "trunk", false, "mine");
    write(&target, [of_parts.clone(), vec![own.clone()]].concat());
    put_together(DOG, folder, &quick()).expect("a robot");
    assert_eq!(edits_of(&target), [of_parts, vec![own]].concat());
    assert_eq!(findings(&target), [] as [String; 0]);
}

#[test]
fn a_composed_robot_is_a_part_again() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    let of_two = |recipe: &str, name: &str| {
        put_together(recipe, folder, &core()).expect("a robot");
        std::fs::rename(folder.join("cell"), folder.join(name)).expect("a folder");
    };
    let arm = format!(
        "name = \"armed\"\n[[part]]\nid = \"arm\"\nsource = \"{}\"\n[[part]]\nid = \"gripper\"\nsource = \"{}\"\nattach = {{ to = \"arm/tool0\", joint = \"continuous\", axis = [0, 0, 1] }}",
        ours("six_axis_arm").display(),
        ours("gripper").display()
    );
    of_two(&arm, "armed");
    let two = "[base]\n[[part]]\nid = \"left\"\nsource = \"armed\"\n[[part]]\nid = \"right\"\nsource = \"armed\"\nattach = { to = \"left/arm_base_link\", xyz = [0, 1, 0] }";
    let (made, target) = put_together(two, folder, &core()).expect("a robot");
    assert_eq!(findings(&target), [] as [String; 0]);
    let parts = &made.composition.parts;
    let nested = parts[1].composition.as_ref().expect("a composition");
    let ids: Vec<&str> = nested.parts.iter().map(|part| part.id.as_str()).collect();
    assert_eq!(ids, ["arm", "gripper"]);
    let robot = Robot::open(&target).expect("a robot");
    assert!(robot.link("right_gripper_pinion").is_ok());
}

#[test]
fn each_part_moves_as_by_itself() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    generate(&ours("six_axis_arm"), &folder.join("arm"), &core(), &()).expect("a URDD");
    generate(&ours("gripper"), &folder.join("gripper"), &core(), &()).expect("a URDD");
    let recipe = "[[part]]\nid = \"arm\"\nsource = \"arm\"\nprefix = \"\"\n[[part]]\nid = \"g\"\nsource = \"gripper\"\nattach = { to = \"arm/tool0\", xyz = [0.1, 0.2, 0.3], rpy = [0.4, -0.5, 0.6] }";
    let (_, target) = put_together(recipe, folder, &core()).expect("a robot");
    let open = |path: &Path| Robot::open(path).expect("a robot");
    let (arm, gripper, whole) =
        (open(&folder.join("arm")), open(&folder.join("gripper")), open(&target));
    let q = whole.configurations().expect("configurations").random(3);
    let (of_arm, of_gripper) = q.split_at(arm.configurations().expect("them").num_dofs());
    let poses = whole.link_poses(&q).expect("poses");
    let arm_poses = arm.link_poses(of_arm).expect("poses");
    let attachment = Isometry3::from_parts(
        nalgebra::Translation3::new(0.1, 0.2, 0.3),
        nalgebra::UnitQuaternion::from_euler_angles(0.4, -0.5, 0.6),
    );
    let base = arm_poses[arm.link("tool0").expect("a link")] * attachment;
    let moved = gripper.link_poses(of_gripper).expect("poses");
    for (name, pose) in gripper.link_names().expect("links").iter().zip(moved) {
        let link = whole.link(&format!("g_{name}")).expect("a link");
        let apart = (poses[link].to_homogeneous() - (base * pose).to_homogeneous()).amax();
        assert!(apart < 1e-14, "{name}: {apart:e}");
    }
}
