//! Pairs of shapes that need no collision check: MoveIt's allowed collision matrix, for shapes.

use std::ffi::c_char;

use crate::failure::{Failure, Status, run};
use crate::handle::{at, free, handle, make};
use crate::memory::{plain, put, put_all, read_text};
use crate::names::out_of_range;
use crate::proximity::shape_kind;
use crate::robot::Robot;

/// The skips between the shapes of one kind.
pub struct Skips(urdd_robot::Skips);

handle!(Skips, "urdd_skips");

/// A shape: the index of its link, and of the link's piece; 0 for hulls and their bounding volumes.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Place {
    /// The index of the link.
    pub link: usize,
    /// The index of the piece.
    pub piece: usize,
}

plain!(Place);

/// Reads the skips between the shapes of a kind. `kind` is as for `urdd_robot_proximity`.
///
/// Errors: `UNKNOWN_NAME` for the kind; `MISSING_MODULE`, `UNUSABLE`: the skips modules.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_skips(
    handle: *const Robot,
    kind: *const c_char,
    out: *mut *mut Skips,
) -> Status {
    unsafe {
        make(out, || {
            let kind = shape_kind(read_text("kind", kind)?)?;
            Ok(Skips(at(handle)?.robot.skips(kind)?))
        })
    }
}

/// Frees skips. Null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_skips_free(skips: *mut Skips) -> Status {
    unsafe { free(skips) }
}

/// Writes the number of shapes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_skips_len(handle: *const Skips, out: *mut usize) -> Status {
    run(|| unsafe { put("out", out, at(handle)?.0.len()) })
}

/// Writes the link and the piece of each shape.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_skips_places(
    handle: *const Skips,
    places: *mut Place,
    length: usize,
) -> Status {
    run(|| unsafe {
        let known = at(handle)?.0.places();
        let each = known.iter().map(|(link, piece)| Place { link: *link, piece: *piece });
        put_all(("places", places, length), (known.len(), 1), each)
    })
}

/// Writes whether a pair of shapes is skipped, by their indices. A shape with itself is.
///
/// Errors: `OUT_OF_RANGE`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_skips_is_skipped(
    handle: *const Skips,
    i: usize,
    j: usize,
    out: *mut bool,
) -> Status {
    run(|| unsafe {
        let skips = &at(handle)?.0;
        for index in [i, j] {
            if index >= skips.len() {
                return Err::<(), Failure>(out_of_range("shape", index, skips.len()));
            }
        }
        put("out", out, skips.is_skipped(i, j))
    })
}
