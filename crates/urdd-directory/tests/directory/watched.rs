use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, mpsc};
use std::time::Duration;

use urdd_directory::cancellation::{Cancellation, Limit};
use urdd_directory::watched::watched;

#[test]
fn a_robot_beyond_its_limits_is_stopped_or_left_behind_and_others_are_not() {
    let limit = Limit::Time(Duration::from_secs(3));
    let run = Cancellation::watched(Arc::default());
    // It never ends by itself.
    let (never, wait) = mpsc::channel::<()>();
    let wait = Mutex::new(wait);
    let is_done = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !is_done.load(Ordering::Relaxed) {
                for robot in run.in_work().into_iter().filter(|robot| robot.name == "stuck") {
                    robot.cancellation.exceed(limit);
                    robot.cancellation.give_up();
                }
                std::thread::yield_now();
            }
        });
        let stuck = watched(&run, "stuck", move |_| wait.lock().unwrap().recv().is_err());
        is_done.store(true, Ordering::Relaxed);
        assert_eq!(stuck, Err(limit));
    });
    let stops = watched(&run, "stops", move |own| {
        own.exceed(limit);
        own.check()
    });
    assert_eq!(stops, Err(limit));
    assert_eq!(watched(&run, "good", Cancellation::check), Ok(Ok(())));
    assert!(run.in_work().is_empty() && !run.is_cancelled());
    // All of them are cancelled with the run.
    run.cancel();
    assert!(watched(&run, "late", Cancellation::is_cancelled).unwrap());
    drop(never);
}

#[test]
fn without_limits_a_robot_has_the_cancellation_of_the_run() {
    let run = Cancellation::default();
    assert_eq!(watched(&run, "arm", |own| own.cancel()), Ok(()));
    assert!(run.is_cancelled() && run.in_work().is_empty());
}
