//! Runs an external command with a time limit, ends all its child processes with it, and finds codes of rules in what it prints.

use std::collections::{BTreeSet, VecDeque};
use std::io::Read;
use std::path::Path;
use std::process::{Command, ExitStatus};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use parking_lot::Mutex;

use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_source::process::{Ended, PAUSE, Running};
use urdd_validate::code::Code;

/// Length of the output tail that is kept, bytes.
const TAIL: usize = 2000;
/// How long to wait for the last output if another process keeps the stream open.
const LAST_WORDS: Duration = Duration::from_millis(500);

/// How a command ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum End {
    /// With an exit status.
    Status(i32),
    /// By a signal, in the system's notation.
    Signal(String),
    /// Stopped at the time limit.
    TimeLimit,
    /// Failed to start.
    NotStarted(String),
    /// In a batch: ended, or closed its output, without an answer.
    NoAnswer,
    /// In a batch: an answer that begins with no number.
    NotAVerdict(String),
}

impl std::fmt::Display for End {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            End::Status(status) => write!(f, "exit status {status}"),
            End::Signal(signal) => write!(f, "ended by {signal}"),
            End::TimeLimit => f.write_str("stopped at the time limit"),
            End::NotStarted(error) => write!(f, "could not be started: {error}"),
            End::NoAnswer => f.write_str("ended without an answer"),
            End::NotAVerdict(answer) => {
                write!(f, "answered {answer:?}, which begins with no number")
            }
        }
    }
}

/// A finished command, with the end of its output.
#[derive(Debug, Clone)]
pub struct Ran {
    /// How it ended.
    pub end: End,
    /// The end of its standard output.
    pub stdout: String,
    /// The end of its standard error.
    pub stderr: String,
    /// The codes of rules in all of its output.
    pub codes: BTreeSet<Code>,
    /// How long it ran.
    pub duration: Duration,
}

/// What interpreters and runtimes print of an uncaught exception or a panic. Go and OCaml then end with status 2, Rust with
/// 101, the others with 1.
const CRASHES: &[&str] = &[
    "Traceback (most recent call last)", // Python
    "\nNode.js v",
    "Exception in thread \"",        // the JVM
    "[running]:\n",                  // Go
    "Fatal error: exception ",       // OCaml
    "' panicked at ",                // Rust
    "CallStack (from HasCallStack)", // Haskell
    "\nStacktrace:\n",               // Julia
    "\nstack traceback:\n",          // Lua
];

impl Ran {
    /// A command that printed nothing.
    pub(crate) fn without_output(end: End) -> Self {
        let (stdout, stderr) = Default::default();
        Ran { end, stdout, stderr, codes: BTreeSet::new(), duration: Duration::ZERO }
    }

    /// Seconds that it ran, to milliseconds.
    pub fn seconds(&self) -> f64 {
        self.duration.as_millis() as f64 / 1000.0
    }

    /// Whether it seems to have crashed, so that its exit status says nothing.
    pub fn looks_crashed(&self) -> bool {
        CRASHES.iter().any(|words| self.stderr.contains(words))
    }
}

/// A command with arguments, in which each `{word}` is a placeholder for a path.
#[derive(Debug, Clone)]
pub struct Template {
    words: Vec<String>,
}

