//! XML as RustyXML 0.3.0 reads it, which urdf-rs uses: the first element that is closed is all there is, any text is a
//! name, and a prefix without a namespace is refused. The names of the tree are without prefixes.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use crate::tinyxml::Malformed;
use crate::tree::{Attribute, Element, Tree};

type Parsed<T> = Result<T, Malformed>;

/// White space.
const SPACES: [char; 4] = [' ', '\t', '\r', '\n'];
/// Namespaces that each document has.
const XML: &str = "http://www.w3.org/XML/1998/namespace";
const XMLNS: &str = "http://www.w3.org/2000/xmlns/";

/// Parses a file up to the end of its first element.
pub(crate) fn parse(text: &str) -> Parsed<Tree<'_>> {
    let namespaces =
        HashMap::from([("xml", vec![Cow::Borrowed(XML)]), ("xmlns", vec![Cow::Borrowed(XMLNS)])]);
    let mut parser = Parser { text, at: 0, namespaces, tree: Tree::default(), open: Vec::new() };
    parser.document()?;
    Ok(parser.tree)
}

/// An element that is not closed yet.
struct Open<'a> {
    index: usize,
    namespace: Option<Cow<'a, str>>,
    /// The prefixes that it declares.
    declares: Vec<&'a str>,
}

struct Parser<'a> {
    text: &'a str,
    at: usize,
    /// The namespaces of a prefix, the innermost last. The default one is of the prefix ``.
    namespaces: HashMap<&'a str, Vec<Cow<'a, str>>>,
    tree: Tree<'a>,
    open: Vec<Open<'a>>,
}

