//! Text of a file in a message or report: few bytes, however long it is there and however often it is quoted.

use std::borrow::Cow;
use std::fmt;
use std::ops::Deref;

/// Text of a file as a message quotes it: at most 60 characters, and `…` where there are more.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Short(Box<str>);

/// Maximum number of characters of a [`Short`].
const LONGEST: usize = 60;
/// Maximum number of bytes of a [`name`], and of characters where it has more.
const LONGEST_NAME: usize = 250;

impl Short {
    /// Of this text.
    pub fn of(text: &str) -> Self {
        Short(cut(text, LONGEST).into())
    }
}

impl From<&str> for Short {
    fn from(text: &str) -> Self {
        Short::of(text)
    }
}

impl Deref for Short {
    type Target = str;
    fn deref(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.0)
    }
}

impl fmt::Debug for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&*self.0, f)
    }
}

/// A name as reports have it: as it is, up to 250 bytes; of a longer one, its beginning and `…`.
pub fn name(name: &str) -> Cow<'_, str> {
    if name.len() <= LONGEST_NAME { name.into() } else { cut(name, LONGEST_NAME) }
}

/// A text of at most so many characters, and `…` where there are more.
pub fn cut(text: &str, longest: usize) -> Cow<'_, str> {
    match text.char_indices().nth(longest) {
        Some((end, _)) => format!("{}…", &text[..end]).into(),
        None => text.into(),
    }
}
