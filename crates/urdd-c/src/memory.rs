//! Handles, which the caller holds without knowing what is in them, arrays and texts of the caller's, and what a thread keeps.

use std::cell::RefCell;
use std::collections::HashMap;
use std::ffi::{CStr, c_char};
use std::slice;
use std::sync::{LazyLock, Mutex, PoisonError};

use nalgebra::Isometry3;

use crate::failure::{Failure, Span, Status, run};
use urdd_robot::has_room;

/// Types for which any memory full of zeros is a value.
///
/// # Safety
/// As stated.
pub(crate) unsafe trait Plain: Copy {}

/// Declares that zero bytes are a value of these types: the number 0, false, a null pointer.
macro_rules! plain {
    ($($type:ty),+) => {
        $(
            // SAFETY: stated where the macro is used.
            unsafe impl $crate::memory::Plain for $type {}
        )+
    };
}
pub(crate) use plain;

plain!(f64, bool, usize, u32, u8, *const c_char);

/// Three values of the caller's.
///
/// # Safety
/// `data` is null, or there are 3 values at it.
pub(crate) unsafe fn triple(what: &'static str, data: *const f64) -> Result<[f64; 3], Failure> {
    // SAFETY: guaranteed by the caller.
    let values = unsafe { values(what, data, 3) }?;
    Ok([values[0], values[1], values[2]])
}

/// An array of the caller's that a call reads or writes. What it writes overlaps no other one.
pub(crate) fn array<T>(
    what: &'static str,
    data: *const T,
    length: usize,
    is_written: bool,
) -> Result<(), Failure> {
    let longest = isize::MAX as usize / size_of::<T>().max(1);
    if length > longest {
        let message = format!("`{what}` has {length} values, which is more than any memory");
        return Err(Failure::new(Status::Length, message));
    }
    if length > 0 && data.is_null() {
        return Err(Failure::new(Status::Pointer, format!("`{what}` is null")));
    }
    if length > 0 && !data.is_aligned() {
        let message = format!("`{what}` is not aligned to {} bytes", align_of::<T>());
        return Err(Failure::new(Status::Pointer, message));
    }
    let new = Span { what, address: data.addr(), bytes: length * size_of::<T>(), is_written };
    let Some(other) = new.first_clash() else {
        return Ok(());
    };
    let [a, b] = if other.is_written { [other.what, what] } else { [what, other.what] };
    Err(Failure::new(Status::Pointer, format!("`{a}` and `{b}` overlap")))
}

/// The caller's values.
///
/// # Safety
/// `data` is null, or there are `length` values at it, which nobody changes during the call.
pub(crate) unsafe fn values<'a, T: Plain>(
    what: &'static str,
    data: *const T,
    length: usize,
) -> Result<&'a [T], Failure> {
    array(what, data, length, false)?;
    if length == 0 {
        return Ok(&[]);
    }
    // SAFETY: guaranteed by the caller; it is neither null nor misaligned, nor longer than any memory.
    Ok(unsafe { slice::from_raw_parts(data, length) })
}

/// The caller's room for results, full of zeros.
///
/// # Safety
/// `data` is null, or there is room for `length` values at it, which nobody else uses during the call.
pub(crate) unsafe fn room<'a, T: Plain>(
    what: &'static str,
    data: *mut T,
    length: usize,
) -> Result<&'a mut [T], Failure> {
    array(what, data, length, true)?;
    if length == 0 {
        return Ok(&mut []);
    }
    // SAFETY: guaranteed by the caller; zeros are a value of the type.
    unsafe {
        data.write_bytes(0, length);
        Ok(slice::from_raw_parts_mut(data, length))
    }
}

/// As [`room`], for exactly `count` times `width` results.
///
/// # Safety
/// As for [`room`].
pub(crate) unsafe fn exact_room<'a, T: Plain>(
    what: &'static str,
    data: *mut T,
    length: usize,
    (count, width): (usize, usize),
) -> Result<&'a mut [T], Failure> {
    if count.checked_mul(width) != Some(length) {
        let message = match count {
            1 => format!("`{what}` has room for {length} values: expected {width}"),
            _ => format!("`{what}` has room for {length} values: expected {count} x {width}"),
        };
        return Err(Failure::new(Status::Length, message));
    }
    // SAFETY: guaranteed by the caller.
    unsafe { room(what, data, length) }
}

/// Refuses `count` times `bytes` that there is not memory for, before an allocation that would end the process.
pub(crate) fn enough(what: &'static str, count: usize, bytes: usize) -> Result<(), Failure> {
    // What is small is not tried: a control loop does not allocate.
    const SMALL: usize = 1 << 16;
    let all = count.saturating_mul(bytes);
    match all < SMALL || has_room(all) && Vec::<u8>::new().try_reserve_exact(all).is_ok() {
        true => Ok(()),
        false => {
            let message = format!("not enough memory for `{what}`: {count} values");
            Err(Failure::new(Status::Memory, message))
        }
    }
}

/// Writes one result.
///
/// # Safety
/// `out` is null, or there is room for a value at it.
pub(crate) unsafe fn put<T>(what: &'static str, out: *mut T, value: T) -> Result<(), Failure> {
    array(what, out, 1, true)?;
    // SAFETY: guaranteed by the caller; it is neither null nor misaligned.
    unsafe { out.write(value) };
    Ok(())
}

