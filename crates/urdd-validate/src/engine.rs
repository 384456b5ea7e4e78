//! Runs the rules on a URDD, or on a URDF alone, phase by phase. A rule runs only if its needs are met; a rule that
//! crashes is caught.
//!
//! A URDD may have two descriptions of its robot, `urdf_module` and its carried URDF. URD001 and URD013 report where the
//! two differ. Even then, one fault should give one finding, and a second fault should not be hidden by the first:
//!
//! - Rules about the robot itself (SRC) use its source: the carried URDF, if it is readable.
//! - A module derived from the robot is judged against both, and is faulty only if both give a fault. A module made
//!   from the URDF before it was changed follows from `urdf_module`; one beside a damaged `urdf_module` follows from
//!   the URDF. In both cases URD001 reports the difference. A module that follows from neither is itself wrong.
//!
//! Each of the two runs keeps its own outcomes, so that a rule's needs hold for its own run. The results are then
//! combined rule by rule.

use std::collections::{HashMap, HashSet};

use super::context::{Context, Described, Subject, UrdfText, examined};
use super::locate::locate;
use super::reference::urdf_text;
use super::rule::{CheckOf, Need, Rule};
use super::{rules, skip};
use urdd_directory::discover::Found;
use urdd_directory::root::{ReadError, Root};
use urdd_document::carried_urdf::{self, CarriedUrdf};
use urdd_document::mechanism::Mechanism;
use urdd_document::module::Module;
use urdd_findings::answer;
use urdd_findings::check::Examined;
use urdd_findings::check::{Check, Outcome};
use urdd_findings::code::Code;
use urdd_findings::description::Phase;
use urdd_findings::finding::Findings;
use urdd_findings::part::SkipReason;
use urdd_findings::part::{Faulted, Part, Scope};
use urdd_format::registry::{ModuleKind, Profile};
use urdd_format::report::{Cause, Kind, NotExamined};
use urdd_xml::Xml;

