//! Programs on Linux and their descendants, found in `/proc`.

use std::collections::{BTreeSet, HashSet};
use std::io::{self, Read};
use std::os::unix::process::CommandExt;
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command, ExitStatus};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use std::{fs, thread};

use rustix::process::{
    Pid, Signal, WaitOptions, getpid, kill_process, kill_process_group, set_child_subreaper,
    waitpid,
};

/// Maximum number of bytes of an environment to search; Linux allows 6 MiB for it and the arguments.
const MAX_ENVIRONMENT: u64 = 8 << 20;

/// Maximum number of rounds that search for remaining processes. After that, processes that cannot be ended are left.
const MAX_ROUNDS: usize = 400;

/// Time between two rounds.
const PAUSE: Duration = Duration::from_millis(5);

/// Whether orphans are reparented to this process.
static ADOPTS: AtomicBool = AtomicBool::new(false);

/// The process IDs of the running programs.
static RUNNING: Mutex<BTreeSet<i32>> = Mutex::new(BTreeSet::new());

/// A program and its descendants.
pub(super) struct Tree {
    child: Child,
    /// An environment variable of the program, which its descendants inherit.
    mark: String,
    is_reaped: bool,
}

pub(super) fn adopt_orphans() {
    // The process does not matter: `Some` means yes.
    let adopts = set_child_subreaper(Some(getpid())).is_ok();
    ADOPTS.store(adopts, Ordering::Relaxed);
}

pub(super) fn end_all() {
    running(|running| {
        for group in running.iter().filter_map(|pid| Pid::from_raw(*pid)) {
            let _ = kill_process_group(group, Signal::KILL);
        }
    });
}

impl Tree {
    pub fn start(mut command: Command) -> io::Result<Tree> {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let mark = format!("URDD_RUN_{}_{number}", std::process::id());
        command.env(&mark, "1").process_group(0);
        // Under the lock, so that no concurrent search takes this child for an orphan.
        let child = running(|running| {
            let child = command.spawn()?;
            running.insert(child.id().cast_signed());
            io::Result::Ok(child)
        })?;
        Ok(Tree { child, mark: format!("{mark}="), is_reaped: false })
    }

    pub fn input(&mut self) -> Option<ChildStdin> {
        self.child.stdin.take()
    }

    pub fn streams(&mut self) -> (Option<ChildStdout>, Option<ChildStderr>) {
        (self.child.stdout.take(), self.child.stderr.take())
    }

    pub fn try_wait(&mut self) -> io::Result<Option<ExitStatus>> {
        let status = self.child.try_wait()?;
        self.is_reaped |= status.is_some();
        Ok(status)
    }

    /// Ends all processes. They are stopped first, so that none starts another during the search.
    pub fn end(&mut self) {
        if !self.is_reaped {
            let _ = self.child.kill();
        }
        if let Some(group) = Pid::from_raw(self.pid()) {
            let _ = kill_process_group(group, Signal::KILL);
        }
        let mut stopped = HashSet::new();
        for _ in 0..MAX_ROUNDS {
            let left = self.left();
            if left.is_empty() {
                break;
            }
            let mut is_new = false;
            for pid in &left {
                if stopped.insert(*pid) {
                    is_new = true;
                    let _ = kill_process(*pid, Signal::STOP);
                }
            }
            if is_new {
                continue;
            }
            for pid in &left {
                let _ = kill_process(*pid, Signal::KILL);
            }
            thread::sleep(PAUSE);
            // Reap those that were adopted.
            for pid in &left {
                let _ = waitpid(Some(*pid), WaitOptions::NOHANG);
            }
        }
        if !self.is_reaped {
            let _ = self.child.wait();
            self.is_reaped = true;
        }
        running(|running| running.remove(&self.pid()));
    }

    fn pid(&self) -> i32 {
        self.child.id().cast_signed()
    }

    /// The remaining descendants of the program, without itself.
    fn left(&self) -> Vec<Pid> {
        let (own, root) = (std::process::id().cast_signed(), self.pid());
        let is_adopted = |process: &Process| {
            ADOPTS.load(Ordering::Relaxed)
                && process.parent == own
                && running(|running| running.len() == 1 && !running.contains(&process.pid))
        };
        let all = processes();
        let mut found: BTreeSet<i32> = BTreeSet::new();
        if !self.is_reaped {
            found.insert(root);
        }
        for process in all.iter().filter(|process| process.pid != own) {
            if process.group == root
                || is_adopted(process)
                || has_in_environment(process.pid, &self.mark)
            {
                found.insert(process.pid);
            }
        }
        // And all descendants of these.
        loop {
            let before = found.len();
            let children = all.iter().filter(|process| found.contains(&process.parent));
            let children: Vec<i32> = children.map(|process| process.pid).collect();
            found.extend(children);
            if found.len() == before {
                break;
            }
        }
        found.remove(&root);
        let alive = all.iter().filter(|process| !process.is_dead && process.pid != own);
        let left = alive.filter(|process| found.contains(&process.pid));
        left.filter_map(|process| Pid::from_raw(process.pid)).collect()
    }
}

fn running<T>(with: impl FnOnce(&mut BTreeSet<i32>) -> T) -> T {
    with(&mut RUNNING.lock().unwrap_or_else(PoisonError::into_inner))
}

struct Process {
    pid: i32,
    parent: i32,
    group: i32,
    /// Ended, but not yet reaped by its parent.
    is_dead: bool,
}

/// All processes in `/proc`.
fn processes() -> Vec<Process> {
    let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
    let pids = entries.filter_map(|entry| entry.file_name().to_str()?.parse().ok());
    pids.filter_map(process).collect()
}

/// Reads `PID (NAME) STATE PARENT GROUP …`; the name may contain any characters.
fn process(pid: i32) -> Option<Process> {
    let bytes = fs::read(format!("/proc/{pid}/stat")).ok()?;
    let text = String::from_utf8_lossy(&bytes);
    let (_, rest) = text.rsplit_once(')')?;
    let mut words = rest.split_ascii_whitespace();
    let state = words.next()?;
    Some(Process {
        pid,
        parent: words.next()?.parse().ok()?,
        group: words.next()?.parse().ok()?,
        is_dead: matches!(state, "Z" | "X"),
    })
}

/// Whether a process of the same user was started with a variable, given as `NAME=`.
fn has_in_environment(pid: i32, name: &str) -> bool {
    let Ok(file) = fs::File::open(format!("/proc/{pid}/environ")) else {
        return false;
    };
    let mut bytes = Vec::new();
    let read = file.take(MAX_ENVIRONMENT).read_to_end(&mut bytes);
    let mut variables = bytes.split(|byte| *byte == 0);
    read.is_ok() && variables.any(|variable| variable.starts_with(name.as_bytes()))
}
