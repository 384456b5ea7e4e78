//! Commands for contributors, run by `cargo xtask`: see CONTRIBUTING.md.

#![allow(clippy::disallowed_methods, reason = "for maintainers")]

mod check;
mod new_lint_rule;
mod new_module;
mod new_rule;
mod source;
mod update;

use std::path::PathBuf;
use std::process::ExitCode;

const USAGE: &str = "\
cargo xtask check
    What you forgot, after a rule, a module or a message: each with its remedy.

cargo xtask update [schemas|cases|clauses|counts|exports|types|imports|snapshots|fields|programs]...
    Writes again what is generated: all of it, or what is named. `check` says which is stale.

cargo xtask clauses
    How many statements of SPEC.md cases decide, by chapter; which line of conformance/clauses is missing or wrong.

cargo xtask new-rule CODE name-of-the-fault [--clause 6.1.7] [--severity error|warning|info] [--family FILE]
    Makes the files of a new rule: the rule, its code, its place in SPEC.md, and its two cases.
    The code is the family and its next free number (such as SRC010); the name states the fault.
    A family that is new gets a file: --family battery. A rule of lint (LNT060) has no clause.

cargo xtask new-module NAME
    Makes the files of a new module of the format: its type, its entries in the registry, its place in SPEC.md.
";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if words.iter().any(|word| word == "--help" || word == "-h") {
        println!("{}", USAGE.trim_end());
        return ExitCode::SUCCESS;
    }
    let result = match words.split_first() {
        Some((command, words)) => run(command, words),
        None => Err(USAGE.to_owned()),
    };
    match result {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("{}", message.trim_end());
            ExitCode::from(2)
        }
    }
}

/// Runs a command; returns whether it succeeded.
fn run(command: &str, words: &[String]) -> Result<bool, String> {
    // For tests: the root of another copy of the source.
    let (plain, mut options) = arguments(words)?;
    let given = options.remove("--root").map(PathBuf::from);
    // Cargo says which clone it runs in; the program may have been built in another one.
    let here = || Some(PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR")?).join(".."));
    let root = given.or_else(here).ok_or("run it as `cargo xtask`")?;
    let plain: Vec<&str> = plain.iter().map(String::as_str).collect();
    let text = match (command, plain.as_slice()) {
        ("check", []) => return check::run(&root),
        ("update", names) => return update::run(&root, names),
        ("clauses", []) => return check::clauses(&root),
        ("new-rule", [code, name]) if code.starts_with("LNT") => {
            if let Some(option) =
                ["--clause", "--family"].iter().find(|&&name| options.contains_key(name))
            {
                return Err(format!("{option} is not for rules of lint"));
            }
            let severity = options.get("--severity").map_or("warning", String::as_str);
            new_lint_rule::make(&root, code, name, severity)?
        }
        ("new-rule", [code, name]) => {
            let option = |name: &str| options.get(name).map(String::as_str);
            let new = new_rule::NewRule {
                code,
                name,
                clause: option("--clause"),
                severity: option("--severity").unwrap_or("error"),
                family: option("--family"),
            };
            new_rule::make(&root, &new)?
        }
        ("new-module", [name]) => new_module::make(&root, name)?,
        _ => return Err(USAGE.to_owned()),
    };
    print!("{text}");
    // Breaks long lines. The copies of tests have no manifest and stay as they are.
    let _ = check::cargo(&root).arg("fmt").output();
    Ok(true)
}

type Options = std::collections::BTreeMap<String, String>;

/// The arguments that are not options, and the options with their values.
fn arguments(words: &[String]) -> Result<(Vec<String>, Options), String> {
    let mut plain = Vec::new();
    let mut options = Options::new();
    let mut words = words.iter().cloned();
    while let Some(word) = words.next() {
        match word.as_str() {
            "--clause" | "--severity" | "--family" | "--root" => {
                let value = words.next().ok_or(format!("{word} needs a value"))?;
                options.insert(word, value);
            }
            _ if word.starts_with('-') => return Err(format!("{word} is not known\n\n{USAGE}")),
            _ => plain.push(word),
        }
    }
    Ok((plain, options))
}
