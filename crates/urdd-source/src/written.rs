//! The map of an expansion: from places in the text that xacro made to those in the files that a person wrote.

use std::collections::HashMap;
use std::ops::Range;
use std::path::{Component, Path, PathBuf};

use urdd_directory::position::{LineIndex, Position};
use urdd_directory::regular;
use urdd_xml::Node;
use urdd_xml::element::name;

use crate::fault::{Fault, PlacedFault};
use crate::files::MAX_SOURCE_BYTES;
use crate::note::{MacroCall, SourcePlace};
use crate::trail::{ElementPlace, Trail, ValuePlace};

/// A place in a file that a person wrote.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WrittenPlace {
    /// The file, as seen from the folder of the one that was expanded, with forward slashes.
    pub file: String,
    /// Whether it is the one that was expanded.
    pub is_main: bool,
    /// The place in it.
    pub at: Position,
    /// The macro that holds it; that of a call is the one that is called.
    pub macro_name: Option<String>,
}

impl WrittenPlace {
    /// The name of its file, where the one that was expanded is called `main`.
    pub fn named(&self, main: &str) -> String {
        match self.is_main {
            true => main.to_owned(),
            false => plain(&Path::new(main).with_file_name(&self.file).to_string_lossy()),
        }
    }

    fn of_source(&self, main: &str) -> SourcePlace {
        let Position { line, column } = self.at;
        SourcePlace { file: self.named(main), line, column }
    }
}

/// What a place of an expansion was made from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The one literal that it is from, such as an attribute of a macro's call, a property or a line of a YAML; without one,
    /// the element or the attribute.
    pub place: WrittenPlace,
    /// The element or the attribute, where the literal is elsewhere.
    pub used_at: Option<WrittenPlace>,
    /// The calls of macros that it is from, innermost first.
    pub calls: Vec<WrittenPlace>,
}

/// The files of a trail: their names as [`WrittenPlace`] has them, whether they are the one that was expanded, and their
/// texts where these could be read.
pub(crate) struct SourceFiles(Vec<(String, bool, Option<String>)>);

/// The texts of files by the files' numbers.
type Sources<'a> = HashMap<usize, (Marked<'a>, LineIndex<'a>)>;

impl SourceFiles {
    pub(crate) fn new(trail: &Trail, file: &Path) -> Self {
        let main = file.canonicalize().unwrap_or_else(|_| file.to_owned());
        let folder = main.parent().unwrap_or(Path::new("")).to_owned();
        let mut left = MAX_SOURCE_BYTES;
        let files = trail.files.iter().map(|path| {
            // As Rust spells it.
            let path = &path.canonicalize().unwrap_or_else(|_| path.clone());
            let text = regular::read(path, left).ok();
            left -= text.as_ref().map_or(0, |text| text.len() as u64);
            let text = text.and_then(|text| String::from_utf8(text).ok());
            (seen_from(path, &folder), *path == main, text)
        });
        SourceFiles(files.collect())
    }

    /// The name of each file with its text, if that could be read.
    pub(crate) fn texts(&self) -> impl Iterator<Item = (&str, Option<&str>)> {
        self.0.iter().map(|(file, _, text)| (file.as_str(), text.as_deref()))
    }

