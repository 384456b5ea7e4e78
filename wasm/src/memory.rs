//! Memory shared with the host.

use std::alloc::{Layout, alloc, dealloc};

fn layout(length: usize) -> Option<Layout> {
    Layout::from_size_align(length.max(1), 8).ok()
}

/// Allocates `length` bytes; null on failure.
#[unsafe(no_mangle)]
pub extern "C" fn urdd_alloc(length: usize) -> *mut u8 {
    match layout(length) {
        // SAFETY: the layout's size is not 0.
        Some(layout) => unsafe { alloc(layout) },
        None => std::ptr::null_mut(),
    }
}

/// Frees memory from [`urdd_alloc`].
///
/// # Safety
/// `pointer` is from [`urdd_alloc`] with the same length, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_free(pointer: *mut u8, length: usize) {
    if let (false, Some(layout)) = (pointer.is_null(), layout(length)) {
        // SAFETY: guaranteed by the caller.
        unsafe { dealloc(pointer, layout) };
    }
}

/// Frees an answer.
///
/// # Safety
/// `pointer` is an answer, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_free_answer(pointer: *mut u8) {
    // SAFETY: an answer begins with its length, and was allocated by `urdd_alloc` with space for both.
    unsafe {
        let length = u32::from_le_bytes(*pointer.cast::<[u8; 4]>());
        urdd_free(pointer, length as usize + 4);
    }
}

/// The bytes that the host wrote.
///
/// # Safety
/// `length` bytes at `pointer` are initialised, and do not change while the slice is used.
pub unsafe fn bytes<'a>(pointer: *const u8, length: usize) -> &'a [u8] {
    match length {
        0 => &[],
        // SAFETY: guaranteed by the caller.
        length => unsafe { std::slice::from_raw_parts(pointer, length) },
    }
}

/// The little-endian binary64 numbers that the host wrote.
///
/// # Safety
/// As for [`bytes`], with 8 bytes for each.
#[cfg(feature = "robot")]
pub unsafe fn numbers(pointer: *const u8, count: usize) -> Vec<f64> {
    // SAFETY: guaranteed by the caller.
    let bytes = unsafe { bytes(pointer, 8 * count) };
    bytes.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect()
}
