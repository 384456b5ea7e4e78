//! Recipes from legacy modules that describe how a robot was composed.

use std::path::Path;

use serde_json::{Value, json};
use urdd_generate::combine::{CombineError, Recipe};

fn of(folder: &Path, module: &str, document: Value) -> Result<(String, Vec<String>), CombineError> {
    let robot = folder.join("robot");
    std::fs::create_dir_all(robot.join(module)).expect("a folder");
    std::fs::write(robot.join(module).join("module.json"), document.to_string()).expect("a file");
    let (recipe, notes) = Recipe::of_legacy(&robot)?;
    let folder = folder.canonicalize().expect("a folder");
    let text = recipe.to_toml(&folder)?;
    // Reading it back gives the same recipe.
    let again = Recipe::from_toml(&text, "x.toml", &folder).expect("a recipe");
    assert_eq!(again.to_toml(&folder)?, text);
    Ok((text, notes.iter().map(ToString::to_string).collect()))
}

fn attached(robot: &str, point: Value, kind: &str) -> Value {
    json!({
        "robot_name": robot, "attachment_point": point, "joint_type": kind,
        "origin": { "xyz": [0.1, 0.0, 0.0], "rpy": [0.0, 1.571, 0.0] },
        "axis": { "xyz": [0.0, 0.0, 0.0] },
        "limit": { "lower": -3.1, "upper": 3.1, "effort": 0.0, "velocity": 2.0 },
        "dynamics": null, "safety_controller": null,
    })
}

#[test]
fn combined_robots_hang_on_the_world_and_on_each_other() {
    let folder = testkit::temporary::folder();
    let link = json!({ "Link": { "robot_idx": 0, "link_name": "a/b" } });
    let (text, notes) = of(
        folder.path(),
        "combined_robot_module",
        json!({ "name": "cell", "attached_robots": [
            attached("arm", json!("World"), "Fixed"),
            attached("hand", link, "Revolute"),
            attached("table", json!("World"), "Fixed"),
        ] }),
    )
    .expect("a recipe");
    assert_eq!(
        text,
        r#"name = "cell"

[base]
link = "combined_robot_world"
name = "connection_joint_robot_0"
joint = "fixed"
xyz = [0.1, 0.0, 0.0]
rpy = [0.0, 1.571, 0.0]

[[part]]
id = "arm"
source = "arm"
prefix = "robot_0_"

[[part]]
id = "hand"
source = "hand"
prefix = "robot_1_"

[part.attach]
to = "arm/a/b"
name = "connection_joint_robot_1"
joint = "revolute"
xyz = [0.1, 0.0, 0.0]
rpy = [0.0, 1.571, 0.0]

[part.attach.limit]
lower = -3.1
upper = 3.1
velocity = 2.0

[[part]]
id = "table"
source = "table"
prefix = "robot_2_"

[part.attach]
to = "base/combined_robot_world"
name = "connection_joint_robot_2"
joint = "fixed"
xyz = [0.1, 0.0, 0.0]
rpy = [0.0, 1.571, 0.0]
"#
    );
    assert_eq!(notes, ["the axis of the joint of robot 1 is 0 0 0; 1 0 0 is used"]);
}

#[test]
fn adjusted_robots_lose_branches_and_joints() {
    let folder = testkit::temporary::folder();
    let (text, notes) = of(
        folder.path(),
        "adjusted_robot_module",
        json!({
            "name": "short", "base_robot_name": "long", "dead_end_link_names": ["tip"],
            "fixed_base_joints": [["ball", [0.0, 0.1, 0.2]], ["turn", [0.5]]],
            "deleted_base_links": ["tip"], "deleted_base_joints": ["last"],
            "adjusted_link_idx_to_base_link_idx_mapping": [0],
            "base_link_idx_to_adjusted_link_idx_mapping": [0, null],
            "adjusted_joint_idx_to_base_joint_idx_mapping": [],
            "base_joint_idx_to_adjusted_joint_idx_mapping": [null],
        }),
    )
    .expect("a recipe");
    assert_eq!(
        text,
        "name = \"short\"\n\n[[part]]\nid = \"long\"\nsource = \"long\"\nprefix = \"\"\ndrop = [\"tip\"]\n\n[part.freeze]\nball = [0.0, 0.1, 0.2]\nturn = [0.5]\n"
    );
    assert_eq!(notes, [] as [&str; 0]);
}

#[test]
fn created_chains_say_what_a_recipe_cannot() {
    let folder = testkit::temporary::folder();
    let pose = json!({ "rotation": [0.0, 0.0, 1.0, 0.0], "translation": [1.0, 2.0, 3.0] });
    let chain = json!({ "AddAlreadyExistingChain": { "name": "arm", "base_offset": pose, "scale": [1.0, 1.0, 2.0] } });
    let mass = json!({ "SetObjectMass": { "object_name": "x", "mass": 1.0 } });
    let module = |actions: Value| json!({ "name": "room", "actions": actions });
    let (text, notes) =
        of(folder.path(), "creator_module", module(json!([chain, mass]))).expect("a recipe");
    assert!(text.contains("xyz = [1.0, 2.0, 3.0]\nrpy = [0.0, 0.0, 3.14"), "{text}");
    assert_eq!(notes.len(), 2);
    assert!(
        notes[0].starts_with("action 0 scales `arm`")
            && notes[1].starts_with("action 1, SetObjectMass,"),
        "{notes:?}"
    );
    let error = of(folder.path(), "creator_module", module(json!([mass]))).expect_err("nothing");
    let words = "a recipe cannot express how it was combined: action 0, SetObjectMass,";
    assert!(error.to_string().contains(words), "{error}");
}
