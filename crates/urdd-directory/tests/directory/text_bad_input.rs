//! YAML files that no honest producer writes.

use serde_json::{Value, json};
use urdd_directory::position::{TextFaultKind as Kind, TextFaults};
use urdd_directory::yaml::check_mirror;

fn faults_of(yaml: &str, json: Value) -> TextFaults {
    check_mirror(yaml.as_bytes(), &json)
}

#[test]
fn nesting_is_bounded() {
    let nested = |n: usize| (0..n).fold(json!(1), |inner, _| Value::from(vec![inner]));
    let flow = |n: usize| "[".repeat(n) + "1" + &"]".repeat(n);
    let block = |n: usize| "- ".repeat(n) + "1\n";
    assert!(faults_of(&flow(100), nested(100)).is_empty());
    assert!(faults_of(&block(100), nested(100)).is_empty());
    let deep = [
        flow(101),
        block(101),
        flow(10_000),
        block(10_000),
        "[".repeat(10_000),
        "{a: ".repeat(10_000),
    ];
    for yaml in deep {
        let faults = check_mirror(yaml.as_bytes(), &json!([[1]]));
        assert_eq!(faults.total(Kind::YamlTooDeep), 1, "{:.40}: {faults}", yaml);
    }
    let stairs: String = (0..10_000).map(|n| " ".repeat(n % 200) + "a:\n").collect();
    assert_eq!(faults_of(&stairs, json!({})).total(Kind::YamlTooDeep), 1);
}

#[test]
fn a_key_in_braces_is_on_one_line_with_its_colon() {
    let refused = [
        "{k\n: [1]}",
        "{k\r: [1]}",
        "{é: é, k\r\n : [1]}",
        "{'k'\n: [1]}",
        "{\"k\" # why\n\n: [1]}",
        "{\"k\n k\": [1]}",
        "[{k\n: [1]}]",
        "{a b\n: [1]}",
    ];
    // PyYAML and libyaml refuse these and read the others.
    for yaml in refused {
        let faults = faults_of(yaml, json!({"k": [1]}));
        assert_eq!(faults.total(Kind::YamlSyntax), 1, "{yaml:?}: {faults}");
    }
    let read = [
        "{k:\n [1]\n}",
        "{\"k\" :\n [1]}",
        "{? k\n: [1]}",
        "{?\n k\n: [1]}",
        "? k\n: [1]",
        "{\n\n k: [1]\n,}",
    ];
    for yaml in read {
        let faults = faults_of(yaml, json!({"k": [1]}));
        assert!(faults.is_empty(), "{yaml:?}: {faults}");
    }
    assert!(faults_of("{k\n, l\n}", json!({"k": null, "l": null})).is_empty());
}

#[test]
fn a_text_that_ends_with_the_file() {
    // Saphyr reads one more line break at the end of each than PyYAML: both are right (SPEC 3.2.3).
    for yaml in [
        "k: |\n  é",
        "k: >\n  é",
        "k: |+\n  é",
        "k: |\n  é\n  ",
        "k: |\r\n  é",
        "a: |\n  b\nk: |\n  é",
    ] {
        for text in ["é", "é\n"] {
            let faults = faults_of(yaml, json!({"k": text}));
            let total = faults.total(Kind::YamlAmbiguousScalar);
            assert_eq!(total, 0, "{yaml:?}: {faults}");
        }
        assert!(!faults_of(yaml, json!({"k": "e"})).is_empty(), "{yaml:?}");
    }
    let clear = ["k: |\n  é\n", "k: |\n  é\n# why", "{k: \"é\\n\"}"];
    for yaml in clear {
        let faults = faults_of(yaml, json!({"k": "é\n"}));
        assert!(faults.is_empty(), "{yaml:?}: {faults}");
    }
    for yaml in ["k: |-\n  é", "k: é"] {
        let faults = faults_of(yaml, json!({"k": "é"}));
        assert!(faults.is_empty(), "{yaml:?}: {faults}");
    }
}

#[test]
fn bad_files_have_a_kind_each() {
    let json = || json!({"a": [1]});
    let first = |bytes: &[u8]| check_mirror(bytes, &json()).iter().next().cloned().unwrap();
    assert!(first(b"a: [1").message.contains("ends early"), "{:?}", first(b"a: [1"));
    assert!(first(b"a: \"b").message.contains("ends early"), "{:?}", first(b"a: \"b"));
    assert!(first(b"").message.contains("nothing"));
    assert!(first(b"# only a comment\n").message.contains("nothing"));
    assert!(first(b"a: [1]\0\n").message.contains("U+0000"));
    // The parser takes NUL for the end of the file, so what it would read must not be used.
    let faults = check_mirror(b"a: [2]\0, b: 1", &json());
    assert_eq!(faults.totals().collect::<Vec<_>>(), [(Kind::YamlSyntax, 1)]);
    let cases: [(&[u8], Kind); 9] = [
        (b"a: [1]\0\n", Kind::YamlSyntax),
        (b"a: [1]]\n", Kind::YamlSyntax),
        (b"a: [1,\t1]\n", Kind::YamlSyntax),
        (b"a:\n\t- 1\n", Kind::YamlSyntax),
        (b"a: [\xFF]\n", Kind::YamlNotUtf8),
        (b"\xFE\xFFa", Kind::YamlNotUtf8),
        (b"\xEF\xBB\xBFa: [1]\n", Kind::YamlByteOrderMark),
        (b"# c\n%YAML 1.1\n---\na: [1]\n", Kind::YamlDirective),
        (b"a: [1]\n---\na: [1]\n", Kind::YamlSeveralDocuments),
    ];
    for (bytes, kind) in cases {
        let fault = first(bytes);
        assert_eq!(fault.kind, kind, "{fault:?}");
        assert!(fault.position.is_some(), "{fault:?}");
    }
    for clean in [&b"a: [1] # c\td\r\n"[..], b"a:\r\n  - 1\r\n", b"a:\r- 1\r"] {
        assert!(check_mirror(clean, &json()).is_empty(), "{clean:?}");
    }
}
