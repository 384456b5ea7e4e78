//! Repairs that make the text well-formed.

use std::borrow::Cow;
use std::ops::Range;

use urdd_xml::ParserError as Error;

use crate::note::{NoteKind, Remark};
use urdd_xml::element::Edit;
use urdd_xml::{Xml, XmlError};

/// Maximum number of undeclared prefixes that are declared for a file.
const MOST_PREFIXES: usize = 32;

/// What repairs make of a text that is nearly XML.
#[derive(Default)]
pub struct Repaired {
    /// The text, if it was repaired.
    pub text: Option<String>,
    /// What was repaired.
    pub remarks: Vec<Remark>,
    /// The changes, each in the text that those before it gave.
    pub edits: Vec<Edit>,
    /// The number of lines removed from its start.
    pub first_line: u32,
}

/// Repairs nearly well-formed XML: white space before the declaration, an invalid XML version in it (Bullet writes
/// `0.0`), trailing NUL bytes (from C strings), and undeclared prefixes (in files for old versions of Gazebo).
pub fn mend_xml(xml: &Xml<'_>) -> Repaired {
    let mut text = Cow::Borrowed(xml.text());
    let mut repaired = Repaired::default();
    let space = text.len() - text.trim_start().len();
    if space > 0 && text[space..].starts_with("<?xml") {
        repaired.first_line =
            u32::try_from(text[..space].matches('\n').count()).unwrap_or_default();
        let problem = "there is white space before the declaration `<?xml …?>`".to_owned();
        repaired.edit(&mut text, 0..space, String::new());
        repaired.remark(0, problem, "removed");
    }
    if let Some(range) = urdd_xml::wrong_version(&text) {
        let found: String = text[range.clone()].chars().take(20).collect();
        let problem = format!("the XML declaration names version `{found}`");
        repaired.remark(range.start, problem, "carried as `1.0`");
        repaired.edit(&mut text, range, "1.0".to_owned());
    }
    let end = text.trim_end_matches('\0').len();
    if end < text.len() {
        repaired.remark(end, "the file ends with a NUL byte".to_owned(), "removed");
        let range = end..text.len();
        repaired.edit(&mut text, range, String::new());
    }
    for _ in 0..MOST_PREFIXES {
        let prefix = match repaired.edits.is_empty() {
            true => undeclared_prefix(xml),
            false => undeclared_prefix(&Xml::new(&text)),
        };
        let Some(prefix) = prefix else {
            break;
        };
        let Some(at) = text.find("<robot").map(|start| start + "<robot".len()) else {
            break;
        };
        let place = text.find(&format!("{prefix}:")).unwrap_or(at);
        let problem = format!("the prefix `{prefix}` is used and not declared");
        repaired.remark(place, problem, "declared at `<robot>`");
        let declared = format!(" xmlns:{prefix}=\"urn:urdd:undeclared:{prefix}\"");
        repaired.edit(&mut text, at..at, declared);
    }
    repaired.text = (!repaired.edits.is_empty()).then(|| text.into_owned());
    repaired
}

impl Repaired {
    fn edit(&mut self, of: &mut Cow<'_, str>, range: Range<usize>, text: String) {
        of.to_mut().replace_range(range.clone(), &text);
        self.edits.push(Edit { range, text });
    }

    fn remark(&mut self, offset: usize, problem: String, assumed: &str) {
        let assumed = assumed.to_owned();
        self.remarks.push(Remark { kind: NoteKind::Xml, offset, problem, assumed });
    }
}

/// The undeclared prefix, if that is the parser's first error.
pub fn undeclared_prefix(xml: &Xml<'_>) -> Option<String> {
    match xml.document() {
        Err(XmlError::Parser(Error::UnknownNamespace(prefix, _))) => Some(prefix.clone()),
        _ => None,
    }
}
