//! Limits that are checked before parsing.

use std::collections::HashSet;

use super::error::{XmlError, text_pos};
use super::limits::{Kind, MAX_ATTRIBUTES, MAX_COMPARED_BYTES, MAX_LEVELS, MAX_PREFIXES};
use super::markup::{self, MarkupKind};

/// Checks the limits tag by tag. Malformed XML is left to the parser.
pub fn check(text: &str, kind: Kind) -> Result<(), XmlError> {
    let mut prefixes: HashSet<&[u8]> = HashSet::new();
    let (mut levels, mut elements) = (0_usize, 0_usize);
    let (mut longest, mut compared) = (0_usize, 0_usize);
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
        let Attributes { attributes, prefixed, namespace } =
            count_attributes(inside, &mut prefixes);
        if attributes > MAX_ATTRIBUTES {
            return Err(too_many("attributes of one element", MAX_ATTRIBUTES));
        }
        longest = longest.max(namespace);
        compared = compared.saturating_add(longest.saturating_mul(prefixed * prefixed));
        if compared > MAX_COMPARED_BYTES {
            return Err(too_many("bytes of namespaces to compare", MAX_COMPARED_BYTES));
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

/// What is counted in a tag.
#[derive(Default)]
struct Attributes {
    /// The `=` outside quotes, at most one more than [`MAX_ATTRIBUTES`].
    attributes: usize,
    /// Those of names with a prefix that are no declarations of one.
    prefixed: usize,
    /// The length of the longest namespace that is declared, bytes.
    namespace: usize,
}

/// Counts in a tag. Adds the names between `xmlns:` and such a `=` to `prefixes`.
fn count_attributes<'t>(tag: &'t [u8], prefixes: &mut HashSet<&'t [u8]>) -> Attributes {
    let mut found = Attributes::default();
    let mut quote = None;
    // Start of the last word or value, and whether the word has ended.
    let (mut word, mut ended) = (1, false);
    // Whether the last word before a `=` declares a namespace.
    let mut declares = false;
    for (at, byte) in tag.iter().enumerate().skip(1) {
        match (quote, byte) {
            (Some(open), byte) if *byte == open => {
                found.namespace = found.namespace.max(if declares { at - word } else { 0 });
                (quote, ended) = (None, true);
            }
            (Some(_), _) => {}
            (None, b'"' | b'\'') => (quote, word) = (Some(*byte), at + 1),
            (None, b'=') => {
                found.attributes += 1;
                let name = tag[word..at].trim_ascii();
                prefixes.extend(name.strip_prefix(b"xmlns:"));
                declares = name == b"xmlns" || name.starts_with(b"xmlns:");
                found.prefixed += usize::from(!declares && name.contains(&b':'));
                ended = true;
            }
            (None, _) if byte.is_ascii_whitespace() => ended = true,
            (None, _) if ended => (word, ended) = (at, false),
            (None, _) => {}
        }
        if found.attributes > MAX_ATTRIBUTES {
            break;
        }
    }
    found
}
