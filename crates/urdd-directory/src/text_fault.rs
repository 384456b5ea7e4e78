//! Faults in the text of a JSON or YAML file, independent of its content.

use std::collections::BTreeMap;
use std::fmt;

use super::position::Position;

/// Number of faults of each kind that are kept; further ones are only counted.
pub const KEPT_PER_KIND: usize = 5;

/// The kinds of text fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TextFaultKind {
    /// The file is not JSON.
    Syntax,
    /// The JSON file is not UTF-8.
    NotUtf8,
    /// The JSON file begins with a byte order mark.
    ByteOrderMark,
    /// A JSON object has a duplicate member.
    DuplicateKey,
    /// `NaN`, `Infinity`, or a number too large for a 64-bit float.
    NonFiniteNumber,
    /// The JSON is nested deeper than the limit.
    TooDeep,
    /// The file is not YAML.
    YamlSyntax,
    /// The YAML file is not UTF-8.
    YamlNotUtf8,
    /// The YAML file begins with a byte order mark.
    YamlByteOrderMark,
    /// A node has a tag, such as `!Mesh`.
    YamlTag,
    /// An anchor (`&a`) or an alias (`*a`).
    YamlAnchorOrAlias,
    /// A merge key (`<<`).
    YamlMergeKey,
    /// A YAML mapping has a duplicate key.
    YamlDuplicateKey,
    /// A scalar that YAML 1.1 and YAML 1.2 read differently.
    YamlAmbiguousScalar,
    /// The YAML differs from the JSON.
    YamlDiffers,
    /// The YAML is nested deeper than the limit.
    YamlTooDeep,
    /// The file contains more than one document.
    YamlSeveralDocuments,
    /// A directive, such as `%YAML 1.1`.
    YamlDirective,
    /// A mapping key that is not a string.
    YamlNonStringKey,
}

/// One fault, with its position.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextFault {
    /// What is wrong.
    pub kind: TextFaultKind,
    /// RFC 6901 pointer to the value, if there is one.
    pub pointer: Option<String>,
    /// Position in the file, if there is one.
    pub position: Option<Position>,
    /// What is wrong and how to fix it.
    pub message: String,
    /// The expected content, if it is known.
    pub expected: Option<String>,
    /// The actual content.
    pub found: Option<String>,
}

impl TextFault {
    /// A fault without position and comparison.
    pub fn new(kind: TextFaultKind, message: impl Into<String>) -> Self {
        Self {
            kind,
            pointer: None,
            position: None,
            message: message.into(),
            expected: None,
            found: None,
        }
    }

    /// Sets the expected content.
    #[must_use]
    pub fn expecting(mut self, expected: impl Into<String>) -> Self {
        self.expected = Some(expected.into());
        self
    }

    /// Sets the actual content.
    #[must_use]
    pub fn finding(mut self, found: impl Into<String>) -> Self {
        self.found = Some(found.into());
        self
    }

    /// Sets the position of the fault.
    #[must_use]
    pub fn at(mut self, position: Position) -> Self {
        self.position = Some(position);
        self
    }

    /// Sets the pointer of the fault.
    #[must_use]
    pub fn of(mut self, pointer: String) -> Self {
        self.pointer = Some(pointer);
        self
    }
}

impl fmt::Display for TextFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(position) = self.position {
            write!(f, "{position}: ")?;
        }
        f.write_str(&self.message)
    }
}

/// The faults of one file: the first few of each kind, and the total of each kind.
///
/// A generated file may repeat a mistake a hundred thousand times; a few examples and a count say the same.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TextFaults {
    kept: Vec<TextFault>,
    totals: BTreeMap<TextFaultKind, usize>,
}

impl TextFaults {
    /// Counts a fault of `kind`. Calls `fault` only for the first few of each kind.
    pub fn add(&mut self, kind: TextFaultKind, fault: impl FnOnce() -> TextFault) {
        let total = self.totals.entry(kind).or_insert(0);
        *total += 1;
        if *total <= KEPT_PER_KIND {
            let fault = fault();
            debug_assert_eq!(fault.kind, kind);
            self.kept.push(fault);
        }
    }

    /// Counts an existing fault.
    pub fn push(&mut self, fault: TextFault) {
        self.add(fault.kind, || fault);
    }

    /// Whether there are no faults.
    pub fn is_empty(&self) -> bool {
        self.totals.is_empty()
    }

    /// Total number of faults of this kind, kept or not.
    pub fn total(&self, kind: TextFaultKind) -> usize {
        self.totals.get(&kind).copied().unwrap_or(0)
    }

    /// Every kind that occurred, with its total.
    pub fn totals(&self) -> impl Iterator<Item = (TextFaultKind, usize)> + '_ {
        self.totals.iter().map(|(&kind, &total)| (kind, total))
    }

    /// The kept faults, in the order in which they were found.
    pub fn iter(&self) -> std::slice::Iter<'_, TextFault> {
        self.kept.iter()
    }
}

impl<'a> IntoIterator for &'a TextFaults {
    type Item = &'a TextFault;
    type IntoIter = std::slice::Iter<'a, TextFault>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl fmt::Display for TextFaults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all: usize = self.totals.values().sum();
        match self.kept.first() {
            None => f.write_str("no fault"),
            Some(first) if all == 1 => write!(f, "{first}"),
            Some(first) => write!(f, "{first} (and {} more)", all - 1),
        }
    }
}

/// The text has no usable value; the faults say why.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{faults}")]
pub struct UnreadableText {
    /// The faults; never empty.
    pub faults: TextFaults,
}
