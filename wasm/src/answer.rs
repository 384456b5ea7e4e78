//! Encoding of answers.

use serde_json::json;

use crate::memory::urdd_alloc;

/// An answer with these bytes; null if there is not enough memory.
pub fn bytes(bytes: &[u8]) -> *mut u8 {
    let Ok(length) = u32::try_from(bytes.len()) else {
        return std::ptr::null_mut();
    };
    let pointer = urdd_alloc(bytes.len() + 4);
    if !pointer.is_null() {
        // SAFETY: the allocation has space for the length and the bytes, and is not shared yet.
        unsafe {
            pointer.copy_from_nonoverlapping(length.to_le_bytes().as_ptr(), 4);
            pointer.add(4).copy_from_nonoverlapping(bytes.as_ptr(), bytes.len());
        }
    }
    pointer
}

/// An answer with this text.
pub fn text(text: &str) -> *mut u8 {
    bytes(text.as_bytes())
}

/// An answer with a value or an error.
pub fn result(result: Result<serde_json::Value, String>) -> *mut u8 {
    match result {
        Ok(value) => text(&value.to_string()),
        Err(error) => text(&json!({ "error": error }).to_string()),
    }
}

/// An answer with a byte 1 and the bytes, or a byte 0 and the error as text.
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
