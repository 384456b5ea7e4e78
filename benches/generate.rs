//! Time and output size of `generate`, for chains of growing length, and for the robots of the paper's timing table if
//! they are in `../shared/robots` (or `URDD_ROBOTS`).
//!
//! `cargo bench --bench generate` prints for each: the time (minimum of several runs), the bytes of the URDD, both per
//! link, and the peak memory of the program so far (Linux): within a table, it never decreases. The paths of pairs stop
//! at 300 links, or at 2,000,000 links in paths: in a line after 180 (SPEC 6.4.6).

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use urdd_generate::{Selection, Settings, generate};

const RUNS: usize = 3;

fn main() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let core =
        Settings { selection: Selection::parse(["core"]).expect("a class"), ..Settings::default() };
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let one = one.expect("a thread");
    println!("chains, core class, one thread");
    titles();
    for links in [10, 100, 180, 300, 500, 1000, 2000] {
        let source = folder.path().join(format!("chain_{links}.urdf"));
        fs::write(&source, chain(links)).expect("the URDF");
        one.install(|| measure(&format!("{links}"), &source, &core, RUNS));
    }
    println!("chains, every module, every processor");
    titles();
    for links in [10, 100, 300, 500, 1000] {
        let source = folder.path().join(format!("chain_{links}.urdf"));
        measure(&format!("{links}"), &source, &Settings::default(), 1);
    }
    let robots = std::env::var_os("URDD_ROBOTS").map(PathBuf::from);
    let robots = robots.unwrap_or_else(|| PathBuf::from("../shared/robots"));
    if !robots.is_dir() {
        println!("{} is not here: no robots", robots.display());
        return;
    }
    println!("robots, every module, every processor");
    titles();
    for robot in [
        "ur5/robot",
        "xarm7/robot",
        "h1/robot",
        "orca/robot_55links_split",
        "b1/robot_31links_apollo",
    ] {
        let source = robots.join(format!("{robot}.urdf"));
        measure(robot, &source, &Settings::default(), RUNS);
    }
}

fn titles() {
    println!(
        "{:>24} {:>6} {:>10} {:>10} {:>10} {:>10} {:>10}",
        "", "links", "ms", "ms/link", "MB", "kB/link", "peak MB"
    );
}

/// Generates a URDD several times, and prints a row.
fn measure(name: &str, source: &Path, settings: &Settings, runs: usize) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (mut least, mut bytes, mut links) = (Duration::MAX, 0, 0);
    for run in 0..runs {
        let target = folder.path().join(format!("{run}"));
        let start = Instant::now();
        let made = generate(source, &target, settings, &());
        least = least.min(start.elapsed());
        links = made.expect("a URDD").num_links;
        bytes = size(&target);
        fs::remove_dir_all(&target).expect("removed");
    }
    let (ms, mb) = (least.as_secs_f64() * 1e3, bytes as f64 / 1e6);
    let per_link = |x: f64| x / links as f64;
    println!(
        "{name:>24} {links:6} {ms:10.1} {:10.3} {mb:10.2} {:10.2} {:>10}",
        per_link(ms),
        per_link(mb * 1e3),
        peak_mb()
    );
}

/// Links in a line, each a box on a hinge.
fn chain(links: usize) -> String {
    let mut xml = "<robot name=\"chain\">\n".to_owned();
    for i in 0..links {
        xml += &format!(
            "<link name=\"link_{i}\"><visual><geometry><box size=\"0.1 0.05 0.05\"/></geometry></visual></link>\n"
        );
        if i > 0 {
            let (above, roll) = (i - 1, 0.1 * i as f64 % 3.0);
            xml += &format!(
                "<joint name=\"joint_{i}\" type=\"revolute\"><parent link=\"link_{above}\"/><child link=\"link_{i}\"/>\
                 <origin xyz=\"0.1 0 0.02\" rpy=\"{roll} 0.2 0.3\"/><axis xyz=\"0 0 1\"/>\
                 <limit lower=\"-1\" upper=\"1.5\" effort=\"10\" velocity=\"2\"/></joint>\n"
            );
        }
    }
    xml + "</robot>\n"
}

fn size(folder: &Path) -> u64 {
    let entries = fs::read_dir(folder).expect("a folder").flatten();
    let sizes = entries.map(|entry| match entry.metadata().expect("an entry") {
        metadata if metadata.is_dir() => size(&entry.path()),
        metadata => metadata.len(),
    });
    sizes.sum()
}

/// Peak memory of this program, MB; `?` if the system does not report it.
fn peak_mb() -> String {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kb = line.and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
    kb.map_or_else(|| "?".to_owned(), |kb| format!("{:.0}", kb / 1e3))
}
