//! Findings about the documents of a URDD.

use std::fmt::{Debug, Display};

use super::described::Described;
use urdd_directory::discover::ROOT_METADATA;
use urdd_document::entries::Entry;
use urdd_document::module::Module;
use urdd_findings::finding::Finding;
use urdd_format::registry::ModuleKind;

/// A document that findings are about.
pub trait Document {
    /// The file, and the pointer of a value in that file.
    fn locate(&self, pointer: String) -> (String, String);
}

/// `module.json`.
impl Document for &Module {
    fn locate(&self, pointer: String) -> (String, String) {
        (self.file("module.json"), pointer)
    }
}

/// `module.json` of the module of this kind.
impl Document for ModuleKind {
    fn locate(&self, pointer: String) -> (String, String) {
        (format!("{}/module.json", self.folder()), pointer)
    }
}

/// The file that the robot was read from.
impl Document for &Described<'_> {
    fn locate(&self, pointer: String) -> (String, String) {
        (self.robot_file(), pointer)
    }
}

/// An entry of `modules` in `urdd.json`. Pointers are relative to the entry, without a leading slash.
impl Document for &Entry<'_> {
    fn locate(&self, pointer: String) -> (String, String) {
        (ROOT_METADATA.to_owned(), self.pointer(&pointer))
    }
}

/// A finding about a value of a document.
pub fn finding_in(
    document: impl Document,
    pointer: impl Into<String>,
    message: impl Into<String>,
) -> Finding {
    let (file, pointer) = document.locate(pointer.into());
    Finding::at(file, pointer, message)
}

/// The expected and the actual value of a finding at once, in the forms that rules use.
pub trait Compared: Sized {
    /// Sets both.
    fn values(self, expected: impl ToString, actual: impl ToString) -> Self;

    /// Sets both as literals: texts in quotes, numbers with all digits.
    fn literals(self, expected: impl Debug, actual: impl Debug) -> Self {
        self.values(format!("{expected:?}"), format!("{actual:?}"))
    }

    /// Sets both as numbers of something, such as `links`.
    fn counts(self, expected: impl Display, actual: impl Display, what: &str) -> Self {
        self.values(format!("{expected} {what}"), format!("{actual} {what}"))
    }
}

impl Compared for Finding {
    fn values(self, expected: impl ToString, actual: impl ToString) -> Self {
        self.expected(expected).actual(actual)
    }
}
