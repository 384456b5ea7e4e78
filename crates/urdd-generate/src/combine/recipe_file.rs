//! Recipes as TOML files, and what is checked of one before any part is read. Recipes are untrusted input: the work is linear in
//! the number of parts, which is limited to the maximum number of links.

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::error::{CombineError, Result, did_you_mean};
use super::recipe::{Attachment, JointLimit, Part, Recipe, Sources, Word, fixed};
use crate::MOST_LINKS;
use urdd_directory::limits::MAX_TOML_BYTES;
use urdd_directory::{position, regular};
use urdd_format::escape;
use urdd_format::urdf::JointType;
use urdd_source::cycles;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(default)]
    name: Word,
    base: Option<BaseTable>,
    #[serde(default)]
    part: Vec<Part>,
}

#[derive(Serialize, Deserialize)]
struct BaseTable(#[serde(with = "Base")] Attachment);

/// As `attach`, but `link` names the link that is added.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Attachment", deny_unknown_fields)]
struct Base {
    #[serde(rename = "link", default)]
    to: Word,
    #[serde(default)]
    name: Word,
    #[serde(default = "fixed")]
    joint: Word,
    #[serde(default)]
    xyz: [f64; 3],
    #[serde(default)]
    rpy: [f64; 3],
    axis: Option<[f64; 3]>,
    limit: Option<JointLimit>,
}

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
            regular::read(file, MAX_TOML_BYTES).map_err(|error| unreadable(error.to_string()))?;
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
        let file: File = toml::from_str(text).map_err(|error| CombineError::Recipe {
            file: shown.to_owned(),
            at: error.span().map(|span| position::position(text, span.start)),
            fault: escape::line(&with_nearest(error.message())).into_owned(),
        })?;
        let mut recipe = Recipe {
            shown: shown.to_owned(),
            text: text.to_owned(),
            name: file.name,
            base: file.base.map(|BaseTable(base)| base),
            parts: file.part,
            sources: Sources::In(folder.to_owned()),
        };
        let stem = Path::new(shown).file_stem();
        recipe.name.or(stem.map_or("robot".into(), |stem| stem.to_string_lossy()));
        if let Some(base) = &mut recipe.base {
            base.to.or("world");
            base.name.or("world_joint");
        }
        for part in &mut recipe.parts {
            let id = &part.id.text;
            part.source = folder.join(&part.source);
            part.prefix.or(format!("{id}_"));
            if let Some(attach) = &mut part.attach {
                attach.name.or(format!("{id}_attachment"));
            }
        }
        recipe.check()?;
        Ok(recipe)
    }

    /// The TOML text of this recipe for a file in `folder`. Sources inside `folder` are written relative to it.
    ///
    /// # Errors
    /// If a source is not UTF-8.
    pub fn to_toml(&self, folder: &Path) -> Result<String, CombineError> {
        let mut file = File {
            name: self.name.clone(),
            base: self.base.clone().map(BaseTable),
            part: self.parts.clone(),
        };
        for part in &mut file.part {
            if let Ok(inside) = part.source.strip_prefix(folder) {
                part.source = inside.to_owned();
            }
        }
        toml::to_string(&file).map_err(|error| self.refused(&self.name, error.to_string()))
    }
}

/// Adds the nearest of the known keys to serde's message about an unknown one, which quotes it and then all of them.
fn with_nearest(message: &str) -> String {
    if !message.starts_with("unknown field") {
        return message.to_owned();
    }
    let mut quoted = message.split('`').skip(1).step_by(2);
    let unknown = quoted.next().unwrap_or_default();
    format!("{message}{}", did_you_mean(quoted, unknown))
}

/// Maximum length of a robot's name in bytes: files are named after it.
const MAX_ROBOT_NAME_BYTES: usize = 200;

/// Maximum length of a prefix in bytes: it is repeated before thousands of names.
const MAX_PREFIX_BYTES: usize = 100;

/// Maximum number of characters of a word that a message shows.
const MAX_SHOWN: usize = 60;

impl Recipe {
    /// Checks the number of parts, their names and their attachments.
    pub(super) fn check(&self) -> Result<()> {
        if self.parts.is_empty() {
            let fault = "there is no part; write one or more tables `[[part]]`, each with `id` and `source`";
            return Err(self.refused(&Word::default(), fault));
        }
        if let Some(part) = self.parts.get(MOST_LINKS) {
            return Err(self.too_many_links(&part.id, self.parts.len()));
        }
        self.check_words()?;
        self.check_ids()?;
        let mut roots = self.parts.iter().filter(|part| part.attach.is_none());
        if let (Some(first), Some(second)) = (roots.next(), roots.next()) {
            let fault = format!(
                "parts `{}` and `{}` are both unattached, but a robot has one root; give one of them `attach`",
                first.id.text, second.id.text
            );
            return Err(self.refused(&second.id, fault));
        }
        self.check_attachments()
    }

    /// The error for more links than a robot may have, or more parts. `found` is their number up to the part at which
    /// reading stopped.
    pub(super) fn too_many_links(&self, part: &Word, found: usize) -> CombineError {
        let fault = format!(
            "a robot has at most {MOST_LINKS} links, and the parts have {found} or more: use fewer parts, or drop links"
        );
        self.refused(part, fault)
    }

