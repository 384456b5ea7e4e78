//! STL, binary and as text.

use super::measure::{Measures, Triangle};

/// What is in an STL file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct StlFacts {
    /// The number of triangles that its header says, if it has a binary header.
    pub written: Option<usize>,
    /// The same number, if the file is exactly as long as a binary file of so many triangles.
    pub binary: Option<usize>,
    /// How often `vertex` is there, if it is no binary file and begins with `solid`.
    pub corners: usize,
    /// Whether two corners of a binary file's triangles are one point.
    pub shares_corners: bool,
}

/// The number of triangles in a binary header.
pub(super) fn written_count(head: &[u8]) -> Option<usize> {
    let count = head.get(80..84)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(count)).ok()
}

pub(super) fn read(bytes: &[u8]) -> (StlFacts, Measures) {
    let written = written_count(bytes);
    let body = bytes.get(84..).unwrap_or_default();
    let binary = written.filter(|count| count.checked_mul(50) == Some(body.len()));
    let mut facts = StlFacts { written, binary, ..StlFacts::default() };
    if binary.is_none() && bytes.starts_with(b"solid") {
        facts.corners = corners(bytes);
    }
    // A program that goes by the header alone reads a file that is too long.
    let whole =
        written.filter(|count| count.checked_mul(50).is_some_and(|size| size <= body.len()));
    let body = whole.map_or(&[][..], |count| &body[..count * 50]);
    let triangles: Vec<Triangle> = triangles(body).collect();
    let points = || triangles.iter().flatten().copied();
    let measures = Measures::of(points, || triangles.iter().copied());
    facts.shares_corners = super::measure::has_repeated(points());
    (facts, measures)
}

fn corners(bytes: &[u8]) -> usize {
    const MARK: &[u8] = b"vertex";
    let marks = bytes
        .windows(MARK.len() + 1)
        .filter(|window| window.starts_with(MARK) && window[MARK.len()].is_ascii_whitespace());
    marks.count()
}

fn triangles(body: &[u8]) -> impl Iterator<Item = Triangle> {
    let number = |record: &[u8], at: usize| {
        let bytes = record.get(at..at + 4).and_then(|bytes| bytes.try_into().ok());
        f64::from(f32::from_le_bytes(bytes.unwrap_or_default()))
    };
    body.chunks_exact(50).map(move |record| {
        [12, 24, 36].map(|corner| [0, 4, 8].map(|axis| number(record, corner + axis)))
    })
}
