//! `src/in_programs.rs`: what programs do with the invalid cases of rules, as `urdd explain` says it.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use super::cases::cases;
use super::linted;
use urdd_findings::code::Code;
use urdd_format::report::{Finding, Place};
use urdd_lint::{LintSettings, rules};

/// LNT060 and LNT061 are about nothing else.
const OF_PROGRAMS: [Code; 2] = [Code::LNT060, Code::LNT061];
/// Longest line of the file.
const WIDTH: usize = 120;

/// A message without what to do, and what programs do, which is in brackets at its end.
fn parts(message: &str) -> Option<(&str, &str)> {
    let inside = message.strip_suffix(')')?;
    let mut depth = 1;
    let open = inside.char_indices().rev().find(|(_, c)| {
        depth += match c {
            ')' => 1,
            '(' => -1,
            _ => 0,
        };
        depth == 0
    });
    let open = open?.0;
    let said = inside[..open].trim_end();
    Some((said.split_once("; ").map_or(said, |(said, _)| said), &inside[open + 1..]))
}

/// What is wrong in a finding's places or because of them, and what programs do there. That they ignore what URDF does not
/// have says nothing.
fn said(finding: &Finding) -> Vec<(String, String)> {
    let message = |place: &Place| place.message.clone().unwrap_or_else(|| finding.message.clone());
    let of = |place: &Place, message: &str| {
        let (fault, doings) = parts(message).filter(|_| !place.programs.is_empty())?;
        let is_all = !doings.contains("; ") && doings.ends_with("ignore it");
        (!is_all).then(|| (fault.to_owned(), doings.to_owned()))
    };
    let mut all: Vec<(String, String)> = Vec::new();
    for place in &finding.places {
        all.extend(of(place, &message(place)));
        // The code and name of another rule come first.
        let effects = place.related.iter().filter_map(|effect| {
            let (_, said) = effect.message.as_ref()?.split_once(": ")?;
            of(effect, said)
        });
        all.extend(effects);
    }
    all
}

/// What `urdd explain` says of a rule.
fn sentence(code: Code) -> String {
    let mut all: Vec<(String, String)> = Vec::new();
    for file in
        cases(code, "invalid").iter().filter(|file| file.extension() == Some("urdf".as_ref()))
    {
        let findings = linted(file, &LintSettings::default()).report.urdds.remove(0).findings;
        for one in findings.iter().filter(|one| one.code == code.as_str()).flat_map(said) {
            if all.iter().all(|(fault, _)| *fault != one.0) {
                all.push(one);
            }
        }
    }
    match &all[..] {
        [] => String::new(),
        [(fault, doings)] => format!("In an example, {fault}: {doings}."),
        many => {
            let mut text = "In examples of it:\n".to_owned();
            for (fault, doings) in many {
                write!(text, "\n- {fault}: {doings}.").expect("text");
            }
            text
        }
    }
}

/// A text as a literal of Rust, in short lines.
fn literal(text: &str) -> String {
    let escaped = text.escape_debug().to_string().replace("\\'", "'");
    let (mut lines, mut line) = (Vec::new(), String::new());
    for word in escaped.split_inclusive(' ') {
        if line.len() + word.len() > WIDTH {
            lines.push(std::mem::take(&mut line));
        }
        line += word;
    }
    lines.push(line);
    format!("\"\\\n            {}\"", lines.join("\\\n            "))
}

#[test]
fn rules_say_what_programs_do_with_their_examples() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/in_programs.rs");
    let found = fs::read_to_string(&path).expect("a file");
    let mut arms = String::new();
    let codes = rules::all().into_iter().map(|rule| rule.description.code);
    for code in codes.filter(|code| !OF_PROGRAMS.contains(code)) {
        let sentence = sentence(code);
        if !sentence.is_empty() {
            writeln!(arms, "        Code::{code} => {},", literal(&sentence)).expect("text");
        }
    }
    let start = "    match code {\n";
    let (before, rest) = found.split_once(start).expect("the function");
    let (_, after) = rest.split_once("        _ => \"\",\n").expect("its end");
    let expected = format!("{before}{start}{arms}        _ => \"\",\n{after}");
    if std::env::var_os("URDD_UPDATE").is_some() {
        fs::write(&path, expected).expect("written");
    } else {
        assert_eq!(found, expected, "programs do something else now; run `cargo xtask update`");
    }
}
