//! Creates the files of a new module of the format: its type, its entries in the registry, its place in SPEC.md.

use std::path::Path;

use crate::new_rule::add_change;
use crate::source::{Edits, camel};

const TYPES: &str = "crates/urdd-format/src";
const SPEC: &str = "SPEC.md";
const SELECTION: &str = "crates/urdd-generate/src/selection.rs";

/// Creates a module that no conformance class requires, derived from `urdf_module`. Writes nothing unless all edits are
/// possible.
///
/// # Errors
/// If the name is invalid or taken, or the source does not have the expected form.
pub fn make(root: &Path, name: &str) -> Result<String, String> {
    let stem = name.strip_suffix("_module").unwrap_or(name);
    check_name(stem)?;
    let (name, kind) = (format!("{stem}_module"), camel(stem));
    let mut edits = Edits::new(root);
    let path = format!("{TYPES}/{stem}.rs");
    edits.create(&path, module_type(&name, &kind))?;
    edits.insert_module(&format!("{TYPES}/lib.rs"), &format!("pub mod {stem};"))?;
    // After the last of the core modules, as in SPEC.md.
    let registry = format!("{TYPES}/registry.rs");
    if edits.read(&registry)?.contains(&format!("= \"{name}\" in")) {
        return Err(format!("{name} is there already: {registry}"));
    }
    edits.insert_before(
        &registry,
        "    /// Mesh files as the URDF names them.",
        &format!(
            "    /// TODO: what it says, in some words. Optional.\n    {kind} = \"{name}\" in \"\", None, needs [Urdf];\n"
        ),
    )?;
    edits.insert_before(
        &registry,
        "    OriginalMeshes(",
        &format!("    {kind}({stem}::{kind}Module): {kind} @ \"1.0.0\", V1;\n"),
    )?;
    let selection = edits.read(SELECTION)?;
    let list = "NOT_SELECTABLE: &[(ModuleKind, &str)] =";
    let begin = selection
        .find(list)
        .and_then(|at| Some(at + list.len() + selection[at + list.len()..].find('[')? + 1));
    let begin = begin.ok_or(format!("{SELECTION} is not as expected: no {list:?}"))?;
    let (head, tail) = selection.split_at(begin);
    edits.set(
        SELECTION,
        format!("{head}\n    (ModuleKind::{kind}, \"TODO: which robots have it\"),{tail}"),
    );
    let clause = next_clause(&edits.read(SPEC)?)?;
    edits.insert_before(
        SPEC,
        "## 7 Mesh modules",
        &format!(
            "### {clause} `{name}`\n\n**{clause}.1** TODO: say what the module holds, who needs it, and that no class requires it (annex A has its keys).\n\n"
        ),
    )?;
    edits.insert_before(
        SPEC,
        "| `original_meshes_module` | `mesh_modules/",
        &format!("| `{name}` | `{name}` | (optional) | `urdf_module` |\n"),
    )?;
    add_change(&mut edits, &format!("what {name} says"))?;
    edits.write()?;
    Ok(format!(
        "1. Write its type: {path}. Every key with its meaning, shape, unit and frame.\n\
         2. What it is derived from, and its words: `{kind}` in {registry}, and the table in {SPEC}, clause 2.2.1.\n\
         3. Say in {SPEC}, clause {clause}, what it holds.\n\
         4. cargo xtask new-rule BAT001 name-of-the-fault --clause {clause}.1 --family {stem}     (its first rule; three letters of yours for BAT)\n\
         5. cargo xtask update     (schemas, annex A, types for Python)\n\
         6. cargo xtask check      (what is left)\n\
         `urdd generate` does not make it. If it should: a stage in crates/urdd-generate/src/stages.rs, and its name goes from {SELECTION}.\n"
    ))
}

fn check_name(stem: &str) -> Result<(), String> {
    let words = stem.split('_').all(|word| {
        !word.is_empty()
            && word.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit())
    });
    let begins = stem.bytes().next().is_some_and(|byte| byte.is_ascii_lowercase());
    match words && begins {
        true => Ok(()),
        false => Err(format!(
            "{stem:?} is not a name; write small letters with underscores: battery_pack"
        )),
    }
}

fn module_type(name: &str, kind: &str) -> String {
    format!(
        "//! `{name}`: TODO: what it says, in some words.\n\n\
         use super::types::module;\n\n\
         module! {{\n    \
             /// TODO: what the module says, in one sentence.\n    \
             pub struct {kind}Module {{\n        \
                 /// TODO: meaning, shape, unit, index space, frame; `crates/urdd-format/src/bounds.rs` is an example.\n        \
                 pub values: Vec<f64>,\n    \
             }}\n}}\n"
    )
}

/// The number after the last clause of the core modules: `6.7`.
fn next_clause(spec: &str) -> Result<String, String> {
    let numbers = spec.lines().filter_map(|line| {
        let number = line.strip_prefix("### 6.")?;
        number.split(' ').next()?.parse::<u32>().ok()
    });
    let last = numbers.max();
    last.map(|last| format!("6.{}", last + 1)).ok_or(format!("{SPEC} has no clauses 6.x"))
}