    /// Where a place is, more exactly than it was noted: at the attribute, and at the parameter in it.
    fn find<'a>(&'a self, place: &ValuePlace, sources: &mut Sources<'a>) -> Option<WrittenPlace> {
        let ValuePlace(number, line, column, attribute, parameter) = place;
        let (file, is_main, text) = self.0.get(*number)?;
        let at = Position { line: *line, column: *column };
        let mut found =
            WrittenPlace { file: file.clone(), is_main: *is_main, at, macro_name: None };
        if let Some(text) = text {
            let (marked, lines) =
                sources.entry(*number).or_insert_with(|| (Marked::new(text), LineIndex::new(text)));
            if let Some(element) = lines.offset(at) {
                let attribute = marked.attribute(element, attribute);
                found.at = lines.position(marked.parameter(attribute, parameter));
                found.macro_name = marked.macro_around(element).map(str::to_owned);
            }
        }
        Some(found)
    }

    /// A call of a macro and those around it.
    fn calls<'a>(
        &'a self,
        (trail, innermost): (&Trail, Option<usize>),
        sources: &mut Sources<'a>,
    ) -> Vec<WrittenPlace> {
        let around = trail.calls_around(innermost).into_iter();
        let call = |(place, name): (ElementPlace, &str)| {
            let found = self.find(&ValuePlace::element(place, ""), sources)?;
            Some(WrittenPlace { macro_name: Some(name.to_owned()), ..found })
        };
        around.filter_map(call).collect()
    }
}

/// Where xacro failed, and the calls of macros around that; `shown` is what the file that it expanded is called.
pub(crate) fn fault_place(
    trail: &Trail,
    file: &Path,
    shown: &str,
) -> Option<(SourcePlace, Vec<MacroCall>)> {
    let (place, innermost) = trail.fault.as_ref()?;
    let (files, mut sources) = (SourceFiles::new(trail, file), HashMap::new());
    let place = files.find(place, &mut sources)?.of_source(shown);
    let calls = files.calls((trail, *innermost), &mut sources).into_iter();
    let call = |call: WrittenPlace| MacroCall {
        place: call.of_source(shown),
        name: call.macro_name.unwrap_or_default(),
    };
    Some((place, calls.map(call).collect()))
}

/// A map of places.
pub struct WrittenMap<'a> {
    trail: &'a Trail,
    expanded: Marked<'a>,
    files: SourceFiles,
    values: HashMap<(usize, &'a str), &'a ValuePlace>,
}

impl<'a> WrittenMap<'a> {
    /// The map of the text that xacro made of a file, of which the trail tells.
    pub fn new(text: &'a str, trail: &'a Trail, file: &Path) -> Self {
        let expanded = Marked::new(text);
        let is_of_text = expanded.count == trail.elements.len();
        let values = trail.values.iter().map(|(element, name, at)| ((*element, name.as_str()), at));
        WrittenMap {
            trail,
            expanded,
            files: if is_of_text { SourceFiles::new(trail, file) } else { SourceFiles(Vec::new()) },
            values: values.collect(),
        }
    }

    /// Where each of these places in the expansion is written, as far as that is known: the literal that a value is from, the
    /// attribute, or else the element.
    pub fn find(&self, places: impl IntoIterator<Item = Position>) -> HashMap<Position, Written> {
        let lines = LineIndex::new(self.expanded.text);
        let mut sources = HashMap::new();
        let written = |place: Position| {
            let (element, attribute) = self.expanded.at(lines.offset(place)?)?;
            let (file, line, column, call) = (*self.trail.elements.get(element)?)?;
            let own = ValuePlace::element((file, line, column), attribute);
            let own = self.files.find(&own, &mut sources)?;
            let value = self.values.get(&(element, attribute));
            let value = value.and_then(|value| self.files.find(value, &mut sources));
            let calls = self.files.calls((self.trail, call), &mut sources);
            let (found, used_at) = match value {
                Some(value) => (value, Some(own)),
                None => (own, None),
            };
            Some((place, Written { place: found, used_at, calls }))
        };
        places.into_iter().filter_map(written).collect()
    }
}

/// Where the elements and attributes of a text are.
struct Marked<'a> {
    text: &'a str,
    /// Each element with its number and no name, followed by its attributes with their names.
    marks: Vec<(usize, usize, &'a str)>,
    count: usize,
    macros: Vec<String>,
    /// The innermost macro around each element.
    around: Vec<Option<usize>>,
}

