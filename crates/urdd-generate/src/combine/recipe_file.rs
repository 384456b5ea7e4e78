//! Recipes as TOML files.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::error::{CombineError, did_you_mean};
use super::recipe::{Attachment, JointLimit, Part, Recipe, Sources, Word, fixed};
use urdd_directory::limits::MAX_TOML_BYTES;
use urdd_directory::{position, regular};
use urdd_format::escape;

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
