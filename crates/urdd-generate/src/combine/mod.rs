//! Combines several robots into one. Merges their URDFs, stores each mesh once, and reuses results from the parts'
//! URDDs.
//!
//! A [`Recipe`] lists the robots and how they are attached. [`combine`] generates the URDD. It does not validate the
//! parts; the caller does that first, with [`check_parts`].

mod compose;
mod decisions;
mod error;
mod legacy;
mod names;
mod part;
mod recipe;
mod recipe_file;
mod rewrite;
mod sources;
mod trim;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use crate::given::GivenDecisions;
use crate::robot::generate_composed;
use crate::{GenerateError, Generated, MOST_LINKS, Progress, Settings};
use compose::Member;
use error::Result;
use names::LeftAlone;
use part::Meshes;
use rewrite::{Rewrite, Rewritten};
use sources::SourceKind;
use urdd_directory::cancellation::Cancelled;
use urdd_directory::target_lock::Temporary;
use urdd_format::composition::CompositionModule;
use urdd_format::registry::ModuleKind;
use urdd_source::note::NoteKind;
use urdd_source::origin::has_quaternions;
use urdd_source::{named, read_urdf};

pub use error::{CombineError, Note, PartFault};
pub use recipe::Recipe;

/// The modules that a part has because of a person, or because of its source, or on request, and that are not computed.
const OF_PEOPLE: [&str; 4] = [
    "composition_module",
    "named_configurations_module",
    "link_shapes_spheres_module",
    "loops_module",
];

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

/// Validates each part that is a URDD: `find_errors` returns its errors as text. With [`Settings::force`], parts with
/// errors are accepted; their ids are returned, and their URDDs must not be reused.
///
/// # Errors
/// [`CombineError::Part`] for a part that is missing or may not be used, and without `force` for one with errors; an
/// error if cancelled.
pub fn check_parts(
    recipe: &Recipe,
    settings: &Settings,
    find_errors: impl Fn(&Path) -> Result<Vec<String>, Cancelled>,
) -> Result<BTreeSet<String>, CombineError> {
    let mut distrusted = BTreeSet::new();
    let mut known: BTreeMap<PathBuf, Vec<String>> = BTreeMap::new();
    for part in &recipe.parts {
        settings.source.cancellation.check()?;
        let source = recipe.source(part, settings)?;
        if source.kind != SourceKind::Urdd {
            continue;
        }
        let codes = match known.get(&source.path) {
            Some(codes) => codes.clone(),
            None => find_errors(&source.path)?,
        };
        known.insert(source.path, codes.clone());
        if codes.is_empty() {
            continue;
        }
        if !settings.force {
            return Err(part.refused(PartFault::Fails { codes }));
        }
        distrusted.insert(part.id.text.clone());
    }
    Ok(distrusted)
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
    let place = std::env::temp_dir();
    let workplace =
        Temporary::begin(&place, "combined").map_err(|error| unwritable(&place, error))?;
    let mut notes = Vec::new();
    let parts = load_parts(recipe, workplace.path(), settings)?;
    note_parts(&parts, &mut notes);
    let holders = compose::holders(recipe, &parts)?;
    let repeated = compose::check_names(recipe, &parts)?;
    let (edits, skipped_reasons) = decisions::skips(recipe, &parts, &mut notes)?;
    let configurations = decisions::configurations(recipe, &parts, &mut notes)?;

    let [folder, store] = ["whole", "store"].map(|name| workplace.path().join(name));
    for folder in [&folder, &store] {
        std::fs::create_dir_all(folder).map_err(|error| unwritable(folder, error))?;
    }
    let mut files = Meshes::new(store, &settings.source.cancellation);
    let mut placed = Vec::new();
    for member in &parts {
        placed.push(files.add(member.part, &member.loaded, &used_meshes(member))?);
    }
    let shared = files.write(&folder)?;

    let quaternions = has_quaternions(compose::version(&parts).as_deref());
    let (mut rewritten, mut length) = (Vec::new(), 0);
    for ((member, placed), repeated) in parts.iter().zip(placed).zip(&repeated) {
        settings.source.cancellation.check()?;
        let carried = placed.into_iter();
        let carried = carried.map(|(name, place)| (name, part::carried(&place, &shared)));
        let text = Rewrite {
            loaded: &member.loaded,
            trim: &member.trim,
            prefix: &member.part.prefix.text,
            names: &name_places(recipe, member.part)?,
            meshes: &carried.collect::<BTreeMap<_, _>>(),
            repeated_materials: repeated,
            quaternions,
        };
        let text = text.run().map_err(internal)?;
        note_text(member, &text, &mut notes);
        length += text.inner.len();
        recipe.check_length(member.part, "the URDFs", length)?;
        rewritten.push(text);
    }
    let urdf = compose::urdf(recipe, &parts, &holders, &rewritten)?;
    settings.source.cancellation.check()?;
    let robot = read_urdf(urdf.as_bytes(), &recipe.name.text)
        .map_err(|error| CombineError::Generate { id: None, error: error.into() })?;
    let composition = compose::composition(recipe, &parts, &holders, &robot.robot);

    let mut settings = settings.clone();
    let mut reused = BTreeSet::new();
    let trusted = parts.iter().filter(|member| {
        let is_trusted = member.is_urdd() && !distrusted.contains(&member.part.id.text);
        is_trusted && reused.insert(Rc::as_ptr(&member.loaded))
    });
    settings.donors = trusted.map(|member| member.loaded.root.clone()).collect();
    let given = GivenDecisions {
        edits: &edits,
        configurations: &configurations,
        skipped_reasons: skipped_reasons.as_ref(),
        composition: Some(&composition),
        origin: None,
    };
    let shown = format!("{}.urdf", recipe.name.text);
    let place = (shown.as_str(), folder.as_path());
    let generated = generate_composed(urdf.into_bytes(), place, given, target, &settings, progress);
    let mut generated = generated.map_err(|error| CombineError::Generate { id: None, error })?;
    // The notes about the parts already say that.
    generated.notes.retain(|note| note.kind != NoteKind::MeshNotFound);
    Ok(Combined { generated, composition, notes })
}

