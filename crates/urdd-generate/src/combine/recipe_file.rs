//! Reads a recipe from its file.

use std::fs;
use std::path::Path;

use super::error::CombineError;
use super::keys;
use super::recipe::{
    Attachment, Base, JointDescription, MAX_RECIPE_BYTES, Part, Recipe, Sources, Word,
};
use super::recipe_fault::{RecipeFault, joint_type_word};
use super::toml_file::{FreezeValue, JointFile, PartFile, RecipeFile};
use urdd_directory::position::LineIndex;
use urdd_directory::regular;
use urdd_format::nearest::nearest;
use urdd_format::urdf::{JointType, Limit};

impl Recipe {
    /// Reads a recipe from its file. Sources are relative to the folder of the file.
    ///
    /// # Errors
    /// Those of [`Recipe::from_toml`], or if the file cannot be read.
    pub fn read(file: &Path) -> Result<Recipe, CombineError> {
        let shown = file.display().to_string();
        let unreadable = |reason: String| CombineError::Unreadable { file: shown.clone(), reason };
        if file.is_dir() || file.extension().is_none_or(|ending| ending != "toml") {
            let words =
                "a recipe is a .toml file; to combine two robots, give both and `--at LINK`";
            return Err(unreadable(words.to_owned()));
        }
        let bytes =
            regular::read(file, MAX_RECIPE_BYTES).map_err(|error| unreadable(error.to_string()))?;
        let text =
            String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8".to_owned()))?;
        let folder = match file.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => fs::canonicalize(folder),
            _ => fs::canonicalize("."),
        };
        let folder = folder.map_err(|error| unreadable(error.to_string()))?;
        Recipe::from_toml(&text, &shown, &folder)
    }

    /// Reads a recipe from the text of a TOML file. Sources are relative to `folder` and must be inside it.
    ///
    /// # Errors
    /// If it is not a valid recipe: what is wrong, where, and what to do.
    pub fn from_toml(text: &str, shown: &str, folder: &Path) -> Result<Recipe, CombineError> {
        let lines = LineIndex::new(text);
        let refused = |offset: Option<usize>, fault: RecipeFault| CombineError::Recipe {
            file: shown.to_owned(),
            at: offset.map(|offset| lines.position(offset)),
            fault: Box::new(fault),
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
            name: match &file.name {
                Some(name) => reader.word(name),
                None => Word::new(stem),
            },
            base: None,
            parts: Vec::new(),
            sources: Sources::In(folder.to_owned()),
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
            recipe.parts.push(part.map_err(|(at, fault)| refused(at, fault))?);
        }
        recipe.check()?;
        Ok(recipe)
    }
}

/// A value, or a fault with its byte offset.
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
            prefix: match &file.prefix {
                Some(prefix) => self.word(prefix),
                None => Word::new(format!("{}_", id.text)),
            },
            drop: words(&file.drop),
            freeze,
            attach,
            skip: skip.collect(),
            names: words(&file.names),
            id,
        })
    }

    fn joint(&self, file: &JointFile, name: &str, usual: JointType) -> Placed<JointDescription> {
        let at = file.joint.as_ref().or(file.to.as_ref()).map(|word| word.span().start);
        let joint_type = match &file.joint {
            None => usual,
            Some(word) => {
                let known = JointType::ALL.iter().copied();
                let words: Vec<String> = known.clone().map(joint_type_word).collect();
                let mut found = known.zip(&words).filter(|(_, of)| *of == word.get_ref());
                let fault = || RecipeFault::UnknownJointType {
                    found: word.get_ref().clone(),
                    nearest: nearest(words.iter().map(String::as_str), word.get_ref()),
                };
                found.next().ok_or_else(|| (at, fault()))?.0
            }
        };
        let limit = file.limit.as_ref();
        let numbers = [file.xyz, file.rpy, file.axis].into_iter().flatten().flatten();
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

fn finite(numbers: &[f64], at: Option<usize>, what: &'static str) -> Placed<()> {
    match numbers.iter().all(|number| number.is_finite()) {
        true => Ok(()),
        false => Err((at, RecipeFault::NotFinite(what))),
    }
}
