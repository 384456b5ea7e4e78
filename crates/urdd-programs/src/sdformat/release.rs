//! The releases that are told apart.

use crate::prelude::*;

/// Which libsdformat.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Release {
    /// 12.3.0.
    Twelve,
    /// 14.1 and later. It reads mimics, and what it writes is SDF 1.11, whose names have no `::`. As in 12.7, links and
    /// joints that are merged stay as frames, which need names and a link; and a link without mass that is merged does not
    /// take those below with it.
    Fourteen,
}

impl Release {
    /// A name as it is read.
    pub fn read(self, text: &str) -> &str {
        let text = text.trim_matches(is_space);
        match text {
            _ if self == Release::Fourteen => text,
            _ if text.eq_ignore_ascii_case("true") => "1",
            _ if text.eq_ignore_ascii_case("false") => "0",
            _ => text,
        }
    }

    /// Whether a name is one that SDF keeps for itself.
    pub fn keeps(self, name: &str) -> bool {
        self == Release::Fourteen && name.contains("::")
    }
}
