//! A fault and its place, on its way to the reader's caller.

use super::super::fault::ImportFault;
use super::super::place::Place;

/// A fault, and where it is.
#[derive(Debug)]
pub struct Refusal {
    pub place: Place,
    pub fault: ImportFault,
}

impl Refusal {
    pub fn at<T>(place: Place, fault: impl Into<ImportFault>) -> Result<T, Self> {
        Err(Refusal { place, fault: fault.into() })
    }
}
