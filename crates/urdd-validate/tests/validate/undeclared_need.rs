//! A rule that uses data without declaring the need is detected, and never counts as passed.

use testkit::fixture::{Fixture, toy_robot};
use testkit::folder::Folder;
use urdd_document::urdd::Urdd;
use urdd_findings::check::Outcome;
use urdd_findings::description::{Consequence, Description, Phase, Severity};
use urdd_findings::finding::Findings;
use urdd_findings::part::SkipReason;
use urdd_validate::code::Code;
use urdd_validate::context::Context;
use urdd_validate::rule::{CheckOf, Need, Rule};
use urdd_validate::rules;
use urdd_validate::settings::Settings;

static FORGETFUL: Rule = Rule {
    description: Description {
        code: Code::TST001,
        name: "takes-the-composition",
        severity: Severity::Error,
        clause: Some("13.1"),
        since: "0.2.0",
        consequence: Consequence::Format,
        phase: Phase::References,
        doc: &[" Takes a module that it does not need."],
    },
    needs: &[],
    check: CheckOf::Urdd(|context, _| {
        context.document(urdd_format::registry::ModuleKind::Composition)?;
        Some(())
    }),
};

#[test]
fn a_forgotten_need_is_caught() {
    let mut folder = Folder::new();
    let mut urdd = Fixture::core(&toy_robot());
    urdd.seal();
    let path = folder.put(&urdd);
    let urdd = Urdd::read(path).unwrap();
    let examined = urdd_validate::examine(urdd, "toy", &Settings::default(), &[&FORGETFUL]);
    match &examined.checks[0].outcome {
        Outcome::Crashed(message) if cfg!(debug_assertions) => {
            assert!(message.starts_with("TST001 takes"), "{message}");
        }
        Outcome::Skipped(SkipReason::UndeclaredNeed) if !cfg!(debug_assertions) => {}
        other => panic!("{other:?}"),
    }
    assert!(SkipReason::UndeclaredNeed.is_obstacle());
}

/// Without its needs, no rule passes on an empty URDD: a forgotten need is always detected.
#[test]
fn every_rule_takes_what_it_needs() {
    let empty = testkit::temporary::folder();
    let context = Context::new(Urdd::read(empty.path()).unwrap(), None, &Settings::default());
    let mut passed = Vec::new();
    for rule in rules::all() {
        // These read `urdf_module` only in legacy URDDs.
        if [Code::MSH005, Code::LEG007].contains(&rule.code) {
            continue;
        }
        if rule.needs.iter().any(is_of_document) {
            let mut findings = Findings::default();
            let passes = match rule.check {
                CheckOf::Urdd(check) => check(&context, &mut findings),
                CheckOf::Robot(check) => check(&context.described(), &mut findings),
            };
            if passes.is_some() {
                passed.push(rule.code);
            }
        }
    }
    assert_eq!(passed, []);
}

/// Whether a URDD without any files fails to meet the need.
fn is_of_document(need: &Need) -> bool {
    match need {
        Need::Module(_) | Need::ModuleV1(_) | Need::RootMetadata => true,
        Need::CarriedUrdf | Need::UrdfFile => true,
        Need::All(needs) => needs.iter().any(is_of_document),
        _ => false,
    }
}
