//! Named configurations of parts in a combined robot.

use std::path::Path;

use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_generate::generate;
use urdd_robot::Robot;

use crate::combine::support::{core, findings, ours, put_together};

const CELL: &str = r#"name = "cell"
[base]
[[part]]
id = "left"
source = "gripper"
[[part]]
id = "right"
source = "gripper"
attach = { to = "left/gripper_base", xyz = [0, 1, 0] }
freeze = { motor = 0.5 }
"#;

fn edit(name: &str, positions: &[(&str, f64)]) -> ConfigurationEdit {
    let positions = positions.iter();
    let position = |(dof, position): &(&str, f64)| DofPosition {
        dof_name: (*dof).to_owned(),
        position: *position,
    };
    ConfigurationEdit {
        name: ConfigurationName::new(name).expect("a name"),
        positions: positions.map(position).collect(),
    }
}

fn write(urdd: &Path, edits: &[ConfigurationEdit]) {
    let robot = Robot::open(urdd).expect("a robot");
    let edited = robot.with_named_configurations(edits);
    for (path, bytes) in edited.expect("configurations").files {
        let path = urdd.join(path);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, bytes).expect("a file");
    }
}

fn edits_of(urdd: &Path) -> Vec<ConfigurationEdit> {
    let robot = Robot::open(urdd).expect("a robot");
    let named = robot.named_configurations().expect("configurations");
    named.iter().map(ConfigurationEdit::from).collect()
}

#[test]
fn configurations_of_parts_come_along_by_name_and_a_persons_stay() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    let gripper = folder.join("gripper");
    generate(&ours("gripper"), &gripper, &core(), &()).expect("a URDD");
    write(&gripper, &[edit("open", &[("motor", 0.25)])]);
    let (made, target) = put_together(CELL, folder, &core()).expect("a robot");
    let lost: Vec<String> = (made.notes.iter())
        .filter(|note| note.kind == "position-lost")
        .map(ToString::to_string)
        .collect();
    let expected = "part `right`: the configuration `open` is kept without a position of `motor`, whose joint is dropped or frozen";
    assert_eq!(lost, [expected]);
    let of_parts = [edit("left_open", &[("left_motor", 0.25)]), edit("right_open", &[])];
    assert_eq!(edits_of(&target), of_parts);
    assert_eq!(findings(&target), [] as [String; 0]);
    // A user changes one of them, and adds another: both stay.
    let own = [
        edit("left_open", &[("left_motor", 0.5)]),
        edit("right_open", &[]),
        edit("mine", &[("left_motor", 0.125)]),
    ];
    write(&target, &own);
    put_together(CELL, folder, &core()).expect("a robot");
    assert_eq!(edits_of(&target), own);
}

#[test]
fn of_two_configurations_with_one_name_the_first_is_kept() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    for (name, position) in [("gripper", 0.25), ("hand", 0.125)] {
        let urdd = folder.join(name);
        generate(&ours(name), &urdd, &core(), &()).expect("a URDD");
        let dof = Robot::open(&urdd).expect("a robot").dof_names().expect("names")[0].clone();
        write(&urdd, &[edit("open", &[(&dof, position)])]);
    }
    let recipe = r#"name = "cell"
[base]
[[part]]
id = "gripper"
source = "gripper"
prefix = ""
[[part]]
id = "hand"
source = "hand"
prefix = ""
attach = { to = "gripper/gripper_base", xyz = [0, 1, 0] }
"#;
    let (made, target) = put_together(recipe, folder, &core()).expect("a robot");
    let lost: Vec<String> = (made.notes.iter())
        .filter(|note| note.kind == "configuration-lost")
        .map(ToString::to_string)
        .collect();
    let expected = "part `hand`: the configuration `open` is left out, since an earlier part has one of this name; give the part a prefix";
    assert_eq!(lost, [expected]);
    assert_eq!(edits_of(&target), [edit("open", &[("motor", 0.25)])]);
}
