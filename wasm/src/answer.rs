//! What is answered.

use serde_json::json;

use crate::memory::urdd_alloc;

/// An answer that holds this text; null where there is no room for it.
pub fn text(text: &str) -> *mut u8 {
    let Ok(length) = u32::try_from(text.len()) else {
        return std::ptr::null_mut();
    };
    let pointer = urdd_alloc(text.len() + 4);
    if !pointer.is_null() {
        // SAFETY: there is room for the length and the text, and nobody else knows of it yet.
        unsafe {
            pointer.copy_from_nonoverlapping(length.to_le_bytes().as_ptr(), 4);
            pointer
                .add(4)
                .copy_from_nonoverlapping(text.as_ptr(), text.len());
        }
    }
    pointer
}

/// An answer, or what was wrong.
pub fn result(result: Result<serde_json::Value, String>) -> *mut u8 {
    match result {
        Ok(value) => text(&value.to_string()),
        Err(error) => text(&json!({ "error": error }).to_string()),
    }
}
