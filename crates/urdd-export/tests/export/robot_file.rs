//! cuRobo's whole robot file: the keys of its template, and spheres that are run through our own kinematics. cuRobo needs
//! a GPU and is not to be had here.

use crate::made::export;
use nalgebra::Point3;
use serde_json::{Value, json};
use urdd_export::{Choices, Export, Format, Note, Setup};
use urdd_robot::Robot;

use testkit::robots::{made, our_robots};

/// The keys of `robot_cfg.kinematics` in cuRobo 0.7, and of its `cspace`.
const KINEMATICS: [&str; 21] = [
    "asset_root_path",
    "base_link",
    "collision_link_names",
    "collision_sphere_buffer",
    "collision_spheres",
    "cspace",
    "ee_link",
    "extra_collision_spheres",
    "extra_links",
    "isaac_usd_path",
    "link_names",
    "lock_joints",
    "mesh_link_names",
    "self_collision_buffer",
    "self_collision_ignore",
    "urdf_path",
    "usd_flip_joint_limits",
    "usd_flip_joints",
    "usd_path",
    "usd_robot_root",
    "use_global_cumul",
];
const CSPACE: [&str; 6] = [
    "cspace_distance_weight",
    "joint_names",
    "max_acceleration",
    "max_jerk",
    "null_space_weight",
    "retract_config",
];

fn robot_of(name: &str) -> (tempfile::TempDir, Robot) {
    let robots = our_robots();
    let (_, urdf) = robots.iter().find(|(found, _)| found == name).expect(name);
    let (folder, path) = made(urdf);
    (folder, Robot::open(path).expect("a robot"))
}

fn exported(robot: &Robot, setup: Option<&str>) -> (Export, Value) {
    let options = Choices {
        robot_file: Some("robot.urdf".to_owned()),
        samples: 500,
        spheres: Some(4),
        setup: setup.map(|text| Setup::from_toml(text, "x", robot).expect("read")),
        ..Choices::default()
    };
    let made = export(robot, Format::Curobo, &options).expect("an export");
    let document: Value = serde_yaml::from_str(&made.text).expect("YAML");
    (made, document["robot_cfg"]["kinematics"].clone())
}

