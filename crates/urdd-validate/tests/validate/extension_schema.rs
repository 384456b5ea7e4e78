//! Schemas of extensions: nothing outside is opened, and what would take much work is refused.

use serde_json::{Value, json};
use urdd_validate::views::extension_schema::{faults, violations};

fn message(schema: &Value, document: &Value) -> Option<String> {
    faults(schema, Some(document)).into_iter().next().map(|fault| fault.message)
}

#[test]
fn nothing_outside_is_referred_to() {
    for target in ["other.json", "file:///etc/passwd", "http://localhost/x", "/a"] {
        let schema = json!({"properties": {"a": {"$ref": target}}});
        let faults = faults(&schema, None);
        assert_eq!(faults.len(), 1);
        assert_eq!(faults[0].pointer, "/properties/a/$ref");
    }
    // This only looks like a reference.
    let schema = json!({"const": {"$ref": "other.json"}, "properties": {"$ref": true}});
    assert_eq!(message(&schema, &json!({})), None);
}

#[test]
fn what_is_no_schema_is_refused() {
    for schema in [
        json!(3),
        json!({"type": "strin"}),
        json!({"pattern": "("}),
        json!({"pattern": "((((a{100}){100}){100}){100})"}),
        json!({"$ref": "#/$defs/nowhere"}),
    ] {
        assert!(message(&schema, &json!(1)).is_some(), "{schema}");
    }
}

#[test]
fn recursion_is_fine_and_explosion_is_not() {
    let tree = json!({"type": "array", "items": {"$ref": "#"}});
    assert_eq!(message(&tree, &json!([[], [[]]])), None);
    assert_eq!(message(&json!({"$ref": "#"}), &json!(1)), None);

    let mut definitions = serde_json::Map::new();
    for i in 0..60 {
        let next = json!({"$ref": format!("#/$defs/a{}", i + 1)});
        definitions.insert(format!("a{i}"), json!({"anyOf": [next, next]}));
    }
    definitions.insert("a60".to_owned(), json!(false));
    let laughs = json!({"$defs": definitions, "$ref": "#/$defs/a0"});
    assert!(message(&laughs, &json!(1)).is_some());

    let twice = json!({"anyOf": [{"items": {"$ref": "#"}}, {"items": {"$ref": "#"}}]});
    let mut deep = json!(1);
    for _ in 0..60 {
        deep = json!([deep]);
    }
    assert!(message(&twice, &deep).is_some());
}

#[test]
fn long_chains_of_references_do_not_overflow() {
    let mut definitions = serde_json::Map::new();
    for i in 0..20_000 {
        definitions.insert(format!("a{i}"), json!({"$ref": format!("#/$defs/a{}", i + 1)}));
    }
    definitions.insert("a20000".to_owned(), json!(true));
    let chain = json!({"$defs": definitions, "$ref": "#/$defs/a0"});
    assert!(message(&chain, &json!(1)).is_some());
}

#[test]
fn large_documents_are_checked() {
    let schema = json!({"items": {"type": "array", "items": {"type": "number"}}});
    let mut document = json!(vec![vec![0.5; 100]; 3000]);
    assert_eq!(message(&schema, &document), None);
    assert!(violations(&schema, &document, None, 10).found.is_empty());
    document[7][8] = json!("x");
    let broken = violations(&schema, &document, None, 10);
    assert_eq!(broken.found[0].0, "/7/8");
    assert!(broken.is_first_only);
    // Of a million violations, one is kept; of a few, all.
    let all = json!({"items": {"type": "string"}});
    assert_eq!(violations(&all, &json!(vec![1; 1_000_000]), None, 10).found.len(), 1);
    let few = violations(&all, &json!([1, 2, "a"]), None, 10);
    assert_eq!((few.found.len(), few.is_first_only), (2, false));
}

#[test]
fn patterns_are_matched_in_linear_time() {
    let nested = json!({"pattern": "^(a+)+$"});
    let hostile = json!("a".repeat(100_000) + "!");
    let start = std::time::Instant::now();
    assert_eq!(message(&nested, &hostile), None);
    assert_eq!(violations(&nested, &hostile, None, 10).found.len(), 1);
    assert!(start.elapsed().as_secs() < 2);
    for pattern in ["^(?=a)(a+)+$", "(?!a)b", "(?<=a)b", "(a)\\1"] {
        for schema in [
            json!({"pattern": pattern}),
            json!({"patternProperties": {pattern: true}}),
            json!({"propertyNames": {"pattern": pattern}}),
        ] {
            assert!(message(&schema, &json!({})).is_some(), "{schema}");
        }
    }
}

