//! The text of a file: decodes its bytes, and makes it well-formed.

use std::borrow::Cow;
use std::ops::Range;

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};
use urdd_xml::element::Edit;
use urdd_xml::foreign::foreign;
use urdd_xml::{ParserError as Error, Xml, XmlError};

use crate::error::SourceError;
use crate::note::{Note, NoteKind, Remark};

/// The text of a file.
#[derive(Debug)]
pub struct Decoded {
    /// The text.
    pub text: String,
    /// Whether the bytes can be stored unchanged. SPEC 6.1.8 requires UTF-8; a byte order mark is harmless.
    pub is_verbatim: bool,
    /// How the bytes became it.
    pub decoding: Decoding,
}

/// How the bytes of a file became its text.
#[derive(Debug, Clone)]
pub struct Decoding {
    /// The bytes before the text: a byte order mark.
    mark: usize,
    encoding: &'static Encoding,
    /// The name of another encoding, in the text before `UTF-8` took its place.
    renamed: Option<Range<usize>>,
}

/// A file whose bytes are not those of its text.
#[derive(Debug, Clone)]
pub struct Original {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// How they became the text.
    pub decoding: Decoding,
}

/// Where bytes of a file are in its text; by default, the bytes are the text.
#[derive(Debug, Default)]
pub struct TextOffsets {
    decoding: Decoding,
    /// Of each byte behind the mark, the character that it is of; none if the bytes are the text.
    decoded: Option<Vec<usize>>,
}

impl Default for Decoding {
    /// The bytes are the text.
    fn default() -> Self {
        Decoding { mark: 0, encoding: UTF_8, renamed: None }
    }
}

impl Original {
    /// Where its bytes are in the text.
    pub fn offsets(&self) -> TextOffsets {
        let Decoding { mark, encoding, .. } = self.decoding;
        let is_other = encoding != UTF_8;
        let decoded = self.bytes.get(mark..).filter(|_| is_other);
        let decoded = decoded.map(|bytes| decoded_offsets(encoding, bytes));
        TextOffsets { decoding: self.decoding.clone(), decoded }
    }
}

impl TextOffsets {
    /// The offset in the text of a byte of the file; for one of the mark, the beginning.
    pub fn of(&self, byte: usize) -> usize {
        let byte = byte.saturating_sub(self.decoding.mark);
        let decoded = match &self.decoded {
            None => byte,
            Some(offsets) => offsets.get(byte).or(offsets.last()).copied().unwrap_or_default(),
        };
        match &self.decoding.renamed {
            Some(name) if decoded >= name.end => decoded - name.len() + UTF_8.name().len(),
            Some(name) => decoded.min(name.start),
            None => decoded,
        }
    }
}

/// Of each byte, and of the end, how long the text is before it: the bytes are decoded one by one.
fn decoded_offsets(encoding: &'static Encoding, bytes: &[u8]) -> Vec<usize> {
    let mut decoder = encoding.new_decoder_without_bom_handling();
    let mut text = [0; 64];
    let mut length = 0;
    let mut offsets = Vec::with_capacity(bytes.len() + 1);
    for byte in bytes {
        offsets.push(length);
        let (_, _, written, _) = decoder.decode_to_utf8(&[*byte], &mut text, false);
        length += written;
    }
    offsets.push(length);
    offsets
}

/// The text of a file.
pub fn decode(bytes: &[u8], shown: &str, notes: &mut Vec<Note>) -> Result<Decoded, SourceError> {
    // Zeros may be text, at the end of a URDF; in a mesh they are not.
    if let Some(foreign) = foreign(bytes).filter(|_| bytes.contains(&0)) {
        return Err(SourceError::unread(shown, foreign));
    }
    let (bytes, mark, length) = match Encoding::for_bom(bytes) {
        Some((encoding, length)) => (&bytes[length..], Some(encoding), length),
        None => (bytes, None, 0),
    };
    let of = |text: String, encoding| {
        let renamed = declaration(text.as_bytes());
        let text = match &renamed {
            Some(name) => format!("{}UTF-8{}", &text[..name.start], &text[name.end..]),
            None => text,
        };
        Decoded { text, is_verbatim: false, decoding: Decoding { mark: length, encoding, renamed } }
    };
    let declared = declared(bytes);
    if mark.is_none_or(|encoding| encoding == UTF_8)
        && let Ok(text) = std::str::from_utf8(bytes)
    {
        if declared.is_none_or(|encoding| encoding == UTF_8) {
            let decoding = Decoding { mark: length, ..Decoding::default() };
            return Ok(Decoded { text: text.to_owned(), is_verbatim: true, decoding });
        }
        // Declared as another encoding, in which the text is the same, or which the byte order mark contradicts.
        if mark.is_some() || text.is_ascii() {
            return Ok(of(text.to_owned(), UTF_8));
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
                let reason = format!("it is not a text file: its byte {at} is 0; give a URDF");
                return Err(SourceError::unread(shown, reason));
            }
            let problem = "the file is not UTF-8, and declares no other encoding".to_owned();
            note(problem, "read as windows-1252, carried in UTF-8");
            WINDOWS_1252
        }
    };
    let (text, had_errors) = encoding.decode_without_bom_handling(bytes);
    if had_errors {
        let reason = format!("it is not valid {}; save it as UTF-8", encoding.name());
        return Err(SourceError::unread(shown, reason));
    }
    Ok(of(text.into_owned(), encoding))
}

/// The byte range of the encoding name in the XML declaration.
fn declaration(text: &[u8]) -> Option<Range<usize>> {
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
