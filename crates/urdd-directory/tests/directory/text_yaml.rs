//! The YAML mirror: compared with other readers, with one fault at a time, and on bad input.

use serde_json::{Value, json};
use urdd_directory::canonical;
use urdd_directory::position::{KEPT_PER_KIND, TextFault, TextFaultKind as Kind, TextFaults};
use urdd_directory::yaml::check_mirror;
use urdd_directory::yaml::scalar::{Reading, classify};

// Results of other readers.

#[test]
fn plain_scalars_are_read_as_other_readers_read_them() {
    /// PyYAML and ruamel.yaml agree on these, and other readers do not.
    const AGREED_BY_TWO: &[&str] = &[
        "y",
        "Y",
        "n",
        "N",
        ".5e5",
        "-0x1F",
        "0b11",
        "1_000",
        "0_1",
        "0x_1",
        "1__0",
        "1_0.5",
        "1.0_1",
        "1._5",
        "2001-01-01",
        "2001-01-01T00:00:00Z",
        "2001-1-1T1:00:00",
        "2001-01-01 00:00:00",
        "=",
        "<<",
        "2001-01-01T00:00:00.5+01:00",
        "2001-01-01t00:00:00-5",
        "2001-01-01 00:00:00 +1",
    ];
    let table: Vec<Value> = serde_json::from_str(include_str!("yaml_scalars.json")).unwrap();
    assert!(table.len() > 150);
    for row in table {
        let text = row["text"].as_str().unwrap();
        let kind = |version: &str| row[version][0].as_str().unwrap();
        let (old, new) = (kind("yaml11"), kind("yaml12"));
        // Not plain scalars: a list, a mapping, a reserved character.
        if matches!(text, "-" | "1:" | "@x" | "`x" | "%x") {
            continue;
        }
        let readings = classify(text);
        let peers_agree = row["yaml11"] == row["yaml12"] && !AGREED_BY_TWO.contains(&text);
        let dates = old == "datetime";
        assert!(
            readings.ambiguous != peers_agree || dates,
            "{text}: {readings:?}, but YAML 1.1 {old}, YAML 1.2 {new}"
        );
        if !readings.ambiguous {
            let value = row["yaml12"][1].as_str().unwrap();
            let expected = match new {
                "null" => Reading::Null,
                "bool" => Reading::Bool(value == "True"),
                "int" => Reading::Integer,
                "float" if value.ends_with("inf") || value == "nan" => Reading::NonFinite,
                "float" => Reading::Float,
                _ => Reading::Text,
            };
            assert_eq!(readings.yaml12, expected, "{text}");
        }
    }
}

#[test]
fn canonical_strings_are_plain_only_where_nobody_reads_anything_else() {
    let table: Vec<Value> = serde_json::from_str(include_str!("yaml_scalars.json")).unwrap();
    for row in table {
        let text = row["text"].as_str().unwrap();
        let written = canonical::yaml_string(&row["text"]);
        if !written.starts_with('"') {
            assert_eq!(row["yaml11"], json!(["str", text]));
            assert_eq!(row["yaml12"], json!(["str", text]));
        }
    }
}

// One fault, one message.

fn faults_of(yaml: &str, json: Value) -> TextFaults {
    check_mirror(yaml.as_bytes(), &json)
}

fn only(yaml: &str, json: Value) -> TextFault {
    let faults = faults_of(yaml, json);
    let all: Vec<_> = faults.iter().cloned().collect();
    assert_eq!(all.len(), 1, "{yaml}: {all:#?}");
    all.into_iter().next().unwrap()
}

#[track_caller]
fn expect(yaml: &str, json: Value, kind: Kind, pointer: &str, place: (u32, u32)) -> TextFault {
    let fault = only(yaml, json);
    assert_eq!(fault.kind, kind, "{yaml}: {fault:?}");
    assert_eq!(fault.pointer.as_deref(), Some(pointer), "{yaml}: {fault:?}");
    let at = fault.position.unwrap();
    assert_eq!((at.line, at.column), place, "{yaml}: {fault:?}");
    fault
}

#[test]
fn mirrors_in_other_layouts_pass() {
    let json = json!({"a": [1, 2.0, {"b": null}], "c": "no", "d": "x\ty", "e": {}});
    for yaml in [
        "# a comment\na:\n- 1.0\n- 2\n- b:\nc: 'no'\nd: \"x\ty\"\ne: {} # done\n",
        "---\r\nc: \"no\"\r\na: [1, 2.0, {b: ~}]\r\nd: \"x\\ty\"\r\ne: {\r\n }\r\n...\r\n",
        "{\"a\":[1,2.0,{\"b\":null}],\"c\":\"no\",\"d\":\"x\\ty\",\"e\":{}} # \t tab",
        "e: {\n  # a\tcomment\n }\nd: \"x\ty\"\nc: >- # a\tb\n  no\n# a\tb\na: [ # a\tb\n 1, +2., {b: Null}]\n",
    ] {
        let faults = faults_of(yaml, json.clone());
        assert!(faults.is_empty(), "{yaml}: {faults}");
    }
}

