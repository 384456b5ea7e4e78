//! Faults that the parser does not see: reserved names, colons in names, prefixes without a namespace, references to
//! characters that XML does not have.

use super::error::{XmlError, text_pos};

const COLON: &str =
    "a name begins or ends with a colon, or has two; a name has at most one, after a prefix";
const RESERVED: &str =
    "`<?xml ...?>` is the XML declaration, in lower case; other targets must not be called `xml`";
const TARGET: &str = "the target of a processing instruction contains a colon; remove it";
const STANDALONE: &str = "`standalone` of the XML declaration is neither `yes` nor `no`; remove it";
const NO_NAMESPACE: &str = "a prefix is declared with an empty namespace; name one";
const NO_CHARACTER: &str = "a reference `&#...;` names no character of XML; remove it";

/// Checks what the parser accepts and XML 1.0 or its namespaces do not. What is broken otherwise is left to the parser.
pub(super) fn check(text: &str) -> Result<(), XmlError> {
    match fault(text) {
        Some((at, what)) => Err(XmlError::NotWellFormed {
            what,
            pos: text_pos(text, at),
        }),
        None => Ok(()),
    }
}

type Found = (usize, &'static str);

fn fault(text: &str) -> Option<Found> {
    let mut at = 0;
    while let Some(found) = text[at..].find('<').map(|offset| at + offset) {
        if let Some(fault) = references(&text[at..found], at) {
            return Some(fault);
        }
        let rest = &text[found..];
        let until = |start: &str, mark: &str| {
            Some(found + start.len() + rest.get(start.len()..)?.find(mark)? + mark.len())
        };
        at = if rest.starts_with("<!--") {
            until("<!--", "-->")?
        } else if rest.starts_with("<![CDATA[") {
            until("<![CDATA[", "]]>")?
        } else if rest.starts_with("<?") {
            let end = until("<?", "?>")?;
            if let Some(what) = instruction(
                &text[found + 2..end - 2],
                found == 0 || &text[..found] == "\u{feff}",
            ) {
                return Some((found, what));
            }
            end
        } else {
            let end = tag_end(rest)?;
            if !rest.starts_with("<!")
                && let Some((offset, what)) = tag(&rest[1..end - 1])
            {
                return Some((found + 1 + offset, what));
            }
            found + end
        };
    }
    None
}

/// The fault of a processing instruction, without its marks.
fn instruction(text: &str, at_start: bool) -> Option<&'static str> {
    let target = text.split(|c: char| c.is_ascii_whitespace()).next()?;
    if target.contains(':') {
        return Some(TARGET);
    }
    if !target.eq_ignore_ascii_case("xml") {
        return None;
    }
    if target != "xml" {
        return Some(RESERVED);
    }
    if !at_start {
        return None;
    }
    let (_, after) = text.split_once("standalone")?;
    let value = after.trim_start().strip_prefix('=')?.trim_start();
    let quoted = ["\"yes\"", "'yes'", "\"no\"", "'no'"];
    (!quoted.iter().any(|right| value.starts_with(right))).then_some(STANDALONE)
}

/// The end of a tag, or of a declaration up to its `[`.
fn tag_end(rest: &str) -> Option<usize> {
    let mut quote = None;
    for (at, byte) in rest.bytes().enumerate() {
        match (quote, byte) {
            (Some(open), byte) if byte == open => quote = None,
            (Some(_), _) => {}
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'>') => return Some(at + 1),
            (None, b'[') if rest.starts_with("<!") => return Some(at + 1),
            (None, _) => {}
        }
    }
    None
}

/// The fault of a tag, without `<` and `>`, and its offset.
fn tag(text: &str) -> Option<Found> {
    let is_space = |c: char| c.is_ascii_whitespace();
    let body = text.strip_prefix('/').unwrap_or(text);
    let body = body.strip_suffix('/').unwrap_or(body);
    let name = body.split(is_space).next()?;
    if !is_qualified(name) {
        return Some((0, COLON));
    }
    let mut rest = &body[name.len()..];
    let at = |rest: &str| rest.as_ptr() as usize - text.as_ptr() as usize;
    loop {
        rest = rest.trim_start_matches(is_space);
        let (name, after) = rest.split_once('=')?;
        let value = after.trim_start_matches(is_space);
        let quote = value.chars().next().filter(|c| matches!(c, '"' | '\''))?;
        let (value, after) = value[1..].split_once(quote)?;
        let name = name.trim_end_matches(is_space);
        if !is_qualified(name) {
            return Some((at(rest), COLON));
        }
        if name.starts_with("xmlns:") && value.is_empty() {
            return Some((at(rest), NO_NAMESPACE));
        }
        if let Some(fault) = references(value, at(value)) {
            return Some(fault);
        }
        rest = after;
    }
}

fn is_qualified(name: &str) -> bool {
    !name.starts_with(':') && !name.ends_with(':') && name.matches(':').count() <= 1
}

/// The first reference to what is no character of XML; `start` is the text's offset.
fn references(text: &str, start: usize) -> Option<Found> {
    for (at, _) in text.match_indices("&#") {
        let Some((digits, _)) = text[at + 2..].split_once(';') else {
            continue;
        };
        let number = match digits.strip_prefix('x') {
            Some(digits) => u32::from_str_radix(digits, 16),
            None => digits.parse(),
        };
        let is_character = |number: u32| matches!(number, 0x9 | 0xA | 0xD | 0x20..=0xD7FF | 0xE000..=0xFFFD | 0x1_0000..=0x10_FFFF);
        if !number.is_ok_and(is_character) {
            return Some((start + at, NO_CHARACTER));
        }
    }
    None
}
