//! What is not told by itself of what rules found: what follows from other findings, and what a comment in the URDF allows.

use std::cell::LazyCell;
use std::collections::{HashMap, HashSet};
use std::hash::Hash;
use std::str::FromStr;

use urdd_directory::position::{LineIndex, Position};
use urdd_findings::check::{Check, FollowsFrom, Outcome};
use urdd_findings::code::Code;
use urdd_findings::part::SkipReason;
use urdd_findings::places::at;
use urdd_findings::places::retain;
use urdd_findings::selection::Codes;
use urdd_format::report::{Place, StaleIgnore};
use urdd_xml::element::{Edit, apply};
use urdd_xml::{Document, Node};

use crate::subject::Subject;
use crate::vocabulary::What;

/// A rule whose findings follow from those of another at the same place.
const AT_THE_SAME_PLACE: [(Code, Code); 2] =
    [(Code::LNT029, Code::LNT027), (Code::LNT030, Code::LNT027)];

/// A rule whose findings follow from those of another about the same link or joint: an inertia, a centre of mass or
/// limits that are written mend both.
const OF_ONE_PART: [(Code, Code); 9] = [
    (Code::LNT001, Code::SRC004),
    (Code::LNT001, Code::SRC005),
    (Code::LNT001, Code::LNT002),
    (Code::LNT002, Code::LNT064),
    (Code::LNT005, Code::SRC004),
    (Code::LNT005, Code::SRC005),
    (Code::SRC003, Code::LNT008),
    (Code::SRC006, Code::LNT017),
    (Code::LNT021, Code::LNT064),
];

struct Misspelling {
    at: Position,
    subject: Option<String>,
    meant: &'static str,
    edits: Vec<Edit>,
}

/// Marks the findings that follow from others by where they are.
pub fn mark(checks: &mut [Check]) {
    for (effect, cause) in AT_THE_SAME_PLACE {
        follow(checks, effect, cause, at);
    }
    for (effect, cause) in OF_ONE_PART {
        follow(checks, effect, cause, |place| place.subject.clone());
    }
}

/// Maximum number of names that are mended each by itself.
const MOST_TRIED: usize = 8;

/// Marks the findings that go away when misspelt names are mended. A finding follows from the name that takes it away by
/// itself: of those in its link or joint, or else of all. `again` runs the rules on another text, and says in their findings
/// what programs do or not; `None` if it is no XML.
pub fn mark_misspelt(
    urdf: &Subject,
    checks: &mut [Check],
    again: impl Fn(&str, bool) -> Option<Vec<Check>>,
) {
    let misspelt: HashSet<Position> =
        reported(checks, Code::LNT040).filter_map(|(place, _)| at(place)).collect();
    let mut misspellings = misspellings(urdf);
    misspellings.retain(|one| misspelt.contains(&one.at));
    if misspellings.is_empty() {
        return;
    }
    let edits: Vec<Edit> = misspellings.iter().flat_map(|one| one.edits.clone()).collect();
    let mended = apply(urdf.text, edits.clone());
    let Some(others) = again(&mended, true) else { return };
    let moves = Moves::new(urdf.text, &mended, edits);
    // The first of each meaning, in each link or joint and in all.
    let mut firsts: HashMap<Option<&str>, Vec<&Misspelling>> = HashMap::new();
    for one in &misspellings {
        let own = one.subject.as_deref();
        for part in own.map(Some).into_iter().chain([None]) {
            let firsts = firsts.entry(part).or_default();
            if firsts.iter().all(|first| first.meant != one.meant) {
                firsts.push(one);
            }
        }
    }
    let own = LazyCell::new(|| again(urdf.text, false).unwrap_or_default());
    // What goes away with one meaning.
    let by_itself = |meant: &str| {
        let of_meant = misspellings.iter().filter(|one| one.meant == meant);
        let edits: Vec<Edit> = of_meant.flat_map(|one| one.edits.clone()).collect();
        let mended = apply(urdf.text, edits.clone());
        let others = again(&mended, false).unwrap_or_default();
        let moves = Moves::new(urdf.text, &mended, edits);
        let mut all = HashSet::new();
        for (check, other) in both(&own, &others) {
            let left: HashSet<(Position, &str)> = here(other).collect();
            let gone = numbered(check).filter(|((at, _), message)| {
                moves.moved(*at).is_some_and(|there| !left.contains(&(there, message)))
            });
            all.extend(gone.map(|(key, _)| (check.rule.code, key)));
        }
        all
    };
    let mut tried: HashMap<&str, HashSet<(Code, Numbered)>> = HashMap::new();
    let mut effects = Vec::new();
    for (check, other) in both(checks, &others).filter(|(one, _)| one.rule.code != Code::LNT040) {
        let code = check.rule.code;
        let mut numbers = HashMap::new();
        for ((at, number), message) in numbered(check) {
            numbers.entry((at, message)).or_insert(number);
        }
        for (place, at, message) in gone(check, other, |at| moves.moved(at)) {
            let part = place.subject.as_deref().filter(|part| firsts.contains_key(&Some(part)));
            let near = firsts.get(&part).map(Vec::as_slice).unwrap_or_default();
            let key = (code, (at, numbers[&(at, message)]));
            let mut takes = |one: &&&Misspelling| {
                if !tried.contains_key(one.meant) && tried.len() < MOST_TRIED {
                    tried.insert(one.meant, by_itself(one.meant));
                }
                tried.get(one.meant).is_some_and(|gone| gone.contains(&key))
            };
            let best = near.iter().find(|one| near.len() > 1 && takes(one)).or(near.first());
            let cause = best.map(|best| (Code::LNT040, best.at));
            let message = message.to_owned();
            effects.extend(cause.map(|cause| (code, FollowsFrom { at, cause, message })));
        }
    }
    for (code, effect) in effects {
        if let Some(check) = checks.iter_mut().find(|check| check.rule.code == code) {
            check.effects.push(effect);
        }
    }
}

