//! Which SRDFs are a robot's: where they are, whose names they have, and what is found in them.

use std::fs;
use std::path::Path;

use super::linted;
use urdd_lint::LintSettings;

const ARM: &str = include_str!("../cases/LNT063/near_miss.urdf");
/// A fault: `lower` is no link.
const LINE: &str = "<disable_collisions link1=\"base\" link2=\"lower\"/>";
/// Another robot's, which has a link `base`, too.
const OTHER: &str = "<robot name=\"leg\"><disable_collisions link1=\"hip\" link2=\"knee\"/>\
    <disable_collisions link1=\"base\" link2=\"foot\"/><group name=\"g\"/>\
    <group_state name=\"s\" group=\"none\"/></robot>";

fn srdf(name: &str) -> String {
    format!("<robot name=\"{name}\">{LINE}<passive_joint name=\"turn\"/></robot>")
}

/// The SRDFs of findings in a robot with these files, its own being the first.
fn found(urdf: &str, files: &[(&str, &str)]) -> Vec<String> {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in [&[(urdf, ARM)][..], files].concat() {
        let path = folder.path().join("ws").join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("written");
    }
    let file = folder.path().join("ws").join(urdf);
    let findings =
        linted(Path::new(&file), &LintSettings::default()).report.urdds.remove(0).findings;
    let places = findings.iter().flat_map(|finding| &finding.places);
    let names = places.map(|place| place.file.clone().unwrap_or_default());
    names.collect()
}

#[test]
fn srdfs_are_found_where_moveit_puts_them() {
    let urdf = "arm_description/urdf/arm.urdf";
    for (file, seen) in [
        ("arm_description/urdf/arm.srdf", "arm.srdf"),
        ("arm_description/urdf/srdf/arm.srdf", "srdf/arm.srdf"),
        ("arm_description/config/arm.srdf", "../config/arm.srdf"),
        ("arm_description/srdf/arm.srdf", "../srdf/arm.srdf"),
        ("arm_moveit_config/config/arm.srdf", "../../arm_moveit_config/config/arm.srdf"),
        // A folder for each robot.
        ("arm_description/config/arm/arm.srdf", "../config/arm/arm.srdf"),
        ("arm_moveit_config/config/arm/arm.srdf", "../../arm_moveit_config/config/arm/arm.srdf"),
        // Another name: the only one, and of this robot.
        ("arm_description/config/all.srdf", "../config/all.srdf"),
        ("arm_moveit_config/config/all.srdf", "../../arm_moveit_config/config/all.srdf"),
    ] {
        assert_eq!(found(urdf, &[(file, &srdf("arm"))]), [seen], "{file}");
    }
    let xacro = [("arm_moveit_config/config/arm.srdf", &*srdf("arm"))];
    assert_eq!(found("arm_description/urdf/arm.robot.urdf", &xacro).len(), 1);
}

#[test]
fn srdfs_of_a_robot_in_a_folder_of_its_own_are_those_of_its_package() {
    let urdf = "arm_description/urdf/arm/arm.urdf";
    let package =
        ("arm_description/package.xml", "<package><name>arm_description</name></package>");
    for (file, seen) in [
        ("arm_description/config/arm.srdf", "../../config/arm.srdf"),
        ("arm_description/config/arm/arm.srdf", "../../config/arm/arm.srdf"),
        ("arm_moveit_config/config/arm/arm.srdf", "../../../arm_moveit_config/config/arm/arm.srdf"),
    ] {
        assert_eq!(found(urdf, &[(file, &srdf("arm")), package]), [seen], "{file}");
    }
    // Outside of its package.
    let outside = [
        ("arm_description/urdf/package.xml", "<package><name>arm</name></package>"),
        ("arm_description/config/arm.srdf", &*srdf("arm")),
    ];
    assert_eq!(found(urdf, &outside), [""; 0]);
}

