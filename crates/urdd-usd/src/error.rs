//! What is wrong with a layer, and where.

use std::fmt;
use std::sync::Arc;

use thiserror::Error;
use urdd_directory::account::AccountError;

/// Why a stage cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{layer}{place}: {fault}")]
pub struct UsdError {
    /// The layer, by its path.
    pub layer: Arc<str>,
    /// Where in it.
    pub place: Place,
    /// What is wrong.
    pub fault: Fault,
}

/// A place in a layer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// Line and column, from 1.
    Text(u32, u32),
    /// A byte.
    Byte(u64),
    /// A prim or property.
    Path(String),
    /// The layer as a whole.
    Layer,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Text(line, column) => write!(f, ":{line}:{column}"),
            Place::Byte(byte) => write!(f, ", byte {byte}"),
            Place::Path(path) => write!(f, ", <{path}>"),
            Place::Layer => Ok(()),
        }
    }
}

/// What is wrong at a place.
pub type Wrong = (Place, Fault);

/// What is wrong with a layer.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum Fault {
    #[error("not a USD layer: expected `#usda 1.0`, a crate file or a zip archive")]
    Kind,
    #[error("not UTF-8")]
    Encoding,
    #[error("expected {expected}, found {found}")]
    Syntax { expected: &'static str, found: String },
    #[error("the file ends inside of {0}")]
    Unfinished(&'static str),
    #[error("prims are nested more than {0} levels deep")]
    Deep(usize),
    #[error("a prim or property has more than {0} fields")]
    Fields(usize),
    #[error("values are nested more than {0} levels deep")]
    DeepValue(usize),
    #[error(
        "version {0}.{1} of crate files is not read; open and save the file with a current USD"
    )]
    Version(u8, u8),
    #[error("the crate file is damaged: {0}")]
    Damaged(&'static str),
    #[error("not a usdz that can be read: {0}")]
    Zip(String),
    #[error("cannot read `{asset}`: {why}")]
    File { asset: String, why: String },
    #[error("`{0}` is not a file: layers from the network are not read; copy it beside the robot")]
    Network(String),
    #[error("`{0}` is an expression; paths of layers must be said as they are")]
    Expression(String),
    #[error("relocates are not read; flatten the file with usdcat --flatten")]
    Relocates,
    #[error("prim `{path}` is not in `{asset}`")]
    Missing { asset: String, path: String },
    #[error("`{0}` has no default prim, and the reference does not name one")]
    NoDefault(String),
    #[error("references, payloads or inherits go round in a circle at `{0}`")]
    Circle(String),
    #[error("a prim has more than {0} sources: references, payloads, inherits, variants")]
    Sources(usize),
    #[error("sublayers go round in a circle at `{0}`")]
    LayerCircle(String),
    #[error(transparent)]
    TooMuch(#[from] AccountError),
}
