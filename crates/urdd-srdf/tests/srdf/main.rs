//! An SRDF of a person's, with new pairs of links: every other byte stays.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

use urdd_srdf::{ReadError, merge_srdf};
use urdd_xml::{Document, Node};

const NEW: &str = "<robot name=\"r\">\n  <disable_collisions link1=\"a\" link2=\"b\" reason=\"Never\"/>\n</robot>\n";

fn merged(old: &str) -> String {
    merge_srdf(old, NEW).expect("merged").text
}

fn disabled<'a>(srdf: &'a Document) -> Vec<Node<'a, 'a>> {
    let elements = srdf.root_element().children();
    elements.filter(|element| element.has_tag_name("disable_collisions")).collect()
}

#[test]
fn pairs_are_replaced_and_the_rest_stays() {
    let old = "<?xml version=\"1.0\"?>\n<!-- mine -->\n<robot name=\"r\">\n    <group name=\"arm\"><chain base_link=\"a\" tip_link=\"b\"/></group>\n    <disable_collisions link1=\"x\" link2=\"y\" reason=\"Never\"/>\n    <!-- kept -->\n    <disable_collisions link1=\"x\" link2=\"z\" reason=\"Always\"/>\n    <end_effector name=\"e\" parent_link=\"b\" group=\"g\"/>\n</robot>\n";
    let expected = "<?xml version=\"1.0\"?>\n<!-- mine -->\n<robot name=\"r\">\n    <group name=\"arm\"><chain base_link=\"a\" tip_link=\"b\"/></group>\n    <disable_collisions link1=\"a\" link2=\"b\" reason=\"Never\"/>\n    <!-- kept -->\n    <end_effector name=\"e\" parent_link=\"b\" group=\"g\"/>\n</robot>\n";
    assert_eq!(merged(old), expected);
    assert_eq!(merged(expected), expected);
}

#[test]
fn pairs_go_to_the_end_where_there_were_none() {
    let old = "<robot name=\"r\">\n  <group name=\"arm\"/>\n</robot>\n";
    let expected = "<robot name=\"r\">\n  <group name=\"arm\"/>\n  <disable_collisions link1=\"a\" link2=\"b\" reason=\"Never\"/>\n</robot>\n";
    assert_eq!(merged(old), expected);
    let empty = merged("<robot name=\"r\"/>\n");
    let parsed = urdd_xml::parse(&empty, urdd_xml::Kind::Other).expect("well-formed");
    assert_eq!(disabled(&parsed).len(), 1);
}

#[test]
fn elements_on_one_line_are_replaced() {
    let old = "<robot name=\"r\"><disable_collisions link1=\"x\" link2=\"y\" reason=\"Default\"/><group name=\"g\"/></robot>";
    let merged = merged(old);
    let parsed = urdd_xml::parse(&merged, urdd_xml::Kind::Other).expect("well-formed");
    let pairs = disabled(&parsed);
    assert_eq!(pairs.len(), 1);
    assert_eq!(pairs[0].attribute("link1"), Some("a"));
    assert!(merged.contains("<group name=\"g\"/>"));
}

#[test]
fn other_files_are_refused() {
    assert!(matches!(merge_srdf("<robot name=\"q\"/>", NEW), Err(ReadError::OtherRobot { .. })));
    assert!(matches!(merge_srdf("<urdf/>", NEW), Err(ReadError::NotSrdf(_))));
    assert!(matches!(merge_srdf("no", NEW), Err(ReadError::Xml { .. })));
}

#[test]
fn pairs_of_a_person_stay_and_are_counted() {
    let pair = |a: &str, b: &str, reason: &str| {
        format!("  <disable_collisions link1=\"{a}\" link2=\"{b}\"{reason}/>\n")
    };
    let own = [
        pair("b", "a", " reason=\"User\""),
        pair("a", "c", " reason=\"bolted together\""),
        pair("a", "d", ""),
    ];
    let gone = pair("c", "d", " reason=\" Adjacent \"");
    let old = format!("<robot name=\"r\">\n{}{gone}{}{}</robot>\n", own[0], own[1], own[2]);
    let made = merge_srdf(&old, NEW).expect("merged");
    // The pair of the new text is one of the user's, with the links swapped.
    assert_eq!(made.text, format!("<robot name=\"r\">\n{}</robot>\n", own.concat()));
    assert_eq!((made.kept, made.enabled), (3, 0));
    assert_eq!(merge_srdf(&made.text, NEW).expect("merged"), made);
    // A pair that the user enabled is not disabled.
    let old = "<robot name=\"r\">\n  <enable_collisions link1=\"b\" link2=\"a\"/>\n</robot>";
    let made = merge_srdf(old, NEW).expect("merged");
    assert_eq!((made.text.as_str(), made.kept, made.enabled), (old, 0, 1));
}

#[test]
fn line_ends_stay_and_a_second_run_changes_nothing() {
    let group = "<group name=\"g\"/>";
    let gone = "<disable_collisions link1=\"x\" link2=\"y\" reason=\"Never\"/>";
    let own = "<disable_collisions link1=\"x\" link2=\"z\" reason=\"User\"/>";
    let blanks = ["", " ", "\n", "\n  ", "\n\n\t", " <!-- c -->\n", "\n<!-- c -->"];
    for first in [group, gone, own] {
        for second in ["", group, gone, own] {
            for before in blanks {
                for between in blanks {
                    let old = format!(
                        "<?xml version=\"1.0\"?>\n<robot name=\"r\">{before}{first}{between}{second}{before}</robot>\n"
                    );
                    for old in [old.clone(), old.replace('\n', "\r\n")] {
                        let made = merge_srdf(&old, NEW).expect("merged").text;
                        assert_eq!(merged(&made), made, "{old:?}");
                        let is_mixed = made.replace("\r\n", "").contains('\n');
                        assert!(is_mixed != old.contains('\r'), "{old:?}: {made:?}");
                        let count = |text: &str, of: &str| text.matches(of).count();
                        assert_eq!(count(&made, own), count(&old, own), "{old:?}");
                        assert_eq!(count(&made, "<!-- c -->"), count(&old, "<!-- c -->"));
                        assert_eq!(count(&made, group), count(&old, group));
                        assert_eq!((count(&made, gone), count(&made, "link1=\"a\"")), (0, 1));
                    }
                }
            }
        }
    }
}
