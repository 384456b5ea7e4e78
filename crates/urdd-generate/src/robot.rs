//! Generates the URDD of one robot.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::carry_over::{carry_over, extensions};
use super::composed::Composed;
use super::edits::{self, Decisions};
use super::error::GenerateError;
use super::made::{Content, Made};
use super::meshes::MeshCount;
use super::metadata::{self, Entry};
use super::note::Note;
use super::old::Old;
use super::progress::Progress;
use super::reuse::Reusable;
use super::settings::Settings;
use super::size;
use super::source::{self, Source};
use super::stages::{self, Make, Stage};
use super::work::Work;
use urdd_directory::canonical;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::path::portable;
use urdd_directory::staging::{Staging, StagingError};
use urdd_directory::writer::Writer;
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::{ConformanceClass, FileEntry};

/// Sizes and hashes refer to bytes: Git must not convert line endings.
const GIT_ATTRIBUTES: &str = "# The hashes in urdd.json are of these very bytes.\n* -text\n";
const GIT_ATTRIBUTES_FILE: &str = ".gitattributes";

/// A generated URDD.
#[derive(Debug, Clone, PartialEq)]
pub struct Generated {
    /// Name of the robot.
    pub robot_name: String,
    /// Number of links.
    pub num_links: usize,
    /// Number of joints.
    pub num_joints: usize,
    /// Number of DOFs.
    pub num_dofs: usize,
    /// The conformance class that it claims.
    pub class: ConformanceClass,
    /// Its modules.
    pub modules: Vec<MadeModule>,
    /// Whether it differs from the old URDD. If not, nothing was written.
    pub changed: bool,
    /// How the mesh references were resolved; empty if no meshes were selected.
    pub meshes: MeshCount,
    /// Deviations in the source, and how they were interpreted.
    pub notes: Vec<Note>,
}

/// A module of a generated URDD.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MadeModule {
    /// Which module.
    pub kind: ModuleKind,
    /// Whether it was kept from the old URDD because none of its inputs changed.
    pub kept: bool,
}

