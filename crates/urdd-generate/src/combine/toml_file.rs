//! The structure of a recipe file in TOML. `keys` rejects unknown keys beforehand.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

#[derive(Deserialize)]
pub(super) struct RecipeFile {
    pub name: Option<Spanned<String>>,
    pub base: Option<JointFile>,
    #[serde(default)]
    pub part: Vec<Spanned<PartFile>>,
}

#[derive(Deserialize)]
pub(super) struct PartFile {
    pub id: Option<Spanned<String>>,
    pub source: Option<Spanned<String>>,
    pub prefix: Option<Spanned<String>>,
    #[serde(default)]
    pub drop: Vec<Spanned<String>>,
    #[serde(default)]
    pub freeze: BTreeMap<Spanned<String>, FreezeValue>,
    pub attach: Option<JointFile>,
    #[serde(default)]
    pub skip: Vec<[Spanned<String>; 2]>,
    #[serde(default)]
    pub names: Vec<Spanned<String>>,
}

/// One number, or one per DOF.
#[derive(Deserialize)]
#[serde(untagged)]
pub(super) enum FreezeValue {
    One(f64),
    Several(Vec<f64>),
}

/// `base` has a `link`, `attach` has a `to`.
#[derive(Deserialize)]
pub(super) struct JointFile {
    pub to: Option<Spanned<String>>,
    pub link: Option<Spanned<String>>,
    pub name: Option<Spanned<String>>,
    pub joint: Option<Spanned<String>>,
    pub xyz: Option<[f64; 3]>,
    pub rpy: Option<[f64; 3]>,
    pub axis: Option<[f64; 3]>,
    pub limit: Option<LimitFile>,
}

#[derive(Deserialize)]
pub(super) struct LimitFile {
    pub lower: Option<f64>,
    pub upper: Option<f64>,
    pub effort: Option<f64>,
    pub velocity: Option<f64>,
}
