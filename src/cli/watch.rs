//! What ends a run before it is done: signals, and the limits of `--max-time` and `--max-memory`.
//!
//! First the work is cancelled, and ends in a consistent state at its next look at its [`Cancellation`]. If it does not, a
//! thread that watches ends the program.

use std::io;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::sync::{Arc, OnceLock};
use std::thread;
use std::time::{Duration, Instant};

use clap::Args;
use memory_stats::memory_stats;
#[cfg(unix)]
use signal_hook::consts::SIGHUP;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::{flag, low_level};

use super::output::{self, Failure, USAGE, shown};
use urdd_directory::cancellation::{Cancellation, Limit, RobotInWork};
use urdd_directory::range::Range;
use urdd_directory::unfinished;
use urdd_source::process;

/// What each robot may take.
#[derive(Args, Debug, Clone, Copy)]
pub struct LimitArguments {
    /// The longest time for a robot. Where `lint`, `validate`, `generate` or `view --export` has several, they are read one
    /// after the other, and one that takes longer is left out; any other command ends with exit status 2.
    #[arg(long, global = true, display_order = 900, value_name = "SECONDS", value_parser = seconds)]
    max_time: Option<Duration>,

    /// The most memory that the program may have in use. A robot with which it takes more is left out, or ends the run, as for
    /// --max-time.
    #[arg(long, global = true, display_order = 901, value_name = "MB", value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    max_memory: Option<u64>,
}

const MAX_TIME: Range = Range::real("max_time", 0.001, 1e9, "seconds");

fn seconds(word: &str) -> Result<Duration, String> {
    MAX_TIME.parse(word).map(Duration::from_secs_f64)
}

impl LimitArguments {
    fn are_given(self) -> bool {
        self.max_time.is_some() || self.max_memory.is_some()
    }

    /// Refuses limits, for what works on no robots, or on them without end.
    ///
    /// # Errors
    /// If there are any.
    pub fn refuse(self) -> Result<(), String> {
        match self.are_given() {
            true => {
                Err("--max-time and --max-memory are of robots; a server runs until it is ended"
                    .to_owned())
            }
            false => Ok(()),
        }
    }
}

/// How long the work has to end by itself: after a signal, and after a limit.
const GRACE: Duration = Duration::from_millis(700);
/// How long the program waits for files that are being moved into place.
const PATIENCE: Duration = Duration::from_secs(2);
/// How long the program waits for somebody to read its last words.
const LAST_WORDS: Duration = Duration::from_millis(500);
/// Time between two looks: without limits, and with.
const PAUSES: [Duration; 2] = [Duration::from_millis(50), Duration::from_millis(5)];

/// A shell adds this to a signal's number to form an exit status.
const BY_SIGNAL: i32 = 128;

/// Watches a run. The first signal, or a limit, cancels the work at the next safe point; the second signal ends the process
/// immediately. Clones are of the same run.
#[derive(Clone)]
pub struct Watch {
    limits: LimitArguments,
    cancellation: Cancellation,
    flag: Arc<AtomicBool>,
    number: Arc<AtomicUsize>,
    /// What is said after a signal.
    stopped: Arc<OnceLock<&'static str>>,
    work: Arc<OnceLock<Work>>,
    /// Whether a robot was left behind.
    leaves: Arc<AtomicBool>,
}

/// What is worked on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Work {
    /// One robot: the run ends with its limits.
    OneRobot,
    /// Robots that have reports of their own.
    Robots,
    /// Programs of a person's, all of whose processes have to be ended.
    Programs,
    /// Whatever pages ask for: a signal is the way to end it.
    Requests,
}

impl Watch {
    /// Watches nothing yet.
    pub fn new(limits: LimitArguments) -> Self {
        let flag = Arc::<AtomicBool>::default();
        let of = if limits.are_given() { Cancellation::watched } else { Cancellation::of };
        let cancellation = of(Arc::clone(&flag));
        let (number, stopped, work, leaves) = Default::default();
        Watch { limits, cancellation, flag, number, stopped, work, leaves }
    }

    /// Runs a command that can be stopped; `stopped` is what is said after a signal. The processes that it starts end with it.
    pub fn run(
        &self,
        on: Work,
        stopped: Option<&'static str>,
        work: impl FnOnce() -> Result<u8, Failure>,
    ) -> Result<u8, Failure> {
        self.begin(on, stopped)?;
        let result = work();
        if self.leaves.load(Ordering::Relaxed) {
            process::end_all();
            unfinished::abandon(PATIENCE);
        }
        let Some(status) = self.status() else { return result };
        stopped.into_iter().for_each(output::error);
        Ok(status)
    }

    /// As [`Watch::run`], where all work is about one robot, at a path.
    pub fn run_one(
        &self,
        path: &Path,
        stopped: Option<&'static str>,
        work: impl FnOnce(&Cancellation) -> Result<u8, Failure>,
    ) -> Result<u8, Failure> {
        self.run(Work::OneRobot, stopped, || {
            let name = shown(path);
            let robot = self.cancellation.robot(&name);
            let result = work(&robot);
            match robot.limit() {
                Some(limit) => Err(format!("{name}: {limit}").into()),
                None => result,
            }
        })
    }

