//! Generates the URDD of one robot.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use serde_json::Value;

use crate::context::Context;
use crate::donor::Donor;
use crate::donor::edits::Decisions;
use crate::error::{GenerateError, Result};
use crate::given::{GivenDecisions, write_setup};
use crate::meshes::MeshCount;
use crate::modules::{MadeModule, Modules, check_assumptions};
use crate::settings::{Progress, Settings};
use crate::{donor, metadata, stages};
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::root::Root;
use urdd_directory::source::Memory;
use urdd_directory::staging::{Staging, StagingError};
use urdd_directory::writer::Writer;
use urdd_directory::{canonical, regular};
use urdd_format::root_metadata::{self, ConformanceClass, FileEntry};
use urdd_import::{Imported, import};
use urdd_source::Source;
use urdd_source::fault::Fault;
use urdd_source::note::{Note, NoteKind};

/// Sizes and hashes refer to bytes: Git must not convert line endings.
const GIT_ATTRIBUTES: &str = "# The hashes in urdd.json are of these very bytes.\n* -text\n";
const GIT_ATTRIBUTES_FILE: &str = ".gitattributes";

/// Maximum number of links. The matrix of lowest common ancestors grows with its square.
pub const MOST_LINKS: usize = 2_000;

/// Maximum number of elements besides links and joints; 2,000 links have some 10,000.
const MOST_ELEMENTS: usize = 100_000;

/// The bytes of each file of a URDD, by path relative to its root.
pub type UrddFiles = BTreeMap<String, Arc<[u8]>>;

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
    let (imported, loaded, settings) = load(source, settings, progress)?;
    let given = imported.as_ref().map(GivenDecisions::from).unwrap_or_default();
    let mut made = make(Some(source), &loaded, given, target, &settings, progress)?;
    made.notes.extend(imported.and_then(|imported| write_setup(&imported, target)));
    Ok(made)
}

