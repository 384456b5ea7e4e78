//! Why a description of another format is refused.

use thiserror::Error;
use urdd_directory::account::Overdrawn;
use urdd_source::gate::ImageFault;

use super::mjcf::fault::MjcfFault;
use super::sdf::fault::SdfFault;
use super::unreachable::Unreachable;

/// Why a description of another format is refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
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

impl ImportFault {
    /// Of an image, under the name that the description has for it.
    pub fn of_image(file: &str, why: ImageFault) -> Self {
        match why {
            ImageFault::Unread(why) => Unreachable::unread(file, &why).into(),
            ImageFault::TooMuch(why) => why.into(),
        }
    }
}
