//! Creates the files of a new rule.

use std::fs;
use std::path::Path;

use crate::source::{Edits, camel, files, with_module};

pub const CODES: &str = "crates/urdd-findings/src/code.rs";
pub const RULES: &str = "crates/urdd-validate/src/rules";
const ALL: &str = "crates/urdd-validate/src/rules/mod.rs";
const SPEC: &str = "SPEC.md";
const CHANGES: &str = "CHANGELOG.md";
pub const CASES: &str = "conformance/cases";
const BASES: &str = "tests/rules/bases.rs";

/// Families whose cases need no meshes; they use the small base.
const CORE: &[&str] = &["URD", "SRC", "DOF", "CHN", "CON", "BND", "KIN"];

/// A rule to be created.
pub struct NewRule<'a> {
    /// Its code.
    pub code: &'a str,
    /// Its name.
    pub name: &'a str,
    /// The clause of SPEC.md, if known.
    pub clause: Option<&'a str>,
    /// `error`, `warning` or `info`.
    pub severity: &'a str,
    /// The file of its family, if the family is new.
    pub family: Option<&'a str>,
}

/// Creates a rule. Writes nothing unless all edits are possible.
///
/// # Errors
/// If the code or the name is invalid, or the source does not have the expected form.
pub fn make(root: &Path, new: &NewRule) -> Result<String, String> {
    let (code, name) = (new.code, new.name);
    let family = family(code)?;
    check_name(name)?;
    let clause = new.clause.unwrap_or("TODO");
    let severity = severity(new.severity)?;
    let mut edits = Edits::new(root);
    let rule_path = match (file_of(root, family), new.family) {
        (Some(file), None) => file,
        (Some(file), Some(_)) => {
            return Err(format!("{family} is the family of {file}: leave out --family"));
        }
        (None, None) => {
            return Err(format!(
                "there is no family {family}; {CODES} lists them. A new one needs --family FILE"
            ));
        }
        (None, Some(room)) => new_family(&mut edits, code, room)?,
    };
    let room = room_of(&rule_path).to_owned();
    edits.set(CODES, add_code(&edits.read(CODES)?, code, 1)?);
    add_change(&mut edits, &format!("what {code} finds"))?;
    check_new(root, RULES, name)?;
    let module = name.replace('-', "_");
    // If the module is as scaffolded, the rule can already read the values.
    let types = edits.read(&format!("crates/urdd-format/src/{room}.rs"));
    let has_values = types.is_ok_and(|text| text.contains("pub values: Vec<f64>,"));
    let about = has_values.then_some(room.as_str());
    let since = next_version(&edits)?;
    let (declared, check) = rule(code, name, &module, severity, clause, &since, about);
    edits.set(&rule_path, with_rule(&edits.read(&rule_path)?, &declared, &check, &rule_path)?);
    let mut steps = Vec::new();
    if clause == "TODO" {
        steps.push(format!(
            "Say it in {SPEC}: one sentence with MUST or SHOULD, and [{code}] after it; write its clause into {rule_path}."
        ));
    } else {
        let spec = edits.read(SPEC)?;
        edits.set(SPEC, mark_clause(&spec, clause, code)?);
        if let Some(room) = about {
            check_clause(&spec, clause, room)?;
        }
        steps.push(format!("Say it in {SPEC}, clause {clause}: one sentence with MUST or SHOULD, instead of the TODO."));
    }
    let cases = format!("{CASES}/{code}.json");
    let base = base(&edits.read(BASES)?, family, &room);
    edits.create(&cases, two_cases(name, severity, base, about))?;
    edits.write()?;
    steps.extend([
        format!("Write the rule: {rule_path}."),
        format!("Write its two cases: {cases}; conformance/README.md says how."),
        format!("URDD_UPDATE=1 URDD_CASE={code} cargo test --test rules computed      (writes what the validator finds into `expected`: is it right?)"),
        format!("URDD_CASE={code} cargo test --test rules asked_for      (and with URDD_RULE=mute, URDD_RULE=alarm: see both fail)"),
        "cargo xtask update       (writes again what is generated)".to_owned(),
        "cargo xtask check        (says what is left; before you send, .ci/quick runs it)".to_owned(),
    ]);
    let lines = steps.iter().enumerate();
    Ok(lines.map(|(number, step)| format!("{}. {step}\n", number + 1)).collect())
}

