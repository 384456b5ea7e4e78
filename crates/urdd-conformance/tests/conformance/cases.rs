//! Every case, from the data.

use std::collections::BTreeSet;
use std::sync::Arc;

use rayon::prelude::*;
use testkit::repository;
use testkit::trials::sample;
use urdd_conformance::suite::{Case, CaseKind, Suite, Verdict};
use urdd_conformance::tree::{Node, Tree, TreeError};
use urdd_directory::source::Memory;
use urdd_findings::description::Severity;
use urdd_format::report::Report;
use urdd_validate::settings::Settings;
use urdd_validate::{rules, validate, validate_source};

use crate::{judge, suite};

/// A case as files in memory, which takes a third of the time. `None` if it has what only a disk holds: links, empty
/// folders, files beside the URDD, odd names.
fn in_memory(tree: &Tree) -> Option<Memory> {
    let files = tree.nodes.iter().map(|(path, node)| match node {
        Node::File(bytes) => Some((path.as_str()?.to_owned(), Arc::clone(bytes))),
        Node::Link(_) | Node::Folder => None,
    });
    Memory::new("robot", files.collect::<Option<_>>()?).ok()
}

/// The validator's findings in a case; `None` if this system cannot store it on disk.
fn report(case: &Case, suite: &Suite) -> Option<Report> {
    let tree = suite.tree(case).unwrap_or_else(|error| panic!("{error}"));
    if let (Some(source), None) = (in_memory(&tree), case.packed) {
        let run = validate_source(source, "robot", &Settings::default()).expect("not cancelled");
        return Some(run.report);
    }
    let folder = testkit::temporary::folder();
    let root = folder.path().join(case.urdd());
    match case.write(&tree, &root) {
        Ok(()) => {}
        Err(TreeError::Unsupported(_)) if !cfg!(target_os = "linux") => return None,
        Err(error) => panic!("{}: {error}", case.id()),
    }
    let run = validate(&[&root], &Settings::default()).expect("something to examine");
    Some(run.report)
}

/// Every ninth case; every case where `URDD_TRIALS` is at least 5.
#[test]
fn cases_are_judged_as_they_say() {
    let suite = suite();
    assert!(suite.cases.len() > 500, "{} cases", suite.cases.len());
    let cases: Vec<&Case> = sample(&suite.cases, 9).collect();
    let differences = cases.par_iter().filter_map(|case| {
        let report = report(case, &suite)?;
        judge::difference(case, &report)
    });
    let wrong: Vec<String> = differences.collect();
    assert!(wrong.is_empty(), "{} cases are judged wrong:\n{}", wrong.len(), wrong.join("\n"));
}

/// In hundreds, so that a new case does not change them. `URDD_UPDATE=1` writes the number of cases.
#[test]
fn the_pages_say_how_much_there_is() {
    let said = |hundreds: usize| format!("more than {hundreds}00 cases");
    let hundreds = suite().cases.len() / 100;
    let cases = said(hundreds);
    let robots = match suite().data.robots().len() {
        9 => "nine robots",
        others => panic!("{others} robots; the pages say nine"),
    };
    for page in ["README.md", "conformance/README.md"] {
        let mut text = std::fs::read_to_string(repository().join(page)).expect(page);
        if std::env::var_os("URDD_UPDATE").is_some() {
            let before = (0..hundreds).map(said);
            text = before.fold(text, |text, before| text.replace(&before, &cases));
            std::fs::write(repository().join(page), &text).expect(page);
        }
        for words in [cases.as_str(), robots] {
            assert!(text.contains(words), "{page} does not say `{words}`; URDD_UPDATE=1 writes it");
        }
    }
}

#[test]
fn a_case_is_of_one_rule() {
    let rules = rules::all();
    for case in suite().cases {
        let id = case.id();
        let rule = rules.iter().find(|rule| rule.code.as_str() == case.code);
        let rule = rule.unwrap_or_else(|| panic!("{id}: there is no such rule"));
        let others = case.expected.iter().filter(|one| one.code != case.code);
        assert_eq!(others.count(), 0, "{id}: another rule finds something too");
        assert_eq!(case.expected.is_empty(), case.kind == CaseKind::NearMiss, "{id}");
        let rejected = case.kind == CaseKind::Invalid && rule.severity == Severity::Error;
        assert_eq!(case.verdict == Verdict::Reject, rejected, "{id}");
        let near = if case.kind == CaseKind::NearMiss { "near " } else { "" };
        let title = format!("{near}{}: {}", rule.name, case.name.replace('-', " "));
        assert_eq!(case.title, title, "{id}: its file says the name of the rule");
    }
}

#[test]
fn every_rule_has_an_invalid_case_and_a_near_miss() {
    let cases = suite().cases;
    let of = |kind| -> BTreeSet<String> {
        let of_kind = cases.iter().filter(|case| case.kind == kind);
        of_kind.map(|case| case.code.clone()).collect()
    };
    let all: BTreeSet<String> = rules::all().iter().map(|rule| rule.code.to_string()).collect();
    assert_eq!(of(CaseKind::Invalid), all);
    assert_eq!(of(CaseKind::NearMiss), all);
}

#[test]
fn every_base_is_used() {
    let suite = suite();
    let used: BTreeSet<&String> = suite.cases.iter().map(|case| &case.base).collect();
    assert_eq!(used, suite.bases.keys().collect());
}

/// What is wrong with a file of cases, or a case, is said with its place.
#[test]
fn a_wrong_case_says_what_is_wrong() {
    let file = |case: &str| {
        format!(r#"{{"rule": "r", "verdict": "reject", "near_misses": [{{"name": "a", {case}}}]}}"#)
    };
    let error = |text: String, base: &str| {
        let files = [("cases/DOF001.json", text.as_str()), ("bases/toy/robot/a.txt", base)];
        let files = files.map(|(path, text)| (path.to_owned(), text.as_bytes().to_vec()));
        match Suite::of(files.into()) {
            Err(error) => error.to_string(),
            Ok(suite) => suite.tree(&suite.cases[0]).expect_err("it does not fit").to_string(),
        }
    };
    let change = |change: &str| file(&format!(r#""base": "toy", "changes": [{{{change}}}]"#));
    for (text, words) in [
        (file(r#""base": "toy", "cahnges": []"#), "cases/DOF001.json: unknown field `cahnges`"),
        (file(r#""changes": []"#), "missing field `base` at line 1"),
        (file(r#""base": "tyo""#), r#"DOF001/a: there is no base "tyo"; `bases/` has toy"#),
        (
            change(r#""file": "a.txt", "wirte": "b""#),
            "wirte of a.txt: unknown variant `wirte`, expected one of `patch`",
        ),
        (
            change(r#""file": "a.txt", "write": "b", "delete": true"#),
            "a change of a.txt needs one action beside `file`, and has {write, delete}",
        ),
        (
            change(r#""file": "a.txt", "patch": [{"op": "set", "path": "/a"}]"#),
            "patch of a.txt: unknown variant `set`",
        ),
        (
            change(r#""file": "a.txt", "patch": [{"op": "remove", "path": "/b"}]"#),
            "DOF001/a: a.txt: operation '/0' failed at path '/b'",
        ),
        (
            change(r#""file": "a.txt", "replace": {"from": "z", "by": "y"}"#),
            r#"DOF001/a: a.txt: the text "z" was not found"#,
        ),
        (
            file(r#""base": "toy"}, {"name": "a", "base": "toy""#),
            "DOF001/a: two cases have this name",
        ),
    ] {
        let error = error(text, r#"{"a": 1}"#);
        assert!(error.contains(words), "{error}\nhas not: {words}");
    }
}
