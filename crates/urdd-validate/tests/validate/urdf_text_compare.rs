//! Compares a document with the URDF.

use serde_json::{Value, json};
use urdd_validate::urdf_text::compare::*;

fn pointers(expected: &Value, actual: &Value) -> Vec<String> {
    let found = differences(expected, actual);
    found.into_iter().map(|found| found.pointer).collect()
}

fn named(names: &[&str]) -> Value {
    let links: Vec<Value> =
        names.iter().map(|name| json!({"name": name, "mass": name.len()})).collect();
    json!({ "links": links })
}

#[test]
fn one_thing_that_is_missing_is_one_difference() {
    let all = named(&["a", "bb", "ccc", "dddd"]);
    assert_eq!(pointers(&all, &all), Vec::<String>::new());
    for other in [
        named(&["bb", "ccc", "dddd"]),
        named(&["a", "bb", "x", "ccc", "dddd"]),
        named(&["dddd", "ccc", "bb", "a"]),
        named(&[]),
    ] {
        assert_eq!(pointers(&all, &other), ["/links"]);
    }
    let renamed = json!({"links": [{"name": "a", "mass": 1}, {"name": "B", "mass": 2},
            {"name": "ccc", "mass": 3}, {"name": "dddd", "mass": 4}]});
    assert_eq!(pointers(&all, &renamed), ["/links/1/name"]);
    let short_and_wrong = json!({"links": [{"name": "ccc", "mass": 9}]});
    let found = differences(&all, &short_and_wrong);
    assert_eq!(found[1].pointer, "/links/0/mass");
    assert_eq!(found[1].source, "/links/2/mass");
    assert_eq!(found[0].list.as_deref(), Some("missing: `a`, `bb`, `dddd`"));
}

#[test]
fn values_are_compared_as_what_they_are() {
    let urdf = json!({"a": {"Mesh": {"scale": null}}, "v": [1.0, 2.0], "s": "x\r\ny", "n": 0.1});
    let same = json!({"a": {"Mesh": {"scale": null, "x_mine": 1}}, "v": [1, 2.000000001], "s": "x\ny",
            "n": 0.1000000000001, "$schema": "s"});
    assert_eq!(pointers(&urdf, &same), Vec::<String>::new());
    let other = json!({"a": {"Box": {"size": 1}}, "v": [1.0], "s": "x y", "n": 0.10000001});
    assert_eq!(pointers(&urdf, &other), ["/a", "/v", "/s", "/n"]);
    let filled = json!({"a": {"Mesh": {"scale": [1, 1, 1]}}, "v": [1, 2], "s": "x\ny", "n": null});
    assert_eq!(pointers(&urdf, &filled), ["/a/Mesh/scale", "/n"]);
}