#[test]
fn a_tab_in_a_block_scalar_is_a_fault() {
    for (yaml, place) in [
        ("d: |-\n  x\ty\n", (2, 4)),
        ("d: >- # a\tb\n  x\ty\n# c\td\n", (2, 4)),
        ("d: |-\t# a\tb\n  \"x\n", (1, 6)),
    ] {
        let json = json!({"d": if place.0 == 2 { "x\ty" } else { "\"x" }});
        let fault = only(yaml, json);
        let at = fault.position.unwrap();
        assert_eq!((fault.kind, at.line, at.column), (Kind::YamlSyntax, place.0, place.1));
        assert_eq!(fault.message.contains("block scalar"), place.0 == 2, "{yaml:?}: {fault:?}");
    }
}

#[test]
fn tags_are_one_fault_and_the_content_is_still_compared() {
    let json = json!({"shape": {"Mesh": {"file": "a.stl", "scale": [1, 2]}}});
    let yaml = "shape: !Mesh\n  file: a.stl\n  scale: [1.0, 2.0]\n";
    let fault = expect(yaml, json.clone(), Kind::YamlTag, "/shape", (1, 8));
    assert!(fault.message.contains("write `Mesh:` as a key"), "{}", fault.message);

    let faults = faults_of("shape: !Mesh\n  file: a.stl\n  scale: [1.0, 3.0]\n", json.clone());
    let differs = faults.iter().find(|fault| fault.kind == Kind::YamlDiffers).unwrap();
    assert_eq!(differs.pointer.as_deref(), Some("/shape/Mesh/scale/1"));
    assert_eq!(faults.iter().count(), 2);

    // The location of a missing inner key is inside, too.
    let faults = faults_of("shape: !Mesh\n  scale: [1.0, 2.0]\n", json.clone());
    assert!(faults.iter().any(|fault| fault.pointer.as_deref() == Some("/shape/Mesh/file")));

    expect("shape: !Box\n", json.clone(), Kind::YamlTag, "/shape", (1, 8));
    expect("a: !Fixed\n", json!({"a": "Fixed"}), Kind::YamlTag, "/a", (1, 4));
    expect("a: !Pair [1, 2]", json!({"a": {"Pair": [1, 2]}}), Kind::YamlTag, "/a", (1, 4));
    expect("a: !!str 1", json!({"a": "1"}), Kind::YamlTag, "/a", (1, 4));
    expect("a: !!float 1", json!({"a": 1}), Kind::YamlTag, "/a", (1, 4));
    expect("!Root\na: 1", json!({"a": 1}), Kind::YamlTag, "", (1, 1));
    expect("? !K a\n: 1", json!({"a": 1}), Kind::YamlTag, "", (1, 3));
}

#[test]
fn many_tags_are_counted_and_a_few_kept() {
    let n = 100_000;
    let yaml = "- !Mesh {a: 1}\n".repeat(n);
    let json = Value::from(vec![json!({"Mesh": {"a": 1}}); n]);
    let faults = check_mirror(yaml.as_bytes(), &json);
    assert_eq!(faults.total(Kind::YamlTag), n);
    assert_eq!(faults.iter().count(), KEPT_PER_KIND);
    assert_eq!(faults.totals().count(), 1);
}

#[test]
fn anchors_aliases_and_merge_keys_are_reported_and_not_expanded() {
    expect("a: &x 1\n", json!({"a": 1}), Kind::YamlAnchorOrAlias, "/a", (1, 4));
    let faults = faults_of("a: &x [1]\nb: *x\n", json!({"a": [1], "b": [1]}));
    assert_eq!(faults.total(Kind::YamlAnchorOrAlias), 2);
    assert_eq!(faults.totals().count(), 1);
    let faults = faults_of("a: &x {p: 1}\nb:\n  <<: *x\n", json!({"a": {"p": 1}, "b": {"p": 1}}));
    assert_eq!(faults.total(Kind::YamlAnchorOrAlias), 1);
    assert_eq!(faults.total(Kind::YamlMergeKey), 1);
    assert_eq!(faults.totals().count(), 2);
    expect("a: {<<: {p: 1}}", json!({"a": {"p": 1}}), Kind::YamlMergeKey, "/a/<<", (1, 5));
    expect("a: *x", json!({"a": 1}), Kind::YamlAnchorOrAlias, "/a", (1, 4));
}