/// Generates the URDD of the URDF (or xacro file) `source` in the folder `target`. The folder is replaced atomically;
/// it is unchanged on error.
///
/// # Errors
/// If the source is not a valid robot, or the URDD cannot be generated or written.
pub fn generate(
    source: &Path,
    target: &Path,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Generated, GenerateError> {
    let path = source;
    let source = source::load(
        path,
        &settings.xacro,
        &settings.packages,
        &settings.cancellation,
    )?;
    make(Some(path), &source, None, target, settings, progress)
}

/// Generates the URDD of a URDF in memory, such as from a pipe. Relative mesh file names refer to `folder`. Notes and
/// errors show `shown` in place of the file name.
///
/// # Errors
/// Those of [`generate`].
pub fn generate_text(
    urdf: Vec<u8>,
    shown: &str,
    folder: &Path,
    target: &Path,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Generated, GenerateError> {
    let source = source::load_text(urdf, shown, folder)?;
    make(None, &source, None, target, settings, progress)
}

/// Generates the URDD of a composed robot, as [`generate_text`] does for any robot. The URDF is
/// stored in it under the robot's name.
///
/// # Errors
/// Those of [`generate`].
pub fn generate_composed(
    urdf: Vec<u8>,
    composed: &Composed,
    target: &Path,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Generated, GenerateError> {
    let mut source = source::load_text(urdf, &composed.shown, &composed.folder)?;
    source.file_name = portable(&format!("{}.urdf", source.reading.robot.name));
    make(None, &source, Some(composed), target, settings, progress)
}

fn make(
    path: Option<&Path>,
    source: &Source,
    composed: Option<&Composed>,
    target: &Path,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Generated, GenerateError> {
    size::check(source)?;
    check_place(path, source, target)?;
    check_assumptions(&source.notes, settings)?;
    // From here on, no other run changes the target.
    let staging = Staging::begin(target, &settings.cancellation)?;
    let old = Old::read(target);
    let edits = match settings.drop_edits {
        true => Decisions::default(),
        false => edits::read(target, &settings.selection, old.as_ref())?,
    };
    let edits = match composed {
        Some(composed) => composed.decisions(old.as_ref(), edits),
        None => edits,
    };
    check_target(target, old.as_ref(), settings)?;
    let writer = Writer::new(staging.content());

    let mut work = Work::new(source, settings, staging.content(), edits)?;
    work.reusable = Reusable::of(&settings.reuse, &stages::settings_texts(&work));
    work.progress = progress;
    work.composition = composed.map(|composed| &composed.composition);
    let of_parts = composed.map(|_| ModuleKind::Composition);
    let kinds: BTreeSet<ModuleKind> = settings.selection.kinds().chain(of_parts).collect();
    let stages: Vec<&Stage> = kinds.into_iter().filter_map(stages::of).collect();
    let (mut entries, mut modules) = (Vec::new(), Vec::new());
    for (done, stage) in stages.iter().enumerate() {
        settings.cancellation.check()?;
        progress.module(stage.kind, done, stages.len());
        let made = run(stage, &mut work, &writer, old.as_ref(), &entries)?;
        check_assumptions(&work.notes, settings)?;
        let Some((entry, kept)) = made else {
            continue;
        };
        let files = entry.module.files.iter();
        work.digests
            .extend(files.map(|file| (file.path.clone(), file.sha256.as_str().to_owned())));
        entries.push(entry);
        modules.push(MadeModule {
            kind: stage.kind,
            kept,
        });
    }
    let num_dofs = work.dof.dofs.len();
    let meshes = work.original.as_ref().map(|original| original.count);
    let mut notes = source.notes.clone();
    notes.append(&mut work.notes);

    let carried = writer.file(&source.file_name, &source.carried)?;
    let found_name = format!("{}.as-found", source.file_name);
    let found = source
        .found
        .as_deref()
        .map(|bytes| writer.file(&found_name, bytes));
    if target.is_dir() {
        carry_over(target, old.as_ref(), staging.content())?;
    }
    if !staging.content().join(GIT_ATTRIBUTES_FILE).exists() {
        writer.file(GIT_ATTRIBUTES_FILE, GIT_ATTRIBUTES.as_bytes())?;
    }
    let robot = &source.reading.robot;
    let class = metadata::class(&entries);
    let document = metadata::document(
        &robot.name,
        carried,
        found.transpose()?,
        entries,
        extensions(old.as_ref(), staging.content()),
    )?;
    let text = canonical::json_string(&document);
    writer.file(ROOT_METADATA, text.as_bytes())?;
    let changed = !old
        .as_ref()
        .is_some_and(|old| is_same(old, &text, &modules));
    settings.cancellation.check()?;
    if changed {
        staging.commit()?;
    }
    Ok(Generated {
        robot_name: robot.name.clone(),
        num_links: robot.links.len(),
        num_joints: robot.joints.len(),
        num_dofs,
        class,
        modules,
        changed,
        meshes: meshes.unwrap_or_default(),
        notes,
    })
}

/// Returns an error if something was assumed and the settings are strict.
fn check_assumptions(notes: &[Note], settings: &Settings) -> Result<(), GenerateError> {
    let notes = notes.iter().filter(|note| note.kind.changes_robot());
    let notes: Vec<Note> = notes.filter(|_| settings.strict).cloned().collect();
    match notes.is_empty() {
        true => Ok(()),
        false => Err(GenerateError::Strict { notes }),
    }
}

/// Checks that the source is outside the target.
fn check_place(path: Option<&Path>, source: &Source, target: &Path) -> Result<(), GenerateError> {
    let Ok(canonical) = target.canonicalize() else {
        return Ok(());
    };
    let path = path.and_then(|path| path.canonicalize().ok());
    if path.is_some_and(|path| path.starts_with(&canonical)) {
        return Err(GenerateError::SourceInTarget {
            file: source.shown.clone(),
            target: target.to_owned(),
        });
    }
    Ok(())
}

/// Checks that the content of the target may be replaced.
fn check_target(
    target: &Path,
    old: Option<&Old>,
    settings: &Settings,
) -> Result<(), GenerateError> {
    let Ok(canonical) = target.canonicalize() else {
        return Ok(());
    };
    let is_empty = fs::read_dir(&canonical).is_ok_and(|mut entries| entries.next().is_none());
    let is_free = is_empty || old.is_some_and(Old::is_ours) || !canonical.is_dir();
    if !is_free && !settings.force {
        let path = target.to_owned();
        return Err(StagingError::Occupied { path }.into());
    }
    Ok(())
}

/// Builds a module or keeps the old one; `None` if it is of no use. The flag is true for a kept module.
fn run(
    stage: &Stage,
    work: &mut Work,
    writer: &Writer,
    old: Option<&Old>,
    entries: &[Entry],
) -> Result<Option<(Entry, bool)>, GenerateError> {
    let kind = stage.kind;
    let inputs = stage
        .reuse
        .inputs(work)
        .map(|text| metadata::inputs(kind, &text, entries));
    if let (Some(old), Some(inputs)) = (old, &inputs)
        && let Some(files) = old.kept(kind, metadata::MODULE_VERSION, inputs)
    {
        for file in files {
            writer.keep(&old.folder.join(&file.path), &file.path)?;
        }
        let entry = metadata::entry(kind, files.to_vec(), Some(inputs.clone()));
        return Ok(Some((entry, true)));
    }
    let made = match stage.make {
        Make::Always(make) => Some(make(work)?),
        Make::WhereOfUse(make) => make(work)?,
    };
    let Some(Made { document, files }) = made else {
        return Ok(None);
    };
    let mut written: Vec<FileEntry> = writer.module(kind, metadata::MODULE_VERSION, &document)?;
    for file in files {
        written.push(match file.content {
            Content::Bytes(bytes) => writer.file(&file.path, &bytes)?,
            Content::Shared(bytes) => writer.file(&file.path, &bytes)?,
        });
    }
    Ok(Some((metadata::entry(kind, written, inputs), false)))
}

/// Whether the old URDD is identical to the byte: its metadata, and each file by its hash. The files of kept modules
/// were checked before.
fn is_same(old: &Old, text: &str, made: &[MadeModule]) -> bool {
    let path = old.folder.join(ROOT_METADATA);
    if fs::read(path).ok().as_deref() != Some(text.as_bytes()) {
        return false;
    }
    let source = match &old.metadata.source {
        Some(urdd_format::root_metadata::Source::Urdf(file)) => Some(file),
        _ => None,
    };
    let is_kept = |name: &str| made.iter().any(|of| of.kept && of.kind.name() == name);
    let modules = old.metadata.modules.iter();
    let files = modules
        .filter(|module| !is_kept(&module.name))
        .flat_map(|module| &module.files);
    files.chain(source).all(|file| old.is_intact(file))
}
