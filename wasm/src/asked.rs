//! The content of files that the host named, which it is asked for when a description needs them.

use std::io;
use std::sync::Arc;

use urdd_source::Lender;

#[cfg(target_arch = "wasm32")]
#[link(wasm_import_module = "urdd")]
unsafe extern "C" {
    /// The content of a file by its path: an answer of `answer::bytes_or_error`; null if the host has none.
    fn read(path: *const u8, length: usize) -> *mut u8;
}

/// A file that the host has.
#[derive(Debug)]
pub struct Asked {
    path: String,
    size: u64,
}

impl Asked {
    /// The file of this path, which has so many bytes.
    pub fn of(path: &str, size: u64) -> Self {
        Asked { path: path.to_owned(), size }
    }
}

impl Lender for Asked {
    fn size(&self) -> u64 {
        self.size
    }

    fn bytes(&self) -> io::Result<Arc<[u8]>> {
        let given = given(&self.path).ok_or_else(|| io::Error::other("its bytes are not there"))?;
        match given.split_first() {
            Some((1, bytes)) => Ok(Arc::from(bytes)),
            Some((_, error)) => Err(io::Error::other(String::from_utf8_lossy(error))),
            None => Err(io::ErrorKind::UnexpectedEof.into()),
        }
    }
}

#[cfg(target_arch = "wasm32")]
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

#[cfg(not(target_arch = "wasm32"))]
fn given(_: &str) -> Option<Vec<u8>> {
    None
}
