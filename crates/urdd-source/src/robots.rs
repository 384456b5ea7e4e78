//! Finds the robot descriptions of paths and folders, and names them.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use thiserror::Error;
use urdd_directory::account::Account;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::file_type::FileType;
use urdd_directory::limits::MAX_FOLDER_DEPTH;
use urdd_format::escape;
use urdd_format::readable::first_of;
use urdd_format::short::Short;

use crate::checked_in;
use crate::described::{Description, FileKind, Reason, describe};
use crate::error::SourceError;
use crate::fault::Fault;
use crate::files::Files;
use crate::folder_facts::FolderFacts;
use crate::format::{RobotFile, by_content, parts_of_others};
use crate::job_names;
use crate::packages::IGNORED;
use crate::settings::{Declared, Settings, files_below};

/// A robot of a batch.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Job {
    /// The URDF or xacro file.
    pub source: PathBuf,
    /// The name of its URDD, unique in the batch regardless of case.
    pub name: String,
    /// Arguments for xacro that are declared of it, each as `name:=value`.
    pub arguments: Vec<String>,
    /// The packages in the folders that were searched, by name.
    pub packages: Arc<BTreeMap<String, PathBuf>>,
    /// What the batch knows of the folders around its robots.
    pub facts: Option<FolderFacts>,
}

impl Job {
    /// A robot that nobody declares.
    pub fn new(source: PathBuf, name: String) -> Self {
        Job { source, name, arguments: Vec::new(), packages: Arc::default(), facts: None }
    }

    /// The settings to read it with: those of a run of its own.
    pub fn settings(&self, all: &Settings) -> Settings {
        let mut settings = all.with_declared(&self.arguments);
        settings.facts.clone_from(&self.facts);
        settings.account = Some(Account::new(&all.cancellation));
        let packages = self.packages.iter().map(|(name, folder)| (name.clone(), folder.clone()));
        settings.packages.know(packages);
        settings
    }
}

/// Why a batch could not be set up.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum BatchError {
    #[error("{path}: no such file or folder")]
    Missing { path: String },
    #[error("{path}: the folder cannot be searched: {reason}")]
    Unreadable { path: String, reason: String },
    #[error(
        "{path}: folders more than {MAX_FOLDER_DEPTH} levels deep are not searched; give this folder itself"
    )]
    TooDeep { path: String },
    #[error(
        "{path}: there is no .urdf or .xacro file, and no MJCF, SDF or USD of a robot, at any depth"
    )]
    Empty { path: String },
    #[error(
        "{path}: there is no .urdf or .xacro file, and no MJCF, SDF or USD of a robot, but in folders that colcon passes over too: `{folder}` has a file `{mark}`; give that folder itself"
    )]
    Ignored { path: String, folder: String, mark: &'static str },
    #[error(
        "{path}: there is no robot; each file there defines macros or other parts for files that include it (number of files: {files})"
    )]
    OnlyParts { path: String, files: usize },
    #[error(
        "{path}: this is a URDD, or has only URDDs in it: `urdd validate` checks these; here, give the URDF, xacro, MJCF, SDF or USD file that it was made of"
    )]
    Urdd { path: String },
}

/// Whether these paths form a batch: several paths, or a folder.
pub fn is_batch(paths: &[PathBuf]) -> bool {
    paths.len() > 1 || paths.iter().any(|path| path.is_dir())
}

/// The robots of paths, and what else is there.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Batch {
    /// The robots.
    pub jobs: Vec<Job>,
    /// What the URDFs and xacro files of the folders are.
    pub description: Description,
    /// The packages in the folders, by name. Of two with one name, the first counts.
    pub packages: BTreeMap<String, Vec<PathBuf>>,
    /// The files that a person names or declares, with symbolic links resolved: each is to be a robot.
    pub wanted: BTreeSet<PathBuf>,
    /// The SRDFs in the folders.
    pub srdfs: Vec<PathBuf>,
    /// The xacro files with a `.urdf` of their name beside them, which is the robot of a batch; nobody names or declares these.
    pub checked_in: Vec<Job>,
}

