//! XML as tinyxml2 reads it: urdfdom, MuJoCo, Drake, PyBullet and libsdformat. It knows no namespaces, keeps entities
//! that it does not know, and ends at a NUL.

use std::borrow::Cow;

use urdd_xml::Counted;

use crate::tree::{Attribute, Element, Malformed, Parsed, Tree, repeated};

/// Elements that are open at once, from which tinyxml2 refuses, and from which its releases up to 9 do.
pub(crate) const MAX_DEPTH: usize = 499;
pub(crate) const OLD_MAX_DEPTH: usize = 99;

/// More elements in each other than URDF ever has.
pub(crate) const MOST_DEPTH: usize = 1000;

/// A file, parsed once for releases that allow other depths.
pub(crate) struct Document<'a> {
    tree: Parsed<Tree<'a>>,
    /// The first element that is open at each depth, bytes of the file.
    depths: Vec<usize>,
}

impl<'a> Document<'a> {
    /// Parses a file.
    pub fn of(file: Counted<'a>) -> Self {
        let bytes = file.bytes();
        let end = bytes.iter().position(|&byte| byte == 0).unwrap_or(bytes.len());
        let (tree, open, depths) = (Tree::default(), Vec::new(), Vec::new());
        let mut parser = Parser { bytes: &bytes[..end], at: 0, tree, open, depths };
        let parsed = parser.file();
        Document { tree: parsed.map(|()| parser.tree), depths: parser.depths }
    }

    /// What a release makes of it that refuses an element which is open and `max_depth` elements deep.
    pub fn within(&self, max_depth: usize) -> Parsed<&Tree<'a>> {
        match (self.depths.get(max_depth - 1), &self.tree) {
            (Some(&at), _) => Err(Malformed { at, why: TOO_DEEP }),
            (None, Ok(tree)) => Ok(tree),
            (None, Err(bad)) => Err(*bad),
        }
    }
}

const TOO_DEEP: &str = "elements are nested too deep";

struct Parser<'a> {
    bytes: &'a [u8],
    at: usize,
    tree: Tree<'a>,
    /// The elements that are not closed yet: index, and whether anything is inside.
    open: Vec<(usize, bool)>,
    depths: Vec<usize>,
}

impl<'a> Parser<'a> {
    fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    fn refuse<T>(&self, at: usize, why: &'static str) -> Parsed<T> {
        Err(Malformed { at, why })
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
            None => self.refuse(self.at, why),
        }
    }

    fn name(&mut self) -> Option<&'a [u8]> {
        let rest = self.rest();
        rest.first().filter(|&&byte| is_name_start(byte))?;
        let name = rest.iter().take_while(|&&byte| is_name(byte)).count();
        self.at += name;
        Some(&rest[..name])
    }

    fn file(&mut self) -> Parsed<()> {
        self.skip_space();
        if self.rest().starts_with(b"\xef\xbb\xbf") {
            self.at += 3;
        }
        if self.rest().is_empty() {
            return self.refuse(0, "the file is empty");
        }
        // Declarations come before all else.
        let mut declares = true;
        loop {
            let start = self.at;
            self.skip_space();
            let rest = self.rest();
            let here = self.at;
            if rest.is_empty() {
                return match self.open.last() {
                    Some(&(open, _)) => {
                        self.refuse(self.tree.elements[open].tag.start, "an element is not closed")
                    }
                    None => Ok(()),
                };
            }
            if rest.starts_with(b"<?") {
                self.at += 2;
                self.until(b"?>", "a declaration is not closed")?;
                if !declares {
                    let why = "`<?` stands elsewhere than at the beginning of the file";
                    return self.refuse(here, why);
                }
                continue;
            }
            declares = false;
            if rest.starts_with(b"<!--") {
                self.at += 4;
                self.until(b"-->", "a comment is not closed")?;
            } else if rest.starts_with(b"<![CDATA[") {
                self.at += 9;
                let text = self.until(b"]]>", "a CDATA section is not closed")?;
                self.inside(Some(String::from_utf8_lossy(text)));
            } else if rest.starts_with(b"<!") {
                self.at += 2;
                self.until(b">", "`<!` is not closed")?;
                self.inside(None);
            } else if rest.starts_with(b"<") {
                if self.element()? {
                    return Ok(());
                }
            } else {
                self.at = start;
                let text = self.until(b"<", "text follows the last element")?;
                self.at -= 1;
                if self.open.is_empty() {
                    self.tree.stray.get_or_insert(here);
                }
                self.inside(Some(decoded(text)));
            }
        }
    }

    /// Notes a node in the element that is open.
    fn inside(&mut self, text: Option<Cow<'a, str>>) {
        if let Some((open, is_filled)) = self.open.last_mut() {
            if !*is_filled {
                self.tree.elements[*open].text = text;
            }
            *is_filled = true;
        }
    }

    /// A start or end tag. Returns whether parsing ends, as it does at an end tag that closes nothing.
    fn element(&mut self) -> Parsed<bool> {
        let start = self.at;
        self.at += 1;
        self.skip_space();
        let closes = self.rest().starts_with(b"/");
        self.at += usize::from(closes);
        let Some(name) = self.name() else {
            return self.refuse(start, "`<` is not followed by a name");
        };
        let (attributes, is_empty) = self.attributes()?;
        if let Some(second) = repeated(&attributes) {
            return self.refuse(second, "an attribute stands twice in one element");
        }
        // `</name/>` is an empty element.
        if closes && !is_empty {
            let Some((open, _)) = self.open.pop() else { return Ok(true) };
            let opened = &self.tree.elements[open];
            return match opened.name == String::from_utf8_lossy(name) {
                true => Ok(false),
                false => self.refuse(opened.tag.start, "an element is closed by another name"),
            };
        }
        let index = self.tree.elements.len();
        self.inside(None);
        match self.open.last() {
            Some(&(open, _)) => self.tree.elements[open].children.push(index),
            None => self.tree.tops.push(index),
        }
        self.tree.elements.push(Element {
            name: String::from_utf8_lossy(name),
            attributes,
            children: Vec::new(),
            text: None,
            tag: start..self.at,
        });
        if !is_empty {
            self.open.push((index, false));
            if self.open.len() > self.depths.len() {
                self.depths.push(start);
            }
            if self.depths.len() == MOST_DEPTH {
                return self.refuse(start, TOO_DEEP);
            }
        }
        Ok(false)
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
                return self.refuse(start, "a tag has something that is no attribute");
            };
            let name = String::from_utf8_lossy(name);
            self.skip_space();
            if !self.rest().starts_with(b"=") {
                return self.refuse(start, "an attribute has no value");
            }
            self.at += 1;
            self.skip_space();
            let quote = match self.rest().first() {
                Some(quote @ (b'"' | b'\'')) => [*quote],
                _ => return self.refuse(start, "the value of an attribute is not in quotes"),
            };
            self.at += 1;
            let value = self.until(&quote, "the value of an attribute is not closed")?;
            attributes.push(Attribute { name, value: decoded(value), range: start..self.at });
        }
    }
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
