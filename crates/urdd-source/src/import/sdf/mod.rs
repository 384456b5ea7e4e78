//! Reads SDF.

pub mod fault;

use super::model::{Model, Place, TextFile};
use super::options::ImportOptions;
use super::placed::{Placed, placed};
use super::reach::Reach;
use fault::SdfFault;

/// Reads the robot of a description.
///
/// # Errors
/// If it is refused, with the place.
pub fn read(file: TextFile, _reach: &Reach, _options: &ImportOptions) -> Result<Model, Placed> {
    Err(placed(&[file], Place::default(), SdfFault::NoModel))
}
