//! Gives what programs do to the findings of rules that see the same fault.

use std::cell::RefCell;
use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap, HashSet};

use urdd_directory::position::{LineIndex, Position};
use urdd_findings::check::{Check, FollowsFrom};
use urdd_findings::code::Code;
use urdd_findings::finding::Finding;
use urdd_findings::places::at;
use urdd_findings::places::parted;
use urdd_format::report::{Place, Severity};
use urdd_format::short::Short;
use urdd_programs::Fault;
use urdd_xml::element::Edit;
use urdd_xml::{Node, NodeId};

use crate::fixes::fix;
use crate::programs::Asked;
use crate::programs::faults::{Faulty, Reach, sees};
use crate::subject::{Subject, part_of};

/// What programs do because of the faults at the places of rules' findings.
type Given = HashMap<(Code, Position), Faulty>;

struct Known {
    code: Code,
    at: Position,
    severity: Severity,
    message: String,
}

/// Gives what programs do to findings of the same fault, and returns the rest. Findings of the validator that are less severe
/// than what programs do become effects of what is left. `repairs` are those that made the subject's text of the file's.
pub fn attach(
    subject: &Subject,
    asked: &mut Asked,
    checks: &mut [Check],
    repairs: &[Edit],
) -> Vec<(Code, Finding)> {
    let known = Index::new(subject, checks, !repairs.is_empty());
    let mut given = Given::new();
    let mut effects: BTreeMap<Code, Vec<FollowsFrom>> = BTreeMap::new();
    let mut left = Vec::new();
    let mut faults = std::mem::take(&mut asked.faults);
    for faulty in &mut faults {
        faulty.at = repairs.iter().fold(faulty.at, |at, repair| repair.moved(at));
    }
    for mut faulty in of_one_body(subject, faults) {
        let offset = faulty.at;
        // What is before the robot is a fault of the file.
        let node = subject.element(offset).unwrap_or(subject.root);
        let severity = faulty.severity(asked.has_chosen);
        faulty.fix = fix(subject, offset, &faulty.fault);
        match known.of(subject, node, offset, &faulty) {
            // SPEC has the severities of the validator's rules.
            Some(known) if known.severity < severity && known.code.family() != "LNT" => {
                effects.entry(known.code).or_default().push(FollowsFrom {
                    at: known.at,
                    message: known.message.clone(),
                    cause: (faulty.code(), subject.position(offset)),
                });
            }
            Some(known) => {
                match given.entry((known.code, known.at)) {
                    Entry::Occupied(mut here) => here.get_mut().add(faulty),
                    Entry::Vacant(here) => {
                        here.insert(faulty);
                    }
                }
                continue;
            }
            None => {}
        }
        let found = |message| subject.at_offset(offset, message);
        left.push(faulty.reported(&asked.results, severity, found));
    }
    for check in checks {
        check.effects.extend(effects.remove(&check.rule.code).into_iter().flatten());
        give(check, &given, asked);
    }
    left
}

/// Gives what programs do because of such faults to the first finding of a rule, where nothing else is known of the robot;
/// returns the rest. `found` makes a finding of an offset and a message.
pub fn attach_to(
    code: Code,
    asked: &mut Asked,
    checks: &mut [Check],
    is_its: impl Fn(&Fault) -> bool,
    found: impl Fn(usize, String) -> Finding,
) -> Vec<(Code, Finding)> {
    let faults = std::mem::take(&mut asked.faults);
    let check = checks.iter_mut().find(|check| check.rule.code == code);
    let place = check.as_ref().and_then(|check| at(&check.findings.first()?.place));
    let (its, others): (Vec<Faulty>, Vec<Faulty>) =
        faults.into_iter().partition(|faulty| place.is_some() && is_its(&faulty.fault));
    let mut its = its.into_iter();
    if let (Some(check), Some(place), Some(mut first)) = (check, place, its.next()) {
        its.for_each(|other| first.add(other));
        give(check, &Given::from([((code, place), first)]), asked);
    }
    let left = |faulty: Faulty| {
        let (offset, severity) = (faulty.at, faulty.severity(asked.has_chosen));
        faulty.reported(&asked.results, severity, |message| found(offset, message))
    };
    others.into_iter().map(left).collect()
}

