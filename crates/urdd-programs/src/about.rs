//! What a reader says of its program.

use crate::effect::{Effects, Reading};
use crate::file::File;
use crate::unknown::Names;

/// What a reader says of its program.
pub(crate) struct About {
    /// As reports and the table of `tests/figures/programs` name it.
    pub id: &'static str,
    /// As people know it.
    pub name: &'static str,
    /// Its name whatever its version.
    pub family: &'static str,
    /// The version that the reader is held to.
    pub version: &'static str,
    /// Names of settings for it besides `id`, the best first.
    pub settings: &'static [&'static str],
    /// Whether it is asked if nobody says which programs matter.
    pub is_asked: bool,
    /// Which names it takes for those of elements.
    pub names: Names,
    /// Elements and attributes that it never reads: nothing is lost with them.
    pub never: &'static [&'static str],
    pub read: fn(&File, &mut Effects) -> Reading<()>,
}
