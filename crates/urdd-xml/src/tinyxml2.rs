//! XML as tinyxml2 takes it apart: urdfdom, MuJoCo, Drake, PyBullet and libsdformat read by it. It knows no namespaces,
//! keeps entities that it does not know, and ends at a NUL.

use std::borrow::Cow;
use std::ops::Range;

use crate::error::MAX_ATTRIBUTES;
use crate::tally;

/// Why a document is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Malformed {
    /// Where, bytes of the file.
    pub at: usize,
    /// What is wrong.
    pub why: &'static str,
}

/// An attribute.
#[derive(Debug)]
pub struct Attribute<'a> {
    /// Its name, with its prefix.
    pub name: Cow<'a, str>,
    /// Its value, entities replaced.
    pub value: Cow<'a, str>,
    /// From its name to the closing quote, bytes of the file.
    pub range: Range<usize>,
}

/// What a document is made of.
#[derive(Debug)]
pub enum Event<'a> {
    /// A start tag.
    Start {
        /// The name, with its prefix.
        name: Cow<'a, str>,
        /// The attributes, no two of one name.
        attributes: Vec<Attribute<'a>>,
        /// From `<` to the end of the tag, bytes of the file.
        tag: Range<usize>,
        /// Whether it is closed already.
        is_empty: bool,
    },
    /// The end tag of the element that is open.
    End,
    /// Text, and where it begins behind white space.
    Text(Cow<'a, str>, usize),
    /// CDATA.
    Data(Cow<'a, str>),
    /// `<!…>` that is neither a comment nor CDATA.
    Unknown,
}

/// Takes a document apart.
pub struct Parser<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The elements that are not closed yet: name and place.
    open: Vec<(&'a [u8], usize)>,
    /// Whether `<?` may come yet: declarations come before all else.
    declares: bool,
}

type Parsed<T> = Result<T, Malformed>;

impl<'a> Parser<'a> {
    /// Of the bytes of a file.
    ///
    /// # Errors
    /// If it is empty.
    pub fn new(bytes: &'a [u8]) -> Parsed<Self> {
        tally::count("tinyxml2");
        let end = bytes.iter().position(|&byte| byte == 0).unwrap_or(bytes.len());
        let mut parser = Parser { bytes: &bytes[..end], at: 0, open: Vec::new(), declares: true };
        parser.skip_space();
        if parser.rest().starts_with(b"\xef\xbb\xbf") {
            parser.at += 3;
        }
        match parser.rest().is_empty() {
            true => refuse(0, "the file is empty"),
            false => Ok(parser),
        }
    }

    /// What comes next; none at the end.
    ///
    /// # Errors
    /// If tinyxml2 refuses the document here.
    pub fn event(&mut self) -> Parsed<Option<Event<'a>>> {
        loop {
            let start = self.at;
            self.skip_space();
            let (rest, here) = (self.rest(), self.at);
            if rest.is_empty() {
                return match self.open.last() {
                    Some(&(_, open)) => refuse(open, "an element is not closed"),
                    None => Ok(None),
                };
            }
            if rest.starts_with(b"<?") {
                self.at += 2;
                self.until(b"?>", "a declaration is not closed")?;
                if !self.declares {
                    return refuse(here, "`<?` stands elsewhere than at the beginning of the file");
                }
                continue;
            }
            self.declares = false;
            if rest.starts_with(b"<!--") {
                self.at += 4;
                self.until(b"-->", "a comment is not closed")?;
            } else if rest.starts_with(b"<![CDATA[") {
                self.at += 9;
                let text = self.until(b"]]>", "a CDATA section is not closed")?;
                return Ok(Some(Event::Data(String::from_utf8_lossy(text))));
            } else if rest.starts_with(b"<!") {
                self.at += 2;
                self.until(b">", "`<!` is not closed")?;
                return Ok(Some(Event::Unknown));
            } else if rest.starts_with(b"<") {
                return self.element();
            } else {
                self.at = start;
                let text = self.until(b"<", "text follows the last element")?;
                self.at -= 1;
                return Ok(Some(Event::Text(decoded(text), here)));
            }
        }
    }

    /// Whether an element is open.
    pub fn is_inside(&self) -> bool {
        !self.open.is_empty()
    }

    fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    fn skip_space(&mut self) {
        let spaces = self.rest().iter().take_while(|&&byte| is_space(byte));
        self.at += spaces.count();
    }

    /// Takes all up to a mark, and the mark.
    fn until(&mut self, mark: &[u8], why: &'static str) -> Parsed<&'a [u8]> {
        let rest = self.rest();
        match rest.windows(mark.len()).position(|window| window == mark) {
            Some(length) => {
                self.at += length + mark.len();
                Ok(&rest[..length])
            }
            None => refuse(self.at, why),
        }
    }

    fn name(&mut self) -> Option<&'a [u8]> {
        let rest = self.rest();
        rest.first().filter(|&&byte| is_name_start(byte))?;
        let name = rest.iter().take_while(|&&byte| is_name(byte)).count();
        self.at += name;
        Some(&rest[..name])
    }

    /// A start or end tag. Parsing ends at an end tag that closes nothing.
    fn element(&mut self) -> Parsed<Option<Event<'a>>> {
        let start = self.at;
        self.at += 1;
        self.skip_space();
        let closes = self.rest().starts_with(b"/");
        self.at += usize::from(closes);
        let Some(name) = self.name() else {
            return refuse(start, "`<` is not followed by a name");
        };
        let (attributes, is_empty) = self.attributes()?;
        if let Some(second) = repeated(&attributes) {
            return refuse(second, "an attribute stands twice in one element");
        }
        // `</name/>` is an empty element.
        if closes && !is_empty {
            return match self.open.pop() {
                None => {
                    self.at = self.bytes.len();
                    Ok(None)
                }
                Some((opened, _)) if opened == name => Ok(Some(Event::End)),
                Some((_, opened)) => refuse(opened, "an element is closed by another name"),
            };
        }
        if !is_empty {
            self.open.push((name, start));
        }
        let (name, tag) = (String::from_utf8_lossy(name), start..self.at);
        Ok(Some(Event::Start { name, attributes, tag, is_empty }))
    }

    /// Attributes, and whether the tag ends with `/>`.
    fn attributes(&mut self) -> Parsed<(Vec<Attribute<'a>>, bool)> {
        let mut attributes: Vec<Attribute> = Vec::new();
        loop {
            self.skip_space();
            let start = self.at;
            if self.rest().starts_with(b">") {
                self.at += 1;
                return Ok((attributes, false));
            }
            if self.rest().starts_with(b"/>") {
                self.at += 2;
                return Ok((attributes, true));
            }
            let Some(name) = self.name() else {
                return refuse(start, "a tag has something that is no attribute");
            };
            let name = String::from_utf8_lossy(name);
            self.skip_space();
            if !self.rest().starts_with(b"=") {
                return refuse(start, "an attribute has no value");
            }
            self.at += 1;
            self.skip_space();
            let quote = match self.rest().first() {
                Some(quote @ (b'"' | b'\'')) => [*quote],
                _ => return refuse(start, "the value of an attribute is not in quotes"),
            };
            self.at += 1;
            let value = self.until(&quote, "the value of an attribute is not closed")?;
            attributes.push(Attribute { name, value: decoded(value), range: start..self.at });
            // Whoever counted the file found no more; tags in what is counted as one `<!…>` were not counted.
            if attributes.len() > MAX_ATTRIBUTES {
                return refuse(start, "an element has too many attributes");
            }
        }
    }
}

