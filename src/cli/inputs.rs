//! Reads the files that commands are given: URDDs, SRDFs, and advice on those that are something else. Edits a module of a
//! URDD: reads the robot, asks for the changed files, and replaces them atomically.

use std::io::Read;
use std::path::{Path, PathBuf};

use clap::Args;

use super::arguments::{around, only_arguments};
use super::output::{self, Failure, about, one_line, shown};
use super::watch::Watch;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::{DiscoverError, ROOT_METADATA};
use urdd_directory::file_type::{FileType, Foreign, HEAD, foreign, is_archive};
use urdd_directory::limits::{MAX_DOCUMENT_BYTES, MAX_SRDF_BYTES};
use urdd_directory::listing::ReadError;
use urdd_directory::metadata::{Files, Replacement};
use urdd_directory::regular;
use urdd_directory::root::Root;

use urdd_format::escape;
use urdd_format::registry::ModuleKind;
use urdd_robot::Robot;
use urdd_source::{Format, RobotFile, Settings, XacroSettings, read_source};

/// Opens the robot of a URDD.
///
/// # Errors
/// A message with advice if it cannot be opened.
pub fn open(path: &Path) -> Result<Robot, Failure> {
    if path.is_file() && !is_archive(path) {
        let is_urdf = RobotFile::at(path) == Some(RobotFile::Urdf) && foreign_at(path).is_none();
        let path = path.display().to_string();
        if is_urdf {
            Err(format!(
                "{}: this is a URDF; generate a URDD from it first: urdd generate {} -o DIR",
                one_line(&path),
                escape::shell(&path)
            ))?;
        }
        Err(advice(&DiscoverError::NotAFolder { path }))?;
    }
    Ok(Robot::open(path).map_err(one_line)?)
}

/// What an import from an SRDF reads, and what it edits.
#[derive(Args)]
pub struct SrdfArguments {
    /// The SRDF; also one that is xacro (.srdf.xacro), which the program `xacro` expands.
    #[arg(value_name = "FILE.srdf")]
    pub srdf: PathBuf,

    /// The URDD: a folder.
    #[arg(value_name = "DIR")]
    pub urdd: PathBuf,

    /// An argument for xacro.
    #[arg(value_name = "NAME:=VALUE")]
    more: Vec<PathBuf>,
}

/// Prints what `work` makes of the text of an SRDF; of one that is xacro, of what xacro makes of it with these words of the
/// command line.
pub fn with_srdf(
    files: &SrdfArguments,
    watch: &Watch,
    work: impl FnOnce(&str) -> Result<String, Failure>,
) -> Result<u8, Failure> {
    watch.run_one(&files.urdd, None, |cancellation| {
        let text = srdf_or_xacro(files, cancellation)?;
        output::print(&work(&text)?)?;
        Ok(0)
    })
}

fn srdf_or_xacro(
    SrdfArguments { srdf: file, more, .. }: &SrdfArguments,
    cancellation: &Cancellation,
) -> Result<String, Failure> {
    let arguments = only_arguments(more)?;
    if !FileType::Xacro.is_of(file) {
        return match arguments.first() {
            None => srdf(file),
            Some(argument) => Err(format!(
                "{}: not a xacro file, so that `{}` has no meaning",
                shown(file),
                one_line(argument)
            ))?,
        };
    }
    let settings = Settings {
        xacro: XacroSettings { arguments, ..XacroSettings::default() },
        cancellation: cancellation.clone(),
        ..around()
    };
    Ok(read_source(file, &settings).map_err(one_line)?.text)
}

pub fn srdf(file: &Path) -> Result<String, Failure> {
    text(file, MAX_SRDF_BYTES)
}

/// The text of a file of at most `limit` bytes.
pub fn text(file: &Path, limit: u64) -> Result<String, Failure> {
    let unread = |error| about(file)(format!("cannot be read: {error}"));
    let bytes = regular::read(file, limit).map_err(unread)?;
    Ok(String::from_utf8(bytes).map_err(|_| about(file)("it is not UTF-8"))?)
}

/// The message of an error, with advice if the file has a known format.
pub fn advice(error: &DiscoverError) -> String {
    let DiscoverError::NotAFolder { path } = error else {
        return one_line(error);
    };
    format!("{}: {}", one_line(path), of_file(Path::new(path)))
}

/// What a file is that is of no format of robots, as far as it can be read.
fn foreign_at(path: &Path) -> Option<Foreign> {
    let mut head = Vec::new();
    regular::open(path).ok()?.take(HEAD).read_to_end(&mut head).ok()?;
    foreign(&head)
}

