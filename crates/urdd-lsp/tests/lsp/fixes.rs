use serde_json::{Value, json};

use crate::client::{ARM, Client, able, covered};

const URI: &str = "untitled:Untitled-1";

fn actions(client: &mut Client, range: &Value, only: Value) -> Vec<Value> {
    let params = json!({"textDocument": {"uri": URI}, "range": range, "context": {"diagnostics": [], "only": only}});
    client.request("textDocument/codeAction", params).as_array().unwrap().clone()
}

#[test]
fn a_fix_mends_its_finding() {
    let mut client = Client::new();
    client.open(URI, ARM);
    let found = client.with_code(1, "LNT012");
    let actions = actions(&mut client, &found[0]["range"], Value::Null);
    let fix = actions.iter().find(|action| action["kind"] == "quickfix").expect("a fix");
    assert_eq!(fix["diagnostics"][0]["code"], "LNT012");
    assert_eq!(fix["isPreferred"], true);
    let changes = &fix["edit"]["documentChanges"][0];
    assert_eq!(changes["textDocument"], json!({"uri": URI, "version": 1}));
    let edit = &changes["edits"][0];
    assert_eq!(covered(ARM, &edit["range"]), "0 0 2");
    let numbers = edit["newText"].as_str().unwrap().split(' ');
    let numbers: Vec<f64> = numbers.map(|word| word.parse().unwrap()).collect();
    assert_eq!(numbers, [0.0, 0.0, 1.0]);
}

#[test]
fn all_safe_fixes_are_one_action_also_before_findings_are_there() {
    let text = ARM.replace("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 3\"/>");
    let mut capabilities = able();
    capabilities["workspace"] = json!({});
    let mut client = Client::with(json!({"debounce": 10_000}), capabilities);
    client.open(URI, ARM);
    client.with_code(1, "LNT012");
    client.change(URI, 2, &text);
    let start = json!({"line": 0, "character": 0});
    let range = json!({"start": start, "end": start});
    let actions = actions(&mut client, &range, json!(["source.fixAll"]));
    assert_eq!(actions.len(), 1, "{actions:#?}");
    assert_eq!(actions[0]["kind"], "source.fixAll");
    let edits = actions[0]["edit"]["changes"][URI].as_array().unwrap();
    let covered: Vec<String> = edits.iter().map(|edit| covered(&text, &edit["range"])).collect();
    assert_eq!(covered, ["0 0 2", "0 0 3"]);
}
