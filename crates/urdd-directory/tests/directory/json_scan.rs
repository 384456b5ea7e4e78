//! A lexical scan of JSON text: finds positions without building a tree and without recursion.

use urdd_directory::json_scan::*;

/// Texts that are not JSON.
pub const BROKEN: [&str; 9] =
    ["", "\"", "{\"a", "{\"a\\", "[1,,", "}}", "{\"é\\ud800\":1}", "[\\", ":"];

#[test]
fn finds_repeated_keys_however_they_are_spelled() {
    let text = r#"{"a": [{"x": 1, "\u0078": 2, "y": {"x": 0}}], "a": "a", "b": "a"}"#;
    let mut found = Vec::new();
    repeated_keys(text, |key| found.push(key()));
    let pointers: Vec<_> = found.iter().map(|key| key.pointer.as_str()).collect();
    assert_eq!(pointers, ["/a/0/x", "/a"]);
    assert_eq!(&text[found[0].offset..][..8], r#""\u0078""#);
}

#[test]
fn says_where_an_offset_lies() {
    let text = r#"{"a/b": [0, {"c": NaN}], "d": 1}"#;
    let at = |what: &str| pointer_at(text, text.find(what).unwrap() + 1);
    assert_eq!(at("NaN"), "/a~1b/1/c");
    assert_eq!(at("1}"), "/d");
    assert_eq!(pointer_at(text, 0), "");
}

#[test]
fn broken_text_ends_the_walk() {
    for text in BROKEN {
        repeated_keys(text, |_| {});
        pointer_at(text, usize::MAX);
    }
}
