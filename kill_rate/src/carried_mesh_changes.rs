//! Mutations of original meshes (the files that the URDF names): one coordinate each.

use std::ops::Range;

use serde_json::Value;

use super::dice::Dice;
use super::meaning;
use super::mesh_edit::MeshEdit;
use super::mutation::{Change, FileChange, Files, Mutation};
use super::original::Original;
use super::plan::Plan;
use super::sample;

const MODULE: &str = "original_meshes_module";

/// Step sizes, relative to the mesh's size.
const STEPS: [(&str, f64); 3] = [
    ("a vertex moved by 1e-4 of its size", 1e-4),
    ("a vertex moved by 1e-2 of its size", 1e-2),
    ("a vertex moved by its size", 1.0),
];

/// Mutations of original meshes, as one list.
pub(crate) fn mutations(original: &Original, plan: &Plan) -> Vec<Vec<Mutation>> {
    let files =
        original.document(MODULE).and_then(|document| document.value.get("files")?.as_array());
    let paths: Vec<&str> = files
        .into_iter()
        .flatten()
        .filter_map(|file| file.get("path").and_then(Value::as_str))
        .collect();
    let mut dice = Dice::new(plan.seed, "carried meshes");
    vec![sample::draw(plan, paths.len(), &mut dice, |index, dice| {
        STEPS
            .iter()
            .map(|(kind, step)| mutation(paths[index], kind, *step, dice.below(1 << 30)))
            .collect()
    })]
}

fn mutation(path: &str, kind: &'static str, step: f64, drawn: usize) -> Mutation {
    let file = path.to_owned();
    let make = move |original: &Original| {
        let (after, from, to) = edited(original, &file, step, drawn)?;
        (!meaning::is_same(original, &file, &after))
            .then(|| FileChange::new(Files::from([(file.clone(), Some(after))]), from, to))
    };
    let change = Change::Files(Box::new(make));
    Mutation::of_file(MODULE, path, "carried meshes", kind, change)
}

/// The file with one vertex moved, and the old and new coordinates. Preserves the rest of text files.
fn edited(
    original: &Original,
    path: &str,
    step: f64,
    drawn: usize,
) -> Option<(Vec<u8>, String, String)> {
    let bytes = original.files.get(path)?;
    let extension = path.rsplit_once('.')?.1.to_ascii_lowercase();
    if extension == "stl" || extension == "glb" {
        let scene = meaning::scene(original, path, None)?;
        let edit = MeshEdit::MoveVertex(step, drawn);
        let spot = edit.spot(&scene.merged())?;
        let after = edit.applied(&spot, bytes, scene.parts, &extension)?;
        return Some((after, spot.from, spot.to));
    }
    let text = std::str::from_utf8(bytes).ok()?;
    let numbers = coordinates(text, &extension);
    if numbers.is_empty() {
        return None;
    }
    let size = |range: &Range<usize>| text[range.clone()].parse::<f64>().map_or(0.0, f64::abs);
    let extent = numbers.iter().map(size).fold(0.0, f64::max);
    let range = numbers[drawn % numbers.len()].clone();
    let from = &text[range.clone()];
    let to = (from.parse::<f64>().ok()? + step * extent).to_string();
    let mut after = text.to_owned();
    after.replace_range(range, &to);
    Some((after.into_bytes(), from.to_owned(), to))
}

/// Ranges of numbers in a text mesh that may be coordinates: after `v` in OBJ, the arrays in COLLADA.
fn coordinates(text: &str, extension: &str) -> Vec<Range<usize>> {
    let mut pieces: Vec<Range<usize>> = Vec::new();
    if extension == "obj" {
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            if line.starts_with("v ") {
                pieces.push(start + 2..start + line.len());
            }
            start += line.len();
        }
    } else if let Ok(document) = urdd_xml::parse(text, urdd_xml::Kind::Other) {
        let arrays = document.descendants().filter(|node| node.tag_name().name() == "float_array");
        pieces.extend(arrays.filter_map(|node| Some(node.first_child()?.range())));
    }
    let mut numbers = Vec::new();
    for piece in pieces {
        let words = text[piece.clone()].split_ascii_whitespace();
        let offset = |word: &str| word.as_ptr() as usize - text.as_ptr() as usize;
        numbers.extend(words.map(|word| offset(word)..offset(word) + word.len()));
    }
    numbers
}
