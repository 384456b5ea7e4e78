//! `urdd.toml` and baselines.

use std::fs;
use std::path::PathBuf;

use serde_json::{Value, json};

use crate::client::{ARM, Client, able, robot_folder, uri};

/// A workspace with the robot in a folder below.
struct Workspace {
    _folder: tempfile::TempDir,
    root: PathBuf,
    address: String,
}

fn workspace() -> Workspace {
    let (folder, path, address) = robot_folder();
    Workspace {
        root: path.parent().unwrap().parent().unwrap().to_owned(),
        address,
        _folder: folder,
    }
}

impl Workspace {
    fn write(&self, name: &str, text: &str) {
        fs::write(self.root.join(name), text).unwrap();
    }

    /// What is found anew, once it is as wanted.
    fn until(
        &self,
        client: &mut Client,
        version: i32,
        wanted: impl Fn(&[Value]) -> bool,
    ) -> Vec<Value> {
        client.change(&self.address, version, ARM);
        client.save(&self.address);
        client.until(version, wanted)
    }
}

fn has(found: &[Value], code: &str) -> bool {
    found.iter().any(|one| one["code"] == code)
}

/// Both kinds of findings are there: those of the text, and those about shapes.
fn is_complete(found: &[Value]) -> bool {
    has(found, "LNT012") && has(found, "LNT002")
}

/// The findings without a code: what the server says of settings.
fn words(found: &[Value]) -> Vec<&str> {
    let without = found.iter().filter(|one| one["code"].is_null());
    without.map(|one| one["message"].as_str().unwrap()).collect()
}

#[test]
fn urdd_toml_sets_severities_and_leaves_out() {
    let workspace = workspace();
    workspace.write("urdd.toml", "[severity]\nLNT012 = \"error\"\n");
    let mut client = Client::new();
    client.open(&workspace.address, ARM);
    assert_eq!(client.with_code(1, "LNT012")[0]["severity"], 1);
    client.until(1, is_complete);

    // A change counts at the next analysis. The path is that from the folder of the settings.
    let ignore = "[[ignore]]\ncode = \"LNT012\"\npath = \"my robot*/arm.urdf\"\nreason = \"r\"\n";
    workspace.write("urdd.toml", ignore);
    workspace.until(&mut client, 2, |found| !has(found, "LNT012") && has(found, "LNT002"));
    // The nearest settings count, and those alone.
    workspace.write("my robot \u{1F916}/urdd.toml", "[severity]\nLNT012 = \"info\"\n");
    let found = workspace.until(&mut client, 3, is_complete);
    let one = found.iter().find(|one| one["code"] == "LNT012").unwrap();
    assert_eq!(one["severity"], 3);
    fs::remove_file(workspace.root.join("my robot \u{1F916}/urdd.toml")).unwrap();
    workspace.write("urdd.toml", "exclude = [\"my*\"]");
    workspace.until(&mut client, 4, <[Value]>::is_empty);
    fs::remove_file(workspace.root.join("urdd.toml")).unwrap();
    workspace.until(&mut client, 5, is_complete);
}

#[test]
fn broken_settings_are_said_once_with_their_place_and_the_defaults_count() {
    let workspace = workspace();
    let mut client = Client::new();
    client.open(&workspace.address, ARM);
    for (version, (text, place, part)) in (2..).zip([
        ("\n\ncolour = true\n", ":3:1: ", "colour"),
        ("fail-on = ", ":1:11: ", ""),
        ("[severity]\nLNT012 = \"info\"\nLNT999 = \"info\"\n", ":3:1: ", "LNT999"),
        ("[severity]\nLNT012 = \"fatal\"\n", ":2:10: ", "fatal"),
        ("[[ignore]]\npath = \"[\"\nreason = \"r\"\n", ":2:8: ", "`[`"),
    ]) {
        workspace.write("urdd.toml", text);
        let found = workspace
            .until(&mut client, version, |found| is_complete(found) && !words(found).is_empty());
        let said = words(&found);
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(said[0].contains(&format!("urdd.toml{place}")), "{said:?}");
        assert!(said[0].contains(part), "{said:?}");
        assert!(said[0].contains("defaults"), "{said:?}");
        let one = found.iter().find(|one| one["code"].is_null()).unwrap();
        let related = &one["relatedInformation"][0]["location"];
        assert_eq!(related["uri"], uri(&workspace.root.join("urdd.toml")));
        let line: u64 = place.split(':').nth(1).unwrap().parse().unwrap();
        assert_eq!(related["range"]["start"]["line"], line - 1);
        let axis = found.iter().find(|one| one["code"] == "LNT012").unwrap();
        assert_eq!(axis["severity"], 2);
    }
    fs::write(workspace.root.join("urdd.toml"), b"\xff").unwrap();
    let found = workspace.until(&mut client, 9, |found| !words(found).is_empty());
    assert!(words(&found)[0].contains("not UTF-8"), "{found:?}");
    // A folder of this name is no file with settings.
    fs::remove_file(workspace.root.join("urdd.toml")).unwrap();
    fs::create_dir(workspace.root.join("urdd.toml")).unwrap();
    let found = workspace.until(&mut client, 10, is_complete);
    assert_eq!(words(&found), [""; 0]);
}

