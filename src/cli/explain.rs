//! `urdd explain`.

use std::process::ExitCode;

use clap::Args;

use super::output;
use crate::validate::code::Code;
use crate::validate::rules;

/// Arguments of `urdd explain`.
#[derive(Args)]
pub struct ExplainArguments {
    /// Code of a rule, such as DOF003, or its name; without it, every rule is listed.
    rule: Option<String>,
}

/// Runs `urdd explain`.
pub fn run(arguments: &ExplainArguments) -> ExitCode {
    let rules = rules::all();
    let Some(wanted) = &arguments.rule else {
        let width = rules.iter().map(|rule| rule.name.len()).max().unwrap_or(0);
        for rule in &rules {
            let line = format!(
                "{}  {:7}  {:width$}  {}\n",
                rule.code,
                rule.severity.as_str(),
                rule.name,
                rule.summary()
            );
            output::print(&line);
        }
        return ExitCode::SUCCESS;
    };
    let by_code = Code::parse(wanted);
    match rules
        .iter()
        .find(|rule| Some(rule.code) == by_code || rule.name == wanted)
    {
        Some(rule) => {
            output::print(&format!(
                "{} {}\n{}; SPEC.md clause {}; since urdd {}\n\n{}\n",
                rule.code,
                rule.name,
                rule.severity.as_str(),
                rule.clause,
                rule.since,
                rule.explanation()
            ));
            ExitCode::SUCCESS
        }
        None => {
            output::error(&format!(
                "there is no rule `{wanted}`; `urdd explain` without a code lists them"
            ));
            ExitCode::from(2)
        }
    }
}
