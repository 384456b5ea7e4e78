//! Checks whether YAML mirrors a JSON text in bounded memory: a matrix is read one row at a time.

use urdd_directory::limits::DEPTH_LIMIT;
use urdd_directory::yaml::is_mirrored;
use urdd_directory::{canonical, json};

const TEXTS: [&str; 7] = [
    r#"{"a": 1}"#,
    r#"{"a": [], "b": {}, "c": [[]], "d": [{}], "no": null, "t": true}"#,
    r#"{"m": [[0.5, 1e-9], [-2, 3.0]], "n": {"rows": [[1], [2]], "deep": {"x": [1, 2]}}}"#,
    r#"{"mixed": [1, "two", [3], {"four": [5, [6]]}, 7], "x y": "a: b"}"#,
    r#"{"words": ["a", "No", "é\n"], "last": [null, {"a": {"b": [[], 1]}}]}"#,
    r#"{"big": [18446744073709551615, -9223372036854775808, 1e300]}"#,
    r#"{ "spaced" : [ [ 1 , 2 ] ,
        [ 3 ] ] }"#,
];

#[test]
fn what_is_mirrored_is_the_canonical_yaml() {
    for text in TEXTS {
        let value = json::read(text.as_bytes()).unwrap().value;
        let yaml = canonical::yaml_string(&value);
        assert!(is_mirrored(text, yaml.as_bytes()), "{text}\n{yaml}");
        // One byte more, one byte less, and each byte changed.
        assert!(!is_mirrored(text, format!("{yaml}\n").as_bytes()));
        assert!(!is_mirrored(text, &yaml.as_bytes()[..yaml.len() - 1]));
        for at in 0..yaml.len() {
            let mut changed = yaml.clone().into_bytes();
            changed[at] ^= 1;
            assert!(!is_mirrored(text, &changed), "{text}, byte {at}");
        }
    }
}

#[test]
fn a_text_with_faults_is_not_mirrored() {
    let long = "k".repeat(1001);
    let deep = "[".repeat(DEPTH_LIMIT) + &"]".repeat(DEPTH_LIMIT);
    for text in [
        r#"{"a": 1, "a": 1}"#.to_owned(),
        r#"{"a": [{"b": 1, "b": 1}]}"#.to_owned(),
        r#"{"a": {"b": 1, "b": 1}}"#.to_owned(),
        "[1]".to_owned(),
        "{}".to_owned(),
        "1".to_owned(),
        r#"{"a": 1} 2"#.to_owned(),
        r#"{"a": 1,}"#.to_owned(),
        format!(r#"{{"a": {deep}}}"#),
        "\u{feff}{\"a\": 1}".to_owned(),
    ] {
        let yaml = json::read(text.as_bytes())
            .map_or_else(|_| String::new(), |read| canonical::yaml_string(&read.value));
        assert!(!is_mirrored(&text, yaml.as_bytes()), "{text}");
    }
    let text = format!(r#"{{"a": {{"{long}": [1, [2]]}}}}"#);
    let value = json::read(text.as_bytes()).unwrap().value;
    assert!(is_mirrored(&text, canonical::yaml_string(&value).as_bytes()));
}