/// A baseline of what the rule of codes finds on a joint or link.
fn baseline(file: &str, keys: &[&str]) -> String {
    let keys: serde_json::Map<String, Value> =
        keys.iter().map(|key| ((*key).to_owned(), json!(1))).collect();
    json!({"urdd_baseline": 1, "files": {file: keys}}).to_string()
}

#[test]
fn what_is_in_a_baseline_is_not_shown() {
    let workspace = workspace();
    let file = "../my robot \u{1F916}/arm.urdf";
    workspace.write(
        "known.json",
        &baseline(&file[3..], &["LNT012 joint `shoulder`", "LNT002 link `upper`"]),
    );
    let is_left_out =
        |found: &[Value]| !found.is_empty() && !has(found, "LNT012") && !has(found, "LNT002");
    // Named by the settings of the folder.
    workspace.write("urdd.toml", "baseline = \"known.json\"\n");
    let mut client = Client::new();
    client.open(&workspace.address, ARM);
    let found = client.until(1, is_left_out);
    assert_eq!(words(&found), [""; 0]);
    // A second one on the same joint is new.
    let text = ARM.replace("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 3\"/>");
    client.change(&workspace.address, 2, &text);
    assert_eq!(client.with_code(2, "LNT012").len(), 1);

    // Named by the editor, which comes before the settings.
    workspace.write("other.json", &baseline(&file[3..], &["LNT002 link `upper`"]));
    let others = json!({"debounce": 0, "baseline": workspace.root.join("other.json")});
    let mut client = Client::with(others, able());
    client.open(&workspace.address, ARM);
    client.until(1, |found| has(found, "LNT012") && !has(found, "LNT002"));
    // Relative to the folder that is open; none if it is empty.
    client.notify(
        "workspace/didChangeConfiguration",
        json!({"settings": {"urdd": {"baseline": ""}}}),
    );
    client.published.clear();
    workspace.until(&mut client, 2, is_left_out);

    // What is no baseline is said, and leaves nothing out.
    for (version, (text, part)) in (3..).zip([("{", "not a baseline"), ("", "not a baseline")]) {
        workspace.write("known.json", text);
        let found = workspace
            .until(&mut client, version, |found| is_complete(found) && !words(found).is_empty());
        assert!(words(&found)[0].contains("known.json: "), "{found:#?}");
        assert!(words(&found)[0].contains(part), "{found:#?}");
    }
    fs::remove_file(workspace.root.join("known.json")).unwrap();
    let found =
        workspace.until(&mut client, 5, |found| is_complete(found) && !words(found).is_empty());
    assert!(words(&found)[0].contains("there is no such file"), "{found:#?}");
}

#[test]
fn a_text_that_is_not_saved_has_the_settings_of_the_open_folder() {
    let workspace = workspace();
    workspace.write("urdd.toml", "[severity]\nLNT012 = \"error\"\n");
    let mut client = Client::connected();
    client.request(
        "initialize",
        json!({
            "capabilities": able(),
            "rootUri": uri(&workspace.root),
            "initializationOptions": {"debounce": 0},
        }),
    );
    client.open("untitled:Untitled-1", ARM);
    assert_eq!(client.with_code(1, "LNT012")[0]["severity"], 1);
}
