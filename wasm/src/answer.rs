//! What is answered.

use serde_json::json;

use crate::memory::urdd_alloc;

/// An answer that holds these bytes; null where there is no room for it.
pub fn bytes(bytes: &[u8]) -> *mut u8 {
    let Ok(length) = u32::try_from(bytes.len()) else {
        return std::ptr::null_mut();
    };
    let pointer = urdd_alloc(bytes.len() + 4);
    if !pointer.is_null() {
        // SAFETY: there is room for the length and the bytes, and nobody else knows of it yet.
        unsafe {
            pointer.copy_from_nonoverlapping(length.to_le_bytes().as_ptr(), 4);
            pointer
                .add(4)
                .copy_from_nonoverlapping(bytes.as_ptr(), bytes.len());
        }
    }
    pointer
}

/// An answer that holds this text.
pub fn text(text: &str) -> *mut u8 {
    bytes(text.as_bytes())
}

/// An answer, or what was wrong.
pub fn result(result: Result<serde_json::Value, String>) -> *mut u8 {
    match result {
        Ok(value) => text(&value.to_string()),
        Err(error) => text(&json!({ "error": error }).to_string()),
    }
}

/// Bytes, after a byte 1; or after a byte 0 what was wrong, as text.
pub fn bytes_or_error(result: Result<Vec<u8>, String>) -> *mut u8 {
    let (first, rest) = match result {
        Ok(found) => (1, found),
        Err(error) => (0, error.into_bytes()),
    };
    let mut answer = Vec::with_capacity(rest.len() + 1);
    answer.push(first);
    answer.extend_from_slice(&rest);
    bytes(&answer)
}
