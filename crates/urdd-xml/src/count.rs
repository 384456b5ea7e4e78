//! Limits that are checked before parsing.

use std::collections::HashSet;

use super::error::{XmlError, text_pos};
use super::limits::{Kind, MAX_ATTRIBUTES, MAX_LEVELS, MAX_NAMESPACE_BYTES, MAX_PREFIXES};
use super::markup::{self, MarkupKind};

/// Checks the limits tag by tag. Malformed XML is left to the parser.
pub fn check(text: &str, kind: Kind) -> Result<(), XmlError> {
    let mut prefixes: HashSet<&[u8]> = HashSet::new();
    let (mut levels, mut elements) = (0_usize, 0_usize);
    let mut at = 0;
    while let Some(markup) = markup::next(text, at) {
        let end = markup.end.unwrap_or(text.len());
        let inside = &text.as_bytes()[markup.start..end];
        at = end;
        let too_many = |what, limit| {
            XmlError::refused(text, markup.start, format!("there are more than {limit} {what}"))
        };
        match markup.kind {
            MarkupKind::Text | MarkupKind::Instruction => continue,
            MarkupKind::Declaration if inside.starts_with(b"<!ENTITY") => {
                return Err(XmlError::Entities(text_pos(text, markup.start)));
            }
            MarkupKind::Declaration | MarkupKind::Tag => {}
        }
        let (attributes, longest) = count_attributes(inside, &mut prefixes);
        if attributes > MAX_ATTRIBUTES {
            return Err(too_many("attributes of one element", MAX_ATTRIBUTES));
        }
        if longest > MAX_NAMESPACE_BYTES {
            return Err(too_many("bytes in a namespace", MAX_NAMESPACE_BYTES));
        }
        if prefixes.len() > MAX_PREFIXES {
            return Err(too_many("prefixes of namespaces", MAX_PREFIXES));
        }
        if markup.kind == MarkupKind::Declaration {
            continue;
        }
        if inside.starts_with(b"</") {
            levels = levels.saturating_sub(1);
            continue;
        }
        elements += 1;
        if elements > kind.most_elements() {
            return Err(too_many("elements", kind.most_elements()));
        }
        if levels >= MAX_LEVELS {
            return Err(too_many("levels of nested elements", MAX_LEVELS));
        }
        levels += usize::from(!inside.ends_with(b"/>"));
    }
    Ok(())
}

/// The number of `=` outside quotes in a tag, at most one more than [`MAX_ATTRIBUTES`], and the length of the longest
/// namespace. Adds the names between `xmlns:` and such a `=` to `prefixes`.
fn count_attributes<'t>(tag: &'t [u8], prefixes: &mut HashSet<&'t [u8]>) -> (usize, usize) {
    let (mut count, mut longest) = (0, 0);
    let mut quote = None;
    // Start of the last word or value, and whether the word has ended.
    let (mut word, mut ended) = (1, false);
    // Whether the last word before a `=` declares a namespace.
    let mut declares = false;
    for (at, byte) in tag.iter().enumerate().skip(1) {
        match (quote, byte) {
            (Some(open), byte) if *byte == open => {
                longest = longest.max(if declares { at - word } else { 0 });
                (quote, ended) = (None, true);
            }
            (Some(_), _) => {}
            (None, b'"' | b'\'') => (quote, word) = (Some(*byte), at + 1),
            (None, b'=') => {
                count += 1;
                let name = tag[word..at].trim_ascii();
                prefixes.extend(name.strip_prefix(b"xmlns:"));
                declares = name == b"xmlns" || name.starts_with(b"xmlns:");
                ended = true;
            }
            (None, _) if byte.is_ascii_whitespace() => ended = true,
            (None, _) if ended => (word, ended) = (at, false),
            (None, _) => {}
        }
        if count > MAX_ATTRIBUTES {
            break;
        }
    }
    (count, longest)
}
