//! How long `generate` takes and how much it writes, for chains of growing length.
//!
//! `cargo bench --bench generate` prints for each chain, made on one thread: the time (least of
//! several runs), the bytes of the URDD, both per link, and how much memory the program has taken at
//! most so far (Linux). The paths of pairs stop at 300 links (SPEC 6.4.6).

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use urdd::generate::{Settings, generate};

const RUNS: usize = 3;

fn main() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    println!(
        "{:>8} {:>10} {:>10} {:>10} {:>10} {:>10}",
        "links", "ms", "ms/link", "MB", "kB/link", "peak MB"
    );
    for links in [10, 100, 300, 301, 500, 1000, 2000] {
        let source = folder.path().join(format!("chain_{links}.urdf"));
        fs::write(&source, chain(links)).expect("the URDF");
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .build()
            .expect("a thread");
        let mut least = Duration::MAX;
        let mut bytes = 0;
        for run in 0..RUNS {
            let target = folder.path().join(format!("{links}_{run}"));
            let start = Instant::now();
            let made = pool.install(|| generate(&source, &target, &Settings::default(), &()));
            least = least.min(start.elapsed());
            made.expect("a URDD");
            bytes = size(&target);
            fs::remove_dir_all(&target).expect("removed");
        }
        let (ms, mb) = (least.as_secs_f64() * 1e3, bytes as f64 / 1e6);
        let per_link = |x: f64| x / links as f64;
        println!(
            "{links:8} {ms:10.1} {:10.3} {mb:10.2} {:10.2} {:>10}",
            per_link(ms),
            per_link(mb * 1e3),
            peak_mb()
        );
    }
}

/// Links in a line, each on a hinge, each a box.
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

/// The most memory that this program has had, MB; `?` where the system does not tell.
fn peak_mb() -> String {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kb = line.and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
    kb.map_or_else(|| "?".to_owned(), |kb| format!("{:.0}", kb / 1e3))
}
