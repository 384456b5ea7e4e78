//! COLLADA, OBJ and STL, and measures of their points and triangles.

use std::collections::HashSet;

use urdd_xml::{Kind, Node};

use crate::number::{dot, less, strtod, whole};

/// What is in a COLLADA file that is well-formed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ColladaFacts {
    /// How many triangles its geometries have; polygons are counted as fans.
    pub triangles: usize,
    /// Whether a geometry or a controller has a place.
    pub has_instance: bool,
    /// Whether a scene has a geometry or a controller in it.
    pub has_scene: bool,
    /// Whether it has `<asset>` and `<library_geometries>`.
    pub is_complete: bool,
    /// What its unit is in metres; 1 if it does not say.
    pub meters: f64,
    /// Its axis that is up, such as `Y_UP`; empty if it does not say.
    pub up: String,
    /// The most `<node>` elements around a geometry.
    pub depth: usize,
    /// Whether white space stands before `<?xml`: assimp and tinyxml2 skip it, strict readers refuse the file.
    pub begins_late: bool,
    /// Whether more is behind its root, elements or what follows a NUL: assimp and tinyxml2 skip it.
    pub has_more: bool,
    /// Whether text is there: assimp alone skips it.
    pub has_text: bool,
}

pub fn collada(bytes: &[u8]) -> Option<ColladaFacts> {
    std::str::from_utf8(bytes).ok().and_then(well_formed).or_else(|| with_more(bytes))
}

/// A file with more behind its root, up to a NUL: what is there is well-formed itself.
fn with_more(bytes: &[u8]) -> Option<ColladaFacts> {
    const END: &[u8] = b"</COLLADA>";
    let bytes = bytes.split(|byte| *byte == 0).next().unwrap_or_default();
    let end = bytes.windows(END.len()).position(|window| window == END)? + END.len();
    let rest = format!("<r>{}</r>", String::from_utf8_lossy(&bytes[end..]));
    let rest = urdd_xml::parse(&rest, Kind::Lenient).ok()?;
    let mut texts = rest.root_element().children().filter_map(|node| node.text());
    let has_text = texts.any(|text| !text.trim().is_empty());
    let facts = well_formed(std::str::from_utf8(&bytes[..end]).ok()?)?;
    Some(ColladaFacts { has_more: true, has_text, ..facts })
}

fn well_formed(text: &str) -> Option<ColladaFacts> {
    let text = text.trim_start_matches('\u{feff}');
    let begins_late = text.trim_start().starts_with("<?xml ") && !text.starts_with('<');
    let text = if begins_late { text.trim_start() } else { text };
    let document = urdd_xml::parse(text, Kind::Lenient).ok()?;
    let root = document.root_element();
    let child = |name| root.children().find(|node| node.has_tag_name(name_of(root, name)));
    let asset = child("asset");
    let of_asset = |name| asset?.children().find(|node| node.has_tag_name(name_of(root, name)));
    let unit = of_asset("unit").and_then(|unit| unit.attribute("meter")?.trim().parse().ok());
    let up = of_asset("up_axis").and_then(|up| up.text()).map(|up| up.trim().to_owned());
    let mut facts = ColladaFacts {
        is_complete: asset.is_some() && child("library_geometries").is_some(),
        meters: unit.unwrap_or(1.0),
        up: up.unwrap_or_default(),
        begins_late,
        ..ColladaFacts::default()
    };
    let mut open = vec![(root, 0)];
    while let Some((node, depth)) = open.pop() {
        match node.tag_name().name() {
            "triangles" | "polylist" | "polygons" | "tristrips" | "trifans" => {
                facts.triangles = facts.triangles.saturating_add(triangles_of(node));
                continue;
            }
            "instance_geometry" | "instance_controller" => {
                facts.has_instance = true;
                facts.depth = facts.depth.max(depth);
            }
            _ => {}
        }
        let depth = depth + usize::from(node.tag_name().name() == "node");
        open.extend(node.children().filter(Node::is_element).map(|child| (child, depth)));
    }
    facts.has_scene =
        facts.has_instance && child("scene").is_some_and(|scene| scene.has_children());
    Some(facts)
}

fn name_of<'a>(root: Node<'a, '_>, name: &'a str) -> (&'a str, &'a str) {
    (root.tag_name().namespace().unwrap_or_default(), name)
}

