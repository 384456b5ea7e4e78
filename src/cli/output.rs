//! Printing. Escapes all external text. A failed write is an error, except for a pipe that its reader has closed.

use std::fmt::Display;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::ValueEnum;
use tempfile::TempPath;

use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::regular;
use urdd_format::escape;
use urdd_validate::report::style::STYLES;

/// Exit status: usage error, nothing could be examined, or the result could not be written.
pub const USAGE: u8 = 2;

/// Whether standard output was closed when the program started. Rust's runtime replaces it with `/dev/null`, which
/// discards everything without an error.
static CLOSED: AtomicBool = AtomicBool::new(false);

/// Records that standard output was closed when the program started.
pub fn standard_output_is_closed() {
    CLOSED.store(true, Ordering::Relaxed);
}

/// Why a command stops. People see its text.
pub type Failure = Box<dyn std::error::Error>;

/// A path on one line.
pub fn shown(path: &Path) -> String {
    one_line(path.display())
}

/// A text on one line.
pub fn one_line(text: impl Display) -> String {
    escape::line(&text.to_string()).into_owned()
}

/// Gives an error the path that it is about, and one line.
pub fn about<E: Display>(path: &Path) -> impl Fn(E) -> String {
    move |error| format!("{}: {}", shown(path), one_line(error))
}

/// Prints to standard output.
///
/// # Errors
/// A message if the text cannot be written.
pub fn print(text: &str) -> Result<(), String> {
    write(&safe(text)).map(|_| ())
}

/// As [`print`], for text that has more to follow. Returns whether a reader is still there.
///
/// # Errors
/// As for [`print`].
pub fn print_some(text: &str) -> Result<bool, String> {
    write(&safe(text))
}

/// Writes text. Returns false if it is a pipe that its reader has closed.
fn write(text: &str) -> Result<bool, String> {
    let failed = |reason: &str| Err(format!("standard output cannot be written: {reason}"));
    if CLOSED.load(Ordering::Relaxed) {
        return failed("it is closed");
    }
    let mut out = io::stdout().lock();
    let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    match written {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(false),
        Err(error) => failed(&reason(&error)),
    }
}

/// As [`print`], for text in a format that has already escaped names by its own rules, or that consists of workflow
/// commands.
///
/// # Errors
/// As for [`print`].
pub fn print_raw(text: &str) -> Result<(), String> {
    write(&escape::lines(text)).map(|_| ())
}

/// Prints an error to standard error.
pub fn error(message: &str) {
    let message = inert(message);
    let _ = writeln!(io::stderr().lock(), "urdd: {message}");
}

/// Makes lines inert for terminals and for GitHub Actions runners, which take a line that begins with `::` for a command,
/// and what follows `##[` anywhere. The latter's escape is one of JSON too, which is printed here.
fn inert(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let text = escape::lines(text).replace("##[", "#\\u0023[");
    for line in text.split_inclusive('\n') {
        let start = line.len() - line.trim_start().len();
        let (margin, rest) = line.split_at(start);
        out.push_str(margin);
        if rest.starts_with("::") {
            out.push_str("\\u{3a}:");
        }
        out.push_str(rest.strip_prefix("::").unwrap_or(rest));
    }
    out
}

/// Escapes everything that a terminal would act upon, except for line feeds and our own styles.
fn safe(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut parts = text.split('\u{1b}');
    out.push_str(&inert(parts.next().unwrap_or_default()));
    for part in parts {
        let is_ours = STYLES.iter().any(|style| part.starts_with(&style['\u{1b}'.len_utf8()..]));
        out.push_str(if is_ours { "\u{1b}" } else { "\\u{1b}" });
        out.push_str(&inert(part));
    }
    out
}

/// When output is coloured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Color {
    /// Never if NO_COLOR is set; otherwise on a terminal that is not dumb, and anywhere if CLICOLOR_FORCE is set.
    #[default]
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

impl Color {
    /// Whether to use colours on a stream.
    pub fn on(self, terminal: bool) -> bool {
        let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
        match self {
            Color::Always => true,
            Color::Never => false,
            Color::Auto if set("NO_COLOR").is_some() => false,
            Color::Auto if set("CLICOLOR_FORCE").is_some_and(|value| value != "0") => true,
            Color::Auto => terminal && !is_dumb(),
        }
    }
}

/// A number of things: `1 pair`, `2 pairs`.
pub fn counted(number: usize, thing: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{number} {thing}{plural}")
}

/// The width of the terminal on standard output, in characters; `None` if it is not a terminal.
pub fn width() -> Option<usize> {
    let width = terminal_size::terminal_size_of(io::stdout()).map(|(width, _)| width.0);
    width.map(|width| usize::from(width).max(40))
}

/// Whether the terminal can only show plain text.
pub fn is_dumb() -> bool {
    std::env::var_os("TERM").is_some_and(|value| value == "dumb")
}

/// An error if a file exists with different content. `also` is what its message ends with.
///
/// # Errors
/// A message that names the file.
pub fn refuse_others<'f>(
    files: impl IntoIterator<Item = &'f (PathBuf, &'f [u8])>,
    also: &str,
) -> Result<(), String> {
    match files.into_iter().find(|file| is_other(file)) {
        Some((there, _)) => {
            Err(format!("{} already exists: --force overwrites it{also}", shown(there)))
        }
        None => Ok(()),
    }
}

