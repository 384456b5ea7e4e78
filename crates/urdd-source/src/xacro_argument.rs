//! An argument of a xacro file.

use std::fmt;

use urdd_directory::position::Position;

/// Maximum number of values in a message.
const SHOWN: usize = 6;

/// An argument.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct XacroArgument {
    /// Its name.
    pub name: String,
    /// Its default as it is written.
    pub default: Option<String>,
    /// Values for which the package has files, else those that a launch file lists; or those for which the file defines a
    /// property that is missing.
    pub values: Vec<String>,
    /// Whether a value has to be given: there is no default, the package has no files for it, a property is missing with it,
    /// or xacro does not know it yet.
    pub is_needed: bool,
    /// Where the file itself declares or uses it first.
    pub at: Option<Position>,
}

impl fmt::Display for XacroArgument {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}`", self.name)?;
        if !self.values.is_empty() {
            let more = if self.values.len() > SHOWN { ", …" } else { "" };
            let shown = self.values.iter().take(SHOWN).map(String::as_str);
            write!(f, " ({}{more})", shown.collect::<Vec<_>>().join(", "))?;
        }
        Ok(())
    }
}
