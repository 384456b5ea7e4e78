//! Validators that judge many URDDs in one process, because they start slowly: a folder a line in, an answer a line out.

use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{ChildStdin, ChildStdout};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use parking_lot::Mutex;

use crate::process::{End, Ran, Scan, Tail, command};
use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_source::process::Running;

/// Maximum length of an answer, bytes.
const MAX_ANSWER: u64 = 64 << 10;
/// How often the end of a run is looked for while an answer is awaited.
const PAUSE: Duration = Duration::from_millis(50);

/// A command of which each process judges many URDDs. There are as many processes as URDDs are judged at once.
pub struct Batch<'a> {
    words: &'a [String],
    idle: Mutex<Vec<Judge>>,
}

struct Judge {
    input: ChildStdin,
    answers: Receiver<String>,
    stderr: Option<Tail>,
    /// Ends with it.
    _running: Running,
}

impl<'a> Batch<'a> {
    /// A command; its processes begin with the first URDDs.
    pub fn new(words: &'a [String]) -> Self {
        Batch { words, idle: Mutex::default() }
    }

    /// Asks a process for its verdict on a URDD: the first word of its answer is the exit status that a command would have
    /// had. A process that gives no verdict in time, or none at all, is ended, and the next URDD gets another one.
    pub fn ask(
        &self,
        path: &Path,
        limit: Duration,
        cancellation: &Cancellation,
    ) -> Result<Ran, Cancelled> {
        cancellation.check()?;
        let idle = self.idle.lock().pop();
        let mut judge = match idle.map_or_else(|| Judge::start(self.words), Ok) {
            Ok(judge) => judge,
            Err(error) => return Ok(Ran::without_output(End::NotStarted(error.to_string()))),
        };
        let begin = Instant::now();
        // A process that is gone gives no answer: see below.
        let line = format!("{}\n", path.to_string_lossy());
        let _ = judge.input.write_all(line.as_bytes());
        let answer = loop {
            cancellation.check()?;
            match judge.answers.recv_timeout(PAUSE) {
                Ok(answer) => break Ok(answer),
                Err(RecvTimeoutError::Disconnected) => break Err(End::NoAnswer),
                Err(RecvTimeoutError::Timeout) if begin.elapsed() >= limit => {
                    break Err(End::TimeLimit);
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
        };
        let duration = begin.elapsed();
        let status = |answer: &str| answer.split_whitespace().next()?.parse().ok();
        let (end, stdout) = match answer {
            Ok(answer) => match status(&answer) {
                Some(status) => (End::Status(status), answer),
                None => (End::NotAVerdict(answer.clone()), answer),
            },
            Err(end) => (end, String::new()),
        };
        let mut scan = Scan::default();
        scan.read(stdout.as_bytes());
        let codes = scan.finish();
        let stderr = match &end {
            End::Status(_) => {
                self.idle.lock().push(judge);
                String::new()
            }
            _ => judge.stderr.take().map(|tail| tail.finish().0).unwrap_or_default(),
        };
        Ok(Ran { end, stdout, stderr, codes, duration })
    }
}

impl Judge {
    fn start(words: &[String]) -> std::io::Result<Judge> {
        let (mut running, input) = Running::start_with_input(command(words, String::clone))?;
        let (stdout, stderr) = running.streams();
        let (sender, answers) = channel();
        thread::spawn(move || {
            let mut stdout = stdout.map(BufReader::new)?;
            while let Some(answer) = read_line(&mut stdout) {
                sender.send(answer).ok()?;
            }
            Some(())
        });
        Ok(Judge { input, answers, stderr: stderr.map(Tail::of), _running: running })
    }
}

/// The next line; `None` at the end, or for one that is too long.
fn read_line(stdout: &mut BufReader<ChildStdout>) -> Option<String> {
    let mut line = Vec::new();
    stdout.by_ref().take(MAX_ANSWER).read_until(b'\n', &mut line).ok()?;
    line.ends_with(b"\n").then(|| String::from_utf8_lossy(&line).trim_end().to_owned())
}

#[cfg(all(test, unix))]
#[allow(clippy::unwrap_used)] // Clippy sees no test in `all(test, unix)`.
mod tests {
    use super::*;
    use urdd_validate::code::Code;

    fn words(script: &str) -> Vec<String> {
        ["sh", "-c", script].map(str::to_owned).to_vec()
    }

    fn asked(script: &str, paths: &[&str]) -> Vec<Ran> {
        let words = words(script);
        let batch = Batch::new(&words);
        let limit = Duration::from_secs(20);
        let ask = |path: &&str| batch.ask(Path::new(path), limit, &Cancellation::default());
        paths.iter().map(|path| ask(path).unwrap()).collect()
    }

    #[test]
    fn one_process_judges_all() {
        let script = "n=0; while read -r dir; do n=$((n+1)); case $dir in *bad) echo \"1 DOF003 $n\";; \
            *) echo \"0 $n\";; esac; done";
        let ran = asked(script, &["/a good", "/bad", "/good"]);
        let ends: Vec<&End> = ran.iter().map(|ran| &ran.end).collect();
        assert_eq!(ends, [&End::Status(0), &End::Status(1), &End::Status(0)]);
        assert_eq!(ran[2].stdout, "0 3");
        assert_eq!(ran[1].codes, [Code::DOF003].into());
    }

    #[test]
    fn a_process_without_a_verdict_is_replaced() {
        let script = "while read -r dir; do case $dir in *gone) echo oops >&2; exit 0;; *odd) echo yes;; \
            *long) sleep 60;; *) echo 0;; esac; done";
        let ran = asked(script, &["/good", "/gone", "/good", "/odd", "/good"]);
        let ends: Vec<End> = ran.iter().map(|ran| ran.end.clone()).collect();
        let odd = End::NotAVerdict("yes".to_owned());
        let good = End::Status(0);
        assert_eq!(ends, [good.clone(), End::NoAnswer, good.clone(), odd, good]);
        assert_eq!(ran[1].stderr, "oops\n");
        let words = words(script);
        let batch = Batch::new(&words);
        let short = Duration::from_millis(200);
        let late = batch.ask(Path::new("/long"), short, &Cancellation::default()).unwrap();
        assert_eq!(late.end, End::TimeLimit);
    }
}
