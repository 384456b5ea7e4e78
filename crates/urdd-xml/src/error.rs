//! What a document may have; why one is rejected, where, and what to do.

use crate::foreign::foreign;
use roxmltree::{Error, TextPos};

/// Maximum nesting depth. A URDF has 6 levels and a COLLADA scene some 20; that of a snake robot with 100 joints has
/// 110.
pub const MAX_LEVELS: usize = 256;

/// Maximum number of nodes of a document: elements, texts, comments. A robot with 2,000 links has some 100,000.
pub const MAX_NODES: usize = 4_000_000;

/// Maximum number of elements of a URDF: enough for some 20,000 links with two shapes each.
pub const MAX_ROBOT_ELEMENTS: usize = 500_000;

/// Maximum number of attributes of one element, including namespace declarations; real ones have up to 10.
pub const MAX_ATTRIBUTES: usize = 256;

/// Maximum number of namespace prefixes of a document; real ones have up to 10.
pub const MAX_PREFIXES: usize = 64;

/// Maximum number of bytes of namespaces that are compared: the parser compares the attributes of an element that have a
/// prefix with one another. Real documents have up to a million.
pub const MAX_COMPARED_BYTES: usize = 1 << 30;

/// The kind of document to parse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A URDF (SPEC 6.1.8): at most [`MAX_ROBOT_ELEMENTS`] elements. A `<!DOCTYPE robot>` is skipped; external files
    /// that it references are never fetched.
    Robot,
    /// Any other document, such as a COLLADA scene. A document type is an error.
    Other,
    /// A document as another program's parser has it: as [`Kind::Other`], but a document type is skipped.
    Lenient,
}

impl Kind {
    pub(super) fn most_elements(self) -> usize {
        match self {
            Kind::Robot => MAX_ROBOT_ELEMENTS,
            Kind::Other | Kind::Lenient => MAX_NODES,
        }
    }
}

/// Why a document was rejected.
#[derive(Debug)]
pub enum XmlError {
    /// Not well-formed XML.
    Parser(Error),
    /// It declares entities, which can expand a small file exponentially.
    Entities(TextPos),
    /// The parser would accept it: a wrong XML declaration, another fault that the parser does not see, or more items
    /// than a limit.
    Refused {
        /// What is wrong, and what to do.
        what: String,
        /// Its position.
        pos: TextPos,
    },
}

impl XmlError {
    /// The position of the error.
    pub fn pos(&self) -> TextPos {
        match self {
            XmlError::Parser(error) => error.pos(),
            XmlError::Entities(pos) | XmlError::Refused { pos, .. } => *pos,
        }
    }

    /// The byte of the error in the text that was parsed; its length for a place beyond it.
    pub fn offset(&self, text: &str) -> usize {
        offset(text, self.pos())
    }

    /// The error message for `text`, without the position: what is wrong and what to do.
    pub fn words(&self, text: &str) -> String {
        match self {
            XmlError::Parser(error) => of_parser(error, text),
            XmlError::Entities(_) => {
                "it declares entities (`<!ENTITY`), which are not supported; `xmllint --noent FILE` writes the file without them".to_owned()
            }
            XmlError::Refused { what, .. } => what.clone(),
        }
    }

    /// As [`XmlError::words`], as a sentence: of a file of another kind, what it is.
    pub fn sentence(&self, text: &str) -> String {
        match foreign(text.as_bytes()) {
            Some(foreign) => foreign.to_string(),
            None => format!("not well-formed XML: {}", self.words(text)),
        }
    }

    pub(super) fn refused(text: &str, offset: usize, what: impl Into<String>) -> Self {
        XmlError::Refused { what: what.into(), pos: text_pos(text, offset) }
    }
}

/// The line and column of a byte, counted as the parser does.
pub fn text_pos(text: &str, offset: usize) -> TextPos {
    let before = &text[..offset];
    let line = before.rsplit('\n').next().unwrap_or_default();
    let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    TextPos::new(count(before.matches('\n').count() + 1), count(line.chars().count() + 1))
}

/// The byte at a line and column that are counted as the parser does: lines end at `\n` alone.
fn offset(text: &str, pos: TextPos) -> usize {
    let lines = text.split_inclusive('\n').take((pos.row as usize).saturating_sub(1));
    let start: usize = lines.map(str::len).sum();
    let before = text[start..].chars().take((pos.col as usize).saturating_sub(1));
    start + before.map(char::len_utf8).sum::<usize>()
}

