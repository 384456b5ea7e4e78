//! The tables of `NAME.loops.toml`: what closes the loops of a robot whose URDF cannot say it. Imports write it, other formats
//! of loops are read as it, and `urdd generate` makes `loops_module` of it.

#![expect(missing_docs, reason = "docs/loops.md says what they mean")]

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use toml::Spanned;
use urdd_format::loops::LoopKind;
use urdd_format::short::Short;

use crate::export_toml::{Name, text_of};

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct File {
    /// Joints or DOFs that move freely, by name. Without it, which ones do is chosen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub independent: Option<Vec<Name>>,
    #[serde(rename = "loop", skip_serializing_if = "Vec::is_empty")]
    pub loops: Vec<Spanned<LoopTable>>,
    #[serde(rename = "coupling", skip_serializing_if = "Vec::is_empty")]
    pub couplings: Vec<Spanned<CouplingTable>>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoopTable {
    pub name: String,
    #[serde(deserialize_with = "kind")]
    pub kind: LoopKind,
    pub link_a: Name,
    #[serde(default)]
    pub frame_a: FrameTable,
    pub link_b: Name,
    #[serde(default)]
    pub frame_b: FrameTable,
}

/// A frame in its link's frame: position, m, and fixed-axis roll, pitch and yaw, rad.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FrameTable {
    pub xyz: [f64; 3],
    pub rpy: [f64; 3],
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CouplingTable {
    pub name: String,
    #[serde(default)]
    pub constant: f64,
    /// For each DOF, by name, up to four coefficients: of its position, its square, and so on. Names and coefficients that
    /// many couplings have are shared.
    #[serde(deserialize_with = "terms", serialize_with = "write_terms")]
    pub terms: Terms,
}

type Terms = BTreeMap<Spanned<Arc<str>>, Arc<[f64]>>;

impl File {
    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        self.loops.is_empty() && self.couplings.is_empty()
    }

    /// The text of the file.
    ///
    /// # Errors
    /// None are known: each value has a form in TOML.
    pub fn to_text(&self) -> Result<String, toml::ser::Error> {
        text_of(self)
    }
}

/// The kind of loop of this word, in any letter case.
///
/// # Errors
/// Which kinds there are, if it is none.
pub fn kind_of(word: &str) -> Result<LoopKind, String> {
    let mut all = LoopKind::ALL.iter().copied();
    all.find(|kind| kind.as_str().eq_ignore_ascii_case(word.trim())).ok_or_else(|| {
        let known: Vec<&str> = LoopKind::ALL.iter().map(|kind| kind.as_str()).collect();
        let (word, known) = (Short::of(word), known.join(", ").to_lowercase());
        format!("`{word}` is no kind of loop; there are {known}")
    })
}

fn kind<'de, D: Deserializer<'de>>(reader: D) -> Result<LoopKind, D::Error> {
    kind_of(&String::deserialize(reader)?).map_err(serde::de::Error::custom)
}

fn terms<'de, D: Deserializer<'de>>(reader: D) -> Result<Terms, D::Error> {
    let terms = BTreeMap::<Name, Vec<f64>>::deserialize(reader)?.into_iter();
    Ok(terms
        .map(|(name, of)| (Spanned::new(name.span(), name.into_inner().into()), of.into()))
        .collect())
}

fn write_terms<S: Serializer>(terms: &Terms, writer: S) -> Result<S::Ok, S::Error> {
    writer.collect_map(terms.iter().map(|(name, of)| (&**name.get_ref(), &**of)))
}
