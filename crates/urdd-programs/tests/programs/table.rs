//! The table of what programs did with changed files: `tests/figures/programs/README.md` has its form.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

/// A change of a base, and what programs made of it.
pub struct Row {
    pub id: String,
    pub base: String,
    /// The changed file.
    pub bytes: Vec<u8>,
    /// What makes it of the base: from a byte to another there is this text. The last is first.
    pub edits: Vec<Edit>,
    /// The facts that the change takes away in a program that reads all as it is written.
    pub gone: Vec<String>,
    /// What each program did, by its letter: `+` loads, `-` refuses, `!` crashes, `?` does not end.
    pub verdicts: HashMap<char, char>,
    /// The facts that are otherwise than meant, by a program's letter.
    pub differences: HashMap<char, Vec<String>>,
}

pub type Edit = (usize, usize, Vec<u8>);

/// The letters of programs, by their names.
pub type Letters = HashMap<String, char>;

pub fn folder() -> PathBuf {
    match std::env::var_os("URDD_PROGRAMS") {
        Some(folder) => PathBuf::from(folder),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/figures/programs"),
    }
}

pub fn read(path: &Path) -> (Letters, Vec<Row>) {
    let text = fs::read_to_string(path).unwrap();
    let (mut letters, mut rows, mut bases) = (Letters::new(), Vec::<Row>::new(), HashMap::new());
    for line in text.lines().skip(1) {
        let (mark, rest) = line.split_at(1);
        match mark {
            "@" => {
                let mut parts = rest.trim_start().split('\t');
                let letter = parts.next().unwrap().chars().next().unwrap();
                letters.insert(parts.next().unwrap().to_owned(), letter);
            }
            "*" => {
                let mut parts = rest[1..].split('\t');
                let id = plain(parts.next().unwrap());
                let base = parts.next().unwrap().to_owned();
                let _kind = parts.next();
                let unchanged = bases
                    .entry(base.clone())
                    .or_insert_with(|| fs::read(folder().join("base").join(&base)).unwrap());
                let edits = edits(parts);
                let bytes = changed(unchanged, &edits);
                rows.push(Row {
                    id: String::from_utf8_lossy(&id).into_owned(),
                    base,
                    bytes,
                    edits,
                    gone: Vec::new(),
                    verdicts: HashMap::new(),
                    differences: HashMap::new(),
                });
            }
            "~" => {
                let facts = rest.split('\t').filter(|fact| fact.starts_with('-'));
                let facts = facts.map(|fact| String::from_utf8_lossy(&plain(fact)).into_owned());
                rows.last_mut().unwrap().gone = facts.collect();
            }
            "=" => {
                let mut parts = rest[1..].split('\t');
                let letters = parts.next().unwrap();
                let found: Vec<String> =
                    parts.map(|part| String::from_utf8_lossy(&plain(part)).into_owned()).collect();
                let row = rows.last_mut().unwrap();
                row.differences.extend(letters.chars().map(|letter| (letter, found.clone())));
            }
            "+" | "-" | "!" | "?" => {
                for word in line.split(' ') {
                    let mut characters = word.chars();
                    let verdict = characters.next().unwrap();
                    let row = rows.last_mut().unwrap();
                    row.verdicts.extend(characters.map(|letter| (letter, verdict)));
                }
            }
            _ => {}
        }
    }
    (letters, rows)
}

/// The edits of a row, `START-END:TEXT`.
fn edits<'a>(edits: impl Iterator<Item = &'a str>) -> Vec<Edit> {
    let mut edits: Vec<Edit> = edits
        .map(|edit| {
            let (place, text) = edit.split_once(':').unwrap();
            let (start, end) = place.split_once('-').unwrap();
            (start.parse().unwrap(), end.parse().unwrap(), plain(text))
        })
        .collect();
    edits.sort_by_key(|edit| std::cmp::Reverse(edit.0));
    edits
}

/// A base with edits of which the last is first.
pub fn changed(base: &[u8], edits: &[Edit]) -> Vec<u8> {
    let mut bytes = base.to_vec();
    for (start, end, text) in edits {
        bytes.splice(start..end, text.iter().copied());
    }
    bytes
}

/// `\xNN` as the byte.
fn plain(text: &str) -> Vec<u8> {
    let mut parts = text.split("\\x");
    let mut bytes = parts.next().unwrap().as_bytes().to_vec();
    for part in parts {
        bytes.push(u8::from_str_radix(&part[..2], 16).unwrap());
        bytes.extend(&part.as_bytes()[2..]);
    }
    bytes
}
