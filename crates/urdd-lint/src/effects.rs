//! Findings that are there only because of others: those that go away when misspelt names are mended, and those about a name
//! that another rule finds wrong.

use std::collections::{HashMap, HashSet};
use std::hash::Hash;

use super::subject::Subject;
use super::unknown::What;
use urdd_directory::position::{LineIndex, Position};
use urdd_findings::cause::at;
use urdd_findings::check::FollowsFrom;
use urdd_findings::check::{Check, Outcome};
use urdd_findings::code::Code;
use urdd_format::report::Place;
use urdd_xml::element::{Edit, apply};

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

/// Marks the findings that go away when misspelt names are mended. `again` runs the rules on another text; `None` if it is
/// no XML.
pub fn mark_misspelt(
    urdf: &Subject,
    checks: &mut [Check],
    again: impl FnOnce(&str) -> Option<Vec<Check>>,
) {
    let misspelt: HashSet<Position> =
        reported(checks, Code::LNT040).filter_map(|(place, _)| at(place)).collect();
    let mut misspellings = misspellings(urdf);
    misspellings.retain(|one| misspelt.contains(&one.at));
    if misspellings.is_empty() {
        return;
    }
    let mut edits: Vec<Edit> = misspellings.iter().flat_map(|one| one.edits.clone()).collect();
    let mended = apply(urdf.text, edits.clone());
    let Some(others) = again(&mended) else {
        return;
    };
    let (from, to) = (LineIndex::new(urdf.text), LineIndex::new(&mended));
    // How far edits up to each place move what follows.
    let mut moves: Vec<(usize, isize)> = Vec::new();
    edits.sort_by_key(|edit| edit.range.start);
    for edit in &edits {
        let before = moves.last().map_or(0, |(_, by)| *by);
        moves.push((
            edit.range.start,
            before + edit.text.len() as isize - edit.range.len() as isize,
        ));
    }
    let moved = |at| {
        let offset = from.offset(at)?;
        let edits_before = moves.partition_point(|(start, _)| *start < offset);
        let by = edits_before.checked_sub(1).map_or(0, |last| moves[last].1);
        Some(to.position(offset.checked_add_signed(by)?))
    };
    let causes = Causes::new(&misspellings);
    for check in checks.iter_mut().filter(|check| check.rule.code != Code::LNT040) {
        let mut others = others.iter();
        let other = others.find(|other| other.rule.code == check.rule.code);
        let ran = |other: &&Check| matches!(other.outcome, Outcome::Passed | Outcome::Failed);
        if let Some(other) = other.filter(ran) {
            let effect = |(place, at, message): (&Place, Position, String)| FollowsFrom {
                at,
                cause: (Code::LNT040, causes.of(place, &message)),
                message,
            };
            let effects = gone(check, other, moved).into_iter().map(effect);
            check.effects.extend(effects.collect::<Vec<_>>());
        }
    }
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
) -> Vec<(&'c Place, Position, String)> {
    let left: HashSet<(Position, &str)> =
        other.said().filter_map(|(place, message)| Some((at(place)?, message))).collect();
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
            gone.push((place, here, message.to_owned()));
        }
    }
    gone
}

/// The misspellings that findings follow from.
struct Causes<'m>(HashMap<Option<&'m str>, Vec<&'m Misspelling>>);

impl<'m> Causes<'m> {
    /// The first of each meaning, in each link or joint and in all.
    fn new(misspellings: &'m [Misspelling]) -> Self {
        let mut firsts: HashMap<_, Vec<&Misspelling>> = HashMap::new();
        for one in misspellings {
            let own = one.subject.as_deref();
            for part in own.map(Some).into_iter().chain([None]) {
                let firsts = firsts.entry(part).or_default();
                if firsts.iter().all(|first| first.meant != one.meant) {
                    firsts.push(one);
                }
            }
        }
        Causes(firsts)
    }

    /// One in the same link or joint, if there is one; and one whose right name the finding mentions.
    fn of(&self, place: &Place, message: &str) -> Position {
        let near = place.subject.as_deref().and_then(|part| self.0.get(&Some(part)));
        let all = near.or_else(|| self.0.get(&None)).map(Vec::as_slice).unwrap_or_default();
        let best = all.iter().find(|one| message.contains(one.meant)).or(all.first());
        best.map_or(Position { line: 1, column: 1 }, |best| best.at)
    }
}
