//! Links that are skipped because they touch at rest: what `info` and `check-collisions` say of their other collisions.

use serde_json::{Value, json};

use crate::program::urdd;
use testkit::robots::made_of;

/// Boxes of 0.2 m: one slides along the other, which it touches between -0.2 and 0.2 m. A link without shapes is between them.
const SLIDE: &str = r#"<robot name="slide">
  <link name="base"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <link name="mid"/>
  <link name="block"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <joint name="fixed" type="fixed"><parent link="base"/><child link="mid"/></joint>
  <joint name="slide" type="prismatic"><parent link="mid"/><child link="block"/><axis xyz="1 0 0"/>
    <limit lower="-0.5" upper="1.5" effort="1" velocity="1"/></joint></robot>"#;

/// The number of sampled configurations in which they touch: u(k, 0) of SPEC 9.3.
fn touching(samples: u64) -> usize {
    let position = |k: u64| {
        let mut z = ((k << 32) + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        let u = ((z ^ (z >> 31)) >> 11) as f64 * 2f64.powi(-53);
        -0.5 * (1.0 - u) + 1.5 * u
    };
    (0..samples).filter(|k| position(*k).abs() <= 0.2).count()
}

#[test]
fn collisions_of_links_that_touch_at_rest_are_counted() {
    let (folder, _) = made_of(SLIDE);
    let run = |arguments: &[&str]| urdd(arguments, folder.path());

    let (status, out, error) = run(&["info", "robot", "--format", "json"]);
    assert_eq!((status, error.as_str()), (0, ""));
    let info: Value = serde_json::from_str(&out).expect("JSON");
    let samples = info[0]["skipped_contacts"][0]["num_samples"].as_u64().expect("a number");
    let pair = json!({
        "links": ["base", "block"], "touching": touching(samples), "num_samples": samples,
    });
    assert_eq!(info[0]["skipped_contacts"], json!([pair]));
    let geometry = json!({ "visual": 0, "collision": 2, "with_collision": 2 });
    assert_eq!(info[0]["geometry"], geometry);
    let (_, text, _) = run(&["info", "robot"]);
    assert!(text.contains("1 pair of links that touches at rest"), "{text}");
    assert!(text.contains("base - block"), "{text}");

    let (status, text, _) = run(&["check-collisions", "robot", "--random", "500"]);
    assert_eq!(status, 0, "{text}");
    assert!(text.starts_with("0 of 500 configurations collide (0.0 %)\n"), "{text}");
    assert!(text.contains(&format!("\nnot counted: {} (", touching(500))), "{text}");

    let (status, out, _) = run(&["check-collisions", "robot", "--format", "json"]);
    let line: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!((status, &line["in_collision"]), (0, &json!(false)));
    assert_eq!(line["skipped_touching"][0]["links"], json!(["base", "block"]));
    let (_, text, _) = run(&["check-collisions", "robot"]);
    assert!(text.contains("  touching   base - block, skipped: they touch at rest\n"), "{text}");
}