/// Writes each of some numbers whose pointer is not null.
///
/// # Safety
/// Each pointer is null, or there is room for a number at it.
pub(crate) unsafe fn put_numbers<const N: usize>(
    numbers: [(&'static str, *mut usize, usize); N],
) -> Result<(), Failure> {
    for (what, out, number) in numbers.into_iter().filter(|(_, out, _)| !out.is_null()) {
        // SAFETY: guaranteed by the caller.
        unsafe { put(what, out, number) }?;
    }
    Ok(())
}

/// Writes all results, for which there is exactly room.
///
/// # Safety
/// As for [`room`].
pub(crate) unsafe fn put_all<T: Plain>(
    (what, out, length): (&'static str, *mut T, usize),
    shape: (usize, usize),
    known: impl IntoIterator<Item = T>,
) -> Result<(), Failure> {
    // SAFETY: guaranteed by the caller.
    let out = unsafe { exact_room(what, out, length, shape) }?;
    for (out, value) in out.iter_mut().zip(known) {
        *out = value;
    }
    Ok(())
}

/// Whether there can be a value at a pointer: it is neither null nor misaligned.
pub(crate) fn check<T>(what: &'static str, at: *const T) -> Result<(), Failure> {
    array(what, at, 1, false)
}

/// A text of the caller's.
///
/// # Safety
/// `text` is null or ends with a zero byte.
pub(crate) unsafe fn read_text<'a>(
    what: &'static str,
    text: *const c_char,
) -> Result<&'a str, Failure> {
    check(what, text)?;
    // SAFETY: guaranteed by the caller.
    let bytes = unsafe { CStr::from_ptr(text) };
    enough(what, bytes.count_bytes(), 4)?;
    bytes.to_str().map_err(|_| Failure::new(Status::Utf8, format!("`{what}` is not UTF-8")))
}

thread_local! {
    /// Kept from one call to the next, so that calls on one configuration do not allocate.
    static POSES: RefCell<Vec<Isometry3<f64>>> = const { RefCell::new(Vec::new()) };
}

/// Runs with this thread's poses. A thread that is ending keeps none any more, and starts from nothing.
pub(crate) fn with_poses<T>(act: impl FnOnce(&mut Vec<Isometry3<f64>>) -> T) -> T {
    let mut poses = POSES.try_with(RefCell::take).unwrap_or_default();
    let found = act(&mut poses);
    let _ = POSES.try_with(|kept| kept.replace(poses));
    found
}

/// A type that the caller holds by its address.
pub(crate) trait Handle: Sized {
    /// Its name in the header.
    const NAME: &'static str;
}

/// Makes a type a [`Handle`], with its name.
macro_rules! handle {
    ($type:ty, $name:literal) => {
        impl $crate::memory::Handle for $type {
            const NAME: &'static str = $name;
        }
    };
}
pub(crate) use handle;

/// The type of each open handle by its address. Kept by debug builds alone.
static OPEN: LazyLock<Mutex<HashMap<usize, &'static str>>> = LazyLock::new(Mutex::default);

fn note(address: usize, name: Option<&'static str>) -> Option<&'static str> {
    let mut open = OPEN.lock().unwrap_or_else(PoisonError::into_inner);
    match name {
        Some(name) => open.insert(address, name),
        None => open.remove(&address),
    }
}

fn check_open<T: Handle>(handle: *const T) -> Result<(), Failure> {
    if handle.is_null() {
        let message = format!("the {} is null", T::NAME);
        return Err(Failure::new(Status::Pointer, message));
    }
    if !cfg!(debug_assertions) {
        return Ok(());
    }
    let open = OPEN.lock().unwrap_or_else(PoisonError::into_inner);
    let message = match open.get(&handle.addr()) {
        Some(name) if *name == T::NAME => return Ok(()),
        Some(name) => format!("expected a {}, found a {name}", T::NAME),
        None => format!("the {} is not open: it was freed, or never made", T::NAME),
    };
    Err(Failure::new(Status::Handle, message))
}

/// The value behind a handle.
///
/// # Safety
/// `handle` is null or open, and stays open during the call.
pub(crate) unsafe fn at<'a, T: Handle>(handle: *const T) -> Result<&'a T, Failure> {
    check_open(handle)?;
    // SAFETY: guaranteed by the caller; it is not null.
    Ok(unsafe { &*handle })
}

/// As [`at`], to change it.
///
/// # Safety
/// As there, and nobody else uses it during the call.
pub(crate) unsafe fn at_mut<'a, T: Handle>(handle: *mut T) -> Result<&'a mut T, Failure> {
    check_open(handle.cast_const())?;
    // SAFETY: as above.
    Ok(unsafe { &mut *handle })
}

/// Makes a handle. After an error, `out` is null.
///
/// # Safety
/// `out` is null, or there is room for a pointer at it.
pub(crate) unsafe fn make<T: Handle>(
    out: *mut *mut T,
    act: impl FnOnce() -> Result<T, Failure>,
) -> Status {
    run(|| {
        array("out", out, 1, true)?;
        // SAFETY: guaranteed by the caller; it is neither null nor misaligned.
        unsafe { out.write(std::ptr::null_mut()) };
        let made = Box::into_raw(Box::new(act()?));
        if cfg!(debug_assertions) {
            note(made.addr(), Some(T::NAME));
        }
        // SAFETY: as above.
        unsafe { out.write(made) };
        Ok(())
    })
}

/// Frees a handle. Null is ignored.
///
/// # Safety
/// `handle` is null, or open and not used again.
pub(crate) unsafe fn free<T: Handle>(handle: *mut T) -> Status {
    if handle.is_null() {
        return Status::Ok;
    }
    run(|| {
        check_open(handle)?;
        if cfg!(debug_assertions) {
            note(handle.addr(), None);
        }
        // SAFETY: guaranteed by the caller.
        drop(unsafe { Box::from_raw(handle) });
        Ok(())
    })
}
