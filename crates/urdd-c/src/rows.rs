//! Configurations of the caller's: rows of one value for each DOF, and an answer for each row.

use std::ops::Range;

use urdd_robot::{EdgeSettings, RobotError, fill};

use crate::failure::{Failure, Status};
use crate::memory::{Plain, exact_room, values};

/// Configurations in one block of work.
const BLOCK: usize = 32;

/// Rows of numbers, one after another.
#[derive(Clone, Copy)]
pub(crate) struct Rows<'a> {
    pub values: &'a [f64],
    pub count: usize,
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
        Ok(Rows { values, count, columns })
    }

    /// A row.
    pub fn row(&self, k: usize) -> &'a [f64] {
        self.some(k..k + 1)
    }

    /// Some rows.
    pub fn some(&self, rows: Range<usize>) -> &'a [f64] {
        &self.values[rows.start * self.columns..rows.end * self.columns]
    }

    /// The caller's room for `width` results of each row.
    ///
    /// # Safety
    /// As for [`exact_room`].
    pub unsafe fn room<'o, T: Plain>(
        &self,
        (what, out, length): (&'static str, *mut T, usize),
        width: usize,
    ) -> Result<&'o mut [T], Failure> {
        // SAFETY: guaranteed by the caller.
        unsafe { exact_room(what, out, length, (self.count, width)) }
    }

    /// Writes `width` results of each row, as `ask` does for one. A few rows are answered on this thread.
    ///
    /// # Safety
    /// As for [`exact_room`].
    pub unsafe fn answer<T: Plain + Send>(
        &self,
        out: (&'static str, *mut T, usize),
        width: usize,
        ask: impl Fn(&[f64], &mut [T]) -> Result<(), RobotError> + Sync,
    ) -> Result<(), Failure> {
        // SAFETY: guaranteed by the caller.
        let out = unsafe { self.room(out, width) }?;
        let row = |(): &mut (), k: usize, out: &mut [T]| ask(self.row(k), out);
        Ok(fill(out, width, BLOCK, row)?)
    }
}

/// What the caller says of motions: a resolution of 0 is a proof.
pub(crate) fn edge_settings(margin: f64, resolution: f64, open_loops: bool) -> EdgeSettings {
    let resolution = (resolution != 0.0).then_some(resolution);
    EdgeSettings { margin, resolution, open_loops }
}

/// Asks `N` values of each motion, from a row of the starts to the same row of the ends; so many rows to a thread.
pub(crate) unsafe fn edges<T: Plain + Send, const N: usize>(
    [starts, ends]: [*const f64; 2],
    (shape, num_dofs): ((usize, usize), usize),
    out: (&'static str, *mut T, usize),
    block: usize,
    ask: impl Fn(&[f64], &[f64]) -> Result<[T; N], RobotError> + Sync,
) -> Result<(), Failure> {
    // SAFETY: guaranteed by the caller.
    let (from, to, out) = unsafe {
        let from = Rows::new("starts", starts, shape, num_dofs)?;
        let to = Rows::new("ends", ends, shape, num_dofs)?;
        (from, to, from.room(out, N)?)
    };
    Ok(fill(out, N, block, |(): &mut (), k, out| {
        out.copy_from_slice(&ask(from.row(k), to.row(k))?);
        Ok::<(), RobotError>(())
    })?)
}
