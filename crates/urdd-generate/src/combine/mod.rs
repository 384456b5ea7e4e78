//! Combines several robots into one. Merges their URDFs, stores each mesh once, and reuses results from the parts'
//! URDDs.
//!
//! A [`Recipe`] lists the robots and how they are attached. [`combine`] generates the URDD. It does not validate the
//! parts; the caller does that first, with [`check_parts`].

mod check_parts;
mod compose;
mod configurations;
mod document;
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
mod recipe_check;
mod recipe_fault;
mod recipe_file;
mod record;
mod rewrite;
mod skips;
mod sources;
mod toml_file;
mod toml_text;
mod trim;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use self::compose::Taken;
use self::meshes::Meshes;
use self::names::LeftAlone;
use self::rewrite::{Rewrite, Rewritten};
use crate::{
    Composed, GenerateError, Generated, MOST_LINKS, Progress, Settings, generate_composed,
};
use urdd_format::composition::{CompositionModule, PartSource};
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::Geometry;
use urdd_source::note::{self as generated, NoteKind};
use urdd_source::origin::has_quaternions;
use urdd_source::read_urdf;

pub use check_parts::check_parts;
pub use error::{CombineError, PartFault};
pub use note::Note;
pub use recipe::{
    Attachment, Base, JointDescription, MAX_RECIPE_BYTES, Part, Recipe, Sources, Word,
};
pub use recipe_fault::RecipeFault;
pub use sources::{SourceKind, source_kind};

/// The modules that a part has because of a person, and that are not computed.
const OF_PEOPLE: [&str; 2] = ["composition_module", "named_configurations_module"];

/// A combined robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Combined {
    /// Its URDD.
    pub generated: Generated,
    /// How it was composed.
    pub composition: CompositionModule,
    /// Notes for the user.
    pub notes: Vec<Note>,
}

/// Combines robots: generates the URDD of a recipe in the folder `target`, which is replaced atomically and is
/// unchanged on error. Results in the parts' URDDs are reused, except for the part ids in `distrusted`.
///
/// # Errors
/// If the recipe is invalid, a part is not a valid robot, or the URDD cannot be written.
pub fn combine(
    recipe: &Recipe,
    target: &Path,
    settings: &Settings,
    distrusted: &BTreeSet<String>,
    progress: &dyn Progress,
) -> Result<Combined, CombineError> {
    let internal = |reason: String| CombineError::Generate {
        id: None,
        error: GenerateError::internal(&recipe.shown, reason),
    };
    let unwritable = CombineError::unwritable;
    let workplace = tempfile::tempdir();
    let workplace = workplace.map_err(|error| unwritable(&std::env::temp_dir(), error))?;
    let mut notes = Vec::new();
    let parts = take_up(recipe, workplace.path(), settings)?;
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
    let configurations = configurations::of_parts(recipe, &parts, &mut notes)?;

    let [folder, store] = ["whole", "store"].map(|name| workplace.path().join(name));
    for folder in [&folder, &store] {
        std::fs::create_dir_all(folder).map_err(|error| unwritable(folder, error))?;
    }
    let mut files = Meshes::new(store, &settings.cancellation);
    let mut placed = Vec::new();
    for taken in &parts {
        placed.push(files.add(taken.part, &taken.loaded, &used_meshes(taken))?);
    }
    let shared = files.write(&folder)?;

    let quaternions = has_quaternions(compose::version(&parts).as_deref());
    let (mut rewritten, mut length) = (Vec::new(), 0);
    for ((taken, placed), repeated) in parts.iter().zip(placed).zip(&repeated) {
        settings.cancellation.check()?;
        let carried = placed.into_iter();
        let carried = carried.map(|(name, place)| (name, meshes::carried(&place, &shared)));
        let text = Rewrite {
            loaded: &taken.loaded,
            trim: &taken.trim,
            prefix: &taken.part.prefix.text,
            names: &names_told(recipe, taken.part)?,
            meshes: &carried.collect::<BTreeMap<_, _>>(),
            repeated_materials: repeated,
            quaternions,
        };
        let text = text.run().map_err(internal)?;
        said_of_text(taken, &text, &mut notes);
        length += text.inner.len();
        recipe.check_length(taken.part, "the URDFs", length)?;
        rewritten.push(text);
    }
    let urdf = compose::urdf(recipe, &parts, &rewritten)?;
    settings.cancellation.check()?;
    let robot = read_urdf(urdf.as_bytes(), &recipe.name.text);
    let robot = robot.map_err(|error| CombineError::Generate { id: None, error: error.into() })?;
    let composition = record::composition(recipe, &parts, &robot.robot)?;

    let mut settings = settings.clone();
    let trusted = parts.iter().filter(|taken| {
        let is_urdd = matches!(taken.loaded.source, PartSource::Urdd(_));
        is_urdd && !distrusted.contains(&taken.part.id.text)
    });
    let mut reused = BTreeSet::new();
    let trusted = trusted.filter(|taken| reused.insert(Rc::as_ptr(&taken.loaded)));
    settings.donors = trusted.map(|taken| taken.loaded.root.clone()).collect();
    let composed = Composed {
        shown: format!("{}.urdf", recipe.name.text),
        folder,
        edits,
        configurations,
        skipped_reasons,
        composition: composition.clone(),
    };
    let generated = generate_composed(urdf.into_bytes(), &composed, target, &settings, progress);
    let mut generated = generated.map_err(|error| CombineError::Generate { id: None, error })?;
    // The notes about the parts already say that.
    let is_said = |note: &generated::Note| note.kind == NoteKind::MeshNotFound;
    generated.notes.retain(|note| !is_said(note));
    Ok(Combined { generated, composition, notes })
}

