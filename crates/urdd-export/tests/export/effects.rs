//! Each option of the table does something in each of its formats: a row that nobody reads is found here.

use serde_json::{Value, json};
use testkit::robots::made_of;
use testkit::urdfs::TOWER;
use urdd_export::{CHOICES, Choice, Choices, Format, Kind, Setup};
use urdd_robot::Robot;

use crate::made::export;

/// A value of each option that says something else than its default, and what else is chosen in both cases. One that is for
/// all formats need not do something in each: SRDF has no actuators, and takes `bandwidth` from a configuration of all.
fn example(option: &str) -> (Value, Vec<(&'static str, Value)>) {
    let alone = |value| (value, Vec::new());
    match option {
        "shapes" => alone(json!("spheres")),
        "reasons" => alone(json!(["never"])),
        "keep_pairs" | "cover" | "floating_base" | "merge_fixed" | "sensors" | "scene" => {
            alone(json!(true))
        }
        "spheres" => alone(json!(2)),
        "total_spheres" => alone(json!(9)),
        "samples" => alone(json!(200)),
        "visuals" => alone(json!(false)),
        "mesh_folder" => alone(json!("elsewhere")),
        "fit" => alone(json!([1.5, 0.02])),
        "root" => alone(json!("arm")),
        "actuators" => alone(json!("position")),
        "bandwidth" => (json!(3.0), vec![("actuators", json!("position"))]),
        "robot_file" => alone(json!("robots/r.urdf")),
        "package" => alone(json!("elsewhere")),
        "ros" => alone(json!("humble")),
        _ => panic!("write a value of `{option}` that changes what is written"),
    }
}

/// Pairs of links are the same, whatever the root is.
const IDLE: [(&str, Format); 1] = [("root", Format::Srdf)];

fn chosen(values: &[(&str, Value)], setup: &Setup) -> Choices {
    let (output, setup) = (Some("tower.out".into()), Some(setup.clone()));
    let mut choices = Choices { samples: 100, output, setup, ..Choices::default() };
    for (name, value) in values {
        let choice = Choice::named(name).expect("an option");
        choice.set(&mut choices, value).expect("a value of the option");
    }
    choices
}

#[test]
fn each_option_does_something_where_it_is_taken() {
    let heavy = "<inertial><mass value=\"2\"/><inertia ixx=\"0.02\" ixy=\"0\" ixz=\"0\" iyy=\"0.02\" iyz=\"0\" izz=\"0.02\"/></inertial>";
    let urdf = ["base", "hub", "arm"].iter().fold(TOWER.to_owned(), |urdf, link| {
        let (empty, open) = (format!("<link name=\"{link}\"/>"), format!("<link name=\"{link}\">"));
        urdf.replace(&empty, &format!("{open}</link>")).replace(&open, &format!("{open}{heavy}"))
    });
    let tool = format!(
        "<link name=\"tool\">{heavy}</link><joint name=\"c\" type=\"fixed\"><parent link=\"arm\"/><child link=\"tool\"/></joint></robot>"
    );
    let (_folder, path) = made_of(&urdf.replace("</robot>", &tool));
    let robot = Robot::open(&path).expect("a robot");
    let setup = "robot = \"tower\"\n[frames]\nimus = [\"base\"]\n";
    let setup = Setup::from_toml(setup, "x", &robot).expect("a setup");
    for choice in CHOICES {
        let (value, mut with) = example(choice.name);
        let without = chosen(&with, &setup);
        with.push((choice.name, value));
        let chosen = chosen(&with, &setup);
        let changes = |format: &&Format| {
            let [before, after] = [&without, &chosen]
                .map(|choices| export(&robot, **format, choices).expect("an export"));
            (before.text, before.path, before.files) != (after.text, after.path, after.files)
        };
        let name = choice.name;
        if choice.of.len() == Format::ALL.len() {
            let mut taking = choice.of.iter().filter(|format| chosen.options(**format).is_ok());
            assert!(taking.any(|format| changes(&format)), "`{name}` does nothing");
        } else {
            let is_idle = |format: &&Format| !changes(format) && !IDLE.contains(&(name, **format));
            let idle: Vec<_> = choice.of.iter().filter(is_idle).collect();
            assert!(idle.is_empty(), "`{name}` does nothing in {idle:?}");
        }
    }
}

/// Messages about a range name the option that has it.
#[test]
fn a_range_has_the_name_of_its_option() {
    for choice in CHOICES {
        if let Kind::Number(range) = choice.kind {
            assert_eq!(range.option, choice.name);
        }
    }
}
