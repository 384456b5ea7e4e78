//! Gives what programs do to the findings of rules that see the same fault.

use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap};

use roxmltree::Node;

use urdd_directory::position::Position;
use urdd_findings::cause::at;
use urdd_findings::check::Check;
use urdd_findings::code::Code;
use urdd_findings::effect::Effect;
use urdd_findings::places::parted;
use urdd_format::report::{Does, Place, Severity};

use super::Asked;
use urdd_programs::Fault;

use super::answers::deed;
use super::faults::{Faulty, Said};
use super::seen::{Reach, sees};
use super::severity::{is_refused, severity};
use super::words::{doings, message};
use crate::subject::Subject;

/// A fault that no other rule finds, as LNT060 and LNT061 report it.
#[derive(Debug, Clone)]
pub struct Left {
    /// Where it is in the text.
    pub offset: usize,
    pub message: String,
    pub severity: Severity,
    pub programs: Vec<Does>,
    /// Whether a program has no robot because of it.
    pub is_refused: bool,
}

/// What programs do because of the faults at the places of rules' findings.
type Given = HashMap<(Code, Position), Faulty>;

/// A finding of another rule.
struct Known {
    code: Code,
    at: Position,
    severity: Severity,
    message: String,
}

/// Gives what programs do to findings of the same fault, and returns the rest. Findings of the validator that are less severe
/// than what programs do become effects of what is left.
pub fn attach(subject: &Subject, asked: &Asked, checks: &mut [Check]) -> Vec<Left> {
    let known = Index::new(checks);
    let mut given = Given::new();
    let mut effects: BTreeMap<Code, Vec<Effect>> = BTreeMap::new();
    let mut left = Vec::new();
    let faults = of_one_body(subject, asked);
    for faulty in &faults {
        let Some(offset) = asked.encoding.in_text(faulty.at) else { continue };
        let node = subject.element(offset);
        let severity = severity(&faulty.said, asked.has_chosen);
        match node.and_then(|node| known.of(subject, node, offset, faulty)) {
            // SPEC has the severities of the validator's rules.
            Some(known) if known.severity < severity && known.code.family() != "LNT" => {
                let code =
                    if faulty.said.iter().any(is_refused) { Code::LNT060 } else { Code::LNT061 };
                effects.entry(known.code).or_default().push(Effect {
                    at: known.at,
                    message: known.message.clone(),
                    cause: (code, subject.position(offset)),
                });
            }
            Some(known) => {
                let here = given.entry((known.code, known.at));
                here.and_modify(|one| one.add(faulty.clone())).or_insert_with(|| faulty.clone());
                continue;
            }
            None => {}
        }
        left.push(Left {
            offset,
            message: message(faulty, &asked.results),
            severity,
            programs: does(&faulty.said),
            is_refused: faulty.said.iter().any(is_refused),
        });
    }
    for check in checks {
        check.effects.extend(effects.remove(&check.rule.code).into_iter().flatten());
        give(check, &given, asked);
    }
    left
}

/// Gives all that programs do to the finding that a file is no XML: what they say of it beyond that is not known before it
/// is mended.
pub fn attach_all(asked: &Asked, checks: &mut [Check]) {
    let mut faults = asked.faults.iter().cloned();
    let (Some(mut first), code) = (faults.next(), Code::URD011) else { return };
    faults.for_each(|other| first.add(other));
    let check = checks.iter_mut().find(|check| check.rule.code == code);
    if let Some(check) = check
        && let Some(at) = check.findings.first().and_then(|finding| at(&finding.place))
    {
        give(check, &Given::from([((code, at), first)]), asked);
    }
}

/// The faults, with those of the mass and inertia of a link as one.
fn of_one_body(subject: &Subject, asked: &Asked) -> Vec<Faulty> {
    let mut faults: Vec<Faulty> = Vec::new();
    let mut bodies: HashMap<String, usize> = HashMap::new();
    for faulty in &asked.faults {
        let part = || {
            let node = subject.element(asked.encoding.in_text(faulty.at)?)?;
            crate::subject::subject(node)
        };
        let body = Some(faulty).filter(|one| matches!(one.fault, Fault::Inertia(_)));
        match body.and_then(|_| part()).map(|part| bodies.entry(part)) {
            Some(Entry::Occupied(known)) => faults[*known.get()].add(faulty.clone()),
            Some(Entry::Vacant(new)) => {
                new.insert(faults.len());
                faults.push(faulty.clone());
            }
            None => faults.push(faulty.clone()),
        }
    }
    faults
}

