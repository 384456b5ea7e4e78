//! `urdd explain`.

use clap::{Args, ValueEnum};
use serde_json::{Value, json};

use super::output::{self, Failure};
use urdd_findings::description::{Description, Family};
use urdd_format::escape;
use urdd_validate::code::RetiredCode;
use urdd_validate::report;
use urdd_validate::selection::Codes;

/// Arguments of `urdd explain`.
#[derive(Args)]
pub struct ExplainArguments {
    /// Code of a rule, such as DOF003, or its name; or a family, such as DOF. Default: lists every rule.
    rule: Option<String>,

    /// Output format.
    #[arg(long, value_enum, default_value_t = ExplainFormat::Human)]
    format: ExplainFormat,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ExplainFormat {
    /// Text for people.
    Human,
    /// JSON: an object for each rule.
    Json,
}

/// Maximum line length of an explanation on a terminal, in characters.
const WIDEST: usize = 100;

/// Runs `urdd explain`. Returns what to print.
pub fn run(arguments: &ExplainArguments) -> Result<String, Failure> {
    let mut wanted = all();
    if let Some(word) = &arguments.rule {
        let codes = word.parse::<Codes>().ok();
        wanted.retain(|(rule, _)| {
            rule.name == word || codes.is_some_and(|codes| codes.holds(rule.code))
        });
    }
    let one = arguments.rule.is_some() && wanted.len() == 1;
    Ok(match (&wanted[..], arguments.format) {
        ([], format) => without_rule(arguments.rule.as_deref().unwrap_or_default(), format)?,
        ([rule], ExplainFormat::Human) if one => in_full(rule),
        (rules, ExplainFormat::Human) => list(rules),
        ([rule], ExplainFormat::Json) if one => report::json(&as_json(rule))?,
        (rules, ExplainFormat::Json) => {
            report::json(&rules.iter().map(as_json).collect::<Vec<_>>())?
        }
    })
}

/// A rule to explain, and whether it is on by default.
type Explained = (&'static Description, bool);

/// The rules of `urdd validate`, then those that only `urdd lint` has.
fn all() -> Vec<Explained> {
    let (urdds, urdfs) = (urdd_validate::rules::all(), urdd_lint::rules::all());
    let of_urdds = urdds.into_iter().map(|rule| (&rule.description, true));
    let of_urdfs = urdfs.into_iter().map(|rule| (&rule.description, rule.on_by_default));
    of_urdds.chain(of_urdfs).collect()
}

/// Explains a retired code. Any other word is a usage error.
fn without_rule(wanted: &str, format: ExplainFormat) -> Result<String, Failure> {
    let retired = RetiredCode::parse(wanted).ok_or_else(|| {
        let word = escape::line(wanted);
        format!("unknown rule `{word}`; `urdd explain` without a code lists all rules")
    })?;
    let (code, reason) = (retired.code, retired.reason);
    Ok(match format {
        ExplainFormat::Human => {
            format!("{code} is retired: {reason}. The code is not used again.\n")
        }
        ExplainFormat::Json => report::json(&json!({ "code": code, "retired": reason }))?,
    })
}

fn list(rules: &[Explained]) -> String {
    let lengths = rules.iter().map(|(rule, _)| rule.name.len());
    let width = lengths.max().unwrap_or(0);
    let mut text = String::new();
    let mut above = None;
    for (rule, _) in rules {
        let family = Family::of(rule.code);
        if above.replace(family) != Some(family)
            && let Some(Family { code, name, about }) = family
        {
            let gap = if text.is_empty() { "" } else { "\n" };
            text += &format!("{gap}{code}, {name}: {about}\n");
        }
        let severity = rule.severity.as_str();
        let (code, name, summary) = (rule.code, rule.name, rule.summary());
        text += &format!("{code}  {severity:7}  {name:width$}  {summary}\n");
    }
    text
}

fn in_full((rule, is_on_by_default): &Explained) -> String {
    let (code, name, since) = (rule.code, rule.name, rule.since);
    let clause = rule.clause.map(|clause| format!("SPEC.md clause {clause}; "));
    let clause = clause.unwrap_or_default();
    let severity = rule.severity.as_str();
    let off = match is_on_by_default {
        true => "",
        false => "off unless --select or [severity] of urdd.toml names it; ",
    };
    let explanation = wrapped(&rule.explanation());
    format!("{code} {name}\n{severity}; {off}{clause}since urdd {since}\n\n{explanation}\n")
}

/// Wraps text to the width of the terminal; elsewhere leaves it unchanged.
fn wrapped(text: &str) -> String {
    let Some(width) = output::width() else {
        return text.to_owned();
    };
    let width = width.min(WIDEST);
    let paragraph = |text: &str| match text.starts_with("```") {
        true => text.to_owned(),
        false => items(text)
            .iter()
            .map(|item| {
                let hanging = if item.starts_with("- ") { "  " } else { "" };
                let options = textwrap::Options::new(width).subsequent_indent(hanging);
                textwrap::fill(item, options)
            })
            .collect::<Vec<_>>()
            .join("\n"),
    };
    let paragraphs: Vec<String> = text.split("\n\n").map(paragraph).collect();
    paragraphs.join("\n\n")
}

/// The items of a list, or the paragraph, each joined to one line.
fn items(text: &str) -> Vec<String> {
    let mut items: Vec<String> = Vec::new();
    for line in text.lines() {
        match items.last_mut() {
            Some(last) if !line.starts_with("- ") => {
                last.push(' ');
                last.push_str(line.trim());
            }
            _ => items.push(line.to_owned()),
        }
    }
    items
}

fn as_json((rule, is_on_by_default): &Explained) -> Value {
    let family = Family::of(rule.code);
    let family = family
        .map(|family| json!({ "code": family.code, "name": family.name, "about": family.about }));
    json!({
        "code": rule.code.as_str(),
        "family": family,
        "name": rule.name,
        "severity": rule.severity,
        "clause": rule.clause,
        "since": rule.since,
        "consequence": rule.consequence,
        "on_by_default": is_on_by_default,
        "summary": rule.summary(),
        "explanation": rule.explanation(),
    })
}
