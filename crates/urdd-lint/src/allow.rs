//! Comments in a URDF that allow findings: `<!-- urdd: allow LNT001, LNT003 the cable is not drawn -->`.
//!
//! A comment stands for the element that follows it, with all that is in it; before `<robot>`, for the whole file; and
//! behind an element on the same line, for that element.

use std::str::FromStr;

use urdd_xml::{Document, Node};

use urdd_directory::position::{LineIndex, Position};
use urdd_findings::cause::at;
use urdd_findings::check::{Check, Outcome};
use urdd_findings::places::retain;
use urdd_findings::selection::Codes;
use urdd_findings::skip::SkipReason;
use urdd_format::report::StaleIgnore;

/// Maximum number of comments and texts between a comment and its element.
const MOST_BETWEEN: usize = 200;

struct Allow {
    written: String,
    /// `None`: there is no such rule.
    codes: Option<Codes>,
    /// The comment's line.
    line: u32,
    /// The first and the last position of what it stands for.
    from: Position,
    to: Position,
    is_used: bool,
}

/// Leaves out what comments allow. Returns what they allow and no rule found.
pub fn apply(document: &Document, name: &str, checks: &mut [Check]) -> Vec<StaleIgnore> {
    let mut allows = allows(document);
    for check in checks.iter_mut().filter(|check| !check.findings.is_empty()) {
        let code = check.rule.code;
        let reason = SkipReason::Ignored("a comment in the file allows it".to_owned());
        let mut places: Vec<Position> = check.said().filter_map(|(place, _)| at(place)).collect();
        places.sort_unstable();
        // Where each begins, and the farthest end of those that begin before.
        let mut ranges = Vec::new();
        let is_of = |allow: &&mut Allow| allow.codes.is_some_and(|codes| codes.holds(code));
        for allow in allows.iter_mut().filter(is_of) {
            let first = places.partition_point(|at| *at < allow.from);
            allow.is_used |= places.get(first).is_some_and(|at| *at <= allow.to);
            ranges.push((allow.from, allow.to));
        }
        ranges.sort_unstable();
        for index in 1..ranges.len() {
            ranges[index].1 = ranges[index].1.max(ranges[index - 1].1);
        }
        let is_inside = |at: Position| {
            let before = ranges.partition_point(|(from, _)| *from <= at).checked_sub(1);
            before.is_some_and(|last| at <= ranges[last].1)
        };
        retain(check, reason, |_, place| !at(place).is_some_and(is_inside));
    }
    // What a rule that did not run would have found is not known.
    let ran = |codes: Codes| {
        let mut meant = checks.iter().filter(|check| codes.holds(check.rule.code)).peekable();
        meant.peek().is_some()
            && meant
                .all(|check| !matches!(check.outcome, Outcome::Skipped(_) | Outcome::Crashed(_)))
    };
    let stale = allows.iter().filter(|allow| !allow.is_used && allow.codes.is_none_or(ran));
    stale
        .map(|allow| StaleIgnore {
            code: Some(allow.written.clone()),
            path: format!("{name}:{}", allow.line),
        })
        .collect()
}

fn allows(document: &Document) -> Vec<Allow> {
    let nodes = document.descendants().filter(Node::is_comment);
    let comments: Vec<_> = nodes.filter_map(|node| Some((node, codes_of(node.text()?)?))).collect();
    if comments.is_empty() {
        return Vec::new();
    }
    let lines = LineIndex::new(document.input_text());
    let mut allows = Vec::new();
    for (comment, codes) in comments {
        let start = lines.position(comment.range().start);
        let ends_on_this_line = |node: &Node| lines.position(node.range().end).line == start.line;
        let element = |node: &Node| node.is_element();
        let before = comment.prev_siblings().skip(1).take(MOST_BETWEEN).find(element);
        let after = || comment.next_siblings().skip(1).take(MOST_BETWEEN).find(element);
        let Some(element) = before.filter(ends_on_this_line).or_else(after) else {
            continue;
        };
        let range = element.range();
        allows.extend(codes.into_iter().map(|code| Allow {
            codes: Codes::from_str(code).ok(),
            written: code.to_owned(),
            line: start.line,
            from: lines.position(range.start),
            to: lines.position(range.end),
            is_used: false,
        }));
    }
    allows
}

/// The codes that a comment allows; `None` if it is another comment.
pub fn codes_of(text: &str) -> Option<Vec<&str>> {
    let listed = text.trim().strip_prefix("urdd:")?.trim_start().strip_prefix("allow")?;
    let mut codes = Vec::new();
    for part in listed.strip_prefix(char::is_whitespace)?.split(',') {
        let part = part.trim();
        let end = part.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(part.len());
        codes.extend(Some(&part[..end]).filter(|code| !code.is_empty()));
        // What follows the code is the reason.
        if end == 0 || end < part.len() {
            break;
        }
    }
    Some(codes)
}
