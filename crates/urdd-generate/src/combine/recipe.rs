//! A recipe: which robots are put together, and how.

use std::path::{Path, PathBuf};

use super::error::CombineError;
use super::recipe_fault::RecipeFault;
use urdd_directory::path::portable;
use urdd_directory::position::Position;
use urdd_format::nearest::nearest;
use urdd_format::urdf::{JointType, Limit};

/// Longest recipe, bytes.
pub const MAX_RECIPE_BYTES: u64 = 1 << 20;

/// By what name parts hang on `[base]`: `base/link`.
pub(super) const BASE: &str = "base";

/// A word of a recipe, and where it stands in the file; nowhere, where it came from the command line.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Word {
    /// The word.
    pub text: String,
    /// Where it stands.
    pub at: Option<Position>,
}

impl Word {
    /// A word that stands in no file.
    pub fn new(text: impl Into<String>) -> Self {
        Word {
            text: text.into(),
            at: None,
        }
    }
}

/// Which robots are put together, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// Where it stands, for messages; what it came from, where that is no file.
    pub shown: String,
    /// Name of the robot that is made.
    pub name: Word,
    /// A link of its own below the first part, and the joint between them.
    pub base: Option<Base>,
    /// The parts, in the order in which they stand in the URDF that is made.
    pub parts: Vec<Part>,
    /// Where the sources of its parts may be.
    pub sources: Sources,
}

/// Where the sources of a recipe's parts may be, which decides whether a xacro file among them runs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Sources {
    /// The user named each of them: they may be anywhere, and a xacro file is expanded.
    Named,
    /// A file names them: they are in this folder, after links are resolved, or in one of
    /// [`Settings::allowed_folders`]; a xacro file is expanded only with [`XacroSettings::expand_urdf`].
    ///
    /// [`Settings::allowed_folders`]: crate::Settings::allowed_folders
    /// [`XacroSettings::expand_urdf`]: crate::XacroSettings::expand_urdf
    In(PathBuf),
}

/// A robot that becomes a part of another.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// By what name other parts refer to it.
    pub id: Word,
    /// A URDD (a folder or a zip archive), or a URDF or xacro file.
    pub source: PathBuf,
    /// What stands before its names in the robot that is made; empty for nothing.
    pub prefix: Word,
    /// Links that are left out, each with all that hangs on it.
    pub drop: Vec<Word>,
    /// Joints that become fixed, each at a value for each of its DOFs, rad or m.
    pub freeze: Vec<(Word, Vec<f64>)>,
    /// What it hangs on; `None` for the one part that holds the others.
    pub attach: Option<Attachment>,
    /// Pairs of links that collision checks skip: a link of this part by its own name, one of another
    /// part as `part/link`.
    pub skip: Vec<[Word; 2]>,
    /// What names links and joints in elements that URDF does not define: `element` for its text,
    /// `element@attribute` for an attribute.
    pub names: Vec<Word>,
}

/// What a part hangs on.
#[derive(Debug, Clone, PartialEq)]
pub struct Attachment {
    /// A link of another part: `part/link`, by its name in that part; or `base/link`, that of `[base]`.
    pub to: Word,
    /// The joint.
    pub joint: JointDescription,
}

/// A link that carries all parts, and the joint on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Base {
    /// Name of the link.
    pub link: Word,
    /// The joint.
    pub joint: JointDescription,
}

/// A joint between two parts.
#[derive(Debug, Clone, PartialEq)]
pub struct JointDescription {
    /// Its name.
    pub name: Word,
    /// How it moves.
    pub joint_type: JointType,
    /// Position of its frame in the frame of the link that carries it, metres.
    pub xyz: [f64; 3],
    /// Fixed-axis roll, pitch, yaw of its frame in that frame, radians.
    pub rpy: [f64; 3],
    /// Its axis in its frame; `None` for URDF's default, (1, 0, 0).
    pub axis: Option<[f64; 3]>,
    /// Its limits.
    pub limit: Option<Limit>,
}

impl Recipe {
    /// The usual case: one robot on a link of another, whose names stay as they are.
    ///
    /// # Errors
    /// Where the two cannot be told apart.
    pub fn of_two(
        holder: &Path,
        held: &Path,
        name: Option<&str>,
        to: &str,
        [xyz, rpy]: [[f64; 3]; 2],
    ) -> Result<Recipe, CombineError> {
        let first = id_of(holder);
        let mut second = id_of(held);
        if second.eq_ignore_ascii_case(&first) {
            second += "_2";
        }
        let part = |id: &str, source: &Path, prefix: String| Part {
            id: Word::new(id),
            source: source.to_owned(),
            prefix: Word::new(prefix),
            drop: Vec::new(),
            freeze: Vec::new(),
            attach: None,
            skip: Vec::new(),
            names: Vec::new(),
        };
        let mut held = part(&second, held, format!("{second}_"));
        held.attach = Some(Attachment {
            to: Word::new(format!("{first}/{to}")),
            joint: JointDescription {
                name: Word::new(format!("{second}_attachment")),
                joint_type: JointType::Fixed,
                xyz,
                rpy,
                axis: None,
                limit: None,
            },
        });
        let name = name.map_or_else(|| format!("{first}_{second}"), str::to_owned);
        let recipe = Recipe {
            shown: "command line".to_owned(),
            name: Word::new(name),
            base: None,
            parts: vec![part(&first, holder, String::new()), held],
            sources: Sources::Named,
        };
        recipe.check()?;
        Ok(recipe)
    }

    /// An error about a word of the recipe.
    pub(super) fn refused(&self, at: &Word, fault: RecipeFault) -> CombineError {
        CombineError::Recipe {
            file: self.shown.clone(),
            at: at.at,
            fault: Box::new(fault),
        }
    }

    /// The place of a part.
    pub(super) fn part(&self, id: &str) -> Option<usize> {
        self.parts.iter().position(|part| part.id.text == id)
    }

    /// The part and the link that an attachment names, or why there is none such; no part where it is the
    /// base.
    pub(super) fn target<'a>(
        &self,
        to: &'a Word,
    ) -> Result<(Option<usize>, &'a str), CombineError> {
        let Some((id, link)) = to.text.split_once('/') else {
            let fault = RecipeFault::NoPartNamed(to.text.clone());
            return Err(self.refused(to, fault));
        };
        let part = self.part(id);
        if let (None, BASE, Some(base)) = (part, id, &self.base) {
            if link == base.link.text {
                return Ok((None, link));
            }
            let fault = RecipeFault::Unknown {
                what: "link",
                part: BASE.to_owned(),
                name: link.to_owned(),
                nearest: Some(base.link.text.clone()),
            };
            return Err(self.refused(to, fault));
        }
        let Some(part) = part else {
            let ids = self.parts.iter().map(|part| part.id.text.as_str());
            let fault = RecipeFault::UnknownPart {
                name: id.to_owned(),
                nearest: nearest(ids, id),
            };
            return Err(self.refused(to, fault));
        };
        Ok((Some(part), link))
    }
}

/// An id of the name of a file.
fn id_of(path: &Path) -> String {
    let name = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let name = name.file_name().unwrap_or_default().to_string_lossy();
    let mut stem: &str = &name;
    for extension in [".zip", ".xacro", ".xml", ".urdf"] {
        stem = stem.strip_suffix(extension).unwrap_or(stem);
    }
    let id = portable(stem).replace(|c: char| !c.is_ascii_alphanumeric() && c != '-', "_");
    if id.is_empty() { "part".to_owned() } else { id }
}
