//! Formats the result as a table or JSON.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::outcome::{Outcome, Trial};
use super::plan::Plan;
use super::result::{Measured, Tally};

/// Number of survivors per field in the table.
const SHOWN: usize = 3;

/// A table by module for each URDD, followed by the survivors by field.
pub fn table(measured: &[Measured]) -> String {
    let mut text = String::new();
    for urdd in measured {
        text += &format!("{}\n", urdd.name);
        let modules = urdd.modules();
        let deep = modules.iter().any(|module| module.deep.is_some());
        let mut rows = vec![heading(deep)];
        for module in &modules {
            rows.push(row(&module.module, &module.plain, module.deep.as_ref()));
        }
        let plain = sum(modules.iter().map(|module| module.plain));
        let of_deep = sum(modules.iter().filter_map(|module| module.deep));
        rows.push(row("all", &plain, deep.then_some(&of_deep)));
        text += &aligned(&rows);
        text += &survivors(urdd);
        text += "\n";
    }
    text
}

fn heading(deep: bool) -> Vec<String> {
    let mut cells = vec!["module", "changes", "noticed", "warned", "missed", "rate"];
    if deep {
        cells.extend(["deep: noticed", "warned", "missed", "rate"]);
    }
    cells.into_iter().map(str::to_owned).collect()
}

fn row(name: &str, plain: &Tally, deep: Option<&Tally>) -> Vec<String> {
    let mut cells = vec![name.to_owned(), plain.changes.to_string()];
    for tally in std::iter::once(plain).chain(deep) {
        cells.extend([tally.noticed, tally.warned, tally.missed].map(|count| count.to_string()));
        cells.push(percent(tally.rate()));
    }
    cells
}

/// A rate in percent, rounded down.
fn percent(rate: f64) -> String {
    format!("{:.2} %", (rate * 10_000.0).floor() / 100.0)
}

fn sum(tallies: impl Iterator<Item = Tally>) -> Tally {
    tallies.fold(Tally::default(), |mut sum, tally| {
        sum.changes += tally.changes;
        sum.noticed += tally.noticed;
        sum.warned += tally.warned;
        sum.missed += tally.missed;
        sum
    })
}

fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let cells = row.iter().enumerate().map(|(column, cell)| match column {
            0 => format!("{cell:<width$}", width = widths[0]),
            _ => format!("{cell:>width$}", width = widths[column]),
        });
        text += &format!("  {}\n", cells.collect::<Vec<_>>().join("  ").trim_end());
    }
    text
}

/// The survivors by field: their number, their kinds, and the first few.
fn survivors(urdd: &Measured) -> String {
    let mut by_field: BTreeMap<(&str, &str, &str), Vec<&Trial>> = BTreeMap::new();
    for trial in urdd.survivors() {
        let change = &trial.change;
        let key = (change.module.as_str(), change.field.as_str(), change.target.as_str());
        by_field.entry(key).or_default().push(trial);
    }
    let mut text = String::new();
    if !by_field.is_empty() {
        text += "  survivors\n";
    }
    for ((module, field, target), trials) in by_field {
        let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
        for trial in &trials {
            *kinds.entry(trial.change.kind).or_default() += 1;
        }
        let kinds: Vec<String> =
            kinds.iter().map(|(kind, count)| format!("{kind} ({count})")).collect();
        text += &format!("    {module} {field} ({target}): {}\n", kinds.join(", "));
        for trial in trials.iter().take(SHOWN) {
            let change = &trial.change;
            let place = change.pointer.as_deref().unwrap_or(&change.file);
            let said = said(trial.deep.as_ref().unwrap_or(&trial.plain));
            text += &format!("      {place}: {} -> {} [{said}]\n", change.from, change.to);
        }
    }
    text
}

fn said(outcome: &Outcome) -> String {
    let (word, codes) = in_words(outcome);
    let mut words = vec![word.to_owned()];
    words.extend(codes);
    words.join(" ")
}

fn in_words(outcome: &Outcome) -> (&'static str, Vec<String>) {
    match outcome {
        Outcome::Noticed(codes) => ("noticed", codes.iter().map(ToString::to_string).collect()),
        Outcome::Warned(codes) => ("warned", codes.iter().map(ToString::to_string).collect()),
        Outcome::Missed => ("missed", Vec::new()),
        Outcome::Crashed(code) => ("crashed", vec![code.to_string()]),
        Outcome::Unreadable => ("unreadable", Vec::new()),
    }
}

/// All counts and every survivor; with `all`, every mutation.
pub fn json(measured: &[Measured], plan: &Plan, all: bool) -> Value {
    let urdds: Vec<Value> = measured.iter().map(|urdd| of_urdd(urdd, all)).collect();
    json!({
        "tool": { "name": env!("CARGO_PKG_NAME"), "version": env!("CARGO_PKG_VERSION") },
        "seed": plan.seed,
        "per_field": plan.per_field,
        "limit": plan.limit,
        "urdds": urdds,
    })
}

fn of_urdd(urdd: &Measured, all: bool) -> Value {
    let modules: Vec<Value> = urdd
        .modules()
        .iter()
        .map(|module| {
            json!({ "module": module.module, "plain": of_tally(&module.plain),
                    "deep": module.deep.as_ref().map(of_tally) })
        })
        .collect();
    let fields: Vec<Value> = urdd
        .fields()
        .iter()
        .map(|field| {
            json!({ "module": field.module, "field": field.field, "target": field.target.as_str(),
                    "plain": of_tally(&field.plain), "deep": field.deep.as_ref().map(of_tally) })
        })
        .collect();
    let trials: Vec<Value> = match all {
        true => urdd.trials.iter().map(of_trial).collect(),
        false => urdd.survivors().map(of_trial).collect(),
    };
    let list = if all { "changes" } else { "survivors" };
    json!({ "name": urdd.name, "modules": modules, "fields": fields, list: trials })
}

fn of_tally(tally: &Tally) -> Value {
    json!({ "changes": tally.changes, "noticed": tally.noticed, "warned": tally.warned,
            "missed": tally.missed, "rate": tally.rate() })
}

fn of_trial(trial: &Trial) -> Value {
    let change = &trial.change;
    let outcome = |outcome: &Outcome| {
        let (word, codes) = in_words(outcome);
        json!({ "outcome": word, "codes": codes })
    };
    json!({
        "module": change.module, "file": change.file, "field": change.field,
        "pointer": change.pointer, "target": change.target.as_str(), "kind": change.kind,
        "from": change.from, "to": change.to,
        "plain": outcome(&trial.plain), "deep": trial.deep.as_ref().map(outcome),
    })
}