/// A source, what was imported if it is no URDF, and settings by which its files are found.
fn load(
    path: &Path,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<(Option<Imported>, Source, Settings)> {
    progress.reads(path);
    let Some(imported) = import(path, &settings.source)? else {
        let source = urdd_source::load(path, &settings.source)?;
        return Ok((None, source, settings.clone()));
    };
    imported.read.iter().for_each(|file| progress.reads(file));
    let settings = Settings { source: imported.settings(&settings.source)?, ..settings.clone() };
    let mut source = imported.load(&settings.source)?;
    source.notes.extend(imported.report.notes(&imported.shown));
    source.shown = format!("{} (as {})", imported.shown, imported.urdf);
    Ok((Some(imported), source, settings))
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
    let source = urdd_source::load_text(urdf, shown, folder, &settings.source)?;
    make(None, &source, GivenDecisions::default(), target, settings, progress)
}

/// As [`generate_text`], for a robot composed of those that give `given`. The URDF is stored under the robot's name.
pub(crate) fn generate_composed(
    urdf: Vec<u8>,
    (shown, folder): (&str, &Path),
    given: GivenDecisions,
    target: &Path,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Generated> {
    let mut source = urdd_source::load_text(urdf, shown, folder, &settings.source)?;
    // No hidden file, and no option of a command.
    let name = source.reading.robot.name.trim_start_matches(['.', '-']);
    source.file_name = urdd_source::file_name(name);
    make(None, &source, given, target, settings, progress)
}

/// Generates the URDD of a URDF in memory, where [`Settings::source`] says that its files are: nothing is written to the
/// disk, and no URDD is replaced.
///
/// # Errors
/// Those of [`generate`].
pub fn generate_in_memory(
    source: &Path,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<(Generated, UrddFiles), GenerateError> {
    let (imported, source, settings) = load(source, settings, progress)?;
    check_size(&source)?;
    check_assumptions(&source.notes, &settings)?;
    let given = imported.as_ref().map(GivenDecisions::from).unwrap_or_default();
    let decisions = given.decisions(true, Decisions::default());
    let context = Context::new(&source, &settings, None, decisions, progress)?;
    check_assumptions(&context.loop_notes, &settings)?;
    let files = Memory::default();
    let writer = Writer::in_memory(files.clone());
    let written = write(&context, None, &writer, Root::of(files.clone()))?;
    writer.file(GIT_ATTRIBUTES_FILE, GIT_ATTRIBUTES.as_bytes())?;
    let text = written.metadata(&source.reading.robot.name, given.origin, Vec::new())?;
    writer.file(ROOT_METADATA, text.as_bytes())?;
    Ok((written.generated(&context, true), files.files()))
}

struct Written {
    entries: Vec<metadata::Entry>,
    made: Vec<MadeModule>,
    meshes: MeshCount,
    notes: Vec<Note>,
    carried: FileEntry,
    found: Option<FileEntry>,
}

fn write(
    context: &Context,
    replaced: Option<&Donor>,
    writer: &Writer,
    root: Root,
) -> Result<Written> {
    let source = context.source;
    let mut modules = Modules::new(context, replaced, writer, root);
    let meshes = stages::run(context, &mut modules)?;
    let Modules { entries, made, notes, .. } = modules;
    let carried = writer.file(&source.file_name, &source.carried)?;
    let found_name = format!("{}.as-found", source.file_name);
    let found = source.found.as_deref().map(|bytes| writer.file(&found_name, bytes));
    Ok(Written { entries, made, meshes, notes, carried, found: found.transpose()? })
}

impl Written {
    fn metadata(
        &self,
        robot: &str,
        origin: Option<&Value>,
        extensions: Vec<Value>,
    ) -> Result<String> {
        let Written { carried, found, entries, .. } = self;
        let found = found.as_ref();
        let document = metadata::document(robot, carried, found, origin, entries, extensions)?;
        Ok(canonical::json_string(&document))
    }

    fn generated(self, context: &Context, changed: bool) -> Generated {
        let robot = &context.source.reading.robot;
        Generated {
            robot_name: robot.name.clone(),
            num_links: robot.links.len(),
            num_joints: robot.joints.len(),
            num_dofs: context.dof.dofs.len(),
            class: metadata::class(&self.entries),
            modules: self.made,
            changed,
            meshes: self.meshes,
            notes: [context.source.notes.clone(), self.notes].concat(),
        }
    }
}

fn make(
    path: Option<&Path>,
    source: &Source,
    given: GivenDecisions,
    target: &Path,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Generated> {
    check_size(source)?;
    check_place(path, source, target)?;
    check_assumptions(&source.notes, settings)?;
    // From here on, no other run changes the target.
    let staging = Staging::begin(target, &settings.source.cancellation)?;
    let donor = Root::open_folder(target).ok().and_then(Donor::open);
    let replaced = donor.as_ref();
    let decisions = match settings.drop_edits {
        true => Decisions::default(),
        false => Decisions::read(target, &settings.selection, replaced)?,
    };
    let decisions = given.decisions(replaced.is_none(), decisions);
    check_target(target, replaced, settings)?;

    let context = Context::new(source, settings, given.composition, decisions, progress)?;
    check_assumptions(&context.loop_notes, settings)?;
    let content = staging.content();
    let writer = Writer::new(content);
    let root = Root::open_folder(content)
        .map_err(|error| GenerateError::internal(&content.display().to_string(), error))?;
    let mut written = write(&context, replaced, &writer, root)?;
    if target.is_dir() {
        donor::carry_over(target, replaced, content)?;
        let kinds: Vec<_> = written.made.iter().map(|module| module.kind).collect();
        for kind in donor::left_behind(content, &kinds) {
            let file = target.join(kind.folder()).display().to_string();
            let problem = format!("files of yours are here, and `{}` is not made", kind.name());
            let assumed = "they stay, and `urdd validate` reports the folder (DIR003) until you move them away";
            let note = context.note(NoteKind::LeftBehind, problem, assumed);
            written.notes.push(Note { file, ..note });
        }
    }
    if !content.join(GIT_ATTRIBUTES_FILE).exists() {
        writer.file(GIT_ATTRIBUTES_FILE, GIT_ATTRIBUTES.as_bytes())?;
    }
    let extensions = donor::extensions(replaced, content);
    let text = written.metadata(&source.reading.robot.name, given.origin, extensions)?;
    writer.file(ROOT_METADATA, text.as_bytes())?;
    let changed = !replaced.is_some_and(|replaced| is_same(replaced, target, &text, &written.made));
    settings.source.cancellation.check()?;
    if changed {
        staging.commit()?;
    }
    Ok(written.generated(&context, changed))
}

/// Refuses a robot whose URDD would be too large for its readers.
fn check_size(source: &Source) -> Result<()> {
    let robot = &source.reading.robot;
    let links = robot.links.len();
    let shapes = robot
        .links
        .iter()
        .map(|link| link.visual.len() + link.collision.len() + link.unknown_elements.len());
    let of_joints = robot.joints.iter().map(|joint| joint.unknown_elements.len());
    let elements = shapes.chain(of_joints).sum::<usize>()
        + robot.materials.len()
        + robot.unknown_elements.len();
    let fault = if links > MOST_LINKS {
        Fault::TooManyLinks { found: links, limit: MOST_LINKS }
    } else if elements > MOST_ELEMENTS {
        Fault::TooManyElements { found: elements, limit: MOST_ELEMENTS }
    } else {
        return Ok(());
    };
    Err(source.refused(fault).into())
}

/// Checks that the source is outside the target.
fn check_place(path: Option<&Path>, source: &Source, target: &Path) -> Result<()> {
    let Ok(canonical) = target.canonicalize() else { return Ok(()) };
    let path = path.and_then(|path| path.canonicalize().ok());
    if path.is_some_and(|path| path.starts_with(&canonical)) {
        return Err(GenerateError::SourceInTarget {
            file: source.shown.clone(),
            target: target.to_owned(),
        });
    }
    Ok(())
}

fn check_target(target: &Path, replaced: Option<&Donor>, settings: &Settings) -> Result<()> {
    let Ok(canonical) = target.canonicalize() else { return Ok(()) };
    let is_empty = fs::read_dir(&canonical).is_ok_and(|mut entries| entries.next().is_none());
    let is_free = is_empty || replaced.is_some_and(Donor::is_ours) || !canonical.is_dir();
    if !is_free && !settings.force {
        return Err(StagingError::Occupied { path: target.to_owned() }.into());
    }
    Ok(())
}

/// Whether the replaced URDD is identical to the byte: its metadata, and each file by its hash. The files of kept modules
/// were checked before.
fn is_same(replaced: &Donor, target: &Path, text: &str, made: &[MadeModule]) -> bool {
    let there = regular::read(&target.join(ROOT_METADATA), text.len() as u64);
    if there.ok().as_deref() != Some(text.as_bytes()) {
        return false;
    }
    let source = match &replaced.metadata.source {
        Some(root_metadata::Source::Urdf(file)) => Some(file),
        _ => None,
    };
    let is_kept = |name: &str| made.iter().any(|of| of.kept && of.kind.name() == name);
    let modules = replaced.metadata.modules.iter();
    let files = modules.filter(|module| !is_kept(&module.name)).flat_map(|module| &module.files);
    files.chain(source).all(|file| replaced.is_intact(file))
}
