//! The map of an expansion: from places in the text that xacro made to those in the files that a person wrote.

use std::collections::HashMap;
use std::ops::Range;
use std::path::Path;

use urdd_directory::position::{LineIndex, Position};
use urdd_directory::regular;
use urdd_xml::Node;
use urdd_xml::element::name;

use crate::fault::{Fault, PlacedFault};
use crate::files::MAX_SOURCE_BYTES;
use crate::note::SourcePlace;
use crate::xacro::Trail;

/// What a place of an expansion was made from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The file, as seen from the folder of the one that was expanded, with forward slashes.
    pub file: String,
    /// Whether it is the one that was expanded.
    pub is_main: bool,
    /// The place in it.
    pub at: Position,
    /// The macro that holds it.
    pub macro_name: Option<String>,
}

impl Written {
    /// The name of its file, where the one that was expanded is called `main`.
    pub fn named(&self, main: &str) -> String {
        match self.is_main {
            true => main.to_owned(),
            false => Path::new(main).with_file_name(&self.file).to_string_lossy().into_owned(),
        }
    }
}

/// A map of places.
pub struct WrittenMap<'a> {
    trail: &'a Trail,
    expanded: Marked<'a>,
    /// The files of the trail by their names as [`Written`] has them, whether they are the one that was expanded, and their texts where these could be read.
    files: Vec<(String, bool, Option<String>)>,
}

impl<'a> WrittenMap<'a> {
    /// The map of the text that xacro made of a file, of which the trail tells.
    pub fn new(text: &'a str, trail: &'a Trail, file: &Path) -> Self {
        let expanded = Marked::new(text);
        let is_of_text = expanded.count == trail.elements.len();
        let main = file.canonicalize().unwrap_or_else(|_| file.to_owned());
        let folder = main.parent().unwrap_or(Path::new("")).to_owned();
        let mut left = MAX_SOURCE_BYTES;
        let files = trail.files.iter().take(if is_of_text { usize::MAX } else { 0 }).map(|path| {
            // As Rust spells it.
            let path = &path.canonicalize().unwrap_or_else(|_| path.clone());
            let text = regular::read(path, left).ok();
            left -= text.as_ref().map_or(0, |text| text.len() as u64);
            (
                seen_from(path, &folder),
                *path == main,
                text.and_then(|text| String::from_utf8(text).ok()),
            )
        });
        WrittenMap { trail, files: files.collect(), expanded }
    }

    /// Where each of these places in the expansion is written, as far as that is known: the attribute, or else the element.
    pub fn find(&self, places: impl IntoIterator<Item = Position>) -> HashMap<Position, Written> {
        let lines = LineIndex::new(self.expanded.text);
        let mut by_file: HashMap<usize, Vec<(Position, Position, &str)>> = HashMap::new();
        for place in places {
            let Some((element, attribute)) =
                lines.offset(place).and_then(|offset| self.expanded.at(offset))
            else {
                continue;
            };
            if let Some(Some((file, line, column))) = self.trail.elements.get(element) {
                let at = Position { line: *line, column: *column };
                by_file.entry(*file).or_default().push((place, at, attribute));
            }
        }
        let mut found = HashMap::new();
        for (file, places) in by_file {
            let Some((file, is_main, text)) = self.files.get(file) else { continue };
            let source = text.as_deref().map(|text| (Marked::new(text), LineIndex::new(text)));
            found.extend(places.into_iter().map(|(place, at, attribute)| {
                let (file, is_main) = (file.clone(), *is_main);
                let mut written = Written { file, is_main, at, macro_name: None };
                if let Some((marked, lines)) = &source
                    && let Some(offset) = lines.offset(at)
                {
                    written.at = lines.position(marked.attribute(offset, attribute));
                    written.macro_name = marked.macro_around(offset).map(str::to_owned);
                }
                (place, written)
            }));
        }
        found
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
            Some(written) => SourcePlace {
                file: written.named(self.shown),
                line: written.at.line,
                column: written.at.column,
            },
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
    use crate::xacro::Trail;
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
        let elements = vec![Some((0, 1, 1)), Some((1, 3, 4)), Some((1, 5, 1)), None];
        let mut trail = Trail { files: vec![main.clone(), macros], elements };
        let found = |trail: &Trail, main: &Path, column: u32| {
            let at = Position { line: 1, column };
            let found = WrittenMap::new(EXPANDED, trail, main).find([at]).remove(&at)?;
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
