//! Where the time of `generate` goes: seconds of each stage, and of each link in the stages that work on meshes.
//!
//! `cargo bench --bench profile` profiles the five robots of `../shared/robots` (or `URDD_ROBOTS`), and
//! `cargo bench --bench profile -- my/robot.urdf` any other. One thread does everything. On Linux the seconds are its
//! processor time, which other programs hardly change; elsewhere they are wall time.
//!
//! In a stage with links, *rest* is what is not done for a single link: finding equal meshes, and writing and hashing the
//! files. Links with equal meshes are counted at the first.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex};
use std::time::Instant;

use urdd_format::registry::ModuleKind;
use urdd_generate::{Progress, Settings, generate};

/// Links that took less than this fraction of the time are summed up.
const SMALL: f64 = 0.02;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let files = words.iter().filter(|word| !word.starts_with('-'));
    let mut files: Vec<PathBuf> = files.map(PathBuf::from).collect();
    if files.is_empty() {
        let robots = std::env::var_os("URDD_ROBOTS").map(PathBuf::from);
        let robots = robots.unwrap_or_else(|| PathBuf::from("../shared/robots"));
        let five = [
            "ur5/robot.urdf",
            "xarm7/robot.urdf",
            "h1/robot.urdf",
            "b1/robot.urdf",
            "orca/robot_55links_split.urdf",
        ];
        files = five.map(|robot| robots.join(robot)).into();
    }
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let one = one.expect("a thread");
    for file in files {
        one.install(|| profile(&file));
    }
}

/// Generates a URDD, and prints where the time went.
fn profile(source: &Path) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let clock = Clock(Mutex::new(Times {
        stage: "reading the URDF",
        last: seconds(),
        stages: Vec::new(),
        links: BTreeMap::new(),
    }));
    let settings = Settings::default();
    let target = folder.path().join("urdd");
    let made = generate(source, &target, &settings, &clock);
    made.unwrap_or_else(|error| panic!("{}: {error}", source.display()));
    clock.enter("end");
    let times = clock.0.into_inner().expect("no panic");
    fs::remove_dir_all(&target).expect("removed");
    print(source, &times);
}

fn print(source: &Path, times: &Times) {
    let all: f64 = times.stages.iter().map(|(_, time)| time).sum();
    println!("\n{}: {all:.3} s", source.display());
    println!("{:>9} {:>6}  stage", "s", "%");
    for (stage, time) in &times.stages {
        let of_links: f64 = times.links.values().filter_map(|of| of.get(stage)).sum();
        let rest =
            if of_links > 0.0 { format!(", rest {:.3}", time - of_links) } else { String::new() };
        println!("{time:9.3} {:6.1}  {stage}{rest}", 100.0 * time / all);
    }
    let mut kinds: Vec<&str> = times.links.values().flat_map(BTreeMap::keys).copied().collect();
    kinds.sort_unstable();
    kinds.dedup();
    for kind in &kinds {
        print!("{:>9} ", short(kind));
    }
    println!(" link");
    let sum = |of: &BTreeMap<&str, f64>| of.values().sum::<f64>();
    let mut links: Vec<_> = times.links.iter().collect();
    links.sort_by(|a, b| sum(b.1).total_cmp(&sum(a.1)));
    let mut others: BTreeMap<&str, f64> = BTreeMap::new();
    let row = |name: &str, of: &BTreeMap<&str, f64>| {
        for kind in &kinds {
            print!("{:9.3} ", of.get(kind).unwrap_or(&0.0));
        }
        println!(" {name}");
    };
    for (name, of) in links {
        if sum(of) >= SMALL * all {
            row(name, of);
        } else {
            for (kind, time) in of {
                *others.entry(kind).or_default() += time;
            }
        }
    }
    row("(other links)", &others);
}

/// What a stage makes of each link.
fn short(stage: &str) -> &str {
    match stage {
        "convex_hull_meshes" => "hulls",
        "convex_decomposition_meshes" => "pieces",
        "link_shapes_approximations" => "boxes",
        other => other,
    }
}

/// Times the stages by their progress.
struct Clock(Mutex<Times>);

struct Times {
    stage: &'static str,
    /// When the last part ended.
    last: f64,
    stages: Vec<(&'static str, f64)>,
    /// For each link, the time of each stage.
    links: BTreeMap<String, BTreeMap<&'static str, f64>>,
}

impl Times {
    /// The time since the last part ended, which belongs to the current stage.
    fn lap(&mut self) -> f64 {
        let now = seconds();
        let lap = now - self.last;
        self.last = now;
        match self.stages.last_mut() {
            Some((stage, time)) if *stage == self.stage => *time += lap,
            _ => self.stages.push((self.stage, lap)),
        }
        lap
    }
}

impl Clock {
    fn enter(&self, stage: &'static str) {
        let mut times = self.0.lock().expect("no panic");
        times.lap();
        times.stage = stage;
    }
}

impl Progress for Clock {
    fn module(&self, kind: ModuleKind, _: usize, _: usize) {
        self.enter(kind.short_name());
    }

    fn link(&self, _: ModuleKind, name: &str) {
        let mut times = self.0.lock().expect("no panic");
        let (lap, stage) = (times.lap(), times.stage);
        let link = times.links.entry(name.to_owned()).or_default();
        *link.entry(stage).or_default() += lap;
    }
}

/// The processor time of this thread, or the time since the start of the program.
fn seconds() -> f64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    let start = *START;
    let text = fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = text.split(' ').next().and_then(|word| word.parse::<f64>().ok());
    nanoseconds.map_or_else(|| start.elapsed().as_secs_f64(), |ns| ns * 1e-9)
}
