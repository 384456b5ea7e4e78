//! Limits that are checked before parsing.

use std::collections::HashSet;

use super::error::{XmlError, text_pos};
use super::limits::{Kind, MOST_ATTRIBUTES, MOST_LEVELS, MOST_PREFIXES};

/// Checks the limits tag by tag. Malformed XML is left to the parser.
pub(super) fn check(text: &str, kind: Kind) -> Result<(), XmlError> {
    let mut prefixes: HashSet<&[u8]> = HashSet::new();
    let (mut levels, mut elements) = (0_usize, 0_usize);
    let bytes = text.as_bytes();
    let mut at = 0;
    while let Some(found) = find(bytes, at, b"<") {
        let rest = &bytes[found..];
        // `<!-->` starts a comment but does not end it.
        let end_of = |start: &[u8], mark: &[u8]| {
            find(bytes, found + start.len(), mark).map(|end| end + mark.len())
        };
        let end = if rest.starts_with(b"<!--") {
            end_of(b"<!--", b"-->")
        } else if rest.starts_with(b"<![CDATA[") {
            end_of(b"<![CDATA[", b"]]>")
        } else if rest.starts_with(b"<?") {
            end_of(b"<?", b"?>")
        } else {
            let tag = Tag::read(bytes, found);
            let too_many = |what, limit| XmlError::TooMany {
                what,
                limit,
                pos: text_pos(text, found),
            };
            if tag.attributes > MOST_ATTRIBUTES {
                return Err(too_many("attributes of one element", MOST_ATTRIBUTES));
            }
            prefixes.extend(tag.prefixes);
            if prefixes.len() > MOST_PREFIXES {
                return Err(too_many("prefixes of namespaces", MOST_PREFIXES));
            }
            match tag.kind {
                TagKind::Start | TagKind::Empty => {
                    elements += 1;
                    if elements > kind.most_elements() {
                        return Err(too_many("elements", kind.most_elements()));
                    }
                    if levels >= MOST_LEVELS {
                        let what = "levels of nested elements";
                        return Err(too_many(what, MOST_LEVELS));
                    }
                    levels += usize::from(tag.kind == TagKind::Start);
                }
                TagKind::End => levels = levels.saturating_sub(1),
                TagKind::Declaration => {
                    if rest.starts_with(b"<!ENTITY") {
                        return Err(XmlError::Entities(text_pos(text, found)));
                    }
                }
            }
            Some(tag.end)
        };
        match end {
            Some(end) => at = end,
            None => break,
        }
    }
    Ok(())
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TagKind {
    /// `<a>`.
    Start,
    /// `<a/>`.
    Empty,
    /// `</a>`.
    End,
    /// `<!DOCTYPE …`, and the declarations inside it.
    Declaration,
}

/// The counted properties of a tag.
struct Tag<'t> {
    kind: TagKind,
    /// Number of `=` outside quotes.
    attributes: usize,
    /// The names between `xmlns:` and such a `=`.
    prefixes: Vec<&'t [u8]>,
    /// Byte offset of its end.
    end: usize,
}

impl<'t> Tag<'t> {
    fn read(bytes: &'t [u8], start: usize) -> Self {
        let mut tag = Tag {
            kind: match bytes.get(start + 1) {
                Some(b'/') => TagKind::End,
                Some(b'!') => TagKind::Declaration,
                _ => TagKind::Start,
            },
            attributes: 0,
            prefixes: Vec::new(),
            end: bytes.len(),
        };
        let mut quote = None;
        // Start of the last word, and whether the word has ended.
        let (mut word, mut ended) = (start + 1, false);
        for (offset, byte) in bytes[start + 1..].iter().enumerate() {
            let at = start + 1 + offset;
            match (quote, byte) {
                (Some(open), byte) if *byte == open => {
                    quote = None;
                    ended = true;
                }
                (Some(_), _) => {}
                (None, b'"' | b'\'') => quote = Some(*byte),
                (None, b'=') => {
                    tag.attributes += 1;
                    let name = bytes[word..at].trim_ascii();
                    tag.prefixes.extend(name.strip_prefix(b"xmlns:"));
                    ended = true;
                }
                // A DOCTYPE contains other declarations.
                (None, b'>' | b'[') => {
                    tag.end = at + 1;
                    if tag.kind == TagKind::Start && bytes[at - 1] == b'/' {
                        tag.kind = TagKind::Empty;
                    }
                    break;
                }
                (None, _) if byte.is_ascii_whitespace() => ended = true,
                (None, _) if ended => (word, ended) = (at, false),
                (None, _) => {}
            }
            if tag.attributes > MOST_ATTRIBUTES {
                break;
            }
        }
        tag
    }
}

fn find(bytes: &[u8], from: usize, mark: &[u8]) -> Option<usize> {
    let rest = bytes.get(from..)?;
    let first = mark.first()?;
    let mut at = 0;
    loop {
        at += rest[at..].iter().position(|byte| byte == first)?;
        if rest[at..].starts_with(mark) {
            return Some(from + at);
        }
        at += 1;
    }
}
