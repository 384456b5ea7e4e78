//! Wavefront OBJ, and its material libraries (.mtl): diffuse colours and opacity.

use std::collections::HashMap;
use std::ops::Range;

use nalgebra::Matrix4;

use super::assembly::{
    Assembly, MAX_PARTS, Material, Picker, TOO_MANY_PARTS, UvCorners, mark, within,
};
use super::bytes::{Words, float};
use super::scene::{Failure, NoteCode, Place, Texture};
use crate::polygon::Splitter;

/// Reads OBJ. Groups faces by material: objects, groups and smoothing groups do not affect the surface.
pub(super) fn read(
    bytes: &[u8],
    fetch: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
    assembly: &mut Assembly,
) -> Result<(), Failure> {
    let mut file = File {
        textures: assembly.options.textures,
        groups: vec![Group::default()],
        splitter: Splitter::new(assembly.options.uncut),
        ..File::default()
    };
    let mut joined: Vec<u8> = Vec::new();
    for (at, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
        // A trailing backslash continues the line.
        let trimmed = line.trim_ascii_end();
        if let Some(start) = trimmed.strip_suffix(b"\\") {
            joined.extend_from_slice(start);
            joined.push(b' ');
            continue;
        }
        if joined.is_empty() {
            file.line(trimmed)
        } else {
            joined.extend_from_slice(trimmed);
            let result = file.line(&joined);
            joined.clear();
            result
        }
        .map_err(|failure| failure.at(|| Place::Line(at + 1)))?;
    }
    file.drop_faces_out_of_range();
    let text = "a face was dropped: a vertex index is out of range, or is not an index";
    assembly.notes.add_many(NoteCode::IndexOutOfRange, text, file.bad);
    if file.too_many {
        assembly.notes.add(NoteCode::Assumed, TOO_MANY_PARTS);
    }
    let materials = read_libraries(&file.libraries, fetch, assembly);
    let mut used = vec![false; file.vertices.len()];
    for group in &file.groups {
        mark(&mut used, &group.triangles);
    }
    assembly.note_unused(&file.vertices, &used);
    drop(used);
    let mut picker = Picker::default();
    for group in &file.groups {
        let entry = group.material.as_ref().and_then(|name| materials.get(name));
        let color = entry.and_then(Entry::color);
        let texture = entry.and_then(|entry| entry.texture.clone());
        let (mut mesh, left_out) = picker.pick(&file.vertices, &group.triangles);
        let text = "a triangle was dropped: a vertex index is out of range";
        assembly.notes.add_many(NoteCode::IndexOutOfRange, text, left_out);
        let mut uv = Vec::new();
        if !group.uvs.is_empty() {
            (mesh, uv) = group.uvs.mesh(&file.vertices, &group.triangles, &file.uvs);
        }
        let texture = texture.map(|name| Texture { name, embedded: None, uv });
        let material = Material { name: group.material.clone(), color, texture };
        assembly.add(&mesh, &Matrix4::identity(), &material)?;
    }
    Ok(())
}

#[derive(Default)]
struct Group {
    material: Option<String>,
    triangles: Vec<[u32; 3]>,
    uvs: UvCorners,
}

#[derive(Default)]
struct File {
    libraries: Vec<String>,
    vertices: Vec<[f64; 3]>,
    /// Texture coordinates, if textures are read.
    uvs: Vec<[f64; 3]>,
    textures: bool,
    groups: Vec<Group>,
    current: usize,
    /// The material selected since the last face.
    wanted: Option<String>,
    /// Whether there are more than [`MAX_PARTS`] materials.
    too_many: bool,
    group_of: HashMap<String, usize>,
    splitter: Splitter,
    corners: Vec<u32>,
    /// Group and triangles of each face with a vertex that was not there yet.
    ahead: Vec<(usize, Range<usize>)>,
    bad: usize,
}

