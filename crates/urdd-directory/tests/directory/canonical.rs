//! The canonical form of a document, as JSON and as YAML.

use serde_json::{Value, json};
use urdd_directory::canonical::*;

fn sample() -> Value {
    json!({
        "name": "z1",
        "empty": [{}, [], ""],
        "matrix": [[0.0, 1.5e-7], [1, null], []],
        "deep": [[[1], [2]], [{"a": 1, "b": {"c": []}}]],
        "no": ["no", true, "0x1", "a b", "x/y.stl"],
    })
}

#[test]
fn json_layout() {
    let expected = r#"{
  "name": "z1",
  "empty": [
    {},
    [],
    ""
  ],
  "matrix": [
    [0.0, 1.5e-7],
    [1, null],
    []
  ],
  "deep": [
    [
      [1],
      [2]
    ],
    [
      {
        "a": 1,
        "b": {
          "c": []
        }
      }
    ]
  ],
  "no": ["no", true, "0x1", "a b", "x/y.stl"]
}
"#;
    assert_eq!(json_string(&sample()), expected);
}

#[test]
fn yaml_layout() {
    let expected = r#"name: z1
empty:
  - {}
  - []
  - ""
matrix:
  - [0.0, 1.5e-7]
  - [1, null]
  - []
deep:
  -
    - [1]
    - [2]
  -
    - a: 1
      b:
        c: []
"no": ["no", true, "0x1", "a b", x/y.stl]
"#;
    assert_eq!(yaml_string(&sample()), expected);
}

#[test]
fn a_key_too_long_for_readers_takes_two_lines() {
    let (short, long) = ("k".repeat(1000), "k".repeat(1001));
    let text = yaml_string(&json!({ "a": { short.clone(): 1, long.clone(): [[1]] } }));
    assert_eq!(text, format!("a:\n  {short}: 1\n  ? {long}\n  :\n    - [1]\n"));
}
