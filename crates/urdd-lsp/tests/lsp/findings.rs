use serde_json::json;

use crate::client::{ARM, Client, able, covered, position, robot_folder};

#[test]
fn findings_have_code_severity_place_and_values() {
    let (_folder, _, uri) = robot_folder();
    let mut client = Client::new();
    client.open(&uri, ARM);
    let found = client.with_code(1, "LNT012");
    assert_eq!(found.len(), 1, "{found:#?}");
    assert_eq!(covered(ARM, &found[0]["range"]), "xyz=\"0 0 2\"");
    assert_eq!(found[0]["source"], "urdd");
    assert_eq!(found[0]["severity"], 2);
    assert!(found[0]["message"].as_str().unwrap().contains("joint `shoulder`"), "{found:#?}");
    let found = client.with_code(1, "LNT002");
    let message = found[0]["message"].as_str().unwrap();
    assert!(message.contains("\nfound: (9.0000, 0.0000, 0.0000)"), "{message}");
}

#[test]
fn each_place_of_a_folded_finding_is_one() {
    let text = ARM.replace("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 3\"/>");
    let mut client = Client::new();
    client.open("untitled:Untitled-1", &text);
    let found = client.with_code(1, "LNT012");
    let places: Vec<String> = found.iter().map(|one| covered(&text, &one["range"])).collect();
    assert_eq!(places.len(), 2, "{found:#?}");
    assert!(
        places.contains(&"xyz=\"0 0 2\"".to_owned())
            && places.contains(&"xyz=\"0 0 3\"".to_owned())
    );
}

#[test]
fn a_finding_about_shapes_stays_until_its_link_changes() {
    let (_folder, path, uri) = robot_folder();
    let mut client = Client::new();
    client.open(&uri, ARM);
    client.with_code(1, "LNT002");
    // Above the link, and in another element: it moves along.
    let above = ARM.replace("<color", "\n\n   <color").replace("velocity=\"2\"", "velocity=\"3\"");
    client.change(&uri, 2, &above);
    let found = client.with_code(2, "LNT002");
    assert_eq!(covered(&above, &found[0]["range"]), "<origin xyz=\"9 0 0\"/>");
    // In the link: gone, though the fault is still there.
    let inside = above.replace("value=\"2.5\"", "value=\"2.4\"");
    client.change(&uri, 3, &inside);
    client.until(3, |found| found.iter().all(|one| one["code"] != "LNT002"));
    std::fs::write(path, &inside).unwrap();
    client.save(&uri);
    client.with_code(3, "LNT002");
    // And after the fault is mended and saved, it is gone.
    let mended = inside.replace("xyz=\"9 0 0\"", "xyz=\"0 0 0\"");
    client.change(&uri, 4, &mended);
    client.save(&uri);
    client.until(4, |found| found.iter().all(|one| one["code"] != "LNT002"));
}

#[test]
fn changes_of_ranges_are_applied_in_order() {
    let mut client = Client::new();
    let uri = "untitled:Untitled-1";
    client.open(uri, ARM);
    client.with_code(1, "LNT012");
    let start = ARM.find("0 0 2").unwrap();
    let range = json!({"start": position(ARM, start), "end": position(ARM, start + 5)});
    let first = json!({"range": range, "text": "0 0 4\r\n\u{1F916}"});
    let end = json!({"line": range["start"]["line"].as_u64().unwrap() + 1, "character": 2});
    let at = json!({"start": {"line": range["start"]["line"], "character": range["start"]["character"].as_u64().unwrap() + 5}, "end": end});
    client.edit(uri, 2, json!([first, {"range": at, "text": ""}]));
    let found = client.with_code(2, "LNT012");
    let now = ARM.replace("0 0 2", "0 0 4");
    assert_eq!(covered(&now, &found[0]["range"]), "xyz=\"0 0 4\"");
}

#[test]
fn positions_are_in_the_agreed_unit() {
    let text = ARM
        .replace('\n', "\r\n")
        .replace("shoulder\" type", "\u{1F916}é\" type")
        .replace("<axis", "<!--\u{1F916}é--><axis");
    let text = text.replace("mimic joint=\"shoulder", "mimic joint=\"\u{1F916}é");
    let before = "    <!--\u{1F916}é--><axis ";
    let columns = [
        ("utf-8", before.len()),
        ("utf-16", before.encode_utf16().count()),
        ("utf-32", before.chars().count()),
    ];
    for (encoding, column) in columns {
        for mark in ["", "\u{feff}"] {
            let mut capabilities = able();
            capabilities["general"] = json!({"positionEncodings": ["utf-7", encoding]});
            let mut client = Client::with(json!({"debounce": 0}), capabilities);
            client.open("untitled:Untitled-1", &format!("{mark}{text}"));
            let found = client.with_code(1, "LNT012");
            assert_eq!(
                found[0]["range"]["start"],
                json!({"line": 26, "character": column}),
                "{encoding}"
            );
            assert_eq!(found[0]["range"]["end"], json!({"line": 26, "character": column + 11}));
        }
    }
}

#[test]
fn what_is_not_xml_says_where() {
    let mut client = Client::new();
    let uri = "untitled:Untitled-1";
    let broken = ARM.replace("</link>\n  <link name=\"upper\"", "</lin>\n  <link name=\"upper\"");
    client.open(uri, &broken);
    let found = client.until(1, |found| !found.is_empty());
    assert_eq!(found.len(), 1, "{found:#?}");
    assert_eq!(found[0]["severity"], 1);
    assert_eq!(found[0]["range"]["start"]["line"], 10, "{found:#?}");
    client.change(uri, 2, ARM);
    client.with_code(2, "LNT012");
    client.notify("textDocument/didClose", json!({"textDocument": {"uri": uri}}));
    let begun = client.published.len();
    client.request(
        "textDocument/hover",
        json!({"textDocument": {"uri": uri}, "position": {"line": 0, "character": 0}}),
    );
    let last = client.published.last().unwrap();
    assert!(client.published.len() > begun || last["diagnostics"] == json!([]), "{last:#?}");
}

#[test]
fn the_text_says_what_a_file_is_before_its_name() {
    let mjcf = "<mujoco><worldbody/></mujoco>";
    for (uri, language) in [("file:///nowhere/m.urdf", "urdf"), ("file:///nowhere/m.xml", "xml")] {
        let mut client = Client::new();
        client.open_as(uri, language, mjcf);
        assert_eq!(client.until(1, |_| true), [] as [serde_json::Value; 0], "{uri}");
        // It becomes a URDF while it is written.
        client.change(uri, 2, ARM);
        client.with_code(2, "LNT012");
        client.change(uri, 3, mjcf);
        client.until(3, |found| found.is_empty());
    }
}
