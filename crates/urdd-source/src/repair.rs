//! Repairs that make the text well-formed.

use urdd_xml::ParserError as Error;

use crate::note::{NoteKind, Remark};
use urdd_xml::XmlError;

/// Maximum number of undeclared prefixes that are declared for a file.
const MOST_PREFIXES: usize = 32;

/// Repairs nearly well-formed XML: white space before the declaration, an invalid XML version in it (Bullet writes
/// `0.0`), trailing NUL bytes (from C strings), and undeclared prefixes (in files for old versions of Gazebo). Returns
/// the text, the remarks, and the number of lines removed from its start.
pub fn mend_xml(mut text: String) -> (String, Vec<Remark>, u32) {
    let mut remarks = Vec::new();
    let mut remark = |offset: usize, problem: String, assumed: &str| {
        let assumed = assumed.to_owned();
        remarks.push(Remark { kind: NoteKind::Xml, offset, problem, assumed });
    };
    let mut first_line = 0;
    let trimmed = text.trim_start();
    if trimmed.len() < text.len() && trimmed.starts_with("<?xml") {
        let space = &text[..text.len() - trimmed.len()];
        first_line = u32::try_from(space.matches('\n').count()).unwrap_or_default();
        text = trimmed.to_owned();
        remark(0, "there is white space before the declaration `<?xml …?>`".to_owned(), "removed");
    }
    if let Some(range) = urdd_xml::wrong_version(&text) {
        let found: String = text[range.clone()].chars().take(20).collect();
        remark(
            range.start,
            format!("the XML declaration names version `{found}`"),
            "carried as `1.0`",
        );
        text.replace_range(range, "1.0");
    }
    let end = text.trim_end_matches('\0').len();
    if end < text.len() {
        remark(end, "the file ends with a NUL byte".to_owned(), "removed");
        text.truncate(end);
    }
    for _ in 0..MOST_PREFIXES {
        let Some(prefix) = unknown_prefix(&text) else {
            break;
        };
        let Some(at) = text.find("<robot").map(|start| start + "<robot".len()) else {
            break;
        };
        let place = text.find(&format!("{prefix}:")).unwrap_or(at);
        remark(
            place,
            format!("the prefix `{prefix}` is used and not declared"),
            "declared at `<robot>`",
        );
        text.insert_str(at, &format!(" xmlns:{prefix}=\"urn:urdd:undeclared:{prefix}\""));
    }
    (text, remarks, first_line)
}

/// The undeclared prefix, if that is the parser's first error.
fn unknown_prefix(text: &str) -> Option<String> {
    match urdd_xml::parse(text, urdd_xml::Kind::Robot) {
        Err(XmlError::Parser(Error::UnknownNamespace(prefix, _))) => Some(prefix),
        _ => None,
    }
}
