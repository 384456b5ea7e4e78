//! A displayed robot: its files, its generation, the picture of its card, and what a program shows of it.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use parking_lot::{Condvar, Mutex};
use serde_json::json;

use crate::http::{Body, Reply};
use crate::revision;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::carried;
use urdd_directory::metadata::Files;
use urdd_directory::root::{ReadError, Root};
use urdd_generate::Settings;
use urdd_robot::Robot;
use urdd_source::Settings as SourceSettings;

/// A displayed robot.
#[derive(Debug, Default)]
pub struct Shown {
    /// Its unique identifier in URLs: ASCII letters, digits, `-`, `_` and `.`.
    pub id: String,
    /// Its displayed name: its path from the given folder.
    pub name: String,
    /// The URDF that it is generated from; `None` for a URDD.
    pub source: Option<Source>,
    /// The configurations that a program shows.
    pub states: Arc<States>,
    standing: Mutex<Standing>,
    /// The files, and their revision.
    pub(super) opened: Mutex<Option<(String, Opened)>>,
    /// When a page last asked for it.
    seen: Mutex<Option<Instant>>,
    /// The report, and its revision.
    pub(super) report: Mutex<Option<(String, String)>>,
    /// The picture, and its revision.
    pub(super) picture: Mutex<Option<(String, Option<Vec<u8>>)>>,
    /// The picture of its card before it is generated.
    pub(super) card: Card,
    /// The saves that can be undone: the revision after each, and the files before it.
    pub(super) undo: Mutex<Vec<(String, Files)>>,
}

/// What a robot is generated from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// The URDF or xacro file.
    pub file: PathBuf,
    /// Folders of packages besides those of the settings, each as `NAME=PATH`.
    pub packages: Vec<String>,
    /// Arguments for xacro that are declared of it, each as `name:=value`.
    pub arguments: Vec<String>,
}

impl Source {
    /// The settings to read it with: with its own packages and arguments.
    pub fn settings(&self, all: &Settings) -> Settings {
        let source = self.with_packages(&all.source).with_declared(&self.arguments);
        Settings { source, ..all.clone() }
    }

    /// These settings with its own packages.
    pub(super) fn with_packages(&self, all: &SourceSettings) -> SourceSettings {
        let mut settings = all.clone();
        for package in &self.packages {
            // A folder that is gone: its meshes are not found, and the page says so.
            let _ = settings.packages.add(package);
        }
        settings
    }
}

#[derive(Debug, Default)]
struct Standing {
    path: PathBuf,
    is_ready: bool,
    notes: Vec<String>,
    kind: Access,
    making: Making,
}

/// The operations allowed on a robot's files.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum Access {
    /// An archive or a URDD from before version 1: read-only.
    #[default]
    ReadOnly,
    /// A version 1 folder: skips can be saved.
    Writable,
    /// Generated for display: the whole URDD can be saved into a folder.
    Temporary,
}

/// Progress of a robot's generation.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub enum Making {
    /// Generation is complete, or was not needed.
    #[default]
    Done,
    /// Nobody has opened it yet.
    Waiting,
    /// A module is being generated.
    Running {
        /// The module.
        what: String,
        /// Number of finished modules.
        done: usize,
        /// Total number of modules.
        of: usize,
    },
    /// Generation failed, with the reason.
    Failed(String),
}

/// The files of a displayed robot. All requests share one archive in memory.
#[derive(Debug, Clone)]
pub struct Opened {
    /// All files: for the validator.
    pub all: Root,
    /// The URDD's own files (see [`carried`]): for everything else.
    pub own: Root,
    /// The robot.
    pub robot: Arc<Robot>,
}

impl Opened {
    /// The files of a robot, as they are now.
    pub(super) fn of(root: &Root) -> Result<Self, ReadError> {
        let all = root.kept();
        let own = carried(&all)?;
        Ok(Opened { robot: Arc::new(Robot::of(own.clone())), own, all })
    }
}

