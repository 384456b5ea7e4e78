//! XML as TinyXML 2.6.2 reads it, which urdfdom 3 uses: no namespaces, values without quotes, and nothing but elements
//! counts behind the root. Places are those of the file.

use std::borrow::Cow;

use urdd_xml::{Counted, tally};

use crate::number::is_space;
use crate::tree::{Attribute, Element, Malformed, Parsed, Tree, repeated};

pub fn parse(file: Counted<'_>) -> Parsed<Tree<'_>> {
    tally::count("TinyXML");
    let bytes = file.bytes();
    let end = bytes.iter().position(|&byte| byte == 0).unwrap_or(bytes.len());
    let is_utf8 = bytes.starts_with(b"\xef\xbb\xbf").then_some(true);
    let tree = Tree::default();
    let mut parser = Parser { bytes: &bytes[..end], at: 0, is_utf8, tree, open: Vec::new() };
    parser.document()?;
    Ok(parser.tree)
}

struct Parser<'a> {
    bytes: &'a [u8],
    at: usize,
    /// None before the first declaration.
    is_utf8: Option<bool>,
    tree: Tree<'a>,
    /// The elements that are not closed yet.
    open: Vec<usize>,
}

impl<'a> Parser<'a> {
    fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    fn starts(&self, text: &[u8]) -> bool {
        self.rest().get(..text.len()).is_some_and(|start| start.eq_ignore_ascii_case(text))
    }

    fn refuse<T>(&self, at: usize, why: &'static str) -> Parsed<T> {
        Err(Malformed { at, why })
    }

    fn is_utf8(&self) -> bool {
        self.is_utf8 == Some(true)
    }

    /// Skips white space, and byte order marks in UTF-8. Returns the next byte.
    fn skip_space(&mut self) -> Option<u8> {
        loop {
            match self.rest() {
                [0xef, 0xbb, 0xbf, ..] | [0xef, 0xbf, 0xbe | 0xbf, ..] if self.is_utf8() => {
                    self.at += 3;
                }
                [byte, ..] if is_space(char::from(*byte)) => self.at += 1,
                rest => return rest.first().copied(),
            }
        }
    }

    /// Goes behind a mark, or to the end.
    fn behind(&mut self, mark: &[u8]) {
        let found = self.rest().windows(mark.len()).position(|window| window == mark);
        self.at = found.map_or(self.bytes.len(), |length| self.at + length + mark.len());
    }

    fn document(&mut self) -> Parsed<()> {
        let mut is_empty = true;
        while let Some(next) = self.skip_space() {
            let Some(&open) = self.open.last() else {
                // Text between elements ends the reading.
                if next != b'<' || !self.markup()? {
                    break;
                }
                is_empty = false;
                continue;
            };
            if next != b'<' {
                self.text(b'<')?;
                self.at -= 1;
            } else if self.rest().starts_with(b"</") {
                self.end_tag(open)?;
            } else if !self.markup()? {
                return self.refuse(self.at, "an attribute stands twice in one element");
            }
        }
        match self.open.last() {
            Some(&open) => {
                self.refuse(self.tree.elements[open].tag.start, "an element is not closed")
            }
            None if is_empty && self.tree.tops.is_empty() => {
                self.refuse(0, "the file does not begin with an element")
            }
            None => Ok(()),
        }
    }

    /// What begins with `<`, but for end tags. Returns whether reading goes on.
    fn markup(&mut self) -> Parsed<bool> {
        if self.starts(b"<?xml") {
            self.declaration()?;
        } else if self.starts(b"<!--") {
            self.at += 4;
            self.behind(b"-->");
        } else if self.starts(b"<![CDATA[") {
            self.at += 9;
            self.behind(b"]]>");
        } else if self.rest().get(1).copied().is_some_and(is_name_start) {
            return self.element();
        } else {
            self.behind(b">");
        }
        Ok(true)
    }

    fn declaration(&mut self) -> Parsed<()> {
        self.at += 5;
        let mut encoding = Cow::Borrowed("");
        while let Some(next) = self.skip_space() {
            if next == b'>' {
                self.at += 1;
                break;
            }
            if self.starts(b"version") || self.starts(b"encoding") || self.starts(b"standalone") {
                let is_encoding = next.eq_ignore_ascii_case(&b'e');
                let attribute = self.attribute()?;
                if is_encoding {
                    encoding = attribute.value;
                }
            } else {
                let is_inside = |&&byte: &&u8| byte != b'>' && !is_space(char::from(byte));
                self.at += self.rest().iter().take_while(is_inside).count();
            }
        }
        let name = encoding.to_ascii_lowercase();
        let is_utf8 = name.is_empty() || name.starts_with("utf-8") || name.starts_with("utf8");
        self.is_utf8.get_or_insert(is_utf8);
        Ok(())
    }

    /// A start tag. Returns whether reading goes on.
    fn element(&mut self) -> Parsed<bool> {
        let start = self.at;
        self.at += 1;
        let name = self.name();
        let mut attributes = Vec::new();
        let is_closed = self.attributes(start, &mut attributes)?;
        // What follows is not read.
        let is_repeated = repeated(&attributes).is_some();
        let element = Element::new(String::from_utf8_lossy(name), attributes, start..self.at);
        let index = self.tree.push(element, self.open.last().copied());
        if !is_closed && !is_repeated {
            self.open.push(index);
        }
        Ok(!is_repeated)
    }

