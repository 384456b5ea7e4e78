//! A URDF as tinyxml2 makes a tree of it, and whether rapidxml refuses it.

use std::borrow::Cow;

use urdd_xml::tinyxml2::{Event, Parser};
use urdd_xml::{Counted, tally};

use crate::tree::{Element, Malformed, Parsed, Tree};

/// Elements that are open at once, from which tinyxml2 refuses, and from which its releases up to 9 do.
pub const MAX_DEPTH: usize = 499;
pub const OLD_MAX_DEPTH: usize = 99;

/// More elements in each other than URDF ever has.
pub const MOST_DEPTH: usize = 1000;

/// A file, parsed once for releases that allow other depths.
pub struct Document<'a> {
    tree: Parsed<Tree<'a>>,
    /// The first element that is open at each depth, bytes of the file.
    depths: Vec<usize>,
}

impl<'a> Document<'a> {
    pub fn of(file: Counted<'a>) -> Self {
        let mut making = Making::default();
        let parsed = making.file(file.bytes());
        Document { tree: parsed.map(|()| making.tree), depths: making.depths }
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

#[derive(Default)]
struct Making<'a> {
    tree: Tree<'a>,
    /// The elements that are not closed yet: index, and whether anything is inside.
    open: Vec<(usize, bool)>,
    depths: Vec<usize>,
}

impl<'a> Making<'a> {
    fn file(&mut self, bytes: &'a [u8]) -> Parsed<()> {
        let mut parser = Parser::new(bytes)?;
        while let Some(event) = parser.event()? {
            match event {
                Event::Unknown => self.inside(None),
                Event::Text(text, at) => {
                    if self.open.is_empty() {
                        self.tree.stray.get_or_insert(at);
                    }
                    self.inside(Some(text));
                }
                Event::Data(text) => self.inside(Some(text)),
                Event::End => drop(self.open.pop()),
                Event::Start { name, attributes, tag, is_empty } => {
                    let start = tag.start;
                    self.inside(None);
                    let above = self.open.last().map(|(open, _)| *open);
                    let index = self.tree.push(Element::new(name, attributes, tag), above);
                    if !is_empty {
                        self.open.push((index, false));
                        if self.open.len() > self.depths.len() {
                            self.depths.push(start);
                        }
                        if self.depths.len() == MOST_DEPTH {
                            return Err(Malformed { at: start, why: TOO_DEEP });
                        }
                    }
                }
            }
        }
        Ok(())
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
}

/// Whether rapidxml in Boost 1.90 refuses a file, and where: Pinocchio reads geometry by it. The elements are those that tinyxml2
/// has found before.
pub fn check_by_rapidxml(file: Counted<'_>) -> Parsed<()> {
    tally::count("rapidxml");
    let bytes = file.bytes();
    let end = bytes.iter().position(|&byte| byte == 0).unwrap_or(bytes.len());
    let at = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    RapidXml { bytes: &bytes[..end], at }.document()
}

struct RapidXml<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl RapidXml<'_> {
    fn next(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn rest(&self) -> &[u8] {
        &self.bytes[self.at..]
    }

    fn refuse<T>(&self, why: &'static str) -> Parsed<T> {
        Err(Malformed { at: self.at, why })
    }

    /// Skips bytes that are none of those given.
    fn skip_to(&mut self, ends: &[u8]) {
        self.at += self.rest().iter().take_while(|byte| !ends.contains(byte)).count();
    }

    fn skip_space(&mut self) {
        self.at += self.rest().iter().take_while(|byte| b" \t\r\n".contains(byte)).count();
    }

    fn behind(&mut self, mark: &[u8]) -> Parsed<()> {
        let found = self.rest().windows(mark.len()).position(|window| window == mark);
        match found {
            Some(length) => self.at += length + mark.len(),
            None => return self.refuse("a comment or declaration is not closed"),
        }
        Ok(())
    }

    fn document(&mut self) -> Parsed<()> {
        let mut depth = 0_usize;
        loop {
            if depth == 0 {
                self.skip_space();
                match self.next() {
                    None => return Ok(()),
                    Some(b'<') => {}
                    Some(_) => return self.refuse("text stands outside of the root"),
                }
            }
            let text = self.at;
            self.skip_to(b"<");
            self.references(text, self.at)?;
            self.at += 1;
            match self.next() {
                None => return self.refuse("an element is not closed"),
                Some(b'/') if depth > 0 => {
                    self.end_tag()?;
                    depth -= 1;
                }
                Some(b'?') => self.behind(b"?>")?,
                Some(b'!') => self.declaration()?,
                Some(_) => depth += usize::from(self.start_tag()?),
            }
        }
    }

    fn end_tag(&mut self) -> Parsed<()> {
        self.at += 1;
        self.skip_to(b" \n\r\t/>?");
        self.skip_space();
        if self.next() != Some(b'>') {
            return self.refuse("an end tag has more than a name");
        }
        self.at += 1;
        Ok(())
    }

    /// What begins with `<!`.
    fn declaration(&mut self) -> Parsed<()> {
        let rest = self.rest();
        if rest.starts_with(b"!--") {
            self.at += 3;
            return self.behind(b"-->");
        }
        if rest.starts_with(b"![CDATA[") {
            self.at += 8;
            return self.behind(b"]]>");
        }
        let is_doctype = rest.starts_with(b"!DOCTYPE")
            && rest.get(8).is_some_and(|byte| b" \t\r\n".contains(byte));
        if !is_doctype {
            return self.behind(b">");
        }
        let mut depth = 0_usize;
        loop {
            match self.next() {
                None => return self.refuse("DOCTYPE is not closed"),
                Some(b'[') => depth += 1,
                Some(b']') => depth = depth.saturating_sub(1),
                Some(b'>') if depth == 0 => break,
                Some(_) => {}
            }
            self.at += 1;
        }
        self.at += 1;
        Ok(())
    }

    /// Returns whether the element has content.
    fn start_tag(&mut self) -> Parsed<bool> {
        let start = self.at;
        self.skip_to(b" \n\r\t/>?");
        if self.at == start {
            return self.refuse("`<` is not followed by a name");
        }
        self.skip_space();
        while self.next().is_some_and(|byte| !b"/<>=?!".contains(&byte)) {
            self.attribute()?;
        }
        let has_content = self.next() == Some(b'>');
        self.at += 1;
        if !has_content && self.next() != Some(b'>') {
            return self.refuse("a tag has something that is not an attribute");
        }
        self.at += usize::from(!has_content);
        Ok(has_content)
    }

    fn attribute(&mut self) -> Parsed<()> {
        self.skip_to(b" \n\r\t/<>=?!");
        self.skip_space();
        if self.next() != Some(b'=') {
            return self.refuse("an attribute has no value");
        }
        self.at += 1;
        self.skip_space();
        let Some(quote @ (b'"' | b'\'')) = self.next() else {
            return self.refuse("the value of an attribute is not in quotes");
        };
        self.at += 1;
        let start = self.at;
        self.skip_to(&[quote]);
        self.references(start, self.at)?;
        self.at += 1;
        self.skip_space();
        Ok(())
    }

    /// References to characters in a text.
    fn references(&self, start: usize, end: usize) -> Parsed<()> {
        let mut at = start;
        while let Some(found) = self.bytes[at..end].windows(2).position(|two| two == b"&#") {
            let here = at + found;
            let is_hexadecimal = self.bytes.get(here + 2) == Some(&b'x');
            at = here + 2 + usize::from(is_hexadecimal);
            let radix = if is_hexadecimal { 16 } else { 10 };
            let mut code = 0_u64;
            while let Some(digit) =
                self.bytes[at..end].first().and_then(|&byte| char::from(byte).to_digit(16))
            {
                code = code.wrapping_mul(radix).wrapping_add(u64::from(digit));
                at += 1;
            }
            if code > u64::from(u32::from(char::MAX)) {
                return Err(Malformed { at: here, why: "a character reference is too large" });
            }
            if self.bytes[at..end].first() != Some(&b';') {
                return Err(Malformed { at: here, why: "a character reference is not a number" });
            }
        }
        Ok(())
    }
}