/// Where what is in a text is when it is mended.
struct Moves<'t> {
    from: LineIndex<'t>,
    to: LineIndex<'t>,
    /// How far edits up to each place move what follows.
    by: Vec<(usize, isize)>,
}

impl<'t> Moves<'t> {
    fn new(text: &'t str, mended: &'t str, mut edits: Vec<Edit>) -> Self {
        let mut all: Vec<(usize, isize)> = Vec::new();
        edits.sort_by_key(|edit| edit.range.start);
        for edit in &edits {
            let before = all.last().map_or(0, |(_, by)| *by);
            let by = edit.text.len() as isize - edit.range.len() as isize;
            all.push((edit.range.start, before + by));
        }
        Moves { from: LineIndex::new(text), to: LineIndex::new(mended), by: all }
    }

    fn moved(&self, at: Position) -> Option<Position> {
        let offset = self.from.offset(at)?;
        let edits_before = self.by.partition_point(|(start, _)| *start < offset);
        let by = edits_before.checked_sub(1).map_or(0, |last| self.by[last].1);
        Some(self.to.position(offset.checked_add_signed(by)?))
    }
}

/// The results of each rule that ran on another text too.
fn both<'c>(
    checks: &'c [Check],
    others: &'c [Check],
) -> impl Iterator<Item = (&'c Check, &'c Check)> {
    checks.iter().filter_map(|check| {
        let other = others.iter().find(|other| other.rule.code == check.rule.code)?;
        let ran = matches!(other.outcome, Outcome::Passed | Outcome::Failed);
        ran.then_some((check, other))
    })
}

/// Where a rule's findings are, and what they say.
fn here(check: &Check) -> impl Iterator<Item = (Position, &str)> {
    check.said().filter_map(|(place, message)| Some((at(place)?, message)))
}

/// Where a finding is, and its number among those of its rule there: what it says may depend on programs.
type Numbered = (Position, usize);

fn numbered(check: &Check) -> impl Iterator<Item = (Numbered, &str)> {
    let mut counts: HashMap<Position, usize> = HashMap::new();
    here(check).map(move |(at, message)| {
        let count = counts.entry(at).or_default();
        *count += 1;
        ((at, *count), message)
    })
}

