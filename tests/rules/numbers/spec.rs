//! The list against the text of SPEC.md.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use super::list;
use super::not_limits::NOT_LIMITS;

/// The text of each clause before the annexes, white space as single spaces. Formulas, which are indented, are left out.
fn clauses() -> BTreeMap<String, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("SPEC.md");
    let text = fs::read_to_string(path).expect("SPEC.md");
    let text = text.split("\n## Annexes").next().expect("a text");
    let mut clauses: BTreeMap<String, String> = BTreeMap::new();
    let mut clause = String::new();
    for line in text.lines() {
        let id = line.strip_prefix("**").map(|rest| {
            let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.');
            rest[..end.unwrap_or(0)].trim_end_matches('.')
        });
        if let Some(id) = id.filter(|id| id.contains('.')) {
            clause = id.to_owned();
        } else if line.starts_with('#') {
            clause.clear();
        }
        if !clause.is_empty() && !line.starts_with("    ") && !is_row_of_values(line) {
            let of = clauses.entry(clause.clone()).or_default();
            for word in line.split_whitespace() {
                *of += word;
                of.push(' ');
            }
        }
    }
    clauses
}

/// Whether it is a row of a table that holds examples: numbers alone.
fn is_row_of_values(line: &str) -> bool {
    line.starts_with('|')
        && !line.replace("and", "").contains(|c: char| c.is_ascii_alphabetic())
        && line.contains(|c: char| c.is_ascii_digit())
}

/// The text without what stands between backticks.
fn without_code(text: &str) -> String {
    let mut parts = text.split('`');
    let mut out = String::new();
    while let Some(part) = parts.next() {
        out += part;
        out.push(' ');
        parts.next();
    }
    out
}

/// Numerals in a text, except those that are part of a word (`U+0085`, `DOF003`, `§12`), and, where neither `%` nor
/// `times` follows, 0, 1, 2 and numbers of clauses.
pub(super) fn numerals(text: &str, clauses: &BTreeSet<&str>) -> Vec<String> {
    let mut found = Vec::new();
    let words = text.split(|c: char| c.is_whitespace() || "()[]{}|;:/\"*".contains(c));
    let mut words = words.filter(|word| !word.is_empty()).peekable();
    while let Some(word) = words.next() {
        let next = words.peek().map(|next| next.trim_matches([',', '.']));
        let counts = matches!(next, Some("%" | "times"));
        let word = word.trim_matches(|c: char| ".,?!".contains(c));
        let word = word.trim_start_matches(['-', '+', '±', '=', '<', '>']);
        let number = word.starts_with(|c: char| c.is_ascii_digit());
        let clause = clauses.contains(word) || matches!(word, "0" | "1" | "2");
        if number && (counts || !clause) {
            found.push(word.to_owned());
        }
    }
    found
}

/// The number that is written so: `1e-9`, `2 %`, `2,000,000`, `64 MiB`, `2^-52`.
fn read(written: &str) -> Option<f64> {
    let plain = |text: &str| text.replace(',', "").parse::<f64>().ok();
    if let Some(percent) = written.strip_suffix(" %") {
        return Some(plain(percent)? / 100.0);
    }
    for (unit, factor) in [(" KiB", 1024.0), (" MiB", 1_048_576.0), (" mm", 1e-3)] {
        if let Some(count) = written.strip_suffix(unit) {
            return Some(plain(count)? * factor);
        }
    }
    if let Some((factor, power)) = written.split_once(" * 2^") {
        return Some(plain(factor)? * plain(power)?.exp2());
    }
    if let Some(power) = written.strip_prefix("2^") {
        return Some(plain(power)?.exp2());
    }
    plain(written)
}

/// Changing a number in SPEC.md, or the words around it, fails here.
#[test]
fn every_entry_is_in_its_clause() {
    let clauses = clauses();
    let mut ids = BTreeSet::new();
    for number in list() {
        let id = number.id;
        assert!(ids.insert(id), "{id}: twice");
        let clause = clauses.get(number.clause);
        let clause = clause.unwrap_or_else(|| panic!("{id}: no clause {}", number.clause));
        let (words, written) = (number.words, number.written);
        assert!(clause.contains(words), "{id}: {} no longer says {words:?}", number.clause);
        assert!(words.contains(written), "{id}: {written:?} is not in {words:?}");
        let value = read(written);
        let near = |value: f64| (value - number.value).abs() <= 1e-12 * value.abs();
        let agrees = value.is_some_and(|value| value == number.value || near(value));
        assert!(agrees, "{id}: {written:?} is {value:?}, and not {}", number.value);
    }
}

/// A number that is new in SPEC.md fails here.
#[test]
fn every_number_of_spec_is_in_the_list() {
    let clauses = clauses();
    assert!(clauses.len() > 90, "{} clauses", clauses.len());
    let ids: BTreeSet<&str> = clauses.keys().map(String::as_str).collect();
    let mut missing = Vec::new();
    let mut used = BTreeSet::new();
    // 5.12 repeats those of other clauses: `tolerances.rs`.
    for (id, text) in clauses.iter().filter(|(id, _)| *id != "5.12") {
        let mut text = text.clone();
        let own = list();
        let own = own.iter().filter(|number| number.clause == id);
        for words in own.map(|number| number.words) {
            text = text.replace(words, " ");
        }
        for (clause, words) in NOT_LIMITS.iter().filter(|(clause, _)| clause == id) {
            assert!(
                text.contains(words),
                "{clause} no longer says {words:?}: take it out of not_limits.rs"
            );
            used.insert((clause, words));
            text = text.replace(words, " ");
        }
        for numeral in numerals(&without_code(&text), &ids) {
            missing.push(format!("{id}: {numeral}"));
        }
    }
    for (clause, _) in NOT_LIMITS {
        assert!(clauses.contains_key(*clause), "not_limits.rs: no clause {clause}");
    }
    assert!(
        missing.is_empty(),
        "numbers of SPEC.md that are not in tests/rules/numbers: give each an entry with two cases, or say in \
         not_limits.rs that it is no limit:\n{missing:#?}"
    );
}

#[test]
fn numbers_are_found_and_read() {
    let clauses = BTreeSet::from(["5.6", "6.1.8"]);
    let text = "within 1e-9 (5.6), at 2 most 2,000,000 or 2 %, 5.6 times U+0085, DOF003, §12, 2^-52. 0x1F 84 + 50 n";
    let found = numerals(text, &clauses);
    assert_eq!(found, ["1e-9", "2,000,000", "2", "5.6", "2^-52", "0x1F", "84", "50"]);
    for (written, value) in [
        ("1e-9", 1e-9),
        ("2 %", 0.02),
        ("64 MiB", 67_108_864.0),
        ("2^-3", 0.125),
        ("8 * 2^-3", 1.0),
    ] {
        assert_eq!(read(written), Some(value));
    }
}
