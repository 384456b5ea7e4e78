//! How YAML 1.1 and YAML 1.2 readers interpret a plain scalar.

use serde_json::{Value, json};
use urdd_directory::yaml::scalar::*;

#[test]
fn numbers_are_compared_by_value() {
    let same = |text, json: Value| agrees(classify(text).yaml12, text, &json);
    assert!(same("1", json!(1.0)) && same("1.0", json!(1)) && same("0x1F", json!(31)));
    assert!(same("-0.0", json!(0)) && same("1.0e-7", json!(1e-7)));
    assert!(same("18446744073709551615", json!(u64::MAX)));
    assert!(same("18446744073709551616", json!(18_446_744_073_709_551_616.0)));
    assert!(!same("9007199254740993", json!(9_007_199_254_740_992_i64)));
    assert!(!same("9007199254740993.0", json!(9_007_199_254_740_993_i64)));
    assert!(!same("1", json!("1")) && !same("a", json!(1)) && !same(".inf", json!(1)));
    assert!(!same("1.5", json!(1)) && !same("1e999", json!(1)));
}

#[test]
fn the_quick_way_agrees_with_the_long_one() {
    for text in ["0", "-1", "12", "0.5", "-1.25e-7", "10.0E+3", "length", "Falsehood"] {
        let long = (yaml12(text), yaml11(text));
        let quick = classify(text);
        assert_eq!((quick.yaml12, quick.yaml11), long, "{text}");
        assert!(!quick.ambiguous, "{text}");
    }
}
