//! A recipe: the robots to combine, and how they are attached. It is read from a file as it is declared here.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use toml::Spanned;

use super::error::{CombineError, PartFault, Result, did_you_mean};
use urdd_directory::file_type::stem;
use urdd_directory::path::portable;
use urdd_directory::position::{self, Position};
use urdd_format::escape;
use urdd_source::MAX_SOURCE_BYTES;

/// The id with which parts refer to `[base]`: `base/link`.
pub(super) const BASE: &str = "base";

/// A word of a recipe and its place in the file.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Word {
    pub text: String,
    /// Its byte offset in the file; `None` if it is not from a file, such as on the command line.
    pub at: Option<usize>,
}

impl Word {
    pub fn new(text: impl Into<String>) -> Self {
        Word { text: text.into(), at: None }
    }

    /// Sets a word that the file leaves out.
    pub(super) fn or(&mut self, usual: impl Into<String>) {
        if self.at.is_none() {
            self.text = usual.into();
        }
    }
}

impl<'de> Deserialize<'de> for Word {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = Spanned::<String>::deserialize(deserializer)?;
        Ok(Word { at: Some(word.span().start), text: word.into_inner() })
    }
}

impl Serialize for Word {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.text.serialize(serializer)
    }
}

/// The robots to combine, and how they are attached. It was checked when it was read or made.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// The name of the recipe in messages: its file, or another origin.
    pub(super) shown: String,
    /// The text of its file, in which words have their places; empty without a file.
    pub(super) text: String,
    pub(super) name: Word,
    /// An additional link below the first part, which `to` names, and the joint between them.
    pub(super) base: Option<Attachment>,
    /// The parts, in their order in the combined URDF.
    pub(super) parts: Vec<Part>,
    /// The folders in which the sources of its parts may be.
    pub(super) sources: Sources,
}

/// Where the sources of a recipe's parts may be, and whether a xacro file among them may run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Sources {
    /// The user named each source. They may be anywhere, and xacro files are expanded.
    Named,
    /// A file names the sources. With symbolic links resolved, they must be in this folder or in one of
    /// [`Settings::allowed_folders`]. Xacro files are expanded only with [`XacroSettings::expand_urdf`].
    ///
    /// [`Settings::allowed_folders`]: crate::Settings::allowed_folders
    /// [`XacroSettings::expand_urdf`]: crate::XacroSettings::expand_urdf
    In(PathBuf),
}

/// A robot that becomes a part of another one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Part {
    /// The id with which other parts refer to it.
    pub id: Word,
    /// A URDD (a folder or a zip archive), or a URDF or xacro file.
    pub source: PathBuf,
    /// The prefix of its names in the combined robot; may be empty.
    #[serde(default)]
    pub prefix: Word,
    /// Links to drop, each with all its descendants.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub drop: Vec<Word>,
    /// Joints to freeze, and where.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub freeze: BTreeMap<Word, Frozen>,
    /// Where it is attached; `None` for the one root part.
    pub attach: Option<Attachment>,
    /// Pairs of links to skip in collision checks: a link of this part by its own name, a link of another part as
    /// `part/link`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub skip: Vec<[Word; 2]>,
    /// Places of link and joint names in elements that URDF does not define: `element` for its text,
    /// `element@attribute` for an attribute.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub names: Vec<Word>,
}

/// The position of a frozen joint, rad or m.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "expected a number, or a list with one for each DOF")]
pub(super) enum Frozen {
    One(f64),
    Each(Vec<f64>),
}

impl Frozen {
    pub(super) fn values(&self) -> &[f64] {
        match self {
            Frozen::One(value) => std::slice::from_ref(value),
            Frozen::Each(values) => values,
        }
    }
}

/// What holds a part, and the joint between them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Attachment {
    /// A link of another part as `part/link`, with its name in that part; or the link of `[base]` as `base/link`.
    pub to: Word,
    #[serde(default)]
    pub name: Word,
    /// Type of the joint, as in a URDF.
    #[serde(default = "fixed")]
    pub joint: Word,
    /// Position of the joint frame in the frame of its parent link, metres.
    #[serde(default)]
    pub xyz: [f64; 3],
    /// Fixed-axis roll, pitch and yaw of the joint frame in that frame, radians.
    #[serde(default)]
    pub rpy: [f64; 3],
    /// The axis in the joint frame; `None` for URDF's default, (1, 0, 0).
    pub axis: Option<[f64; 3]>,
    pub limit: Option<JointLimit>,
}

/// URDF's `<limit>`: rad or m, N m or N, and rad/s or m/s.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct JointLimit {
    pub lower: Option<f64>,
    pub upper: Option<f64>,
    pub effort: Option<f64>,
    pub velocity: Option<f64>,
}

/// The joint type without a word for it.
pub(super) fn fixed() -> Word {
    Word::new("fixed")
}

