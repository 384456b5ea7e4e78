use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::client::{Client, covered, uri};

/// The first URDD of the examples, copied.
fn urdd() -> (tempfile::TempDir, PathBuf) {
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/urdds/arm");
    let folder = tempfile::tempdir().unwrap();
    for file in [
        "urdd.json",
        "chain_module/module.json",
        "chain_module/module.yaml",
        "chain_module/VERSION",
    ] {
        let to = folder.path().join(file);
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::copy(from.join(file), to).unwrap();
    }
    let path = folder.path().canonicalize().unwrap();
    // The example's YAML is JSON.
    let module = path.join("chain_module");
    let json = fs::read(module.join("module.json")).unwrap();
    let value = serde_json::from_slice(&json).unwrap();
    fs::write(module.join("module.yaml"), urdd_directory::canonical::yaml_string(&value)).unwrap();
    (folder, path)
}

fn open(client: &mut Client, path: &Path, change: impl Fn(&str) -> String) -> (String, String) {
    let text = change(&fs::read_to_string(path).unwrap());
    let address = uri(path);
    client.open_as(&address, "json", &text);
    (address, text)
}

#[test]
fn what_is_right_has_no_finding() {
    let (_folder, path) = urdd();
    let mut client = Client::new();
    for file in ["urdd.json", "chain_module/module.json", "chain_module/module.yaml"] {
        open(&mut client, &path.join(file), str::to_owned);
        let found = client.until(1, |_| true);
        assert_eq!(found, [] as [Value; 0], "{file}");
        client.published.clear();
    }
}

#[test]
fn what_breaks_the_schema_is_found_where_it_is() {
    let (_folder, path) = urdd();
    let mut client = Client::new();
    let json = path.join("chain_module/module.json");
    let (_, text) = open(&mut client, &json, |text| {
        text.replacen("\"root_idx\": 0", "\"root_idx\": \"zero\"", 1)
    });
    let found = client.with_code(1, "SCH001");
    assert_eq!(covered(&text, &found[0]["range"]), "\"zero\"", "{found:#?}");
    let message = found[0]["message"].as_str().unwrap();
    assert!(message.contains("expected: integer"), "{message}");
    client.published.clear();

    let yaml = path.join("chain_module/module.yaml");
    let (_, text) =
        open(&mut client, &yaml, |text| text.replacen("root_idx: 0", "root_idx: zero", 1));
    let found = client.with_code(1, "SCH001");
    assert!(covered(&text, &found[0]["range"]).starts_with("root_idx: zero"), "{found:#?}");
    // It differs from module.json, too.
    assert!(!client.with_code(1, "YML007").is_empty());
    client.published.clear();

    open(&mut client, &path.join("urdd.json"), |text| {
        text.replacen('{', "{\n  \"strange\": 1,", 1)
    });
    let found = client.with_code(1, "SCH001");
    assert_eq!(found[0]["range"]["start"], json!({"line": 1, "character": 13}));
    client.published.clear();

    open(&mut client, &path.join("urdd.json"), |text| text.replacen('{', "{,", 1));
    client.with_code(1, "JSN001");
}

#[test]
fn values_are_explained_by_the_schema() {
    let (_folder, path) = urdd();
    let mut client = Client::new();
    for (file, needle) in [("module.json", "\"root_idx\""), ("module.yaml", "root_idx")] {
        let (address, text) =
            open(&mut client, &path.join("chain_module").join(file), str::to_owned);
        let hover = client.at("textDocument/hover", &address, &text, needle, 2);
        let shown = hover["contents"]["value"].as_str().unwrap_or_default();
        assert!(shown.contains("The one link without a parent."), "{file}: {shown}");
        assert!(shown.contains("Index of: `link`."), "{file}: {shown}");
        let hover = client.at("textDocument/hover", &address, &text, "axis", 1);
        let shown = hover["contents"]["value"].as_str().unwrap_or_default();
        assert!(shown.contains("Frame: `joint`."), "{file}: {shown}");
    }
}

#[test]
fn broken_documents_end_nothing() {
    let (_folder, path) = urdd();
    let mut client = Client::new();
    for file in ["module.json", "module.yaml"] {
        let (address, text) =
            open(&mut client, &path.join("chain_module").join(file), str::to_owned);
        for (version, end) in (2..).zip((0..text.len()).step_by(37)) {
            client.change(&address, version, &text[..end]);
            client.request(
                "textDocument/hover",
                json!({"textDocument": {"uri": address}, "position": {"line": 5, "character": 9}}),
            );
        }
    }
}