/// Adds a family without rules: its file, which is returned, the first code's place, and where it is about a module, a
/// base of its cases that has it. Families of modules come before the legacy ones.
fn new_family(edits: &mut Edits, code: &str, room: &str) -> Result<String, String> {
    check_name(&room.replace('_', "-"))?;
    let family = &code[..3];
    if !code.ends_with("001") {
        return Err(format!("{code}: the first code of a family is {family}001"));
    }
    let file = format!("{RULES}/{room}.rs");
    if edits.is_there(&format!("{RULES}/{room}")) {
        return Err(format!("{file} is there already, as a folder"));
    }
    let about = match is_module(edits, room) {
        true => format!("`{room}_module`"),
        false => "TODO: what the rules are about".to_owned(),
    };
    let empty = "use crate::rules::prelude::*;\n\ndeclare_rule! {\n}\n";
    edits.create(&file, format!("//! {family}: {about}.\n\n{empty}"))?;
    edits.insert_before(CODES, "    LEG001 ", &format!("    {code}\n"))?;
    edits.insert_module(ALL, &format!("pub mod {room};"))?;
    edits.insert_before(ALL, "    };\n    rules.sort_by_key", &format!("        {room},\n"))?;
    if is_module(edits, room) {
        edits.insert_before(BASES, "        (\"composition\",", &small_base(room))?;
    }
    Ok(file)
}

/// Whether a family is about a module of version 1 that has its type in a file of that name.
fn is_module(edits: &Edits, room: &str) -> bool {
    let registry = edits.read("crates/urdd-format/src/registry.rs");
    registry.is_ok_and(|text| text.contains(&format!("({room}::")))
}

/// A base that has a new module, in the list of bases.
fn small_base(room: &str) -> String {
    let kind = camel(room);
    format!(
        r#"        (
            "{room}",
            base(|| {{
                let module = json!({{ "values": [] }});
                Fixture::core_with(&toy_robot(), ModuleKind::{kind}, module)
            }}),
        ),
"#
    )
}

/// The family of a code: its first three letters.
fn family(code: &str) -> Result<&str, String> {
    let right = code.len() == 6
        && code.bytes().take(3).all(|byte| byte.is_ascii_uppercase())
        && code.bytes().skip(3).all(|byte| byte.is_ascii_digit());
    match right {
        true => Ok(&code[..3]),
        false => {
            Err(format!("{code} is not a code; write three capitals and three digits: SRC009"))
        }
    }
}

/// Checks that no rule in a folder of rules has a name.
pub fn check_new(root: &Path, rules: &str, name: &str) -> Result<(), String> {
    let declared = format!(" \"{name}\", ");
    for path in files(root, &[rules]) {
        if fs::read_to_string(&path).is_ok_and(|text| text.contains(&declared)) {
            return Err(format!("the rule {name} is there already: {}", path.display()));
        }
    }
    Ok(())
}

pub fn check_name(name: &str) -> Result<(), String> {
    let word = |word: &str| {
        !word.is_empty()
            && word.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit())
    };
    let begins = name.bytes().next().is_some_and(|byte| byte.is_ascii_lowercase());
    match begins && name.split('-').all(word) {
        true => Ok(()),
        false => Err(format!(
            "{name:?} is not a name; state the fault in small letters with hyphens: crossed-limits"
        )),
    }
}

/// A severity as the source has it.
pub fn severity(word: &str) -> Result<&'static str, String> {
    match word {
        "error" => Ok("Error"),
        "warning" => Ok("Warning"),
        "info" => Ok("Info"),
        other => Err(format!("--severity {other}: write error, warning or info")),
    }
}

