//! A recipe: which robots are put together, and how.

use std::path::{Path, PathBuf};

use super::error::{CombineError, RecipeFault};
use super::keys;
use super::nearest::nearest;
use super::toml_file::{FreezeValue, JointFile, PartFile, RecipeFile};
use crate::directory::path::portable;
use crate::directory::position::{LineIndex, Position};
use crate::format::urdf::{JointType, Limit};

/// Longest recipe, bytes.
pub const MAX_RECIPE_BYTES: u64 = 1 << 20;

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
    /// A link of another part: `part/link`, by its name in that part.
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
    /// Reads a recipe from the text of a TOML file in a folder; sources are relative to that.
    ///
    /// # Errors
    /// Where it is no recipe: what, where, and what to do.
    pub fn from_toml(text: &str, shown: &str, folder: &Path) -> Result<Recipe, CombineError> {
        let lines = LineIndex::new(text);
        let refused = |offset: Option<usize>, fault: RecipeFault| CombineError::Recipe {
            file: shown.to_owned(),
            at: offset.map(|offset| lines.position(offset)),
            fault,
        };
        keys::check(text).map_err(|(offset, fault)| refused(offset, fault))?;
        let file: RecipeFile = toml::from_str(text).map_err(|error| {
            let words = error.message().to_owned();
            let start = error.span().map(|span| span.start);
            refused(start, RecipeFault::Toml(words))
        })?;
        let stem = Path::new(shown).file_stem();
        let stem = stem.map_or("robot".into(), |stem| stem.to_string_lossy());
        let reader = Reader { lines: &lines };
        let mut recipe = Recipe {
            shown: shown.to_owned(),
            name: file.name.unwrap_or_else(|| stem.into_owned()),
            base: None,
            parts: Vec::new(),
        };
        if let Some(base) = file.base {
            let link = base.link.as_ref().map(|link| reader.word(link));
            let joint = reader.joint(&base, "world_joint", JointType::Fixed);
            recipe.base = Some(Base {
                link: link.unwrap_or_else(|| Word::new("world")),
                joint: joint.map_err(|(at, fault)| refused(at, fault))?,
            });
        }
        for part in file.part {
            let part = reader.part(part, folder);
            recipe
                .parts
                .push(part.map_err(|(at, fault)| refused(at, fault))?);
        }
        recipe.check()?;
        Ok(recipe)
    }

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
            fault,
        }
    }

    /// The place of a part.
    pub(super) fn part(&self, id: &str) -> Option<usize> {
        self.parts.iter().position(|part| part.id.text == id)
    }

    /// The part and the link that an attachment names, or why there is none such.
    pub(super) fn target<'a>(&self, to: &'a Word) -> Result<(usize, &'a str), CombineError> {
        let Some((id, link)) = to.text.split_once('/') else {
            let fault = RecipeFault::NoPartNamed(to.text.clone());
            return Err(self.refused(to, fault));
        };
        let Some(part) = self.part(id) else {
            let ids = self.parts.iter().map(|part| part.id.text.as_str());
            let fault = RecipeFault::UnknownPart {
                name: id.to_owned(),
                nearest: nearest(ids, id),
            };
            return Err(self.refused(to, fault));
        };
        Ok((part, link))
    }

    /// What can be said before any part is read: names, and who hangs on whom.
    fn check(&self) -> Result<(), CombineError> {
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
            let (next, _) = self.target(&attachment.to)?;
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

/// What is wrong, and at which byte.
type Placed<T> = Result<T, (Option<usize>, RecipeFault)>;

struct Reader<'a> {
    lines: &'a LineIndex<'a>,
}