/// The findings of rules, by where they are.
struct Index {
    by_position: HashMap<Position, Vec<usize>>,
    by_subject: HashMap<String, Vec<usize>>,
    all: Vec<Known>,
}

impl Index {
    fn new(checks: &[Check]) -> Self {
        let mut index =
            Index { by_position: HashMap::new(), by_subject: HashMap::new(), all: Vec::new() };
        for check in checks {
            for finding in &check.findings {
                for (place, message) in finding.said() {
                    let Some(at) = at(place) else { continue };
                    let here = index.all.len();
                    index.by_position.entry(at).or_default().push(here);
                    if let Some(subject) = &place.subject {
                        index.by_subject.entry(subject.clone()).or_default().push(here);
                    }
                    index.all.push(Known {
                        code: check.rule.code,
                        at,
                        severity: finding.severity.unwrap_or(check.severity),
                        message: message.to_owned(),
                    });
                }
            }
        }
        index
    }

    /// The finding that sees a fault: the one that is nearest.
    fn of(&self, subject: &Subject, node: Node, offset: usize, faulty: &Faulty) -> Option<&Known> {
        let here = |position: Position| {
            self.by_position.get(&position).into_iter().flatten().map(|index| &self.all[*index])
        };
        let is_near = |known: &&Known| sees(known.code, &faulty.fault).is_some();
        let exact = here(subject.position(offset)).find(is_near);
        // One attribute is no reason for what is wrong with another.
        let in_element = || {
            let start = node.range().start;
            let attributes = node.attributes().map(|one| one.range().start);
            let attributes = attributes.filter(|_| offset == start);
            let starts = std::iter::once(start).chain(attributes);
            starts.flat_map(|start| here(subject.position(start))).find(is_near)
        };
        let beside = || {
            let above = node.parent_element()?;
            let all = std::iter::once(above).chain(above.children()).filter(Node::is_element);
            let starts = all.flat_map(|one| {
                let attributes = one.attributes().map(|one| one.range().start);
                std::iter::once(one.range().start).chain(attributes)
            });
            let is_beside = |known: &&Known| sees(known.code, &faulty.fault) >= Some(Reach::Beside);
            starts.flat_map(|start| here(subject.position(start))).find(is_beside)
        };
        let in_part = || {
            let part = crate::subject::subject(node)?;
            let all = self.by_subject.get(&part)?.iter().map(|index| &self.all[*index]);
            let is_of_part = |known: &&Known| sees(known.code, &faulty.fault) >= Some(Reach::Part);
            all.into_iter().find(is_of_part)
        };
        let in_file = || {
            let is_of_file = |known: &&Known| sees(known.code, &faulty.fault) == Some(Reach::File);
            self.all.iter().find(is_of_file)
        };
        exact.or_else(in_element).or_else(beside).or_else(in_part).or_else(in_file)
    }
}

/// Says at the places of findings what programs do. A finding is as severe as that.
fn give(check: &mut Check, given: &Given, asked: &Asked) {
    let code = check.rule.code;
    if !given.keys().any(|(of, _)| *of == code) {
        return;
    }
    let of = |place: &Place| given.get(&(code, at(place)?));
    for finding in std::mem::take(&mut check.findings) {
        let own = finding.severity.unwrap_or(check.severity);
        let (groups, mut cut) = parted(finding, |place| {
            let said = &of(place)?.said;
            Some((severity(said, asked.has_chosen).max(own), doings(said, &asked.results)))
        });
        for (said, mut group) in groups {
            group.count += std::mem::take(&mut cut);
            if let Some((worst, words)) = said {
                group.severity = Some(worst).filter(|worst| *worst > own).or(group.severity);
                group.message = format!("{} ({words})", group.message);
                for place in group.places_mut() {
                    place.message = place.message.take().map(|said| format!("{said} ({words})"));
                    place.programs = of(place).map_or_else(Vec::new, |one| does(&one.said));
                }
            }
            check.findings.push(group);
        }
    }
}

fn does(said: &[Said]) -> Vec<Does> {
    let does = |one: &Said| Does { program: one.program.id().to_owned(), does: deed(one.deed) };
    said.iter().map(does).collect()
}
