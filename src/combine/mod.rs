//! Several robots become one: their URDFs one URDF, whose URDD carries all meshes, each once, and
//! takes over what the parts' URDDs hold of their links.
//!
//! A [`Recipe`] says which robots, and how they hang on each other. [`combine`] makes the URDD. It does not judge
//! the parts: whoever calls it validates those before, by [`check_parts`].

mod check_parts;
mod compose;
mod error;
mod from_legacy;
mod frozen;
mod keys;
mod legacy;
mod meshes;
mod names;
mod note;
mod part;
mod recipe;
mod recipe_file;
mod record;
mod rewrite;
mod skips;
mod toml_file;
mod toml_text;
mod trim;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use self::compose::Taken;
use self::meshes::Meshes;
use self::rewrite::{Rewrite, Rewritten};
use crate::format::composition::{CompositionModule, PartSource};
use crate::format::registry::ModuleKind;
use crate::format::urdf::Geometry;
use crate::generate::note::{self as generated, NoteKind};
use crate::generate::{
    Composed, GenerateError, Generated, Progress, Settings, generate_composed, has_quaternions,
    read_urdf,
};

pub use check_parts::check_parts;
pub use error::{CombineError, PartFault, RecipeFault};
pub use names::LeftAlone;
pub use note::Note;
pub use part::{SourceKind, source_kind};
pub use recipe::{Attachment, Base, JointDescription, MAX_RECIPE_BYTES, Part, Recipe, Word};

/// A robot that was put together.
#[derive(Debug, Clone, PartialEq)]
pub struct Combined {
    /// Its URDD.
    pub generated: Generated,
    /// How it was put together.
    pub composition: CompositionModule,
    /// What there is to say of it.
    pub notes: Vec<Note>,
}

/// Puts robots together: makes the URDD of a recipe in the folder `target`, which is there as a whole when this
/// returns, or is as it was. What the URDDs of parts hold of their links is taken over, but for parts that are
/// `distrusted`, by their ids.
///
/// # Errors
/// Where the recipe cannot be followed, a part is no robot, or the URDD cannot be written.
pub fn combine(
    recipe: &Recipe,
    target: &Path,
    settings: &Settings,
    distrusted: &BTreeSet<String>,
    progress: &dyn Progress,
) -> Result<Combined, CombineError> {
    let internal = |reason: String| CombineError::Generate {
        id: None,
        error: GenerateError::Internal {
            file: recipe.shown.clone(),
            reason,
        },
    };
    let workplace = tempfile::tempdir().map_err(|error| internal(error.to_string()))?;
    let mut notes = Vec::new();
    let mut parts = Vec::new();
    for (idx, part) in recipe.parts.iter().enumerate() {
        settings.cancellation.check().map_err(cancelled)?;
        let place = workplace.path().join(format!("part_{idx}"));
        let loaded = part::load(recipe, part, &place, settings)?;
        let trim = trim::trim(recipe, part, &loaded.robot)?;
        parts.push(Taken { part, loaded, trim });
    }
    said(&parts, &mut notes);
    for taken in &parts {
        if let Some(attach) = &taken.part.attach {
            let (holder, link) = recipe.target(&attach.to)?;
            if let Some(holder) = holder {
                skips::existing(recipe, &parts[holder], link, &attach.to)?;
            }
        }
    }
    let repeated = compose::check_names(recipe, &parts)?;
    let (edits, skipped_reasons) = skips::decisions(recipe, &parts, &mut notes)?;

    let folder = workplace.path().join("whole");
    let mut files = Meshes::default();
    let mut placed = Vec::new();
    for taken in &parts {
        placed.push(files.add(taken.part, &taken.loaded, &used_meshes(taken))?);
    }
    std::fs::create_dir_all(&folder).map_err(|error| internal(error.to_string()))?;
    let shared = files.write(&folder).map_err(internal)?;

    let quaternions = has_quaternions(compose::version(&parts).as_deref());
    let mut rewritten = Vec::new();
    for ((taken, placed), repeated) in parts.iter().zip(placed).zip(&repeated) {
        let carried = placed.into_iter();
        let carried = carried.map(|(name, place)| (name, meshes::carried(&place, &shared)));
        let text = Rewrite {
            loaded: &taken.loaded,
            trim: &taken.trim,
            prefix: &taken.part.prefix,
            names: &names_told(recipe, taken.part)?,
            meshes: &carried.collect::<BTreeMap<_, _>>(),
            repeated_materials: repeated,
            quaternions,
        };
        let text = text.run().map_err(internal)?;
        said_of_text(taken, &text, &mut notes);
        rewritten.push(text);
    }
    let urdf = compose::urdf(recipe, &parts, &rewritten)?;
    let robot = read_urdf(urdf.as_bytes(), &recipe.name);
    let robot = robot.map_err(|error| CombineError::Generate { id: None, error })?;
    let composition = record::composition(recipe, &parts, &robot.robot)?;

    let mut settings = settings.clone();
    let trusted = parts.iter().filter(|taken| {
        let is_urdd = matches!(taken.loaded.source, PartSource::Urdd(_));
        is_urdd && !distrusted.contains(&taken.part.id.text)
    });
    settings.reuse = trusted.map(|taken| taken.loaded.root.clone()).collect();
    let composed = Composed {
        shown: format!("{}.urdf", recipe.name),
        folder,
        edits,
        skipped_reasons,
        composition: composition.clone(),
    };
    let generated = generate_composed(urdf.into_bytes(), &composed, target, &settings, progress);
    let mut generated = generated.map_err(|error| CombineError::Generate { id: None, error })?;
    // That was said of the parts.
    let is_said = |note: &generated::Note| note.kind == NoteKind::MeshNotFound;
    generated.notes.retain(|note| !is_said(note));
    Ok(Combined {
        generated,
        composition,
        notes,
    })
}