/// The message for a parser error, without the position.
fn of_parser(error: &Error, text: &str) -> String {
    match error {
        Error::InvalidXmlPrefixUri(_)
        | Error::UnexpectedXmlUri(_)
        | Error::UnexpectedXmlnsUri(_)
        | Error::InvalidElementNamePrefix(_) => {
            "the prefixes `xml` and `xmlns` are reserved; use another prefix".to_owned()
        }
        Error::DuplicatedNamespace(prefix, _) if prefix.is_empty() => {
            "an element declares `xmlns` twice; remove one of them".to_owned()
        }
        Error::DuplicatedNamespace(prefix, _) => {
            format!("an element declares the prefix `{prefix}` twice; remove one of the declarations")
        }
        Error::UnknownNamespace(prefix, _) if prefix == "xacro" => {
            "the prefix `xacro` is not declared; expand the file with xacro first".to_owned()
        }
        Error::UnknownNamespace(prefix, _) => format!(
            "the prefix `{prefix}` is not declared; declare it with `xmlns:{prefix}=\"...\"`, or remove it"
        ),
        Error::UnexpectedCloseTag(expected, found, _) => {
            format!("`</{found}>` where `</{expected}>` is expected; close an element before its parent")
        }
        Error::UnknownEntityReference(name, _) => format!(
            "the entity `&{name};` is not declared; XML itself defines only `&amp;`, `&lt;`, `&gt;`, `&quot;` and `&apos;`"
        ),
        Error::MalformedEntityReference(_) => {
            "`&` does not begin an entity here; write `&amp;` for the character".to_owned()
        }
        Error::UnexpectedEntityCloseTag(_)
        | Error::EntityReferenceLoop(_)
        | Error::EntityResolver(..) => {
            "an entity of the document type cannot be expanded; write out what it stands for".to_owned()
        }
        Error::InvalidAttributeValue(_) | Error::InvalidChar(b'\'' | b'"', b'<', _) => {
            "an attribute's value contains `<`; write `&lt;`, or close the value's quotes before it"
                .to_owned()
        }
        Error::DuplicatedAttribute(name, _) => {
            format!("an element has the attribute `{name}` twice; remove one of them")
        }
        Error::UnexpectedDeclaration(_) => {
            "the XML declaration `<?xml ...?>` must be at the very start of the file, once".to_owned()
        }
        Error::DtdDetected => {
            "a document type (`<!DOCTYPE`) is not supported here; remove it".to_owned()
        }
        Error::NoRootNode | Error::UnclosedRootNode | Error::UnexpectedEndOfStream => {
            let is_empty = text.trim().is_empty();
            let cut = "the file ends before its outermost element is closed; it may be cut off";
            if is_empty { "the file is empty" } else { cut }.to_owned()
        }
        Error::NodesLimitReached => {
            format!("the file has more than {MAX_NODES} elements, texts and comments")
        }
        Error::AttributesLimitReached | Error::NamespacesLimitReached => {
            "the file has too many attributes or namespaces".to_owned()
        }
        Error::InvalidName(_) => {
            "a name begins with, or contains, a character that XML does not allow in names; names begin with a letter or `_`"
                .to_owned()
        }
        Error::NonXmlChar(c, _) => format!(
            "XML does not allow the character U+{:04X}; remove it",
            u32::from(*c)
        ),
        Error::InvalidChar(expected, found, _) => {
            expected_character(&format!("`{}`", char::from(*expected)), *found)
        }
        Error::InvalidChar2(expected, found, _) => expected_character(expected, *found),
        Error::InvalidString(expected, _) => format!("expected `{expected}` here"),
        Error::InvalidExternalID(_) => {
            "the document type (`<!DOCTYPE`) is not well-formed; remove it".to_owned()
        }
        Error::InvalidComment(_) => {
            "a comment contains `--`, or ends with `--->`; write single hyphens".to_owned()
        }
        Error::InvalidCharacterData(_) => {
            "text contains `]]>`; write `]]&gt;` for the characters".to_owned()
        }
        Error::UnknownToken(pos) => unknown_token(text, *pos).to_owned(),
    }
}

fn expected_character(expected: &str, found: u8) -> String {
    let found = match found {
        b' '..=b'~' => format!("`{}`", char::from(found)),
        b'\n' | b'\r' => "the end of the line".to_owned(),
        other => format!("the byte 0x{other:02X}"),
    };
    format!("expected {expected}, found {found}")
}

/// The parser reports the same error for three faults; the position distinguishes them.
fn unknown_token(text: &str, pos: TextPos) -> &'static str {
    let before = &text[..offset(text, pos)];
    let in_document_type =
        before.rfind("<!DOCTYPE").is_some_and(|begin| !before[begin..].contains("]>"));
    if before.trim_start_matches('\u{feff}').trim().is_empty() {
        "the file does not begin with `<`; remove what is before the first element"
    } else if in_document_type {
        "a declaration within `<!DOCTYPE ...>` cannot be read; remove the document type"
    } else {
        "there is more after the end of the outermost element; remove it"
    }
}