    fn name(&mut self) -> &'a [u8] {
        let name = name_of(self.rest());
        self.at += name.len();
        name
    }

    /// Attributes, and whether the tag ends with `/>`.
    fn attributes(&mut self, tag: usize, found: &mut Vec<Attribute<'a>>) -> Parsed<bool> {
        loop {
            match self.skip_space() {
                None => return self.refuse(tag, "an element is not closed"),
                Some(b'/') => {
                    self.at += 2;
                    return match self.bytes.get(self.at - 1) {
                        Some(b'>') => Ok(true),
                        _ => self.refuse(tag, "`/` is not followed by `>`"),
                    };
                }
                Some(b'>') => {
                    self.at += 1;
                    return Ok(false);
                }
                Some(_) => found.push(self.attribute()?),
            }
        }
    }

    fn attribute(&mut self) -> Parsed<Attribute<'a>> {
        let start = self.at;
        let name = String::from_utf8_lossy(self.name());
        if name.is_empty() {
            return self.refuse(start, "a tag has something that is not an attribute");
        }
        if self.skip_space() != Some(b'=') {
            return self.refuse(start, "an attribute has no value");
        }
        self.at += 1;
        let value = match self.skip_space() {
            Some(quote @ (b'"' | b'\'')) => {
                self.at += 1;
                let value = self.text(quote)?;
                let end = value.iter().position(|&byte| byte == 0).unwrap_or(value.len());
                Cow::Owned(String::from_utf8_lossy(&value[..end]).into_owned())
            }
            _ => {
                let rest = self.rest();
                let ends = |byte: u8| is_space(char::from(byte)) || matches!(byte, b'/' | b'>');
                let length = rest.iter().take_while(|&&byte| !ends(byte)).count();
                self.at += length;
                if rest[..length].iter().any(|byte| matches!(byte, b'"' | b'\'')) {
                    return self.refuse(start, "the value of an attribute is not in quotes");
                }
                String::from_utf8_lossy(&rest[..length])
            }
        };
        if self.rest().is_empty() {
            return self.refuse(start, "the file ends in a tag");
        }
        Ok(Attribute { name, value, range: start..self.at })
    }

    fn end_tag(&mut self, open: usize) -> Parsed<()> {
        let opened = self.tree.elements[open].tag.start;
        self.at += 2;
        let name = name_of(&self.bytes[opened + 1..]);
        if self.rest().starts_with(name) {
            self.at += name.len();
            if self.skip_space() == Some(b'>') {
                self.at += 1;
                self.open.pop();
                return Ok(());
            }
        }
        self.refuse(opened, "an element is closed by another name")
    }

    /// Text up to a byte, and the byte.
    fn text(&mut self, end: u8) -> Parsed<Vec<u8>> {
        let start = self.at;
        let mut text = Vec::new();
        loop {
            match self.rest().first() {
                None => return self.refuse(start, "a value or an element is not closed"),
                Some(&byte) if byte == end => {
                    self.at += 1;
                    return Ok(text);
                }
                Some(b'&') => self.entity(&mut text)?,
                Some(&byte) => {
                    let length = match byte {
                        0xc2..=0xdf if self.is_utf8() => 2,
                        0xe0..=0xef if self.is_utf8() => 3,
                        0xf0..=0xf4 if self.is_utf8() => 4,
                        _ => 1,
                    };
                    let length = length.min(self.rest().len());
                    text.extend(&self.rest()[..length]);
                    self.at += length;
                }
            }
        }
    }

    /// An entity; one that is not known is left out.
    fn entity(&mut self, text: &mut Vec<u8>) -> Parsed<()> {
        const NAMED: [(&[u8], u8); 5] = [
            (b"&amp;", b'&'),
            (b"&lt;", b'<'),
            (b"&gt;", b'>'),
            (b"&quot;", b'"'),
            (b"&apos;", b'\''),
        ];
        let rest = self.rest();
        let Some(number) = rest.strip_prefix(b"&#").filter(|number| !number.is_empty()) else {
            let named = NAMED.iter().find(|(name, _)| rest.starts_with(name));
            text.extend(named.map(|(_, byte)| *byte));
            self.at += named.map_or(1, |(name, _)| name.len());
            return Ok(());
        };
        let (digits, radix) = match number.strip_prefix(b"x") {
            Some(digits) => (digits, 16),
            None => (number, 10),
        };
        let is_digit = |byte: &&u8| char::from(**byte).is_digit(radix);
        let length = digits.iter().take_while(is_digit).count();
        if digits.get(length) != Some(&b';') {
            return self.refuse(self.at, "a character reference is not a number");
        }
        let code = std::str::from_utf8(&digits[..length]).unwrap_or_default();
        let code = u32::from_str_radix(code, radix).unwrap_or_default();
        match self.is_utf8() {
            true => {
                let character = char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER);
                text.extend(character.encode_utf8(&mut [0; 4]).bytes());
            }
            false => text.extend(code.to_le_bytes().first()),
        }
        self.at += rest.len() - digits.len() + length + 1;
        Ok(())
    }
}

fn is_name_start(byte: u8) -> bool {
    byte >= 127 || byte.is_ascii_alphabetic() || byte == b'_'
}

/// The name that a text begins with; empty if there is none.
fn name_of(text: &[u8]) -> &[u8] {
    let starts = text.first().copied().is_some_and(is_name_start);
    let is_name = |byte| is_name_start(byte) || matches!(byte, b'0'..=b'9' | b'-' | b'.' | b':');
    let length = text.iter().take_while(|&&byte| starts && is_name(byte)).count();
    &text[..length]
}