fn cancelled(error: crate::cancellation::Cancelled) -> CombineError {
    CombineError::Generate {
        id: None,
        error: error.into(),
    }
}

/// The meshes that links name which come along.
fn used_meshes(taken: &Taken) -> BTreeSet<String> {
    let links = taken.loaded.robot.links.iter().enumerate();
    let links = links.filter(|(idx, _)| taken.trim.keeps_link(*idx));
    let geometries = links.flat_map(|(_, link)| {
        let visual = link.visual.iter().map(|visual| &visual.geometry);
        let collision = link.collision.iter().map(|collision| &collision.geometry);
        visual.chain(collision).flatten()
    });
    let names = geometries.filter_map(|geometry| match geometry {
        Geometry::Mesh(mesh) => Some(mesh.filename.clone()),
        _ => None,
    });
    names.collect()
}

/// The files that materials which come along name as their textures.
fn textures(taken: &Taken) -> BTreeSet<String> {
    let robot = &taken.loaded.robot;
    let links = robot.links.iter().enumerate();
    let links = links.filter(|(idx, _)| taken.trim.keeps_link(*idx));
    let visuals = links.flat_map(|(_, link)| &link.visual);
    let own = visuals.filter_map(|visual| visual.material.as_ref());
    let textures = own.chain(&robot.materials);
    let textures = textures.filter_map(|material| material.texture.as_ref());
    textures.map(|texture| texture.filename.clone()).collect()
}

/// What else names links and joints in a part, as the recipe tells it.
fn names_told<'a>(recipe: &Recipe, part: &'a Part) -> Result<BTreeSet<&'a str>, CombineError> {
    let mut told = BTreeSet::new();
    for word in &part.names {
        let mut words = word.text.split('@');
        let is_word = |word: Option<&str>| word.is_none_or(|word| !word.trim().is_empty());
        let fits = is_word(words.next()) && is_word(words.next()) && words.next().is_none();
        if !fits {
            let fault = RecipeFault::BadName(word.text.clone());
            return Err(recipe.refused(word, fault));
        }
        told.insert(word.text.as_str());
    }
    Ok(told)
}

/// What there is to say of the parts by themselves.
fn said(parts: &[Taken], notes: &mut Vec<Note>) {
    let is_urdd = |taken: &&Taken| matches!(taken.loaded.source, PartSource::Urdd(_));
    let urdds = parts.iter().filter(is_urdd);
    let all: BTreeSet<&String> = urdds.flat_map(|taken| &taken.loaded.modules).collect();
    for taken in parts {
        let part = &taken.part.id.text;
        for note in &taken.loaded.notes {
            notes.push(Note::Part {
                part: part.clone(),
                note: note.clone(),
            });
        }
        for joint in &taken.trim.following {
            notes.push(Note::Following {
                part: part.clone(),
                joint: joint.clone(),
            });
        }
        for name in textures(taken) {
            notes.push(Note::Texture {
                part: part.clone(),
                name,
            });
        }
        if !is_urdd(&taken) {
            continue;
        }
        for name in used_meshes(taken) {
            if !taken.loaded.meshes.contains_key(&name) {
                let part = part.clone();
                notes.push(Note::NoMesh { part, name });
            }
        }
        let known = ModuleKind::ALL.iter().map(|kind| kind.name());
        let lacks = known.filter(|name| {
            let is_there = |list: &Vec<String>| list.iter().any(|module| module == name);
            let others_have = all.iter().any(|module| module == name);
            others_have && !is_there(&taken.loaded.modules) && *name != "composition_module"
        });
        let lacks: Vec<String> = lacks.map(str::to_owned).collect();
        if !lacks.is_empty() {
            notes.push(Note::UnequalModules {
                part: part.clone(),
                lacks,
            });
        }
    }
}

/// What there is to say of a part's text.
fn said_of_text(taken: &Taken, text: &Rewritten, notes: &mut Vec<Note>) {
    let part = &taken.part.id.text;
    let is_renamed = !taken.part.prefix.is_empty();
    for left in text.left_alone.iter().filter(|_| is_renamed) {
        notes.push(Note::LeftAlone {
            part: part.clone(),
            place: left.place.clone(),
            name: left.name.clone(),
        });
    }
    for what in &text.gone {
        notes.push(Note::Gone {
            part: part.clone(),
            what: what.clone(),
        });
    }
}
