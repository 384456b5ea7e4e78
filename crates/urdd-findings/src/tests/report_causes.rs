//! Findings with one cause.

use super::DESCRIPTION;
use crate::check::{Check, Outcome};
use crate::check::{Examined, blank};
use crate::finding::Finding;
use crate::report::summary::*;
use crate::run::Run;
use crate::settings::Settings;
use urdd_format::report::{Kind, Place, Severity};

#[test]
fn neither_words_nor_places_tell_causes_apart() {
    let robot = |name: &str| {
        let finding = |file: &str, message: &str| Finding::at(file, "/a", message);
        let mut lesser = finding("urdf_module/module.json", "the axis is long");
        lesser.severity = Some(Severity::Info);
        let findings = vec![
            finding("dof_module/module.json", &format!("`{name}` is lost")),
            finding("urdf_module/module.json", "the origin is lost"),
            lesser,
        ];
        let checks = vec![Check::new(&DESCRIPTION, Outcome::Failed, findings)];
        Examined { report: blank(Kind::Urdd, name), checks }
    };
    let run = Run::of(vec![robot("one"), robot("two")], Vec::new(), 0, &Settings::default());
    let found = causes(&run.report);
    let found: Vec<_> =
        found.iter().map(|cause| (cause.first.severity, cause.times, &cause.urdds[..])).collect();
    let both = &["one", "two"][..];
    assert_eq!(found, [(Severity::Error, 4, both), (Severity::Info, 2, both)]);
}

#[test]
fn a_pair_is_the_same_either_way_round() {
    let at = |subject: &str| Place { subject: Some(subject.to_owned()), ..Place::default() };
    let one = subject(&at("`b` piece 3, `a` piece 1"));
    assert_eq!(one.as_deref(), Some("`a`, `b`"));
    assert_eq!(one, subject(&at("`a`, `b`")));
}
