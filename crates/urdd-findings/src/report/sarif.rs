//! The report as SARIF 2.1.0, for GitHub code scanning, editors and other readers of that format.
//!
//! Contains only the rules that a result or a notification names. The limit of GitHub that a report can reach is 25,000
//! results per run: equal findings are one result with a count, and results are in the order of the URDDs.

use std::collections::{BTreeMap, HashMap};

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::human::macro_of;
use super::style::unverified;
use super::unexamined::{NOT_EXAMINED, own_file, place_in, unexamined};
use super::variants::Variants;
use crate::code::Code;
use crate::description::Description;
use crate::run::{Run, file_in, is_inside};
use urdd_format::escape;
use urdd_format::hexadecimal::hexadecimal;
use urdd_format::readable::number;
use urdd_format::report::{
    CheckStatus, Finding, Fix, MacroPlace, Place, Severity, Status, Urdd, WrittenAt,
};

/// Base of relative paths: the working directory, under the name that readers of SARIF use for the root of a
/// repository.
const BASE: &str = "%SRCROOT%";

/// Maximum number of related locations of a result: GitHub accepts 1,000 locations per result.
const MOST_LOCATIONS: usize = 999;

/// Characters to percent-encode in a URI reference: all except letters, digits and those removed here.
const KEPT: &AsciiSet =
    &NON_ALPHANUMERIC.remove(b'/').remove(b'-').remove(b'.').remove(b'_').remove(b'~');

/// Writes the report of a run. `places` are the folders of its URDDs (see [`super::place::places`]), `exit_code` is the
/// exit status of the program.
///
/// # Errors
/// Never for the report of a [`Run`].
pub fn sarif(run: &Run, places: &[String], exit_code: u8) -> serde_json::Result<String> {
    let report = &run.report;
    let rules = used(run);
    let placed = || report.urdds.iter().zip(places);
    let variants = Variants::new(report, Some(places));
    let results: Vec<Value> =
        (0..places.len()).flat_map(|robot| results((&variants, robot), places, &rules)).collect();
    let notifications: Vec<Value> =
        placed().flat_map(|(urdd, place)| notifications(urdd, place, &rules)).collect();
    let stale: Vec<Value> = report
        .stale_ignores
        .iter()
        .map(|ignore| {
            let text = format!(
                "the ignore of {} at `{}` in the settings matches nothing: remove it, or correct its path",
                ignore.code.as_deref().unwrap_or("all rules"),
                ignore.path
            );
            json!({"level": "warning", "message": message(&text)})
        })
        .collect();
    // Geometry or rates that were not verified do not make the run a failure.
    let failed = !notifications.is_empty();
    let unverified = placed().flat_map(|(urdd, place)| {
        unverified(urdd).into_iter().map(move |text| {
            json!({"level": "note", "message": message(&text), "locations": [folder(place)]})
        })
    });
    let notifications: Vec<Value> = notifications.into_iter().chain(unverified).collect();
    let mut driver = json!({
        "name": report.tool.name,
        "version": report.tool.version,
        "semanticVersion": report.tool.version,
    });
    let homepage = env!("CARGO_PKG_REPOSITORY");
    if !homepage.is_empty() {
        driver["informationUri"] = json!(homepage);
    }
    let mut descriptions: Vec<Value> = rules.values().map(|rule| describe(rule)).collect();
    let has_open = report.urdds.iter().any(|urdd| unexamined(urdd).is_some());
    descriptions.extend(has_open.then(describe_unexamined));
    driver["rules"] = json!(descriptions);
    let log = json!({
        "$schema": "https://docs.oasis-open.org/sarif/sarif/v2.1.0/os/schemas/sarif-schema-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": {"driver": driver},
            "invocations": [{
                "executionSuccessful": !failed,
                "exitCode": exit_code,
                "toolExecutionNotifications": notifications,
                "toolConfigurationNotifications": stale,
            }],
            "originalUriBaseIds": {
                BASE: {"description": {"text": "The folder in which urdd ran: the root of the repository."}},
            },
            "columnKind": "unicodeCodePoints",
            "properties": {"specVersion": report.spec_version},
            "results": results,
        }],
    });
    super::json(&log)
}

