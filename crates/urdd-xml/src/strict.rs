//! Faults that the parser does not see: a wrong XML declaration, reserved names, colons in names, prefixes without a
//! namespace, references to characters that XML does not have, document types.

use std::ops::Range;

use super::characters::{is_character_number, is_qualified};
use super::doctype;
use super::error::XmlError;
use super::markup::{self, MarkupKind};

const COLON: &str =
    "a name begins or ends with a colon, or has two; a name has at most one, after a prefix";
const RESERVED: &str =
    "`<?xml ...?>` is the XML declaration, in lower case; other targets must not be called `xml`";
const TARGET: &str = "the target of a processing instruction contains a colon; remove it";
const STANDALONE: &str = "`standalone` of the XML declaration is neither `yes` nor `no`; remove it";
const NO_NAMESPACE: &str = "a prefix is declared with an empty namespace; name one";
const OWN_PREFIX: &str =
    "the prefix `xmlns` is declared; it declares others, and cannot be declared itself";
const NO_CHARACTER: &str = "a reference `&#...;` names no character of XML; remove it";

/// Checks what the parser accepts and XML 1.0 or its namespaces do not. What is broken otherwise is left to the parser.
pub(super) fn check(text: &str) -> Result<(), XmlError> {
    match fault(text) {
        Some((at, what)) => Err(XmlError::refused(text, at, what)),
        None => Ok(()),
    }
}

type Found = (usize, &'static str);

fn fault(text: &str) -> Option<Found> {
    let mut at = 0;
    while let Some(markup) = markup::next(text, at) {
        if let Some(fault) = references(&text[at..markup.start], at) {
            return Some(fault);
        }
        at = markup.end?;
        let inside = &text[markup.start..at];
        let fault = match markup.kind {
            MarkupKind::Instruction => {
                let at_start = matches!(&text[..markup.start], "" | "\u{feff}");
                let what = instruction(&inside[2..inside.len() - 2], at_start);
                what.map(|what| (0, what))
            }
            MarkupKind::Tag => tag(&inside[1..inside.len() - 1]).map(|(at, what)| (at + 1, what)),
            MarkupKind::Declaration if inside.starts_with("<!DOCTYPE") => {
                doctype::fault(&text[markup.start..])
            }
            MarkupKind::Text | MarkupKind::Declaration => None,
        };
        if let Some((offset, what)) = fault {
            return Some((markup.start + offset, what));
        }
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
        if name == "xmlns:xmlns" {
            return Some((at(rest), OWN_PREFIX));
        }
        if let Some(fault) = references(value, at(value)) {
            return Some(fault);
        }
        rest = after;
    }
}

/// The first reference to what is no character of XML; `start` is the text's offset.
fn references(text: &str, start: usize) -> Option<Found> {
    for (at, _) in text.match_indices("&#") {
        // The parser refuses one that does not end.
        let rest = &text[at + 2..];
        let end = rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(rest.len());
        let (digits, rest) = rest.split_at(end);
        if !rest.starts_with(';') {
            continue;
        }
        if !is_character_number(digits) {
            return Some((start + at, NO_CHARACTER));
        }
    }
    None
}

/// Checks that the declaration, if present, names a version 1.x and no encoding other than UTF-8. The parser accepts
/// any.
pub(super) fn check_declaration(text: &str) -> Result<(), XmlError> {
    let found = |range: &Range<usize>| -> String {
        text[range.clone()].chars().take(20).flat_map(char::escape_debug).collect()
    };
    if let Some(range) = wrong_version(text) {
        let found = found(&range);
        let what = format!("the XML declaration names version `{found}`; write `1.0`");
        return Err(XmlError::refused(text, range.start, what));
    }
    let is_utf8 = |range: &Range<usize>| {
        ["utf-8", "utf8"].iter().any(|name| text[range.clone()].eq_ignore_ascii_case(name))
    };
    if let Some(range) = value(text, "encoding").filter(|range| !is_utf8(range)) {
        let found = found(&range);
        let what = format!(
            "the XML declaration names the encoding `{found}`; save the file as UTF-8 and declare that"
        );
        return Err(XmlError::refused(text, range.start, what));
    }
    Ok(())
}

/// The range of the declared version, unless it is 1.0, 1.1 and so on.
pub fn wrong_version(text: &str) -> Option<Range<usize>> {
    let range = value(text, "version")?;
    let digits = text[range.clone()].strip_prefix("1.");
    let is_right = digits.is_some_and(|d| !d.is_empty() && d.bytes().all(|b| b.is_ascii_digit()));
    (!is_right).then_some(range)
}

/// The range of the value of a pseudo-attribute of the declaration.
fn value(text: &str, name: &str) -> Option<Range<usize>> {
    let rest = text.strip_prefix("<?xml")?;
    let rest = rest.starts_with(|c: char| c.is_ascii_whitespace()).then_some(rest)?;
    let declaration = &rest[..rest.find("?>")?];
    let start = text.len() - rest.len();
    let after = declaration.find(name)? + name.len();
    let quote = after + declaration[after..].find(['"', '\''])?;
    let mark = declaration[quote..].chars().next()?;
    let length = declaration[quote + 1..].find(mark)?;
    Some(start + quote + 1..start + quote + 1 + length)
}
