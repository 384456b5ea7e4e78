//! Expands xacro files with the external program `xacro`.
//!
//! A xacro file is a program: it may contain any expression and include any file. It therefore runs only if the user
//! asks for it, by the file extension or by a flag, and with a time limit.
//!
//! It is watched, since it does not say from where the elements of its output are: a module that Python loads in its place,
//! and that loads it, notes them. Where Python loads none of ours, nothing is known, and xacro runs all the same.

use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus};
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::Duration;

use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_directory::file_type::FileType;
use urdd_directory::listing::ReadError;
use urdd_directory::regular;
use urdd_format::escape;

use crate::error::{SourceError, XacroFault};
use crate::files::{Files, MAX_SOURCE_BYTES};
use crate::package_index::PackageIndex;
use crate::packages::Packages;
use crate::process::{Ended, Running};
use crate::settings::{Settings, XacroSettings};
use crate::trail::{Trail, Watch};
use crate::written;

/// Maximum number of bytes to read from its standard error.
const MAX_WORDS: u64 = 1 << 20;
/// Maximum number of last lines to report, and of characters in them.
const MOST_LINES: usize = 3;
const MOST_CHARACTERS: usize = 1000;
/// How it begins to say that a file is not well-formed; behind that is advice for all such files.
const NOT_XML: &str = "XML parsing error: ";
/// How long to wait for its last output if another process keeps the pipe open.
const LAST_WORDS: Duration = Duration::from_secs(2);

/// Expands a xacro file to a URDF, and says where its elements are from.
///
/// # Errors
/// If the program is missing, fails, takes too long, writes too much, or is cancelled.
pub(super) fn expand(
    path: &Path,
    shown: &str,
    settings: &XacroSettings,
    packages: &Packages,
    cancellation: &Cancellation,
) -> Result<(String, Trail), SourceError> {
    let failed = |error: io::Error| SourceError::Xacro {
        file: shown.to_owned(),
        fault: error.to_string().into(),
    };
    let given = PackageIndex::new(packages, path, cancellation).map_err(failed)?;
    // Without it nothing is known of places, and xacro runs all the same.
    let watch = Watch::begin().ok();
    let made = run(&[], path, shown, settings, &given, watch.as_ref(), cancellation);
    let trail = watch.map(|watch| watch.trail()).unwrap_or_default();
    match made {
        Ok(text) => Ok((text, trail)),
        Err(SourceError::Xacro { file, fault }) => {
            let fault = Box::new(placed(*fault, &trail, path, shown));
            Err(SourceError::Xacro { file, fault })
        }
        Err(error) => Err(error),
    }
}

/// What xacro says of the files and macros around a fault, which a trail says with lines.
const AROUND: [&str; 5] = [
    "when instantiating macro:",
    "instantiated from:",
    "in file:",
    "included from:",
    "when processing file:",
];

/// A fault with its place, and with the paths of files as seen from where the user names them.
fn placed(mut fault: XacroFault, trail: &Trail, path: &Path, shown: &str) -> XacroFault {
    if let Some((place, calls)) = written::fault_place(trail, path, shown) {
        fault.further.retain(|line| !AROUND.iter().any(|start| line.starts_with(start)));
        (fault.place, fault.calls) = (Some(place), calls);
    }
    let folder = path.canonicalize().ok().and_then(|path| Some(path.parent()?.to_owned()));
    for line in fault.further.iter_mut().chain([&mut fault.reason]) {
        *line = as_shown(line, folder.as_deref(), Path::new(shown));
    }
    fault
}

/// Maximum number of folders above that of the file in which paths are shown as seen from it.
const MAX_ABOVE: usize = 4;

