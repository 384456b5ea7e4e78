//! Mutations of a string: a name, a word, a path, a version, a text.

use serde_json::{Value, json};

use super::dice::Dice;
use super::field::Field;
use super::schema;

/// Mutations of a string.
pub(crate) fn texts(field: &Field, text: &str, dice: &mut Dice) -> Vec<(&'static str, Value)> {
    let mut to: Vec<(&'static str, Value)> = Vec::new();
    for word in schema::words(&field.schema) {
        to.push(("another word", json!(word)));
    }
    for (kind, changed) in spellings(text, dice) {
        to.push((kind, json!(changed)));
    }
    let itself = json!(text);
    if let Some((_, other)) = field.another(&itself, dice, Value::is_string) {
        to.push(("another place's text", other.clone()));
    }
    let files = &field.original.files;
    if files.contains_key(text) {
        let extension = |path: &str| path.rsplit_once('.').map(|(_, end)| end.to_owned());
        let other = |same: bool| {
            let fits =
                |path: &&String| *path != text && (extension(path) == extension(text)) == same;
            files.keys().filter(fits).collect::<Vec<_>>()
        };
        for (kind, paths) in
            [("another file of its kind", other(true)), ("a file of another kind", other(false))]
        {
            if !paths.is_empty() {
                to.push((kind, json!(paths[dice.below(paths.len())])));
            }
        }
    }
    to
}

/// Misspellings of a text.
pub(crate) fn spellings(text: &str, dice: &mut Dice) -> Vec<(&'static str, String)> {
    let mut to = vec![
        ("a space after it", format!("{text} ")),
        ("a space before it", format!(" {text}")),
        ("empty", String::new()),
    ];
    let letters: Vec<usize> = text
        .char_indices()
        .filter(|(_, letter)| letter.is_ascii_alphanumeric())
        .map(|(at, _)| at)
        .collect();
    if !letters.is_empty() {
        let at = letters[dice.below(letters.len())];
        let mut changed = text.to_owned();
        let next = match text.as_bytes()[at] {
            b'z' => 'a',
            b'Z' => 'A',
            b'9' => '0',
            byte => char::from(byte + 1),
        };
        changed.replace_range(at..=at, next.encode_utf8(&mut [0; 4]));
        to.push(("a letter changed", changed));
        let mut shorter = text.to_owned();
        shorter.remove(at);
        to.push(("a letter left out", shorter));
    }
    let cased = letters.iter().find(|at| text.as_bytes()[**at].is_ascii_alphabetic());
    if let Some(&at) = cased {
        let other = char::from(text.as_bytes()[at] ^ 0x20);
        let mut changed = text.to_owned();
        changed.replace_range(at..=at, other.encode_utf8(&mut [0; 4]));
        to.push(("a letter's case changed", changed));
    }
    to
}