const MAX_NAMED: usize = 5;

impl Batch {
    /// Whether a file may turn out to be a part of robots: nobody names it, and nobody declares it.
    pub fn may_drop(&self, source: &Path) -> bool {
        !self.wanted.contains(&resolved(source))
    }

    /// Whether an error says that a file in a folder is a part of robots after all: the expansion of a xacro file has no link;
    /// or another file includes it, and it has no link, no name, no expansion by itself, or one that is no whole tree.
    pub fn is_part(&self, source: &Path, error: &SourceError) -> bool {
        let is_xacro = FileType::Xacro.is_of(source);
        let is_included = self.description.may_be_part(source);
        let is_of_part = |fault: &Fault| match fault {
            Fault::NoLinks | Fault::OnlyMacros | Fault::IsSrdf => is_xacro || is_included,
            Fault::MissingAttribute { element: "robot", .. } => is_included,
            Fault::UnknownLink { .. } | Fault::ManyRoots { .. } => is_xacro && is_included,
            _ => false,
        };
        self.may_drop(source)
            && match error {
                SourceError::Refused { faults, .. } => {
                    faults.iter().any(|one| is_of_part(&one.fault))
                }
                SourceError::Xacro { .. } => is_included,
                _ => false,
            }
    }

    /// What a person may want to know, and nothing fails for: parts of robots, macros that nothing calls, and packages of
    /// one name. `more` are files of which only their expansion said that they have no robot.
    pub fn asides(&self, more: usize) -> Vec<String> {
        let files = &self.description.files;
        let of = |kind: FileKind| files.iter().filter(|file| file.kind == kind).count();
        let mut lines = Vec::new();
        let counted = |count: usize, one: &str, several: &str| match count {
            0 => None,
            1 => Some(format!("1 file {one}")),
            _ => Some(format!("{count} files {several}")),
        };
        let parts = of(FileKind::Fragment) + more;
        lines.extend(counted(
            parts,
            "defines macros or other parts, and no robot",
            "define macros or other parts, and no robot",
        ));
        lines.extend(counted(of(FileKind::Neither(Reason::Srdf)), "makes an SRDF", "make SRDFs"));
        let uncalled = &self.description.uncalled;
        let named = uncalled.iter().map(|(file, one)| {
            format!("`{}` ({}:{})", Short::of(&one.name), file.display(), one.line)
        });
        if !uncalled.is_empty() {
            lines.push(format!("no robot here calls the macro {}", first_of(named, MAX_NAMED)));
        }
        for (name, folders) in self.packages.iter().filter(|(_, folders)| folders.len() > 1) {
            let all: Vec<String> =
                folders.iter().take(MAX_NAMED).map(|folder| folder.display().to_string()).collect();
            let name = Short::of(name);
            lines.push(format!(
                "{} packages are named `{name}`: {}; the first counts, or --package {name}=FOLDER",
                folders.len(),
                all.join(", ")
            ));
        }
        lines.iter().map(|line| escape::line(line).to_string()).collect()
    }
}