/// Reads the parts, each source once, and checks the size limits of a robot.
fn load_parts<'a>(
    recipe: &'a Recipe,
    workplace: &Path,
    settings: &Settings,
) -> Result<Vec<Member<'a>>> {
    let mut parts = Vec::new();
    let mut known: BTreeMap<PathBuf, Rc<part::Loaded>> = BTreeMap::new();
    let (mut links, mut length, mut composition_length) = (0, 0, 0);
    for (idx, part) in recipe.parts.iter().enumerate() {
        settings.source.cancellation.check()?;
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
        links += trim.dropped_links.iter().filter(|with| with.is_none()).count();
        if links > MOST_LINKS {
            return Err(recipe.too_many_links(&part.id, links));
        }
        length += loaded.text.len();
        recipe.check_length(part, "the URDFs", length)?;
        composition_length += loaded.composition_length;
        recipe.check_length(part, "the composition modules", composition_length)?;
        parts.push(Member { part, loaded, trim });
    }
    Ok(parts)
}

fn used_meshes(member: &Member) -> BTreeSet<String> {
    let named = named(&member.loaded.robot).into_iter();
    let used = named.filter(|mesh| member.trim.keeps_link(mesh.link));
    used.map(|mesh| mesh.filename.to_owned()).collect()
}

fn textures(member: &Member) -> BTreeSet<String> {
    let visuals = member.kept_links().flat_map(|link| &link.visual);
    let own = visuals.filter_map(|visual| visual.material.as_ref());
    let materials = own.chain(&member.loaded.robot.materials);
    let textures = materials.filter_map(|material| material.texture.as_ref());
    textures.map(|texture| texture.filename.clone()).collect()
}

