//! Parses XML from anybody. Knows no URDD.
//!
//! `roxmltree` compares each attribute of an element with the others, and copies the namespaces of
//! an element to those below it that declare one: time and memory with the square, or the cube, of
//! what a small file can hold. So both are counted before it is called.

use std::collections::HashSet;

use roxmltree::{Document, ParsingOptions, TextPos};

/// Most nodes of a document: a robot of 2,000 links has some 100,000.
pub const MOST_NODES: u32 = 4_000_000;

/// Most attributes of one element, declarations of namespaces among them; real ones have up to 10.
pub const MOST_ATTRIBUTES: usize = 256;

/// Most prefixes that a document declares; real ones have up to 10.
pub const MOST_PREFIXES: usize = 64;

/// Why a text is not parsed.
#[derive(Debug)]
pub enum XmlError {
    /// It is not well-formed, declares entities, or has too many nodes.
    Parser(roxmltree::Error),
    /// It has more of something than any document needs.
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// How many are allowed.
        limit: usize,
        /// Where the element begins that has it.
        pos: TextPos,
    },
}

impl XmlError {
    /// Where it is.
    pub fn pos(&self) -> TextPos {
        match self {
            XmlError::Parser(error) => error.pos(),
            XmlError::TooMany { pos, .. } => *pos,
        }
    }

    /// What is wrong, without the place.
    pub fn words(&self) -> String {
        match self {
            XmlError::Parser(error) => {
                let words = error.to_string();
                match words.rsplit_once(" at ") {
                    Some((words, place)) if place.contains(':') => words.to_owned(),
                    _ => words,
                }
            }
            XmlError::TooMany { what, limit, .. } => format!("there are more than {limit} {what}"),
        }
    }
}

/// Parses a document.
///
/// A document that declares entities of its own is an error: they are how small files grow large. A
/// mere `<!DOCTYPE robot>` does no harm, where `allow_doctype` lets it pass; what it names outside
/// the file is never fetched.
///
/// # Errors
/// Where it is not well-formed, or has too much of something.
pub fn parse(text: &str, allow_doctype: bool) -> Result<Document<'_>, XmlError> {
    check_counts(text)?;
    let options = ParsingOptions {
        allow_dtd: allow_doctype && !text.contains("<!ENTITY"),
        nodes_limit: MOST_NODES,
        ..ParsingOptions::default()
    };
    Document::parse_with_options(text, options).map_err(XmlError::Parser)
}

/// Counts attributes and prefixes, tag by tag; what is not well-formed is left to the parser.
fn check_counts(text: &str) -> Result<(), XmlError> {
    let mut prefixes: HashSet<&[u8]> = HashSet::new();
    let bytes = text.as_bytes();
    let mut at = 0;
    while let Some(found) = find(bytes, at, b"<") {
        let rest = &bytes[found..];
        // `<!-->` begins a comment and does not end it.
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
            Some(tag.end)
        };
        match end {
            Some(end) => at = end,
            None => break,
        }
    }
    Ok(())
}

/// What is counted of a tag.
struct Tag<'t> {
    /// Signs of equality outside of quotes.
    attributes: usize,
    /// What stands between `xmlns:` and such a sign.
    prefixes: Vec<&'t [u8]>,
    /// Where it ends.
    end: usize,
}

impl<'t> Tag<'t> {
    fn read(bytes: &'t [u8], start: usize) -> Self {
        let mut tag = Tag {
            attributes: 0,
            prefixes: Vec::new(),
            end: bytes.len(),
        };
        let mut quote = None;
        // Where the last word began, and whether it has ended.
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
                // A declaration of a DOCTYPE holds others.
                (None, b'>' | b'[') => {
                    tag.end = at + 1;
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

/// The line and column of a byte, as the parser counts them.
fn text_pos(text: &str, offset: usize) -> TextPos {
    let before = &text[..offset];
    let line = before.rsplit('\n').next().unwrap_or_default();
    let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    TextPos::new(
        count(before.matches('\n').count() + 1),
        count(line.chars().count() + 1),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn attributes(count: usize) -> String {
        (0..count).map(|n| format!(" a{n}=\"=\"")).collect()
    }

    fn result(text: &str) -> Result<(), String> {
        let parsed = parse(text, true).map(|_| ());
        parsed.map_err(|error| format!("{}: {}", error.pos(), error.words()))
    }

    #[test]
    fn attributes_are_bounded() {
        let most = attributes(MOST_ATTRIBUTES);
        assert_eq!(result(&format!("<r><a{most}/><b{most}/></r>")), Ok(()));
        let text = format!("<r>\n é<a b='>'{most}/></r>");
        let expected = "2:3: there are more than 256 attributes of one element";
        assert_eq!(result(&text), Err(expected.to_owned()));
    }

    #[test]
    fn prefixes_are_bounded() {
        let declared = |from: usize, to: usize| -> String {
            let one = |n: usize| format!("<a xmlns:p{n} = 'u'>");
            (from..to).map(one).collect()
        };
        let ends = |count: usize| "</a>".repeat(count);
        let most = declared(0, MOST_PREFIXES) + &ends(MOST_PREFIXES);
        assert_eq!(result(&format!("<r>{most}{most}</r>")), Ok(()));
        let more = declared(0, MOST_PREFIXES + 1) + &ends(MOST_PREFIXES + 1);
        assert!(result(&more).unwrap_err().contains("more than 64 prefixes"));
    }

    #[test]
    fn quotes_elsewhere_hide_no_attributes() {
        let many = format!("<a{}/>", attributes(MOST_ATTRIBUTES + 1));
        let before = [
            "<r><!--> <b ' -->",
            "<r><?p <b '?>",
            "<r><![CDATA[<b ']]>",
            "<r>'",
            "<!DOCTYPE r [ <!-- ' --> <!ATTLIST r a CDATA \"<b '\"> <?p '?> ]><r>",
        ];
        for before in before {
            assert_eq!(result(&format!("{before}<a/>'</r>")), Ok(()), "{before}");
            let error = result(&format!("{before}{many}'</r>")).unwrap_err();
            assert!(error.contains("256 attributes"), "{before}: {error}");
        }
    }

    #[test]
    fn text_that_looks_like_attributes_is_none() {
        let signs = "=".repeat(2 * MOST_ATTRIBUTES);
        let text = format!(
            "<?p <{signs}?><r><!-- <{signs}> --><![CDATA[<{signs}]]>{signs}<a b=\"{signs}\"/></r>"
        );
        assert_eq!(result(&text), Ok(()));
    }

    #[test]
    fn what_is_broken_is_told_by_the_parser() {
        for text in [
            "",
            "<",
            "<r",
            "<!--",
            "<r a='",
            "<![CDATA[",
            "<?",
            "<r a=b>",
            "<!DOCTYPE",
        ] {
            assert!(result(text).is_err(), "{text}");
        }
    }
}