fn keys(value: &Value) -> Vec<&str> {
    let keys = value.as_object().expect("a map").keys();
    let mut keys: Vec<&str> = keys.map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

fn texts(value: &Value) -> Vec<&str> {
    let items = value.as_array().expect("a list").iter();
    items.map(|item| item.as_str().expect("text")).collect()
}

/// The deepest contact between spheres that are not ignored, m; negative where all are apart.
fn depth(robot: &Robot, file: &Value, configuration: &[f64]) -> f64 {
    let poses = robot.link_poses(configuration).expect("poses");
    let mut spheres = Vec::new();
    for (link, list) in file["collision_spheres"].as_object().expect("a map") {
        let place = robot.link(link).expect("a link");
        for sphere in list.as_array().expect("spheres") {
            let centre = [0, 1, 2].map(|k| sphere["center"][k].as_f64().expect("a number"));
            let radius = sphere["radius"].as_f64().expect("a number");
            spheres.push((link.as_str(), poses[place] * Point3::from(centre), radius));
        }
    }
    let is_ignored = |a: &str, b: &str| {
        let list = &file["self_collision_ignore"][a];
        list.as_array().is_some_and(|list| list.iter().any(|other| other == b))
    };
    let mut deepest = f64::NEG_INFINITY;
    for (place, (a, p, r)) in spheres.iter().enumerate() {
        for (b, q, s) in &spheres[..place] {
            if a != b && !is_ignored(a, b) && !is_ignored(b, a) {
                deepest = deepest.max(r + s - (p - q).norm());
            }
        }
    }
    deepest
}

#[test]
fn the_file_has_the_keys_of_curobos_template_and_is_free_where_it_retracts() {
    for name in ["six_axis_arm", "gripper", "hand"] {
        let (_folder, robot) = robot_of(name);
        let (made, file) = exported(&robot, None);
        assert_eq!(keys(&file), KINEMATICS, "{name}");
        let cspace = &file["cspace"];
        assert_eq!(keys(cspace), CSPACE, "{name}");
        let joints = texts(&cspace["joint_names"]);
        for key in ["retract_config", "null_space_weight", "cspace_distance_weight"] {
            assert_eq!(cspace[key].as_array().expect("numbers").len(), joints.len(), "{name}");
        }
        assert_eq!(
            (&cspace["max_jerk"], &cspace["max_acceleration"]),
            (&json!(500.0), &json!(15.0))
        );
        // Each joint is in the configuration space or locked; a link of which a joint is in neither has no place.
        let locked =
            file["lock_joints"].as_object().map_or_else(Vec::new, |locked| locked.keys().collect());
        for dof in robot.dof_names().expect("names") {
            assert!(joints.contains(&dof.as_str()) != locked.contains(&dof), "{name} {dof}");
        }
        // Each ignore names links that have spheres.
        let links = texts(&file["collision_link_names"]);
        assert_eq!(keys(&file["collision_spheres"]).len(), links.len());
        for (link, others) in file["self_collision_ignore"].as_object().expect("a map") {
            assert!(
                links.contains(&link.as_str())
                    && texts(others).iter().all(|other| links.contains(other))
            );
        }
        let zero = robot.configurations().expect("bounds").zero();
        let is_said = made.notes.iter().any(|note| matches!(note, Note::Retract { .. }));
        assert_eq!(depth(&robot, &file, &zero) > 0.0, is_said, "{name}");
        assert!(!is_said || name != "six_axis_arm");
    }
}

#[test]
fn a_person_chooses_the_end_effector_locks_and_limits() {
    let (_folder, robot) = robot_of("six_axis_arm");
    let dofs = robot.dof_names().expect("names").to_vec();
    let (_, plain) = exported(&robot, None);
    assert_eq!(plain["ee_link"], "tool0");
    assert_eq!(plain["lock_joints"], Value::Null);
    let joint = &dofs[5];
    let text = format!(
        "robot = \"six_axis_arm\"\n[limits]\nacceleration = 3.0\njerk = 30.0\n[curobo]\nee_link = \"shoulder\"\nlocked = {{ \"{joint}\" = 0.25 }}\n"
    );
    let (made, file) = exported(&robot, Some(&text));
    assert_eq!(file["ee_link"], "shoulder");
    assert_eq!(file["extra_links"]["attached_object"]["parent_link_name"], "shoulder");
    assert_eq!(texts(&file["cspace"]["joint_names"]), [dofs[0].as_str()]);
    assert_eq!(file["lock_joints"][joint], 0.25);
    assert_eq!(file["lock_joints"].as_object().expect("a map").len(), 5);
    assert_eq!(file["cspace"]["max_acceleration"], 3.0);
    assert_eq!(file["cspace"]["max_jerk"], 30.0);
    assert!(!made.notes.contains(&Note::Guessed));
}

/// A spherized URDF has the spheres of the other formats as collision geometry.
#[test]
fn a_spherized_urdf_has_the_same_spheres() {
    let (_folder, robot) = robot_of("gripper");
    let (_, file) = exported(&robot, None);
    let options = Choices { samples: 500, spheres: Some(4), ..Choices::default() };
    let made = export(&robot, Format::Spherized, &options).expect("an export");
    let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
    for (link, list) in file["collision_spheres"].as_object().expect("a map") {
        let mut links = document.descendants().filter(|node| node.has_tag_name("link"));
        let found = links.find(|node| node.attribute("name") == Some(link)).expect("a link");
        let spheres: Vec<Value> = found
            .children()
            .filter(|node| node.has_tag_name("collision"))
            .map(|collision| {
                let of = |tag: &str, key: &str| {
                    let node = collision.descendants().find(|node| node.has_tag_name(tag));
                    let text = node.and_then(|node| node.attribute(key)).expect(key);
                    text.split(' ')
                        .map(|word| word.parse().expect("a number"))
                        .collect::<Vec<f64>>()
                };
                json!({"center": of("origin", "xyz"), "radius": of("sphere", "radius")[0]})
            })
            .collect();
        assert_eq!(json!(spheres), *list, "{link}");
    }
}
