//! Kinds of shapes by their names.

use std::str::FromStr;

use serde::Deserialize;
use urdd_robot::ShapeKind;

/// A kind of shapes: `pieces` by default.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "String")]
pub struct Kind(pub ShapeKind);

impl Default for Kind {
    fn default() -> Self {
        Kind(ShapeKind::Pieces)
    }
}

impl TryFrom<String> for Kind {
    type Error = <ShapeKind as FromStr>::Err;

    fn try_from(name: String) -> Result<Self, Self::Error> {
        name.parse().map(Kind)
    }
}
