//! A recipe: which robots are put together, and how.

use std::path::{Path, PathBuf};

use super::error::{CombineError, RecipeFault};
use crate::directory::path::portable;
use crate::directory::position::Position;
use crate::format::nearest::nearest;
use crate::format::urdf::{JointType, Limit};

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
    pub name: String,
    /// A link of its own below the first part, and the joint between them.
    pub base: Option<Base>,
    /// The parts, in the order in which they stand in the URDF that is made.
    pub parts: Vec<Part>,
}

/// A robot that becomes a part of another.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// By what name other parts refer to it.
    pub id: Word,
    /// A URDD (a folder or a zip archive), or a URDF or xacro file.
    pub source: PathBuf,
    /// What stands before its names in the robot that is made; empty for nothing.
    pub prefix: String,
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
            prefix,
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
            name,
            base: None,
            parts: vec![part(&first, holder, String::new()), held],
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

    /// What can be said before any part is read: names, and who hangs on whom.
    pub(super) fn check(&self) -> Result<(), CombineError> {
        if self.parts.is_empty() {
            return Err(self.refused(&Word::default(), RecipeFault::NoParts));
        }
        for (idx, part) in self.parts.iter().enumerate() {
            let id = &part.id;
            let is_of_id = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
            if id.text.is_empty() || !id.text.chars().all(is_of_id) {
                return Err(self.refused(id, RecipeFault::BadId(id.text.clone())));
            }
            let mut before = self.parts[..idx].iter();
            if let Some(first) = before.find(|of| of.id.text.eq_ignore_ascii_case(&id.text)) {
                let fault = RecipeFault::IdTwice {
                    id: id.text.clone(),
                    first: first.id.at,
                };
                return Err(self.refused(id, fault));
            }
        }
        let mut roots = self.parts.iter().filter(|part| part.attach.is_none());
        let first = roots.next();
        if let (Some(first), Some(second)) = (first, roots.next()) {
            let fault = RecipeFault::TwoRoots {
                first: first.id.text.clone(),
                second: second.id.text.clone(),
            };
            return Err(self.refused(&second.id, fault));
        }
        for part in &self.parts {
            self.check_attachment(part)?;
        }
        Ok(())
    }

    /// Follows a part to the one that holds all.
    fn check_attachment(&self, part: &Part) -> Result<(), CombineError> {
        let (mut path, mut now) = (vec![part.id.text.as_str()], part);
        while let Some(attachment) = &now.attach {
            let (Some(next), _) = self.target(&attachment.to)? else {
                break;
            };
            now = &self.parts[next];
            if now.id == part.id {
                let fault = match path.len() {
                    1 => RecipeFault::OnItself(part.id.text.clone()),
                    _ => RecipeFault::Ring(path.iter().map(|id| (*id).to_owned()).collect()),
                };
                let attach = part.attach.as_ref().unwrap_or(attachment);
                return Err(self.refused(&attach.to, fault));
            }
            // A ring further on is told of by its own parts.
            if path.contains(&now.id.text.as_str()) {
                break;
            }
            path.push(&now.id.text);
        }
        Ok(())
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

/// The word of a joint type, as URDFs and recipes write it.
pub(super) fn word_of(joint_type: JointType) -> String {
    joint_type.as_str().to_ascii_lowercase()
}