/// The triangles of a primitive.
fn triangles_of(primitive: Node<'_, '_>) -> usize {
    let texts = |name: &'static str| {
        let children = primitive.children().filter(move |child| child.tag_name().name() == name);
        children.map(|child| child.text().unwrap_or_default())
    };
    let count = primitive.attribute("count").and_then(|count| count.trim().parse().ok());
    match primitive.tag_name().name() {
        "triangles" => {
            let is_empty = texts("p").all(|text| text.trim().is_empty());
            if is_empty { 0 } else { count.unwrap_or(0) }
        }
        "polylist" => {
            let counts = texts("vcount").flat_map(str::split_ascii_whitespace);
            counts
                .map(|count| count.parse().unwrap_or(0_usize).saturating_sub(2))
                .fold(0, usize::saturating_add)
        }
        _ => texts("p").filter(|text| !text.trim().is_empty()).count(),
    }
}

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
pub fn obj(bytes: &[u8]) -> (ObjFacts, Measures) {
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
pub fn written_count(head: &[u8]) -> Option<usize> {
    let count = head.get(80..84)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(count)).ok()
}

pub fn stl(bytes: &[u8]) -> (StlFacts, Measures) {
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
    facts.shares_corners = has_repeated(points());
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

pub type Triangle = [[f64; 3]; 3];

/// Measures of a mesh, in its own units. All are 0 without points.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Measures {
    /// How many different points there are, up to 4.
    pub points: usize,
    /// Whether a coordinate is not finite.
    pub has_infinite: bool,
    /// The largest coordinate, without its sign.
    pub largest: f64,
    /// How far a point is from the first one at most, from the line of these two, and from the plane of these three; the
    /// latter in coordinates of single precision.
    pub spread: [f64; 3],
    /// The size of its box along each axis.
    pub size: [f64; 3],
    /// The sum of the volumes, each without its sign, between triangles and the mean of their centres; in coordinates of
    /// single precision.
    pub volume: f64,
}

impl Measures {
    /// Measures points and triangles, which are gone through several times.
    pub fn of<P, T>(points: impl Fn() -> P, triangles: impl Fn() -> T) -> Measures
    where
        P: Iterator<Item = [f64; 3]>,
        T: Iterator<Item = Triangle>,
    {
        let mut measures = Measures::default();
        let Some(first) = points().next() else { return measures };
        let (mut low, mut high) = (first, first);
        let mut distinct: Vec<[f64; 3]> = Vec::new();
        for point in points() {
            for axis in 0..3 {
                measures.has_infinite |= !point[axis].is_finite();
                measures.largest = measures.largest.max(point[axis].abs());
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
            if distinct.len() < 4 && !distinct.contains(&point) {
                distinct.push(point);
            }
        }
        measures.points = distinct.len();
        measures.size = less(high, low);
        measures.spread = spread(&points, first);
        measures.volume = volume(|| triangles().map(|corners| corners.map(single)));
        measures
    }
}

fn spread<P: Iterator<Item = [f64; 3]>>(points: impl Fn() -> P, first: [f64; 3]) -> [f64; 3] {
    let flat = single(first);
    let (from_point, second) = farthest(points(), first, |point| length(less(point, first)));
    let line = unit(less(second, first));
    let off_line = |point| length(cross(less(point, first), line));
    let (from_line, third) = farthest(points(), first, off_line);
    let sides = [second, third].map(|point| less(single(point), flat));
    let normal = unit(cross(unit(sides[0]), sides[1]));
    let off_plane = |point| dot(less(single(point), flat), normal).abs();
    let (from_plane, _) = farthest(points(), first, off_plane);
    [from_point, from_line, from_plane]
}

/// The point of the largest distance, and that; `first` if all have none.
fn farthest(
    points: impl Iterator<Item = [f64; 3]>,
    first: [f64; 3],
    distance: impl Fn([f64; 3]) -> f64,
) -> (f64, [f64; 3]) {
    points
        .map(|point| (distance(point), point))
        .fold((0.0, first), |far, one| if one.0 > far.0 { one } else { far })
}

fn volume<T: Iterator<Item = Triangle>>(triangles: impl Fn() -> T) -> f64 {
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for triangle in triangles() {
        for corner in triangle {
            sum = [0, 1, 2].map(|axis| sum[axis] + corner[axis]);
            count += 1.0;
        }
    }
    let centre = sum.map(|sum| sum / f64::max(count, 1.0));
    triangles()
        .map(|[a, b, c]| {
            let [a, b, c] = [a, b, c].map(|corner| less(corner, centre));
            dot(a, cross(b, c)).abs() / 6.0
        })
        .sum()
}

/// Whether two of the first points are one; too many are not looked at.
pub fn has_repeated(points: impl Iterator<Item = [f64; 3]>) -> bool {
    const MOST: usize = 100_000;
    let mut seen = HashSet::new();
    points.take(MOST).any(|point| !seen.insert(point.map(|axis| (axis + 0.0).to_bits())))
}

/// A point in single precision.
#[allow(clippy::cast_possible_truncation)]
fn single(point: [f64; 3]) -> [f64; 3] {
    point.map(|axis| f64::from(axis as f32))
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// A vector of length 1; of length 0 if it has none.
fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = length(a);
    if length > 0.0 { a.map(|axis| axis / length) } else { [0.0; 3] }
}
