//! An SRDF that is there already: its pairs of links replaced, everything else as it was, to the byte.

use std::ops::Range;

use roxmltree::{Document, Node};
use thiserror::Error;

/// The element that is replaced.
const DISABLED: &str = "disable_collisions";

/// Why an SRDF cannot be merged.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SrdfError {
    /// It is no XML.
    #[error("this is no XML: {0}")]
    Xml(String),
    /// It is no SRDF.
    #[error("this is no SRDF: its element is `{}`, not `robot`", .0.escape_debug())]
    NotSrdf(String),
    /// It is that of another robot.
    #[error("this is the SRDF of robot `{}`, not of `{}`", .found.escape_debug(), .expected.escape_debug())]
    OtherRobot {
        /// The name in it.
        found: String,
        /// The robot's.
        expected: String,
    },
}

/// `old` with the pairs of links of `new` instead of its own. Groups, states, end effectors, comments and white space
/// stay. The new pairs stand where the first old one stood, or at the end.
///
/// # Errors
/// Where `old` is no SRDF, or that of another robot.
pub fn merge_srdf(old: &str, new: &str) -> Result<String, SrdfError> {
    let old_document = parse(old)?;
    let new_document = parse(new)?;
    let (robot, source) = (old_document.root_element(), new_document.root_element());
    let names = [robot, source].map(|robot| robot.attribute("name").unwrap_or_default());
    if names[0] != names[1] {
        return Err(SrdfError::OtherRobot {
            found: names[0].to_owned(),
            expected: names[1].to_owned(),
        });
    }
    let pairs: Vec<&str> = disabled(source).map(|pair| &new[pair.range()]).collect();
    let gone: Vec<Range<usize>> = disabled(robot)
        .map(|pair| whole_line(old, pair.range()))
        .collect();
    let margin = match robot.children().find(Node::is_element) {
        Some(first) => margin_before(old, first.range().start),
        None => "  ",
    };
    let lines: String = pairs
        .iter()
        .map(|pair| format!("{margin}{pair}\n"))
        .collect();
    // An element without anything in it has no end tag to stand before.
    let range = robot.range();
    let end = old[range.clone()].rfind("</").map(|end| range.start + end);
    let Some(end) = end else {
        let head = old[..range.end].trim_end_matches("/>").trim_end();
        return Ok(format!("{head}>\n{lines}</robot>{}", &old[range.end..]));
    };
    let place = gone
        .first()
        .map_or_else(|| line_start(old, end), |first| first.start);
    let mut text = String::with_capacity(old.len() + lines.len());
    text += &old[..place];
    if !text.is_empty() && !text.ends_with('\n') {
        text.push('\n');
    }
    text += &lines;
    let mut from = place;
    for cut in gone {
        text += &old[from..cut.start];
        from = cut.end;
    }
    text += &old[from..];
    Ok(text)
}

pub(super) fn parse(text: &str) -> Result<Document<'_>, SrdfError> {
    let document = Document::parse(text).map_err(|error| SrdfError::Xml(error.to_string()))?;
    match document.root_element().tag_name().name() {
        "robot" => Ok(document),
        other => Err(SrdfError::NotSrdf(other.to_owned())),
    }
}

fn disabled<'a>(robot: Node<'a, 'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    robot
        .children()
        .filter(|child| child.is_element() && child.tag_name().name() == DISABLED)
}

/// With the white space before it and the line break after it, where nothing else is on its line.
fn whole_line(text: &str, range: Range<usize>) -> Range<usize> {
    let start = line_start(text, range.start);
    let rest = &text[range.end..];
    let blank = rest.len() - rest.trim_start_matches([' ', '\t', '\r']).len();
    let ends = rest[blank..].starts_with('\n');
    let begins = text[start..range.start].trim().is_empty();
    match begins && ends {
        true => start..range.end + blank + 1,
        false => range,
    }
}

fn line_start(text: &str, at: usize) -> usize {
    let start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
    match text[start..at].trim().is_empty() {
        true => start,
        false => at,
    }
}

fn margin_before(text: &str, at: usize) -> &str {
    let start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
    let margin = &text[start..at];
    match margin.trim().is_empty() && start > 0 {
        true => margin,
        false => "  ",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEW: &str = "<robot name=\"r\">\n  <disable_collisions link1=\"a\" link2=\"b\" reason=\"Never\"/>\n</robot>\n";

    #[test]
    fn pairs_are_replaced_and_the_rest_stays() {
        let old = "<?xml version=\"1.0\"?>\n<!-- mine -->\n<robot name=\"r\">\n    <group name=\"arm\"><chain base_link=\"a\" tip_link=\"b\"/></group>\n    <disable_collisions link1=\"x\" link2=\"y\" reason=\"User\"/>\n    <!-- kept -->\n    <disable_collisions link1=\"x\" link2=\"z\" reason=\"User\"/>\n    <end_effector name=\"e\" parent_link=\"b\" group=\"g\"/>\n</robot>\n";
        let expected = "<?xml version=\"1.0\"?>\n<!-- mine -->\n<robot name=\"r\">\n    <group name=\"arm\"><chain base_link=\"a\" tip_link=\"b\"/></group>\n    <disable_collisions link1=\"a\" link2=\"b\" reason=\"Never\"/>\n    <!-- kept -->\n    <end_effector name=\"e\" parent_link=\"b\" group=\"g\"/>\n</robot>\n";
        assert_eq!(merge_srdf(old, NEW).as_deref(), Ok(expected));
        assert_eq!(merge_srdf(expected, NEW).as_deref(), Ok(expected));
    }

    #[test]
    fn pairs_go_to_the_end_where_there_were_none() {
        let old = "<robot name=\"r\">\n  <group name=\"arm\"/>\n</robot>\n";
        let expected = "<robot name=\"r\">\n  <group name=\"arm\"/>\n  <disable_collisions link1=\"a\" link2=\"b\" reason=\"Never\"/>\n</robot>\n";
        assert_eq!(merge_srdf(old, NEW).as_deref(), Ok(expected));
        let empty = merge_srdf("<robot name=\"r\"/>\n", NEW).expect("merged");
        let parsed = Document::parse(&empty).expect("well-formed");
        assert_eq!(disabled(parsed.root_element()).count(), 1);
    }

    #[test]
    fn elements_on_one_line_are_replaced() {
        let old = "<robot name=\"r\"><disable_collisions link1=\"x\" link2=\"y\"/><group name=\"g\"/></robot>";
        let merged = merge_srdf(old, NEW).expect("merged");
        let parsed = Document::parse(&merged).expect("well-formed");
        let pairs: Vec<_> = disabled(parsed.root_element()).collect();
        assert_eq!(pairs.len(), 1);
        assert_eq!(pairs[0].attribute("link1"), Some("a"));
        assert!(merged.contains("<group name=\"g\"/>"));
    }

    #[test]
    fn other_files_are_refused() {
        assert!(matches!(
            merge_srdf("<robot name=\"q\"/>", NEW),
            Err(SrdfError::OtherRobot { .. })
        ));
        assert!(matches!(
            merge_srdf("<urdf/>", NEW),
            Err(SrdfError::NotSrdf(_))
        ));
        assert!(matches!(merge_srdf("no", NEW), Err(SrdfError::Xml(_))));
    }
}
