//! A fault and its place, on its way to the reader's caller.

use super::fault::ImportFault;
use super::place::Place;

/// A fault, and where it is.
#[derive(Debug)]
pub struct Refusal {
    pub place: Place,
    pub fault: ImportFault,
}

/// What fails with a place.
pub type Fallible<T> = Result<T, Refusal>;

/// A fault at a place.
pub fn at(place: Place, fault: impl Into<ImportFault>) -> Refusal {
    Refusal { place, fault: fault.into() }
}

impl Refusal {
    pub fn at<T>(place: Place, fault: impl Into<ImportFault>) -> Result<T, Self> {
        Err(at(place, fault))
    }
}