impl<'a> Marked<'a> {
    fn new(text: &'a str) -> Self {
        let mut marked =
            Marked { text, marks: Vec::new(), count: 0, macros: Vec::new(), around: Vec::new() };
        let Ok(document) = urdd_xml::parse(text, urdd_xml::Kind::Robot) else { return marked };
        // The macros around an element, each with its end.
        let mut open: Vec<(usize, usize)> = Vec::new();
        for node in document.descendants().filter(Node::is_element) {
            let Range { start, end } = node.range();
            while open.last().is_some_and(|(end, _)| *end <= start) {
                open.pop();
            }
            marked.marks.push((start, marked.count, ""));
            marked.marks.extend(node.attributes().map(|one| {
                let name = one.range_qname();
                (name.start, marked.count, &text[name])
            }));
            if let ("xacro:macro", Some(name)) = (name(node), node.attribute("name")) {
                open.push((end, marked.macros.len()));
                marked.macros.push(name.to_owned());
            }
            marked.around.push(open.last().map(|(_, name)| *name));
            marked.count += 1;
        }
        marked
    }

    /// The number of the element that is at an offset or is the last before it, and the attribute whose name is there.
    fn at(&self, offset: usize) -> Option<(usize, &'a str)> {
        let after = self.marks.partition_point(|(start, ..)| *start <= offset);
        let (start, element, attribute) = self.marks.get(after.checked_sub(1)?)?;
        Some((*element, if *start == offset { attribute } else { "" }))
    }

    /// Where the attribute of the element at an offset is; the element without it.
    fn attribute(&self, element: usize, wanted: &str) -> usize {
        let from = self.marks.partition_point(|(start, ..)| *start < element);
        let mut own = self.marks[from..].iter().skip(1).take_while(|(_, _, name)| !name.is_empty());
        own.find(|(_, _, name)| *name == wanted).map_or(element, |(start, ..)| *start)
    }

    /// Where the parameter with a default is in the attribute at an offset; the attribute without it.
    fn parameter(&self, attribute: usize, name: &str) -> usize {
        let value = || {
            let start = attribute + self.text[attribute..].find(['"', '\''])?;
            let quote = self.text[start..].chars().next()?;
            let start = start + quote.len_utf8();
            let value = &self.text[start..start + self.text[start..].find(quote)?];
            let is_it = |(at, _): &(usize, &str)| {
                let after = value[at + name.len()..].trim_start();
                value[..*at].chars().next_back().is_none_or(char::is_whitespace)
                    && (after.starts_with('=') || after.starts_with(":="))
            };
            Some(start + value.match_indices(name).find(is_it)?.0)
        };
        if name.is_empty() { attribute } else { value().unwrap_or(attribute) }
    }

    fn macro_around(&self, offset: usize) -> Option<&str> {
        let (element, _) = self.at(offset)?;
        self.around.get(element).copied()?.map(|name| self.macros[name].as_str())
    }
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

/// A path without the folders that `..` leaves again.
pub(crate) fn plain(path: &str) -> String {
    let mut plain = PathBuf::new();
    for part in Path::new(path).components() {
        match (part, plain.components().next_back()) {
            (Component::ParentDir, Some(Component::Normal(_))) => {
                plain.pop();
            }
            (part, _) => plain.push(part),
        }
    }
    plain.to_string_lossy().into_owned()
}

/// What a text was made from.
pub struct Origin<'a> {
    /// The file, as the user named it.
    pub shown: &'a str,
    /// Number of lines that are missing at the beginning.
    pub first_line: u32,
    /// Where xacro has its elements from.
    pub trail: Option<&'a Trail>,
    /// The file.
    pub path: &'a Path,
}

