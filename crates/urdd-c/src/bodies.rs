//! The bodies of a robot's shapes: links, and objects that they carry. Which of them are checked.

use std::ffi::c_char;

use crate::failure::{Failure, Status, Text, run};
use crate::memory::{at, enough, make, put, read_text, values};
use crate::names::nth;
use crate::obstacle::Obstacle;
use crate::proximity::Proximity;

/// Makes shapes in which a link carries an object, whose pose is that in the link's frame. The object is checked against
/// all links that move against it, but those that it ignores: the ones that may touch it. The shapes at `handle` stay as they are.
///
/// In answers, an object has the index of its link in `links`, and one of its own in `bodies`; `pieces` counts its parts.
///
/// Errors: `OUT_OF_RANGE` for a link; `UNKNOWN_NAME` if the object ignores an unknown link; `VALUE` if a link or an
/// attached object has its name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_attach(
    handle: *const Proximity,
    link: usize,
    object: *const Obstacle,
    out: *mut *mut Proximity,
) -> Status {
    unsafe { make(out, || Ok(Proximity::new(at(handle)?.0.attach(link, &at(object)?.0)?))) }
}

/// Makes shapes without some pairs of bodies, which are links or attached objects: MoveIt's allowed collision matrix at run
/// time, such as for two links that are always nearer than a margin. `names` has 2 x `count` names: of the first pair,
/// of the second pair and so on. Obstacles are still checked; the shapes at `handle` stay as they are.
///
/// Errors: `UNKNOWN_NAME`, whose message has the nearest name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_without(
    handle: *const Proximity,
    names: *const *const c_char,
    count: usize,
    out: *mut *mut Proximity,
) -> Status {
    unsafe {
        make(out, || {
            let names = texts(names, count.saturating_mul(2))?;
            Ok(Proximity::new(at(handle)?.0.without(names.as_chunks().0.iter().copied())?))
        })
    }
}

/// As `urdd_proximity_without`, for all that belongs to `count` bodies, among obstacles too. The indices of the other
/// bodies stay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_without_bodies(
    handle: *const Proximity,
    names: *const *const c_char,
    count: usize,
    out: *mut *mut Proximity,
) -> Status {
    unsafe {
        make(out, || {
            let names = texts(names, count)?;
            Ok(Proximity::new(at(handle)?.0.without_bodies(names)?))
        })
    }
}

/// Writes the number of bodies: of links, and of attached objects, in the order in which they were attached.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_num_bodies(
    handle: *const Proximity,
    out: *mut usize,
) -> Status {
    run(|| unsafe { put("out", out, at(handle)?.0.num_bodies()) })
}

/// Writes the index of a body, as in `bodies` of `urdd_pair`.
///
/// Errors: `UNKNOWN_NAME`, whose message has the nearest name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_body(
    handle: *const Proximity,
    name: *const c_char,
    out: *mut usize,
) -> Status {
    run(|| unsafe { put("out", out, at(handle)?.0.body(read_text("name", name)?)?) })
}

/// Writes the name of a body.
///
/// Errors: `OUT_OF_RANGE`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_body_name(
    handle: *const Proximity,
    body: usize,
    out: *mut Text,
) -> Status {
    run(|| unsafe { put("out", out, nth("body", at(handle)?.names(), body)?.text()) })
}

unsafe fn texts<'a>(data: *const *const c_char, count: usize) -> Result<Vec<&'a str>, Failure> {
    unsafe {
        let names = values("names", data, count)?;
        enough("names", count, 128)?;
        names.iter().map(|one| read_text("a name", *one)).collect()
    }
}
