//! Texts that cross the border.

use std::ffi::c_char;

/// A text in UTF-8: `length` bytes at `data`, and a zero byte after them. A name can contain zero bytes itself.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Text {
    /// Its first byte; never null.
    pub data: *const c_char,
    /// Number of bytes, without the zero byte.
    pub length: usize,
}

/// A text with its zero byte, which a handle or a thread owns.
#[derive(Debug, Clone)]
pub(crate) struct Owned(Box<[u8]>);

impl Owned {
    pub fn new(text: &str) -> Self {
        Owned([text.as_bytes(), b"\0"].concat().into())
    }

    /// The same text for C, alive as long as `self`.
    pub fn text(&self) -> Text {
        Text { data: self.0.as_ptr().cast(), length: self.0.len() - 1 }
    }
}

impl Default for Owned {
    fn default() -> Self {
        Owned::new("")
    }
}

/// A text of the program. `with_zero` ends with a zero byte.
pub(crate) const fn constant(with_zero: &'static str) -> Text {
    Text { data: with_zero.as_ptr().cast(), length: with_zero.len() - 1 }
}
