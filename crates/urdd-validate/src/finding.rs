//! Findings about the documents of a URDD.

use urdd_directory::discover::ROOT_METADATA;
use urdd_document::entries::Entry;
use urdd_document::module::Module;
use urdd_findings::finding::Finding;

/// A document that findings are about.
pub trait Document {
    /// The file, and the pointer of a value in that file.
    fn locate(&self, pointer: String) -> (String, String);
}

/// `module.json`.
impl Document for Module {
    fn locate(&self, pointer: String) -> (String, String) {
        (self.file("module.json"), pointer)
    }
}

/// An entry of `modules` in `urdd.json`. Pointers are relative to the entry, without a leading slash.
impl Document for Entry<'_> {
    fn locate(&self, pointer: String) -> (String, String) {
        (ROOT_METADATA.to_owned(), self.pointer(&pointer))
    }
}

/// A finding about a value of a document.
pub fn finding_in(
    document: &impl Document,
    pointer: impl Into<String>,
    message: impl Into<String>,
) -> Finding {
    let (file, pointer) = document.locate(pointer.into());
    Finding::at(file, pointer, message)
}
