//! Text that is no XML, and that tinyxml2 reads: as XML that says the same.
//!
//! tinyxml2 takes `--` in a comment, text and elements around the outermost one, undeclared prefixes, entities that nobody
//! declared, `<` in values, and more. Nothing of what it passes over is in the new text.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::BTreeSet;

use quick_xml::escape::escape;
use roxmltree::Error;

use crate::document::{Document, parse};
use crate::error::{Kind, MAX_LEVELS, XmlError, text_pos};
use crate::prolog::is_character;
use crate::tinyxml2::{Attribute, Event, Malformed, Parser};

/// The text that was made of one that is no XML; empty of one that is.
#[derive(Debug, Default)]
pub struct Mended(OnceCell<Made>);

#[derive(Debug, Default)]
struct Made {
    text: String,
    /// Where each start tag is in it, and in the text that it was made of.
    places: Vec<(usize, usize)>,
}

impl Mended {
    /// The memory that it takes, in bytes.
    pub fn size(&self) -> usize {
        self.0.get().map_or(0, |made| made.text.len() + size_of_val(&*made.places))
    }

    /// Where the tag at a byte of the document is in the text that a person wrote.
    pub fn original(&self, at: usize) -> usize {
        let Some(made) = self.0.get() else { return at };
        let before = made.places.partition_point(|(here, _)| *here <= at);
        before.checked_sub(1).map_or(0, |last| made.places[last].1)
    }
}

/// Parses a text as a program does that reads by tinyxml2: the first outermost element that is called `root`, or else the
/// first. The limits are those of [`Kind::Other`].
///
/// # Errors
/// [`XmlError`] if tinyxml2 refuses the text, or if it declares entities or exceeds a limit.
pub fn parse_leniently<'t>(
    text: &'t str,
    root: &str,
    mended: &'t Mended,
) -> Result<Document<'t>, XmlError> {
    let strict = match parse(text, Kind::Other) {
        Err(XmlError::Parser(error)) => error,
        done => return done,
    };
    let made = match made(text, root) {
        Ok(made) => made,
        Err(_) if is_fault_for_all(&strict) => return Err(XmlError::Parser(strict)),
        Err(Malformed { at, why }) => return Err(XmlError::refused(text, floor(text, at), why)),
    };
    let made = mended.0.get_or_init(|| made);
    parse(&made.text, Kind::Other).map_err(|error| {
        let at = mended.original(error.offset(&made.text));
        XmlError::Refused { what: error.words(&made.text), pos: text_pos(text, at) }
    })
}

/// Whether tinyxml2 refuses this too: then the words of the strict parser say more.
fn is_fault_for_all(error: &Error) -> bool {
    matches!(
        error,
        Error::UnexpectedCloseTag(..)
            | Error::NoRootNode
            | Error::UnclosedRootNode
            | Error::UnexpectedEndOfStream
            | Error::DuplicatedAttribute(..)
    )
}

/// The text of one outermost element: the first of a name, or else the first.
fn made(text: &str, root: &str) -> Result<Made, Malformed> {
    let mut parser = Parser::new(text.as_bytes())?;
    let mut tops: Vec<bool> = Vec::new();
    loop {
        let is_top = !parser.is_inside();
        match parser.event()? {
            Some(Event::Start { name, .. }) if is_top => tops.push(name == root),
            Some(_) => {}
            None => break,
        }
    }
    let wanted = tops.iter().position(|is_root| *is_root).unwrap_or_default();
    let (mut made, mut prefixes) = (Made::default(), BTreeSet::new());
    let (mut open, mut top) = (Vec::new(), 0);
    let mut parser = Parser::new(text.as_bytes())?;
    while let Some(event) = parser.event()? {
        let is_wanted = top == wanted;
        match event {
            Event::Start { name, attributes, tag, is_empty } => {
                if open.len() == MAX_LEVELS {
                    return Err(Malformed { at: tag.start, why: "elements are nested too deep" });
                }
                let name = plain_name(&name);
                if is_wanted {
                    made.begin(&name, &attributes, tag.start, is_empty, &mut prefixes);
                }
                if !is_empty {
                    open.push(name);
                }
                top += usize::from(open.is_empty());
            }
            Event::End => {
                let name = open.pop().unwrap_or_default();
                if is_wanted {
                    made.text += &format!("</{name}>");
                }
                top += usize::from(open.is_empty());
            }
            Event::Text(text, _) | Event::Data(text) if is_wanted && !open.is_empty() => {
                made.text.push_str(&escape(valid(&text)));
            }
            Event::Text(..) | Event::Data(_) | Event::Unknown => {}
        }
    }
    let declared = prefixes.iter().map(|prefix| format!(" xmlns:{prefix}=\"urn:urdd:{prefix}\""));
    made.insert(&declared.collect::<String>());
    Ok(made)
}

impl Made {
    fn begin(
        &mut self,
        name: &str,
        attributes: &[Attribute<'_>],
        place: usize,
        is_empty: bool,
        prefixes: &mut BTreeSet<String>,
    ) {
        self.places.push((self.text.len(), place));
        let mut uses = |name: &str| {
            let prefix = name.split_once(':').map(|(prefix, _)| prefix);
            prefixes.extend(prefix.filter(|prefix| *prefix != "xml").map(str::to_owned));
        };
        uses(name);
        self.text += &format!("<{name}");
        for attribute in attributes {
            // Prefixes are declared at the outermost element.
            if attribute.name == "xmlns" || attribute.name.starts_with("xmlns:") {
                continue;
            }
            let name = plain_name(&attribute.name);
            uses(&name);
            self.text += &format!(" {name}=\"{}\"", escape(valid(&attribute.value)));
        }
        self.text.push_str(if is_empty { "/>" } else { ">" });
    }

    /// Puts attributes into the outermost element.
    fn insert(&mut self, attributes: &str) {
        let end = self.text.find(|c: char| c.is_ascii_whitespace() || matches!(c, '>' | '/'));
        self.text.insert_str(end.unwrap_or_default(), attributes);
        let later = self.places.iter_mut().skip(1);
        later.for_each(|(here, _)| *here += attributes.len());
    }
}

/// A name as XML can have it, with one colon at most.
fn plain_name(name: &str) -> String {
    let single = name.replace("::", "__");
    let parts = || single.split(':');
    let is_qualified = parts().count() <= 2 && parts().all(|part| !matches!(part, "" | "xmlns"));
    let is_plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
    let each = single.chars().map(|c| match c {
        ':' if is_qualified => ':',
        c if is_plain(c) => c,
        _ => '_',
    });
    let plain: String = each.collect();
    // What is behind a prefix may begin with what no name begins with.
    let begins = |part: &str| part.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    if plain.split(':').all(begins) { plain } else { format!("_{}", plain.replace(':', "_")) }
}

/// A text without characters that XML does not have.
fn valid(text: &str) -> Cow<'_, str> {
    match text.chars().all(is_character) {
        true => Cow::Borrowed(text),
        false => text.chars().filter(|c| is_character(*c)).collect::<String>().into(),
    }
}

/// The character that a byte is of.
fn floor(text: &str, at: usize) -> usize {
    (0..=at).rev().find(|at| text.is_char_boundary(*at)).unwrap_or_default()
}
