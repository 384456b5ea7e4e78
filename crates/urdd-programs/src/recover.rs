//! What libxml2 makes of a document that is not well-formed, when it recovers as it reads: yourdfpy.

use std::borrow::Cow;

use crate::tree::{Attribute, Element, Tree};

/// Elements nested deeper end the reading.
const MAX_DEPTH: usize = 256;

/// Reads as much as can be read. Elements with a prefix or a namespace of their own are left out.
/// Also whether all of it was read, as far as can be known.
pub(crate) fn parse(text: &str) -> (Tree<'_>, bool) {
    let tree = Tree::default();
    let mut parser = Parser { text, at: 0, tree, open: Vec::new(), names: 0, is_whole: true };
    parser.prologue();
    if parser.tag() {
        parser.content();
    }
    let is_whole = parser.is_whole && parser.open.is_empty();
    (parser.tree, is_whole)
}

struct Parser<'a> {
    text: &'a str,
    at: usize,
    tree: Tree<'a>,
    /// The elements that are open; none of one that is left out.
    open: Vec<Option<usize>>,
    /// How many end tags are expected: a start tag that is cut counts here alone.
    names: usize,
    is_whole: bool,
}

impl<'a> Parser<'a> {
    fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or_default()
    }

    fn skip(&mut self, what: impl Fn(char) -> bool) -> &'a str {
        let rest = self.rest();
        let end = rest.find(|character| !what(character)).unwrap_or(rest.len());
        self.at += end;
        &rest[..end]
    }

    /// Goes behind a mark, or to the end of the file.
    fn behind(&mut self, mark: &str) {
        self.at = self.rest().find(mark).map_or(self.text.len(), |at| self.at + at + mark.len());
    }

    /// All before the root.
    fn prologue(&mut self) {
        if self.rest().starts_with('\u{feff}') {
            self.at += '\u{feff}'.len_utf8();
        }
        loop {
            self.skip(is_space);
            if self.rest().starts_with("<!--") {
                self.behind("-->");
            } else if self.rest().starts_with("<?xml ") && self.at == 0 {
                self.behind(">");
            } else if self.rest().starts_with("<?") {
                self.behind("?>");
            } else if self.rest().starts_with("<!DOCTYPE") {
                let subset = self.rest().find('[');
                let end = self.rest().find('>').unwrap_or(0);
                self.behind(if subset.is_some_and(|subset| subset < end) { "]>" } else { ">" });
            } else {
                return;
            }
        }
    }

    fn content(&mut self) {
        while !self.open.is_empty() && self.names < MAX_DEPTH {
            self.skip(|character| character != '<');
            let rest = self.rest();
            if rest.is_empty() {
                return;
            } else if rest.starts_with("</") {
                self.at += 2;
                let name = self.skip(is_name);
                self.skip(is_space);
                self.at += usize::from(self.rest().starts_with('>'));
                if let Some(Some(open)) = self.open.pop() {
                    self.is_whole &= self.tree.elements[open].name == name;
                }
                self.names = self.names.saturating_sub(1);
            } else if rest.starts_with("<!--") {
                self.at += 4;
                let body = self.at;
                self.behind("-->");
                // A comment does not end at `--->`.
                if self.text[body..self.at].ends_with("--->") {
                    return;
                }
            } else if rest.starts_with("<![CDATA[") {
                self.behind("]]>");
            } else if rest.starts_with("<??>") {
                self.at += 2;
            } else if rest.starts_with("<?") {
                self.add("?".into(), Vec::new(), self.at, false);
                self.behind("?>");
            } else if !self.tag() {
                return;
            }
        }
    }

    /// Notes an element in the one that is open.
    fn add(&mut self, name: Cow<'a, str>, attributes: Vec<Attribute<'a>>, at: usize, opens: bool) {
        let parent = self.open.last().copied();
        let is_left_out = name.contains(':') || attributes.iter().any(|one| one.name == "xmlns");
        let index = match parent {
            Some(None) => None,
            Some(Some(_)) if is_left_out => None,
            _ => Some(self.tree.elements.len()),
        };
        if let Some(index) = index {
            match parent.flatten() {
                Some(parent) => self.tree.elements[parent].children.push(index),
                None => self.tree.tops.push(index),
            }
            let tag = at..self.at;
            let element = Element { name, attributes, children: Vec::new(), text: None, tag };
            self.tree.elements.push(element);
        }
        if opens {
            self.open.push(index);
        }
    }

    /// A start tag. Reading ends at `<` without a name behind it.
    fn tag(&mut self) -> bool {
        let start = self.at;
        let rest = self.rest();
        if !rest.starts_with('<') || !rest[1..].starts_with(is_name_start) {
            return false;
        }
        self.at += 1;
        let name = self.skip(is_name);
        let attributes = self.attributes();
        let (opens, closes) = (self.rest().starts_with('>'), self.rest().starts_with("/>"));
        self.at += usize::from(opens) + 2 * usize::from(closes);
        let is_root = self.open.is_empty();
        self.add(name.into(), attributes, start, opens);
        self.names += usize::from(!closes);
        if !opens && !closes {
            let cut = self.rest().split(['<', '>']).next().unwrap_or_default();
            self.is_whole &= !cut.contains('=') && !is_root;
        }
        !is_root || opens
    }

    fn attributes(&mut self) -> Vec<Attribute<'a>> {
        let mut attributes: Vec<Attribute> = Vec::new();
        loop {
            let spaces = self.skip(is_space);
            let start = self.at;
            let is_end = self.rest().starts_with(['>', '<']) || self.rest().starts_with("/>");
            if is_end || spaces.is_empty() || !self.rest().starts_with(is_name_start) {
                return attributes;
            }
            let name = self.skip(is_name);
            self.skip(is_space);
            if !self.rest().starts_with('=') {
                self.is_whole = false;
                // What is next is an attribute only behind a space, which is taken already.
                return attributes;
            }
            self.at += 1;
            self.skip(is_space);
            let Some(quote) = self.rest().chars().next().filter(|one| "\"'".contains(*one)) else {
                self.is_whole = false;
                return attributes;
            };
            self.at += 1;
            let rest = self.rest();
            let Some(end) = rest.find(quote) else {
                self.at = self.text.len();
                return attributes;
            };
            let Some(value) = value(&rest[..end]) else {
                self.is_whole = false;
                return attributes;
            };
            self.at += end + 1;
            if attributes.iter().all(|one| one.name != name) {
                attributes.push(Attribute { name: name.into(), value, range: start..self.at });
            }
        }
    }
}

