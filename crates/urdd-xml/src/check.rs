//! What is checked before parsing: the limits, tag by tag, and faults that the parser does not see: a wrong XML declaration, reserved
//! names, colons in names, prefixes without a namespace, references to characters that XML does not have, document types.

use std::collections::HashSet;
use std::ops::Range;

use crate::error::{
    Kind, MAX_ATTRIBUTES, MAX_COMPARED_BYTES, MAX_LEVELS, MAX_PREFIXES, XmlError, text_pos,
};
use crate::prolog::{self, is_character_number, is_qualified};

/// Checks the limits tag by tag. Malformed XML is left to the parser.
pub fn limits(text: &str, kind: Kind) -> Result<(), XmlError> {
    let mut prefixes: HashSet<&[u8]> = HashSet::new();
    let (mut levels, mut elements) = (0_usize, 0_usize);
    let (mut longest, mut compared) = (0_usize, 0_usize);
    let mut at = 0;
    while let Some(markup) = next_markup(text, at) {
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

const COLON: &str =
    "a name begins or ends with a colon, or has two; a name has at most one, after a prefix";
const RESERVED: &str =
    "`<?xml ...?>` is the XML declaration, in lower case; other targets must not be called `xml`";
const TARGET: &str = "the target of a processing instruction contains a colon; remove it";
const DECLARATION: &str =
    "the XML declaration is not well-formed; write `<?xml version=\"1.0\" encoding=\"UTF-8\"?>`";
const INSTRUCTION: &str =
    "a processing instruction needs a name behind `<?`, and white space behind that; remove it";
const TWICE: &str = "an element has the attribute `xmlns` twice; remove one";
const NO_NAMESPACE: &str = "a prefix is declared with an empty namespace; name one";
const OWN_PREFIX: &str =
    "the prefix `xmlns` is declared; it declares others, and cannot be declared itself";
const NO_CHARACTER: &str = "a reference `&#...;` names no character of XML; remove it";

/// Checks what the parser accepts and XML 1.0 or its namespaces do not. What is broken otherwise is left to the parser. Returns
/// the places of `xmlns` in attributes `prefix:xmlns`, which the parser takes for `xmlns`.
pub fn strict(text: &str) -> Result<Vec<usize>, XmlError> {
    declaration(text)?;
    let mut not_default = Vec::new();
    match fault(text, &mut not_default) {
        Some((at, what)) => Err(XmlError::refused(text, at, what)),
        None => Ok(not_default),
    }
}

type Found = (usize, &'static str);

fn fault(text: &str, not_default: &mut Vec<usize>) -> Option<Found> {
    let mut at = 0;
    while let Some(markup) = next_markup(text, at) {
        if let Some(fault) = references(&text[at..markup.start], at) {
            return Some(fault);
        }
        at = markup.end?;
        let inside = &text[markup.start..at];
        let fault = match markup.kind {
            MarkupKind::Instruction => {
                let at_start = matches!(&text[..markup.start], "" | "\u{feff}");
                let what = instruction(&text[markup.start..], at_start);
                what.map(|what| (0, what))
            }
            MarkupKind::Tag => tag(&inside[1..inside.len() - 1], markup.start + 1, not_default)
                .map(|(at, what)| (at + 1, what)),
            MarkupKind::Declaration if inside.starts_with("<!DOCTYPE") => {
                prolog::fault(&text[markup.start..])
            }
            MarkupKind::Text | MarkupKind::Declaration => None,
        };
        if let Some((offset, what)) = fault {
            return Some((markup.start + offset, what));
        }
    }
    None
}

/// The fault of the processing instruction that a text begins with.
fn instruction(text: &str, at_start: bool) -> Option<&'static str> {
    let target = text[2..].split(|c: char| c.is_ascii_whitespace() || c == '?').next()?;
    match target {
        "xml" if at_start => (!prolog::has_declaration(text)).then_some(DECLARATION),
        // The parser says it.
        "xml" if text.starts_with("<?xml ") => None,
        _ if target.eq_ignore_ascii_case("xml") => Some(RESERVED),
        _ if target.contains(':') => Some(TARGET),
        _ => (!prolog::has_instruction(text)).then_some(INSTRUCTION),
    }
}

/// The fault of a tag, without `<` and `>`, and its offset. Adds where its attributes `prefix:xmlns` have their `xmlns`; `start`
/// is where the tag is.
fn tag(text: &str, start: usize, not_default: &mut Vec<usize>) -> Option<Found> {
    let is_space = |c: char| c.is_ascii_whitespace();
    let body = text.strip_prefix('/').unwrap_or(text);
    let body = body.strip_suffix('/').unwrap_or(body);
    let name = body.split(is_space).next()?;
    if !is_qualified(name) {
        return Some((0, COLON));
    }
    let mut rest = &body[name.len()..];
    let mut has_default = false;
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
        if name == "xmlns" && std::mem::replace(&mut has_default, true) {
            return Some((at(rest), TWICE));
        }
        if name.ends_with(":xmlns") {
            not_default.push(start + at(rest) + name.len() - "xmlns".len());
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
fn declaration(text: &str) -> Result<(), XmlError> {
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

/// What a `<` begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum MarkupKind {
    /// A comment, or a CDATA section.
    Text,
    /// `<?target …?>`.
    Instruction,
    /// `<!DOCTYPE …` up to its `[`, and the declarations inside it.
    Declaration,
    /// `<a>`, `<a/>`, `</a>`.
    Tag,
}

struct Markup {
    kind: MarkupKind,
    /// Byte offset of its `<`.
    start: usize,
    /// Byte offset of its end; `None` if it has none.
    end: Option<usize>,
}

/// The first markup from byte `at` on.
fn next_markup(text: &str, at: usize) -> Option<Markup> {
    let start = at + text[at..].find('<')?;
    let rest = &text[start..];
    // `<!-->` starts a comment but does not end it.
    let until =
        |head: &str, mark: &str| Some(head.len() + rest[head.len()..].find(mark)? + mark.len());
    let (kind, length) = if rest.starts_with("<!--") {
        (MarkupKind::Text, until("<!--", "-->"))
    } else if rest.starts_with("<![CDATA[") {
        (MarkupKind::Text, until("<![CDATA[", "]]>"))
    } else if rest.starts_with("<?") {
        (MarkupKind::Instruction, until("<?", "?>"))
    } else if rest.starts_with("<!DOCTYPE") {
        (MarkupKind::Declaration, tag_length(rest, b">["))
    } else if rest.starts_with("<!") {
        // The parser knows no quotes in them.
        (MarkupKind::Declaration, until("<!", ">"))
    } else {
        (MarkupKind::Tag, tag_length(rest, b">"))
    };
    Some(Markup { kind, start, end: length.map(|length| start + length) })
}

/// The length up to the first of `ends` outside quotes.
fn tag_length(text: &str, ends: &[u8]) -> Option<usize> {
    let mut quote = None;
    let end = text.bytes().position(|byte| match quote {
        Some(open) => {
            quote = (byte != open).then_some(open);
            false
        }
        None => {
            quote = matches!(byte, b'"' | b'\'').then_some(byte);
            ends.contains(&byte)
        }
    });
    Some(end? + 1)
}

/// The qualified name of the outermost element of a text, found without parsing it; `None` if there is none.
pub fn root_name(text: &str) -> Option<&str> {
    let mut at = 0;
    loop {
        let markup = next_markup(text, at)?;
        if markup.kind == MarkupKind::Tag {
            // White space there is tinyxml2's.
            let name = text[markup.start + 1..].trim_start();
            let end = name.find(|c: char| c.is_ascii_whitespace() || matches!(c, '>' | '/'))?;
            return Some(&name[..end]).filter(|name| !name.is_empty());
        }
        at = markup.end?;
    }
}
