//! The text layer on arbitrary documents and arbitrary bytes.

use proptest::prelude::*;
use serde_json::{Map, Value, json};
use urdd_directory::position::TextFaultKind as Kind;
use urdd_directory::yaml::{check_mirror, is_canonical};
use urdd_directory::{canonical, json, position};

fn text() -> impl Strategy<Value = String> {
    let tricky = prop::sample::select(vec![
        "no",
        "y",
        "~",
        "",
        "1",
        "010",
        "0x1",
        "1e-7",
        "1:30",
        "2001-01-01",
        "<<",
        "=",
        "null",
        ".inf",
        "- a",
        "a: b",
        "#",
        " a",
        "a ",
        "'",
        "\"",
        "[",
        "a\nb",
        "\u{85}",
        "\u{2028}",
        "\u{feff}",
        "\0",
        "\u{7f}",
        "\u{9b}",
        "\u{1F916}",
        "\u{ffff}",
        "---",
        "...",
        "!a",
        "&a",
        "*a",
        "%a",
        "@a",
        "?",
        ":",
    ]);
    prop_oneof![
        tricky.prop_map(str::to_owned),
        "[a-z_/.:-]{0,8}",
        any::<String>(),
        prop::collection::vec(any::<char>(), 0..6).prop_map(|chars| chars.into_iter().collect()),
    ]
}

fn number() -> impl Strategy<Value = Value> {
    let finite = prop::num::f64::ANY.prop_filter("finite", |x| x.is_finite());
    prop_oneof![
        finite.prop_map(Value::from),
        (-1e3..1e3_f64).prop_map(Value::from),
        (-20..20_i32).prop_map(|e| Value::from(10_f64.powi(e))),
        any::<i64>().prop_map(Value::from),
        any::<u64>().prop_map(Value::from),
    ]
}

fn leaf() -> impl Strategy<Value = Value> {
    prop_oneof![
        1 => Just(Value::Null),
        1 => any::<bool>().prop_map(Value::from),
        4 => number(),
        4 => text().prop_map(Value::from),
    ]
}

fn document() -> impl Strategy<Value = Value> {
    leaf().prop_recursive(5, 60, 6, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..6).prop_map(Value::from),
            prop::collection::vec((text(), inner), 0..6)
                .prop_map(|members| Value::from(members.into_iter().collect::<Map<_, _>>())),
        ]
    })
}

/// All leaves, each with a path to it.
fn leaves(value: &mut Value) -> Vec<&mut Value> {
    match value {
        Value::Array(list) => list.iter_mut().flat_map(leaves).collect(),
        Value::Object(map) => map.values_mut().flat_map(leaves).collect(),
        leaf => vec![leaf],
    }
}

fn other_than(leaf: &Value) -> Value {
    match leaf {
        Value::Number(n) => match n.as_f64() {
            Some(x) if x.abs() < 1e15 => Value::from(x + 0.5),
            _ => Value::from(0.25),
        },
        Value::String(s) => Value::from(format!("{s}x")),
        Value::Bool(b) => Value::from(!b),
        _ => Value::from("null"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, max_global_rejects: 100_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn canonical_json_reads_back(value in document()) {
        let document = json::read(canonical::json_string(&value).as_bytes()).unwrap();
        prop_assert_eq!(&document.value, &value);
        prop_assert!(document.faults.is_empty());
    }

    #[test]
    fn canonical_yaml_reads_back_in_another_reader(value in document()) {
        let text = canonical::yaml_string(&value);
        let read: Value = serde_yaml::from_str(&text).unwrap();
        prop_assert_eq!(&read, &value, "{}", text);
    }

    #[test]
    fn canonical_yaml_is_a_mirror_by_bytes_and_by_events(value in document()) {
        let text = canonical::yaml_string(&value);
        prop_assert!(is_canonical(text.as_bytes(), &value));
        let commented = format!("# by hand\n{text}");
        let faults = check_mirror(commented.as_bytes(), &value);
        prop_assert!(faults.is_empty(), "{faults}\n{text}");
    }

    #[test]
    fn another_writers_yaml_says_the_same(value in document()) {
        let text = serde_yaml::to_string(&value).unwrap();
        // A YAML 1.1 writer folds lines at these characters; for YAML 1.2, that changes the string.
        prop_assume!(!text.contains(['\u{85}', '\u{2028}', '\u{2029}']));
        let faults = check_mirror(text.as_bytes(), &value);
        prop_assert_eq!(faults.total(Kind::YamlDiffers), 0, "{}\n{}", faults, text);
    }

    #[test]
    fn one_changed_leaf_is_found(value in document(), pick in any::<prop::sample::Index>()) {
        let mut changed = value.clone();
        let mut leaves = leaves(&mut changed);
        prop_assume!(!leaves.is_empty());
        let leaf = pick.get_mut(&mut leaves);
        **leaf = other_than(leaf);
        let faults = check_mirror(canonical::yaml_string(&changed).as_bytes(), &value);
        prop_assert_eq!(faults.total(Kind::YamlDiffers), 1, "{}", faults);
        let fault = faults.iter().next().unwrap();
        let pointer = fault.pointer.as_deref().unwrap();
        prop_assert_ne!(value.pointer(pointer).unwrap(), changed.pointer(pointer).unwrap());
    }

    #[test]
    fn every_pointer_is_located(value in document()) {
        let text = canonical::json_string(&value);
        let lines: Vec<&str> = text.split('\n').collect();
        let mut open = vec![(String::new(), &value)];
        while let Some((pointer, value)) = open.pop() {
            let place = position::locate(&text, &pointer).unwrap();
            let line = lines[place.line as usize - 1];
            let rest: String = line.chars().skip(place.column as usize - 1).collect();
            let first = canonical::json_string(value);
            let first = first.lines().next().unwrap();
            prop_assert!(rest.starts_with(first), "{} at {}: {:?}", pointer, place, rest);
            let escape = |key: &str| key.replace('~', "~0").replace('/', "~1");
            match value {
                Value::Array(list) => open.extend(list.iter().enumerate().map(|(i, v)| (format!("{pointer}/{i}"), v))),
                Value::Object(map) => open.extend(map.iter().map(|(k, v)| (format!("{pointer}/{}", escape(k)), v))),
                _ => {}
            }
        }
    }

    #[test]
    fn any_bytes_are_survived(bytes in prop::collection::vec(any::<u8>(), 0..60)) {
        let _ = json::read(&bytes);
        check_mirror(&bytes, &json!({"a": [1]}));
    }

    #[test]
    fn anything_like_yaml_is_survived(text in r#"[-?:,\[\]{}#&*!|>'"%@ \t\n\r~<=0-9a-c_.\\\x{85}é]{0,40}"#) {
        check_mirror(text.as_bytes(), &json!({"a": [1]}));
        let _ = json::read(text.as_bytes());
    }
}