/// Reads the parts, each source once, and checks the size limits of a robot.
fn take_up<'a>(
    recipe: &'a Recipe,
    workplace: &Path,
    settings: &Settings,
) -> Result<Vec<Taken<'a>>, CombineError> {
    let mut parts = Vec::new();
    let mut known: BTreeMap<PathBuf, Rc<part::Loaded>> = BTreeMap::new();
    let (mut links, mut length, mut composition_length) = (0, 0, 0);
    for (idx, part) in recipe.parts.iter().enumerate() {
        settings.cancellation.check()?;
        let source = recipe.source(part, settings)?;
        let loaded = match known.get(&source.path) {
            Some(loaded) => loaded.clone(),
            None => {
                let place = workplace.join(format!("part_{idx}"));
                Rc::new(part::load(&source, &part.id.text, &place, settings)?)
            }
        };
        known.insert(source.path, loaded.clone());
        let trim = trim::trim(recipe, part, &loaded)?;
        links += (0..trim.dropped_links.len()).filter(|link| trim.keeps_link(*link)).count();
        if links > MOST_LINKS {
            let fault = RecipeFault::TooManyLinks { found: links, limit: MOST_LINKS };
            return Err(recipe.refused(&part.id, fault));
        }
        length += loaded.text.len();
        recipe.check_length(part, "the URDFs", length)?;
        composition_length += loaded.composition_length;
        let what = "the composition modules";
        recipe.check_length(part, what, composition_length)?;
        parts.push(Taken { part, loaded, trim });
    }
    Ok(parts)
}

/// The meshes of the kept links.
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

/// The texture files of the kept materials.
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

/// The recipe's `names` of a part: other elements and attributes that name links and joints.
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

/// Notes about each part.
fn said(parts: &[Taken], notes: &mut Vec<Note>) {
    let is_urdd = |taken: &&Taken| matches!(taken.loaded.source, PartSource::Urdd(_));
    let urdds = parts.iter().filter(is_urdd);
    let all: BTreeSet<&String> = urdds.flat_map(|taken| &taken.loaded.modules).collect();
    for taken in parts {
        let mut note = |kind, text| notes.push(Note::of_part(kind, &taken.part.id.text, text));
        for of_part in &taken.loaded.notes {
            note(of_part.kind.as_str(), of_part.to_string());
        }
        for link in &taken.loaded.plain_meshes {
            let idx = taken.loaded.links.get(link);
            if idx.is_some_and(|idx| taken.trim.keeps_link(*idx)) {
                note(
                    "plain-mesh",
                    format!(
                        "its URDD lacks the original mesh of link `{link}`; the plain mesh is used, without colours"
                    ),
                );
            }
        }
        for joint in &taken.trim.following {
            note(
                "following",
                format!(
                    "joint `{joint}` mimics a frozen joint, and is frozen at the position that follows"
                ),
            );
        }
        // URDDs store the textures of meshes, not those of materials.
        for name in textures(taken) {
            note(
                "texture",
                format!(
                    "texture `{name}` of a material is not carried; its name is unchanged, and the file stays where it is"
                ),
            );
        }
        if !is_urdd(&taken) {
            continue;
        }
        for name in used_meshes(taken) {
            if !taken.loaded.meshes.contains_key(&name) {
                note(
                    "mesh-not-found",
                    format!(
                        "its URDD has no file for mesh `{name}`: not carried; the element has no surface"
                    ),
                );
            }
        }
        let known = ModuleKind::ALL.iter().map(|kind| kind.name());
        let lacks = known.filter(|name| {
            let is_name = |module: &&String| module.as_str() == *name;
            let is_there = taken.loaded.modules.iter().any(|module| is_name(&module));
            !is_there && all.iter().any(is_name) && !OF_PEOPLE.contains(name)
        });
        let lacks: Vec<&str> = lacks.collect();
        if !lacks.is_empty() {
            let lacks = lacks.join(", ");
            note(
                "unequal-modules",
                format!("it has no {lacks}, which other parts have; it is computed"),
            );
        }
    }
}

/// Notes about the text of a part.
fn said_of_text(taken: &Taken, text: &Rewritten, notes: &mut Vec<Note>) {
    let mut note = |kind, text| notes.push(Note::of_part(kind, &taken.part.id.text, text));
    let is_renamed = !taken.part.prefix.text.is_empty();
    for LeftAlone { place, name } in text.left_alone.iter().filter(|_| is_renamed) {
        note(
            "left-alone",
            format!(
                "`{place}` contains `{name}`, the name of a link or joint, and was left unchanged; if it refers to that, write names = [\"{place}\"]"
            ),
        );
    }
    for what in &text.gone {
        note("gone", format!("left out {what}"));
    }
}
