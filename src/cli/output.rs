//! What a command has of its process: printing, and its exit status. All external text is escaped. A failed write is an error,
//! except for a pipe that its reader has closed.

use std::fmt::Display;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::ValueEnum;
use urdd_directory::outputs::{self, Output, OutputError, Target};
use urdd_directory::staging::StagingError;
use urdd_format::escape;
use urdd_validate::report::style::STYLES;

/// Exit status: usage error, nothing could be examined, or the result could not be written.
pub const USAGE: u8 = 2;

/// Whether standard output was closed when the program started. Rust's runtime replaces it with `/dev/null`, which
/// discards everything without an error.
static CLOSED: AtomicBool = AtomicBool::new(false);

/// Whether something was printed to standard output.
static PRINTED: AtomicBool = AtomicBool::new(false);

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

pub fn print(text: &str) -> Result<(), String> {
    write(&safe(text)).map(|_| ())
}

/// As [`print`], for text that has more to follow. Returns whether a reader is still there.
pub fn print_some(text: &str) -> Result<bool, String> {
    write(&safe(text))
}

/// Writes the bytes of a file to standard output.
pub fn print_bytes(bytes: &[u8]) -> Result<(), String> {
    write_bytes(bytes).map(|_| ())
}

/// Writes text. Returns false if it is a pipe that its reader has closed.
fn write(text: &str) -> Result<bool, String> {
    write_bytes(text.as_bytes())
}

fn write_bytes(bytes: &[u8]) -> Result<bool, String> {
    let failed = |reason: &str| Err(format!("standard output cannot be written: {reason}"));
    if CLOSED.load(Ordering::Relaxed) {
        return failed("it is closed");
    }
    let mut out = io::stdout().lock();
    PRINTED.store(true, Ordering::Relaxed);
    let written = out.write_all(bytes).and_then(|()| out.flush());
    match written {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(false),
        Err(error) => failed(&reason(&error)),
    }
}

/// As [`print`], for text in a format that has already escaped names by its own rules, or that consists of workflow
/// commands.
pub fn print_raw(text: &str) -> Result<(), String> {
    write(&escape::lines(text)).map(|_| ())
}

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

/// The width of the terminal on standard output, in characters; `None` if it is not a terminal.
pub fn width() -> Option<usize> {
    let width = terminal_size::terminal_size_of(io::stdout()).map(|(width, _)| width.0);
    width.map(|width| usize::from(width).max(40))
}

/// Whether the terminal can only show plain text.
pub fn is_dumb() -> bool {
    std::env::var_os("TERM").is_some_and(|value| value == "dumb")
}

/// Writes files that belong together, and a report on them. If one cannot be written, writes none. `also` is what the
/// message ends with if a file exists with other content.
pub fn write_files<'f>(
    target: Target,
    mut files: Vec<Output<'f>>,
    report: Option<(&'f Path, &'f [u8])>,
    force: bool,
    also: &str,
) -> Result<(), String> {
    let mut apart = None;
    if let Some((file, bytes)) = report {
        let below = Target::File(file).folder().strip_prefix(target.folder());
        match below {
            Ok(below) if !file.is_symlink() && !outputs::is_stream(file) => {
                let path = below.join(outputs::name_of(file));
                files.insert(0, Output { path, bytes, replaces: force });
            }
            _ => apart = Some((file, bytes)),
        }
    }
    let written = (apart.map_or(Ok(()), |(file, bytes)| outputs::check_report(file, bytes, force)))
        .and_then(|()| outputs::write(target, files))
        .and_then(|_| apart.map_or(Ok(()), |(file, bytes)| outputs::report(file, bytes, force)));
    written.map_err(|error| unwritten(error, also))
}

/// Writes a report to a file, replaced atomically; unchanged on error.
///
/// # Errors
/// A message if it cannot be written, or if its name would make its folder a URDD.
pub fn write_file(file: &Path, text: &str) -> Result<(), String> {
    outputs::report(file, text.as_bytes(), true).map_err(|error| unwritten(error, ""))
}

/// Writes a file that a person named. One with other content is replaced with `force` only.
pub fn write_alone(file: &Path, bytes: &[u8], force: bool) -> Result<(), String> {
    let path = outputs::name_of(file).into();
    let output = Output { path, bytes, replaces: force };
    write_files(Target::File(file), vec![output], None, force, "")
}

fn unwritten(error: OutputError, also: &str) -> String {
    match error {
        OutputError::Exists(path) => {
            format!("{} already exists: --force overwrites it{also}", shown(&path))
        }
        OutputError::Write { path, error }
        | OutputError::Folder(StagingError::Write { path, error }) => {
            format!("{}: cannot be written: {}", shown(&path), reason(&error))
        }
        error => error.to_string(),
    }
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

/// The exit status of a command. Prints its error message; where JSON was asked for and nothing is printed, also as JSON.
pub fn ended(result: Result<u8, Failure>, is_json: bool) -> ExitCode {
    let status = result.unwrap_or_else(|message| {
        let message = message.to_string();
        error(&message);
        print_error_as_json(&message, is_json);
        USAGE
    });
    ExitCode::from(status)
}

/// Prints why nothing was done as JSON, if that was asked for and nothing is printed.
pub fn print_error_as_json(message: &str, is_json: bool) {
    if is_json && !PRINTED.load(Ordering::Relaxed) {
        let error = serde_json::json!({"status": USAGE, "error": {"message": message}});
        // Standard error has the message too.
        let _ = print(&format!("{error}\n"));
    }
}

/// Does work whose panics are caught and reported: the default hook would print them as well.
pub fn without_panic_messages<T>(work: impl FnOnce() -> T) -> T {
    std::panic::set_hook(Box::new(|_| {}));
    let done = work();
    let _ = std::panic::take_hook();
    done
}
