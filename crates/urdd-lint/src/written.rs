//! The place in a .xacro file that a link or joint of its expansion was written at, as far as its name tells.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use urdd_xml::Node;

use urdd_directory::limits::MAX_SRDF_BYTES;
use urdd_directory::position::LineIndex;
use urdd_directory::regular;
use urdd_findings::check::Check;
use urdd_findings::finding::Finding;
use urdd_format::index::Count;
use urdd_format::report::{Place, WrittenAt};
use urdd_xml::element::name;

/// The links and joints in xacro files.
#[derive(Debug, Default)]
pub struct Sources {
    elements: Vec<Element>,
}

/// A link or joint as it is written.
#[derive(Debug)]
struct Element {
    /// `link` or `joint`.
    tag: String,
    /// The fixed parts of its name, between what xacro puts in.
    parts: Vec<String>,
    at: WrittenAt,
}

impl Sources {
    /// Reads xacro files. Those that cannot be read are left out. Names in the report are seen from `folder`.
    pub fn read(files: &[PathBuf], folder: &Path) -> Self {
        let mut sources = Sources::default();
        for file in files {
            let bytes = regular::read(file, MAX_SRDF_BYTES).ok();
            let text = bytes.and_then(|bytes| String::from_utf8(bytes).ok());
            let Some(text) = text else { continue };
            if let Ok(document) = urdd_xml::parse(&text, urdd_xml::Kind::Robot) {
                let shown = seen_from(file, folder);
                let lines = LineIndex::new(&text);
                let nodes = document.descendants().filter(Node::is_element);
                sources.elements.extend(nodes.filter_map(|node| element(node, &lines, &shown)));
            }
        }
        sources
    }

    /// Where "link `NAME`" is written: the one element whose name fits with the most fixed letters.
    pub fn find(&self, subject: &str) -> Option<&WrittenAt> {
        let (tag, wanted) = named(subject)?;
        let fitting =
            self.elements.iter().filter(|element| element.tag == tag && element.fits(wanted));
        let letters = |element: &Element| element.parts.iter().map(String::len).sum::<usize>();
        let most = fitting.clone().map(letters).max().filter(|most| *most > 0)?;
        let mut best = fitting.filter(|element| letters(element) == most);
        let first = best.next()?;
        best.next().is_none().then_some(&first.at)
    }
}

/// What "link `NAME`" is about: `link`, and the name.
pub fn named(subject: &str) -> Option<(&str, &str)> {
    let (tag, quoted) = subject.split_once(' ')?;
    Some((tag, quoted.strip_prefix('`')?.strip_suffix('`')?))
}

/// Says of each finding about a link or joint where that is written, as `find` knows by the subject.
pub fn say_where(checks: &mut [Check], find: impl Fn(&str) -> Option<WrittenAt>) {
    let mut known: HashMap<String, Option<WrittenAt>> = HashMap::new();
    let mut say = |place: &mut Place| {
        let Some(subject) = &place.subject else { return };
        if !known.contains_key(subject) {
            known.insert(subject.clone(), find(subject));
        }
        place.written_at.clone_from(&known[subject]);
    };
    let findings = checks.iter_mut().flat_map(|check| &mut check.findings);
    for place in findings.flat_map(Finding::places_mut) {
        say(place);
        place.related.iter_mut().for_each(&mut say);
    }
}

impl Element {
    fn fits(&self, wanted: &str) -> bool {
        let [first, between @ .., last] = &self.parts[..] else {
            return self.parts.first().is_some_and(|only| only == wanted);
        };
        let rest =
            wanted.strip_prefix(first.as_str()).and_then(|rest| rest.strip_suffix(last.as_str()));
        let Some(mut rest) = rest else { return false };
        between.iter().all(|part| match rest.split_once(part.as_str()) {
            Some((_, after)) => {
                rest = after;
                true
            }
            None => false,
        })
    }
}

fn element(node: Node, lines: &LineIndex, file: &str) -> Option<Element> {
    let tag = name(node);
    let named = node.attribute("name").filter(|_| matches!(tag, "link" | "joint"))?;
    let position = lines.position(node.range().start);
    let is_macro = |one: &Node| one.is_element() && name(*one) == "xacro:macro";
    let holder = node.ancestors().find(is_macro);
    Some(Element {
        tag: tag.to_owned(),
        parts: fixed_parts(named),
        at: WrittenAt {
            file: file.to_owned(),
            line: Some(Count(position.line)),
            column: Some(Count(position.column)),
            macro_name: holder.and_then(|holder| Some(holder.attribute("name")?.to_owned())),
        },
    })
}

/// What is between `${…}` and `$(…)` in a name.
pub fn fixed_parts(name: &str) -> Vec<String> {
    let mut parts = Vec::new();
    let mut start = 0;
    for (at, _) in name.match_indices('$').filter(|(at, _)| name[at + 1..].starts_with(['{', '(']))
    {
        let close = if name[at + 1..].starts_with('{') { '}' } else { ')' };
        if let (true, Some(length)) = (at >= start, name[at..].find(close)) {
            parts.push(name[start..at].to_owned());
            start = at + length + 1;
        }
    }
    parts.push(name[start..].to_owned());
    parts
}

/// The path of a file as seen from a folder, with forward slashes.
pub fn seen_from(file: &Path, folder: &Path) -> String {
    let mut up = String::new();
    for above in folder.ancestors() {
        if let Ok(inside) = file.strip_prefix(above) {
            return up + &inside.to_string_lossy().replace('\\', "/");
        }
        up += "../";
    }
    file.to_string_lossy().into_owned()
}
