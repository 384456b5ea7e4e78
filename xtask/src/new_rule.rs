//! Creates the files of a new rule.

use std::fs;
use std::path::{Path, PathBuf};

const CODES: &str = "crates/urdd-validate/src/code.rs";
const RULES: &str = "crates/urdd-validate/src/rules";
const SPEC: &str = "SPEC.md";
const CASES: &str = "tests/rules/main.rs";

/// Families whose cases need no meshes; they use the small base.
const CORE: &[&str] = &["URD", "SRC", "DOF", "CHN", "CON", "BND", "KIN"];

/// A file with its new text.
struct Edit {
    path: PathBuf,
    text: String,
}

/// Creates a rule. Writes nothing unless all edits are possible.
///
/// # Errors
/// If the code or the name is invalid, or the source does not have the expected form.
pub fn make(
    root: &Path,
    code: &str,
    name: &str,
    clause: Option<&str>,
    severity: &str,
) -> Result<String, String> {
    let family = family(code)?;
    check_name(name)?;
    let clause = clause.unwrap_or("TODO");
    let severity = match severity {
        "error" => "Error",
        "warning" => "Warning",
        "info" => "Info",
        other => return Err(format!("--severity {other}: write error, warning or info")),
    };
    let codes = add_code(&read(root, CODES)?, code)?;
    let room = room_of(root, family)?;
    let module = name.replace('-', "_");
    let rule_path = format!("{RULES}/{room}/{module}.rs");
    if root.join(&rule_path).exists() {
        return Err(format!("{rule_path} is there already"));
    }
    let list = format!("{RULES}/{room}/mod.rs");
    let mut edits = vec![
        (CODES.to_owned(), codes),
        (list.clone(), register(&read(root, &list)?, &module, &list)?),
        (rule_path.clone(), rule(code, name, severity, clause)),
    ];
    let mut steps = Vec::new();
    let spec = match clause {
        "TODO" => None,
        _ => Some(mark_clause(&read(root, SPEC)?, clause, code)?),
    };
    match spec {
        Some(text) => {
            edits.push((SPEC.to_owned(), text));
            steps.push(format!("Say it in {SPEC}, clause {clause}: one sentence with MUST or SHOULD, instead of the TODO."));
        }
        None => steps.push(format!(
            "Say it in {SPEC}: one sentence with MUST or SHOULD, and [{code}] after it; write its clause into {rule_path}."
        )),
    }
    let test = format!("tests/rules/{room}.rs");
    let cases = format!("{}_cases", code.to_lowercase());
    edits.push((
        test.clone(),
        read(root, &test)?.trim_end().to_owned() + "\n\n" + &two_cases(code, family, &cases),
    ));
    edits.push((
        CASES.to_owned(),
        list_cases(&read(root, CASES)?, &room, &cases)?,
    ));
    let edits = edits.into_iter().map(|(path, text)| Edit {
        path: root.join(path),
        text,
    });
    for edit in edits.collect::<Vec<_>>() {
        fs::write(&edit.path, edit.text)
            .map_err(|error| format!("{}: cannot be written: {error}", edit.path.display()))?;
    }
    steps.extend([
        format!("Write the rule: {rule_path}."),
        format!("Write its two cases: {test}, fn {cases}."),
        format!("URDD_CASE={code} cargo test --test rules      (and with URDD_RULE=mute, URDD_RULE=alarm: see both fail)"),
        "URDD_UPDATE=1 cargo test --test rules         (writes the cases as data; read what it wrote)".to_owned(),
    ]);
    let lines = steps.iter().enumerate();
    Ok(lines
        .map(|(number, step)| format!("{}. {step}\n", number + 1))
        .collect())
}

fn read(root: &Path, path: &str) -> Result<String, String> {
    fs::read_to_string(root.join(path)).map_err(|error| format!("{path}: cannot be read: {error}"))
}

/// The family of a code: its first three letters.
fn family(code: &str) -> Result<&str, String> {
    let right = code.len() == 6
        && code.bytes().take(3).all(|byte| byte.is_ascii_uppercase())
        && code.bytes().skip(3).all(|byte| byte.is_ascii_digit());
    match right {
        true => Ok(&code[..3]),
        false => Err(format!(
            "{code} is not a code; write three capitals and three digits: SRC009"
        )),
    }
}

fn check_name(name: &str) -> Result<(), String> {
    let word = |word: &str| {
        !word.is_empty()
            && word
                .bytes()
                .all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit())
    };
    let begins = name
        .bytes()
        .next()
        .is_some_and(|byte| byte.is_ascii_lowercase());
    match begins && name.split('-').all(word) {
        true => Ok(()),
        false => Err(format!(
            "{name:?} is not a name; state the fault in small letters with hyphens: crossed-limits"
        )),
    }
}

/// Inserts a code into the list of codes, after the last one of its family.
fn add_code(text: &str, code: &str) -> Result<String, String> {
    let (family, number) = (&code[..3], &code[3..]);
    let (start, end) = text
        .split_once("\ncodes! {")
        .and_then(|(before, rest)| Some((before.len(), before.len() + rest.find("\n}")?)))
        .ok_or(format!("{CODES} has no list of codes"))?;
    let list = &text[start..end + "\ncodes! {".len()];
    let known: Vec<&str> = list
        .split_whitespace()
        .filter(|word| word.starts_with(family))
        .collect();
    let Some(last) = known.last() else {
        return Err(format!("there is no family {family}; {CODES} lists them"));
    };
    let next = last[3..].parse::<u32>().unwrap_or(0) + 1;
    if number.parse::<u32>() != Ok(next) {
        return Err(format!(
            "{code}: the next free code of the family is {family}{next:03}; codes are never used again"
        ));
    }
    let place = start + list.find(last).unwrap_or(0) + last.len();
    Ok(format!("{} {code}{}", &text[..place], &text[place..]))
}

