//! A recipe: the robots to combine, and how they are attached.

use std::path::{Path, PathBuf};

use super::error::{CombineError, PartFault};
use super::recipe_fault::RecipeFault;
use urdd_directory::path::portable;
use urdd_directory::position::Position;
use urdd_format::nearest::nearest;
use urdd_format::urdf::{JointType, Limit};
use urdd_source::MAX_SOURCE_BYTES;

/// Maximum size of a recipe in bytes.
pub const MAX_RECIPE_BYTES: u64 = 1 << 20;

/// The id with which parts refer to `[base]`: `base/link`.
pub(super) const BASE: &str = "base";

/// A word of a recipe and its position in the file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Word {
    /// The word.
    pub text: String,
    /// Its position; `None` if it is not from a file, such as on the command line.
    pub at: Option<Position>,
}

impl Word {
    /// A word without a position.
    pub fn new(text: impl Into<String>) -> Self {
        Word { text: text.into(), at: None }
    }
}

/// The robots to combine, and how they are attached.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// The name of the recipe in messages: its file, or another origin.
    pub shown: String,
    /// Name of the combined robot.
    pub name: Word,
    /// An additional link below the first part, and the joint between them.
    pub base: Option<Base>,
    /// The parts, in their order in the combined URDF.
    pub parts: Vec<Part>,
    /// The folders in which the sources of its parts may be.
    pub sources: Sources,
}

/// Where the sources of a recipe's parts may be, and whether a xacro file among them may run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Sources {
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
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The id with which other parts refer to it.
    pub id: Word,
    /// A URDD (a folder or a zip archive), or a URDF or xacro file.
    pub source: PathBuf,
    /// The prefix of its names in the combined robot; may be empty.
    pub prefix: Word,
    /// Links to drop, each with all its descendants.
    pub drop: Vec<Word>,
    /// Joints to freeze, each at one value per DOF, rad or m.
    pub freeze: Vec<(Word, Vec<f64>)>,
    /// Where it is attached; `None` for the one root part.
    pub attach: Option<Attachment>,
    /// Pairs of links to skip in collision checks: a link of this part by its own name, a link of another part as
    /// `part/link`.
    pub skip: Vec<[Word; 2]>,
    /// Places of link and joint names in elements that URDF does not define: `element` for its text,
    /// `element@attribute` for an attribute.
    pub names: Vec<Word>,
}

/// Where a part is attached.
#[derive(Debug, Clone, PartialEq)]
pub struct Attachment {
    /// A link of another part as `part/link`, with its name in that part; or the link of `[base]` as `base/link`.
    pub to: Word,
    /// The joint.
    pub joint: JointDescription,
}

/// An additional root link and the joint on it.
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
    /// The joint type.
    pub joint_type: JointType,
    /// Position of the joint frame in the frame of its parent link, metres.
    pub xyz: [f64; 3],
    /// Fixed-axis roll, pitch and yaw of the joint frame in that frame, radians.
    pub rpy: [f64; 3],
    /// The axis in the joint frame; `None` for URDF's default, (1, 0, 0).
    pub axis: Option<[f64; 3]>,
    /// Its limits.
    pub limit: Option<Limit>,
}

impl Part {
    /// The whole of a robot, not attached.
    pub(super) fn new(id: String, source: PathBuf, prefix: String) -> Self {
        Part {
            id: Word::new(id),
            source,
            prefix: Word::new(prefix),
            drop: Vec::new(),
            freeze: Vec::new(),
            attach: None,
            skip: Vec::new(),
            names: Vec::new(),
        }
    }

    /// An error about this part.
    pub(super) fn refused(&self, fault: PartFault) -> CombineError {
        CombineError::Part {
            id: self.id.text.clone(),
            source_path: self.source.display().to_string(),
            fault,
        }
    }
}

impl JointDescription {
    /// A fixed joint.
    pub(super) fn fixed(name: String, xyz: [f64; 3], rpy: [f64; 3]) -> Self {
        JointDescription {
            name: Word::new(name),
            joint_type: JointType::Fixed,
            xyz,
            rpy,
            axis: None,
            limit: None,
        }
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
        [xyz, rpy]: [[f64; 3]; 2],
    ) -> Result<Recipe, CombineError> {
        let first = id_of(holder);
        let mut second = id_of(held);
        if second.eq_ignore_ascii_case(&first) {
            second += "_2";
        }
        let joint = JointDescription::fixed(format!("{second}_attachment"), xyz, rpy);
        let prefix = format!("{second}_");
        let mut held = Part::new(second.clone(), held.to_owned(), prefix);
        held.attach = Some(Attachment { to: Word::new(format!("{first}/{to}")), joint });
        let name = name.map_or_else(|| format!("{first}_{second}"), str::to_owned);
        let recipe = Recipe {
            shown: "command line".to_owned(),
            name: Word::new(name),
            base: None,
            parts: vec![Part::new(first, holder.to_owned(), String::new()), held],
            sources: Sources::Named,
        };
        recipe.check()?;
        Ok(recipe)
    }

    /// An error about a word of the recipe.
    pub(super) fn refused(&self, at: &Word, fault: RecipeFault) -> CombineError {
        CombineError::Recipe { file: self.shown.clone(), at: at.at, fault: Box::new(fault) }
    }

    /// Refuses parts whose total text is longer than a URDF may be.
    pub(super) fn check_length(
        &self,
        part: &Part,
        what: &'static str,
        length: usize,
    ) -> Result<(), CombineError> {
        let limit = MAX_SOURCE_BYTES;
        match length as u64 > limit {
            true => Err(self.refused(&part.id, RecipeFault::TooLong { what, limit })),
            false => Ok(()),
        }
    }

    /// The index of a part.
    pub(super) fn part(&self, id: &str) -> Option<usize> {
        self.parts.iter().position(|part| part.id.text == id)
    }

    /// The part index and the link that an attachment refers to, or an error if they do not exist. The index is `None`
    /// for the base.
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
            let fault = RecipeFault::UnknownPart { name: id.to_owned(), nearest: nearest(ids, id) };
            return Err(self.refused(to, fault));
        };
        Ok((Some(part), link))
    }
}

/// Derives an id from a file name.
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
