//! Cancelled batches return a cancellation error.

use testkit::robots::{made, our_robots};
use urdd_directory::cancellation::Cancellation;
use urdd_robot::{Obstacle, Queries, Robot, RobotError, ShapeKind, World};

#[test]
fn batches_of_distances_stop() {
    let (_folder, path) = made(&our_robots()[8].1);
    let robot = Robot::open(path).unwrap();
    let proximity = robot.proximity(ShapeKind::Pieces).unwrap();
    let q = robot.configurations().unwrap().random(1);
    // Minutes of work.
    let batch = q.repeat(1_000_000);
    let stopped = |ask: &(dyn Fn(&Cancellation) -> Result<(), RobotError> + Sync)| {
        let cancellation = Cancellation::default();
        std::thread::scope(|scope| {
            let asked = scope.spawn(|| ask(&cancellation));
            cancellation.cancel();
            asked.join().unwrap()
        })
    };
    let ball = Obstacle::sphere("ball", [0.5, 0.0, 0.5], 0.1).unwrap();
    let around = proximity.world_proximity(&World::new([ball])).unwrap();
    let (count, some) = (batch.len() / q.len(), &batch[..q.len() * 10_000]);
    for found in [
        stopped(&|on| proximity.in_collision_batch_into(&batch, on, &mut vec![false; count])),
        stopped(&|on| proximity.min_distance_batch_into(&batch, on, &mut vec![0.0; count])),
        stopped(&|on| {
            let mut out = vec![0.0; 10_000 * proximity.num_pairs()];
            proximity.distances_batch_into(some, on, &mut out)
        }),
        stopped(&|on| around.min_distance_batch_into(&batch, on, &mut vec![0.0; count])),
    ] {
        assert!(matches!(found, Err(RobotError::Cancelled(_))), "{found:?}");
    }
    // Without a cancellation, the result is the same.
    let (few, on) = (&batch[..q.len() * 3], Cancellation::default());
    let (mut touches, mut least) = ([false; 3], [0.0; 3]);
    let mut distances = vec![0.0; 3 * proximity.num_pairs()];
    proximity.in_collision_batch_into(few, &on, &mut touches).unwrap();
    proximity.min_distance_batch_into(few, &on, &mut least).unwrap();
    proximity.distances_batch_into(few, &on, &mut distances).unwrap();
    assert_eq!(proximity.in_collision_batch(few).unwrap(), touches);
    assert_eq!(proximity.min_distance_batch(few).unwrap(), least);
    assert_eq!(proximity.distances_batch(few).unwrap(), distances);
}
