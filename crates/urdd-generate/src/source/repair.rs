//! Repairs of the text itself.

use roxmltree::Error;

use crate::note::{NoteKind, Remark};
use urdd_xml::XmlError;

/// Most prefixes that are declared for a file.
const MOST_PREFIXES: usize = 32;

/// Makes XML of what nearly is: white space before the declaration, a version in it that is not one of
/// XML (Bullet writes `0.0`), NUL bytes after the end (of a C string), and prefixes that stand for nothing (in files for old versions of Gazebo). Gives the text, what was done, and how many
/// lines were taken off its start.
pub(super) fn mend_xml(text: String) -> (String, Vec<Remark>, u32) {
    let mut remarks = Vec::new();
    let mut first_line = 0;
    let mut text = text;
    let trimmed = text.trim_start();
    if trimmed.len() < text.len() && trimmed.starts_with("<?xml") {
        let space = &text[..text.len() - trimmed.len()];
        first_line = u32::try_from(space.matches('\n').count()).unwrap_or_default();
        text = trimmed.to_owned();
        remarks.push(Remark {
            kind: NoteKind::Xml,
            offset: 0,
            problem: "there is white space before the declaration `<?xml …?>`".to_owned(),
            assumed: "taken out".to_owned(),
        });
    }
    if let Some(range) = urdd_xml::wrong_version(&text) {
        let found: String = text[range.clone()].chars().take(20).collect();
        remarks.push(Remark {
            kind: NoteKind::Xml,
            offset: range.start,
            problem: format!("the XML declaration names version `{found}`"),
            assumed: "carried as `1.0`".to_owned(),
        });
        text.replace_range(range, "1.0");
    }
    let end = text.trim_end_matches('\0').len();
    if end < text.len() {
        remarks.push(Remark {
            kind: NoteKind::Xml,
            offset: end,
            problem: "the file ends with a NUL byte".to_owned(),
            assumed: "taken out".to_owned(),
        });
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
        remarks.push(Remark {
            kind: NoteKind::Xml,
            offset: place,
            problem: format!("the prefix `{prefix}` is used and not declared"),
            assumed: "declared at `<robot>`".to_owned(),
        });
        text.insert_str(
            at,
            &format!(" xmlns:{prefix}=\"urn:urdd:undeclared:{prefix}\""),
        );
    }
    (text, remarks, first_line)
}

/// A prefix that the parser does not know, where that is what it stumbles over first.
fn unknown_prefix(text: &str) -> Option<String> {
    match urdd_xml::parse(text, urdd_xml::Kind::Robot) {
        Err(XmlError::Parser(Error::UnknownNamespace(prefix, _))) => Some(prefix),
        _ => None,
    }
}
