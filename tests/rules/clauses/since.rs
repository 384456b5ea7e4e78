//! What SPEC.md asks since 1.0.0, sentence by sentence: `1.0.0.txt` keeps what 1.0.0 asked (its sentences with MUST or SHOULD,
//! and the rows of its tables), and each line of `changes.txt` says of what is otherwise today whether it asks more, less,
//! or is only clearer (docs/promises.md). `URDD_UPDATE=1` writes a line, as `open`, for what is new or has changed again.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;

use sha2::{Digest, Sha256};
use testkit::repository;

use super::{BY, OPEN, Statement, beginning, statements};

const RELEASED: &str = "tests/rules/clauses/1.0.0.txt";
const CHANGES: &str = "tests/rules/clauses/changes.txt";
/// What a change does to a URDD of 1.0.
const WORDS: [&str; 3] = ["more", "less", "clearer"];
/// The clauses of the modules that 1.1 added, which ask what they like.
const OF_LATER_MODULES: [&str; 2] = ["6.8", "8.9"];
/// A change may ask more where it is about these alone: no URDD of 1.0 has them.
const LATER: [&str; 3] = ["loops_module", "link_shapes_spheres_module", "1.1.0"];

fn is_normative(statement: &Statement) -> bool {
    statement.is_row || ["MUST", "SHOULD"].iter().any(|word| statement.text.contains(word))
}

/// Two of 1.0.0 as they are kept: clause, whether it is a row, text.
fn released() -> Vec<Statement> {
    let text = fs::read_to_string(repository().join(RELEASED)).expect("the statements of 1.0.0");
    let read = |line: &str| {
        let (clause, text) = line.split_once(' ').expect("a clause and a text");
        let is_row = text.starts_with("| ");
        let text = text.trim_start_matches("| ").to_owned();
        Statement { clause: clause.to_owned(), text, is_row }
    };
    text.lines().map(read).collect()
}

/// What only one of two texts has.
fn missing_in(others: &[Statement], all: &[Statement]) -> Vec<Statement> {
    let texts: BTreeSet<&str> = others.iter().map(|one| one.text.as_str()).collect();
    all.iter().filter(|one| !texts.contains(one.text.as_str())).cloned().collect()
}

/// A line of `changes.txt`: word, digest, and the statements that it is about.
#[derive(Debug, Clone)]
struct Change {
    word: String,
    digest: String,
    what: String,
    why: String,
}

impl Change {
    fn read(line: &str) -> Self {
        let parts = || {
            let (head, why) = line.split_once(BY)?;
            let (word, rest) = head.split_once(' ')?;
            let (digest, what) = rest.split_once(' ')?;
            Some([word, digest, what, why].map(str::to_owned))
        };
        let [word, digest, what, why] = parts().unwrap_or_else(|| panic!("{line}: no change"));
        Self { word, digest, what, why }
    }

    /// `2.15 *` is about all of a clause.
    fn is_of(&self, statement: &Statement) -> bool {
        match self.what.strip_suffix(" *") {
            Some(clause) => statement.clause == clause,
            None => super::is_of(&self.what, statement),
        }
    }

    /// What it is about, of what is gone and what is new, and a digest of that.
    fn about<'a>(&self, changed: &'a [Statement]) -> (Vec<&'a Statement>, String) {
        let own: Vec<&Statement> = changed.iter().filter(|one| self.is_of(one)).collect();
        let mut texts: Vec<&str> = own.iter().map(|one| one.text.as_str()).collect();
        texts.sort_unstable();
        let digest = Sha256::digest(texts.join("\n"));
        (own, digest[..4].iter().map(|byte| format!("{byte:02x}")).collect())
    }
}

#[test]
fn every_change_since_1_0_0_says_what_it_asks() {
    let spec = fs::read_to_string(repository().join("SPEC.md")).expect("SPEC.md");
    let today: Vec<Statement> = statements(&spec).into_iter().filter(is_normative).collect();
    let released = released();
    assert!(released.len() > 350, "{} statements of 1.0.0", released.len());
    let is_later = |one: &Statement| {
        OF_LATER_MODULES.iter().any(|clause| {
            one.clause
                .strip_prefix(clause)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        })
    };
    let mut changed = missing_in(&today, &released);
    changed.extend(missing_in(&released, &today).into_iter().filter(|one| !is_later(one)));

    let path = repository().join(CHANGES);
    let lines = || fs::read_to_string(&path).unwrap_or_default();
    let mut list: Vec<Change> = lines().lines().map(Change::read).collect();
    if std::env::var_os("URDD_UPDATE").is_some() {
        for change in &mut list {
            let (_, digest) = change.about(&changed);
            if digest != change.digest {
                (change.word, change.digest) = (OPEN.to_owned(), digest);
            }
        }
        for one in &changed {
            if !list.iter().any(|change| change.is_of(one)) {
                let what = format!("{} {}", one.clause, beginning(one, &today));
                let mut change =
                    Change { word: OPEN.into(), digest: String::new(), what, why: String::new() };
                change.digest = change.about(&changed).1;
                list.push(change);
            }
        }
        list.retain(|change| !change.about(&changed).0.is_empty());
        let mut text = String::new();
        for Change { word, digest, what, why } in &list {
            writeln!(text, "{word} {digest} {what}{BY}{why}").expect("a text");
        }
        fs::write(&path, text).expect("written");
    }

    let mut wrong = Vec::new();
    for one in &changed {
        let lines = list.iter().filter(|change| change.is_of(one)).count();
        if lines != 1 {
            wrong.push(format!("{lines} lines are about `{} {}`", one.clause, one.text));
        }
    }
    for change in &list {
        let (own, digest) = change.about(&changed);
        let what = &change.what;
        if own.is_empty() {
            wrong.push(format!("`{what}` has not changed: take the line out"));
        } else if digest != change.digest {
            wrong.push(format!("`{what}` has changed since it was looked at"));
        }
        if !WORDS.contains(&change.word.as_str()) || change.why.is_empty() {
            wrong.push(format!("`{what}`: say more, less or clearer, and why"));
        }
        let is_of_later = |one: &&Statement| {
            !today.contains(one) || LATER.iter().any(|name| one.text.contains(name))
        };
        if change.word == "more" && !own.iter().all(is_of_later) {
            wrong.push(format!("`{what}` asks more of a URDD of 1.0: relax it (docs/promises.md)"));
        }
    }
    assert!(
        wrong.is_empty(),
        "{} wrong; URDD_UPDATE=1 cargo test --test rules clauses writes the missing lines to {CHANGES} as `open`, for you \
         to say what each asks:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}
