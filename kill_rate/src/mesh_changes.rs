//! Mutations of meshes: a vertex or a triangle, in one format or in all three.

use serde_json::Value;

use super::dice::Dice;
use super::meaning;
use super::mesh_edit::MeshEdit;
use super::mutation::{Change, FileChange, Files, Mutation};
use super::original::{Document, Original};
use super::plan::Plan;
use super::pointer;
use super::sample;

/// The modules with meshes in three formats.
const MODULES: [&str; 3] =
    ["plain_meshes_module", "convex_hull_meshes_module", "convex_decomposition_meshes_module"];

/// A mesh's files by format, and its JSON Pointer.
#[derive(Clone)]
struct Entry {
    pointer: String,
    files: [String; 3],
}

const FORMATS: [&str; 3] = ["stl", "obj", "glb"];

/// Which formats to change together.
const SCOPES: [(&str, &[usize]); 4] =
    [("all formats", &[0, 1, 2]), (".stl", &[0]), (".obj", &[1]), (".glb", &[2])];

/// Mutations of meshes, one list per module and choice of formats.
pub(crate) fn mutations(original: &Original, plan: &Plan) -> Vec<Vec<Mutation>> {
    let mut lists = Vec::new();
    for document in MODULES.iter().filter_map(|name| original.document(name)) {
        let entries = entries(document);
        for (name, scope) in SCOPES {
            let mut dice = Dice::new(plan.seed, &format!("{} {name}", document.name));
            lists.push(sample::draw(plan, entries.len(), &mut dice, |index, dice| {
                of_mesh(document, &entries, index, (name, scope), dice)
            }));
        }
    }
    lists.extend(super::carried_mesh_changes::mutations(original, plan));
    lists
}

fn entries(document: &Document) -> Vec<Entry> {
    let fields = pointer::fields(&document.value);
    let stl = fields.iter().filter(|(field, _)| field.ends_with("/stl"));
    let places = stl.flat_map(|(_, places)| places);
    places
        .filter_map(|place| {
            let (pointer, _) = place.rsplit_once('/')?;
            let object = document.value.pointer(pointer)?;
            let file = |format: &str| object.get(format).and_then(Value::as_str).map(str::to_owned);
            let [stl, obj, glb] = FORMATS.map(file);
            Some(Entry { pointer: pointer.to_owned(), files: [stl?, obj?, glb?] })
        })
        .collect()
}

fn of_mesh(
    document: &Document,
    entries: &[Entry],
    index: usize,
    (name, scope): (&str, &'static [usize]),
    dice: &mut Dice,
) -> Vec<Mutation> {
    let entry = &entries[index];
    let mutation = |kind: &'static str, change: Change| {
        let (file, field) = (&entry.files[scope[0]], format!("meshes, {name}"));
        let mut mutation = Mutation::of_file(&document.name, file, &field, kind, change);
        mutation.description.pointer = Some(entry.pointer.clone());
        mutation
    };
    let mut out = Vec::new();
    for (kind, edit) in MeshEdit::each(dice) {
        let entry = entry.clone();
        let make = move |original: &Original| edited(original, &entry, scope, &edit);
        out.push(mutation(kind, Change::Files(Box::new(make))));
    }
    if scope.len() == FORMATS.len() && entries.len() > 1 {
        let other = &entries[(index + 1 + dice.below(entries.len() - 1)) % entries.len()];
        for (kind, both) in [("exchanged with another", true), ("another instead of it", false)] {
            let (entry, other) = (entry.clone(), other.clone());
            let make = move |original: &Original| exchanged(original, &entry, &other, both);
            out.push(mutation(kind, Change::Files(Box::new(make))));
        }
    }
    out
}

fn edited(
    original: &Original,
    entry: &Entry,
    scope: &[usize],
    edit: &MeshEdit,
) -> Option<FileChange> {
    // Select the spot in one file and find it by position in the others, so that all formats get the same edit.
    let first = meaning::scene(original, &entry.files[0], None)?;
    let spot = edit.spot(&first.merged())?;
    let mut files = Files::new();
    for format in scope {
        // With all formats, colours change in .glb only.
        if !edit.is_possible(FORMATS[*format]) {
            continue;
        }
        let path = &entry.files[*format];
        let parts = meaning::scene(original, path, None)?.parts;
        let before = original.files.get(path)?;
        let after = edit.applied(&spot, before, parts, FORMATS[*format])?;
        let same = match edit.is_beside_triangles() {
            true => *before == after,
            false => meaning::is_same(original, path, &after),
        };
        if same {
            return None;
        }
        files.insert(path.clone(), Some(after));
    }
    (!files.is_empty()).then(|| FileChange::new(files, spot.from, spot.to))
}

fn exchanged(original: &Original, entry: &Entry, other: &Entry, both: bool) -> Option<FileChange> {
    let mut files = Files::new();
    for (a, b) in entry.files.iter().zip(&other.files) {
        let (of_a, of_b) = (original.files.get(a)?, original.files.get(b)?);
        if meaning::is_same(original, a, of_b) {
            return None;
        }
        files.insert(a.clone(), Some(of_b.clone()));
        if both {
            files.insert(b.clone(), Some(of_a.clone()));
        }
    }
    Some(FileChange::new(files, &entry.pointer, &other.pointer))
}
