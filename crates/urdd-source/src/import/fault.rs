//! Why a description of another format is refused.

use thiserror::Error;

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
    #[error("{0}")]
    File(Unreachable),
    #[error("`{attribute}` of `<{element}>` is `{value}`, which is not {wanted}")]
    Value { element: String, attribute: String, value: String, wanted: &'static str },
    #[error("the files have more than {0} elements in all; a robot has fewer")]
    TooMany(usize),
    #[error(transparent)]
    Mjcf(#[from] MjcfFault),
    #[error(transparent)]
    Sdf(#[from] SdfFault),
}
