//! Notes about combined robots.

use std::fmt;

use urdd_format::escape;

/// A note about combined robots. Its text says what was found in a part, and what was done about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// A machine-readable name of its kind, such as `left-alone`.
    pub kind: &'static str,
    /// The part; `None` for the robot as a whole.
    pub part: Option<String>,
    /// The text. Names in it are not escaped.
    pub text: String,
}

impl Note {
    pub(super) fn of_part(kind: &'static str, part: &str, text: String) -> Self {
        Note { kind, part: Some(part.to_owned()), text }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(part) = &self.part {
            write!(f, "part `{}`: ", escape::line(part))?;
        }
        f.write_str(&escape::line(&self.text))
    }
}
