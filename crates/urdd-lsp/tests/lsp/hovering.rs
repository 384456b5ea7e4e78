use serde_json::Value;

use crate::client::{ARM, Client, covered, robot_folder};

fn shown(hover: &Value) -> &str {
    hover["contents"]["value"].as_str().unwrap_or_default()
}

#[test]
fn a_link_has_its_pose_mass_and_children() {
    let (_folder, _, uri) = robot_folder();
    let mut client = Client::new();
    client.open(&uri, ARM);
    let hover = client.at("textDocument/hover", &uri, ARM, "link=\"upper\"", 7);
    assert_eq!(covered(ARM, &hover["range"]), "upper");
    let text = shown(&hover);
    for part in [
        "**link `upper`**",
        "mass: 2.5 kg",
        "pose in `base`, default configuration: xyz 0 0 1 m, rpy 0 0 0.5 rad",
        "moved by joint `shoulder` (prismatic), on link `base`",
        "children: `lower`",
        "0 visual, 1 collision",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    // The elbow follows the shoulder, and is at its offset.
    let hover = client.at("textDocument/hover", &uri, ARM, "link name=\"lower\"", 1);
    let text = shown(&hover);
    assert!(text.contains("1.1 m, rpy 0 0 0.5 rad"), "{text}");
    assert!(text.contains("mass: none") && text.contains("children: none"), "{text}");
}

#[test]
fn a_joint_has_its_limits_in_both_units() {
    let mut client = Client::new();
    let uri = "untitled:Untitled-1";
    let arm = &ARM.replace("prismatic", "revolute");
    client.open(uri, arm);
    let hover = client.at("textDocument/hover", uri, arm, "mimic joint", 9);
    let text = shown(&hover);
    for part in [
        "**joint `shoulder`**: revolute",
        "`base` → `upper`",
        "axis: 0 0 2",
        "limits: -1 to 1.5 rad (-57.296° to 85.944°)",
        "velocity: 2 rad/s (114.59°/s)",
        "effort: 10 N m",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let hover = client.at("textDocument/hover", uri, arm, "name=\"elbow\"", 8);
    assert!(
        shown(&hover).contains("mimics `shoulder`: position = 2 × its position + 0.1"),
        "{hover:#?}"
    );
}

#[test]
fn a_mesh_has_its_file_and_its_extent_as_scaled() {
    let (_folder, path, uri) = robot_folder();
    let mut client = Client::new();
    client.open(&uri, ARM);
    let hover = client.at("textDocument/hover", &uri, ARM, "meshes/part.stl", 3);
    let text = shown(&hover);
    for part in [
        "part.stl`",
        "bytes",
        "triangles: 4",
        "bounding box: 1 × 1 × 1 m, from (0 0 0) to (1 1 1)",
        "scale: 0.001",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    std::fs::remove_file(path.with_file_name("meshes").join("part.stl")).unwrap();
    client.change(&uri, 2, ARM);
    let hover = client.at("textDocument/hover", &uri, ARM, "meshes/part.stl", 3);
    assert!(shown(&hover).contains("Not found: tried "), "{hover:#?}");
}

/// A robot whose safety controller lacks `k_velocity`: urdfdom refuses it, and with it ROS, Gazebo and Pinocchio; MuJoCo
/// does not read the element, and refuses the link without mass.
fn without_k_velocity() -> String {
    let limit = "<limit lower=\"-1\" upper=\"1.5\" effort=\"10\" velocity=\"2\"/>";
    ARM.replace(limit, &format!("{limit}\n    <safety_controller k_position=\"20\"/>"))
}

#[test]
fn the_robot_has_a_line_for_what_programs_do_with_it() {
    let (_folder, path, uri) = robot_folder();
    let settings = path.with_file_name("urdd.toml");
    let text = without_k_velocity();
    let mut client = Client::new();
    client.open(&uri, &text);
    let found = client.with_code(1, "LNT060");
    assert_eq!(covered(&text, &found[0]["range"]), "<safety_controller k_position=\"20\"/>");
    let message = found[0]["message"].as_str().unwrap();
    assert!(message.contains("ROS, Gazebo and Pinocchio refuse the robot"), "{message}");

    let hover = client.at("textDocument/hover", &uri, &text, "robot name", 2);
    assert_eq!(covered(&text, &hover["range"]), "robot");
    let line = 1 + text[..text.find("<safety").unwrap()].matches('\n').count();
    let said = shown(&hover);
    let refused = format!("- ROS, Gazebo and Pinocchio refuse it (LNT060 at {line}:5)");
    let order = |refused: &str| {
        Some((
            said.find(refused)?,
            said.find("- Drake loads it without the safety controller of ")?,
        ))
    };
    assert!(order(&refused).is_some_and(|(first, second)| first < second), "{said}");
    // Elsewhere in the start tag, nothing is said.
    assert!(client.at("textDocument/hover", &uri, &text, "name=\"arm\"", 1).is_null());

    // What the settings name comes first.
    std::fs::write(&settings, "for = [\"mujoco\"]\n").unwrap();
    client.change(&uri, 2, &text);
    client.save(&uri);
    client
        .until(2, |found| found.iter().any(|one| one["code"] == "LNT060" && one["severity"] == 3));
    let hover = client.at("textDocument/hover", &uri, &text, "robot name", 2);
    let said = shown(&hover);
    assert!(said.starts_with("**In programs**\n\n- MuJoCo "), "{said}");
    assert!(said.contains(&refused), "{said}");

    // Mended, ROS loads it; the answer does not wait for the findings.
    let mended = text.replace("k_position", "k_velocity=\"1\" k_position");
    client.change(&uri, 3, &mended);
    let hover = client.at("textDocument/hover", &uri, &mended, "robot name", 2);
    let said = shown(&hover);
    assert!(said.contains("- MuJoCo refuses it (LNT006 at 22:3)"), "{said}");
    assert!(said.contains("- ROS and Isaac and Newton load it\n"), "{said}");
    // A text that is not XML is refused by all.
    let broken = mended.replace("</robot>", "");
    client.change(&uri, 4, &broken);
    let hover = client.at("textDocument/hover", &uri, &broken, "robot name", 2);
    assert!(shown(&hover).contains("ROS"), "{hover:#?}");
    assert!(!shown(&hover).contains("load"), "{hover:#?}");
}

#[test]
fn half_typed_text_still_answers() {
    let mut client = Client::new();
    let uri = "untitled:Untitled-1";
    client.open(uri, ARM);
    client.with_code(1, "LNT012");
    // The robot is that of the text before; places are those of the text as it is.
    let typed = ARM.replace("<link name=\"lower\"/>", "<link name=\"lower\"/>\n  <link name=\"ha");
    client.change(uri, 2, &typed);
    let hover = client.at("textDocument/hover", uri, &typed, "link=\"upper\"", 7);
    assert!(shown(&hover).contains("mass: 2.5 kg"), "{hover:#?}");
    let symbols = client
        .request("textDocument/documentSymbol", serde_json::json!({"textDocument": {"uri": uri}}));
    assert_eq!(symbols[0]["name"], "base", "{symbols:#?}");
    let at = client.at("textDocument/definition", uri, &typed, "child link=\"lower\"", 13);
    assert_eq!(covered(&typed, &at["range"]), "lower");
}
