//! Generates the robots that the page shows, and follows their files.
//!
//! A robot is generated when a page opens it: first a URDD with what the picture, the joints and the sliders need, which
//! takes less than a second, then all of it. When a file that was read changes while a page shows the robot, both are
//! generated again; what did not change is taken from the last ones. [`Cards`] has the pictures of robots that nobody has
//! opened.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::{self, Scope, ScopedJoinHandle};
use std::time::{Duration, Instant};

use parking_lot::Mutex;
use rayon::ThreadPool;

use crate::cards::Cards;
use crate::collection::Collection;
use crate::shown::{Making, Shown, Source};
use crate::{picture, revision};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::root::Root;
use urdd_format::registry::ModuleKind;
use urdd_generate::batch::{Observer, caught};
use urdd_generate::{GenerateError, Generated, Progress, Settings};
use urdd_source::included;
use urdd_source::robots::Job;

/// How often the files are compared.
const PAUSE: Duration = Duration::from_millis(200);
/// A page that has not asked for so long shows another robot, or is closed.
const FORGOTTEN: Duration = Duration::from_secs(5);

/// The files that a robot was generated from, and their fingerprints before they were read.
type Files = BTreeMap<PathBuf, String>;

/// Generates robots, each in its own folder below a temporary one.
pub struct Live<'a> {
    /// Where the generated URDDs go.
    pub folder: &'a Path,
    /// How to generate them.
    pub settings: &'a Settings,
    /// Receives the progress and the results for the terminal.
    pub observer: &'a dyn Observer,
    /// Pause after a picture before the rest is generated: the page draws meanwhile, and whoever saves often is not
    /// hindered.
    pub pause: Duration,
}

#[derive(Clone)]
struct Followed {
    shown: Arc<Shown>,
    source: Source,
    job: Job,
    folder: PathBuf,
    files: Files,
    /// Counts its pictures.
    turn: usize,
    /// When the last picture was made, if the rest has to be generated.
    is_partial_since: Option<Instant>,
}

/// A run that generates all of a robot.
struct Run<'scope> {
    id: String,
    turn: usize,
    cancellation: Cancellation,
    thread: ScopedJoinHandle<'scope, Result<Generated, GenerateError>>,
}

impl Live<'_> {
    /// Generates the robots of a collection that pages ask for, and follows their files, until the settings'
    /// cancellation.
    pub fn run(&self, collection: &Collection) {
        // Pictures do not wait for the threads that generate the rest.
        let pool = rayon::ThreadPoolBuilder::new().build().ok();
        let mut known: BTreeMap<String, Followed> = BTreeMap::new();
        thread::scope(|scope| {
            let mut running: Option<Run<'_>> = None;
            let mut cards = Cards::new(self.settings);
            while !self.settings.source.cancellation.is_cancelled() {
                for shown in collection.robots() {
                    if !is_watched(&shown) {
                        continue;
                    }
                    let Some(source) = shown.source.clone() else { continue };
                    let id = shown.id.clone();
                    let robot = known.entry(id).or_insert_with(|| self.followed(shown, source));
                    if robot.turn > 0 && robot.is_current() {
                        continue;
                    }
                    // Whoever waits for a picture comes first; the run that was stopped begins again later.
                    if let Some(run) = &running {
                        run.cancellation.cancel();
                    }
                    cards.stop();
                    self.picture(robot, pool.as_ref());
                }
                if let Some(run) = running.take_if(|run| run.thread.is_finished()) {
                    finish(run, &mut known);
                } else if running.is_none() {
                    running = self.begin(scope, &known);
                }
                cards.go_on(scope, collection, running.is_some() || known.values().any(is_due));
                thread::sleep(PAUSE);
            }
            cards.stop();
            if let Some(run) = running {
                run.cancellation.cancel();
            }
        });
    }

    /// Generates all of a robot now. Returns whether it succeeded.
    pub fn generate(&self, shown: &Arc<Shown>) -> bool {
        let Some(source) = shown.source.clone() else { return true };
        let robot = self.followed(Arc::clone(shown), source);
        let outcome = self.whole(&robot, self.settings.source.cancellation.clone());
        let is_made = outcome.is_ok();
        robot.end(outcome);
        is_made
    }

    fn followed(&self, shown: Arc<Shown>, source: Source) -> Followed {
        let folder = self.folder.join(&shown.id);
        // The URDD's folder has the robot's name, which the page shows.
        let name = shown.name.replace(['/', '\\', '\0'], "_");
        Followed {
            job: Job::new(source.file.clone(), name),
            source,
            folder,
            files: Files::new(),
            turn: 0,
            is_partial_since: None,
            shown,
        }
    }

    /// Generates what the picture needs, and shows it.
    fn picture(&self, robot: &mut Followed, pool: Option<&ThreadPool>) {
        robot.turn += 1;
        // Before anything is read, so that later changes are noticed.
        let before = robot.files.keys().map(|file| (file.clone(), revision::of_file(file)));
        let files = Mutex::new(before.collect());
        let target = robot.picture_path();
        let progress = Reading { shown: &robot.shown, files: &files };
        let settings = Settings {
            selection: picture::modules(),
            donors: donors([&target]),
            ..robot.source.settings(self.settings)
        };
        let make = || {
            caught(&robot.job.source, || {
                urdd_generate::generate(&robot.job.source, &target, &settings, &progress)
            })
        };
        let made = match pool {
            Some(pool) => pool.install(make),
            None => make(),
        };
        let mut files = files.into_inner();
        for file in included(&robot.job.source, &settings.source) {
            let word = revision::of_file(&file);
            files.entry(file).or_insert(word);
        }
        robot.files = files;
        match made {
            Ok(generated) => {
                let rest = Making::Running { what: "the rest".to_owned(), done: 0, of: 0 };
                robot.shown.show(target, notes(&generated), rest);
                robot.is_partial_since = Some(Instant::now());
            }
            Err(GenerateError::Cancelled) => {}
            Err(error) => {
                robot.is_partial_since = None;
                robot.shown.set_making(Making::Failed(error.to_string()));
                self.observer.done(&robot.job, &Err(error));
            }
        }
    }

    /// Begins to generate all of the robot that was asked for last, if one has only a picture.
    fn begin<'scope, 'env: 'scope>(
        &'env self,
        scope: &'scope Scope<'scope, 'env>,
        known: &BTreeMap<String, Followed>,
    ) -> Option<Run<'scope>> {
        let is_over = |since: Instant| since.elapsed() >= self.pause;
        let waiting = known.iter().filter(|(_, robot)| robot.is_partial_since.is_some_and(is_over));
        let waiting = waiting.filter(|(_, robot)| is_watched(&robot.shown));
        let (id, robot) = waiting.min_by_key(|(_, robot)| robot.shown.unseen_for())?;
        let cancellation = Cancellation::default();
        let (copy, wish) = (robot.clone(), cancellation.clone());
        let thread = scope.spawn(move || self.whole(&copy, wish));
        Some(Run { id: id.clone(), turn: robot.turn, cancellation, thread })
    }

    fn whole(
        &self,
        robot: &Followed,
        cancellation: Cancellation,
    ) -> Result<Generated, GenerateError> {
        let target = robot.whole_path();
        let mut settings = Settings {
            donors: donors([&target, &robot.picture_path()]),
            ..robot.source.settings(self.settings)
        };
        settings.source.cancellation = cancellation.clone();
        let progress =
            Told { terminal: self.observer.begin(&robot.job), shown: &robot.shown, cancellation };
        let outcome = caught(&robot.job.source, || {
            urdd_generate::generate(&robot.job.source, &target, &settings, &progress)
        });
        drop(progress);
        if !matches!(outcome, Err(GenerateError::Cancelled)) {
            self.observer.done(&robot.job, &outcome);
        }
        outcome
    }
}

