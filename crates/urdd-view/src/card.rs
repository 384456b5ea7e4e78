//! The picture of a robot of a URDF that nobody has opened yet, for its card in the gallery.

use std::sync::Arc;
use std::time::{Duration, Instant};

use parking_lot::{Condvar, Mutex};

/// Maximum time that a request waits for a picture; the page asks again when it shows the card again.
const PATIENCE: Duration = Duration::from_secs(25);
/// How often a waiting request looks whether it has to end.
const PAUSE: Duration = Duration::from_millis(100);

/// A picture as PNG; `None` of a robot that cannot be drawn.
pub type Picture = Option<Arc<[u8]>>;

/// The picture, and who waits for it.
#[derive(Debug, Default)]
pub struct Card {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct State {
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
            self.changed.wait_for(&mut state, PAUSE);
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