impl Reader<'_> {
    fn word(&self, spanned: &toml::Spanned<String>) -> Word {
        Word {
            text: spanned.get_ref().clone(),
            at: Some(self.lines.position(spanned.span().start)),
        }
    }

    fn part(&self, spanned: toml::Spanned<PartFile>, folder: &Path) -> Placed<Part> {
        let start = spanned.span().start;
        let file = spanned.into_inner();
        let missing = |key: &'static str| (Some(start), RecipeFault::MissingKey(key));
        let id = self.word(&file.id.ok_or_else(|| missing("id"))?);
        let source = file.source.ok_or_else(|| missing("source"))?;
        let words =
            |list: &[toml::Spanned<String>]| list.iter().map(|word| self.word(word)).collect();
        let mut freeze = Vec::new();
        for (joint, value) in &file.freeze {
            let values = match value {
                FreezeValue::One(value) => vec![*value],
                FreezeValue::Several(values) => values.clone(),
            };
            finite(&values, Some(joint.span().start), "freeze")?;
            freeze.push((self.word(joint), values));
        }
        let attach = match &file.attach {
            None => None,
            Some(attach) => {
                let to = attach.to.as_ref().ok_or_else(|| missing("attach.to"))?;
                let name = format!("{}_attachment", id.text);
                Some(Attachment {
                    to: self.word(to),
                    joint: self.joint(attach, &name, JointType::Fixed)?,
                })
            }
        };
        let skip = file.skip.iter().map(|[a, b]| [self.word(a), self.word(b)]);
        Ok(Part {
            source: folder.join(source.get_ref()),
            prefix: file.prefix.unwrap_or_else(|| format!("{}_", id.text)),
            drop: words(&file.drop),
            freeze,
            attach,
            skip: skip.collect(),
            names: words(&file.names),
            id,
        })
    }

    fn joint(&self, file: &JointFile, name: &str, usual: JointType) -> Placed<JointDescription> {
        let at = file
            .joint
            .as_ref()
            .or(file.to.as_ref())
            .map(|word| word.span().start);
        let joint_type = match &file.joint {
            None => usual,
            Some(word) => {
                let known = JointType::ALL.iter().copied();
                let words: Vec<String> = known.clone().map(word_of).collect();
                let mut found = known.zip(&words).filter(|(_, of)| *of == word.get_ref());
                let fault = || RecipeFault::UnknownJointType {
                    found: word.get_ref().clone(),
                    nearest: nearest(words.iter().map(String::as_str), word.get_ref()),
                };
                found.next().ok_or_else(|| (at, fault()))?.0
            }
        };
        let limit = file.limit.as_ref();
        let numbers = [file.xyz, file.rpy, file.axis]
            .into_iter()
            .flatten()
            .flatten();
        let of_limit = limit.map(|of| [of.lower, of.upper, of.effort, of.velocity]);
        let numbers = numbers.chain(of_limit.into_iter().flatten().flatten());
        finite(&numbers.collect::<Vec<_>>(), at, "attach")?;
        let is_limited = matches!(joint_type, JointType::Revolute | JointType::Prismatic);
        let has_all = limit.is_some_and(|of| of.lower.is_some() && of.upper.is_some());
        if is_limited && !has_all {
            return Err((at, RecipeFault::NoLimit(joint_type)));
        }
        if let Some((lower, upper)) = limit.and_then(|of| of.lower.zip(of.upper))
            && lower > upper
        {
            return Err((at, RecipeFault::CrossedLimit { lower, upper }));
        }
        if file.axis == Some([0.0; 3]) {
            return Err((at, RecipeFault::ZeroAxis));
        }
        Ok(JointDescription {
            name: match &file.name {
                Some(name) => self.word(name),
                None => Word::new(name),
            },
            joint_type,
            xyz: file.xyz.unwrap_or_default(),
            rpy: file.rpy.unwrap_or_default(),
            axis: file.axis,
            limit: limit.map(|of| Limit {
                lower: of.lower,
                upper: of.upper,
                effort: of.effort,
                velocity: of.velocity,
                acceleration: None,
                deceleration: None,
                jerk: None,
            }),
        })
    }
}

/// The word of a joint type, as URDFs and recipes write it.
pub(super) fn word_of(joint_type: JointType) -> String {
    joint_type.as_str().to_ascii_lowercase()
}

fn finite(numbers: &[f64], at: Option<usize>, what: &'static str) -> Placed<()> {
    match numbers.iter().all(|number| number.is_finite()) {
        true => Ok(()),
        false => Err((at, RecipeFault::NotFinite(what))),
    }
}
