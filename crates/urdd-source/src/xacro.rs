//! Expands xacro files with the external program `xacro`.
//!
//! A xacro file is a program: it may contain any expression and include any file. It therefore runs only if the user
//! asks for it, by the file extension or by a flag, and with a time limit.

use std::io::{self, ErrorKind, Read};
use std::path::Path;
use std::process::{Command, ExitStatus};
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::Duration;

use crate::error::{SourceError, XacroFault};
use crate::files::MAX_SOURCE_BYTES;
use crate::package_index::PackageIndex;
use crate::packages::Packages;
use crate::process::{Ended, Running};
use crate::watch::{Trail, Watch};
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_directory::range::{OutOfRange, Range};
use urdd_directory::read_error::ReadError;
use urdd_directory::regular;
use urdd_format::escape;

/// Maximum number of bytes to read from its standard error.
const MAX_WORDS: u64 = 1 << 20;
/// Maximum number of last lines to report, and of characters in them.
const MOST_LINES: usize = 3;
const MOST_CHARACTERS: usize = 1000;
/// How it begins to say that a file is not well-formed; behind that is advice for all such files.
const NOT_XML: &str = "XML parsing error: ";
/// How long to wait for its last output if another process keeps the pipe open.
const LAST_WORDS: Duration = Duration::from_secs(2);

/// How xacro files are expanded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct XacroSettings {
    /// Whether to expand a `.urdf` that contains macros; a `.xacro` is always expanded.
    pub expand_urdf: bool,
    /// Arguments for the file, each as `name:=value`.
    pub arguments: Vec<String>,
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
            time_limit: Duration::from_secs(60),
        }
    }
}

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
    let given = PackageIndex::new(packages, path).map_err(failed)?;
    // Without it nothing is known of places, and xacro runs all the same.
    let watch = Watch::begin().ok();
    let text = run(&[], path, shown, settings, &given, watch.as_ref(), cancellation)?;
    Ok((text, watch.map(|watch| watch.trail()).unwrap_or_default()))
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
    Some(Box::new(XacroFault { reason, further, package }))
}

/// The name in ament's "package 'NAME' not found".
fn missing_package(line: &str) -> Option<String> {
    let (name, rest) = line.split_once("package '")?.1.split_once('\'')?;
    rest.trim_start().starts_with("not found").then(|| name.to_owned())
}
