//! The XML declaration: `<?xml version="1.0" encoding="UTF-8"?>`.

use std::ops::Range;

use super::error::XmlError;

/// Checks that the declaration, if present, names a version 1.x and no encoding other than UTF-8. The parser accepts
/// any.
pub(super) fn check(text: &str) -> Result<(), XmlError> {
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
