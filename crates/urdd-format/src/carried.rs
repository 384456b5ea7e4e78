//! What a format carries of a robot, in the words that exports and imports share.

use std::fmt::Write;

use serde_json::{Value, json};

use super::escape;
use super::registry::PROGRAM_VERSION;

/// How something is carried from one format to another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum How {
    /// As it is.
    Yes,
    /// In another way.
    Otherwise(&'static str),
    /// It is lost.
    No,
    /// It has no place there: another file has it, or the format cannot say it.
    Elsewhere,
}

/// Something that a robot has: what, how many, and how it is carried.
pub type Part = (String, usize, How);

/// The report on a robot, as JSON: what is carried, what otherwise, what is lost, and the notes.
#[must_use]
pub fn report(robot: &str, format: &str, parts: &[Part], notes: &[String]) -> String {
    report_with(robot, format, parts, notes, [])
}

/// The same, with more keys.
#[must_use]
pub fn report_with<const N: usize>(
    robot: &str,
    format: &str,
    parts: &[Part],
    notes: &[String],
    more: [(&str, Value); N],
) -> String {
    let of = |wanted: fn(How) -> bool| -> Value {
        let found = parts.iter().filter(|(_, _, how)| wanted(*how));
        let entry = |(name, count, how): &Part| match how {
            How::Otherwise(how) => json!({"what": name, "count": count, "how": how}),
            _ => json!({"what": name, "count": count}),
        };
        found.map(entry).collect()
    };
    let mut document = json!({
        "robot": robot,
        "format": format,
        "program": PROGRAM_VERSION,
        "carried": of(|how| how == How::Yes),
        "otherwise": of(|how| matches!(how, How::Otherwise(_))),
        "lost": of(|how| how == How::No),
        "notes": notes,
    });
    for (key, value) in more {
        document[key] = value;
    }
    let text = serde_json::to_string_pretty(&document).unwrap_or_default() + "\n";
    escape::json(&text).into_owned()
}

/// A table in Markdown: a column a format, a row a thing, with notes below.
#[must_use]
pub fn table<'r, R: AsRef<[How]>>(
    formats: &[&str],
    rows: impl IntoIterator<Item = (&'r str, R)>,
) -> String {
    let mut text = String::from("| |");
    for format in formats {
        let _ = write!(text, " {format} |");
    }
    text += "\n|---|";
    text += &"---|".repeat(formats.len());
    text.push('\n');
    let mut notes: Vec<&str> = Vec::new();
    for (name, by_format) in rows {
        let _ = write!(text, "| {name} |");
        for how in by_format.as_ref() {
            let cell = match how {
                How::Yes => "yes".to_owned(),
                How::No => "**lost**".to_owned(),
                How::Elsewhere => "–".to_owned(),
                How::Otherwise(how) => {
                    let known = notes.iter().position(|note| note == how);
                    let place = known.unwrap_or_else(|| {
                        notes.push(how);
                        notes.len() - 1
                    });
                    format!("({})", place + 1)
                }
            };
            let _ = write!(text, " {cell} |");
        }
        text.push('\n');
    }
    text.push('\n');
    for (place, note) in notes.iter().enumerate() {
        let _ = writeln!(text, "({}) {note}.  ", place + 1);
    }
    text
}
