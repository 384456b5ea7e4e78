//! Arguments that are given to xacro, and that no file takes: xacro passes over them without a word.

use std::collections::BTreeSet;
use std::path::Path;

use urdd_directory::position::{LineIndex, Position};
use urdd_format::nearest::nearest;
use urdd_xml::element::name;

use crate::trail::Trail;
use crate::written::SourceFiles;

/// An argument that no file takes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnusedArgument {
    /// Its name.
    pub name: String,
    /// The declared argument that may be meant, and that has no value: the one of the nearest name, or the only one; its file,
    /// as seen from the folder of the one that was expanded, and its place.
    pub nearest: Option<(String, String, Position)>,
}

/// The arguments, each as `name:=value`, that none of the files takes that xacro read: it neither declares nor uses them.
pub(crate) fn unused_arguments<'a>(
    file: &Path,
    trail: &Trail,
    given: impl Iterator<Item = &'a String>,
) -> Vec<UnusedArgument> {
    let given: BTreeSet<&str> = given.filter_map(|word| Some(word.split_once(":=")?.0)).collect();
    // Of a run that noted nothing, nothing is known.
    if given.is_empty() || trail.files.is_empty() {
        return Vec::new();
    }
    let files = SourceFiles::new(trail, file);
    let mut open = given.clone();
    for (_, text) in files.texts() {
        // Of a file that cannot be read, nothing is known.
        let Some(text) = text else { return Vec::new() };
        open.retain(|name| !uses(text, name));
    }
    if open.is_empty() {
        return Vec::new();
    }
    let mut declared = Vec::new();
    for (file, text) in files.texts().filter_map(|(file, text)| Some((file, text?))) {
        let Ok(document) = urdd_xml::parse(text, urdd_xml::Kind::Robot) else { continue };
        let lines = LineIndex::new(text);
        let arguments = document.descendants().filter(|node| name(*node) == "xacro:arg");
        declared.extend(arguments.filter_map(|node| {
            let at = lines.position(node.range().start);
            Some((node.attribute("name")?.to_owned(), file.to_owned(), at))
        }));
    }
    open.retain(|name| declared.iter().all(|(known, ..)| known != name));
    let is_free = |known: &&(String, String, Position)| !given.contains(known.0.as_str());
    let free: Vec<_> = declared.iter().filter(is_free).collect();
    let unused = open.into_iter().map(|name| {
        let like = nearest(free.iter().map(|(known, ..)| known.as_str()), name);
        let nearest = like.and_then(|like| free.iter().find(|(known, ..)| *known == like));
        // The only one without a value is most likely the same, however it is called now.
        let nearest = nearest.or(free.first().filter(|_| free.len() == 1));
        UnusedArgument { name: name.to_owned(), nearest: nearest.map(|known| (*known).clone()) }
    });
    unused.collect()
}

/// Whether a text uses an argument: `$(arg NAME)`, or in what is evaluated as Python.
fn uses(text: &str, name: &str) -> bool {
    let inside = |begin: &str, end: char| {
        let parts = text.split(begin).skip(1);
        parts.map(move |part| part.split_once(end).map_or(part, |(inside, _)| inside)).any(|part| {
            let is_word = |c: char| c.is_alphanumeric() || c == '_';
            part.split(|c| !is_word(c)).any(|word| word == name)
        })
    };
    inside("$(arg ", ')') || inside("$(eval ", '<') || inside(".arg(", ')')
}

#[cfg(test)]
mod tests {
    use super::uses;

    #[test]
    fn an_argument_is_used_in_substitutions_and_in_python_alone() {
        for text in
            ["<a b='$(arg side)'/>", "<a b='$(eval arg(\"side\") + 1)'/>", "${xacro.arg('side')}"]
        {
            assert!(uses(text, "side"), "{text}");
            assert!(!uses(text, "sid"), "{text}");
        }
        assert!(!uses("<xacro:macro name='arm' params='side'/> ${side}", "side"));
    }
}
