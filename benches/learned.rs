//! What a self-collision model saves: its own time beside exact distances, and passing over what it clears before
//! checking the rest exactly.
//!
//! `cargo bench --bench learned -- URDD...` prints for each URDD with a model, in microseconds a configuration on one
//! thread, the median over five rounds over 5,000 sampled configurations that had no part in making it. Without
//! arguments it makes a model of `conformance/robots/welding_arm.urdf`.

use std::path::{Path, PathBuf};
use std::time::Instant;

use urdd::generate::{Selection, Settings, generate};
use urdd::robot::{Robot, ShapeKind};

/// The first of the configurations, and their number.
const FIRST: u64 = 10_000_000;
const COUNT: u64 = 5_000;
const ROUNDS: usize = 5;

fn main() {
    let given: Vec<PathBuf> = std::env::args()
        .skip(1)
        .filter(|argument| !argument.starts_with("--"))
        .map(PathBuf::from)
        .collect();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let one = one.expect("a thread");
    let paths = match given.is_empty() {
        false => given,
        true => vec![made()],
    };
    one.install(|| paths.iter().for_each(|path| measure(path)));
}

fn made() -> PathBuf {
    let target = PathBuf::from("target/bench/welding_arm_with_model");
    let settings = Settings {
        selection: Selection::parse(["all", "self_collision_model"]).expect("modules"),
        ..Settings::default()
    };
    let urdf = PathBuf::from("conformance/robots/welding_arm.urdf");
    generate(&urdf, &target, &settings, &()).expect("a URDD");
    target
}

fn measure(path: &Path) {
    let robot = Robot::open(path).expect("a URDD");
    let model = robot.collision_model().expect("a model");
    let pieces = robot.proximity(ShapeKind::Pieces).expect("pieces");
    let space = robot.configurations().expect("configurations");
    let configurations: Vec<f64> = (FIRST..FIRST + COUNT)
        .flat_map(|sample| space.random(sample))
        .collect();
    let num_dofs = pieces.num_dofs();
    println!("{}", path.display());
    let by_model = row("model", || {
        model.may_collide_batch(&configurations).expect("answers");
    });
    let distances = row("exact distances", || {
        pieces.distances_batch(&configurations).expect("distances");
    });
    let exact = row("exact collision", || {
        pieces.in_collision_batch(&configurations).expect("answers");
    });
    let both = row("model, then exact", || {
        let may = model.may_collide_batch(&configurations).expect("answers");
        let rest = configurations.chunks(num_dofs).zip(&may);
        let rest: Vec<f64> = rest
            .filter(|(_, may)| **may)
            .flat_map(|(q, _)| q.to_vec())
            .collect();
        pieces.in_collision_batch(&rest).expect("answers");
    });
    println!(
        "  exact distances take {:.1} times as long as the model, exact collision {:.1} times; both after each other {:.2} of exact collision",
        distances / by_model,
        exact / by_model,
        both / exact
    );
    let may = model.may_collide_batch(&configurations).expect("answers");
    let is = pieces.in_collision_batch(&configurations).expect("answers");
    let count = |wanted: (bool, bool)| {
        may.iter()
            .zip(&is)
            .filter(|(m, i)| (**m, **i) == wanted)
            .count()
    };
    println!(
        "  missed {} of {} collisions, cleared {} of {} free configurations",
        count((false, true)),
        count((true, true)) + count((false, true)),
        count((false, false)),
        count((false, false)) + count((true, false))
    );
}

/// Prints and returns the microseconds of a configuration.
fn row(what: &str, mut work: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let start = Instant::now();
            work();
            1e6 * start.elapsed().as_secs_f64() / COUNT as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("  {what}: {:.2} us", times[ROUNDS / 2]);
    times[ROUNDS / 2]
}
