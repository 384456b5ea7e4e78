//! Faults at their places.

use super::super::fault::ImportFault;
use super::super::place::Place;

/// A fault and its place.
#[derive(Debug)]
pub struct At {
    /// Where.
    pub place: Place,
    /// What is wrong.
    pub fault: ImportFault,
}

/// What fails with a place.
pub type Fallible<T> = Result<T, At>;

/// A fault at a place.
pub fn at(place: Place, fault: impl Into<ImportFault>) -> At {
    At { place, fault: fault.into() }
}
