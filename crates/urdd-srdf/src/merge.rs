//! Merges into an existing SRDF: replaces the pairs of links that programs wrote, and leaves every other byte
//! unchanged. Runs in linear time.

use std::collections::HashSet;
use std::ops::Range;

use urdd_xml::Node;

use crate::{ReadError, Srdf};

/// The element that is replaced.
const DISABLED: &str = "disable_collisions";

/// The reasons that MoveIt's Setup Assistant and this program write. A pair with another reason, such as `User` or a
/// sentence, belongs to the user.
const FOUND_BY_PROGRAMS: &[&str] = &["Adjacent", "Always", "Default", "Never"];

/// A merged SRDF.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MergedSrdf {
    /// Its text.
    pub text: String,
    /// Number of pairs that the user disabled, which are unchanged.
    pub kept: usize,
    /// Number of pairs that the user enabled (`<enable_collisions>`) and the new text disables: omitted.
    pub enabled: usize,
}

/// Replaces the pairs of links in `old` that programs wrote with those of `new`. Pairs with a user's reason, groups,
/// states, end effectors, comments, white space and line endings remain. The new pairs take the place of the first old
/// one, or go to the end. A second merge changes nothing.
///
/// # Errors
/// If `old` is not an SRDF, or that of another robot.
pub fn merge_srdf(old: &str, new: &str) -> Result<MergedSrdf, ReadError> {
    let source = Srdf::new(new)?;
    let srdf = Srdf::of(old, source.robot().attribute("name").unwrap_or_default())?;
    let robot = srdf.robot();
    let (gone, persons): (Vec<Node>, Vec<Node>) =
        srdf.elements(DISABLED).partition(|pair| is_found_by_programs(*pair));
    let kept: HashSet<[&str; 2]> = persons.iter().map(|pair| links(*pair)).collect();
    let enabled: HashSet<[&str; 2]> = srdf.elements("enable_collisions").map(links).collect();
    let mut num_enabled = 0;
    let newline = newline_of(old);
    let margin = match robot.children().find(Node::is_element) {
        Some(first) => margin_before(old, first.range().start),
        None => "  ",
    };
    let mut pairs = Vec::new();
    for pair in source.elements(DISABLED) {
        let of = links(pair);
        let is_enabled = enabled.contains(&of);
        num_enabled += usize::from(is_enabled);
        if !is_enabled && !kept.contains(&of) {
            pairs.push(&new[pair.range()]);
        }
    }
    let merged = |text: String| MergedSrdf { text, kept: persons.len(), enabled: num_enabled };
    // They may be interleaved with the user's pairs.
    if gone.iter().map(|pair| &old[pair.range()]).eq(pairs.iter().copied()) {
        return Ok(merged(old.to_owned()));
    }
    let lines: String = pairs.iter().map(|pair| format!("{margin}{pair}{newline}")).collect();
    // An empty element has no end tag to insert before.
    let range = robot.range();
    let end = old[range.clone()].rfind("</").map(|end| range.start + end);
    let Some(end) = end else {
        let head = old[..range.end].trim_end_matches("/>").trim_end();
        let tail = &old[range.end..];
        return Ok(merged(format!("{head}>{newline}{lines}</robot>{tail}")));
    };
    let gone: Vec<Range<usize>> = gone.iter().map(|pair| whole_line(old, pair.range())).collect();
    let place = gone.first().map_or_else(|| line_start(old, end), |first| first.start);
    let mut text = String::with_capacity(old.len() + lines.len());
    text += &old[..place];
    if !lines.is_empty() && !text.ends_with('\n') {
        text += newline;
    }
    text += &lines;
    let mut from = place;
    for cut in gone {
        text += &old[from..cut.start];
        from = cut.end;
    }
    text += &old[from..];
    Ok(merged(text))
}

fn is_found_by_programs(pair: Node) -> bool {
    let reason = pair.attribute("reason").unwrap_or_default();
    FOUND_BY_PROGRAMS.contains(&reason.trim())
}

/// The names of a pair's links, sorted.
fn links<'a>(pair: Node<'a, '_>) -> [&'a str; 2] {
    let mut names = ["link1", "link2"].map(|key| pair.attribute(key).unwrap_or_default());
    names.sort_unstable();
    names
}

/// The line ending of a text: that of its first line.
fn newline_of(text: &str) -> &'static str {
    match text.split_once('\n') {
        Some((first, _)) if first.ends_with('\r') => "\r\n",
        _ => "\n",
    }
}

/// Extends a range by the white space before it and the line break after it, if nothing else is on its line.
fn whole_line(text: &str, range: Range<usize>) -> Range<usize> {
    let start = line_start(text, range.start);
    let rest = text[range.end..].trim_start_matches([' ', '\t', '\r']);
    let begins = start == 0 || text.as_bytes()[start - 1] == b'\n';
    if begins && rest.starts_with('\n') { start..text.len() - rest.len() + 1 } else { range }
}

/// The start of the line if only white space precedes `at` on it; otherwise `at`.
fn line_start(text: &str, at: usize) -> usize {
    let start = text[..at].trim_end_matches([' ', '\t']).len();
    if start == 0 || text.as_bytes()[start - 1] == b'\n' { start } else { at }
}

fn margin_before(text: &str, at: usize) -> &str {
    let start = line_start(text, at);
    if start > 0 && start < at { &text[start..at] } else { "  " }
}
