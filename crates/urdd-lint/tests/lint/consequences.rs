//! One fault gives one message: what follows from another finding is left out where that one is reported.

use std::fs;

use super::{codes, linted, written};
use urdd_findings::baseline::Baseline;
use urdd_format::report::{Finding, Severity};
use urdd_lint::LintSettings;

/// A robot without a fault.
const ARM: &str = include_str!("../cases/LNT040/near_miss.urdf");
/// Without a number of its inertia, which LNT008 says, because of a misspelling.
const MISSPELT: (&str, &str) = ("ixz=", "ixzz=");

fn with(changes: &[(&str, &str)]) -> String {
    let mut text = ARM.to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    text
}

/// What is found in a text.
fn found(text: &str, settings: &LintSettings) -> Vec<Finding> {
    let (_folder, file) = written(text);
    linted(&file, settings).report.urdds.remove(0).findings
}

/// The codes and severities of what is found in a text.
fn kinds(text: &str, settings: &LintSettings) -> Vec<(String, Severity)> {
    let found = found(text, settings).into_iter();
    found.map(|finding| (finding.code, finding.severity)).collect()
}

fn is(code: &str, severity: Severity) -> (String, Severity) {
    (code.to_owned(), severity)
}

#[test]
fn the_cause_names_what_follows_and_is_as_severe() {
    let finding = found(&with(&[MISSPELT]), &LintSettings::default()).remove(0);
    assert_eq!(finding.severity, Severity::Error);
    assert_eq!(finding.default_severity, Severity::Warning);
    assert_eq!(finding.line.map(|line| line.get()), Some(5));
    let [effect] = &finding.places[0].related[..] else {
        panic!("{finding:#?}");
    };
    let message = effect.message.as_deref().unwrap_or_default();
    assert!(message.starts_with("LNT008 "), "{message}");
    assert_eq!(effect.line.map(|line| line.get()), Some(3));
    for (change, severity) in [
        (("<limit ", "<limits "), Severity::Error),
        (("<axis ", "<axsi "), Severity::Warning),
        (("effort=", "efort="), Severity::Error),
        (("<parent ", "<parnt "), Severity::Error),
    ] {
        let kinds = kinds(&with(&[change]), &LintSettings::default());
        assert_eq!(kinds, [is("LNT040", severity)], "{change:?}");
    }
}

#[test]
fn each_misspelling_speaks_for_itself() {
    let text = with(&[("<limit ", "<limits "), ("<axis ", "<axsi "), MISSPELT]);
    let found = found(&text, &LintSettings::default());
    let places = found.iter().flat_map(|finding| &finding.places);
    let mut effects: Vec<(usize, String)> = Vec::new();
    for place in places {
        let [effect] = &place.related[..] else {
            panic!("{place:#?}");
        };
        let code = effect.message.as_deref().and_then(|text| text.get(..6));
        let line = place.line.map_or(0, |line| line.get());
        effects.push((line, code.unwrap_or_default().to_owned()));
    }
    effects.sort();
    let expected = [(5, "LNT008"), (14, "LNT016"), (15, "LNT017")];
    assert_eq!(effects, expected.map(|(line, code)| (line, code.to_owned())));
}

#[test]
fn another_fault_of_the_same_element_is_reported() {
    let limit = "    <limit lower=\"-2\" upper=\"2\" effort=\"10\" jerk=\"10\" velocity=\"1\"/>\n";
    for (changes, other) in [
        (&[("<axis ", "<axsi "), (limit, "")][..], "LNT017"),
        (&[MISSPELT, (" iyz=\"0\"", "")], "LNT008"),
        (&[("<axis xyz=\"0 0 1\"/>", "<axsi/>")], "LNT016"),
    ] {
        let found = found(&with(changes), &LintSettings::default());
        let mut codes: Vec<&str> = found.iter().map(|one| one.code.as_str()).collect();
        codes.sort_unstable();
        let mut expected = ["LNT040", other];
        expected.sort_unstable();
        assert_eq!(codes, expected, "{changes:?}");
    }
}

#[test]
fn what_follows_is_reported_where_the_cause_is_not() {
    let text = with(&[MISSPELT]);
    let effect = [is("LNT008", Severity::Error)];
    let mut ignored = LintSettings::default();
    ignored.report.selection.ignore = vec!["LNT040".parse().expect("a code")];
    assert_eq!(kinds(&text, &ignored), effect);
    let mut selected = LintSettings::default();
    selected.report.selection.select = vec!["LNT008".parse().expect("a code")];
    assert_eq!(kinds(&text, &selected), effect);
    let toml = "[[ignore]]\ncode = \"LNT040\"\npath = \"*.urdf\"\nreason = \"known\"";
    let by_file = LintSettings {
        report: urdd_findings::settings::Settings::from_toml(toml).expect("settings"),
        ..LintSettings::default()
    };
    assert_eq!(kinds(&text, &by_file), effect);
    let allowed = text.replace("<inertia ", "<!-- urdd: allow LNT040 --><inertia ");
    assert_eq!(kinds(&allowed, &LintSettings::default()), effect);
    let both = text.replace("<inertial>", "<!-- urdd: allow LNT040, LNT008 --><inertial>");
    assert_eq!(kinds(&both, &LintSettings::default()), []);
}

#[test]
fn settings_say_how_severe_both_are() {
    let text = with(&[MISSPELT]);
    for (code, severity, expected) in
        [("LNT008", Severity::Info, Severity::Warning), ("LNT040", Severity::Info, Severity::Error)]
    {
        let mut settings = LintSettings::default();
        let code = urdd_findings::code::Code::parse(code).expect("a code");
        settings.report.severities.insert(code, severity);
        assert_eq!(kinds(&text, &settings), [is("LNT040", expected)], "{code}");
    }
}

#[test]
fn a_baseline_with_the_cause_leaves_out_what_follows() {
    let (folder, file) = written(&with(&[MISSPELT]));
    let run = linted(&file, &LintSettings::default());
    let baseline = Baseline::of(&run, folder.path());
    let settings = LintSettings { baseline: Some(baseline.into()), ..LintSettings::default() };
    let run = linted(&file, &settings);
    assert_eq!((codes(&run), run.report.stale_ignores), (vec![], vec![]));
    fs::write(&file, ARM.replacen(" ixz=\"0\"", "", 1)).expect("written");
    assert_eq!(codes(&linted(&file, &settings)), ["LNT008"], "another fault");
}