impl Part {
    pub(super) fn new(
        id: String,
        source: PathBuf,
        prefix: String,
        attach: Option<Attachment>,
    ) -> Self {
        Part {
            id: Word::new(id),
            source,
            prefix: Word::new(prefix),
            drop: Vec::new(),
            freeze: BTreeMap::new(),
            attach,
            skip: Vec::new(),
            names: Vec::new(),
        }
    }

    pub(super) fn refused(&self, fault: PartFault) -> CombineError {
        CombineError::Part {
            id: self.id.text.clone(),
            source_path: self.source.display().to_string(),
            fault,
        }
    }
}

impl Attachment {
    pub(super) fn fixed(to: String, name: String, [xyz, rpy]: [[f64; 3]; 2]) -> Self {
        let [to, name] = [to, name].map(Word::new);
        Attachment { to, name, joint: fixed(), xyz, rpy, axis: None, limit: None }
    }
}

impl Recipe {
    /// The usual case: one robot on a link of another. The names of the first one remain unchanged.
    ///
    /// # Errors
    /// If the resulting recipe is invalid.
    pub fn of_two(
        holder: &Path,
        held: &Path,
        name: Option<&str>,
        to: &str,
        pose: [[f64; 3]; 2],
    ) -> Result<Recipe, CombineError> {
        let first = id_of(holder);
        let mut second = id_of(held);
        if second.eq_ignore_ascii_case(&first) {
            second += "_2";
        }
        let joint = format!("{second}_attachment");
        let attach = Attachment::fixed(format!("{first}/{to}"), joint, pose);
        let recipe = Recipe {
            shown: "command line".to_owned(),
            text: String::new(),
            name: Word::new(name.map_or_else(|| format!("{first}_{second}"), str::to_owned)),
            base: None,
            parts: vec![
                Part::new(first, holder.to_owned(), String::new(), None),
                Part::new(second.clone(), held.to_owned(), format!("{second}_"), Some(attach)),
            ],
            sources: Sources::Named,
        };
        recipe.check()?;
        Ok(recipe)
    }

    pub(super) fn position(&self, word: &Word) -> Option<Position> {
        word.at.map(|at| position::position(&self.text, at))
    }

    pub(super) fn refused(&self, word: &Word, fault: impl AsRef<str>) -> CombineError {
        CombineError::Recipe {
            file: self.shown.clone(),
            at: self.position(word),
            fault: escape::line(fault.as_ref()).into_owned(),
        }
    }

    /// Refuses parts whose total text is longer than a URDF may be. `what` is the kind of text.
    pub(super) fn check_length(&self, part: &Part, what: &str, length: usize) -> Result<()> {
        if length as u64 <= MAX_SOURCE_BYTES {
            return Ok(());
        }
        let limit = MAX_SOURCE_BYTES >> 20;
        let fault = format!(
            "{what} of the parts have more than {limit} MiB in total: use fewer parts, or shorter ones"
        );
        Err(self.refused(&part.id, fault))
    }

    /// The index of a part's link or joint, which `what` says; or an error at `word` if the part has none of this name.
    pub(super) fn find(
        &self,
        part: &str,
        what: &str,
        indices: &HashMap<String, usize>,
        name: &str,
        word: &Word,
    ) -> Result<usize> {
        indices.get(name).copied().ok_or_else(|| {
            let mut names: Vec<&str> = indices.keys().map(String::as_str).collect();
            names.sort_unstable_by_key(|name| indices[*name]);
            let nearest = did_you_mean(names.into_iter(), name);
            self.refused(word, format!("part `{part}` has no {what} `{name}`{nearest}"))
        })
    }

    /// The part index and the link that an attachment refers to, or an error if they do not exist. The index is `None`
    /// for the base.
    pub(super) fn target<'a>(&self, to: &'a Word) -> Result<(Option<usize>, &'a str)> {
        let Some((id, link)) = to.text.split_once('/') else {
            let fault = format!("`{}` does not name a part; write `part/link`", to.text);
            return Err(self.refused(to, fault));
        };
        let ids = self.parts.iter().map(|part| part.id.text.as_str());
        let fault = match (ids.clone().position(|part| part == id), &self.base) {
            (Some(part), _) => return Ok((Some(part), link)),
            (None, Some(base)) if id == BASE && link == base.to.text => return Ok((None, link)),
            (None, Some(base)) if id == BASE => {
                format!("part `{BASE}` has no link `{link}`; did you mean `{}`?", base.to.text)
            }
            _ => format!("there is no part `{id}`{}", did_you_mean(ids, id)),
        };
        Err(self.refused(to, fault))
    }
}

fn id_of(path: &Path) -> String {
    let stem = stem(&path.canonicalize().unwrap_or_else(|_| path.to_owned()));
    let id = portable(&stem).replace(|c: char| !c.is_ascii_alphanumeric() && c != '-', "_");
    if id.is_empty() { "part".to_owned() } else { id }
}
