use serde_json::json;

use crate::client::{Client, able, covered};

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
    let names: Vec<&str> =
        symbols.as_array().unwrap().iter().map(|one| one["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["size", "arm", "${prefix}_upper", "base"]);
    client.change("file:///nowhere/arm.urdf.xacro", 2, &XACRO.replace("</xacro:macro>", ""));
    let found = client.until(2, |found| !found.is_empty());
    assert!(
        found[0]["message"].as_str().unwrap().starts_with("not well-formed XML: "),
        "{found:#?}"
    );
}

#[test]
fn included_files_that_are_missing_are_said_without_xacro() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().canonicalize().unwrap().join("my arm");
    std::fs::create_dir_all(root.join("urdf")).unwrap();
    let package = "<package>\n<name>my_arm</name></package>";
    std::fs::write(root.join("package.xml"), package).unwrap();
    std::fs::write(root.join("urdf/there.xacro"), XACRO).unwrap();
    let address = crate::client::uri(&root.join("urdf/arm.xacro"));
    let text = |includes: &[&str]| {
        let include = |name: &&str| format!("<xacro:include filename=\"{name}\"/>\n");
        let includes: String = includes.iter().map(include).collect();
        XACRO.replace("<link name='base'/>", &includes)
    };
    let mut client = Client::new();
    let fine = [
        "there.xacro",
        "../urdf/there.xacro",
        "$(find my_arm)/urdf/there.xacro",
        // Only xacro can tell.
        "$(find other_arm)/urdf/none.xacro",
        "$(find my_arm)/$(arg model).xacro",
        "${model}.xacro",
        "none*.xacro",
        "",
    ];
    client.open(&address, &text(&fine));
    assert_eq!(client.until(1, |_| true), [""; 0]);
    let wrong = ["none.xacro", "$(find my_arm)/urdf/n&amp;ne.xacro", "/none.xacro"];
    let text = text(&wrong);
    client.change(&address, 2, &text);
    let found = client.until(2, |found| !found.is_empty());
    let marked: Vec<String> = found.iter().map(|one| covered(&text, &one["range"])).collect();
    assert_eq!(marked, wrong);
    let message = found[1]["message"].as_str().unwrap();
    assert!(message.contains("my arm/urdf/n&ne.xacro"), "{message}");
    // Where xacro may leave it out.
    for (version, (before, after)) in (3..).zip([
        ("<xacro:if value='${size}'>", "</xacro:if>"),
        ("<xacro:macro name='m'>", "</xacro:macro>"),
    ]) {
        let include = "<xacro:include filename=\"none.xacro\"/>";
        let text = XACRO.replace("<link name='base'/>", &format!("{before}{include}{after}"));
        client.change(&address, version, &text);
        assert_eq!(client.until(version, |_| true), [""; 0]);
    }
    // A text that is no file includes none that could be looked for.
    client.open_as("untitled:Untitled-1", "xacro", &text);
    client.published.clear();
    assert_eq!(client.until(1, |_| true), [""; 0]);
}

/// `xacro` of these tests: whether it is installed does not matter, only that it is started when it may be.
#[test]
fn with_leave_it_is_expanded_when_it_is_saved_and_not_before() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().canonicalize().unwrap().join("arm.xacro");
    std::fs::write(
        &path,
        "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'><xacro:nothing/></robot>",
    )
    .unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let address = crate::client::uri(&path);
    let mut client = Client::with(json!({"debounce": 0, "xacro": true}), able());
    client.open(&address, &text);
    assert!(client.until(1, |_| true).is_empty());
    client.published.clear();
    client.save(&address);
    let found = client.until(1, |found| !found.is_empty());
    assert!(found[0]["message"].as_str().unwrap().contains("xacro"), "{found:#?}");
}
