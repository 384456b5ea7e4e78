//! What is asked of a robot's own pairs and of those with obstacles, once for both handles.

use urdd_robot::{FirstContact, Queries, RobotError};

use crate::failure::{Failure, Status, run};
use crate::handle::{Handle, at};
use crate::memory::{Plain, room};
use crate::rows::{Rows, edge_settings, edges};

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