/// The folder of the rules of a family.
fn room_of(root: &Path, family: &str) -> Result<String, String> {
    let failed = |error| format!("{RULES}: cannot be read: {error}");
    for room in fs::read_dir(root.join(RULES)).map_err(failed)? {
        let room = room.map_err(failed)?;
        for file in fs::read_dir(room.path()).into_iter().flatten().flatten() {
            let text = fs::read_to_string(file.path()).unwrap_or_default();
            let Some((_, after)) = text.split_once("declare_rule! {") else {
                continue;
            };
            let mut lines = after.lines().map(str::trim);
            let first = lines.find(|line| !line.is_empty() && !line.starts_with("///"));
            if first.is_some_and(|line| line.starts_with(family)) {
                return Ok(room.file_name().to_string_lossy().into_owned());
            }
        }
    }
    Err(format!("no rule in {RULES} is of the family {family}"))
}

/// Adds the rule to the sorted modules and the sorted rules of the family's `mod.rs`.
fn register(text: &str, module: &str, path: &str) -> Result<String, String> {
    let unexpected = || format!("{path} is not as expected: no list of modules and rules");
    let line = format!("pub mod {module};");
    let name = |line: &str| line.trim_start_matches("pub ").to_owned();
    let modules: Vec<&str> = text
        .lines()
        .filter(|line| name(line).starts_with("mod "))
        .collect();
    let before = modules.iter().rev().find(|other| name(other) < name(&line));
    let text = match (before, modules.first()) {
        (Some(before), _) => text.replacen(before, &format!("{before}\n{line}"), 1),
        (None, Some(first)) => text.replacen(first, &format!("{line}\n{first}"), 1),
        (None, None) => return Err(unexpected()),
    };
    let (head, rest) = text.split_once("rules! {").ok_or_else(unexpected)?;
    let (list, tail) = rest.split_once('}').ok_or_else(unexpected)?;
    let mut rules: Vec<&str> = list.split(',').map(str::trim).collect();
    rules.push(module);
    rules.retain(|rule| !rule.is_empty());
    rules.sort_unstable();
    let mut lines = vec![String::from("   ")];
    for rule in rules {
        match lines.last_mut() {
            Some(line) if line.len() + rule.len() < 96 => *line += &format!(" {rule},"),
            _ => lines.push(format!("    {rule},")),
        }
    }
    Ok(format!("{head}rules! {{\n{}\n}}{tail}", lines.join("\n")))
}

/// Appends a placeholder sentence to the clause in SPEC.md.
fn mark_clause(text: &str, clause: &str, code: &str) -> Result<String, String> {
    let start = text
        .find(&format!("\n**{clause}**"))
        .ok_or(format!("{SPEC} has no clause {clause}"))?;
    let length = text[start + 1..]
        .find("\n\n")
        .unwrap_or(text.len() - start - 1);
    let (head, tail) = text.split_at(start + 1 + length);
    Ok(format!(
        "{} TODO: say what MUST or SHOULD be. [{code}]{tail}",
        head.trim_end()
    ))
}

fn rule(code: &str, name: &str, severity: &str, clause: &str) -> String {
    // Rules about unusual robots judge the source.
    let (judges, need) = match code.starts_with("SRC") {
        true => ("judges Source, ", "SourceRobot"),
        false => ("", "Module(Kind::Urdf)"),
    };
    format!(
        r#"use crate::rules::prelude::*;

declare_rule! {{
    /// TODO: what is wrong, in one sentence.
    ///
    /// TODO: why it matters, and what to do.
    {code} "{name}", {severity}, clause "{clause}", since "0.2.0",
    phase References, {judges}needs [{need}],
}}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {{
    // TODO: report each place. `context.rs` shows the available data, `tolerance.rs` how to compare numbers (both in
    // `crates/urdd-validate/src/`). Declare in `needs` what you take with `?`.
    let robot = context.robot()?;
    let file = context.robot_file()?;
    if robot.links.is_empty() {{
        Finding::at(file, "/links/0", "TODO: what is wrong here, and what to do")
            .expected("TODO")
            .actual("TODO")
            .report(findings);
    }}
    Some(())
}}
"#
    )
}

fn two_cases(code: &str, family: &str, cases: &str) -> String {
    let base = match CORE.contains(&family) {
        true => "testkit::fixture::Fixture::core(&testkit::fixture::toy_robot())",
        false => "testkit::fixture::Fixture::toy()",
    };
    format!(
        r#"pub fn {cases}() -> Vec<crate::Case> {{
    use urdd_validate::code::Code::{code};
    let base = || {base};
    vec![
        crate::changed({code}, "todo-name-the-fault", true, base, |_urdd| {{
            todo!("{code}: change the URDD so that exactly this rule catches it")
        }}),
        crate::changed({code}, "todo-name-what-comes-near", false, base, |_urdd| {{
            todo!("{code}: change the URDD so that it comes near the fault, and is right")
        }}),
    ]
}}
"#
    )
}

/// Adds the rule's cases to the list of all cases.
fn list_cases(text: &str, room: &str, cases: &str) -> Result<String, String> {
    let own = format!("        {room}::cases(),\n");
    match text.contains(&own) {
        true => Ok(text.replacen(&own, &format!("{own}        {room}::{cases}(),\n"), 1)),
        false => Err(format!("{CASES} lists no {room}::cases()")),
    }
}