/// Finds the robots. A file is used as given. A folder is searched for every `.urdf`, and for every `.xacro` that is a
/// robot and without a `.urdf` of its name beside it; one without these, for every SDF, for every MJCF or USD that is no
/// part of another, and for URDFs by their content. The search skips hidden folders, those that colcon skips (`COLCON_IGNORE`), symbolic links to folders, and URDDs,
/// which contain copies of their URDFs. Duplicate paths count once.
///
/// Each robot is named after its file, without the extension. Where names collide, as many parent folder names as
/// necessary are prepended, joined by `-`. If they still collide, a number is appended.
///
/// # Errors
/// If a path does not exist, or a folder cannot be searched or has no description. There may be parts of robots alone.
pub fn find(paths: &[PathBuf], settings: &Settings) -> Result<Batch, BatchError> {
    let (mut sources, mut listed, mut batch) = (Vec::new(), Vec::new(), Batch::default());
    let mut beside = Vec::new();
    let facts = FolderFacts::new(&settings.files);
    let settings = &Settings { facts: Some(facts.clone()), ..settings.clone() };
    batch.wanted.extend(settings.robots.iter().map(|robot| resolved(&robot.source)));
    for path in paths {
        let shown = path.display().to_string();
        let metadata =
            fs::metadata(path).map_err(|_| BatchError::Missing { path: shown.clone() })?;
        if !metadata.is_dir() {
            sources.push(path.clone());
            batch.wanted.insert(resolved(path));
            continue;
        }
        let mut found = Found::default();
        search(path, 0, &facts, &mut found)?;
        found.urdfs.extend(files_below(path, &settings.robots));
        if found.urdfs.is_empty() {
            let others = others(found.others, &settings.run_account());
            if others.is_empty() {
                return Err(match (found.has_urdd, found.ignored) {
                    (true, _) => BatchError::Urdd { path: shown },
                    (false, Some((folder, mark))) => {
                        let folder = folder.display().to_string();
                        BatchError::Ignored { path: shown, folder, mark }
                    }
                    (false, None) => BatchError::Empty { path: shown },
                });
            }
            sources.extend(others);
        }
        sources.extend(found.urdfs.iter().cloned());
        listed.append(&mut found.urdfs);
        listed.extend(found.checked_in.iter().cloned());
        beside.append(&mut found.checked_in);
        batch.srdfs.append(&mut found.srdfs);
        for (name, folder) in found.packages {
            batch.packages.entry(name).or_default().push(folder);
        }
    }
    let first = batch.packages.iter().filter_map(|(name, all)| Some((name.clone(), all.first()?)));
    let packages = first.map(|(name, folder)| (name, folder.clone())).collect();
    batch.description = describe(&listed, &packages, settings);
    let is_passed = |kind: &FileKind| match kind {
        FileKind::Robot | FileKind::Neither(Reason::Unreadable(_)) => false,
        FileKind::Fragment | FileKind::Neither(Reason::Srdf | Reason::Root(_)) => true,
    };
    let passed = batch.description.files.iter().filter(|file| is_passed(&file.kind));
    let passed: BTreeSet<&PathBuf> = passed.map(|file| &file.path).collect();
    let mut seen = BTreeSet::new();
    sources.retain(|path| {
        let place = resolved(path);
        let is_robot = !passed.contains(path) || batch.wanted.contains(&place);
        seen.insert(place) && is_robot
    });
    beside.retain(|path| !passed.contains(path) && seen.insert(resolved(path)));
    let named_paths: BTreeSet<&PathBuf> = paths.iter().collect();
    let mut declared: HashMap<PathBuf, Vec<&Declared>> = HashMap::new();
    for robot in settings.robots.iter() {
        declared.entry(resolved(&robot.source)).or_default().push(robot);
    }
    let robots = sources.into_iter().flat_map(|source| {
        // Arguments on the command line make a robot of their own.
        let is_own = named_paths.contains(&source) && !settings.xacro.arguments.is_empty();
        match declared.get(&resolved(&source)).filter(|_| !is_own) {
            Some(all) => {
                let with_path =
                    |one: &&Declared| Declared { source: source.clone(), ..(*one).clone() };
                all.iter().map(with_path).collect()
            }
            None => vec![source.into()],
        }
    });
    batch.jobs = named(robots.collect());
    batch.checked_in = named(beside.into_iter().map(Declared::from).collect());
    let packages = packages.into_iter().map(|(name, folder)| (name, resolved(&folder)));
    let packages: Arc<BTreeMap<String, PathBuf>> = Arc::new(packages.collect());
    for job in batch.jobs.iter_mut().chain(&mut batch.checked_in) {
        (job.packages, job.facts) = (Arc::clone(&packages), Some(facts.clone()));
    }
    Ok(batch)
}

fn resolved(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}