/// A text in which absolute paths of files around the one that was shown so, in this folder, are as that one is shown.
fn as_shown(text: &str, folder: Option<&Path>, shown: &Path) -> String {
    let mut made = text.to_owned();
    for (above, around) in folder.iter().flat_map(|folder| folder.ancestors()).enumerate() {
        // Folders of the machine are in no repository.
        if above > MAX_ABOVE || around.components().count() < 3 {
            break;
        }
        let here = shown.with_file_name("../".repeat(above));
        let here = match written::plain(&here.to_string_lossy()) {
            path if path.is_empty() => path,
            path => path + "/",
        };
        let around = format!("{}/", around.display());
        let mut parts = made.split(&around);
        let mut replaced = parts.next().unwrap_or_default().to_owned();
        for rest in parts {
            let is_inside = replaced.ends_with(|c: char| c.is_alphanumeric() || c == '/');
            replaced += if is_inside { &around } else { &here };
            replaced += rest;
        }
        made = replaced;
    }
    made
}

/// Runs xacro with these options on a file, and returns its output.
///
/// # Errors
/// As for [`expand`].
pub(super) fn run(
    options: &[&str],
    path: &Path,
    shown: &str,
    settings: &XacroSettings,
    given: &PackageIndex,
    watch: Option<&Watch>,
    cancellation: &Cancellation,
) -> Result<String, SourceError> {
    let fails = |fault: Box<XacroFault>| SourceError::Xacro { file: shown.to_owned(), fault };
    let failed = |reason: String| fails(reason.into());
    // An absolute path cannot be mistaken for an option.
    let path = path.canonicalize().map_err(|error| failed(error.to_string()))?;
    let mut command = Command::new("xacro");
    command.args(options).arg(&path).args(&settings.arguments);
    given.tell(&mut command, watch.map(Watch::folder).as_slice());
    if let Some(watch) = watch {
        watch.tell(&mut command);
    }
    let mut running = Running::start(command).map_err(|error| match error.kind() {
        ErrorKind::NotFound => SourceError::NoXacro { file: shown.to_owned() },
        _ => failed(error.to_string()),
    })?;
    let (Some(output), Some(words)) = running.streams() else {
        return Err(failed("its output cannot be read".to_owned()));
    };
    let output = read_beside(output, MAX_SOURCE_BYTES);
    let words = read_beside(words, MAX_WORDS);
    let mut written = None;
    let ended = running.wait(settings.time_limit, cancellation, || {
        if written.is_none() {
            written = output.try_recv().ok();
        }
        matches!(written, Some(Err(_)))
    });
    let status = match ended.map_err(|error| failed(error.to_string()))? {
        Ended::Itself(status) => Some(status),
        Ended::Enough => None,
        Ended::Cancelled => return Err(Cancelled.into()),
        Ended::TimeLimit => {
            let limit = settings.time_limit.as_secs();
            return Err(failed(format!("it took more than {limit} s and was stopped")));
        }
    };
    let written = written.or_else(|| output.recv_timeout(LAST_WORDS).ok());
    let written = written.ok_or_else(|| failed("its output: it did not end".to_owned()))?;
    let written = written.map_err(|why| failed(format!("its output: {why}")))?;
    if let Some(status) = status.filter(|status: &ExitStatus| !status.success()) {
        let words = words.recv_timeout(LAST_WORDS).ok().and_then(Result::ok);
        let words = words.unwrap_or_default();
        return Err(fails(fault(&words, given).unwrap_or_else(|| status.to_string().into())));
    }
    let text = String::from_utf8(written);
    let text = text.map_err(|_| failed("its output is not UTF-8".to_owned()))?;
    Ok(given.lasting(&text))
}

/// Reads a stream in a separate thread, so that the program never blocks on a full pipe.
fn read_beside(
    stream: impl Read + Send + 'static,
    limit: u64,
) -> Receiver<Result<Vec<u8>, ReadError>> {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || sender.send(regular::read_up_to(stream, limit)));
    receiver
}

