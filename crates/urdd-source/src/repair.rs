//! Repairs that make the text well-formed.

use std::borrow::Cow;

use urdd_xml::ParserError as Error;

use crate::note::{NoteKind, Remark};
use urdd_xml::{Xml, XmlError};

/// Maximum number of undeclared prefixes that are declared for a file.
const MOST_PREFIXES: usize = 32;

/// Repairs nearly well-formed XML: white space before the declaration, an invalid XML version in it (Bullet writes
/// `0.0`), trailing NUL bytes (from C strings), and undeclared prefixes (in files for old versions of Gazebo). Returns
/// the text if it was repaired, the remarks, and the number of lines removed from its start.
pub fn mend_xml(xml: &Xml<'_>) -> (Option<String>, Vec<Remark>, u32) {
    let mut text = Cow::Borrowed(xml.text());
    let mut remarks = Vec::new();
    let mut first_line = 0;
    let trimmed = xml.text().trim_start();
    if trimmed.len() < text.len() && trimmed.starts_with("<?xml") {
        let space = &text[..text.len() - trimmed.len()];
        first_line = u32::try_from(space.matches('\n').count()).unwrap_or_default();
        text = trimmed.into();
        let problem = "there is white space before the declaration `<?xml …?>`".to_owned();
        remarks.push(remark(0, problem, "removed"));
    }
    if let Some(range) = urdd_xml::wrong_version(&text) {
        let found: String = text[range.clone()].chars().take(20).collect();
        let problem = format!("the XML declaration names version `{found}`");
        remarks.push(remark(range.start, problem, "carried as `1.0`"));
        text.to_mut().replace_range(range, "1.0");
    }
    let end = text.trim_end_matches('\0').len();
    if end < text.len() {
        remarks.push(remark(end, "the file ends with a NUL byte".to_owned(), "removed"));
        text.to_mut().truncate(end);
    }
    for _ in 0..MOST_PREFIXES {
        let prefix = match remarks.is_empty() {
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
        remarks.push(remark(place, problem, "declared at `<robot>`"));
        text.to_mut().insert_str(at, &format!(" xmlns:{prefix}=\"urn:urdd:undeclared:{prefix}\""));
    }
    ((!remarks.is_empty()).then(|| text.into_owned()), remarks, first_line)
}

fn remark(offset: usize, problem: String, assumed: &str) -> Remark {
    Remark { kind: NoteKind::Xml, offset, problem, assumed: assumed.to_owned() }
}

/// The undeclared prefix, if that is the parser's first error.
pub fn undeclared_prefix(xml: &Xml<'_>) -> Option<String> {
    match xml.document() {
        Err(XmlError::Parser(Error::UnknownNamespace(prefix, _))) => Some(prefix.clone()),
        _ => None,
    }
}
