//! Draws the cards of robots that are not generated yet, in the background: the one that is visible first, one at a time,
//! on one thread, and only while no robot that is open has to be generated. Each is made in memory, where only its
//! picture stays: nothing is written to the disk.

use std::collections::VecDeque;
use std::path::Path;
use std::sync::Arc;
use std::thread::{Scope, ScopedJoinHandle};
use std::time::{Duration, Instant};

use rayon::ThreadPool;

use crate::collection::Collection;
use crate::http::{Body, Reply};
use crate::shown::{Making, Picture, Shown, Source};
use crate::{picture, revision};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::root::Root;
use urdd_directory::source::Memory;
use urdd_generate::batch::caught;
use urdd_generate::{GenerateError, Settings, generate_in_memory};
use urdd_robot::Robot;

/// Maximum time for a robot; then its card has no picture.
const LONGEST: Duration = Duration::from_secs(20);
/// Maximum number of pictures that are kept, of at most 0.3 MB, and usually 0.02.
const MAX_KEPT: usize = 500;

pub struct Cards<'scope, 'a> {
    settings: &'a Settings,
    pool: Option<Arc<ThreadPool>>,
    running: Option<Run<'scope>>,
    /// Robots whose cards have a picture, the oldest first.
    kept: VecDeque<Arc<Shown>>,
}

/// A robot that is being drawn.
struct Run<'scope> {
    shown: Arc<Shown>,
    revision: String,
    since: Instant,
    cancellation: Cancellation,
    thread: ScopedJoinHandle<'scope, Result<Picture, GenerateError>>,
}

/// The response to a request for the picture of a robot that has nothing to show yet. It waits for the picture, unless
/// `stop` says so, or somebody opens the robot.
pub fn answer(robot: &Shown, stop: &dyn Fn() -> bool) -> Reply {
    let is_waiting = || robot.making() == Making::Waiting;
    let picture = robot.source.as_ref().filter(|_| is_waiting()).and_then(|source| {
        robot.card.wait(&revision::of_file(&source.file), &|| stop() || !is_waiting())
    });
    match picture {
        Some(bytes) => Reply::ok("image/png", Body::Bytes(bytes.to_vec())),
        None => Reply::nothing(),
    }
}

impl<'scope, 'a: 'scope> Cards<'scope, 'a> {
    pub fn new(settings: &'a Settings) -> Self {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().ok().map(Arc::new);
        Cards { settings, pool, running: None, kept: VecDeque::new() }
    }

    /// Takes what was drawn, and begins with the next card, unless the program is busy.
    pub fn go_on(
        &mut self,
        scope: &'scope Scope<'scope, '_>,
        collection: &Collection,
        is_busy: bool,
    ) {
        if let Some(run) = self.running.take_if(|run| run.thread.is_finished()) {
            self.end(run);
        }
        match &self.running {
            Some(run) if is_busy || run.since.elapsed() > LONGEST => run.cancellation.cancel(),
            None if !is_busy => self.running = self.begin(scope, collection),
            _ => {}
        }
    }

    /// Stops the card that is being drawn. It is drawn again later if somebody still waits for it.
    pub fn stop(&self) {
        if let Some(run) = &self.running {
            run.cancellation.cancel();
        }
    }

    fn begin(
        &self,
        scope: &'scope Scope<'scope, '_>,
        collection: &Collection,
    ) -> Option<Run<'scope>> {
        let is_wanted = |robot: &Arc<Shown>| robot.card.is_wanted();
        let shown = collection.robots().into_iter().find(is_wanted)?;
        let source = shown.source.clone()?;
        let revision = revision::of_file(&source.file);
        let cancellation = Cancellation::default();
        let mut settings =
            Settings { selection: picture::modules(), ..source.settings(self.settings) };
        settings.source.cancellation = cancellation.clone();
        let pool = self.pool.clone();
        let thread = scope.spawn(move || match pool {
            Some(pool) => pool.install(|| drawn(&source, &settings)),
            None => drawn(&source, &settings),
        });
        Some(Run { shown, revision, since: Instant::now(), cancellation, thread })
    }

    fn end(&mut self, run: Run<'_>) {
        let Run { shown, revision, since, thread, .. } = run;
        let picture = match thread.join() {
            // For a robot that is open: it is drawn later.
            Ok(Err(GenerateError::Cancelled)) if since.elapsed() <= LONGEST => return,
            Ok(Ok(picture)) => picture,
            // The card stays as it is; whoever opens the robot is told why.
            Ok(Err(_)) | Err(_) => None,
        };
        shown.card.put(revision, picture);
        self.kept.push_back(shown);
        if self.kept.len() > MAX_KEPT
            && let Some(oldest) = self.kept.pop_front()
        {
            oldest.card.forget();
        }
    }
}

/// Generates what a picture needs, in memory, and draws it.
fn drawn(Source { file, .. }: &Source, settings: &Settings) -> Result<Picture, GenerateError> {
    caught(file, || {
        let (_, files) = generate_in_memory(Path::new(file), settings, &())?;
        let root = Memory::new("robot", files).ok().map(Root::of);
        let picture =
            root.and_then(|root| picture::card(&Robot::of(root), &settings.source.cancellation));
        settings.source.cancellation.check()?;
        Ok(picture.map(Arc::from))
    })
}
