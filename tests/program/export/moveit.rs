//! `urdd export moveit`: the folder is a package that our own readers take, and a person's changes stay.

use urdd_export::{import_srdf, import_states};
use urdd_robot::Robot;

use crate::program::urdd;
use testkit::robots::{made, made_of, our_robots};

/// The package of each of our robots: its meshes are in it, its SRDF says what the URDD says, and its URDF is ours.
#[test]
fn what_is_written_is_read_back() {
    for name in ["six_axis_arm", "quadruped"] {
        let robots = our_robots();
        let (_, urdf) = robots.iter().find(|(found, _)| found == name).expect(name);
        let (folder, path) = made(urdf);
        let folder = folder.path();
        let path = path.to_str().expect("a path");
        let robot = Robot::open(path).expect("a robot");
        let dof = robot.dof_names().expect("names").last().expect("a DOF").clone();
        let middle = robot.configurations().expect("bounds").middle();
        let set = format!("{dof}={}", middle.last().expect("a DOF"));
        assert_eq!(urdd(&["configurations", "set", path, "ready", &set], folder).0, 0);
        assert_eq!(urdd(&["export", "moveit", path, "-o", "arm_moveit"], folder).0, 0);
        let srdf = std::fs::read_to_string(folder.join(format!("arm_moveit/config/{name}.srdf")))
            .expect("an SRDF");
        let robot = Robot::open(path).expect("a robot");
        let skips = import_srdf(&robot, &srdf, false).expect("an SRDF of the robot");
        assert_eq!((skips.added, skips.unlisted), (0, 0), "{name}");
        let states = import_states(&robot, &srdf, false).expect("states");
        assert_eq!((states.changed, states.already), (0, 1), "{name}");
        let urdf = folder.join(format!("arm_moveit/config/{name}.urdf"));
        let text = std::fs::read_to_string(&urdf).expect("a URDF");
        let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("well-formed");
        let meshes = document.descendants().filter_map(|node| node.attribute("filename"));
        for mesh in meshes {
            let inside = mesh.strip_prefix("package://arm_moveit/").expect("of the package");
            assert!(folder.join("arm_moveit").join(inside).is_file(), "{mesh}");
        }
        // Our own reader finds the meshes by package.xml.
        let (status, _, said) =
            urdd(&["generate", urdf.to_str().expect("a path"), "-o", "again"], folder);
        assert_eq!(status, 0, "{said}");
        let again = Robot::open(folder.join("again")).expect("a robot");
        assert_eq!(again.dof_names(), robot.dof_names());

        // A person's changes stay: nothing is overwritten, and --update changes the pairs alone.
        let kinematics = folder.join("arm_moveit/config/kinematics.yaml");
        std::fs::write(&kinematics, "mine: 1\n").expect("written");
        let srdf_file = folder.join(format!("arm_moveit/config/{name}.srdf"));
        let mine = srdf.replace("</robot>", "  <group name=\"mine\"/>\n</robot>");
        std::fs::write(&srdf_file, &mine).expect("written");
        let (status, _, said) = urdd(&["export", "moveit", path, "-o", "arm_moveit"], folder);
        assert!(status == 2 && said.contains("already exists"), "{said}");
        let (status, _, said) =
            urdd(&["export", "moveit", path, "-o", "arm_moveit", "--update"], folder);
        assert!(status == 0 && said.contains("kinematics.yaml stays as it is"), "{said}");
        assert_eq!(std::fs::read_to_string(&kinematics).expect("text"), "mine: 1\n");
        assert_eq!(std::fs::read_to_string(&srdf_file).expect("text"), mine);
    }
}

#[test]
fn packages_have_names_that_ros_takes() {
    let (folder, path) = made_of(
        r#"<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="revolute"><parent link="a"/>
<child link="b"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="5" velocity="2"/></joint></robot>"#,
    );
    let folder = folder.path();
    let path = path.to_str().expect("a path");
    let export = |more: &[&str]| urdd(&[&["export", "moveit", path, "-o"], more].concat(), folder);
    assert_eq!(export(&["My-Robot config"]).0, 0);
    let package =
        std::fs::read_to_string(folder.join("My-Robot config/package.xml")).expect("a package");
    assert!(package.contains("<name>my_robot_config</name>"), "{package}");
    for wrong in [&["x", "--package", "../x"][..], &["x", "--package", "9a"], &["9 lives"]] {
        let (status, _, said) = export(wrong);
        assert!(status == 2 && said.contains("a letter first"), "{said}");
    }
}
