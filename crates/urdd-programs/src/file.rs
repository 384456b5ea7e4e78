//! What a reader is asked about, and what it says of its program.

use std::cell::OnceCell;

use urdd_xml::Counted;

use crate::effect::{Effects, Reading};
use crate::mesh::Mesh;
use crate::strict;
use crate::tinyxml::Document;
use crate::tree::{Parsed, Tree};
use crate::unknown::{self, Found, Names};

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
    /// Elements and attributes that it never reads, in words with spaces between them: nothing is lost with them.
    pub never: &'static [&'static str],
    pub read: fn(&File, &mut Effects) -> Reading<()>,
}

/// A URDF, and the mesh files that it names.
pub struct File<'a> {
    /// The file as it is on disk.
    pub(crate) bytes: &'a [u8],
    pub(crate) counted: Counted<'a>,
    /// What tinyxml2 makes of it, for all programs that read by it.
    pub(crate) document: Document<'a>,
    /// What parsers make of it that keep to the standard ([`strict::trees`]), if it is UTF-8.
    pub(crate) strict: Option<Parsed<[Tree<'a>; 2]>>,
    meshes: &'a dyn Fn(&str) -> Mesh,
    unknown: [OnceCell<Vec<Found>>; 3],
}

impl<'a> File<'a> {
    /// A file as it is on disk. `meshes` says what is there of a mesh, by the name that the URDF gives it.
    pub fn new(counted: Counted<'a>, meshes: &'a dyn Fn(&str) -> Mesh) -> Self {
        let (bytes, document) = (counted.bytes(), Document::of(counted));
        let text = std::str::from_utf8(bytes).ok();
        let strict = text.map(|text| strict::trees(text, counted.document()));
        File { bytes, counted, document, strict, meshes, unknown: Default::default() }
    }

    /// What programs ignore that take such names for those of elements.
    pub(crate) fn unknown(&self, names: Names) -> &[Found] {
        let found = &self.unknown[names as usize];
        found.get_or_init(|| unknown::find(&self.document, names))
    }

    pub(crate) fn mesh(&self, name: &str) -> Mesh {
        (self.meshes)(name)
    }
}