/// The faults, with those of the mass and inertia of a link as one.
fn of_one_body(subject: &Subject, all: Vec<Faulty>) -> Vec<Faulty> {
    let mut faults: Vec<Faulty> = Vec::new();
    let mut bodies: HashMap<String, usize> = HashMap::new();
    for faulty in all {
        let part = || part_of(subject.element(faulty.at)?);
        let is_body = matches!(faulty.fault, Fault::Inertia(_));
        match is_body.then(part).flatten().map(|part| bodies.entry(part)) {
            Some(Entry::Occupied(known)) => faults[*known.get()].add(faulty),
            Some(Entry::Vacant(new)) => {
                new.insert(faults.len());
                faults.push(faulty);
            }
            None => faults.push(faulty),
        }
    }
    faults
}

/// The first findings of each rule, by where they are: others of a rule there say no more of a fault.
#[derive(Default)]
struct Index {
    /// Whether the text was no XML before it was repaired. Then URD011 tells of that, and of nothing else; or else of all
    /// but that.
    is_repaired: bool,
    by_position: HashMap<Position, Vec<usize>>,
    /// In a link or joint.
    by_subject: HashMap<String, Vec<usize>>,
    /// Those about a file, by the link and the file's name: rules report a name once in each link.
    by_file: HashMap<(String, String), Vec<usize>>,
    /// Those about a material or its colour, by its name.
    by_material: HashMap<Short, Vec<usize>>,
    /// In the file.
    firsts: Vec<usize>,
    /// What `around` and `inside` gave, by element.
    around: RefCell<HashMap<NodeId, Vec<usize>>>,
    inside: RefCell<HashMap<NodeId, Vec<usize>>>,
    all: Vec<Known>,
}