/// The rules that the report names, in order of code.
type Rules = BTreeMap<Code, &'static Description>;

fn used(run: &Run) -> Rules {
    let checks = run.report.urdds.iter().flat_map(|urdd| &urdd.checks);
    let used = checks
        .filter(|check| matches!(check.status, Status::Failed | Status::Crashed))
        .filter_map(|check| run.rule(&check.code));
    used.map(|rule| (rule.code, rule)).collect()
}

fn index(rules: &Rules, code: &str) -> Option<usize> {
    rules.keys().position(|known| known.as_str() == code)
}

fn describe(rule: &Description) -> Value {
    let clause = rule.clause.map(|clause| format!("SPEC.md, clause {clause}. "));
    let help = format!(
        "{}\n\n{}`urdd explain {}` says the same.",
        rule.explanation(),
        clause.unwrap_or_default(),
        rule.code
    );
    json!({
        "id": rule.code.as_str(),
        "name": rule.name,
        "shortDescription": {"text": rule.name.replace('-', " ")},
        "fullDescription": {"text": rule.summary()},
        "help": {"text": help, "markdown": help},
        "defaultConfiguration": {"level": level(rule.severity)},
        "properties": {
            "clause": rule.clause,
            "since": rule.since,
            "phase": format!("{:?}", rule.phase).to_lowercase(),
        },
    })
}

fn level(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Info => "note",
    }
}

