use serde_json::json;

use crate::client::{Client, able};

const XACRO: &str = "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'>\n\
    <xacro:property name='size' value='1'/>\n\
    <xacro:macro name='arm' params='prefix parent'>\n\
    <link name='${prefix}_upper'/>\n\
    </xacro:macro>\n\
    <link name='base'/>\n\
    <xacro:arm prefix='left' parent='base'/>\n\
    </robot>\n";

#[test]
fn without_leave_a_file_is_only_read_as_xml() {
    let mut client = Client::new();
    client.open("file:///nowhere/arm.urdf.xacro", XACRO);
    client.save("file:///nowhere/arm.urdf.xacro");
    assert!(client.until(1, |_| true).is_empty());
    let symbols = client.request(
        "textDocument/documentSymbol",
        json!({"textDocument": {"uri": "file:///nowhere/arm.urdf.xacro"}}),
    );
    let names: Vec<&str> = symbols
        .as_array()
        .unwrap()
        .iter()
        .map(|one| one["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["size", "arm", "${prefix}_upper", "base"]);
    client.change(
        "file:///nowhere/arm.urdf.xacro",
        2,
        &XACRO.replace("</xacro:macro>", ""),
    );
    let found = client.until(2, |found| !found.is_empty());
    assert!(
        found[0]["message"]
            .as_str()
            .unwrap()
            .starts_with("not well-formed XML: "),
        "{found:#?}"
    );
}

/// `xacro` of these tests: whether it is installed does not matter, only that it is started when it may be.
#[test]
fn with_leave_it_is_expanded_when_it_is_saved_and_not_before() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().canonicalize().unwrap().join("arm.xacro");
    std::fs::write(&path, "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'><xacro:include filename='none.xacro'/></robot>").unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let address = crate::client::uri(&path);
    let mut client = Client::with(json!({"debounce": 0, "xacro": true}), able());
    client.open(&address, &text);
    assert!(client.until(1, |_| true).is_empty());
    client.published.clear();
    client.save(&address);
    let found = client.until(1, |found| !found.is_empty());
    assert!(
        found[0]["message"].as_str().unwrap().contains("xacro"),
        "{found:#?}"
    );
}
