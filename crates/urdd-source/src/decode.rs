//! Decodes the bytes of a file to text.

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

use crate::error::SourceError;
use crate::note::{Note, NoteKind};

/// The text of a file, and whether its bytes can be stored unchanged. SPEC 6.1.8 requires UTF-8; a byte order mark is
/// harmless.
pub fn decode(
    bytes: &[u8],
    shown: &str,
    notes: &mut Vec<Note>,
) -> Result<(String, bool), SourceError> {
    let (bytes, mark) = match Encoding::for_bom(bytes) {
        Some((encoding, length)) => (&bytes[length..], Some(encoding)),
        None => (bytes, None),
    };
    let declared = declared(bytes);
    if mark.is_none_or(|encoding| encoding == UTF_8)
        && let Ok(text) = std::str::from_utf8(bytes)
    {
        if declared.is_none_or(|encoding| encoding == UTF_8) {
            return Ok((text.to_owned(), true));
        }
        // Declared as another encoding, in which the text is the same, or which the byte order mark contradicts.
        if mark.is_some() || text.is_ascii() {
            return Ok((redeclared(text), false));
        }
    }
    // UTF-16 without a byte order mark: the first character is `<`.
    let guessed = match bytes {
        [b'<', 0, ..] => Some(UTF_16LE),
        [0, b'<', ..] => Some(UTF_16BE),
        _ => None,
    };
    let encoding = mark.or(guessed).or(declared.filter(|encoding| *encoding != UTF_8));
    let mut note = |problem: String, assumed: &str| {
        notes.push(Note::of_file(shown, NoteKind::Encoding, problem, assumed));
    };
    let encoding = match encoding {
        Some(encoding) => {
            let name = encoding.name();
            let problem = format!("the file is encoded in {name}, but URDDs are in UTF-8");
            note(problem, "carried in UTF-8");
            encoding
        }
        None => {
            if let Some(at) = bytes.iter().position(|byte| *byte == 0) {
                return Err(SourceError::Read {
                    file: shown.to_owned(),
                    reason: format!("it is not a text file: its byte {at} is 0; give a URDF"),
                });
            }
            let problem = "the file is not UTF-8, and declares no other encoding".to_owned();
            note(problem, "read as windows-1252, carried in UTF-8");
            WINDOWS_1252
        }
    };
    let (text, had_errors) = encoding.decode_without_bom_handling(bytes);
    if had_errors {
        return Err(SourceError::Read {
            file: shown.to_owned(),
            reason: format!("it is not valid {}; save it as UTF-8", encoding.name()),
        });
    }
    Ok((redeclared(&text), false))
}

/// The byte range of the encoding name in the XML declaration.
fn declaration(text: &[u8]) -> Option<std::ops::Range<usize>> {
    let end = text.windows(2).take(200).position(|pair| pair == b"?>")?;
    let declaration = text.get(..end).filter(|text| text.starts_with(b"<?xml"))?;
    let word = b"encoding";
    let after = declaration.windows(word.len()).position(|w| w == word)? + word.len();
    let quote = after + declaration[after..].iter().position(|b| matches!(b, b'"' | b'\''))?;
    let length = declaration[quote + 1..].iter().position(|b| *b == declaration[quote])?;
    Some(quote + 1..quote + 1 + length)
}

fn declared(bytes: &[u8]) -> Option<&'static Encoding> {
    Encoding::for_label(&bytes[declaration(bytes)?])
}

/// The text with its declared encoding set to UTF-8.
fn redeclared(text: &str) -> String {
    match declaration(text.as_bytes()) {
        Some(range) => format!("{}UTF-8{}", &text[..range.start], &text[range.end..]),
        None => text.to_owned(),
    }
}
