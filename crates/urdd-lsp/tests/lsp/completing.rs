use serde_json::{Value, json};

use crate::client::{ARM, Client, covered, position};

const URI: &str = "untitled:Untitled-1";

/// The labels at `|`, and what is replaced.
fn labels(client: &mut Client, version: i32, text: &str) -> (Vec<String>, String, Vec<Value>) {
    let offset = text.find('|').expect("a cursor");
    let text = text.replacen('|', "", 1);
    client.change(URI, version, &text);
    let params = json!({"textDocument": {"uri": URI}, "position": position(&text, offset)});
    let items = client.request("textDocument/completion", params);
    let items = items.as_array().unwrap().clone();
    let labels = items.iter().map(|item| item["label"].as_str().unwrap().to_owned()).collect();
    let replaced = items.first().map(|item| covered(&text, &item["textEdit"]["range"]));
    (labels, replaced.unwrap_or_default(), items)
}

#[test]
fn names_elements_and_attributes_are_offered_where_they_fit() {
    let mut client = Client::new();
    client.open(URI, ARM);
    let arm = |what: &str, with: &str| {
        assert!(ARM.contains(what), "{what}");
        ARM.replacen(what, with, 1)
    };
    let joints = ["shoulder", "elbow"];
    let links = ["base", "upper", "lower"];
    let cases: Vec<(String, Vec<&str>, &str)> = vec![
        (arm("parent link=\"base\"", "parent link=\"ba|\""), links.to_vec(), "ba"),
        (arm("<parent link=\"base\"/>", "<parent link=\"|"), links.to_vec(), ""),
        // A joint does not follow itself.
        (arm("mimic joint=\"shoulder\"", "mimic joint=\"|\""), vec!["shoulder"], ""),
        (
            arm("</robot>", "<gazebo reference=\"|\"></robot>"),
            [&links[..], &joints[..]].concat(),
            "",
        ),
        (
            arm("</robot>", "<transmission name='t'><joint name=\"s|\"/></transmission></robot>"),
            joints.to_vec(),
            "s",
        ),
        // URDF+.
        (
            arm("</robot>", "<loop name='l'><successor link=\"|\"/></loop></robot>"),
            links.to_vec(),
            "",
        ),
        (
            arm("</robot>", "<loop name='l' type=\"|\"/></robot>"),
            vec![
                "fixed",
                "revolute",
                "prismatic",
                "cylindrical",
                "universal",
                "spherical",
                "planar",
            ],
            "",
        ),
        (arm("      <material name=\"grey\"", "      <material name=\"gr|\""), vec!["grey"], "gr"),
        (
            arm("type=\"prismatic\"", "type=\"pris|matic\""),
            vec!["revolute", "continuous", "prismatic", "fixed", "floating", "planar", "spherical"],
            "prismatic",
        ),
        (arm("<link name=\"lower\"/>", "<link name=\"|lower\"/>"), vec![], ""),
        (
            arm("<axis xyz=\"0 0 2\"/>", "<|"),
            vec![
                "origin",
                "parent",
                "child",
                "axis",
                "limit",
                "dynamics",
                "mimic",
                "safety_controller",
                "calibration",
            ],
            "",
        ),
        (
            arm("<axis xyz=\"0 0 2\"/>", "<li|"),
            vec![
                "origin",
                "parent",
                "child",
                "axis",
                "limit",
                "dynamics",
                "mimic",
                "safety_controller",
                "calibration",
            ],
            "li",
        ),
        (arm("<box size=\"0.2 0.2 0.2\"/>", "<cylinder radius=\"1\" |/>"), vec!["length"], ""),
        (
            arm("velocity=\"2\"", "vel|"),
            vec!["velocity", "acceleration", "deceleration", "jerk"],
            "vel",
        ),
        (arm("<link name=\"lower\"/>", "<link |/>"), vec!["name"], ""),
        (arm("<robot name=\"arm\">", "<robot name=\"arm\" |>"), vec!["version", "xmlns:xacro"], ""),
        (
            arm("</robot>", "<transmission name='t'><|</transmission></robot>"),
            vec!["type", "joint", "actuator"],
            "",
        ),
        (
            arm(
                "</robot>",
                "<ros2_control name='c'><joint name='elbow'><|</joint></ros2_control></robot>",
            ),
            vec!["command_interface", "state_interface", "param"],
            "",
        ),
        (arm("</collision>", "</|"), vec!["collision"], ""),
        (arm("<color", "<!-- | --><color"), vec![], ""),
    ];
    for (version, (text, expected, replaced)) in (2..).zip(&cases) {
        let (labels, covered, _) = labels(&mut client, version, text);
        assert_eq!(&labels, expected, "{text}");
        assert_eq!(&covered, replaced, "{text}");
    }
}

#[test]
fn names_are_escaped_where_they_are_written() {
    let mut client = Client::new();
    let text =
        "<robot name='r'><link name='a &amp; \"b\"'/><joint><parent link=\"|\"/></joint></robot>";
    client.open(URI, text);
    let (labels, _, items) = labels(&mut client, 2, text);
    assert_eq!(labels, ["a & \"b\""]);
    assert_eq!(items[0]["textEdit"]["newText"], "a &amp; &quot;b&quot;");
}
