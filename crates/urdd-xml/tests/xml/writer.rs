//! An XML tree and its serialization.

use urdd_xml::writer::*;

#[test]
fn text_from_anybody_stays_inside_its_place() {
    let hostile = [
        "a\"<b>&'",
        "--",
        "---",
        "----",
        "-",
        "x--",
        "--->",
        "-->",
        "--!>",
        "<!-- x -->",
        "--><!DOCTYPE robot [<!ENTITY x 'y'>]><robot name='other'/><!--",
        "]]>",
        "a\nb\tc\rd",
        "\u{202e}\u{85}\u{2028}\u{feff}",
        "-\n-",
        "-\u{ad}-",
        " - - ",
        "{{x}}",
        "{%x%}",
        "{#x#}",
        "{{{#{%{",
    ];
    for text in hostile {
        let written = Element::new("robot")
            .with("name", text)
            .document(&[text.to_owned(), format!("of `{text}`")]);
        let parsed = urdd_xml::parse(&written, urdd_xml::Kind::Other).expect(&written);
        assert_eq!(parsed.root_element().attribute("name"), Some(text));
        let comments = parsed
            .root_element()
            .parent()
            .expect("a root")
            .children()
            .filter(|node| node.is_comment());
        for comment in comments {
            let comment = comment.text().expect("text");
            assert!(!comment.contains("--") && !comment.ends_with('-'), "{comment}");
            assert!(comment.chars().all(urdd_xml::is_character));
        }
        assert_eq!(
            parsed.root_element().parent().expect("a root").children().count(),
            3,
            "{written}"
        );
        for begin in ["{{", "{%", "{#"] {
            assert!(!written.contains(begin), "{written}");
        }
    }
    let noncharacters = comment("\u{0}\u{fffe}\u{ffff}");
    assert_eq!(noncharacters, "<!-- \\u{0}\\u{fffe}\\u{ffff} -->\n");
}

#[test]
fn raw_text_is_a_child() {
    let mut root = Element::new("robot");
    root.push_raw("<gazebo><a/></gazebo>");
    let text = root.document(&[]);
    let parsed = urdd_xml::parse(&text, urdd_xml::Kind::Other).expect("well-formed");
    let names = parsed.root_element().children().filter(|n| n.is_element());
    assert_eq!(names.count(), 1);
}