fn refuse<T>(at: usize, why: &'static str) -> Parsed<T> {
    Err(Malformed { at, why })
}

/// The place of an attribute that stands twice in an element.
pub fn repeated(attributes: &[Attribute<'_>]) -> Option<usize> {
    let mut names: Vec<(&str, usize)> =
        attributes.iter().map(|one| (&*one.name, one.range.start)).collect();
    names.sort_unstable();
    names.windows(2).find(|two| two[0].0 == two[1].0).map(|two| two[1].1)
}

/// As `isspace` of C has it.
fn is_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t'..=b'\r')
}

fn is_name_start(byte: u8) -> bool {
    byte >= 128 || byte.is_ascii_alphabetic() || matches!(byte, b':' | b'_')
}

fn is_name(byte: u8) -> bool {
    is_name_start(byte) || byte.is_ascii_digit() || matches!(byte, b'.' | b'-')
}

/// Text with its entities and ends of lines replaced, up to a NUL.
fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    let text = String::from_utf8_lossy(bytes);
    if !text.contains(['&', '\r', '\n']) {
        return text;
    }
    let mut out = String::with_capacity(text.len());
    let mut rest = &*text;
    while let Some(found) = rest.find(['&', '\r', '\n']) {
        out.push_str(&rest[..found]);
        rest = &rest[found..];
        let (replaced, length) = match rest.as_bytes() {
            [b'\r', b'\n', ..] | [b'\n', b'\r', ..] => ('\n', 2),
            [b'\r' | b'\n', ..] => ('\n', 1),
            _ => entity(rest).unwrap_or(('&', 1)),
        };
        if replaced == '\0' {
            return Cow::Owned(out);
        }
        out.push(replaced);
        rest = &rest[length..];
    }
    out.push_str(rest);
    Cow::Owned(out)
}

/// The character of an entity, and how long the entity is.
fn entity(text: &str) -> Option<(char, usize)> {
    const LONGEST: usize = 12;
    let end = text.bytes().take(LONGEST).position(|byte| byte == b';')?;
    let character = match &text[1..end] {
        "quot" => '"',
        "amp" => '&',
        "apos" => '\'',
        "lt" => '<',
        "gt" => '>',
        other => {
            let number = other.strip_prefix('#')?;
            let (digits, radix) = match number.strip_prefix('x') {
                Some(digits) => (digits, 16),
                None => (number, 10),
            };
            if !digits.chars().all(|digit| digit.is_digit(radix)) {
                return None;
            }
            // No digits are 0, where the text ends.
            let code =
                if digits.is_empty() { 0 } else { u32::from_str_radix(digits, radix).ok()? };
            char::from_u32(code)?
        }
    };
    Some((character, end + 1))
}
