//! A YAML tree and its serialization.

use urdd_export::yaml::*;

#[test]
fn a_tree_reads_back() {
    let sphere =
        Yaml::map([("center", Yaml::numbers(&[0.0, 1e-9, -2.5])), ("radius", Yaml::number(3.0))]);
    let tree = Yaml::map([
        ("empty", Yaml::EMPTY),
        ("none", Yaml::List(Vec::new())),
        ("number", Yaml::number(1e-9)),
        ("names", Yaml::texts(["a: b", "\u{202e}- c"])),
        ("spheres", Yaml::named([("link: 1", Yaml::List(vec![sphere.clone(), sphere]))])),
    ]);
    assert_eq!([-0.0, 1e-9, 1e300, 2.5].map(real).join(" "), "0.0 1.0e-9 1.0e+300 2.5");
    let long =
        ["x".repeat(990), "y".repeat(998), "z".repeat(1_200), "\u{1f916}\u{202e}\"".repeat(9_000)];
    let keys = || Yaml::named(long.iter().map(|name| (name.as_str(), Yaml::text(name))));
    let nested = Yaml::List(vec![keys(), Yaml::named([(long[2].as_str(), keys())])]);
    let read: serde_json::Value = serde_yaml::from_str(&nested.document(&[])).expect("YAML");
    for name in &long {
        assert_eq!(read[0][name], name.as_str());
        assert_eq!(read[1][&long[2]][name], name.as_str());
    }
    let text = tree.document(&["two\nlines".to_owned()]);
    let read: serde_json::Value = serde_yaml::from_str(&text).expect("YAML");
    let sphere = serde_json::json!({"center": [0.0, 1e-9, -2.5], "radius": 3.0});

    assert_eq!(read["empty"], serde_json::json!({}));
    assert_eq!(read["none"], serde_json::json!([]));
    assert_eq!(read["number"], serde_json::json!(1e-9));
    assert_eq!(read["names"], serde_json::json!(["a: b", "\u{202e}- c"]));
    assert_eq!(read["spheres"]["link: 1"], serde_json::json!([sphere, sphere]));
    assert!(text.starts_with("# two\\nlines\n"), "{text}");
}
