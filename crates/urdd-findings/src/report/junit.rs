//! The report as JUnit XML, for GitLab, Jenkins, GitHub Actions and other viewers of test results: one suite per URDD,
//! one case per rule.
//!
//! A case fails on findings at or above the severity at which the run fails. Lesser findings are in the output of a
//! passed case.

use std::cmp::Reverse;
use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use super::{human, unexamined};
use crate::run::Run;
use urdd_format::escape;
use urdd_format::report::{CheckStatus, Finding, Severity, Status, Urdd};

type Out = Writer<Vec<u8>>;

/// Writes the report of a run that fails on findings of `fail_on` and worse. `places` are the folders of its URDDs (see
/// [`super::place::places`]).
///
/// # Errors
/// Never: it is written to memory.
pub fn junit(run: &Run, places: &[String], fail_on: Severity) -> io::Result<String> {
    let report = &run.report;
    let urdds = report.urdds.iter().zip(places);
    let suites: Vec<Suite> =
        urdds.map(|(urdd, place)| Suite::new(run, urdd, place, fail_on)).collect();
    let sum = |count: fn(&Suite) -> usize| suites.iter().map(count).sum::<usize>().to_string();
    let mut out = Writer::new_with_indent(Vec::new(), b' ', 2);
    out.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    out.create_element("testsuites")
        .with_attributes([
            ("name", report.tool.name.as_str()),
            ("tests", &sum(|suite| suite.cases.len())),
            ("failures", &sum(|suite| suite.count("failure"))),
            ("errors", &sum(|suite| suite.count("error"))),
        ])
        .write_inner_content(|out| suites.iter().try_for_each(|suite| suite.write(out)))?;
    Ok(String::from_utf8_lossy(&out.into_inner()).into_owned() + "\n")
}

struct Suite {
    name: String,
    cases: Vec<Case>,
}

struct Case {
    name: String,
    /// The result element, with its type, message and text; `None` for a passed case.
    outcome: Option<(&'static str, String, String, String)>,
    /// Findings of a passed case.
    output: String,
}

impl Suite {
    fn new(run: &Run, urdd: &Urdd, place: &str, fail_on: Severity) -> Suite {
        let checks = urdd.checks.iter();
        let case = |check| case(run, urdd, check, fail_on);
        let mut cases: Vec<Case> = checks.map(case).collect();
        if let Some(why) = &urdd.not_examined {
            let element = if why.is_asked_for { "error" } else { "skipped" };
            let at = unexamined::words(why).map(|at| format!("{at}: ")).unwrap_or_default();
            let text = allowed(&(at + &why.reason));
            let outcome = (element, why.cause.as_str().to_owned(), text, String::new());
            cases.push(Case {
                name: "it was examined".to_owned(),
                outcome: Some(outcome),
                output: String::new(),
            });
        }
        let name = match place {
            "" => urdd.path.as_str(),
            place => place,
        };
        Suite { name: allowed(&urdd.label_at(name)), cases }
    }

    fn count(&self, element: &str) -> usize {
        let outcomes = self.cases.iter().filter_map(|case| case.outcome.as_ref());
        outcomes.filter(|(name, ..)| *name == element).count()
    }

    fn write(&self, out: &mut Out) -> io::Result<()> {
        out.create_element("testsuite")
            .with_attributes([
                ("name", self.name.as_str()),
                ("tests", &self.cases.len().to_string()),
                ("failures", &self.count("failure").to_string()),
                ("errors", &self.count("error").to_string()),
                ("skipped", &self.count("skipped").to_string()),
            ])
            .write_inner_content(|out| {
                self.cases.iter().try_for_each(|case| case.write(&self.name, out))
            })?;
        Ok(())
    }
}

impl Case {
    fn write(&self, suite: &str, out: &mut Out) -> io::Result<()> {
        let element = out
            .create_element("testcase")
            .with_attributes([("classname", suite), ("name", &self.name)]);
        if let Some((name, kind, message, text)) = &self.outcome {
            element.write_inner_content(|out| {
                let outcome = out
                    .create_element(*name)
                    .with_attributes([("type", kind.as_str()), ("message", message)]);
                match text.is_empty() {
                    true => outcome.write_empty()?,
                    false => outcome.write_text_content(BytesText::new(text))?,
                };
                Ok(())
            })?;
        } else if self.output.is_empty() {
            element.write_empty()?;
        } else {
            element.write_inner_content(|out| {
                out.create_element("system-out")
                    .write_text_content(BytesText::new(&self.output))?;
                Ok(())
            })?;
        }
        Ok(())
    }
}

fn case(run: &Run, urdd: &Urdd, check: &CheckStatus, fail_on: Severity) -> Case {
    let findings: Vec<&Finding> =
        urdd.findings.iter().filter(|finding| finding.code == check.code).collect();
    let text: String = findings.iter().map(|finding| described(finding)).collect();
    let worst = findings.iter().min_by_key(|finding| Reverse(finding.severity));
    let reason = || allowed(check.reason.as_deref().unwrap_or_default());
    let plain = |element, kind: &str| Some((element, kind.to_owned(), reason(), String::new()));
    let outcome = match (check.status, worst) {
        (Status::Failed, Some(worst)) if worst.severity >= fail_on => Some((
            "failure",
            worst.severity.as_str().to_owned(),
            allowed(&worst.message),
            text.clone(),
        )),
        (Status::Passed | Status::Failed, _) => None,
        (Status::Skipped, _) => plain("skipped", "skipped"),
        (Status::Crashed, _) => plain("error", "crashed"),
    };
    let name = run.rule(&check.code).map_or("", |rule| rule.name);
    Case {
        // The same on every run, so that a case can be followed through runs.
        name: format!("{} {name}", check.code),
        output: match outcome {
            None => text,
            Some(_) => String::new(),
        },
        outcome,
    }
}

/// A finding as in the report for people, without the margin.
fn described(finding: &Finding) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = human::write_finding(finding, super::style::Style::default(), &mut text);
    let lines = text.lines().map(|line| line.strip_prefix("    ").unwrap_or(line));
    escape::lines(&(lines.collect::<Vec<_>>().join("\n") + "\n")).into_owned()
}

/// Escapes characters that XML 1.0 cannot represent, and those that viewers would interpret.
fn allowed(text: &str) -> String {
    escape::line(text).into_owned()
}
