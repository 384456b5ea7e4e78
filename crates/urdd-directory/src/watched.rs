//! Work on the robots of a run, each within its limits.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use rayon::prelude::*;

use crate::cancellation::{Cancellation, Limit};

/// Time between two looks at whether a robot is given up.
const PAUSE: Duration = Duration::from_millis(20);

/// What comes of each robot of a run, in their order. They are worked on beside each other; one after the other if the run is
/// watched: see [`Cancellation::is_watched`].
pub fn map_robots<J: Sync, T: Send>(
    run: &Cancellation,
    robots: &[J],
    work: impl Fn(&J) -> T + Sync + Send,
) -> Vec<T> {
    match run.is_watched() {
        true => robots.iter().map(work).collect(),
        false => robots.par_iter().map(work).collect(),
    }
}

/// What comes of the work on a robot of a run. If the run is watched, the work has threads of its own: a robot that does not
/// stop beyond its limits is given up and left behind, and the others do not wait for it. `work` does not panic.
///
/// # Errors
/// The limit that the robot exceeded.
pub fn watched<T: Send + 'static>(
    run: &Cancellation,
    name: &str,
    work: impl FnOnce(&Cancellation) -> T + Send + 'static,
) -> Result<T, Limit> {
    if !run.is_watched() {
        return Ok(work(run));
    }
    let robot = run.robot(name);
    let (own, (sender, receiver)) = (robot.clone(), channel());
    let work = move || drop(sender.send(work(&own)));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(rayon::current_num_threads());
    match pool.build() {
        Ok(pool) => pool.spawn(work),
        // There are no threads to be had.
        Err(_) => work(),
    }
    loop {
        let found = receiver.recv_timeout(PAUSE);
        match (robot.limit(), found) {
            (None, Ok(found)) => return Ok(found),
            (Some(limit), Ok(_) | Err(RecvTimeoutError::Disconnected)) => return Err(limit),
            (Some(limit), Err(RecvTimeoutError::Timeout)) if robot.is_given_up() => {
                return Err(limit);
            }
            (_, Err(RecvTimeoutError::Timeout)) => {}
            (None, Err(RecvTimeoutError::Disconnected)) => unreachable!("a panic ends the process"),
        }
    }
}