#[test]
fn an_srdf_that_is_of_no_robot_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in
        [("urdf/arm.urdf", ARM), ("config/arm.srdf", &*srdf("arm")), ("config/leg.srdf", OTHER)]
    {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("written");
    }
    let run = linted(folder.path(), &LintSettings::default());
    let [aside] = &run.asides[..] else { panic!("{:?}", run.asides) };
    assert!(aside.starts_with("1 SRDF was matched with no robot that was examined"), "{aside}");
    assert!(aside.contains("leg.srdf") && !aside.contains("arm.srdf"), "{aside}");
}

#[test]
fn srdfs_of_other_robots_are_left_alone() {
    let own = ("config/arm.srdf", &*srdf("arm"));
    assert_eq!(found("urdf/arm.urdf", &[("config/leg.srdf", OTHER)]), [""; 0]);
    assert_eq!(found("urdf/arm.urdf", &[own, ("config/leg.srdf", OTHER)]), ["../config/arm.srdf"]);
    assert_eq!(found("urdf/arm.urdf", &[("leg_moveit_config/config/leg.srdf", OTHER)]), [""; 0]);
    // Of one that is called as this robot, or has its links, in MoveIt's package of another one.
    let other = OTHER.replace("leg", "arm");
    assert_eq!(found("urdf/arm.urdf", &[("config/all.srdf", &other)]), [""; 0]);
    let links = [("all_moveit_config/config/all.srdf", &*srdf("leg"))];
    assert_eq!(found("urdf/arm.urdf", &links), [""; 0]);
    // One of this name, of a robot of this name, in MoveIt's package of another one: its links are others, or this robot's
    // package has its own.
    let namesake = "all_moveit_config/config/arm.srdf";
    assert_eq!(found("urdf/arm.urdf", &[(namesake, &other)]), [""; 0]);
    assert_eq!(found("urdf/arm.urdf", &[own, (namesake, &srdf("arm"))]), ["../config/arm.srdf"]);
    // A broken one of a name that is not this URDF's.
    let broken = [own, ("config/leg.srdf", "<robot name=\"leg\">")];
    assert_eq!(found("urdf/arm.urdf", &broken), ["../config/arm.srdf"]);
    // One that a URDF beside this one has the name of, though both call their robot the same.
    let variant = [("config/small.srdf", &*srdf("arm")), ("urdf/small.urdf", ARM)];
    assert_eq!(found("urdf/arm.urdf", &variant), [""; 0]);
    // One beside two URDFs, with another robot's name: only the robot's name says whose it is.
    let (beside, own) = (("urdf/leg.urdf", ARM), ("config/all.srdf", &*srdf("arm")));
    assert_eq!(found("urdf/arm.urdf", &[("config/all.srdf", &srdf("all")), beside]), [""; 0]);
    assert_eq!(found("urdf/arm.urdf", &[own, beside]), ["../config/all.srdf"]);
    // Several, none of this name: whose they are is not known.
    let several = [("config/a.srdf", &*srdf("arm")), ("config/b.srdf", &*srdf("arm"))];
    assert_eq!(found("urdf/arm.urdf", &several), [""; 0]);
    // One of the URDF's name, for the robot that another URDF beside it is named after.
    let variant = [("urdf/arm.srdf", &*srdf("arm_gripper")), ("urdf/arm_gripper.urdf.xacro", ARM)];
    assert_eq!(found("urdf/arm.urdf", &variant), [""; 0]);
    // One of the URDF's name, whose links are another robot's.
    assert_eq!(found("urdf/arm.urdf", &[("config/arm.srdf", OTHER)]), [""; 0]);
}

#[test]
fn another_name_in_the_robots_own_srdf_is_said() {
    // LNT045 for the link, LNT063 for the name.
    for file in ["config/arm.srdf", "config/all.srdf"] {
        let seen = format!("../{file}");
        assert_eq!(found("urdf/arm.urdf", &[(file, &srdf("leg"))]), [&*seen, &*seen], "{file}");
    }
}