/// Whether a page shows a robot that was not saved, or waits for it.
fn is_watched(shown: &Shown) -> bool {
    let is_seen = shown.unseen_for().is_some_and(|time| time < FORGOTTEN);
    is_seen && shown.is_temporary()
}

/// Whether somebody watches a robot of which only the picture is generated.
fn is_due(robot: &Followed) -> bool {
    robot.is_partial_since.is_some() && is_watched(&robot.shown)
}

/// Takes the result of a run, unless it was stopped, or the robot has another picture since.
fn finish(run: Run<'_>, known: &mut BTreeMap<String, Followed>) {
    let Ok(outcome) = run.thread.join() else { return };
    let robot = known.get_mut(&run.id);
    let Some(robot) = robot.filter(|robot| robot.turn == run.turn) else { return };
    if matches!(outcome, Err(GenerateError::Cancelled)) {
        return;
    }
    robot.is_partial_since = None;
    robot.end(outcome);
}

impl Followed {
    /// The URDD for the picture.
    fn picture_path(&self) -> PathBuf {
        self.folder.join("picture").join(&self.job.name)
    }

    fn whole_path(&self) -> PathBuf {
        self.folder.join("whole").join(&self.job.name)
    }

    fn is_current(&self) -> bool {
        self.files.iter().all(|(file, word)| revision::of_file(file) == *word)
    }

    /// Shows the whole URDD, or why there is none.
    fn end(&self, outcome: Result<Generated, GenerateError>) {
        match outcome {
            Ok(made) => self.shown.show(self.whole_path(), notes(&made), Making::Done),
            Err(error) => self.shown.set_making(Making::Failed(error.to_string())),
        }
    }
}

fn notes(generated: &Generated) -> Vec<String> {
    generated.notes.iter().map(ToString::to_string).collect()
}

/// The last URDDs of a robot, from which unchanged links are taken.
fn donors<'a>(paths: impl IntoIterator<Item = &'a PathBuf>) -> Vec<Root> {
    let paths: BTreeSet<&PathBuf> = paths.into_iter().filter(|path| path.is_dir()).collect();
    paths.into_iter().filter_map(|path| Root::open_folder(path).ok()).collect()
}

struct Reading<'a> {
    shown: &'a Shown,
    files: &'a Mutex<Files>,
}

impl Progress for Reading<'_> {
    fn module(&self, kind: ModuleKind, done: usize, total: usize) {
        // The picture of before stays until there is another.
        if !self.shown.is_ready() {
            self.shown.set_making(running(kind, done, total));
        }
    }

    fn reads(&self, file: &Path) {
        let first = || revision::of_file(file);
        self.files.lock().entry(file.to_owned()).or_insert_with(first);
    }
}

/// Reports the progress of a whole URDD to the terminal and the page.
struct Told<'a> {
    terminal: Box<dyn Progress>,
    shown: &'a Shown,
    cancellation: Cancellation,
}

impl Progress for Told<'_> {
    fn module(&self, kind: ModuleKind, done: usize, total: usize) {
        self.terminal.module(kind, done, total);
        if !self.cancellation.is_cancelled() {
            self.shown.set_making(running(kind, done, total));
        }
    }

    fn part(&self, kind: ModuleKind, done: usize, total: usize) {
        self.terminal.part(kind, done, total);
    }
}

fn running(kind: ModuleKind, done: usize, of: usize) -> Making {
    Making::Running { what: kind.name().to_owned(), done, of }
}