#[test]
fn long_texts_and_lists_of_values_count_as_work() {
    // A pattern whose automaton has many states, on a long text and on long keys.
    let states = "[ab]*a[ab]{200}";
    let text = "ab".repeat(150_000);
    for (schema, document) in [
        (json!({"pattern": states}), json!(text)),
        (json!({"patternProperties": {states: true}}), json!({&text: 1})),
        (json!({"propertyNames": {"pattern": states}}), json!({&text: 1})),
    ] {
        assert!(message(&schema, &document).is_some());
    }
    // Each of many objects is compared with each of many others.
    let object = |i: usize| json!({"a": [1, 2, 3, 4, 5, 6, 7, 8, 9, i]});
    let objects: Vec<Value> = (0..2000).map(object).collect();
    let schema = json!({"items": {"enum": objects}});
    let document = json!((0..2000).map(|i| object(i + 2000)).collect::<Vec<_>>());
    assert!(message(&schema, &document).is_some());
    assert_eq!(message(&schema, &json!([object(3)])), None);
}

/// Verdicts of Node.js 20, `new RegExp(pattern, "u")`.
#[test]
fn patterns_are_those_of_javascript_in_unicode_mode() {
    let right = [
        "^$",
        "a|",
        "[]",
        "[^]",
        "[-a]",
        "[a-]",
        "[\\w-]",
        "[[]",
        "[a&&b]",
        "[!--b]",
        "[\\b]",
        "[\\-]",
        "\\0",
        "\\cA",
        "\\/",
        "\\x41",
        "\\u{1F916}",
        "\\ud83e\\udd16",
        "\\p{Lu}",
        "(?<n>a)",
        "a{2}",
        "a{2,}",
        "a{2,3}?",
        "a??",
        "é",
    ];
    let wrong = [
        "*",
        "a**",
        "a{2}{2}",
        "^*",
        "\\b+",
        "]",
        "}",
        "{",
        "a{",
        "a{,2}",
        "a{3,2}",
        "\\-",
        "\\e",
        "\\_",
        "\\ ",
        "\\é",
        "\\01",
        "\\c1",
        "\\x4",
        "\\u00",
        "\\u{110000}",
        "\\pL",
        "[\\B]",
        "[\\d-z]",
        "[a-\\d]",
        "[z-a]",
        "[",
        "(?i)a",
        "(?x:a)",
        "\\",
    ];
    for (patterns, is_one) in [(&right[..], true), (&wrong[..], false)] {
        for pattern in patterns {
            for schema in
                [json!({"pattern": pattern}), json!({"patternProperties": {*pattern: true}})]
            {
                assert_eq!(faults(&schema, None).is_empty(), is_one, "{schema}");
            }
        }
    }
    for (pattern, text, matches) in [
        ("^.$", "\u{2028}", false),
        ("^.$", "\r", false),
        ("^.$", "\u{85}", true),
        ("^[^]$", "\n", true),
        ("[]", "a", false),
        ("^\\ud83e\\udd16$", "\u{1F916}", true),
        ("\\bé", "é", false),
        ("^\\cA$", "\u{1}", true),
        ("^[\\b]$", "\u{8}", true),
        ("^\\s$", "\u{feff}", true),
        ("^\\d$", "\u{663}", false),
    ] {
        let found = violations(&json!({"pattern": pattern}), &json!(text), None, 1).found;
        assert_eq!(found.is_empty(), matches, "{pattern} {text:?}");
        let schema = json!({"patternProperties": {pattern: false}});
        let found = violations(&schema, &json!({text: 1}), None, 1).found;
        assert_eq!(!found.is_empty(), matches, "{pattern} {text:?}");
    }
    // Two spellings of one pattern are two keys.
    let schema = json!({"patternProperties": {"^\\x41": true, "^\\u0041": false}});
    assert_eq!(violations(&schema, &json!({"A": 1}), None, 1).found.len(), 1);
    let schema = json!({"patternProperties": {"^\\x41": false, "^\\u0041": true}});
    assert_eq!(violations(&schema, &json!({"A": 1}), None, 1).found.len(), 1);
    // The pattern is shown as it is written.
    let schema = json!({"properties": {"a": {"pattern": "^.$"}}});
    let found = violations(&schema, &json!({"a": "ab"}), None, 1).found;
    assert_eq!(found, [("/a".to_owned(), "value does not match \"^.$\"".to_owned())]);
}