    /// Begins to listen for signals, and to watch.
    ///
    /// # Errors
    /// If the operating system has no such signals, or no thread.
    pub fn begin(&self, on: Work, stopped: Option<&'static str>) -> io::Result<()> {
        self.work.get_or_init(|| on);
        if let Some(stopped) = stopped {
            self.stopped.get_or_init(|| stopped);
        }
        for signal in asking() {
            // The order matters: at the first signal, the flag must not be set yet.
            flag::register_conditional_shutdown(
                signal,
                BY_SIGNAL + signal,
                Arc::clone(&self.flag),
            )?;
            flag::register(signal, Arc::clone(&self.flag))?;
            let number = usize::try_from(signal).unwrap_or_default();
            flag::register_usize(signal, Arc::clone(&self.number), number)?;
        }
        process::adopt_orphans();
        let watch = self.clone();
        thread::Builder::new().name("watch".to_owned()).spawn(move || watch.watch()).map(|_| ())
    }

    /// Cancels all robots of the run.
    pub fn cancellation(&self) -> Cancellation {
        self.cancellation.clone()
    }

    /// The exit status, if a signal was received.
    pub fn status(&self) -> Option<u8> {
        let number = i32::try_from(self.number.load(Ordering::Relaxed)).ok()?;
        let status = u8::try_from(BY_SIGNAL + number).ok()?;
        (number != 0).then_some(status)
    }

    fn watch(&self) {
        let mut asked = None;
        loop {
            thread::sleep(PAUSES[usize::from(self.limits.are_given())]);
            let Some(status) = self.status() else {
                self.look_at_limits();
                continue;
            };
            if asked.get_or_insert_with(Instant::now).elapsed() < GRACE {
                continue;
            }
            match self.work.get() {
                Some(Work::Programs) => {}
                Some(Work::Requests) => end(0, None),
                _ => end(status, self.stopped.get().copied()),
            }
        }
    }

    fn look_at_limits(&self) {
        let most = self.limits.max_memory;
        let used =
            most.and_then(|_| memory_stats()).map(|memory| memory.physical_mem as u64 / 1_000_000);
        let is_above = |most: u64| used.is_some_and(|used| used > most);
        for RobotInWork { name, since, cancellation } in self.cancellation.in_work() {
            if let Some((limit, at)) = cancellation.exceeded() {
                let is_much = most.is_some_and(|most| is_above(most + most / 4));
                let over = at.elapsed().saturating_sub(self.grace());
                if is_much || over > self.left_behind() {
                    end(USAGE, Some(&self.unended(&name, limit)));
                }
                if over > Duration::ZERO && matches!(limit, Limit::Time(_)) {
                    self.leaves.store(true, Ordering::Relaxed);
                    cancellation.give_up();
                }
            } else if let Some(most) = self.limits.max_time.filter(|most| since.elapsed() > *most) {
                cancellation.exceed(Limit::Time(most));
            } else if let Some(most) = most.filter(|most| is_above(*most)) {
                cancellation.exceed(Limit::Memory(most));
            }
        }
    }

    fn is_on(&self, work: Work) -> bool {
        self.work.get() == Some(&work)
    }

    /// How long a robot beyond a limit has to end by itself.
    fn grace(&self) -> Duration {
        match self.is_on(Work::OneRobot) {
            true => GRACE,
            false => self.limits.max_time.unwrap_or(GRACE).max(GRACE),
        }
    }

    /// How long a robot that was given up may be waited for.
    fn left_behind(&self) -> Duration {
        if self.is_on(Work::OneRobot) { Duration::ZERO } else { self.grace() }
    }

    fn unended(&self, name: &str, limit: Limit) -> String {
        match self.is_on(Work::OneRobot) {
            true => format!("{name}: {limit}"),
            false => format!(
                "{name}: {limit}. It did not stop by itself, so there is no report on any other"
            ),
        }
    }
}

/// Ends the program: what is unfinished is removed, and nothing that is being moved into place is cut off.
fn end(status: u8, words: Option<&str>) -> ! {
    process::end_all();
    unfinished::abandon(PATIENCE);
    if let Some(words) = words.map(str::to_owned) {
        // Another thread may hold standard error, and wait for its reader.
        let (said, is_said) = mpsc::channel();
        thread::spawn(move || {
            output::error(&words);
            let _ = said.send(());
        });
        let _ = is_said.recv_timeout(LAST_WORDS);
    }
    low_level::exit(status.into())
}

/// The signals that request termination. Includes the hangup of a closed terminal, unless the user ignores it
/// (`nohup`).
fn asking() -> Vec<i32> {
    let mut signals = vec![SIGINT, SIGTERM];
    #[cfg(unix)]
    if is_default(SIGHUP) {
        signals.push(SIGHUP);
    }
    signals
}

/// Whether a signal has its default action in this process, according to Linux's `/proc`.
#[cfg(unix)]
fn is_default(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mut masks = ["SigIgn:", "SigCgt:"].iter().map(|key| {
        let line = status.lines().find_map(|line| line.strip_prefix(key))?;
        u64::from_str_radix(line.trim(), 16).ok()
    });
    masks.all(|mask| mask.is_some_and(|mask| mask & (1 << (signal - 1)) == 0))
}
