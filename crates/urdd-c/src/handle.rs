//! Handles: what the caller holds without knowing what is in it.

use std::collections::HashMap;
use std::sync::{LazyLock, Mutex, PoisonError};

use crate::failure::{Failure, Status, run};
use crate::memory::array;

/// A type that the caller holds by its address.
pub(crate) trait Handle: Sized {
    /// Its name in the header.
    const NAME: &'static str;
}

/// Makes a type a [`Handle`], with its name.
macro_rules! handle {
    ($type:ty, $name:literal) => {
        impl $crate::handle::Handle for $type {
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

fn check<T: Handle>(handle: *const T) -> Result<(), Failure> {
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
    check(handle)?;
    // SAFETY: guaranteed by the caller; it is not null.
    Ok(unsafe { &*handle })
}

/// As [`at`], to change it.
///
/// # Safety
/// As there, and nobody else uses it during the call.
pub(crate) unsafe fn at_mut<'a, T: Handle>(handle: *mut T) -> Result<&'a mut T, Failure> {
    check(handle.cast_const())?;
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
        check(handle)?;
        if cfg!(debug_assertions) {
            note(handle.addr(), None);
        }
        // SAFETY: guaranteed by the caller.
        drop(unsafe { Box::from_raw(handle) });
        Ok(())
    })
}