/// The recipe's `names` of a part: other elements and attributes that name links and joints.
fn name_places<'a>(recipe: &Recipe, part: &'a recipe::Part) -> Result<BTreeSet<&'a str>> {
    let mut places = BTreeSet::new();
    for word in &part.names {
        let mut words = word.text.split('@');
        let is_word = |word: Option<&str>| word.is_none_or(|word| !word.trim().is_empty());
        let fits = is_word(words.next()) && is_word(words.next()) && words.next().is_none();
        if !fits {
            let fault = format!(
                "`{}` does not say where links and joints are named; write `element` for its text, or `element@attribute`",
                word.text
            );
            return Err(recipe.refused(word, fault));
        }
        places.insert(word.text.as_str());
    }
    Ok(places)
}

fn note_parts(parts: &[Member], notes: &mut Vec<Note>) {
    let urdds = parts.iter().filter(|member| member.is_urdd());
    let all: BTreeSet<&String> = urdds.flat_map(|member| &member.loaded.modules).collect();
    for member in parts {
        let mut note = |kind, text| notes.push(Note::of_part(kind, &member.part.id.text, text));
        for of_part in &member.loaded.notes {
            note(of_part.kind.as_str(), of_part.to_string());
        }
        for link in &member.loaded.plain_meshes {
            let idx = member.loaded.links.get(link);
            if idx.is_some_and(|idx| member.trim.keeps_link(*idx)) {
                let text = format!(
                    "its URDD lacks the original mesh of link `{link}`; the plain mesh is used, without colours"
                );
                note("plain-mesh", text);
            }
        }
        for joint in &member.trim.following {
            let text = format!(
                "joint `{joint}` mimics a frozen joint, and is frozen at the position that follows"
            );
            note("following", text);
        }
        // URDDs store the textures of meshes, not those of materials.
        for name in textures(member) {
            let text = format!(
                "texture `{name}` of a material is not carried; its name is unchanged, and the file stays where it is"
            );
            note("texture", text);
        }
        let has_loops = member.loaded.modules.iter().any(|module| module == "loops_module");
        if has_loops && !["<loop", "<coupling"].iter().any(|tag| member.loaded.text.contains(tag)) {
            let text = "its loops are not in its URDF, so they are left out: say them in a file of the combined robot, `--loops FILE`";
            note("loops", text.to_owned());
        }
        if member.loaded.given_spheres > 0 {
            let text = format!(
                "its {} given spheres are left out: import them into the combined robot, `urdd spheres import`",
                member.loaded.given_spheres
            );
            note("given-spheres", text);
        }
        if !member.is_urdd() {
            continue;
        }
        for name in used_meshes(member) {
            if !member.loaded.meshes.contains_key(&name) {
                let text = format!(
                    "its URDD has no file for mesh `{name}`: not carried; the element has no surface"
                );
                note("mesh-not-found", text);
            }
        }
        let lacks = |name: &&str| {
            let is_name = |module: &String| module == name;
            let is_there = member.loaded.modules.iter().any(is_name);
            !is_there && all.iter().any(|module| is_name(module)) && !OF_PEOPLE.contains(name)
        };
        let lacking: Vec<&str> =
            ModuleKind::ALL.iter().map(|kind| kind.name()).filter(lacks).collect();
        if !lacking.is_empty() {
            let lacking = lacking.join(", ");
            note(
                "unequal-modules",
                format!("it has no {lacking}, which other parts have; it is computed"),
            );
        }
    }
}

fn note_text(member: &Member, text: &Rewritten, notes: &mut Vec<Note>) {
    let mut note = |kind, text| notes.push(Note::of_part(kind, &member.part.id.text, text));
    let is_renamed = !member.part.prefix.text.is_empty();
    for LeftAlone { place, name } in text.left_alone.iter().filter(|_| is_renamed) {
        let text = format!(
            "`{place}` contains `{name}`, the name of a link or joint, and was left unchanged; if it refers to that, write names = [\"{place}\"]"
        );
        note("left-alone", text);
    }
    for what in &text.removed {
        note("gone", format!("left out {what}"));
    }
}
