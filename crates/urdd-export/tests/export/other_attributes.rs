//! What a URDF has in places where URDF defines nothing: kept in a URDF, or listed as lost.

use urdd_export::{Export, Format};

use crate::made::{exported, robot};

const URDF: &str = r#"<robot name="r" maker="me &amp; you"><link name="a" type="base"><inertial density="3"><mass value="1" unit="kg"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<visual name="skin"><geometry><box size="1 1 1"/></geometry></visual>
<collision name="bumper" concave="yes"><geometry><box size="1 1 1"/></geometry><surface><friction/></surface></collision></link><link name="b"/>
<joint name="j" type="revolute" dont_collapse="true"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1" k_velocity="4"/><dynamics damping="1" armature="0.5"/></joint>
<mujoco><compiler meshdir="../meshes" balanceinertia="true"/></mujoco></robot>"#;

fn listed(made: &Export, key: &str, what: &str) -> Option<u64> {
    let report: serde_json::Value = serde_json::from_str(&made.report).expect("JSON");
    let entries = report[key].as_array().expect("a list").clone();
    entries.iter().find(|entry| entry["what"] == what).and_then(|entry| entry["count"].as_u64())
}

#[test]
fn attributes_and_names_are_kept_or_listed_as_lost() {
    let (_folder, robot) = robot(URDF);
    for format in [Format::Urdf, Format::Drake, Format::Spherized, Format::Moveit] {
        let made = exported(&robot, format);
        let text = match format {
            Format::Moveit => {
                let file =
                    made.files.iter().find(|(path, _)| path.ends_with(".urdf")).expect("a URDF");
                String::from_utf8(file.1.clone()).expect("UTF-8")
            }
            _ => made.text.clone(),
        };
        let document = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("XML");
        let of = |tag: &str, key: &str| {
            let mut nodes = document.descendants().filter(|node| node.has_tag_name(tag));
            nodes.find_map(|node| node.attribute(key)).map(str::to_owned)
        };
        for (tag, key, value) in [
            ("robot", "maker", "me & you"),
            ("link", "type", "base"),
            ("inertial", "density", "3"),
            ("mass", "unit", "kg"),
            ("joint", "dont_collapse", "true"),
            ("limit", "k_velocity", "4"),
            ("dynamics", "armature", "0.5"),
            ("visual", "name", "skin"),
            ("collision", "name", "bumper"),
            ("compiler", "balanceinertia", "true"),
            ("compiler", "strippath", "false"),
        ] {
            assert_eq!(of(tag, key).as_deref(), Some(value), "{format:?} {tag} {key}");
        }
        assert_eq!((of("collision", "concave"), of("compiler", "meshdir")), (None, None));
        let outside = "attributes that URDF does not define, outside of shapes and materials";
        let inside = "what URDF does not define in shapes, materials, limits and the like";
        assert_eq!(listed(&made, "carried", outside), Some(7), "{format:?}");
        assert_eq!(listed(&made, "lost", inside), Some(2), "{format:?}");
        assert_eq!(listed(&made, "otherwise", "names of visual and collision elements"), Some(2));
    }
    let made = exported(&robot, Format::Mjcf);
    assert_eq!(listed(&made, "lost", "names of visual and collision elements"), Some(2));
    assert!(made.text.contains("names of visual and collision elements (2)"));
}
