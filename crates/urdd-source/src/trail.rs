//! Watches xacro: what a module that Python loads in its place notes of a run.

use std::io;
use std::path::PathBuf;
use std::process::Command;

use serde::Deserialize;
use urdd_directory::target_lock::Temporary;
use urdd_directory::{outputs, regular};

use crate::files::MAX_SOURCE_BYTES;

/// The modules, by their paths in a folder that Python looks in first.
const MODULES: [(&str, &str); 4] = [
    ("xacro/__init__.py", include_str!("watch/xacro.py")),
    ("urdd_xacro/__init__.py", ""),
    ("urdd_xacro/documents.py", include_str!("watch/documents.py")),
    ("urdd_xacro/macros.py", include_str!("watch/macros.py")),
];
/// Where they write.
const PLACES: &str = "URDD_XACRO_PLACES";
/// Maximum number of calls of macros around a place: the outermost takes the place of those between.
const MAX_CALLS: usize = 16;

/// The number of a file, a line and a column: where an element begins.
pub(super) type ElementPlace = (usize, u32, u32);

/// A place that a value is from: an element, or more exactly its attribute, and the parameter of which that has the default;
/// both empty in other files than XML.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub(super) struct ValuePlace(pub usize, pub u32, pub u32, pub String, pub String);

impl ValuePlace {
    pub(super) fn element((file, line, column): ElementPlace, attribute: &str) -> Self {
        ValuePlace(file, line, column, attribute.to_owned(), String::new())
    }
}

/// Where an element begins, and the number of the innermost call that it is from.
type Element = (usize, u32, u32, Option<usize>);

/// A call of a macro: where it is, its name, and the number of the call whose macro has it.
type Call = (Option<ElementPlace>, String, Option<usize>);

/// Where xacro has the elements of its output from, in the order of the output.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize)]
#[serde(default)]
pub struct Trail {
    /// The files, with symbolic links resolved.
    pub(super) files: Vec<PathBuf>,
    /// All elements; `None` for one that macros made of nothing.
    pub(super) elements: Vec<Option<Element>>,
    /// All calls of macros, those around others first.
    pub(super) calls: Vec<Call>,
    /// Attributes by the numbers of their elements, with the place outside of the element that their value is from. That of the
    /// attribute `""` is where all of the element's values are from.
    pub(super) values: Vec<(usize, String, ValuePlace)>,
    /// Where xacro failed, and the innermost call there.
    pub(super) fault: Option<(ValuePlace, Option<usize>)>,
}

impl Trail {
    /// A call and those around it, innermost first, with the names of their macros.
    pub(super) fn calls_around(&self, innermost: Option<usize>) -> Vec<(ElementPlace, &str)> {
        let (mut around, mut next) = (Vec::new(), innermost);
        while let Some(number) = next {
            let Some((place, name, outer)) = self.calls.get(number) else { break };
            if let Some(place) = place {
                around.truncate(MAX_CALLS - 1);
                around.push((*place, name.as_str()));
            }
            // A list that says otherwise is not ours.
            next = outer.filter(|outer| *outer < number);
        }
        around
    }
}

/// A run of xacro that is watched.
pub(super) struct Watch(Temporary);

impl Watch {
    pub(super) fn begin() -> io::Result<Self> {
        let folder = Temporary::begin(&std::env::temp_dir(), "xacro")?;
        for (name, text) in MODULES {
            outputs::fresh(&folder.path().join("python").join(name), text.as_bytes())?;
        }
        Ok(Watch(folder))
    }

    fn notes(&self) -> PathBuf {
        self.0.path().join("places.json")
    }

    /// The folder of the modules: the first of those that Python looks in.
    pub(super) fn folder(&self) -> PathBuf {
        self.0.path().join("python")
    }

    /// Says where the modules write.
    pub(super) fn tell(&self, command: &mut Command) {
        command.env(PLACES, self.notes());
    }

    /// What they noted; nothing if they could not.
    pub(super) fn trail(&self) -> Trail {
        let text = regular::read(&self.notes(), MAX_SOURCE_BYTES).ok();
        text.and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default()
    }
}