#[test]
fn an_alias_bomb_is_harmless() {
    let mut yaml = String::from("a0: &a0 [lol, lol]\n");
    for n in 1..60 {
        yaml += &format!("a{n}: &a{n} [*a{0}, *a{0}, *a{0}]\n", n - 1);
    }
    let faults = check_mirror(yaml.as_bytes(), &json!({}));
    assert_eq!(faults.total(Kind::YamlAnchorOrAlias), 60 + 59 * 3);
}

#[test]
fn what_the_yaml_says_otherwise_is_placed() {
    let json = || json!({"a": [1, "x"], "b": {"c": 2.5}});
    let cases = [
        ("a: [1, x]\nb: {c: 2.25}", "/b/c", (2, 8)),
        ("a: [1, 2]\nb: {c: 2.5}", "/a/1", (1, 8)),
        ("a: [1, x, z]\nb: {c: 2.5}", "/a", (1, 4)),
        ("a: [1]\nb: {c: 2.5}", "/a", (1, 4)),
        ("b: {c: 2.5}\na: [1, x]\nd: 1", "/d", (3, 1)),
        ("b: {c: 2.5}", "/a", (1, 1)),
        ("a: [1, x]\nb: {}", "/b/c", (2, 4)),
        ("a: {}\nb: {c: 2.5}", "/a", (1, 4)),
        ("a: [1, x]\nb: [{c: 2.5}]", "/b", (2, 4)),
        ("a: [1, x]\nb: text", "/b", (2, 4)),
        ("a: [1, [x]]\nb: {c: 2.5}", "/a/1", (1, 8)),
        ("a: [1, x]\nb: {c: '2.5'}", "/b/c", (2, 8)),
        ("a: [1, x]\nb: {c: }", "/b/c", (2, 6)),
        ("", "", (1, 1)),
    ];
    for (yaml, pointer, place) in cases {
        expect(yaml, json(), Kind::YamlDiffers, pointer, place);
    }
    let fault = only("a: [1, x]\nb: {c: '2.5'}", json());
    assert_eq!(fault.expected.as_deref(), Some("2.5"));
    assert_eq!(fault.found.as_deref(), Some("\"2.5\""));
}

#[test]
fn what_readers_disagree_about_is_one_fault_with_the_remedy() {
    let cases = [
        ("1e-7", json!(1e-7), "write `1.0e-7`"),
        ("no", json!("no"), "write `\"no\"`"),
        ("1_000", json!("1_000"), "write `\"1_000\"`"),
        ("010", json!(10), "write `10`"),
        ("2001-01-01", json!("2001-01-01"), "a date"),
        ("=", json!("="), "an operator"),
        ("<<", json!("<<"), "an operator"),
    ];
    for (text, json, part) in cases {
        let yaml = format!("a: {text}\n");
        let fault = expect(&yaml, json!({"a": json}), Kind::YamlAmbiguousScalar, "/a", (1, 4));
        assert!(fault.message.contains(part), "{}", fault.message);
    }
    // Here YAML 1.2 disagrees with the JSON as well.
    let faults = faults_of("a: 1e-7", json!({"a": 1e-8}));
    assert_eq!(faults.total(Kind::YamlDiffers), 1);
    assert_eq!(faults.total(Kind::YamlAmbiguousScalar), 1);

    expect("yes: 1", json!({"yes": 1}), Kind::YamlAmbiguousScalar, "/yes", (1, 1));
    expect("a: [b?c]", json!({"a": ["b?c"]}), Kind::YamlAmbiguousScalar, "/a/0", (1, 5));
    expect("a: {b?c: 1}", json!({"a": {"b?c": 1}}), Kind::YamlAmbiguousScalar, "/a/b?c", (1, 5));
    assert!(faults_of("a: b?c", json!({"a": "b?c"})).is_empty());
    assert!(faults_of("a:\n- b?c\n", json!({"a": ["b?c"]})).is_empty());
    let fault = only("a: \"x\u{2028}y\"", json!({"a": "x\u{2028}y"}));
    assert_eq!(fault.kind, Kind::YamlAmbiguousScalar);
    assert!(fault.message.contains("\\u2028"));
}

#[test]
fn keys_are_strings_and_stand_once() {
    expect("1: 2", json!({"1": 2}), Kind::YamlNonStringKey, "/1", (1, 1));
    expect("~: 2", json!({"~": 2}), Kind::YamlNonStringKey, "/~0", (1, 1));
    let faults = faults_of("? [1, 2]\n: 3\n", json!({}));
    assert_eq!(faults.total(Kind::YamlNonStringKey), 1);
    assert_eq!(faults.totals().count(), 1);
    let repeated = "a: {b: 1, c: 2, b: 3}";
    expect(repeated, json!({"a": {"b": 1, "c": 2}}), Kind::YamlDuplicateKey, "/a/b", (1, 17));
    let repeated = "a: {c: 2, b: 1, c: 2}";
    expect(repeated, json!({"a": {"b": 1, "c": 2}}), Kind::YamlDuplicateKey, "/a/c", (1, 17));
}
