//! Memory that the host writes to and reads from.

use std::alloc::{Layout, alloc, dealloc};

fn layout(length: usize) -> Option<Layout> {
    Layout::from_size_align(length.max(1), 8).ok()
}

/// Room for so many bytes; null where there is none.
#[unsafe(no_mangle)]
pub extern "C" fn urdd_alloc(length: usize) -> *mut u8 {
    match layout(length) {
        // SAFETY: the layout's size is not 0.
        Some(layout) => unsafe { alloc(layout) },
        None => std::ptr::null_mut(),
    }
}

/// Gives back what [`urdd_alloc`] gave.
///
/// # Safety
/// `pointer` is from [`urdd_alloc`] with the same length, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_free(pointer: *mut u8, length: usize) {
    if let (false, Some(layout)) = (pointer.is_null(), layout(length)) {
        // SAFETY: as the caller promises.
        unsafe { dealloc(pointer, layout) };
    }
}

/// Gives back an answer.
///
/// # Safety
/// `pointer` is an answer, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_free_answer(pointer: *mut u8) {
    // SAFETY: an answer begins with its length, and came from `urdd_alloc` with room for both.
    unsafe {
        let length = u32::from_le_bytes(*pointer.cast::<[u8; 4]>());
        urdd_free(pointer, length as usize + 4);
    }
}

/// What the host wrote.
///
/// # Safety
/// `length` bytes at `pointer` are initialised, and do not change while the slice is used.
pub unsafe fn bytes<'a>(pointer: *const u8, length: usize) -> &'a [u8] {
    match length {
        0 => &[],
        // SAFETY: as the caller promises.
        length => unsafe { std::slice::from_raw_parts(pointer, length) },
    }
}