impl File {
    fn line(&mut self, line: &[u8]) -> Result<(), Failure> {
        let mut words = Words::new(line);
        match words.next() {
            Some(b"v") => {
                let mut coordinate = || words.float().unwrap_or(f64::NAN);
                let vertex = [coordinate(), coordinate(), coordinate()];
                self.vertices.push(vertex);
                within("vertices", self.vertices.len(), u32::MAX as usize)?;
            }
            Some(b"vt") if self.textures => {
                let mut coordinate = || words.float().unwrap_or(0.0);
                self.uvs.push([coordinate(), coordinate(), 0.0]);
            }
            // `fo` is an old spelling of `f`.
            Some(b"f" | b"fo") => {
                self.begin_group();
                self.face(words);
            }
            Some(b"usemtl") => self.wanted = Some(rest_of(line, b"usemtl")),
            Some(b"mtllib") => {
                let library = rest_of(line, b"mtllib");
                if self.libraries.len() < MAX_LIBRARIES && !self.libraries.contains(&library) {
                    self.libraries.push(library);
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Selects the group of the last named material before a face. A material without faces gets no group.
    fn begin_group(&mut self) {
        let Some(name) = self.wanted.take() else { return };
        let next = self.groups.len();
        self.current = match self.group_of.get(&name) {
            Some(known) => *known,
            None if next >= MAX_PARTS => {
                self.too_many = true;
                0
            }
            None => {
                self.group_of.insert(name.clone(), next);
                self.groups.push(Group { material: Some(name), ..Group::default() });
                next
            }
        };
    }

    fn face(&mut self, words: Words<'_>) {
        self.corners.clear();
        let group = &mut self.groups[self.current];
        for word in words {
            if word.starts_with(b"#") {
                break;
            }
            match corner(word, self.vertices.len()) {
                Some(index) => {
                    self.corners.push(index);
                    let uv = word.split(|byte| *byte == b'/').nth(1).filter(|_| self.textures);
                    if let Some(uv) = uv.and_then(|uv| corner(uv, self.uvs.len())) {
                        group.uvs.note(index, uv);
                    }
                }
                None => {
                    self.bad += 1;
                    return;
                }
            }
        }
        let start = group.triangles.len();
        self.splitter.split(&self.vertices, &self.corners, &mut group.triangles);
        group.uvs.follow(&group.triangles);
        let count = self.vertices.len();
        if self.corners.iter().any(|corner| *corner as usize >= count) {
            self.ahead.push((self.current, start..group.triangles.len()));
        }
    }

    /// Marks all triangles of a face with a vertex that the whole file lacks: the face is dropped, not a part of it.
    fn drop_faces_out_of_range(&mut self) {
        let count = self.vertices.len();
        for (group, range) in self.ahead.drain(..) {
            let triangles = &mut self.groups[group].triangles[range];
            if triangles.as_flattened().iter().any(|corner| *corner as usize >= count) {
                triangles.fill([u32::MAX; 3]);
            }
        }
    }
}

/// The vertex index of a corner `v`, `v/t`, `v//n` or `v/t/n`. Indices start at 1; negative ones count back from the
/// last vertex so far.
///
/// A positive index may reference a vertex that comes later in the file. A range check follows at the end.
fn corner(word: &[u8], count: usize) -> Option<u32> {
    let end = word.iter().position(|byte| *byte == b'/').unwrap_or(word.len());
    let index = std::str::from_utf8(&word[..end]).ok()?.parse::<i64>().ok()?;
    let index = if index < 0 { index.checked_add(i64::try_from(count).ok()?)? } else { index - 1 };
    u32::try_from(index).ok()
}

fn rest_of(line: &[u8], keyword: &[u8]) -> String {
    let line = line.trim_ascii();
    String::from_utf8_lossy(line.get(keyword.len()..).unwrap_or_default()).trim().to_owned()
}

/// The materials of all libraries by name; the first wins if a name occurs twice.
fn read_libraries(
    libraries: &[String],
    fetch: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
    assembly: &mut Assembly,
) -> HashMap<String, Entry> {
    let mut materials = HashMap::new();
    let mut seen: Vec<&str> = Vec::new();
    for library in libraries {
        // A name may contain spaces. A line may also list several names, each with the extension.
        let mut whole = fetch(library);
        let words: Vec<&str> = library.split_ascii_whitespace().collect();
        let is_list =
            words.len() > 1 && words.iter().all(|word| word.to_ascii_lowercase().ends_with(".mtl"));
        let names = if whole.is_none() && is_list { words } else { vec![library.as_str()] };
        for name in names {
            if seen.len() >= MAX_LIBRARIES || seen.contains(&name) {
                continue;
            }
            seen.push(name);
            assembly.add_side_file(&name.replace('\\', "/"));
            let Some(bytes) = whole.take().or_else(|| fetch(name)) else {
                let text =
                    format!("the material library '{name}' was not found; its colours are missing");
                assembly.notes.add(NoteCode::SideFileMissing, text);
                continue;
            };
            let (entries, textures) = read_library(&bytes);
            for texture in textures {
                assembly.add_side_file(&beside(name, &texture));
            }
            for mut entry in entries {
                entry.texture = entry.texture.map(|texture| beside(name, &texture));
                materials.entry(entry.name.clone()).or_insert(entry);
            }
        }
    }
    materials
}

/// Maximum number of material libraries per file; real files reference one.
const MAX_LIBRARIES: usize = 1000;

/// The name of a texture that `library` references, relative to the mesh.
fn beside(library: &str, texture: &str) -> String {
    match library.replace('\\', "/").rsplit_once('/') {
        Some((folder, _)) if !texture.starts_with('/') => format!("{folder}/{texture}"),
        _ => texture.to_owned(),
    }
}

#[derive(Debug)]
struct Entry {
    name: String,
    color: Option<[f64; 3]>,
    opacity: f64,
    /// The image of its diffuse colour, relative to the library.
    texture: Option<String>,
}

impl Entry {
    /// Colour and opacity; `None` with a texture.
    fn color(&self) -> Option<[f64; 4]> {
        let [red, green, blue] = self.color.filter(|_| self.texture.is_none())?;
        Some([red, green, blue, self.opacity])
    }
}

/// The materials of a library in order, and the textures that it references.
fn read_library(bytes: &[u8]) -> (Vec<Entry>, Vec<String>) {
    let mut entries: Vec<Entry> = Vec::new();
    let mut textures = Vec::new();
    let text = String::from_utf8_lossy(bytes);
    for line in text.lines() {
        let line = line.trim();
        let (keyword, rest) =
            line.split_once(|c: char| c.is_ascii_whitespace()).unwrap_or((line, ""));
        let rest = rest.trim();
        let keyword = keyword.to_ascii_lowercase();
        if keyword == "newmtl" {
            entries.push(Entry { name: rest.to_owned(), color: None, opacity: 1.0, texture: None });
            continue;
        }
        let Some(entry) = entries.last_mut() else { continue };
        match keyword.as_str() {
            "kd" => entry.color = color(rest),
            "d" => entry.opacity = opacity(rest).unwrap_or(1.0),
            "tr" => entry.opacity = opacity(rest).map_or(1.0, |transparency| 1.0 - transparency),
            _ if keyword.starts_with("map_")
                || matches!(keyword.as_str(), "bump" | "disp" | "decal" | "norm" | "refl") =>
            {
                // Options such as `-bm 0.2` precede the name, which is last.
                let is_last = |c: char| rest.starts_with('-') && c.is_whitespace();
                let name = rest.rsplit(is_last).next().unwrap_or(rest).replace('\\', "/");
                if keyword == "map_kd" {
                    entry.texture = Some(name.clone());
                }
                textures.push(name);
            }
            _ => {}
        }
    }
    (entries, textures)
}

/// `r g b`, or `r` for all three; `None` for `spectral` and `xyz`.
fn color(text: &str) -> Option<[f64; 3]> {
    let values: Vec<f64> =
        text.split_ascii_whitespace().take(3).map(|word| float(word.as_bytes())).collect();
    let color = match *values {
        [gray] => [gray; 3],
        [red, green, blue] => [red, green, blue],
        _ => return None,
    };
    color.iter().all(|value| value.is_finite()).then(|| color.map(|value| value.clamp(0.0, 1.0)))
}

/// The first number of a `d` or `Tr` line; `-halo` may precede it.
fn opacity(text: &str) -> Option<f64> {
    let word = text.split_ascii_whitespace().find(|word| *word != "-halo")?;
    let value = float(word.as_bytes());
    value.is_finite().then(|| value.clamp(0.0, 1.0))
}
