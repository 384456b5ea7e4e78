//! Cases about what cannot be read, judged by our validator.

use rayon::prelude::*;
use urdd_conformance::suite::{Case, CaseKind, Suite, Verdict};
use urdd_conformance::tree::Node;
use urdd_format::report::Report;
use urdd_validate::settings::Settings;
use urdd_validate::{ValidateError, validate};

use crate::{judge, suite};

/// The report on a case; `None` where nothing was there to examine.
fn report(case: &Case, suite: &Suite) -> Option<Report> {
    let tree = suite.tree(case).unwrap_or_else(|error| panic!("{error}"));
    let folder = testkit::temporary::folder();
    let root = folder.path().join(case.urdd());
    case.write(&tree, &root).unwrap_or_else(|error| panic!("{}: {error}", case.id()));
    match validate(&[&root], &Settings::default()) {
        Ok(run) => Some(run.report),
        Err(ValidateError::Discover(_)) => None,
        Err(error) => panic!("{}: {error}", case.id()),
    }
}

#[test]
fn cases_are_judged_as_they_say() {
    let suite = suite();
    let differences = suite.unreadable.par_iter().filter_map(|case| {
        let report = report(case, &suite);
        let verdict = report.as_ref().map_or(Verdict::Unreadable, judge::verdict);
        let found: Vec<String> =
            report.iter().flat_map(|report| judge::found("", report)).map(|one| one.code).collect();
        // Kinematics samples are recommended, and the smallest base has them.
        let is_right = verdict == case.verdict && found.is_empty();
        let reason = report.and_then(|report| report.urdds[0].reason.clone());
        println!("{} {verdict:?} {found:?} {}", case.id(), reason.as_deref().unwrap_or_default());
        (!is_right).then(|| format!("{}: {verdict:?} with {found:?}", case.id()))
    });
    let wrong: Vec<String> = differences.collect();
    assert!(wrong.is_empty(), "{} cases are judged wrong:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn each_clause_has_cases_and_near_misses() {
    for clause in ["2.2", "2.14", "13.1"] {
        for kind in [CaseKind::Invalid, CaseKind::NearMiss] {
            let words = format!("(SPEC {clause}):");
            let mut cases = suite().unreadable.into_iter();
            let is_of = |case: &Case| case.kind == kind && case.title.contains(&words);
            assert!(cases.any(|case| is_of(&case)), "{clause}: {kind:?}");
        }
    }
}

/// An archive that says what it should not is said with the entry that is missing.
#[test]
fn an_entry_that_is_not_there_is_named() {
    let mut suite = suite();
    let name = "checksum-of-another-file";
    let case = suite.unreadable.iter_mut().find(|case| case.name == name).expect("a case");
    case.changes.clear();
    let case = case.clone();
    let folder = testkit::temporary::folder();
    let tree = suite.tree(&case).expect("a base");
    let error = case.write(&tree, &folder.path().join("robot.zip")).expect_err("no notes.txt");
    assert!(error.to_string().contains("\"notes.txt\""), "{error}");
}

/// SPEC 13.1: files of 64 MiB and 250 times the archive's size, within 1 %.
#[test]
fn sizes_are_just_on_each_side() {
    let suite = suite();
    for (name, is_beyond) in [("beyond-archive-sizes", true), ("within-archive-sizes", false)] {
        let case = suite.unreadable.iter().find(|case| case.name == name).expect("a case");
        let tree = suite.tree(case).expect("a base");
        let folder = testkit::temporary::folder();
        let path = folder.path().join("robot.zip");
        case.write(&tree, &path).expect("written");
        let files = tree.nodes.values().map(|node| match node {
            Node::File(content) => content.len() as f64,
            Node::Link(_) | Node::Folder => 0.0,
        });
        let packed = std::fs::metadata(&path).expect("an archive").len() as f64;
        let share = files.sum::<f64>() / (f64::from(64 << 20) + 250.0 * packed);
        assert_eq!(share > 1.0, is_beyond, "{name}: {share}");
        assert!((share - 1.0).abs() < 0.01, "{name}: {share}");
    }
}