/// Examines a URDF with the rules that apply to it.
pub fn examine_urdf_file(found: &Found, rules: &[&'static Rule]) -> Result<Examined, ReadError> {
    let urdf = carried_urdf::read_file(&Root::open(&found.path)?, &found.name)?;
    Ok(examine_carried(urdf, None, &found.name, rules))
}

/// Why a URDD or URDF was not examined that cannot be read.
pub(crate) fn unread(error: ReadError) -> NotExamined {
    answer::not_examined(Cause::Unreadable, error.to_string())
}

/// Examines the text of a URDF with the rules that need nothing else. `name` is its name in the report.
pub fn examine_urdf(xml: &Xml<'_>, name: &str) -> Examined {
    Examined::caught(Kind::Urdf, name, || {
        let urdf = CarriedUrdf::of_bytes(name, xml.text().as_bytes()).map_err(unread)?;
        // A byte order mark is not part of the URDF.
        let reading = (urdf.text == xml.text()).then(|| urdf_text::of(xml));
        Ok(examine_carried(urdf, reading, name, &rules::all()))
    })
}

fn examine_carried(
    urdf: CarriedUrdf,
    reading: Option<urdf_text::Reading>,
    name: &str,
    rules: &[&'static Rule],
) -> Examined {
    let text = UrdfText::known(reading);
    let mechanism = text.robot(Ok(&urdf)).map(Mechanism::new);
    let described =
        Described { mechanism: mechanism.as_ref(), module: None, urdf: Ok(&urdf), text: &text };
    let of_robots = rules.iter().copied().filter(|rule| matches!(rule.check, CheckOf::Robot(_)));
    let subject = Subject { described, urdd: None };
    let mut checks = run_all(subject, of_robots.collect(), &mut Outcomes::new());
    checks.sort_by_key(|check| check.rule.code);
    examined(Kind::Urdf, name, described.robot(), checks)
}

/// What a rule judges, and so which of the two descriptions it uses.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Judges {
    /// Files, texts, a module on its own, or a module against the URDF. Runs once.
    AsItStands,
    /// Whether the robot is valid: a tree of links, mimics that can be resolved. Runs for both descriptions, because
    /// other rules depend on it.
    Robot,
    /// The robot itself, whatever the modules contain. Uses the source if it is readable.
    Source,
    /// Data derived from the robot. A fault counts only if both descriptions give it.
    Derived,
}

impl Judges {
    fn of(rule: &Rule) -> Judges {
        let needs = |wanted: Need| rule.needs.contains(&wanted);
        match (rule.phase, rule.code.family()) {
            (Phase::Files | Phase::Syntax | Phase::Schema, _) => Judges::AsItStands,
            _ if needs(Need::CarriedUrdf) || needs(Need::UrdfFile) => Judges::AsItStands,
            _ if needs(Need::SourceRobot) => Judges::Source,
            (_, "URD") => Judges::Robot,
            // The meshes that urdf_module names, and the columns of a module that say the same.
            (_, "SRC") => Judges::AsItStands,
            _ if rule.code == Code::BND002 => Judges::AsItStands,
            _ => Judges::Derived,
        }
    }
}

/// Runs rules on a URDD. The checks are ordered by code.
pub fn run(context: &Context, rules: &[&'static Rule]) -> Vec<Check> {
    let mut checks = run_by_both(context, rules);
    checks.sort_by_key(|check| check.rule.code);
    checks
}

fn run_by_both(context: &Context, rules: &[&'static Rule]) -> Vec<Check> {
    let mut outcomes = Outcomes::new();
    let Some(by_urdf) = context.by_urdf() else {
        return run_all(context.into(), rules.to_vec(), &mut outcomes);
    };
    let of = |kind: Judges| rules.iter().copied().filter(move |rule| Judges::of(rule) == kind);
    let once = of(Judges::AsItStands).chain(of(Judges::Robot)).chain(of(Judges::Derived)).collect();
    let mut checks = run_all(context.into(), once, &mut outcomes);
    let differs = difference(&outcomes);

    let mut second: Vec<&'static Rule> = of(Judges::Source).collect();
    // Whether the URDF's robot is valid enough for the other rules; that of urdf_module was judged above.
    let sound: Vec<&'static Rule> = of(Judges::Robot).collect();
    second.extend(&sound);
    if differs.is_some() {
        second.extend(of(Judges::Derived));
    }
    for rule in &second {
        outcomes.remove(&rule.code);
    }
    let mut again: HashMap<Code, Check> = run_all((&by_urdf).into(), second, &mut outcomes)
        .into_iter()
        .map(|check| (check.rule.code, check))
        .collect();
    for rule in &sound {
        again.remove(&rule.code);
    }
    if let Some(differs) = differs {
        for check in &mut checks {
            let rule = rules.iter().find(|rule| rule.code == check.rule.code);
            let second = again.remove(&check.rule.code);
            if let Some((rule, second)) = rule.zip(second) {
                put_together(rule, check, second, [context, &by_urdf]);
            }
        }
        update_reasons(&mut checks, differs);
    }
    checks.extend(again.into_values());
    checks
}

/// The rule that did not confirm that `urdf_module` matches the URDF.
fn difference(outcomes: &Outcomes) -> Option<Code> {
    [Code::URD001, Code::URD013]
        .into_iter()
        .find(|code| outcomes.get(code).is_some_and(|ran| ran.outcome != Outcome::Passed))
}

/// Combines the check by `urdf_module` with the check by the URDF.
fn put_together(rule: &'static Rule, check: &mut Check, second: Check, contexts: [&Context; 2]) {
    *check = match (&check.outcome, &second.outcome) {
        (Outcome::Crashed(_), _) | (_, Outcome::Skipped(_)) => return,
        (Outcome::Skipped(_), _) | (_, Outcome::Crashed(_)) => second,
        (Outcome::Failed, Outcome::Failed) => at_fault_by_both(rule, [&*check, &second], contexts),
        (Outcome::Passed, _) | (_, Outcome::Passed) => {
            Check::new(check.rule, Outcome::Passed, Vec::new())
        }
    };
}

/// The findings of a rule at the places where it failed both times. Runs it once more, because only the first of many
/// findings are kept.
fn at_fault_by_both(
    rule: &'static Rule,
    [first, second]: [&Check; 2],
    [context, by_urdf]: [&Context; 2],
) -> Check {
    let mut spots = Findings::remembering_spots().within(first.scope.afresh());
    judge(context.into(), rule, &mut spots);
    let mut both = Findings::only_at(spots.into_spots()).within(second.scope.afresh());
    judge(by_urdf.into(), rule, &mut both)
}

/// Replaces the reason of rules that were skipped because of a rule that no longer has findings: the two robots differ.
fn update_reasons(checks: &mut [Check], differs: Code) {
    let settled: HashSet<Code> = checks
        .iter()
        .filter(|check| check.outcome == Outcome::Passed)
        .map(|check| check.rule.code)
        .collect();
    for check in checks {
        if let Outcome::Skipped(SkipReason::Failed(code)) = &mut check.outcome
            && settled.contains(code)
        {
            *code = differs;
        }
    }
}

/// The outcome of a rule, and the parts with findings.
#[derive(Debug, Clone)]
struct Ran {
    pub outcome: Outcome,
    pub faulted: Faulted,
}

type Outcomes = HashMap<Code, Ran>;

/// Runs rules for one description of the robot. `outcomes` has the outcomes of rules that ran before; those of these
/// rules are added.
fn run_all(
    subject: Subject<'_>,
    mut rules: Vec<&'static Rule>,
    outcomes: &mut Outcomes,
) -> Vec<Check> {
    rules.sort_by_key(|rule| (rule.phase, rule.code));
    let mut checks = Vec::with_capacity(rules.len());
    // A rule may need one of the same phase with a higher code: it waits for the next round.
    let mut waiting = rules;
    while !waiting.is_empty() {
        let codes: Vec<Code> = waiting.iter().map(|rule| rule.code).collect();
        let before = waiting.len();
        let mut later = Vec::new();
        for rule in waiting {
            // The caller checks as well, and discards partial results.
            if subject.urdd.is_some_and(|urdd| urdd.cancellation.is_cancelled()) {
                return checks;
            }
            let is_open = |code: &Code| !outcomes.contains_key(code) && codes.contains(code);
            if rule.needs.iter().any(|need| need.codes().iter().any(is_open)) {
                later.push(rule);
                continue;
            }
            let check = run_rule(subject, rule, outcomes);
            let ran = Ran { outcome: check.outcome.clone(), faulted: check.faulted.clone() };
            outcomes.insert(rule.code, ran);
            checks.push(check);
        }
        if later.len() == before {
            // Rules that wait for each other are a fault of the rules, not of the URDD.
            for rule in later.drain(..) {
                let outcome = Outcome::Crashed("its needs go in a circle".to_owned());
                checks.push(Check::new(&rule.description, outcome, Vec::new()));
            }
        }
        waiting = later;
    }
    checks
}

fn run_rule(subject: Subject<'_>, rule: &'static Rule, outcomes: &Outcomes) -> Check {
    let needs = Need::each_of(rule.needs);
    if let Some(reason) = needs.iter().find_map(|need| unmet(subject, *need, outcomes)) {
        return Check::skipped(&rule.description, reason);
    }
    // The parts that are left out, each with the rule that it failed.
    let mut unsound: HashMap<Part, Code> = HashMap::new();
    for need in needs {
        let codes = match need {
            Need::EachInV1(_) if subject.profile() != Profile::V1 => continue,
            Need::Each(codes) | Need::EachInV1(codes) => codes,
            _ => continue,
        };
        for code in codes {
            for part in outcomes.get(code).into_iter().flat_map(|ran| ran.faulted.parts()) {
                unsound.entry(*part).or_insert(*code);
            }
        }
    }
    judge(subject, rule, &mut Findings::default().within(Scope::without(unsound)))
}

/// Runs a rule's check, and leaves `findings` to the caller, without the findings that are returned.
fn judge(subject: Subject<'_>, rule: &'static Rule, findings: &mut Findings) -> Check {
    let judge = |findings: &mut Findings| match rule.check {
        CheckOf::Urdd(check) => check(subject.urdd?, findings),
        CheckOf::Robot(check) => check(&subject.described, findings),
    };
    let mut check = Check::caught(&rule.description, findings, judge);
    locate(subject, &mut check.findings);
    check
}

/// Why a need is not met; `None` if it is.
fn unmet(subject: Subject<'_>, need: Need, outcomes: &Outcomes) -> Option<SkipReason> {
    match need {
        // The URDF takes the module's place.
        Need::Module(ModuleKind::Urdf) | Need::SourceRobot
            if subject.described.module.is_none() && subject.described.mechanism.is_some() =>
        {
            None
        }
        // A URDF alone describes no robot where URD011 found a fault.
        Need::Module(ModuleKind::Urdf) | Need::SourceRobot if subject.urdd.is_none() => {
            unmet(subject, Need::Passed(Code::URD011), outcomes)
        }
        Need::SourceRobot => unmet(subject, Need::Module(ModuleKind::Urdf), outcomes),
        Need::Module(kind) => match subject.module(kind) {
            None => Some(SkipReason::absent(kind)),
            Some(module) => module.unusable().map(SkipReason::obstacle),
        },
        Need::ModuleV1(kind) => unmet(subject, Need::Module(kind), outcomes).or_else(|| {
            subject
                .module(kind)
                .is_some_and(Module::is_legacy)
                .then_some(skip::not_in_this_version(kind))
        }),
        Need::AnyModule(kinds) => {
            let usable = |kind: &ModuleKind| subject.module(*kind)?.document.as_ref();
            kinds.iter().find_map(usable).is_none().then(|| skip::none_usable(kinds))
        }
        Need::RootMetadata => match subject.urdd.and_then(|urdd| urdd.metadata()) {
            Some(_) => None,
            None => Some(skip::NO_ROOT_METADATA),
        },
        Need::UrdfFile if matches!(subject.described.urdf, Err(why) if why.is_too_large()) => None,
        Need::CarriedUrdf | Need::UrdfFile => {
            subject.described.urdf.err().map(|why| SkipReason::LeftOut(why.to_string().into()))
        }
        Need::All(needs) => needs.iter().find_map(|need| unmet(subject, *need, outcomes)),
        Need::NotFailedInV1(_) | Need::NoPieceInV1(_) | Need::EachInV1(_)
            if subject.profile() != Profile::V1 =>
        {
            None
        }
        Need::Each(codes) | Need::EachInV1(codes) => {
            codes.iter().find_map(|code| obstacle(outcomes, *code, Faulted::elsewhere))
        }
        Need::NoPieceInV1(code) => obstacle(outcomes, code, Faulted::has_pieces),
        Need::Passed(code) => match outcomes.get(&code).map(|ran| &ran.outcome) {
            Some(Outcome::Passed) => None,
            Some(Outcome::Failed) => Some(SkipReason::Failed(code)),
            Some(Outcome::Skipped(reason)) => Some(reason.clone()),
            Some(Outcome::Crashed(_)) => Some(SkipReason::Crashed(code)),
            None => Some(SkipReason::DidNotRun(code)),
        },
        Need::NotFailed(code) | Need::NotFailedInV1(code) => obstacle(outcomes, code, |_| true),
        Need::NoneFailed(codes) => {
            codes.iter().find_map(|code| obstacle(outcomes, *code, |_| true))
        }
        Need::Version1 => (subject.profile() != Profile::V1).then_some(skip::NOT_VERSION_1),
        Need::Legacy => (subject.profile() != Profile::Legacy).then_some(skip::NOT_LEGACY),
    }
}

/// Why another rule prevents this one: it crashed, or failed with faults that `matter`.
fn obstacle(
    outcomes: &Outcomes,
    code: Code,
    matter: impl Fn(&Faulted) -> bool,
) -> Option<SkipReason> {
    let ran = outcomes.get(&code)?;
    match ran.outcome {
        Outcome::Failed if matter(&ran.faulted) => Some(SkipReason::Failed(code)),
        Outcome::Crashed(_) => Some(SkipReason::Crashed(code)),
        _ => None,
    }
}
