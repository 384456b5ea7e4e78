//! Commands for contributors, run by `cargo xtask`: see CONTRIBUTING.md.

mod new_rule;

use std::path::PathBuf;
use std::process::ExitCode;

const USAGE: &str = "\
cargo xtask new-rule CODE name-of-the-fault [--clause 6.1.7] [--severity error|warning|info]

Makes the files of a new rule: the rule, its code, its place in SPEC.md, and its two cases.
The code is the family and its next free number (SRC009); the name states the fault.
";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let result = match words.first().map(String::as_str) {
        Some("new-rule") => new_rule(&words[1..]),
        _ => Err(USAGE.to_owned()),
    };
    match result {
        Ok(text) => {
            print!("{text}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{}", message.trim_end());
            ExitCode::from(2)
        }
    }
}

fn new_rule(words: &[String]) -> Result<String, String> {
    let mut plain = Vec::new();
    let (mut clause, mut severity, mut root) = (None, "error".to_owned(), repository());
    let mut words = words.iter().cloned();
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or(format!("{word} needs a value"));
        match word.as_str() {
            "--clause" => clause = Some(value()?),
            "--severity" => severity = value()?,
            // For tests: the root of another copy of the source.
            "--root" => root = value()?.into(),
            _ if word.starts_with('-') => return Err(format!("{word} is not known\n\n{USAGE}")),
            _ => plain.push(word),
        }
    }
    let [code, name] = plain.as_slice() else {
        return Err(USAGE.to_owned());
    };
    new_rule::make(&root, code, name, clause.as_deref(), &severity)
}

fn repository() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}