/// Inserts a code into the list of codes, after the last one of its family. Its number is at least `least`.
pub fn add_code(text: &str, code: &str, least: u32) -> Result<String, String> {
    let (family, number) = (&code[..3], &code[3..]);
    let (start, end) = text
        .split_once("\ncodes! {")
        .and_then(|(before, rest)| Some((before.len(), before.len() + rest.find("\n}")?)))
        .ok_or(format!("{CODES} has no list of codes"))?;
    let list = &text[start..end + "\ncodes! {".len()];
    let known: Vec<&str> =
        list.split_whitespace().filter(|word| word.starts_with(family)).collect();
    if known == [code] {
        return Ok(text.to_owned());
    }
    let last = known.last().ok_or(format!("{CODES} has no family {family}"))?;
    let next = least.max(last[3..].parse::<u32>().unwrap_or(0) + 1);
    if number.parse::<u32>() != Ok(next) {
        return Err(format!(
            "{code}: the next free code of the family is {family}{next:03}; codes are never used again"
        ));
    }
    let place = start + list.find(last).unwrap_or(0) + last.len();
    Ok(format!("{} {code}{}", &text[..place], &text[place..]))
}

/// The shortest file with rules of a family; `None` if it has none yet.
fn file_of(root: &Path, family: &str) -> Option<String> {
    let of_family = files(root, &[RULES]).into_iter().filter_map(|path| {
        let text = fs::read_to_string(&path).ok()?;
        let (_, after) = text.split_once("declare_rule! {")?;
        let is_of = |line: &str| line.starts_with(family) && line.get(6..8) == Some(" \"");
        let found = after.lines().any(|line| is_of(line.trim()));
        found.then_some((text.len(), path))
    });
    let (_, shortest) = of_family.min()?;
    Some(shortest.strip_prefix(root).ok()?.to_string_lossy().replace('\\', "/"))
}

/// What the rules of a file are about: the name of their folder, or else that of the file.
fn room_of(file: &str) -> &str {
    let below = file.trim_start_matches(RULES).trim_start_matches('/');
    below.split('/').next().unwrap_or_default().trim_end_matches(".rs")
}

/// A file of rules with one more, at the end of its table, and its check.
fn with_rule(text: &str, declared: &str, check: &str, path: &str) -> Result<String, String> {
    let unexpected = || format!("{path} is not as expected: no table of rules");
    let start = text.find("declare_rule! {\n").ok_or_else(unexpected)?;
    let end = start + text[start..].find("\n}\n").ok_or_else(unexpected)?;
    let (head, tail) = text.split_at(end);
    let gap = if head.ends_with('{') { "\n" } else { "\n\n" };
    Ok(format!("{head}{gap}{declared}{tail}\n{check}"))
}

/// Adds the rule to the sorted modules and the sorted rules of the family's `mod.rs`.
pub fn register(text: &str, module: &str, path: &str) -> Result<String, String> {
    let text = with_module(text, &format!("mod {module};"), path)?;
    let unexpected = || format!("{path} is not as expected: no list of rules");
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
    let start =
        text.find(&format!("\n**{clause}**")).ok_or(format!("{SPEC} has no clause {clause}"))?;
    let length = text[start + 1..].find("\n\n").unwrap_or(text.len() - start - 1);
    let (head, tail) = text.split_at(start + 1 + length);
    Ok(format!("{} TODO: say what MUST or SHOULD be. [{code}]{tail}", head.trim_end()))
}

/// The version that is being made: the first of CHANGELOG.md.
pub fn next_version(edits: &Edits) -> Result<String, String> {
    let text = edits.read(CHANGES)?;
    let first = text.lines().find_map(|line| line.strip_prefix("## ")?.split_once(','));
    let (version, _) = first.ok_or(format!("{CHANGES} has no version"))?;
    Ok(version.to_owned())
}