impl Shown {
    /// One that is at a path, or that is generated from a source.
    pub(super) fn new(
        id: String,
        name: String,
        source: Option<Source>,
        path: PathBuf,
        kind: Access,
    ) -> Self {
        let is_ready = source.is_none();
        let making = if is_ready { Making::Done } else { Making::Waiting };
        let standing = Standing { path, is_ready, kind, making, ..Standing::default() };
        Shown { id, name, source, standing: Mutex::new(standing), ..Shown::default() }
    }

    /// The current files, and their revision.
    ///
    /// # Errors
    /// If they no longer exist or cannot be read.
    pub fn open(&self) -> Result<(String, Opened), ReadError> {
        let path = self.path();
        // Taken before the files are listed, so that later changes are detected.
        let revision = revision::of(&path);
        let mut opened = self.opened.lock();
        if let Some((of, known)) = opened.as_ref()
            && *of == revision
        {
            return Ok((revision, known.clone()));
        }
        // Drops the old archive first: only one is in memory.
        *opened = None;
        let found = Opened::of(&Root::open(&path)?)?;
        *opened = Some((revision.clone(), found.clone()));
        Ok((revision, found))
    }

    /// The URDD's own files as last listed: all requests for files of an archive read the same archive.
    ///
    /// # Errors
    /// As [`Shown::open`].
    pub fn own_files(&self) -> Result<Root, ReadError> {
        let known = self.opened.lock().as_ref().map(|(_, opened)| opened.own.clone());
        known.map_or_else(|| Ok(self.open()?.1.own), Ok)
    }

    /// The path of its folder or archive.
    pub fn path(&self) -> PathBuf {
        self.standing.lock().path.clone()
    }

    /// The assumptions made when it was generated for display.
    pub fn notes(&self) -> Vec<String> {
        self.standing.lock().notes.clone()
    }

    /// Whether its skips can be saved.
    pub fn is_writable(&self) -> bool {
        self.standing.lock().kind == Access::Writable
    }

    /// Whether it is deleted when the program ends, unless it is saved.
    pub fn is_temporary(&self) -> bool {
        self.standing.lock().kind == Access::Temporary
    }

    /// Progress of its generation.
    pub fn making(&self) -> Making {
        self.standing.lock().making.clone()
    }

    /// Sets the progress of its generation.
    pub fn set_making(&self, making: Making) {
        self.standing.lock().making = making;
    }

    /// Whether there is something to show.
    pub fn is_ready(&self) -> bool {
        self.standing.lock().is_ready
    }

    /// Records that a page shows it, or waits for it.
    pub fn see(&self) {
        *self.seen.lock() = Some(Instant::now());
    }

    /// How long ago a page last asked for it.
    pub fn unseen_for(&self) -> Option<Duration> {
        self.seen.lock().map(|seen| seen.elapsed())
    }

    /// Shows what was generated at a path, with these assumptions, while `making` goes on. Not if it was saved
    /// meanwhile.
    pub fn show(&self, path: PathBuf, notes: Vec<String>, making: Making) {
        let mut standing = self.standing.lock();
        if standing.kind == Access::Temporary {
            standing.path = path;
            standing.notes = notes;
            standing.making = making;
            standing.is_ready = true;
        }
    }

    /// Records that it is now in a folder of the user.
    pub(super) fn keep_at(&self, path: PathBuf) {
        *self.opened.lock() = None;
        let mut standing = self.standing.lock();
        standing.path = path;
        standing.kind = Access::Writable;
        standing.making = Making::Done;
    }
}

/// Maximum time that a request waits for a picture; the page asks again when it shows the card again.
const PATIENCE: Duration = Duration::from_secs(25);
/// How often a waiting request looks whether it has to end.
const LOOK: Duration = Duration::from_millis(100);

/// A picture as PNG; `None` of a robot that cannot be drawn.
pub type Picture = Option<Arc<[u8]>>;