impl Origin<'_> {
    /// Where offsets of the text are in the user's files.
    pub fn offsets(&self, text: &str, offsets: impl Iterator<Item = usize>) -> Vec<SourcePlace> {
        let lines = LineIndex::new(text);
        self.places(text, offsets.map(|offset| lines.position(offset)).collect())
    }

    /// Where places of the text are in the user's files: lines of an expansion are in none.
    fn places(&self, text: &str, places: Vec<Position>) -> Vec<SourcePlace> {
        let Some(trail) = self.trail.filter(|_| !places.is_empty()) else {
            let line = |at: Position| if at.line == 0 { 0 } else { at.line + self.first_line };
            let place = |at: Position| SourcePlace {
                file: self.shown.to_owned(),
                line: line(at),
                column: at.column,
            };
            return places.into_iter().map(place).collect();
        };
        let found = WrittenMap::new(text, trail, self.path).find(places.iter().copied());
        let place = |at: Position| match found.get(&at) {
            Some(written) => written.place.of_source(self.shown),
            None => SourcePlace { file: self.shown.to_owned(), line: 0, column: 0 },
        };
        places.into_iter().map(place).collect()
    }

    /// Faults, each where it is in the user's files.
    pub fn faults(&self, text: &str, mut faults: Vec<PlacedFault>) -> Vec<PlacedFault> {
        let places = faults.iter().map(|one| Position { line: one.line, column: one.column });
        let places = self.places(text, places.collect());
        for (placed, SourcePlace { file, line, column }) in faults.iter_mut().zip(places) {
            placed.file = Some(file).filter(|file| file != self.shown);
            (placed.line, placed.column) = (line, column);
            if let Fault::TwoLinks { first, .. } | Fault::TwoJoints { first, .. } =
                &mut placed.fault
                && *first > 0
            {
                *first = if self.trail.is_some() { 0 } else { *first + self.first_line };
            }
        }
        faults
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::WrittenMap;
    use crate::trail::Trail;
    use urdd_directory::position::Position;

    const MACROS: &str = "<robot xmlns:xacro='x'>\n<xacro:macro name='é'>\n é <link\n  \
        name='${p}a'/></xacro:macro>\n<link name='b'/></robot>\n";
    const EXPANDED: &str = "<robot name='r'><link name='la'/><link name='b'/><new/></robot>";

    #[test]
    #[expect(clippy::disallowed_methods, reason = "a test writes as it likes")]
    fn places_are_those_of_elements_and_attributes_in_their_files() {
        let folder = tempfile::tempdir().expect("a folder");
        let root = folder.path().canonicalize().expect("a folder");
        let [main, macros] = ["urdf/a.xacro", "parts/m.xacro"].map(|name| root.join(name));
        for file in [&main, &macros] {
            std::fs::create_dir(file.parent().expect("a folder")).expect("a folder");
        }
        std::fs::write(&main, "<robot name='r'/>").expect("written");
        std::fs::write(&macros, MACROS).expect("written");
        let at = |file, line, column| Some((file, line, column, None));
        let elements = vec![at(0, 1, 1), at(1, 3, 4), at(1, 5, 1), None];
        let files = vec![main.clone(), macros];
        let mut trail = Trail { files, elements, ..Trail::default() };
        let found = |trail: &Trail, main: &Path, column: u32| {
            let at = Position { line: 1, column };
            let found = WrittenMap::new(EXPANDED, trail, main).find([at]).remove(&at)?.place;
            Some((found.file, found.is_main, found.at.to_string(), found.macro_name))
        };
        let column = |part: &str| EXPANDED.find(part).expect("it") as u32 + 1;
        let in_macro = |at: &str, name: Option<&str>| {
            Some(("../parts/m.xacro".to_owned(), false, at.to_owned(), name.map(str::to_owned)))
        };
        let main_place = Some(("a.xacro".to_owned(), true, "1:1".to_owned(), None));
        assert_eq!(found(&trail, &main, 1), main_place);
        assert_eq!(found(&trail, &main, column("<link")), in_macro("3:4", Some("é")));
        // The attribute is on a line of its own there.
        assert_eq!(found(&trail, &main, column("name='la'")), in_macro("4:3", Some("é")));
        assert_eq!(found(&trail, &main, column("name='b'")), in_macro("5:7", None));
        assert_eq!(found(&trail, &main, column("<new")), None);
        // A trail of another text.
        trail.elements.pop();
        assert_eq!(found(&trail, &main, 1), None);
    }
}
