//! SPEC.md and the rules agree, both ways: every code in SPEC.md is a rule of that clause, and every rule is in the
//! clause that it names.

mod example;
mod fields;
mod values;

use std::collections::BTreeMap;
use std::fs;

use urdd_findings::code::{Code, RETIRED};
use urdd_findings::description::Severity;
use urdd_findings::description::{FAMILIES, Family};
use urdd_format::registry::{FIRST_SPEC_VERSION, ModuleKind};
use urdd_validate::rules;

fn spec() -> String {
    fs::read_to_string(testkit::repository().join("SPEC.md")).expect("SPEC.md")
}

/// For each `[CODE]` of the text, the clauses that contain it and the sentence before it.
fn codes_by_clause(text: &str) -> BTreeMap<String, Vec<(String, String)>> {
    let mut codes: BTreeMap<String, Vec<(String, String)>> = BTreeMap::new();
    let mut clause = String::new();
    for paragraph in text.split("\n\n") {
        if let Some(rest) = paragraph.trim_start().strip_prefix("**") {
            let number: String =
                rest.chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect();
            if !number.is_empty() {
                clause = number.trim_end_matches('.').to_owned();
            }
        }
        let mut before = 0;
        for (place, _) in paragraph.match_indices('[') {
            let Some(end) = paragraph[place..].find(']') else {
                continue;
            };
            let word = &paragraph[place + 1..place + end];
            if Code::parse(word).is_some_and(|code| code.as_str() == word) {
                let sentence = paragraph[before..place].to_owned();
                codes.entry(word.to_owned()).or_default().push((clause.clone(), sentence));
                before = place + end + 1;
            }
        }
    }
    codes
}

#[test]
fn every_rule_stands_in_its_clause() {
    let codes = codes_by_clause(&spec());
    for rule in rules::all() {
        let places = codes
            .get(rule.code.as_str())
            .unwrap_or_else(|| panic!("{} is not in SPEC.md", rule.code));
        let clauses: Vec<&str> = places.iter().map(|(clause, _)| clause.as_str()).collect();
        assert_eq!(
            clauses,
            [rule.clause.unwrap_or_default()],
            "{}: the clauses of SPEC.md that name it",
            rule.code
        );
    }
}

#[test]
fn every_code_in_the_specification_is_a_rule() {
    let registered: Vec<&str> = rules::all().iter().map(|rule| rule.code.as_str()).collect();
    for code in codes_by_clause(&spec()).keys() {
        // The introduction names one rule as an example.
        assert!(
            registered.contains(&code.as_str()),
            "SPEC.md names {code}, and there is no such rule"
        );
    }
}

#[test]
fn each_family_of_rules_has_a_name_in_the_order_of_the_codes() {
    let mut families: Vec<&str> = Code::ALL.iter().map(|code| code.family()).collect();
    families.dedup();
    let named: Vec<&str> = FAMILIES.iter().map(|family| family.code).collect();
    // That of the rule that only tests have.
    assert_eq!(families, [&named[..], &["TST"]].concat());
    for Family { name, about, .. } in FAMILIES {
        assert!(about.ends_with('.') && !name.is_empty(), "{name}: {about}");
    }
}

#[test]
fn severities_follow_the_words_of_the_specification() {
    let codes = codes_by_clause(&spec());
    for rule in rules::all() {
        let (_, sentence) = &codes[rule.code.as_str()][0];
        // The words of the sentence that the code ends, or of the list that it is part of.
        let should = sentence.contains("SHOULD");
        let must = sentence.contains("MUST");
        match rule.severity {
            Severity::Error => {
                assert!(!should || must, "{}: an error, but SPEC.md says SHOULD", rule.code)
            }
            Severity::Warning => {
                assert!(!must || should, "{}: a warning, but SPEC.md says MUST", rule.code)
            }
            Severity::Info => assert!(!must, "{}: an info, but SPEC.md says MUST", rule.code),
        }
    }
}

#[test]
fn the_table_of_modules_is_the_registry() {
    let text = spec();
    let table: Vec<&str> = text
        .lines()
        .skip_while(|line| !line.starts_with("| module | folder | class"))
        .skip(2)
        .take_while(|line| line.starts_with('|'))
        .collect();
    let cells: Vec<(String, String)> = table
        .iter()
        .map(|row| {
            let cell = |i: usize| {
                row.split('|').nth(i).unwrap_or_default().trim().trim_matches('`').to_owned()
            };
            (cell(1), cell(2))
        })
        .collect();
    let registry: Vec<(String, String)> = ModuleKind::ALL
        .iter()
        .filter(|kind| urdd_format::registry::find(**kind, FIRST_SPEC_VERSION).is_some())
        .map(|kind| (kind.name().to_owned(), kind.folder().to_owned()))
        .collect();
    assert_eq!(cells, registry);
}

const END: &str = "<!-- end -->";

/// What this test writes: the file, the mark before it, and the text.
fn written() -> [(&'static str, &'static str, String); 2] {
    [
        (
            "docs/fields.md",
            "<!-- made from the schemas by tests/program/spec_agrees.rs: begin -->\n",
            format!("\n{}", fields::tables()),
        ),
        (
            "docs/codes.md",
            "<!-- made from the rules by tests/program/spec_agrees.rs: begin -->\n",
            codes_table(),
        ),
    ]
}

/// Annex B.
fn codes_table() -> String {
    let mut text = "\n| family | name | what its rules check |\n|---|---|---|\n".to_owned();
    for Family { code, name, about } in FAMILIES {
        text += &format!("| {code} | {name} | {about} |\n");
    }
    text += "\n| code | severity | clause | name |\n|---|---|---|---|\n";
    for rule in rules::all() {
        let (severity, clause) = (rule.severity.as_str(), rule.clause.unwrap_or_default());
        text += &format!("| {} | {severity} | {clause} | `{}` |\n", rule.code, rule.name);
    }
    for retired in RETIRED {
        text += &format!("| {} | retired | | {} |\n", retired.code, retired.reason);
    }
    text + "\n"
}

/// `URDD_UPDATE=1 cargo test --test program spec_agrees` writes the annexes.
#[test]
fn the_annexes_are_the_schemas_and_the_rules() {
    for (file, mark, expected) in written() {
        let how = "cargo test --test program spec_agrees";
        testkit::page::assert_between(file, [mark, END], &expected, how);
    }
}
