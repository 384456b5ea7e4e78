//! Why a description of another format is refused.

use std::path::PathBuf;

use thiserror::Error;

use super::mjcf::fault::MjcfFault;
use super::sdf::fault::SdfFault;
use super::usd::fault::UsdFault;
use urdd_directory::account::Overdrawn;
use urdd_directory::read_error::ReadError;
use urdd_source::NotFound;
use urdd_source::gate::ImageFault;

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
    #[error(transparent)]
    Usd(#[from] UsdFault),
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

/// Why a file is not read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Unreachable {
    #[error("`{0}` was not found")]
    Missing(String),
    #[error(
        "`{file}` is outside of the folders of the description; `--allow-folder {}` allows its folder", folder.display()
    )]
    Outside { file: String, folder: PathBuf },
    #[error("`{file}` cannot be read: {reason}")]
    Unreadable { file: String, reason: String },
    #[error("`{file}` cannot be read as a mesh: {reason}")]
    NotMesh { file: String, reason: String },
    #[error("`{file}` is not an image")]
    NotImage { file: String },
    #[error("`{file}` has no part `{part}`")]
    NoPart { file: String, part: String },
}

impl Unreachable {
    /// Of a file that was not found, under the name that the description has for it.
    pub fn of(file: &str, why: NotFound) -> Self {
        match why.outside {
            Some(outside) => {
                let folder = outside.parent().unwrap_or(&outside).to_owned();
                Unreachable::Outside { file: file.to_owned(), folder }
            }
            None => Unreachable::Missing(file.to_owned()),
        }
    }

    /// Of a file that was found, and not read.
    pub fn unread(file: &str, why: &ReadError) -> Self {
        Unreachable::Unreadable { file: file.to_owned(), reason: why.to_string() }
    }
}