/// What the program says of what is wrong: its own line, with the macros and files around it, or the last lines below a
/// Python traceback.
fn fault(words: &[u8], given: &PackageIndex) -> Option<Box<XacroFault>> {
    let words = String::from_utf8_lossy(words);
    let lines: Vec<&str> = words.lines().filter(|line| !line.trim().is_empty()).collect();
    let states = |line: &&str| line.starts_with("error: ") || line.starts_with(NOT_XML);
    let is_of_it = |line: &&&str| **line != "Check that:";
    let stated: Vec<&&str> = match lines.iter().rposition(states) {
        Some(own) => lines[own..].iter().take_while(is_of_it).take(MOST_LINES + 1).collect(),
        None => lines.iter().rev().take(MOST_LINES).collect(),
    };
    let mut left = MOST_CHARACTERS;
    let mut lines = stated.into_iter().map(|line| {
        let line: String = line.trim().chars().take(left).collect();
        left -= line.chars().count();
        line
    });
    let reason = lines.next()?;
    let mut further: Vec<String> = lines.filter(|line| !line.is_empty()).collect();
    let advice = further.iter().chain([&reason]).find_map(|line| given.advice(line));
    further = further.iter().map(|line| given.lasting(line)).collect();
    further.extend(advice);
    let package = missing_package(&reason);
    let reason = match &package {
        Some(name) => format!(
            "the package `{name}` is not around the file, nor on AMENT_PREFIX_PATH; say where it is: --package {}=FOLDER",
            escape::shell(name)
        ),
        None => given.lasting(&reason),
    };
    Some(Box::new(XacroFault { reason, further, package, ..XacroFault::default() }))
}

/// The name in ament's "package 'NAME' not found".
fn missing_package(line: &str) -> Option<String> {
    let (name, rest) = line.split_once("package '")?.1.split_once('\'')?;
    rest.trim_start().starts_with("not found").then(|| name.to_owned())
}

/// Maximum number of folders, and of files, that are listed.
const MAX_LISTED: usize = 2000;

/// The files that xacro reads for a robot: what `xacro --deps` lists. If it fails, as for a broken file, or names cannot
/// be told apart, the xacro and YAML files of the robot's package. None for a URDF without macros, or in memory.
pub fn included(file: &Path, settings: &Settings) -> Vec<PathBuf> {
    if !matches!(settings.files, Files::Disk) {
        return Vec::new();
    }
    let is_xacro = FileType::Xacro.is_of(file);
    match is_xacro || settings.xacro.expand_urdf && has_macros(file) {
        true => listed(file, settings).unwrap_or_else(|| beside(file)),
        false => Vec::new(),
    }
}

/// Whether xacro reads such files.
fn is_read(file: &Path) -> bool {
    use FileType::{Document, Urdf, Xacro, Xml};
    matches!(FileType::of(file), Some(Xacro | Xml | Urdf | Document))
}

fn has_macros(file: &Path) -> bool {
    let text = regular::read(file, MAX_SOURCE_BYTES);
    text.is_ok_and(|text| String::from_utf8_lossy(&text).contains("<xacro:"))
}

fn listed(file: &Path, settings: &Settings) -> Option<Vec<PathBuf>> {
    let cancellation = &settings.cancellation;
    let given = PackageIndex::new(&settings.packages, file, cancellation).ok()?;
    let text = run(&["--deps"], file, "", &settings.xacro, &given, None, cancellation).ok()?;
    let files: Vec<PathBuf> = text.split_whitespace().map(PathBuf::from).collect();
    // A name with a blank is listed as two.
    files.iter().all(|file| file.is_file()).then_some(files)
}

/// The files with such endings in the folder of the file's package, or else in its own.
fn beside(file: &Path) -> Vec<PathBuf> {
    let Ok(file) = file.canonicalize() else {
        return Vec::new();
    };
    let mut above = file.ancestors().skip(1);
    let package = above.find(|folder| folder.join("package.xml").is_file());
    let Some(folder) = package.or_else(|| file.parent()) else {
        return Vec::new();
    };
    let (mut found, mut waiting, mut visited) = (Vec::new(), vec![folder.to_owned()], 0);
    while let Some(folder) = waiting.pop() {
        visited += 1;
        if visited > MAX_LISTED || found.len() > MAX_LISTED {
            break;
        }
        for entry in std::fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            match entry.file_type() {
                Ok(kind) if kind.is_dir() => waiting.push(path),
                Ok(_) if is_read(&path) => found.push(path),
                _ => {}
            }
        }
    }
    found
}
