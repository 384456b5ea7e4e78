//! Names in elements that URDF does not define.

use urdd_generate::combine::Note;

use crate::combine::support::{core, put_together};

const GRIPPER: &str = r#"<?xml version="1.0"?>
<robot name="g" xmlns:drake="http://drake.mit.edu">
  <material name="steel"><color rgba="0.5 0.5 0.5 1"/></material>
  <link name="hand"><visual><geometry><box size="1 1 1"/></geometry><material name="steel"/></visual></link>
  <link name="tip"/>
  <link name="other"/>
  <joint name="slide" type="prismatic">
    <parent link="hand"/><child link="tip"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="shadow" type="prismatic">
    <parent link="hand"/><child link="other"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
    <mimic joint="slide" multiplier="2" offset="-1"/>
  </joint>
  <transmission name="drive">
    <type>transmission_interface/SimpleTransmission</type>
    <joint name="slide"><hardwareInterface>EffortJointInterface</hardwareInterface></joint>
    <actuator name="motor"/>
  </transmission>
  <ros2_control name="system" type="system">
    <hardware><plugin>x</plugin></hardware>
    <joint name="slide"><command_interface name="position"/></joint>
    <joint name="shadow"><param name="mimic"> slide </param></joint>
    <sensor name="force"/>
  </ros2_control>
  <gazebo reference="tip"><material>Gazebo/Grey</material></gazebo>
  <gazebo>
    <plugin name="p"><bodyName>tip</bodyName><handName>hand</handName><topic on="tip">x</topic></plugin>
  </gazebo>
  <drake:collision_filter_group name="fingers"><drake:member link="tip"/></drake:collision_filter_group>
</robot>
"#;

fn composed(more: &str) -> (String, Vec<Note>) {
    let folder = testkit::temporary::folder();
    std::fs::write(folder.path().join("g.urdf"), GRIPPER).expect("a file");
    let recipe = format!(
        "[base]\nlink = \"world\"\n[[part]]\nid = \"g\"\nsource = \"g.urdf\"\nprefix = \"l/\"\n{more}\n"
    );
    let (made, target) = put_together(&recipe, folder.path(), &core()).expect("a robot");
    let text = std::fs::read_to_string(target.join("cell.urdf")).expect("the URDF");
    (text, made.notes)
}

/// The places and names that were left unchanged.
fn left_alone(notes: &[Note]) -> Vec<(&str, &str)> {
    let left = notes.iter().filter(|note| note.kind == "left-alone");
    let quoted = left.map(|note| {
        let mut quoted = note.text.split('`').skip(1).step_by(2);
        (quoted.next().unwrap_or(""), quoted.next().unwrap_or(""))
    });
    quoted.collect()
}