impl Index {
    fn new(subject: &Subject, checks: &[Check], is_repaired: bool) -> Self {
        let mut index = Index { is_repaired, ..Index::default() };
        let lines = LineIndex::new(subject.text);
        for check in checks {
            for finding in &check.findings {
                for (place, message) in finding.said() {
                    let Some(at) = at(place) else { continue };
                    let here = index.all.len();
                    let (all, code) = (&index.all, check.rule.code);
                    let add = |list: &mut Vec<usize>| {
                        if list.iter().all(|first: &usize| {
                            let first: &Known = &all[*first];
                            first.code != code
                        }) {
                            list.push(here);
                        }
                    };
                    add(index.by_position.entry(at).or_default());
                    let is_of = |fault| sees(check.rule.code, &fault).is_some();
                    let file = place.subject.clone().zip(place.actual.clone());
                    let is_of_file = is_of(Fault::NotFound("mesh"));
                    if let Some(file) = file.filter(|_| is_of_file) {
                        add(index.by_file.entry(file).or_default());
                    }
                    let unknown = Fault::Unknown { kind: "material", name: Short::default() };
                    let offset = lines.offset(at).filter(|_| is_of(unknown));
                    if let Some(material) = offset.and_then(|at| material(subject, at)) {
                        add(index.by_material.entry(material).or_default());
                    }
                    if let Some(part) = &place.subject {
                        add(index.by_subject.entry(part.clone()).or_default());
                    }
                    add(&mut index.firsts);
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

    /// The finding that sees a fault: the one that is nearest; of those, one of lint.
    fn of(&self, subject: &Subject, node: Node, offset: usize, faulty: &Faulty) -> Option<&Known> {
        let is_of_xml = matches!(faulty.fault, Fault::Xml(_));
        let sees = |known: &Known, reach| {
            let is_its = known.code != Code::URD011 || is_of_xml == self.is_repaired;
            is_its && sees(known.code, &faulty.fault) >= Some(reach)
        };
        let best = |indices: Vec<usize>, reach| {
            let all = indices.into_iter().map(|index| &self.all[index]);
            let seen: Vec<&Known> = all.filter(|known| sees(known, reach)).collect();
            let of_lint = seen.iter().find(|known| known.code.family() == "LNT");
            of_lint.or(seen.first()).copied()
        };
        let here = |offset: usize| {
            let known = self.by_position.get(&subject.position(offset));
            known.map(Vec::as_slice).unwrap_or_default().iter().copied()
        };
        let starts = |node: Node| {
            let attributes = node.attributes().map(|one| one.range().start);
            std::iter::once(node.range().start).chain(attributes).collect::<Vec<_>>()
        };
        let start = node.range().start;
        // One attribute is no reason for what is wrong with another.
        let element = if offset == start { starts(node) } else { vec![start] };
        let beside = || {
            // What is beside a link is another one.
            let above = node.parent_element().filter(|above| above.parent_element().is_some())?;
            // A link and a joint hold parts of several kinds.
            let is_one = !matches!(node.tag_name().name(), "link" | "joint");
            let at = |one| starts(one).into_iter().flat_map(here).collect();
            let beside = std::iter::once(above).chain(above.children());
            let mut all = self.firsts_of(&self.around, above, beside, at);
            let inside = node.descendants().filter(|_| is_one);
            all.extend(self.firsts_of(&self.inside, node, inside, at));
            best(all, Reach::Beside)
        };
        let of_file = || {
            let file = node.attribute("filename")?.to_owned();
            let part = part_of(node)?;
            best(self.by_file.get(&(part, file))?.clone(), Reach::Element)
        };
        let in_part = || {
            let part = part_of(node)?;
            best(self.by_subject.get(&part)?.clone(), Reach::Part)
        };
        let named = || best(self.named(&faulty.fault)?.clone(), Reach::Named);
        let of_robot = || best(here(subject.root.range().start).collect(), Reach::Robot);
        best(here(offset).collect(), Reach::Element)
            .or_else(|| best(element.into_iter().flat_map(here).collect(), Reach::Element))
            .or_else(of_file)
            .or_else(beside)
            .or_else(in_part)
            .or_else(named)
            .or_else(of_robot)
            .or_else(|| best(self.firsts.clone(), Reach::File))
    }

    /// The findings about the part that a fault names.
    fn named(&self, fault: &Fault) -> Option<&Vec<usize>> {
        match fault {
            Fault::Unknown { name, .. } => self.by_material.get(name),
            Fault::Name { kind, name, .. } => self.by_subject.get(&format!("{kind} `{}`", &**name)),
            Fault::Empty("link") => self.by_subject.get("link ``"),
            _ => None,
        }
    }

    /// The first finding of each rule at nodes around one or in it. `at` gives the findings at an element. It is computed once
    /// for all faults there.
    fn firsts_of<'a>(
        &self,
        known: &RefCell<HashMap<NodeId, Vec<usize>>>,
        node: Node<'a, 'a>,
        all: impl Iterator<Item = Node<'a, 'a>>,
        at: impl Fn(Node<'a, 'a>) -> Vec<usize>,
    ) -> Vec<usize> {
        let mut known = known.borrow_mut();
        let firsts = known.entry(node.id()).or_insert_with(|| {
            let mut seen = HashSet::new();
            let found = all.filter(Node::is_element).flat_map(at);
            found.filter(|index| seen.insert(self.all[*index].code)).collect()
        });
        firsts.clone()
    }
}

/// The name of the material that has something at an offset.
fn material(subject: &Subject, offset: usize) -> Option<Short> {
    let node = subject.element(offset)?;
    let material = node.ancestors().find(|one| one.has_tag_name("material"))?;
    Some(material.attribute("name")?.into())
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
            let worst = of(place).map(|faulty| faulty.severity(asked.has_chosen));
            worst.filter(|worst| *worst > own)
        });
        for (worst, mut group) in groups {
            group.count += std::mem::take(&mut cut);
            group.severity = worst.or(group.severity);
            let message = std::mem::take(&mut group.message);
            for place in group.places_mut() {
                let Some(faulty) = of(place) else { continue };
                let said = place.message.as_ref().unwrap_or(&message);
                place.message = Some(format!("{said} ({})", faulty.doings(&asked.results)));
                place.programs = faulty.does();
                // The best is first.
                place.fixes.splice(0..0, faulty.fix.clone());
            }
            group.message = group.place.message.take().unwrap_or(message.clone());
            let others = group.more.iter_mut().filter(|_| group.message != message);
            for place in others {
                place.message.get_or_insert_with(|| message.clone());
                place.message.take_if(|said| *said == group.message);
            }
            check.findings.push(group);
        }
    }
}