fn results(
    (variants, robot): (&Variants<'_>, usize),
    places: &[String],
    rules: &Rules,
) -> Vec<Value> {
    let (urdd, place) = (variants.robot(robot), places[robot].as_str());
    let mut alike = HashMap::new();
    let result = |(own, finding): (usize, &Finding)| {
        let mut result = json!({
            "ruleId": finding.code,
            "ruleIndex": index(rules, &finding.code),
            "level": level(finding.severity),
            "message": message(&text(finding, &urdd.xacro_arguments, variants.words(robot, own))),
            "locations": finding.places.iter().take(1).map(|first| location(place, first)).collect::<Vec<_>>(),
        });
        let others = finding.places.iter().skip(1).take(MOST_LOCATIONS);
        let mut related: Vec<Value> = others.map(|other| related(place, other)).collect();
        let cut = finding.count.get().saturating_sub(1 + related.len());
        let room = MOST_LOCATIONS - related.len();
        let seen = finding.places.iter().flat_map(|here| &here.related);
        related.extend(seen.take(room).map(|other| {
            let mut location = location(place, other);
            let text = other.message.as_deref().unwrap_or_default();
            location["message"] = message(&escape::line(text));
            location
        }));
        let written = finding.places.first().and_then(|first| first.written_at.as_ref());
        let trail = written.into_iter().flat_map(|written| trail(place, written));
        related.extend(trail.take(MOST_LOCATIONS - related.len()).collect::<Vec<_>>());
        if !related.is_empty() {
            result["relatedLocations"] = json!(related);
        }
        let changes = finding.places.iter().flat_map(|here| &here.fixes);
        let fixes: Vec<Value> = changes.map(|fix| mend(place, fix)).collect();
        if !fixes.is_empty() {
            result["fixes"] = json!(fixes);
        }
        result["properties"] = json!({
            "consequence": finding.consequence.as_str(),
            "placesCut": cut,
        });
        if !finding.programs.is_empty() {
            result["properties"]["programs"] = json!(finding.programs);
        }
        result["occurrenceCount"] = json!(variants.count(robot, own));
        let kind = kind(finding, urdd, place);
        let nth = alike.entry(kind.clone()).or_insert(0);
        *nth += 1;
        result["partialFingerprints"] = json!({"urddFinding/v1": fingerprint(&kind, *nth)});
        result
    };
    let results = urdd.findings.iter().enumerate().map(result).enumerate();
    let shown = results.filter(|(own, _)| !variants.is_repeated(robot, *own));
    let mut results: Vec<Value> = shown.map(|(_, result)| result).collect();
    results.extend(unexamined(urdd).map(|why| {
        let with = urdd.xacro_arguments.join(" ");
        let with = if with.is_empty() { with } else { format!("\nWith: {}", escape::line(&with)) };
        let own = urdd.label_at(&file_in(place, own_file(urdd)));
        let kind = [UNEXAMINED.to_owned(), own, String::new()];
        json!({
            "ruleId": UNEXAMINED,
            "ruleIndex": rules.len(),
            "level": if why.is_asked_for { "error" } else { "warning" },
            "message": message(&(escape::line(&why.reason).into_owned() + &with)),
            "locations": [location(place, &place_in(urdd, place, why))],
            "partialFingerprints": {"urddFinding/v1": fingerprint(&kind, 1)},
        })
    }));
    results
}

/// The id of the results for what was not examined; no rule has it.
const UNEXAMINED: &str = "not-examined";

fn describe_unexamined() -> Value {
    let text = "Nothing is known of this robot: it was not examined, so it does not pass.";
    json!({
        "id": UNEXAMINED,
        "name": UNEXAMINED,
        "shortDescription": {"text": NOT_EXAMINED},
        "fullDescription": {"text": text},
        "help": {"text": text, "markdown": text},
        "defaultConfiguration": {"level": "error"},
    })
}

/// The whole finding as one text: few readers show other fields of a result.
fn text(finding: &Finding, arguments: &[String], variants: Option<String>) -> String {
    let mut text = escape::line(&finding.message).into_owned();
    let with = Some(arguments.join(" "));
    let with = with.filter(|text| !text.is_empty() && variants.is_none());
    let lines = [
        ("Expected", finding.expected.clone()),
        ("Found", finding.actual.clone()),
        ("Tolerance", finding.tolerance.map(|tolerance| number(tolerance, 2))),
        ("Of", finding.subject.clone()),
        ("With", with),
        ("In", variants),
        ("Macro", finding.places.first().and_then(macro_of).map(str::to_owned)),
        ("Times", Some(finding.count).filter(|count| count.get() > 1).map(|n| n.to_string())),
    ];
    for (label, value) in lines {
        if let Some(value) = value {
            text.push_str(&format!("\n{label}: {}", escape::line(&value)));
        }
    }
    text
}

/// A message, with link syntax broken up: names in a URDD are untrusted text.
fn message(text: &str) -> Value {
    json!({"text": escape::lines(text).replace("](", "] (")})
}

/// Identity of a finding. Does not change when lines move, when an element is inserted before, or when the wording of
/// the message changes.
fn kind(finding: &Finding, urdd: &Urdd, place: &str) -> [String; 3] {
    let what = match &finding.pointer {
        Some(pointer) => {
            let is_index = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
            let parts = pointer.split('/').map(|part| if is_index(part) { "" } else { part });
            parts.collect::<Vec<_>>().join("/")
        }
        None => finding.subject.clone().unwrap_or_default(),
    };
    // The element, not the literal that a value of it is from.
    let written = finding.places.first().and_then(|first| first.written_at.as_ref());
    let used_at = written.and_then(|written| written.used_at.as_ref());
    let file = used_at.map(|used_at| used_at.file.as_str()).or(finding.file.as_deref());
    let file = urdd.label_at(&file_in(place, file));
    [finding.code.clone(), file, what]
}

fn fingerprint(kind: &[String; 3], nth: u32) -> String {
    let digest = Sha256::digest(format!("{}\n{nth}", kind.join("\n")));
    hexadecimal(&digest[..16])
}

/// A related location of a result, with the value found there.
fn related(urdd: &str, other: &Place) -> Value {
    let mut location = location(urdd, other);
    let parts = [
        other.subject.clone(),
        other.actual.clone(),
        other
            .magnitude
            .as_ref()
            .map(|magnitude| format!("off by {}", super::human::off_by(magnitude))),
    ];
    let text: Vec<String> = parts.into_iter().flatten().collect();
    if !text.is_empty() {
        location["message"] = message(&escape::line(&format!("Here too: {}", text.join("; "))));
    }
    location
}

/// Where the value of a place is used, and the calls of macros by which xacro came there.
fn trail(urdd: &str, written: &WrittenAt) -> impl Iterator<Item = Value> {
    let at = |here: &MacroPlace, text: String| {
        let file = Some(here.file.clone());
        let here =
            Place { file, line: Some(here.line), column: Some(here.column), ..Place::default() };
        let mut location = location(urdd, &here);
        location["message"] = message(&escape::line(&text));
        location
    };
    let used_at = written.used_at.iter().map(move |here| match &here.macro_name {
        Some(name) => at(here, format!("The value is used here, in the macro `{name}`")),
        None => at(here, "The value is used here".to_owned()),
    });
    let calls = written.calls.iter().map(move |here| {
        at(
            here,
            format!(
                "The macro `{}` is called here",
                here.macro_name.as_deref().unwrap_or_default()
            ),
        )
    });
    used_at.chain(calls)
}

/// A fix: the edits of a file together, as the format asks.
fn mend(urdd: &str, fix: &Fix) -> Value {
    let mut by_file: BTreeMap<&str, Vec<Value>> = BTreeMap::new();
    for edit in &fix.edits {
        by_file.entry(&edit.file).or_default().push(json!({
            "deletedRegion": {
                "startLine": edit.line.get(),
                "startColumn": edit.column.get(),
                "endLine": edit.end_line.get(),
                "endColumn": edit.end_column.get(),
            },
            "insertedContent": {"text": edit.text},
        }));
    }
    let changes = by_file.into_iter().map(|(file, replacements)| {
        json!({"artifactLocation": artifact(urdd, Some(file)), "replacements": replacements})
    });
    json!({
        "description": message(&escape::line(&fix.message)),
        "artifactChanges": changes.collect::<Vec<_>>(),
    })
}

fn location(urdd: &str, place: &Place) -> Value {
    let mut physical = json!({"artifactLocation": artifact(urdd, place.file.as_deref())});
    if let Some(line) = place.line.filter(|_| is_inside(urdd, place.file.as_deref())) {
        physical["region"] = json!({"startLine": line.get()});
        if let Some(column) = place.column {
            physical["region"]["startColumn"] = json!(column.get());
        }
    }
    let mut location = json!({"physicalLocation": physical});
    if let Some(pointer) = place.pointer.as_deref().filter(|text| !text.is_empty()) {
        location["logicalLocations"] = json!([{"fullyQualifiedName": pointer}]);
    }
    location
}

fn folder(urdd: &str) -> Value {
    location(urdd, &Place::default())
}

fn artifact(urdd: &str, file: Option<&str>) -> Value {
    let path = file_in(urdd, file);
    json!({"uri": utf8_percent_encode(&path, KEPT).to_string(), "uriBaseId": BASE})
}

/// The errors that prevented a full examination of a URDD.
fn notifications(urdd: &Urdd, place: &str, rules: &Rules) -> Vec<Value> {
    let locations = [folder(place)];
    let mut notifications = Vec::new();
    if let Some(why) = &urdd.not_examined {
        let text = format!("{NOT_EXAMINED}: {}", why.reason);
        let level = if why.is_asked_for { "error" } else { "warning" };
        notifications
            .push(json!({"level": level, "message": message(&text), "locations": locations}));
    }
    let crashed = |check: &&CheckStatus| check.status == Status::Crashed;
    for check in urdd.checks.iter().filter(crashed) {
        let text = format!(
            "{} crashed and checked nothing: {}. Please report this.",
            check.code,
            check.reason.as_deref().unwrap_or_default()
        );
        notifications.push(json!({
            "level": "error",
            "message": message(&text),
            "locations": locations,
            "associatedRule": {"id": check.code, "index": index(rules, &check.code)},
        }));
    }
    notifications
}
