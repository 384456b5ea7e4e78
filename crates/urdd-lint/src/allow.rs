//! Comments in a URDF that allow findings: `<!-- urdd: allow LNT001, LNT003 the cable is not drawn -->`.
//!
//! A comment stands for the element that follows it, with all that is in it; before `<robot>`, for the whole file; and
//! behind an element on the same line, for that element.

use std::cmp::Reverse;
use std::collections::{HashMap, HashSet};
use std::str::FromStr;

use roxmltree::{Document, Node, NodeId};

use urdd_directory::position::{LineIndex, Position};
use urdd_findings::cause::at;
use urdd_findings::check::{Check, Outcome};
use urdd_findings::code::Code;
use urdd_findings::places::retain;
use urdd_findings::selection::Codes;
use urdd_findings::skip::SkipReason;
use urdd_format::report::StaleIgnore;

struct Allow {
    written: String,
    /// `None`: there is no such rule.
    codes: Option<Codes>,
    /// The comment's line.
    line: u32,
    /// The first position of what it stands for, and the first behind it.
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
        let mut ranges = Ranges::of(&allows, code);
        retain(check, reason, |_, place| !at(place).is_some_and(|at| ranges.hold(at)));
        let used = ranges.used();
        for allow in allows.iter_mut().filter(|allow| allow.is_of(code)) {
            allow.is_used |= used.contains(&(allow.from, allow.to));
        }
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

impl Allow {
    fn is_of(&self, code: Code) -> bool {
        self.codes.is_some_and(|codes| codes.holds(code))
    }
}

/// What comments stand for that allow a rule, in order. Each is apart from the others, or inside of some.
struct Ranges(Vec<Stretch>);

struct Stretch {
    from: Position,
    /// The first position behind it.
    to: Position,
    /// The smallest of the others that it is in.
    around: Option<usize>,
    is_used: bool,
}

impl Ranges {
    fn of(allows: &[Allow], code: Code) -> Self {
        let these = allows.iter().filter(|allow| allow.is_of(code));
        let mut these: Vec<_> = these.map(|allow| (allow.from, Reverse(allow.to))).collect();
        these.sort_unstable();
        these.dedup();
        let mut all: Vec<Stretch> = Vec::new();
        for (from, Reverse(to)) in these {
            let mut around = all.len().checked_sub(1);
            while let Some(other) = around.filter(|other| all[*other].to <= from) {
                around = all[other].around;
            }
            all.push(Stretch { from, to, around, is_used: false });
        }
        Ranges(all)
    }

    /// Whether one of them has a place; it is used then.
    fn hold(&mut self, at: Position) -> bool {
        let mut last = self.0.partition_point(|one| one.from <= at).checked_sub(1);
        while let Some(one) = last {
            if at < self.0[one].to {
                self.0[one].is_used = true;
                return true;
            }
            last = self.0[one].around;
        }
        false
    }

    /// Those that are used, with those around them.
    fn used(mut self) -> HashSet<(Position, Position)> {
        for one in (0..self.0.len()).rev().filter(|one| self.0[*one].is_used).collect::<Vec<_>>() {
            let mut around = self.0[one].around;
            while let Some(other) = around.filter(|other| !self.0[*other].is_used) {
                self.0[other].is_used = true;
                around = self.0[other].around;
            }
        }
        let used = self.0.iter().filter(|one| one.is_used);
        used.map(|one| (one.from, one.to)).collect()
    }
}

fn allows(document: &Document) -> Vec<Allow> {
    let nodes = document.descendants().filter(Node::is_comment);
    let comments: Vec<_> = nodes.filter_map(|node| Some((node, codes_of(node.text()?)?))).collect();
    if comments.is_empty() {
        return Vec::new();
    }
    let lines = LineIndex::new(document.input_text());
    let mut allows = Vec::new();
    let beside = Beside::of(comments.iter().map(|(comment, _)| *comment));
    for (comment, codes) in comments {
        let start = lines.position(comment.range().start);
        let ends_on_this_line = |node: &Node| lines.position(node.range().end).line == start.line;
        let before = beside.before[&comment.id()].filter(ends_on_this_line);
        let Some(element) = before.or(beside.after[&comment.id()]) else {
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

/// The elements beside comments: found once for many comments in a row.
struct Beside<'a> {
    before: HashMap<NodeId, Option<Node<'a, 'a>>>,
    after: HashMap<NodeId, Option<Node<'a, 'a>>>,
}

impl<'a> Beside<'a> {
    /// Of comments in the order of the document.
    fn of(comments: impl DoubleEndedIterator<Item = Node<'a, 'a>> + Clone) -> Self {
        type Known<'a> = HashMap<NodeId, Option<Node<'a, 'a>>>;
        let find = |known: &Known<'a>, next: fn(&Node<'a, 'a>) -> Option<Node<'a, 'a>>, comment| {
            let mut all = std::iter::successors(next(&comment), next);
            let found = all.find(|node| node.is_element() || known.contains_key(&node.id()))?;
            known.get(&found.id()).copied().unwrap_or(Some(found))
        };
        let (mut before, mut after) = (Known::new(), Known::new());
        for comment in comments.clone() {
            before.insert(comment.id(), find(&before, Node::prev_sibling, comment));
        }
        for comment in comments.rev() {
            after.insert(comment.id(), find(&after, Node::next_sibling, comment));
        }
        Beside { before, after }
    }
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