/// Whether a file exists with different content.
pub fn is_other((file, bytes): &(PathBuf, &[u8])) -> bool {
    match fs::metadata(file) {
        Ok(there) if there.is_file() => {
            let read = regular::read(file, bytes.len() as u64);
            !read.is_ok_and(|there| there == *bytes)
        }
        // Writing to devices and pipes is allowed.
        Ok(there) => there.is_dir(),
        Err(_) => fs::symlink_metadata(file).is_ok(),
    }
}

/// Writes a report to a file, replaced atomically; unchanged on error.
///
/// # Errors
/// A message if it cannot be written, or if its name would make its folder a URDD.
pub fn write_file(file: &Path, text: &str) -> Result<(), String> {
    check_name(file)?;
    let failed = |error| cannot_write(file, &error);
    stage(file, text.as_bytes()).and_then(Staged::put).map_err(failed)
}

/// Writes files that belong together, and creates their folders. If one cannot be prepared, writes none, and removes
/// new folders.
///
/// # Errors
/// As for [`write_file`].
pub fn write_files(files: &[(PathBuf, &[u8])]) -> Result<(), String> {
    let mut folders = NewFolders(Vec::new());
    let mut staged = Vec::new();
    for (file, bytes) in files {
        check_name(file)?;
        let failed = |error| cannot_write(file, &error);
        folders.make(folder_of(file)).map_err(failed)?;
        staged.push((file, stage(file, bytes).map_err(failed)?));
    }
    for (file, staged) in staged {
        staged.put().map_err(|error| cannot_write(file, &error))?;
    }
    folders.0.clear();
    Ok(())
}

fn cannot_write(file: &Path, error: &io::Error) -> String {
    format!("{}: cannot be written: {}", shown(file), reason(error))
}

/// New folders. Those that are empty are removed when this is dropped.
struct NewFolders(Vec<PathBuf>);

impl NewFolders {
    fn make(&mut self, folder: &Path) -> io::Result<()> {
        let missing = folder.ancestors().take_while(|folder| {
            !folder.as_os_str().is_empty() && fs::symlink_metadata(folder).is_err()
        });
        let missing: Vec<PathBuf> = missing.map(Path::to_owned).collect();
        for folder in missing.into_iter().rev() {
            fs::create_dir(&folder)?;
            self.0.push(folder);
        }
        Ok(())
    }
}

impl Drop for NewFolders {
    fn drop(&mut self) {
        for folder in self.0.iter().rev() {
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Staged content of a file.
enum Staged<'a> {
    /// A new file next to the target that it will replace.
    Beside(TempPath, PathBuf),
    /// A device or a pipe, written directly.
    Device(PathBuf, &'a [u8]),
}

impl Staged<'_> {
    fn put(self) -> io::Result<()> {
        match self {
            Staged::Beside(path, target) => path.persist(target).map_err(|error| error.error),
            Staged::Device(file, bytes) => {
                let mut out = fs::OpenOptions::new().write(true).open(file)?;
                out.write_all(bytes)
            }
        }
    }
}

/// Writes the new content next to the file, which remains unchanged.
fn stage<'a>(file: &Path, bytes: &'a [u8]) -> io::Result<Staged<'a>> {
    let (target, permissions) = match fs::metadata(file) {
        Ok(metadata) if metadata.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
        Ok(metadata) if !metadata.is_file() => return Ok(Staged::Device(file.to_owned(), bytes)),
        // A symbolic link remains: its target is replaced.
        Ok(metadata) => (fs::canonicalize(file)?, Some(metadata.permissions())),
        Err(_) => (file.to_owned(), None),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".urdd-report-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The default permissions of new files, subject to the umask.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut beside = builder.tempfile_in(folder_of(&target))?;
    beside.write_all(bytes)?;
    if let Some(permissions) = permissions {
        beside.as_file().set_permissions(permissions)?;
    }
    beside.as_file().sync_all()?;
    Ok(Staged::Beside(beside.into_temp_path(), target))
}

fn folder_of(file: &Path) -> &Path {
    match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Refuses the file name that marks a folder as a URDD.
///
/// # Errors
/// A message with advice if the file has that name.
pub fn check_name(file: &Path) -> Result<(), String> {
    if file.file_name().is_some_and(|name| name.eq_ignore_ascii_case(ROOT_METADATA)) {
        return Err(format!(
            "{}: a file with this name makes its folder a URDD, which the next `urdd validate` would examine; \
             give it another name, such as urdd-report.json",
            shown(file)
        ));
    }
    Ok(())
}

/// The operating system's message, without the error number and without the path of a temporary file.
fn reason(error: &io::Error) -> String {
    match error.raw_os_error() {
        Some(number) => {
            let text = io::Error::from_raw_os_error(number).to_string();
            let end = text.rfind(" (os error").unwrap_or(text.len());
            text[..end].to_lowercase()
        }
        None => match error.kind() {
            io::ErrorKind::Other => error.to_string(),
            kind => kind.to_string(),
        },
    }
}

/// The exit status of a command that only prints.
pub fn printed(text: Result<String, impl Display>) -> ExitCode {
    ended(text.map_err(|error| error.to_string()).and_then(|text| print(&text).map(|()| 0)))
}

/// The exit status of a command. Prints its error message.
pub fn ended(result: Result<u8, impl Display>) -> ExitCode {
    let status = result.unwrap_or_else(|message| {
        error(&message.to_string());
        USAGE
    });
    ExitCode::from(status)
}

/// Does work whose panics are caught and reported: the default hook would print them as well.
pub fn without_panic_messages<T>(work: impl FnOnce() -> T) -> T {
    std::panic::set_hook(Box::new(|_| {}));
    let done = work();
    let _ = std::panic::take_hook();
    done
}