/// The picture, and who waits for it.
#[derive(Debug, Default)]
pub struct Card {
    state: Mutex<CardState>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct CardState {
    waiting: usize,
    /// The picture, and the revision of the URDF that it shows.
    made: Option<(String, Picture)>,
}

impl Card {
    /// The picture of this revision of the URDF, once it is made; `None` after [`PATIENCE`], or when `stop` says so.
    pub fn wait(&self, revision: &str, stop: &dyn Fn() -> bool) -> Picture {
        let until = Instant::now() + PATIENCE;
        let mut state = self.state.lock();
        state.made.take_if(|(of, _)| of != revision);
        state.waiting += 1;
        while state.made.is_none() && Instant::now() < until {
            self.changed.wait_for(&mut state, LOOK);
            if stop() {
                break;
            }
        }
        state.waiting -= 1;
        state.made.as_ref().and_then(|(_, picture)| picture.clone())
    }

    pub fn is_wanted(&self) -> bool {
        let state = self.state.lock();
        state.waiting > 0 && state.made.is_none()
    }

    /// Takes the picture of a revision of the URDF.
    pub fn put(&self, revision: String, picture: Picture) {
        self.state.lock().made = Some((revision, picture));
        self.changed.notify_all();
    }

    /// Frees the picture's memory. It is made again when somebody asks.
    pub fn forget(&self) {
        self.state.lock().made = None;
    }
}

/// Pause after which a page without news hears that the server is still there.
const PAUSE: Duration = Duration::from_millis(500);

/// What a program showed last. Pages that are slower than the program miss what was between.
#[derive(Debug, Default)]
pub struct States {
    last: Mutex<Last>,
    changed: Condvar,
}

/// How often something was shown, and the lines that were last: `around` the robot, and its configuration.
#[derive(Debug, Default, Clone)]
struct Last {
    count: u64,
    around: Option<(u64, Arc<str>)>,
    configuration: Option<(u64, Arc<str>)>,
}

impl States {
    /// Shows a configuration: one value for each DOF, rad or m.
    pub fn set(&self, configuration: &[f64]) {
        let line = json!({ "q": configuration }).to_string();
        self.put(&line, |last| &mut last.configuration);
    }

    /// Shows what is around a robot, in place of what was: a JSON object with the keys `world` and `path`, as
    /// `page/src/showing.ts` has them.
    pub fn show(&self, around: &str) {
        self.put(around, |last| &mut last.around);
    }

    fn put(&self, text: &str, place: impl Fn(&mut Last) -> &mut Option<(u64, Arc<str>)>) {
        // A line feed in JSON is a blank.
        let line = format!("{}\n", text.replace(['\n', '\r'], " "));
        let mut last = self.last.lock();
        last.count += 1;
        let count = last.count;
        *place(&mut last) = Some((count, line.into()));
        self.changed.notify_all();
    }

    /// Whether a program has shown any.
    pub(crate) fn are_sent(&self) -> bool {
        self.last.lock().count > 0
    }

    /// Each line of JSON, from the last ones on, and empty lines meanwhile.
    pub(crate) fn stream(self: &Arc<Self>, cancellation: &Cancellation) -> Reply {
        let (states, cancellation) = (Arc::clone(self), cancellation.clone());
        let mut seen = 0;
        let next = move || {
            let mut last = states.last.lock();
            states.changed.wait_while_for(&mut last, |last| last.count == seen, PAUSE);
            if cancellation.is_cancelled() {
                return None;
            }
            let news = [&last.around, &last.configuration].into_iter().flatten();
            let oldest = news.filter(|(count, _)| *count > seen).min_by_key(|(count, _)| *count);
            let Some((count, line)) = oldest else { return Some("\n".into()) };
            seen = *count;
            Some(Arc::clone(line))
        };
        Reply::ok("application/jsonl", Body::Lines(Box::new(next)))
    }
}