    /// Checks that names and prefixes can be written in a URDF, and that numbers are finite.
    fn check_words(&self) -> Result<()> {
        let unlimited = usize::MAX;
        self.check_word("the name", &self.name, MAX_ROBOT_NAME_BYTES)?;
        if let Some(base) = &self.base {
            self.check_word("the link", &base.to, unlimited)?;
            self.check_joint("base", base)?;
        }
        for part in &self.parts {
            if !part.prefix.text.is_empty() {
                self.check_word("the prefix", &part.prefix, MAX_PREFIX_BYTES)?;
            }
            for (joint, position) in &part.freeze {
                if !position.values().iter().all(|value| value.is_finite()) {
                    return Err(self.refused(joint, "a number of `freeze` is not finite"));
                }
            }
            if let Some(attach) = &part.attach {
                self.check_joint("attach", attach)?;
            }
        }
        Ok(())
    }

    fn check_word(&self, what: &str, word: &Word, limit: usize) -> Result<()> {
        let text = &word.text;
        // XML does not allow other control characters, and turns these into spaces.
        let is_unfit = |c: &char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}');
        let why = if text.trim().is_empty() {
            "is only white space; write a name".to_owned()
        } else if let Some(found) = text.chars().find(is_unfit) {
            format!(
                "has the character U+{:04X}, which names in a URDF cannot contain; remove it",
                u32::from(found)
            )
        } else if text.len() > limit {
            format!("has {} bytes; write at most {limit}", text.len())
        } else {
            return Ok(());
        };
        let shown = match text.char_indices().nth(MAX_SHOWN) {
            Some((end, _)) => format!("{}…", &text[..end]),
            None => text.clone(),
        };
        Err(self.refused(word, format!("{what} `{shown}` {why}")))
    }

    fn check_joint(&self, table: &str, joint: &Attachment) -> Result<()> {
        self.check_word("the joint", &joint.name, usize::MAX)?;
        let kind = joint.joint.text.as_str();
        let known: Vec<String> =
            JointType::ALL.iter().map(|kind| kind.as_str().to_ascii_lowercase()).collect();
        let limit = joint.limit.unwrap_or_default();
        let is_limited = matches!(kind, "revolute" | "prismatic");
        let limits = [limit.lower, limit.upper, limit.effort, limit.velocity];
        let triples = [Some(joint.xyz), Some(joint.rpy), joint.axis];
        let mut numbers =
            limits.into_iter().flatten().chain(triples.into_iter().flatten().flatten());
        let fault = if !known.iter().any(|known| known == kind) {
            let nearest = did_you_mean(known.iter().map(String::as_str), kind);
            format!("unknown joint type `{kind}`{nearest}; expected one of: {}", known.join(", "))
        } else if !numbers.all(f64::is_finite) {
            format!("a number of `{table}` is not finite")
        } else if is_limited && limit.lower.and(limit.upper).is_none() {
            format!(
                "a {kind} joint needs limits: `limit = {{ lower = …, upper = …, effort = …, velocity = … }}`"
            )
        } else if let (Some(lower), Some(upper)) = (limit.lower, limit.upper)
            && lower > upper
        {
            format!("the lower limit, {lower}, is above the upper one, {upper}")
        } else if joint.axis == Some([0.0; 3]) {
            "the axis is 0 0 0, which has no direction".to_owned()
        } else {
            return Ok(());
        };
        let word = if joint.joint.at.is_some() { &joint.joint } else { &joint.to };
        Err(self.refused(word, fault))
    }

    fn check_ids(&self) -> Result<()> {
        let mut first_of: HashMap<String, &Word> = HashMap::new();
        for part in &self.parts {
            let id = &part.id;
            let is_of_id = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
            if id.text.is_empty() || !id.text.chars().all(is_of_id) {
                let fault =
                    format!("`{}` is not a valid id; use letters, digits, `_` and `-`", id.text);
                return Err(self.refused(id, fault));
            }
            if let Some(first) = first_of.insert(id.text.to_ascii_lowercase(), id) {
                let at = self.position(first).map_or_else(String::new, |at| format!(":{at}"));
                let fault = format!(
                    "another part has the id `{}`{at}; ids must differ in more than upper and lower case",
                    id.text
                );
                return Err(self.refused(id, fault));
            }
        }
        Ok(())
    }

    /// Checks that each part is attached to the root part, or to one that is.
    fn check_attachments(&self) -> Result<()> {
        let mut holders = Vec::new();
        for part in &self.parts {
            holders.push(match &part.attach {
                Some(attach) => self.target(&attach.to)?.0,
                None => None,
            });
        }
        let Some(ring) = cycles(&holders).into_iter().next() else { return Ok(()) };
        let first = &self.parts[ring[0]];
        let at = first.attach.as_ref().map_or(&first.id, |attach| &attach.to);
        let ids: Vec<&str> = ring.iter().map(|part| self.parts[*part].id.text.as_str()).collect();
        let fault = match ids.as_slice() {
            [id] => {
                format!(
                    "part `{id}` is attached to itself; `attach.to` must name a link of another part"
                )
            }
            ids => format!(
                "parts are attached in a cycle: `{}`; one part must be unattached, or attached to `[base]`",
                ids.join("` to `")
            ),
        };
        Err(self.refused(at, fault))
    }
}
