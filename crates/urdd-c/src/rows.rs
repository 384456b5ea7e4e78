//! Configurations of the caller's: rows of one value for each DOF.

use crate::failure::{Failure, Status};
use crate::memory::values;

/// Rows of numbers, one after another.
#[derive(Clone, Copy)]
pub(crate) struct Rows<'a> {
    pub values: &'a [f64],
    columns: usize,
}

impl<'a> Rows<'a> {
    /// # Errors
    /// If there are not `expected` columns, or their product with `count` is more than any memory.
    ///
    /// # Safety
    /// As for [`values`], with `count` times `columns` values.
    pub unsafe fn new(
        what: &'static str,
        data: *const f64,
        (count, columns): (usize, usize),
        expected: usize,
    ) -> Result<Self, Failure> {
        if columns != expected {
            let message = format!("`{what}` has {columns} values in a row: expected {expected}");
            return Err(Failure::new(Status::Length, message));
        }
        // The product saturates to what no memory has.
        let length = count.saturating_mul(columns);
        // SAFETY: guaranteed by the caller.
        let values = unsafe { values(what, data, length) }?;
        Ok(Rows { values, columns })
    }

    /// A row.
    pub fn row(&self, k: usize) -> &'a [f64] {
        &self.values[k * self.columns..(k + 1) * self.columns]
    }
}