#[test]
fn names_get_the_prefix_wherever_they_are_known_to_stand() {
    let (text, notes) = composed("");
    for line in [
        "<material name=\"l/steel\"><color",
        "<material name=\"l/steel\"/></visual>",
        "<parent link=\"l/hand\"/><child link=\"l/tip\"/>",
        "<mimic joint=\"l/slide\" multiplier=\"2\" offset=\"-1\"/>",
        "<transmission name=\"l/drive\">",
        "<joint name=\"l/slide\"><hardwareInterface>",
        "<actuator name=\"l/motor\"/>",
        "<ros2_control name=\"l/system\" type=\"system\">",
        "<param name=\"mimic\">l/slide</param>",
        "<sensor name=\"l/force\"/>",
        "<gazebo reference=\"l/tip\">",
        "<bodyName>l/tip</bodyName>",
        "<drake:member link=\"l/tip\"/>",
        "xmlns:drake=\"http://drake.mit.edu\"",
        "<handName>hand</handName>",
        "<material>Gazebo/Grey</material>",
        "<parent link=\"world\"/>\n    <child link=\"l/hand\"/>",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    // A message names what is left unchanged, and what to write.
    assert_eq!(left_alone(&notes), [("handName", "hand"), ("topic@on", "tip")]);
    assert!(notes[0].to_string().contains("names = [\"handName\"]"), "{}", notes[0]);
}

#[test]
fn a_recipe_says_what_else_names_links() {
    let (text, notes) = composed("names = [\"handName\", \"topic@on\"]");
    assert!(
        text.contains("<handName>l/hand</handName>") && text.contains("<topic on=\"l/tip\">"),
        "{text}"
    );
    assert_eq!(left_alone(&notes), []);
}

#[test]
fn what_is_dropped_takes_along_what_names_it() {
    let (text, notes) = composed("drop = [\"tip\", \"other\"]");
    for gone in ["l/tip", "l/slide", "transmission", "<gazebo reference", "bodyName", "l/other"] {
        assert!(!text.contains(gone), "{gone}\n{text}");
    }
    // Only the joints of it.
    assert!(text.contains("ros2_control") && text.contains("l/force"), "{text}");
    let gone = notes.iter().filter(|note| note.kind == "gone").count();
    assert_eq!(gone, 6, "{notes:?}");
}

#[test]
fn a_follower_of_a_frozen_joint_is_frozen_too() {
    let (text, notes) = composed("freeze = { slide = 0.75 }");
    // 2 * 0.75 - 1 along y.
    assert!(text.contains("<origin xyz=\"0.75 0 0\" rpy=\"0 0 0\"/>"), "{text}");
    assert!(text.contains("<origin xyz=\"0 0.5 0\" rpy=\"0 0 0\"/>"), "{text}");
    assert!(
        !text.contains("<mimic") && !text.contains("prismatic") && !text.contains("<limit"),
        "{text}"
    );
    assert!(!text.contains("transmission"), "{text}");
    assert!(notes.iter().any(|note| note.kind == "following"), "{notes:?}");
}

#[test]
fn prefixes_of_xml_that_stand_for_two_things_are_refused() {
    let folder = testkit::temporary::folder();
    std::fs::write(folder.path().join("g.urdf"), GRIPPER).expect("a file");
    let other = GRIPPER.replace("http://drake.mit.edu", "http://else.where");
    std::fs::write(folder.path().join("h.urdf"), other).expect("a file");
    let recipe = "[[part]]\nid = \"g\"\nsource = \"g.urdf\"\n[[part]]\nid = \"h\"\nsource = \"h.urdf\"\nattach = { to = \"g/tip\" }";
    let error = put_together(recipe, folder.path(), &core()).expect_err("two meanings");
    let words = error.to_string();
    assert!(
        words.contains("cell.toml:5:6: the XML prefix `drake` means `http://drake.mit.edu`"),
        "{words}"
    );
}

#[test]
fn materials_of_one_name_look_alike() {
    let folder = testkit::temporary::folder();
    std::fs::write(folder.path().join("g.urdf"), GRIPPER).expect("a file");
    let other = GRIPPER
        .replace("0.5 0.5 0.5 1", "0 0 0 1")
        .replace("\"hand\"", "\"hand2\"")
        .replace("\"tip\"", "\"tip2\"")
        .replace("\"other\"", "\"other2\"")
        .replace("\"slide\"", "\"slide2\"")
        .replace("\"shadow\"", "\"shadow2\"");
    let recipe = "[[part]]\nid = \"g\"\nsource = \"g.urdf\"\nprefix = \"\"\n[[part]]\nid = \"h\"\nsource = \"h.urdf\"\nprefix = \"\"\nattach = { to = \"g/tip\" }";
    std::fs::write(folder.path().join("h.urdf"), &other).expect("a file");
    let error = put_together(recipe, folder.path(), &core()).expect_err("two looks");
    let words = error.to_string();
    assert!(
        words.contains(
            "the material `steel` comes from part `g` and from part `h`, where it looks different"
        ),
        "{words}"
    );
    // Equal elements appear once.
    let alike = other.replace("0 0 0 1", "0.5 0.5 0.5 1").replace("name=\"drive\"", "name=\"d2\"");
    let alike =
        alike.replace("name=\"system\"", "name=\"s2\"").replace("name=\"motor\"", "name=\"m2\"");
    std::fs::write(folder.path().join("h.urdf"), alike).expect("a file");
    let (_, target) = put_together(recipe, folder.path(), &core()).expect("a robot");
    let text = std::fs::read_to_string(target.join("cell.urdf")).expect("the URDF");
    assert_eq!(text.matches("<material name=\"steel\"><color").count(), 1, "{text}");
}

#[test]
fn textures_of_materials_are_not_carried_and_that_is_said() {
    let folder = testkit::temporary::folder();
    let urdf = r#"<robot name="t">
  <material name="wood"><texture filename="textures/wood.png"/></material>
  <link name="a"><visual><geometry><box size="1 1 1"/></geometry>
    <material name="own"><texture filename="package://t/own.png"/></material></visual></link>
  <link name="b"><visual><geometry><box size="1 1 1"/></geometry>
    <material name="gone"><texture filename="gone.png"/></material></visual></link>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
</robot>"#;
    std::fs::write(folder.path().join("t.urdf"), urdf).expect("a file");
    let recipe = "[[part]]\nid = \"t\"\nsource = \"t.urdf\"\ndrop = [\"b\"]\n";
    let (made, target) = put_together(recipe, folder.path(), &core()).expect("a robot");
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    let texture = |name: &str| {
        format!(
            "part `t`: texture `{name}` of a material is not carried; its name is unchanged, and the file stays where it is"
        )
    };
    // Each by its name, except that of the dropped link.
    assert_eq!(notes, [texture("package://t/own.png"), texture("textures/wood.png")]);
    let text = std::fs::read_to_string(target.join("cell.urdf")).expect("the URDF");
    assert!(text.contains("<texture filename=\"textures/wood.png\"/>"));
}
