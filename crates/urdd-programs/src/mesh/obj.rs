//! Wavefront OBJ.

use super::measure::Measures;
use crate::number::{strtod, whole};

/// What is in an OBJ file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ObjFacts {
    /// How many lines `v` with three numbers it has.
    pub vertices: usize,
    /// How many lines `f` it has.
    pub faces: usize,
    /// How many triangles the faces make.
    pub triangles: usize,
    /// Whether a face has an index that is 0, no number, or of no vertex.
    pub has_bad_index: bool,
    /// Whether some corners of faces have a normal, and others none.
    pub lacks_normals: bool,
    /// How many objects and groups have faces.
    pub shapes: usize,
}

/// Reads a file. Its measures are of all vertices, and of the first shape's triangles.
pub(super) fn read(bytes: &[u8]) -> (ObjFacts, Measures) {
    let mut reader = ObjReader::default();
    for line in bytes.split(|byte| matches!(byte, b'\n' | b'\r')) {
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        match words.next() {
            Some(b"v") => reader.vertex(words),
            Some(b"vn") => reader.has_normals = true,
            Some(b"f") => reader.face(words),
            Some(b"o" | b"g") => reader.begins = true,
            _ => {}
        }
    }
    let ObjReader {
        mut facts, vertices, first, highest, corners, with_normals, has_normals, ..
    } = reader;
    facts.lacks_normals = has_normals && with_normals > 0 && with_normals < corners;
    facts.has_bad_index |= highest > vertices.len();
    let triangles = || {
        first.iter().filter_map(|corners| {
            let [a, b, c] = corners.map(|index| vertices.get(index).copied());
            Some([a?, b?, c?])
        })
    };
    let measures = Measures::of(|| vertices.iter().copied(), triangles);
    (facts, measures)
}

#[derive(Default)]
struct ObjReader {
    facts: ObjFacts,
    vertices: Vec<[f64; 3]>,
    /// The triangles of the first shape.
    first: Vec<[usize; 3]>,
    /// Whether the next face is the first of a shape.
    begins: bool,
    /// Whether there are normals.
    has_normals: bool,
    /// How many corners the faces have, and how many of them with a normal.
    corners: usize,
    with_normals: usize,
    /// The highest number of a vertex that a face names, counted from 1.
    highest: usize,
}

impl ObjReader {
    /// A vertex. What is no number is read as far as it is one, and as 0.
    fn vertex<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>) {
        let mut point = [0.0; 3];
        let mut count = 0;
        for (axis, word) in point.iter_mut().zip(words) {
            let read = std::str::from_utf8(word).ok().and_then(strtod);
            *axis = read.map_or(0.0, |(number, _)| number);
            count += usize::from(whole(read).is_some());
        }
        self.vertices.push(point);
        self.facts.vertices += usize::from(count == 3);
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>) {
        self.facts.faces += 1;
        if self.begins || self.facts.shapes == 0 {
            self.facts.shapes += 1;
            self.begins = false;
        }
        let corners: Option<Vec<usize>> = words.map(|word| self.index(word)).collect();
        let Some(corners) = corners else {
            self.facts.has_bad_index = true;
            return;
        };
        self.highest = corners
            .iter()
            .fold(self.highest, |highest, index| highest.max(index.saturating_add(1)));
        self.facts.triangles += corners.len().saturating_sub(2);
        if self.facts.shapes == 1 {
            let sides = corners.windows(2).skip(1);
            self.first.extend(sides.map(|side| [corners[0], side[0], side[1]]));
        }
    }

    /// The vertex that a face names with `1`, `-1`, `1/2` or `1//2`, counted from 0.
    fn index(&mut self, word: &[u8]) -> Option<usize> {
        let mut numbers = word.split(|&byte| byte == b'/');
        let number = numbers.next()?;
        self.corners += 1;
        self.with_normals += usize::from(numbers.nth(1).is_some_and(|normal| !normal.is_empty()));
        let number: i64 = std::str::from_utf8(number).ok()?.parse().ok()?;
        let length = i64::try_from(self.vertices.len()).ok()?;
        let index = if number < 0 { length.checked_add(number)? } else { number.checked_sub(1)? };
        usize::try_from(index).ok()
    }
}