/// Why a command is invalid.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum TemplateError {
    #[error("no command given; give it after `--`")]
    Empty,
    #[error("the command has no {{{0}}}; put it where the path belongs")]
    Missing(&'static str),
    #[error("with --batch, folders are lines of standard input: leave {{{0}}} out of the command")]
    Batch(&'static str),
}

impl Template {
    /// A command whose arguments contain each of `needed` in braces.
    ///
    /// # Errors
    /// If the command is empty, or a placeholder is missing.
    pub fn new(words: &[String], needed: &[&'static str]) -> Result<Template, TemplateError> {
        if words.is_empty() {
            return Err(TemplateError::Empty);
        }
        for name in needed {
            let place = format!("{{{name}}}");
            if !words.iter().skip(1).any(|word| word.contains(&place)) {
                return Err(TemplateError::Missing(name));
            }
        }
        Ok(Template { words: words.to_vec() })
    }

    /// A command that gets its folders one by one, and so has no placeholder.
    ///
    /// # Errors
    /// If the command is empty, or has the placeholder.
    pub fn batch(words: &[String], name: &'static str) -> Result<Template, TemplateError> {
        let template = Template::new(words, &[])?;
        match Template::new(words, &[name]) {
            Ok(_) => Err(TemplateError::Batch(name)),
            Err(_) => Ok(template),
        }
    }

    /// The words as given.
    pub fn words(&self) -> &[String] {
        &self.words
    }

    /// Runs the command with these paths, for at most `limit`.
    ///
    /// # Errors
    /// If cancelled. The command and its child processes have ended then.
    pub fn run(
        &self,
        paths: &[(&str, &Path)],
        limit: Duration,
        cancellation: &Cancellation,
    ) -> Result<Ran, Cancelled> {
        cancellation.check()?;
        let filled = |word: &String| {
            paths.iter().fold(word.clone(), |word, (name, path)| {
                word.replace(&format!("{{{name}}}"), &path.to_string_lossy())
            })
        };
        let begin = Instant::now();
        let mut running = match Running::start(command(&self.words, filled)) {
            Ok(running) => running,
            Err(error) => return Ok(Ran::without_output(End::NotStarted(error.to_string()))),
        };
        let (stdout, stderr) = running.streams();
        let (stdout, stderr) = (stdout.map(Tail::of), stderr.map(Tail::of));
        let end = match running.wait(limit, cancellation, || false) {
            Ok(Ended::Itself(status)) => end(status),
            Ok(Ended::Cancelled) => return Err(Cancelled),
            Ok(Ended::TimeLimit | Ended::Enough) => End::TimeLimit,
            Err(error) => End::Signal(error.to_string()),
        };
        let duration = begin.elapsed();
        let (stdout, mut codes) = stdout.map(Tail::finish).unwrap_or_default();
        let (stderr, more) = stderr.map(Tail::finish).unwrap_or_default();
        codes.extend(more);
        Ok(Ran { end, stdout, stderr, codes, duration })
    }
}

/// A command of these words; `filled` is applied to its arguments.
pub(crate) fn command(words: &[String], filled: impl Fn(&String) -> String) -> Command {
    let mut words = words.iter();
    let mut command = Command::new(words.next().cloned().unwrap_or_default());
    command.args(words.map(filled));
    command
}

fn end(status: ExitStatus) -> End {
    match status.code() {
        Some(status) => End::Status(status),
        None => End::Signal(status.to_string()),
    }
}

/// The end of a stream, and the codes in it. It is read concurrently so that the command never blocks on a full pipe.
pub(crate) struct Tail {
    kept: Arc<Mutex<(VecDeque<u8>, Scan)>>,
    reader: JoinHandle<()>,
}

impl Tail {
    pub(crate) fn of(mut stream: impl Read + Send + 'static) -> Tail {
        let kept = Arc::new(Mutex::new((VecDeque::new(), Scan::default())));
        let shared = kept.clone();
        let reader = thread::spawn(move || {
            let mut piece = [0; 4096];
            while let Ok(read @ 1..) = stream.read(&mut piece) {
                let mut kept = shared.lock();
                let (tail, scan) = &mut *kept;
                scan.read(&piece[..read]);
                tail.extend(&piece[..read]);
                let over = tail.len().saturating_sub(TAIL);
                tail.drain(..over);
            }
        });
        Tail { kept, reader }
    }

    pub(crate) fn finish(self) -> (String, BTreeSet<Code>) {
        let start = Instant::now();
        while !self.reader.is_finished() && start.elapsed() < LAST_WORDS {
            thread::sleep(PAUSE);
        }
        let mut kept = self.kept.lock();
        let (tail, scan) = &mut *kept;
        let text = String::from_utf8_lossy(tail.make_contiguous()).into_owned();
        (text, std::mem::take(scan).finish())
    }
}

/// Length of a code: three letters, three digits.
const LENGTH: usize = 6;

/// Searches a stream in pieces for codes of rules. A code does not count inside a longer word, nor as a folder of a path: the folder of a
/// case has the name of its code.
#[derive(Debug)]
pub struct Scan {
    /// The byte before the next possible code, and all after it.
    rest: Vec<u8>,
    found: BTreeSet<Code>,
}

impl Default for Scan {
    fn default() -> Scan {
        Scan { rest: vec![b'\n'], found: BTreeSet::new() }
    }
}

impl Scan {
    /// Searches the next piece.
    pub fn read(&mut self, piece: &[u8]) {
        self.rest.extend(piece);
        let is_word = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
        for window in self.rest.windows(LENGTH + 2) {
            let [before, code @ .., after] = window else { continue };
            let (letters, digits) = code.split_at(3);
            let has_form =
                letters.iter().all(u8::is_ascii_uppercase) && digits.iter().all(u8::is_ascii_digit);
            if !has_form || is_word(*before) || is_word(*after) || matches!(after, b'/' | b'\\') {
                continue;
            }
            let code = std::str::from_utf8(code).ok().and_then(Code::parse);
            self.found.extend(code);
        }
        let searched = self.rest.len().saturating_sub(LENGTH + 1);
        self.rest.drain(..searched);
    }

    /// All codes, at the end of the stream.
    pub fn finish(mut self) -> BTreeSet<Code> {
        self.read(b"\n");
        self.found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    fn run(script: &str, limit: u64) -> Ran {
        let words = ["sh", "-c", script, "sh", "{dir}"].map(str::to_owned);
        let template = Template::new(&words, &["dir"]).unwrap();
        let paths = [("dir", Path::new("/some/where"))];
        let limit = Duration::from_millis(limit);
        template.run(&paths, limit, &Cancellation::default()).unwrap()
    }

    #[cfg(unix)]
    #[test]
    fn tells_how_it_ended_and_what_it_said() {
        let ran = run("echo \"got $1\"; echo bad >&2; exit 3", 20_000);
        assert_eq!(ran.end, End::Status(3));
        assert_eq!((ran.stdout.as_str(), ran.stderr.as_str()), ("got /some/where\n", "bad\n"));
        assert!(matches!(run("kill -9 $$", 20_000).end, End::Signal(_)));
        let long = run("yes | head -c 100000; echo end", 20_000);
        assert!(long.stdout.len() <= TAIL && long.stdout.ends_with("end\n"));
        let codes = run("echo DOF003; yes | head -c 100000; echo CHN001 >&2", 20_000).codes;
        assert_eq!(codes, [Code::DOF003, Code::CHN001].into());
    }

    #[cfg(unix)]
    #[test]
    fn what_it_started_ends_with_it() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("late");
        let shown = file.display();
        let start = Instant::now();
        let ran = run(&format!("(sleep 2; touch {shown}) & sleep 60"), 300);
        assert_eq!(ran.end, End::TimeLimit);
        assert!(start.elapsed() < Duration::from_secs(2));
        thread::sleep(Duration::from_millis(2500));
        assert!(!file.exists(), "a child outlived the time limit");
    }

    #[cfg(unix)]
    #[test]
    fn commands_must_ask_for_their_paths() {
        let words = ["a".to_owned(), "{dir}/b".to_owned()];
        assert!(Template::new(&words, &["dir"]).is_ok());
        let error = Template::new(&words, &["dir", "out"]).unwrap_err();
        assert_eq!(error, TemplateError::Missing("out"));
        assert_eq!(Template::new(&[], &[]).unwrap_err(), TemplateError::Empty);
        let missing = ["/no/such/program".to_owned()];
        let ran = Template::new(&missing, &[]).unwrap();
        let ran = ran.run(&[], Duration::from_secs(1), &Cancellation::default());
        assert!(matches!(ran.unwrap().end, End::NotStarted(_)));
    }

    #[test]
    fn finds_codes_that_are_words_of_their_own() {
        for (pieces, found) in [
            (&["DOF003"][..], &[Code::DOF003][..]),
            (&["error[DO", "F00", "3]: x"], &[Code::DOF003]),
            (&["{\"code\":\"DOF003\"},", "CHN001,"], &[Code::DOF003, Code::CHN001]),
            (&["/tmp/invalid/DOF003", "/of-two/robot: fine"], &[]),
            (&["C:\\invalid\\DOF003\\of-two"], &[]),
            (&["DOF0031 XDOF003 DOF003_ dof003 DOF999"], &[]),
            (&["", "\u{e9}DOF003\u{e9}"], &[Code::DOF003]),
        ] {
            let mut scan = Scan::default();
            for piece in pieces {
                scan.read(piece.as_bytes());
            }
            assert_eq!(scan.finish(), found.iter().copied().collect(), "{pieces:?}");
        }
    }
}
