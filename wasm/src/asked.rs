//! The content of files that the host named, which it is asked for when a description needs them.

use std::io;
use std::sync::Arc;

#[cfg(all(target_arch = "wasm32", feature = "lint"))]
#[link(wasm_import_module = "urdd")]
unsafe extern "C" {
    /// The content of a file by its path: an answer of `answer::bytes_or_error`; null if the host has none.
    fn read(path: *const u8, length: usize) -> *mut u8;
}

/// The content of a file that the host named; `None` if it has none.
pub fn bytes(path: &str) -> io::Result<Option<Arc<[u8]>>> {
    let Some(given) = given(path) else { return Ok(None) };
    match given.split_first() {
        Some((1, bytes)) => Ok(Some(bytes.into())),
        Some((_, error)) => Err(io::Error::other(String::from_utf8_lossy(error))),
        None => Err(io::ErrorKind::UnexpectedEof.into()),
    }
}

#[cfg(all(target_arch = "wasm32", feature = "lint"))]
fn given(path: &str) -> Option<Vec<u8>> {
    use crate::memory::{bytes, urdd_free_answer};
    // SAFETY: the host reads the path before it returns. Its answer begins with its length, and is not used again.
    unsafe {
        let answer = read(path.as_ptr(), path.len());
        if answer.is_null() {
            return None;
        }
        let length = u32::from_le_bytes(*answer.cast::<[u8; 4]>());
        let content = bytes(answer.add(4), length as usize).to_vec();
        urdd_free_answer(answer);
        Some(content)
    }
}

#[cfg(not(all(target_arch = "wasm32", feature = "lint")))]
fn given(_: &str) -> Option<Vec<u8>> {
    None
}
