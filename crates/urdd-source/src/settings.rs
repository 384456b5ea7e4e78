//! How a description is found and read, and the robots that a person declares: xacro files with their arguments.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use urdd_directory::account::Account;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::range::{OutOfRange, Range};

use crate::files::Files;
use crate::folder_facts::FolderFacts;
use crate::packages::Packages;

/// How a description is found and read. By default, with only the packages around it, from the disk.
#[derive(Debug, Clone, Default)]
pub struct Settings {
    /// The folders of packages.
    pub packages: Packages,
    /// Folders, besides those of the robot and its packages, from which mesh files may be read.
    pub allowed_folders: Vec<PathBuf>,
    /// How xacro files are expanded.
    pub xacro: XacroSettings,
    /// What is chosen of a description that is no URDF.
    pub import: ImportOptions,
    /// The robots that are declared of files: of one in a folder, and of one that is named without arguments.
    pub robots: Arc<[Declared]>,
    /// The file that says what closes the robot's loops. By default the one beside the URDF.
    pub loops: Option<PathBuf>,
    /// Where files are.
    pub files: Files,
    /// The account of the run on one description, if it has several parts. By default each part has its own.
    pub account: Option<Account>,
    /// What the robots of one run know of the folders around them, each read once. By default each robot reads its own.
    pub facts: Option<FolderFacts>,
    /// Cancellation: each account of a run is asked for it.
    pub cancellation: Cancellation,
}

impl Settings {
    /// The account of the run; a new one, if each part of it has its own.
    pub fn run_account(&self) -> Account {
        self.account.clone().unwrap_or_else(|| Account::new(&self.cancellation))
    }

    /// The facts of the run, if they are of these files; else of folders that nobody has read.
    pub(crate) fn folder_facts(&self) -> FolderFacts {
        let shared = self.facts.as_ref().filter(|facts| facts.files().is_same(&self.files));
        shared.cloned().unwrap_or_else(|| FolderFacts::new(&self.files))
    }

    /// The settings with arguments for xacro that are declared of a file. Of two values of an argument, xacro takes the last.
    pub fn with_declared(&self, arguments: &[String]) -> Settings {
        let mut settings = self.clone();
        settings.xacro.arguments = arguments.iter().chain(&self.xacro.arguments).cloned().collect();
        settings.xacro.declared = arguments.len();
        settings
    }
}

/// How xacro files are expanded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct XacroSettings {
    /// Whether to expand a `.urdf` that contains macros; a `.xacro` is always expanded.
    pub expand_urdf: bool,
    /// Arguments for the file, each as `name:=value`.
    pub arguments: Vec<String>,
    /// How many of them, from the first, are declared of the file: it has to take these.
    pub declared: usize,
    /// Time limit of the program.
    pub time_limit: Duration,
}

/// [`XacroSettings::time_limit`], in seconds.
pub const XACRO_TIMEOUT: Range = Range::real("xacro_timeout", 0.001, 1e9, "seconds");

impl XacroSettings {
    /// A time limit in seconds.
    ///
    /// # Errors
    /// If it is out of the range of [`XACRO_TIMEOUT`].
    pub fn seconds(given: f64) -> Result<Duration, OutOfRange> {
        XACRO_TIMEOUT.check(given).map(Duration::from_secs_f64)
    }
}

impl Default for XacroSettings {
    /// Only `.xacro` files, without arguments, with a limit of one minute.
    fn default() -> Self {
        XacroSettings {
            expand_urdf: false,
            arguments: Vec::new(),
            declared: 0,
            time_limit: Duration::from_secs(60),
        }
    }
}

/// What a person can choose of an import.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ImportOptions {
    /// The body of an MJCF or USD that is the root of the robot. By default it is told by the structure.
    pub body: Option<String>,
    /// The model of an SDF. By default it is the only one.
    pub model: Option<String>,
    /// Whether a ball is written as three revolute joints.
    pub has_revolute_balls: bool,
    /// Whether links between the joints of one body get a tiny mass, which MuJoCo asks of what moves.
    pub has_tiny_masses: bool,
}

/// A robot that a person declares.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Declared {
    /// The URDF or xacro file.
    pub source: PathBuf,
    /// Its name, if it has another one than its file.
    pub name: Option<String>,
    /// Arguments for xacro, each as `name:=value`.
    pub arguments: Vec<String>,
}

impl From<PathBuf> for Declared {
    /// A file that nobody declares.
    fn from(source: PathBuf) -> Self {
        Declared { source, name: None, arguments: Vec::new() }
    }
}

/// The robots that are declared of a file, with its path as it is given; else the file itself.
pub fn robots_of(file: PathBuf, declared: &[Declared]) -> Vec<Declared> {
    let found = declared_of(&file, declared);
    if found.is_empty() { vec![file.into()] } else { found }
}

/// The robots that are declared of a file, with its path as it is given; none if none is.
pub fn declared_of(file: &Path, declared: &[Declared]) -> Vec<Declared> {
    let is_it = |one: &&Declared| is_same(&one.source, file);
    let with_path = |one: &Declared| Declared { source: file.to_owned(), ..one.clone() };
    declared.iter().filter(is_it).map(with_path).collect()
}

/// The files that are declared below a folder, by paths that begin with it as it is given.
pub fn files_below(folder: &Path, declared: &[Declared]) -> Vec<PathBuf> {
    let Ok(above) = folder.canonicalize() else { return Vec::new() };
    let inside = |one: &Declared| {
        let file = one.source.canonicalize().ok()?;
        Some(folder.join(file.strip_prefix(&above).ok()?))
    };
    declared.iter().filter_map(inside).collect()
}

/// Whether two paths lead to one file. Most have other names, and need no look at the disk.
fn is_same(one: &Path, other: &Path) -> bool {
    let is_one =
        || one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other));
    one == other || one.file_name() == other.file_name() && is_one()
}
