//! What `<gazebo>` elements of a source have that libsdformat 12.3 or Drake 1.51 refuse in an SDF: each case here was
//! loaded by both, and was refused by one of them before it was mended.

use urdd_export::{Export, Format};

use crate::made::{exported, robot, urdf};

const PARTS: &str = r#"<link name="base"><collision><geometry><box size="1 1 1"/></geometry></collision></link><link name="tip"/>
<joint name="j" type="revolute"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>"#;

fn sdf(gazebo: &str) -> Export {
    let (_folder, robot) = robot(&urdf(&format!("{PARTS}{gazebo}")));
    exported(&robot, Format::Sdf)
}

fn notes(made: &Export) -> String {
    made.notes.iter().map(|note| format!("{note}\n")).collect()
}

/// The values of attributes `name` outside of plugins, and whether a `<pose>` has a `frame`.
fn outside_of_plugins(made: &Export) -> (Vec<String>, bool) {
    let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("XML");
    let mut outside = document.descendants().filter(|node| {
        !node.ancestors().skip(1).any(|above| above.has_tag_name("plugin"))
            && !node.has_tag_name("plugin")
    });
    let names = outside.clone().filter_map(|node| node.attribute("name")).map(str::to_owned);
    let names = names.collect();
    (names, outside.any(|node| node.has_tag_name("pose") && node.attribute("frame").is_some()))
}

#[test]
fn names_with_a_delimiter_are_not_written() {
    let made = sdf(r#"<gazebo reference="base">
        <sensor name="a::imu" type="imu"><driver name="lib::Driver"/><other name="lib::Other">text</other><topic>a::b</topic></sensor>
        <sensor name="c" type="camera"><camera name="x::y"><horizontal_fov>1</horizontal_fov></camera></sensor>
        <light name="::lamp" type="point"/></gazebo>
        <gazebo reference="j"><physics><x name="p::q"/></physics></gazebo>
        <gazebo><gripper name="g::h"><palm_link>base</palm_link></gripper>
        <plugin name="p::q" filename="lib::x"><inner name="kept::here"/></plugin></gazebo>"#);
    let (names, _) = outside_of_plugins(&made);
    assert!(names.iter().all(|name| !name.contains("::")), "{names:?}");
    for kept in ["a__imu", "c", "x__y", "__lamp", "g__h"] {
        assert!(names.iter().any(|name| name == kept), "{kept}: {names:?}");
    }
    assert!(!made.text.contains("lib::Driver") && !made.text.contains("lib::Other"));
    assert!(made.text.contains("kept::here") && made.text.contains("<topic>a::b</topic>"));
    let said = notes(&made);
    assert!(said.contains("have `__` instead") && said.contains("are left out"), "{said}");
}

#[test]
fn plugins_are_where_sdf_has_them() {
    let made = sdf(
        r#"<gazebo reference="base"><plugin name="of_link" filename="a"><x>1</x></plugin>
        <collision><plugin name="of_collision" filename="b"/></collision>
        <sensor name="s" type="imu"><plugin name="of_sensor" filename="c"/></sensor></gazebo>
        <gazebo reference="j"><plugin name="of_joint" filename="d"/></gazebo>
        <gazebo><plugin name="of_model" filename="e"/><plugin name="no_file"/><plugin filename="no_name"/></gazebo>"#,
    );
    let document = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("XML");
    let plugins = document.descendants().filter(|node| node.has_tag_name("plugin"));
    let mut found: Vec<(String, String)> = plugins
        .map(|node| {
            let parent = node.parent().expect("a parent").tag_name().name().to_owned();
            (node.attribute("name").unwrap_or_default().to_owned(), parent)
        })
        .collect();
    found.sort();
    let expected = ["of_collision", "of_joint", "of_link", "of_model", "of_sensor"];
    let expected = expected.map(|name| {
        let parent = if name == "of_sensor" { "sensor" } else { "model" };
        (name.to_owned(), parent.to_owned())
    });
    assert_eq!(found, expected);
    assert!(made.text.contains("<x>1</x>"));
    let said = notes(&made);
    assert!(said.contains("are plugins of the model"), "{said}");
    assert!(said.contains("`<plugin>` is left out: SDF needs its name and its file"), "{said}");
}

#[test]
fn poses_are_those_of_sdf() {
    let made = sdf(r#"<gazebo reference="base">
        <sensor name="a" type="imu"><pose frame="">0 0 0.25 0 0 0</pose></sensor>
        <sensor name="b" type="imu"><pose frame="tip">0 0 0.5 0 0 0</pose></sensor>
        <sensor name="c" type="imu"><pose>0 0 0.75</pose></sensor>
        <sensor name="d" type="imu"><pose rotation_format="quat_xyzw">0 0 0.125 0 0 0 1</pose></sensor>
        <sensor name="e" type="imu"><pose frame=" "/></sensor>
        <light name="l" type="point"><pose frame="">0 0 0.375 0 0 0</pose></light></gazebo>"#);
    assert!(!outside_of_plugins(&made).1, "{}", made.text);
    for kept in ["0 0 0.25 0 0 0", "0 0 0.5 0 0 0", "0 0 0.125 0 0 0 1", "0 0 0.375 0 0 0"] {
        assert!(made.text.contains(kept), "{kept}");
    }
    assert!(!made.text.contains("0 0 0.75"));
    let said = notes(&made);
    assert!(
        said.contains("`frame` of a `<pose>`") && said.contains("SDF needs 6 numbers"),
        "{said}"
    );
    // An empty one says nothing.
    let made = sdf(
        r#"<gazebo reference="base"><sensor name="a" type="imu"><pose frame="">0 0 1 0 0 0</pose></sensor></gazebo>"#,
    );
    assert!(!notes(&made).contains("frame"));
}

#[test]
fn elements_without_a_name_of_their_own_are_left_out() {
    let made = sdf(
        r#"<gazebo reference="base"><sensor type="imu"/><sensor name="" type="imu"/><sensor name="__s__" type="imu"/>
        <sensor name="world" type="imu"/><sensor name="typeless"/><light name=" " type="point"/><sensor name="whole" type="imu"/></gazebo>"#,
    );
    assert_eq!(made.text.matches("<sensor ").count(), 1, "{}", made.text);
    assert!(!made.text.contains("<light "));
    let said = notes(&made);
    assert!(
        said.contains("SDF needs its type") && said.contains("neither empty nor `world`"),
        "{said}"
    );
}
