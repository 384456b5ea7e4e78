//! `conformance/clauses/`: for each statement of SPEC.md (a sentence, a row of a table) the cases that decide it, or why none
//! can. `URDD_UPDATE=1` adds lines for statements that have none, as `open`, and takes away those of statements that are gone.

mod since;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;

use testkit::repository;

const FOLDER: &str = "conformance/clauses";
/// Between the beginning of a statement and what decides it.
const BY: &str = " => ";
/// Why no case decides a statement: the first word behind it.
const WHY: [&str; 7] = ["means", "example", "producer", "consumer", "elsewhere", "free", "vectors"];
/// A statement that a case could decide, and none does yet: a new one, until somebody has looked at it.
const OPEN: &str = "open";

/// A statement: the number of its clause, and its text; of a row of a table its cells, with ` / ` between them.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Statement {
    clause: String,
    text: String,
    is_row: bool,
}

/// The statements of clauses 2 to 13, in order.
fn statements(spec: &str) -> Vec<Statement> {
    let mut found: Vec<Statement> = Vec::new();
    let (mut clause, mut is_code) = (String::new(), false);
    let lines: Vec<&str> = spec.lines().collect();
    for (at, line) in lines.iter().enumerate() {
        if line.starts_with("## Annexes") {
            break;
        }
        if line.starts_with("```") {
            is_code = !is_code;
        }
        let number = |text: &str| {
            let end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
            Some(text[..end].trim_end_matches('.').to_owned()).filter(|number| !number.is_empty())
        };
        let heading = line.trim_start_matches('#').trim_start();
        if heading.len() < line.len() && line.starts_with('#') {
            clause = number(heading).unwrap_or_default();
            continue;
        }
        if let Some(own) = line.strip_prefix("**").and_then(number).filter(|own| own.contains('.'))
        {
            clause = own;
        }
        let is_ruler =
            |line: &str| line.starts_with('|') && line.chars().all(|c| "|- ".contains(c));
        let is_head = lines.get(at + 1).is_some_and(|next| is_ruler(next));
        let is_text =
            !line.trim().is_empty() && !line.starts_with("    ") && !line.starts_with("```");
        if is_code
            || is_head
            || is_ruler(line)
            || !is_text
            || clause.is_empty()
            || clause == "1"
            || clause.starts_with("1.")
        {
            continue;
        }
        let text = match line.strip_prefix('|') {
            Some(row) => row
                .trim_end_matches('|')
                .split(" | ")
                .map(str::trim)
                .collect::<Vec<_>>()
                .join(" / "),
            // Without the number, which may have a title: `**5.1 Units.** Metres`.
            None => line.trim().trim_start_matches(&format!("**{clause}** ")).to_owned(),
        };
        found.push(Statement { clause: clause.clone(), text, is_row: line.starts_with('|') });
    }
    found
}

/// The shortest beginning of whole words, four or more, that no other statement of the clause has.
fn beginning<'a>(statement: &'a Statement, all: &[Statement]) -> &'a str {
    let text = statement.text.as_str();
    let others =
        || all.iter().filter(|other| other.clause == statement.clause && *other != statement);
    let ends = text.match_indices(' ').map(|(at, _)| at).skip(3);
    let is_own = |end: &usize| others().all(|other| !other.text.starts_with(&text[..*end]));
    text.get(..ends.into_iter().find(is_own).unwrap_or(text.len())).unwrap_or(text)
}

/// Of each file, by the number of its chapter: clause and beginning, and what decides them.
fn lines() -> BTreeMap<String, Vec<(String, String)>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(repository().join(FOLDER)).into_iter().flatten() {
        let path = entry.expect("an entry").path();
        let text = fs::read_to_string(&path).expect("text");
        let split = |line: &str| {
            let (what, by) =
                line.split_once(BY).unwrap_or_else(|| panic!("{line}: without `{BY}`"));
            (what.to_owned(), by.to_owned())
        };
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        files.insert(name, text.lines().filter(|line| !line.is_empty()).map(split).collect());
    }
    files
}

fn is_of(what: &str, statement: &Statement) -> bool {
    what.split_once(' ').is_some_and(|(clause, start)| {
        clause == statement.clause && statement.text.starts_with(start)
    })
}

#[test]
fn every_statement_is_decided_or_said_not_to_be() {
    let spec = fs::read_to_string(repository().join("SPEC.md")).expect("SPEC.md");
    let all = statements(&spec);
    let mut files = lines();
    if std::env::var_os("URDD_UPDATE").is_some() {
        let known: Vec<(String, String)> = files.into_values().flatten().collect();
        let mut texts: BTreeMap<&str, String> = BTreeMap::new();
        for statement in &all {
            let by =
                known.iter().find(|(what, _)| is_of(what, statement)).map_or(OPEN, |(_, by)| by);
            let chapter = statement.clause.split('.').next().unwrap_or_default();
            let line = format!("{} {}{BY}{by}", statement.clause, beginning(statement, &all));
            writeln!(texts.entry(chapter).or_default(), "{line}").expect("a text");
        }
        for (chapter, text) in texts {
            fs::create_dir_all(repository().join(FOLDER)).expect("a folder");
            fs::write(repository().join(FOLDER).join(format!("{chapter}.txt")), text)
                .expect("written");
        }
        files = lines();
    }
    let suite = urdd::suite::carried().unwrap_or_else(|error| panic!("{error}"));
    let cases: BTreeSet<String> = suite.all_cases().map(|case| case.id()).collect();
    let known: Vec<(String, String)> = files.into_values().flatten().collect();
    let (mut wrong, mut open) = (Vec::new(), Vec::new());
    let mut counts: BTreeMap<u8, [usize; 3]> = BTreeMap::new();
    for statement in &all {
        let of = known.iter().filter(|(what, _)| is_of(what, statement)).count();
        if of != 1 {
            wrong.push(format!("{} lines are about `{} {}`", of, statement.clause, statement.text));
        }
    }
    for (what, by) in &known {
        if all.iter().filter(|statement| is_of(what, statement)).count() != 1 {
            wrong.push(format!("`{what}` is the beginning of no statement, or of several"));
        }
        let first = by.split([' ', ':']).next().unwrap_or_default();
        let chapter = what.split(['.', ' ']).next().and_then(|chapter| chapter.parse().ok());
        let count = counts.entry(chapter.unwrap_or_default()).or_default();
        count[usize::from(WHY.contains(&first)) + 2 * usize::from(first == OPEN)] += 1;
        if first == OPEN {
            open.push(what);
        } else if !WHY.contains(&first) {
            let unknown = by.split(", ").filter(|case| !cases.contains(*case));
            wrong.extend(unknown.map(|case| format!("`{what}`: there is no case `{case}`")));
        }
    }
    for (chapter, [decided, otherwise, open]) in &counts {
        println!("{chapter}: {decided} decided, {otherwise} not to be decided, {open} open");
    }
    let how =
        "URDD_UPDATE=1 cargo test --test rules clauses, then say of each `open` what decides it";
    assert!(wrong.is_empty(), "{} wrong; {how}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(
        open.is_empty(),
        "{} statements are open: write cases that decide them, or say by a word why none can (conformance/README.md has \
         the words): {open:#?}",
        open.len()
    );
}
