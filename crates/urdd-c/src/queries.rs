//! Configurations of the caller's, and what is asked of a robot's own pairs and of those with obstacles, once for both handles.

use std::ops::Range;

use crate::failure::{Failure, Status, run};
use crate::memory::{Handle, Plain, at, exact_room, room, values};
use urdd_robot::{EdgeSettings, FirstContact, Queries, RobotError, fill};

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

/// Motions in one block of work.
const EDGES: usize = 4;

/// Configurations of the caller's: where they are, their number, and how many values each has.
type Given = (*const f64, usize, usize);

/// A handle whose pairs can be asked about. The functions have the contract of the interface.
pub(crate) trait Asked: Handle + 'static {
    type Of: Queries<Pair: Into<Self::Pair>>;
    /// What an answer says of a pair.
    type Pair: Plain + Send;
    type Overlap: Plain;

    fn queries(&self) -> &Self::Of;
    fn overlap(pair: Self::Pair, depth: f64, direction: [f64; 3]) -> Self::Overlap;

    unsafe fn rows<'a>(
        handle: *const Self,
        what: &'static str,
        (data, rows, dofs): Given,
    ) -> Result<(&'a Self::Of, Rows<'a>), Failure> {
        unsafe {
            let of = at(handle)?.queries();
            Ok((of, Rows::new(what, data, (rows, dofs), of.num_dofs())?))
        }
    }

    /// Writes one result for each configuration.
    unsafe fn one<T: Plain + Send>(
        handle: *const Self,
        q: Given,
        (what, out): (&'static str, *mut T),
        ask: impl Fn(&Self::Of, &[f64]) -> Result<T, RobotError> + Sync,
    ) -> Status {
        run(|| unsafe {
            let (of, rows) = Self::rows(handle, "configurations", q)?;
            rows.answer((what, out, q.1), 1, |q, out| {
                out[0] = ask(of, q)?;
                Ok(())
            })
        })
    }

    unsafe fn in_collision(handle: *const Self, q: Given, colliding: *mut bool) -> Status {
        unsafe { Self::one(handle, q, ("colliding", colliding), Self::Of::in_collision) }
    }

    unsafe fn is_within(handle: *const Self, q: Given, margin: f64, within: *mut bool) -> Status {
        unsafe { Self::one(handle, q, ("within", within), |of, q| of.is_within(q, margin)) }
    }

    /// Infinite without pairs.
    unsafe fn min_distance(handle: *const Self, q: Given, distances: *mut f64) -> Status {
        let ask = |of: &Self::Of, q: &[f64]| Ok(of.min_distance(q)?.unwrap_or(f64::INFINITY));
        unsafe { Self::one(handle, q, ("distances", distances), ask) }
    }

    unsafe fn distances(
        handle: *const Self,
        q: Given,
        distances: *mut f64,
        length: usize,
    ) -> Status {
        run(|| unsafe {
            let (of, rows) = Self::rows(handle, "configurations", q)?;
            let ask = |q: &[f64], out: &mut [f64]| of.distances_into(q, out);
            rows.answer(("distances", distances, length), of.num_pairs(), ask)
        })
    }

    unsafe fn nearest(
        handle: *const Self,
        q: Given,
        k: usize,
        nearest: *mut Self::Pair,
        found: *mut usize,
    ) -> Status {
        run(|| unsafe {
            let (of, rows) = Self::rows(handle, "configurations", q)?;
            let found = room("found", found, 1)?;
            rows.answer(("nearest", nearest, q.1.saturating_mul(k)), k, |q, out| {
                let mut out = out.iter_mut();
                of.each_nearest(q, k, |pair| {
                    if let Some(out) = out.next() {
                        *out = pair.into();
                    }
                })
            })?;
            found[0] = k.min(of.num_pairs_of_parts());
            Ok(())
        })
    }

    /// NaN where a motion is free. A `resolution` of 0 asks for a proof.
    unsafe fn blocked_edge(
        handle: *const Self,
        ends: [*const f64; 2],
        shape: (usize, usize),
        (margin, resolution): (f64, f64),
        blocked: *mut f64,
    ) -> Status {
        let settings = edge_settings(margin, resolution, false);
        let out = ("blocked", blocked, shape.0);
        run(|| unsafe {
            let of = at(handle)?.queries();
            edges(ends, (shape, of.num_dofs()), out, EDGES, |start, end| {
                Ok([of.blocked_edge(start, end, &settings)?.unwrap_or(f64::NAN)])
            })
        })
    }

    /// As [`Asked::blocked_edge`], with two numbers for each motion.
    unsafe fn first_contact(
        handle: *const Self,
        ends: [*const f64; 2],
        shape: (usize, usize),
        (margin, resolution): (f64, f64),
        (contacts, length): (*mut f64, usize),
    ) -> Status {
        let settings = edge_settings(margin, resolution, false);
        let out = ("contacts", contacts, length);
        run(|| unsafe {
            let of = at(handle)?.queries();
            edges(ends, (shape, of.num_dofs()), out, EDGES, |start, end| {
                let contact = of.first_contact(start, end, &settings)?;
                Ok(contact.map_or([f64::NAN; 2], |contact| [contact.free, contact.blocked]))
            })
        })
    }

    /// As [`Asked::first_contact`], with why a motion cannot go on.
    unsafe fn motions<T: Plain + Send + From<Option<FirstContact>>>(
        handle: *const Self,
        ends: [*const f64; 2],
        shape: (usize, usize),
        (margin, resolution, open_loops): (f64, f64, bool),
        motions: *mut T,
    ) -> Status {
        let settings = edge_settings(margin, resolution, open_loops);
        let out = ("motions", motions, shape.0);
        run(|| unsafe {
            let of = at(handle)?.queries();
            edges(ends, (shape, of.num_dofs()), out, EDGES, |start, end| {
                Ok([of.first_contact(start, end, &settings)?.into()])
            })
        })
    }

    unsafe fn gradients(
        handle: *const Self,
        (configuration, dofs): (*const f64, usize),
        k: usize,
        (nearest, gradients): (*mut Self::Pair, *mut f64),
        found: *mut usize,
    ) -> Status {
        run(|| unsafe {
            let (of, q) = Self::rows(handle, "configuration", (configuration, 1, dofs))?;
            let pairs = room("nearest", nearest, k)?;
            let out = room("gradients", gradients, k.saturating_mul(dofs))?;
            let found = &mut room("found", found, 1)?[0];
            Ok(of.each_gradient(q.row(0), k, |pair, gradient| {
                pairs[*found] = pair.into();
                let out = &mut out[*found * dofs..(*found + 1) * dofs];
                match gradient {
                    Some(gradient) => out.copy_from_slice(gradient),
                    None => out.fill(f64::NAN),
                }
                *found += 1;
            })?)
        })
    }

    unsafe fn penetrations(
        handle: *const Self,
        (configuration, dofs): (*const f64, usize),
        (overlaps, length): (*mut Self::Overlap, usize),
        found: *mut usize,
    ) -> Status {
        run(|| unsafe {
            let (of, q) = Self::rows(handle, "configuration", (configuration, 1, dofs))?;
            let out = room("overlaps", overlaps, length)?;
            let found = &mut room("found", found, 1)?[0];
            let all = of.penetrations(q.row(0))?;
            *found = all.len();
            for (out, one) in out.iter_mut().zip(all) {
                *out = Self::overlap(one.pair.into(), one.depth, one.direction);
            }
            Ok(())
        })
    }
}
