//! Expands xacro files with the external program `xacro`.
//!
//! A xacro file is a program: it may contain any expression and include any file. It therefore runs only if the user
//! asks for it, by the file extension or by a flag, and with a time limit.

use std::ffi::OsString;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus};
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::Duration;

use tempfile::TempDir;

use crate::error::SourceError;
use crate::files::MAX_SOURCE_BYTES;
use crate::packages::Packages;
use crate::process::{Ended, Running};
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_directory::read_error::ReadError;
use urdd_directory::regular;

/// Maximum number of bytes to read from its standard error.
const MAX_WORDS: u64 = 1 << 20;
/// Maximum number of last lines to report, and of characters in them.
const MOST_LINES: usize = 3;
const MOST_CHARACTERS: usize = 1000;
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

/// Expands a xacro file to a URDF.
///
/// # Errors
/// If the program is missing, fails, takes too long, writes too much, or is cancelled.
pub(super) fn expand(
    path: &Path,
    shown: &str,
    settings: &XacroSettings,
    packages: &Packages,
    cancellation: &Cancellation,
) -> Result<String, SourceError> {
    let given = PackageIndex::new(packages).map_err(|error| {
        let (file, reason) = (shown.to_owned(), error.to_string());
        SourceError::Xacro { file, reason }
    })?;
    run(&[], path, shown, settings, &given, cancellation)
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
    cancellation: &Cancellation,
) -> Result<String, SourceError> {
    let failed = |reason: String| SourceError::Xacro { file: shown.to_owned(), reason };
    // An absolute path cannot be mistaken for an option.
    let path = path.canonicalize().map_err(|error| failed(error.to_string()))?;
    let mut command = Command::new("xacro");
    command.args(options).arg(&path).args(&settings.arguments);
    given.tell(&mut command);
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
        let words = last_lines(&words.unwrap_or_default());
        return Err(failed(words.unwrap_or_else(|| status.to_string())));
    }
    String::from_utf8(written).map_err(|_| failed("its output is not UTF-8".to_owned()))
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

/// The lines that state the error: xacro's own, with the macros and files around it, or the last ones below a Python
/// traceback.
fn last_lines(words: &[u8]) -> Option<String> {
    let words = String::from_utf8_lossy(words);
    let lines: Vec<&str> = words.lines().filter(|line| !line.trim().is_empty()).collect();
    if let Some(own) = lines.iter().rposition(|line| line.starts_with("error: ")) {
        let own = lines[own..].iter().take(MOST_LINES + 1).map(|line| line.trim());
        let own = own.collect::<Vec<_>>().join("; ");
        return Some(own.chars().take(MOST_CHARACTERS).collect());
    }
    let last = lines[lines.len().saturating_sub(MOST_LINES)..].join("; ");
    let start = last.chars().count().saturating_sub(MOST_CHARACTERS);
    let last: String = last.chars().skip(start).collect();
    (!last.is_empty()).then_some(last)
}

/// The packages named by the user, in a layout that ROS searches: `$(find NAME)` finds these first.
pub(super) struct PackageIndex {
    prefix: Option<TempDir>,
}

impl PackageIndex {
    pub(super) fn new(packages: &Packages) -> io::Result<Self> {
        let mut given = packages.given().peekable();
        if given.peek().is_none() {
            return Ok(PackageIndex { prefix: None });
        }
        let prefix = TempDir::new()?;
        let index = prefix.path().join("share/ament_index/resource_index/packages");
        std::fs::create_dir_all(&index)?;
        for (name, folder) in given {
            std::fs::write(index.join(name), "")?;
            let folder = folder.canonicalize()?;
            link(&folder, &prefix.path().join("share").join(name))?;
        }
        let prefix = Some(prefix);
        Ok(PackageIndex { prefix })
    }

    /// Puts them before those from the environment.
    pub(super) fn tell(&self, command: &mut Command) {
        let Some(prefix) = &self.prefix else {
            return;
        };
        for (name, folder) in [
            ("AMENT_PREFIX_PATH", prefix.path().to_owned()),
            ("ROS_PACKAGE_PATH", prefix.path().join("share")),
        ] {
            command.env(name, before(folder, std::env::var_os(name)));
        }
    }

    /// A path that outlives this layout.
    pub(super) fn lasting(&self, path: PathBuf) -> PathBuf {
        match &self.prefix {
            Some(prefix) if path.starts_with(prefix.path()) => path.canonicalize().unwrap_or(path),
            _ => path,
        }
    }
}

fn before(folder: PathBuf, paths: Option<OsString>) -> OsString {
    let paths = paths.unwrap_or_default();
    let paths = std::env::split_paths(&paths).filter(|path| !path.as_os_str().is_empty());
    let all = std::iter::once(folder.clone()).chain(paths);
    std::env::join_paths(all).unwrap_or_else(|_| folder.into_os_string())
}

#[cfg(unix)]
fn link(folder: &Path, at: &Path) -> io::Result<()> {
    std::os::unix::fs::symlink(folder, at)
}

#[cfg(windows)]
fn link(folder: &Path, at: &Path) -> io::Result<()> {
    std::os::windows::fs::symlink_dir(folder, at)
}

/// WebAssembly starts no program.
#[cfg(not(any(unix, windows)))]
fn link(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