/// As [`find`], where there is a robot.
///
/// # Errors
/// As there, and if there are parts of robots alone.
pub fn found(paths: &[PathBuf], settings: &Settings) -> Result<Batch, BatchError> {
    let batch = find(paths, settings)?;
    match (paths, batch.jobs.is_empty()) {
        ([path, ..], true) => Err(BatchError::OnlyParts {
            path: path.display().to_string(),
            files: batch.description.files.len(),
        }),
        _ => Ok(batch),
    }
}

/// The robots that [`found`] finds.
///
/// # Errors
/// As there.
pub fn jobs(paths: &[PathBuf], settings: &Settings) -> Result<Vec<Job>, BatchError> {
    Ok(found(paths, settings)?.jobs)
}

/// Names each robot as [`jobs`] does.
pub(crate) fn named(robots: Vec<Declared>) -> Vec<Job> {
    let names = job_names::names(&robots);
    let job = |(robot, name): (Declared, String)| Job {
        arguments: robot.arguments,
        ..Job::new(robot.source, name)
    };
    robots.into_iter().zip(names).map(job).collect()
}

#[derive(Default)]
struct Found {
    /// URDFs and xacro files.
    urdfs: Vec<PathBuf>,
    /// Xacro files with a `.urdf` of their name beside them.
    checked_in: Vec<PathBuf>,
    srdfs: Vec<PathBuf>,
    /// Packages, by name.
    packages: Vec<(String, PathBuf)>,
    /// What may be of another format.
    others: Vec<PathBuf>,
    has_urdd: bool,
    /// The first folder that is passed over for a file in it, and that file's name.
    ignored: Option<(PathBuf, &'static str)>,
}

/// The descriptions among files whose names do not say it, without those that are parts of others.
fn others(files: Vec<PathBuf>, account: &Account) -> Vec<PathBuf> {
    let is = |file: PathBuf| Some((by_content(&file, &Files::Disk)?, file));
    let found: Vec<(RobotFile, PathBuf)> = files.into_iter().filter_map(is).collect();
    let all = found.iter().map(|(is, file)| (file.as_path(), *is));
    let parts = parts_of_others(all, &Files::Disk, account);
    let mut files: Vec<PathBuf> = found.into_iter().map(|(_, file)| file).collect();
    files.retain(|file| !file.canonicalize().is_ok_and(|file| parts.contains(&file)));
    files
}

fn search(
    folder: &Path,
    depth: usize,
    facts: &FolderFacts,
    found: &mut Found,
) -> Result<(), BatchError> {
    let unreadable = |error: std::io::Error| BatchError::Unreadable {
        path: folder.display().to_string(),
        reason: error.to_string(),
    };
    let has = |name: &str| folder.join(name).is_file();
    if has(ROOT_METADATA) {
        found.has_urdd = true;
        return Ok(());
    }
    if let Some(mark) = IGNORED.into_iter().find(|name| depth > 0 && has(name)) {
        found.ignored.get_or_insert_with(|| (folder.to_owned(), mark));
        return Ok(());
    }
    if let Some(name) = facts.package_name(folder) {
        found.packages.push((name.to_string(), folder.to_owned()));
    }
    if depth > MAX_FOLDER_DEPTH {
        let path = folder.display().to_string();
        return Err(BatchError::TooDeep { path });
    }
    let mut entries = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        entries.push((entry.file_name().to_string_lossy().into_owned(), entry.path(), is_folder));
    }
    entries.sort();
    for (name, path, is_folder) in entries {
        if is_folder {
            if !name.starts_with('.') {
                search(&path, depth + 1, facts, found)?;
            }
            continue;
        }
        match FileType::of(&path) {
            Some(FileType::Urdf) => found.urdfs.push(path),
            Some(FileType::Xacro) if checked_in::urdf_of(&path).is_file() => {
                found.checked_in.push(path)
            }
            Some(FileType::Xacro) => found.urdfs.push(path),
            Some(FileType::Xml | FileType::Sdf | FileType::Mjcf | FileType::Usd) => {
                found.others.push(path);
            }
            Some(FileType::Srdf) => found.srdfs.push(path),
            Some(FileType::Archive | FileType::Document) | None => {}
        }
    }
    Ok(())
}