impl<'a> Parser<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn refuse<T>(at: usize, why: &'static str) -> Parsed<T> {
        Err(Malformed { at, why })
    }

    /// Where the file ends too early: at the element that is open.
    fn cut<T>(&self) -> Parsed<T> {
        match self.open.last() {
            Some(open) => {
                Self::refuse(self.tree.elements[open.index].tag.start, "an element is not closed")
            }
            None => Self::refuse(0, "the file has no element that is closed"),
        }
    }

    /// Takes all up to a mark, and the mark.
    fn until(&mut self, mark: &str) -> Parsed<&'a str> {
        match self.rest().split_once(mark) {
            Some((before, _)) => {
                self.at += before.len() + mark.len();
                Ok(before)
            }
            None => self.cut(),
        }
    }

    fn document(&mut self) -> Parsed<()> {
        loop {
            let start = self.at;
            let text = self.until("<")?;
            self.text_of_open(unescaped(text, start)?);
            let (here, rest) = (self.at - 1, self.rest());
            if let Some(name) = rest.strip_prefix('/') {
                self.at = self.text.len() - name.len();
                if self.end_tag(here)? {
                    return Ok(());
                }
            } else if rest.starts_with('?') {
                self.at += 1;
                self.until("?")?;
                self.until(">")?;
            } else if rest.starts_with('!') {
                self.at += 1;
                self.declaration(here)?;
            } else if self.start_tag(here)? {
                return Ok(());
            }
        }
    }

    /// Keeps text that is not blank.
    fn text_of_open(&mut self, text: Cow<'a, str>) {
        let is_blank = text.trim_matches(SPACES).is_empty();
        let Some(open) = self.open.last().filter(|_| !is_blank) else { return };
        let kept = &mut self.tree.elements[open.index].text;
        match kept {
            Some(before) => before.to_mut().push_str(&text),
            None => *kept = Some(text),
        }
    }

    /// What begins with `<!`.
    fn declaration(&mut self, here: usize) -> Parsed<()> {
        if self.rest().starts_with("--") {
            self.at += 2;
            self.until("--")?;
            return match self.rest().starts_with('>') {
                true => self.until(">").map(|_| ()),
                false => Self::refuse(self.at - 2, "a comment has `--` inside"),
            };
        }
        if self.rest().starts_with("[CDATA[") {
            self.at += 7;
            let text = self.until("]]>")?;
            self.text_of_open(text.into());
            return Ok(());
        }
        match self.rest().strip_prefix("DOCTYPE") {
            Some(rest) if rest.starts_with(SPACES) => self.until(">").map(|_| ()),
            _ => Self::refuse(here, "`<!` is followed by what is not XML"),
        }
    }

    /// An end tag. Returns whether the root ends.
    fn end_tag(&mut self, here: usize) -> Parsed<bool> {
        let rest = self.rest();
        let Some(end) = rest.find([' ', '\t', '\r', '\n', '>']) else { return self.cut() };
        self.at += end;
        let (prefix, name) = split(&rest[..end]);
        let namespace = self.namespace(prefix, here)?;
        let Some(open) = self.open.pop() else {
            return Self::refuse(here, "an end tag closes nothing");
        };
        self.leave(&open.declares);
        let element = &self.tree.elements[open.index];
        if element.name != name || open.namespace != namespace {
            return Self::refuse(element.tag.start, "an element is closed by another name");
        }
        if self.open.is_empty() {
            return Ok(true);
        }
        match self.until(">")?.trim_matches(SPACES) {
            "" => Ok(false),
            _ => Self::refuse(here, "an end tag has more than a name"),
        }
    }

    /// A start tag. Returns whether the root ends with it.
    fn start_tag(&mut self, here: usize) -> Parsed<bool> {
        let rest = self.rest();
        // Any character begins a name.
        let mut characters = rest.char_indices().skip(1);
        let ends = |character| matches!(character, ' ' | '\t' | '\r' | '\n' | '/' | '>');
        let Some((end, _)) = characters.find(|(_, character)| ends(*character)) else {
            return self.cut();
        };
        self.at += end;
        let (prefix, name) = split(&rest[..end]);
        let mut found = Vec::new();
        while self.attribute(here, &mut found)? {}
        let declares = self.declare(&found);
        let namespace = self.namespace(prefix, here)?;
        let attributes = self.attributes(found)?;
        let is_empty = self.rest().starts_with('/');
        self.at += 1;
        if is_empty {
            if !self.rest().starts_with('>') {
                return match self.rest().is_empty() {
                    true => self.cut(),
                    false => Self::refuse(here, "`/` is not followed by `>`"),
                };
            }
            self.at += 1;
        }
        let index = self.tree.elements.len();
        match self.open.last() {
            Some(open) => self.tree.elements[open.index].children.push(index),
            None => self.tree.tops.push(index),
        }
        self.tree.elements.push(Element {
            name: name.into(),
            attributes,
            children: Vec::new(),
            text: None,
            tag: here..self.at,
        });
        if is_empty {
            self.leave(&declares);
            return Ok(self.open.is_empty());
        }
        self.open.push(Open { index, namespace, declares });
        Ok(false)
    }

    /// The next attribute of a tag, with its prefix. Returns false at the end of the tag.
    fn attribute(&mut self, tag: usize, found: &mut Vec<Raw<'a>>) -> Parsed<bool> {
        let rest = self.rest().trim_start_matches(SPACES);
        self.at = self.text.len() - rest.len();
        let start = self.at;
        let Some(first) = rest.chars().next() else { return self.cut() };
        if matches!(first, '/' | '>') {
            return Ok(false);
        }
        let behind = first.len_utf8();
        let Some(end) = rest[behind..].find('=') else {
            let has_space = rest.trim_end_matches(SPACES).contains(SPACES);
            return match has_space {
                true => Self::refuse(start, "an attribute has no value"),
                false => Self::refuse(tag, "an element is not closed"),
            };
        };
        let name = rest[..behind + end].trim_end_matches(SPACES);
        if name.contains(SPACES) {
            return Self::refuse(start, "an attribute has no value");
        }
        self.at += behind + end + 1;
        let rest = self.rest().trim_start_matches(SPACES);
        self.at = self.text.len() - rest.len();
        let quote = match rest.chars().next() {
            Some('"') => "\"",
            Some('\'') => "'",
            _ => return Self::refuse(start, "the value of an attribute is not in quotes"),
        };
        self.at += 1;
        let at = self.at;
        let Ok(value) = self.until(quote) else {
            return Self::refuse(start, "the value of an attribute is not closed");
        };
        let (prefix, name) = split(name);
        found.push(Raw { prefix, name, value: unescaped(value, at)?, range: start..self.at });
        Ok(true)
    }

    /// Makes the namespaces of a tag known. Returns their prefixes.
    fn declare(&mut self, attributes: &[Raw<'a>]) -> Vec<&'a str> {
        let mut prefixes = Vec::new();
        for one in attributes {
            let prefix = match (one.prefix, one.name) {
                (Some("xmlns"), prefix) => prefix,
                (None, "xmlns") => "",
                _ => continue,
            };
            self.namespaces.entry(prefix).or_default().push(one.value.clone());
            prefixes.push(prefix);
        }
        prefixes
    }

    /// Forgets the namespaces of an element.
    fn leave(&mut self, prefixes: &[&'a str]) {
        for prefix in prefixes {
            self.namespaces.get_mut(prefix).and_then(Vec::pop);
        }
    }

    /// The namespace of a prefix, which needs one.
    fn namespace(&self, prefix: Option<&str>, at: usize) -> Parsed<Option<Cow<'a, str>>> {
        let bound = self.namespaces.get(prefix.unwrap_or_default()).and_then(|all| all.last());
        let bound = bound.filter(|namespace| !namespace.is_empty()).cloned();
        match prefix.is_some() && bound.is_none() {
            true => Self::refuse(at, "a name has a prefix without a namespace (`xmlns`)"),
            false => Ok(bound),
        }
    }

    /// The attributes of a tag, without those that declare namespaces.
    fn attributes(&self, found: Vec<Raw<'a>>) -> Parsed<Vec<Attribute<'a>>> {
        let mut names = HashSet::new();
        let mut attributes = Vec::new();
        for one in found {
            let namespace = match one.prefix {
                Some(_) => self.namespace(one.prefix, one.range.start)?,
                None => None,
            };
            if !names.insert((one.name, namespace)) {
                let why = "an attribute stands twice in one element";
                return Self::refuse(one.range.start, why);
            }
            let name = match (one.prefix, one.name) {
                // Refused where it is read again.
                (Some("xmlns"), _) if one.value.is_empty() => "xmlns:".into(),
                (Some("xmlns"), _) | (None, "xmlns") => continue,
                (_, name) => name.into(),
            };
            attributes.push(Attribute { name, value: one.value, range: one.range });
        }
        Ok(attributes)
    }
}

/// An attribute as it is written.
struct Raw<'a> {
    prefix: Option<&'a str>,
    name: &'a str,
    value: Cow<'a, str>,
    range: std::ops::Range<usize>,
}

/// A prefix, and the name behind it.
fn split(name: &str) -> (Option<&str>, &str) {
    match name.split_once(':') {
        Some((prefix, name)) => (Some(prefix), name),
        None => (None, name),
    }
}

/// Text with its entities replaced.
fn unescaped(text: &str, at: usize) -> Parsed<Cow<'_, str>> {
    if !text.contains('&') {
        return Ok(text.into());
    }
    let mut out = String::with_capacity(text.len());
    for (number, piece) in text.split('&').enumerate() {
        if number == 0 {
            out.push_str(piece);
            continue;
        }
        let replaced = piece.split_once(';').and_then(|(name, rest)| Some((entity(name)?, rest)));
        let Some((character, rest)) = replaced else {
            let place = at + (piece.as_ptr() as usize - text.as_ptr() as usize) - 1;
            return Err(Malformed { at: place, why: "`&` does not begin an entity of XML" });
        };
        out.push(character);
        out.push_str(rest);
    }
    Ok(out.into())
}

/// The character of an entity.
fn entity(name: &str) -> Option<char> {
    Some(match name {
        "quot" => '"',
        "amp" => '&',
        "apos" => '\'',
        "lt" => '<',
        "gt" => '>',
        _ => {
            let number = name.strip_prefix('#')?;
            let code = match number.strip_prefix('x') {
                Some(digits) => u32::from_str_radix(digits, 16),
                None => number.parse(),
            };
            char::from_u32(code.ok()?)?
        }
    })
}