/// What a file is: by its content, and by its name where that does not say.
fn of_file(path: &Path) -> String {
    let by_content = RobotFile::at(path);
    let by_name = FileType::of(path);
    let is_other =
        !matches!(by_content, Some(RobotFile::Imported(_))) && by_name != Some(FileType::Document);
    if let Some(foreign) = foreign_at(path).filter(|_| is_other) {
        return foreign.to_string();
    }
    let by_name = by_name.filter(|_| by_content.is_none());
    let known = match (by_content, by_name) {
        (Some(RobotFile::Urdf), _) => {
            "this is a URDF; `urdd generate` makes a URDD of it, `urdd lint` checks it"
        }
        (Some(RobotFile::Xacro), _) => {
            "this is a xacro file; `urdd generate` makes a URDD of it, `urdd lint` checks it, `urdd diff` compares it"
        }
        (Some(RobotFile::Srdf), _) => {
            "this is SRDF, which adds groups and skipped collisions to a URDF; give the URDF that it belongs to, or a URDD"
        }
        (Some(RobotFile::Imported(Format::Sdf)), _) | (_, Some(FileType::Sdf)) => {
            "this is SDF; `urdd generate` makes a URDD of it, `urdd lint` checks it, `urdd import` makes a URDF"
        }
        (Some(RobotFile::Imported(Format::Mjcf)), _) | (_, Some(FileType::Mjcf)) => {
            "this is MJCF, the format of MuJoCo; `urdd generate` makes a URDD of it, `urdd lint` checks it, `urdd import` \
             makes a URDF"
        }
        (Some(RobotFile::Imported(Format::Usd)), _) | (_, Some(FileType::Usd)) => {
            "this is USD; `urdd generate` makes a URDD of it, `urdd lint` checks it, `urdd import` makes a URDF"
        }
        (_, Some(FileType::Document)) => {
            "a URDD is a folder, not a single file; give the folder that contains urdd.json and the module folders"
        }
        _ => {
            "this is a file, but neither a URDF nor a URDD (a folder that holds urdd.json or the module folders, or a zip \
             archive of one)"
        }
    };
    known.to_owned()
}

/// Maximum number of attempts while another program writes to the URDD.
const MAX_TRIES: usize = 5;

pub struct Edited {
    /// The files that change.
    pub files: Files,
    pub told: String,
}

impl Edited {
    pub fn unchanged(told: String) -> Self {
        Edited { files: Files::new(), told }
    }
}

/// Edits a module of the URDD in a folder. Returns what to print.
pub fn edited(
    urdd: &Path,
    kind: ModuleKind,
    edit: impl Fn(&Robot) -> Result<Edited, Failure>,
) -> Result<String, Failure> {
    if !urdd.is_dir() {
        Err(about(urdd)("not a folder; edits are written into the folder of a URDD"))?;
    }
    for _ in 0..MAX_TRIES {
        let before = state(urdd, kind).map_err(about(urdd))?;
        let robot = open(urdd)?;
        let Edited { files, told } = edit(&robot)?;
        if files.is_empty() {
            return Ok(told);
        }
        // Takes the lock here. Other programs may have written before.
        let replacement = Replacement::begin(urdd)?;
        if state(urdd, kind).map_err(about(urdd))? != before {
            continue;
        }
        replacement.stage(&files)?;
        replacement.commit()?;
        return Ok(told);
    }
    Err(about(urdd)("another program keeps writing into this folder; nothing was written").into())
}

/// Refuses an SRDF of which nothing can be imported; `wrong` says why.
pub fn some_read(read: usize, wrong: &[String]) -> Result<(), String> {
    match read == 0 && !wrong.is_empty() {
        true => Err(format!("nothing in it can be imported: {}", wrong.join("; "))),
        false => Ok(()),
    }
}

/// A line for each part of an SRDF that an import leaves out.
pub fn left_out(wrong: &[String]) -> String {
    wrong.iter().map(|wrong| format!("  left out: {wrong}\n")).collect()
}

/// The files that the edits depend on.
fn state(urdd: &Path, kind: ModuleKind) -> Result<Vec<Vec<u8>>, ReadError> {
    let root = Root::open_folder(urdd)?;
    let module = format!("{}/module.json", kind.folder());
    let read = |path: &str| match root.read(path, MAX_DOCUMENT_BYTES) {
        Err(ReadError::Missing) => Ok(Vec::new()),
        read => read,
    };
    [ROOT_METADATA, &module].map(read).into_iter().collect()
}