/// Leaves a line to write among what the next version adds: its section is the first.
pub fn add_change(edits: &mut Edits, what: &str) -> Result<(), String> {
    let text = edits.read(CHANGES)?;
    let mut sections: Vec<&str> = text.splitn(3, "\n## ").collect();
    let unexpected =
        || format!("{CHANGES} is not as expected: its first version has no `### Added`");
    let first = sections.get_mut(1).ok_or_else(unexpected)?;
    let (head, tail) = first.split_once("### Added\n\n").ok_or_else(unexpected)?;
    let changed = format!("{head}### Added\n\n- TODO: {what}, for users.\n{tail}");
    *first = &changed;
    edits.set(CHANGES, sections.join("\n## "));
    Ok(())
}

/// A clause about another module would get the code in silence.
fn check_clause(text: &str, clause: &str, room: &str) -> Result<(), String> {
    let before = text.split(&format!("\n**{clause}**")).next().unwrap_or_default();
    let heading = before.lines().rfind(|line| line.starts_with("##")).unwrap_or_default();
    match heading.contains(&format!("`{room}_module`")) {
        true => Ok(()),
        false => Err(format!(
            "clause {clause} is not about {room}_module: it stands below \"{heading}\""
        )),
    }
}

/// The declaration of a rule, and its check.
fn rule(
    code: &str,
    name: &str,
    check: &str,
    severity: &str,
    clause: &str,
    since: &str,
    module: Option<&str>,
) -> (String, String) {
    // Rules about unusual robots judge the source.
    let need = match (module, code.starts_with("SRC")) {
        (Some(room), _) => format!("ModuleV1(Kind::{})", camel(room)),
        (None, true) => "SourceRobot".to_owned(),
        (None, false) => "Module(Kind::Urdf)".to_owned(),
    };
    let look = match module {
        Some(room) => format!(
            r#"    let module = document!(context, {})?;
    if module.values.is_empty() {{
        Finding::at("{room}_module/module.json", "/values", "TODO: what is wrong here, and what to do")"#,
            camel(room)
        ),
        None => r#"    let robot = context.robot()?;
    let file = context.described().robot_file();
    if robot.links.is_empty() {
        Finding::at(file, "/links/0", "TODO: what is wrong here, and what to do")"#
            .to_owned(),
    };
    let declared = format!(
        r#"    /// TODO: what is wrong, in one sentence.
    ///
    /// TODO: why it matters, and what to do.
    {code} "{name}", {severity}, clause "{clause}", since "{since}",
    phase References, needs [{need}], check {check},"#
    );
    let check = format!(
        r#"fn {check}(context: &Context, findings: &mut Findings) -> Option<()> {{
    // TODO: report each place. `context.rs` shows the available data, `tolerance.rs` how to compare numbers (both in
    // `crates/urdd-validate/src/`). Declare in `needs` what you take with `?`.
{look}
            .expected("TODO")
            .actual("TODO")
            .report(findings);
    }}
    Some(())
}}
"#
    );
    (declared, check)
}

/// The base of a rule's cases: the smallest that has what the rule is about.
fn base<'a>(bases: &str, family: &str, room: &'a str) -> &'a str {
    if bases.contains(&format!("\"{room}\",")) {
        room
    } else if CORE.contains(&family) {
        "toy_core"
    } else {
        "toy"
    }
}

/// A file of two cases to be written.
fn two_cases(name: &str, severity: &str, base: &str, module: Option<&str>) -> String {
    let verdict = if severity == "Error" { "reject" } else { "accept" };
    let file = format!("{}_module/module.json", module.unwrap_or("urdf"));
    let case = |name: &str| {
        format!(
            r#"    {{
      "name": "todo-name-{name}",
      "base": "{base}",
      "changes": [
        {{"file": "{file}", "patch": [{{"op": "replace", "path": "/TODO", "value": 0}}]}}
      ]
    }}"#
        )
    };
    let (invalid, near) = (case("the-fault"), case("what-comes-near"));
    format!(
        r#"{{
  "rule": "{name}",
  "verdict": "{verdict}",
  "invalid": [
{invalid}
  ],
  "near_misses": [
{near}
  ]
}}
"#
    )
}
