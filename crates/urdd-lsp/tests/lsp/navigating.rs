use serde_json::{Value, json};

use crate::client::{ARM, Client, able, covered, robot_folder, uri};

#[test]
fn names_lead_to_their_elements() {
    let mut client = Client::new();
    let address = "untitled:Untitled-1";
    client.open(address, ARM);
    for (needle, after, expected_line) in [
        ("parent link=\"base", 14, 5),
        ("mimic joint=\"shoulder", 14, 22),
        ("      <material name=\"grey", 23, 2),
        ("<child link=\"lower", 2, 21),
    ] {
        let place = client.at("textDocument/definition", address, ARM, needle, after);
        assert_eq!(place["uri"], address);
        assert_eq!(place["range"]["start"]["line"], expected_line, "{needle}: {place:#?}");
    }
    let place = client.at("textDocument/definition", address, ARM, "mimic joint=\"shoulder", 14);
    assert_eq!(covered(ARM, &place["range"]), "shoulder");
    assert_eq!(client.at("textDocument/definition", address, ARM, "rgba", 1), Value::Null);
    // An end of a loop of URDF+.
    let looped = ARM.replace("</robot>", "<loop><predecessor link=\"lower\"/></loop></robot>");
    let mut client = Client::new();
    client.open(address, &looped);
    let place =
        client.at("textDocument/definition", address, &looped, "predecessor link=\"low", 18);
    assert_eq!(place["range"]["start"]["line"], 21, "{place:#?}");
}

#[test]
fn meshes_lead_to_their_files() {
    let (_folder, path, address) = robot_folder();
    let mut client = Client::new();
    client.open(&address, ARM);
    let place = client.at("textDocument/definition", &address, ARM, "meshes/part.stl", 3);
    let file = path.with_file_name("meshes").join("part.stl");
    let lower = |text: &str| text.to_lowercase();
    assert_eq!(lower(place["uri"].as_str().unwrap()), lower(&uri(&file)));
}

#[test]
fn packages_are_found_where_the_user_says() {
    let (_folder, path, address) = robot_folder();
    let packages = path.parent().unwrap().join("other packages");
    std::fs::create_dir_all(packages.join("parts/meshes")).unwrap();
    std::fs::write(packages.join("parts/package.xml"), "<package><name>parts</name></package>")
        .unwrap();
    std::fs::copy(
        path.with_file_name("meshes").join("part.stl"),
        packages.join("parts/meshes/a.stl"),
    )
    .unwrap();
    let text = ARM.replace("meshes/part.stl", "package://parts/meshes/a.stl");
    let mut client = Client::with(json!({"debounce": 0, "packagePaths": [packages]}), able());
    client.open(&address, &text);
    let place = client.at("textDocument/definition", &address, &text, "package:", 3);
    assert!(place["uri"].as_str().unwrap().ends_with("/parts/meshes/a.stl"), "{place:#?}");
    // Settings may come later, too.
    let settings = json!({"settings": {"urdd": {"packagePaths": []}}});
    client.notify("workspace/didChangeConfiguration", settings);
    let place = client.at("textDocument/definition", &address, &text, "package:", 3);
    assert_eq!(place, Value::Null);
}

#[test]
fn the_outline_is_the_kinematic_tree() {
    let mut client = Client::new();
    let address = "untitled:Untitled-1";
    client.open(address, ARM);
    let symbols =
        client.request("textDocument/documentSymbol", json!({"textDocument": {"uri": address}}));
    let mut names = Vec::new();
    let mut inner = &symbols;
    while let Some(symbol) = inner.get(0) {
        names.push(symbol["name"].as_str().unwrap().to_owned());
        assert_eq!(inner.as_array().unwrap().len(), 1);
        inner = &symbol["children"];
    }
    assert_eq!(names, ["base", "shoulder", "upper", "elbow", "lower"]);
    assert_eq!(symbols[0]["children"][0]["detail"], "prismatic");

    let mut client = Client::with(json!({}), json!({}));
    client.open(address, ARM);
    let symbols =
        client.request("textDocument/documentSymbol", json!({"textDocument": {"uri": address}}));
    assert_eq!(symbols.as_array().unwrap().len(), 5);
    assert_eq!(symbols[1]["containerName"], "base");
}

#[test]
fn circles_and_long_chains_end() {
    let circle = "<robot name='r'><link name='a'/><link name='b'/>\
        <joint name='1' type='fixed'><parent link='a'/><child link='b'/></joint>\
        <joint name='2' type='fixed'><parent link='b'/><child link='a'/></joint></robot>";
    let mut chain = "<robot name='r'><link name='l0'/>".to_owned();
    for index in 0..500 {
        let next = index + 1;
        chain += &format!(
            "<link name='l{next}'/><joint name='j{index}' type='fixed'><parent link='l{index}'/><child link='l{next}'/></joint>"
        );
    }
    chain += "</robot>";
    let mut client = Client::new();
    fn count(symbols: &Value) -> usize {
        let all = symbols.as_array().into_iter().flatten();
        all.map(|one| 1 + count(&one["children"])).sum()
    }
    for (address, text, expected) in [("untitled:a", circle, 4), ("untitled:b", &chain, 1001)] {
        client.open(address, text);
        let symbols = client
            .request("textDocument/documentSymbol", json!({"textDocument": {"uri": address}}));
        assert_eq!(count(&symbols), expected);
    }
}
