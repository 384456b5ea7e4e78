//! Texts that nobody wrote on purpose.

use serde_json::{Value, json};
use testkit::trials::sample;

use crate::client::{ARM, Client, position, robot_folder};

const SMALL: &str = "<?xml version=\"1.0\"?>\r\n<robot name=\"\u{1F916}\"><!-- c -->\r\n\
    <link name=\"a\"><visual><origin rpy='0 0 1'/><geometry><mesh filename=\"m.stl\"/></geometry>\
    <material name=\"&amp;\"/></visual></link>\r\n<link name='b'/>\r\n\
    <joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 2\"/>\
    <limit effort='1' velocity='1' lower='-1' upper='1'/><mimic joint=\"j\"/></joint>\r\n\
    <transmission name='t'><joint name='j'/></transmission></robot>";

/// Asks everything about a place, and takes what comes.
fn ask_all(client: &mut Client, uri: &str, text: &str, offset: usize) {
    let at = json!({"textDocument": {"uri": uri}, "position": position(text, offset)});
    for method in ["hover", "definition", "completion"] {
        client.request(&format!("textDocument/{method}"), at.clone());
    }
    client.request("textDocument/documentSymbol", json!({"textDocument": {"uri": uri}}));
}

#[test]
fn every_beginning_and_every_text_without_a_character_is_answered() {
    let mut client = Client::new();
    let mut version = 1;
    for uri in ["untitled:a", "file:///nowhere/a.xacro"] {
        client.open(uri, SMALL);
        // A fifth of them, and all in `.ci/run`.
        for (at, c) in sample(SMALL.char_indices(), 5) {
            let behind = at + c.len_utf8();
            let without = format!("{}{}", &SMALL[..at], &SMALL[behind..]);
            for (text, offset) in [(&SMALL[..behind], behind), (&without, at)] {
                version += 1;
                client.change(uri, version, text);
                ask_all(&mut client, uri, text, offset);
            }
        }
        version += 1;
        client.change(uri, version, SMALL);
        client.until(version, |_| true);
    }
}

#[test]
fn texts_that_are_no_robots_are_answered() {
    let mut client = Client::new();
    let deep = "<a>".repeat(100_000);
    let long = format!("<robot name='{}'>", "x".repeat(1_000_000));
    let attributes = format!("<robot {}>", "a='' ".repeat(100_000));
    let texts = [
        "",
        "\u{feff}",
        "\0",
        "<",
        "&",
        "<robot",
        "]]>",
        "<!DOCTYPE r [<!ENTITY a 'b'>]><robot/>",
        &deep,
        &long,
        &attributes,
    ];
    client.open("untitled:a", "");
    for (version, text) in (2..).zip(texts) {
        client.change("untitled:a", version, text);
        ask_all(&mut client, "untitled:a", text, text.len());
        let found = client.until(version, |_| true);
        assert!(!found.is_empty(), "{:?}", text.chars().take(30).collect::<String>());
    }
}

#[test]
fn a_large_text_is_said_to_be_too_large() {
    let mut client = Client::new();
    let text = format!("<robot name='r'>{}</robot>", " ".repeat(64 << 20));
    client.open("untitled:a", &text);
    let found = client.until(1, |found| !found.is_empty());
    let message = found[0]["message"].as_str().unwrap();
    assert!(message.contains("too large for the editor: 64 MiB, at most 16 MiB"), "{message}");
    let start = json!({"line": 0, "character": 3});
    let at = json!({"textDocument": {"uri": "untitled:a"}, "position": start});
    assert_eq!(client.request("textDocument/hover", at.clone()), Value::Null);
    assert_eq!(client.request("textDocument/completion", at), json!([]));
    // A change makes it small enough.
    let end = json!({"line": 0, "character": (64 << 20) + 10});
    let range = json!({"start": {"line": 0, "character": 16}, "end": end});
    client.edit("untitled:a", 2, json!([{"range": range, "text": ""}]));
    let found = client.until(2, |_| true);
    assert!(
        found.iter().all(|one| !one["message"].as_str().unwrap().contains("too large")),
        "{found:#?}"
    );
}

/// What the first message of a text says, and its outline.
fn opened(text: &str) -> (String, Value) {
    let mut client = Client::new();
    client.open("untitled:a", text);
    let found = client.until(1, |found| !found.is_empty());
    let document = json!({"textDocument": {"uri": "untitled:a"}});
    let symbols = client.request("textDocument/documentSymbol", document);
    (found[0]["message"].as_str().unwrap().to_owned(), symbols)
}

#[test]
fn a_text_of_very_many_elements_is_said_to_be_too_large() {
    let text = |part: &str, count: usize| format!("<robot name='r'>{}</robot>", part.repeat(count));
    for (part, count, words) in [
        ("<link name='l'/>", 300_000, "300001 elements, at most 100000"),
        ("<a/>", 100_000, "100001 elements, at most 100000"),
        ("<link name='l'/>", 20_001, "20001 links and joints, at most 20000"),
    ] {
        let (message, symbols) = opened(&text(part, count));
        let expected = format!("too large for the editor: {words}; `urdd lint` examines it");
        assert!(message.contains(&expected), "{message}");
        assert_eq!(symbols, Value::Null);
    }
    let (message, symbols) = opened(&text("<link name='l'/>", 20_000));
    assert!(!message.contains("too large"), "{message}");
    assert_eq!(symbols.as_array().map(Vec::len), Some(20_000));
}

#[test]
fn many_findings_are_cut_with_a_word() {
    let joint = |index: usize| {
        format!(
            "<link name='l{index}'/><joint name='j{index}' type='prismatic'><parent link='b'/><child link='l{index}'/><axis xyz='0 0 2'/></joint>\n"
        )
    };
    let joints: String = (0..1500).map(joint).collect();
    let mut client = Client::new();
    client.open("untitled:a", &format!("<robot name='r'><link name='b'/>{joints}</robot>"));
    let found = client.until(1, |found| !found.is_empty());
    assert_eq!(found.len(), 1000);
    assert!(found[999]["message"].as_str().unwrap().contains("more findings are not shown"));
}

#[test]
fn a_file_in_a_folder_that_is_not_there_is_a_robot_without_meshes() {
    let (folder, _, uri) = robot_folder();
    let mut client = Client::new();
    let hover = |client: &mut Client, uri: &str| {
        let hover = client.at("textDocument/hover", uri, ARM, "<link name=\"upper", 14);
        hover["contents"]["value"].to_string()
    };
    for gone in ["file:///nowhere/arm.urdf", "file:///c%3A/my%20robots/arm.urdf"] {
        client.open(gone, ARM);
        client.published.clear();
        client.with_code(1, "LNT002");
        assert!(hover(&mut client, gone).contains("mass: 2.5 kg"));
    }
    client.open(&uri, ARM);
    client.published.clear();
    client.with_code(1, "LNT002");
    drop(folder);
    client.published.clear();
    client.change(&uri, 2, ARM);
    client.save(&uri);
    client.with_code(2, "LNT002");
    assert!(hover(&mut client, &uri).contains("mass: 2.5 kg"));
}