fn is_space(character: char) -> bool {
    matches!(character, ' ' | '\t' | '\n' | '\r')
}

fn is_name_start(character: char) -> bool {
    character.is_alphabetic() || matches!(character, '_' | ':')
}

fn is_name(character: char) -> bool {
    is_name_start(character) || character.is_numeric() || matches!(character, '.' | '-' | '·')
}

/// A value with its references replaced; none if one of them is no number of a character. Unknown entities are left out.
fn value(text: &str) -> Option<Cow<'_, str>> {
    if !text.contains(['&', '\n', '\t', '\r']) {
        return Some(text.into());
    }
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('&') {
        out.push_str(&rest[..at]);
        rest = &rest[at + 1..];
        if let Some(number) = rest.strip_prefix('#') {
            let (number, behind) = number.split_once(';')?;
            let code = match number.strip_prefix('x') {
                Some(digits) => u32::from_str_radix(digits, 16),
                None => number.parse(),
            };
            let code = code.ok().filter(|code| *code > 0)?;
            out.push(char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER));
            rest = behind;
            continue;
        }
        let end = rest.find(|character| !is_name(character)).unwrap_or(rest.len());
        let (name, behind) = rest.split_at(end);
        let entities = [("amp", '&'), ("lt", '<'), ("gt", '>'), ("quot", '"'), ("apos", '\'')];
        let known = entities.iter().find(|(one, _)| *one == name && behind.starts_with(';'));
        out.extend(known.map(|(_, character)| *character));
        rest = behind.strip_prefix(';').filter(|_| end > 0).unwrap_or(behind);
    }
    out.push_str(rest);
    Some(out.replace(['\n', '\t', '\r'], " ").into())
}
