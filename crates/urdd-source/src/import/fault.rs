//! Why a description of another format is refused.

use thiserror::Error;
use urdd_directory::account::Overdrawn;

use super::mjcf::fault::MjcfFault;
use super::sdf::fault::SdfFault;
use super::unreachable::Unreachable;

/// Why a description of another format is refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say it")]
pub enum ImportFault {
    #[error("not well-formed XML: {0}")]
    NotXml(String),
    #[error(transparent)]
    File(#[from] Unreachable),
    #[error("`{attribute}` of `<{element}>` is `{value}`, which is not {wanted}")]
    Value { element: String, attribute: String, value: String, wanted: &'static str },
    #[error(transparent)]
    TooMuch(#[from] Overdrawn),
    #[error(transparent)]
    Mjcf(#[from] MjcfFault),
    #[error(transparent)]
    Sdf(#[from] SdfFault),
}
