//! The canonical form of strings. `canonical` specifies it.

use urdd_directory::canonical::{Language, is_plain, write_quoted, yaml_quoted};

#[test]
fn characters_that_yaml_cannot_hold_are_escaped() {
    let text = "\0\u{7f}\u{85}\u{2028}\u{feff}\u{ffff}\u{1F916}é\"\\\n";
    assert_eq!(yaml_quoted(text), r#""\u0000\u007f\u0085\u2028\ufeff\uffff🤖é\"\\\n""#);
    let mut json = String::new();
    write_quoted(text, Language::Json, &mut json).unwrap();
    assert_eq!(json, serde_json::to_string(text).unwrap());
}

#[test]
fn words_that_mean_something_are_quoted() {
    for word in ["y", "N", "Yes", "nO", "On", "OFF", "True", "false", "NULL", "", "~", "-", "1"] {
        assert!(!is_plain(word), "{word}");
    }
    for word in ["x", "yesterday", "_1", "base_link", "meshes/0_base.stl", "nan"] {
        assert!(is_plain(word), "{word}");
    }
}