/// Marks the findings of a rule that follow from those of another with the same `key`.
fn follow<K: Eq + Hash>(
    checks: &mut [Check],
    effect: Code,
    cause: Code,
    key: impl Fn(&Place) -> Option<K>,
) {
    let places = reported(checks, cause).filter_map(|(place, _)| Some((key(place)?, at(place)?)));
    let causes: HashMap<K, Position> = places.collect();
    let effects = reported(checks, effect).filter_map(|(place, message)| {
        Some(FollowsFrom {
            at: at(place)?,
            message: message.to_owned(),
            cause: (cause, *causes.get(&key(place)?)?),
        })
    });
    let effects: Vec<FollowsFrom> = effects.collect();
    if let Some(check) = checks.iter_mut().find(|check| check.rule.code == effect) {
        check.effects.extend(effects);
    }
}

/// The places of a rule's findings, with what they say.
fn reported(checks: &[Check], code: Code) -> impl Iterator<Item = (&Place, &str)> {
    checks.iter().filter(move |check| check.rule.code == code).flat_map(Check::said)
}

/// What is misspelt, but not what cannot be renamed: two attributes of one name are no XML.
fn misspellings(urdf: &Subject) -> Vec<Misspelling> {
    let mut found: Vec<Misspelling> = Vec::new();
    let mut renamed = HashSet::new();
    for one in urdf.unknown() {
        let Some(meant) = one.meant else { continue };
        let ranges = match one.what {
            What::Element => urdf.tag_names(one.node),
            What::Attribute(name) => {
                if one.node.has_attribute(meant) || !renamed.insert((one.node.id(), meant)) {
                    continue;
                }
                let attribute = one.node.attribute_node(name);
                attribute.map(|attribute| attribute.range_qname()).into_iter().collect()
            }
        };
        let edit = |range| Edit { range, text: meant.to_owned() };
        let edits = ranges.into_iter().map(edit).collect();
        let place = urdf.at_unknown(one, "").place;
        let at = at(&place);
        found.extend(at.map(|at| Misspelling { at, subject: place.subject, meant, edits }));
    }
    found
}

/// The places of a rule's findings that are not there among the others, where `moved` says that they would be; each with
/// what it says. Of a link or joint, no more than it has fewer findings: one that only says something else is still there.
fn gone<'c>(
    check: &'c Check,
    other: &Check,
    moved: impl Fn(Position) -> Option<Position>,
) -> Vec<(&'c Place, Position, &'c str)> {
    let left: HashSet<(Position, &str)> = here(other).collect();
    let mut fewer: HashMap<Option<&str>, usize> = HashMap::new();
    for (place, _) in check.said() {
        *fewer.entry(place.subject.as_deref()).or_default() += 1;
    }
    for (place, _) in other.said() {
        let count = fewer.entry(place.subject.as_deref()).or_default();
        *count = count.saturating_sub(1);
    }
    let mut gone = Vec::new();
    for (place, message) in check.said() {
        let Some((here, there)) = at(place).and_then(|at| Some((at, moved(at)?))) else {
            continue;
        };
        let count = fewer.entry(place.subject.as_deref()).or_default();
        if *count > 0 && !left.contains(&(there, message)) {
            *count -= 1;
            gone.push((place, here, message));
        }
    }
    gone
}

/// Maximum number of comments and texts between a comment and its element.
const MOST_BETWEEN: usize = 200;

struct Allow {
    written: String,
    /// `None`: there is no such rule.
    codes: Option<Codes>,
    line: u32,
    /// The first and the last position of what it stands for.
    from: Position,
    to: Position,
    is_used: bool,
}

/// Leaves out what comments allow, as `<!-- urdd: allow LNT001, LNT003 the cable is not drawn -->`. Returns what they allow
/// and no rule found. A comment stands for the element that follows it, with all that is in it; before `<robot>`, for the
/// whole file; and behind an element on the same line, for that element.
pub fn allow(document: &Document, name: &str, checks: &mut [Check]) -> Vec<StaleIgnore> {
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
