//! Speed of `validate`, compared with plain parsing of the same bytes in the same run.
//!
//! `cargo bench` prints, for each set of URDDs: the size of its module text (JSON and YAML), the time that serde_json
//! and serde_yaml need to parse it on one thread, the time of `validate` on one and on two threads, both as ratios to
//! that, and MB/s. Times are the minimum of several runs. Compare the ratios: the machine's speed cancels out.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

use std::fs;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use testkit::fixture::Fixture;
use testkit::robot::{Robot, joint, limit, link, origin};
use urdd_format::urdf::{Axis, JointType};
use urdd_validate::settings::Settings;
use urdd_validate::validate;

const RUNS: usize = 3;

fn main() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    println!(
        "{:38} {:>8} {:>9} {:>9} {:>6} {:>9} {:>6} {:>6}",
        "module text", "MB", "parse ms", "1 thread", "ratio", "2 threads", "ratio", "MB/s"
    );
    // The published URDDs: their YAML is not canonical, so every mirror is parsed.
    let corpus = std::env::var_os("URDD_CORPUS").map(PathBuf::from);
    let corpus = corpus.unwrap_or_else(|| PathBuf::from("../shared/corpus"));
    if corpus.is_dir() {
        measure("published URDDs, YAML parsed", &corpus);
    } else {
        println!("{} is not here: the published URDDs are not measured", corpus.display());
    }
    let mut toy = Fixture::toy();
    toy.seal();
    let root = folder.path().join("toy");
    toy.write_to(&root);
    measure("toy of 15 links, all modules", &root);
    for links in [300, 2000] {
        let root = folder.path().join(format!("chain_{links}"));
        let mut fixture = Fixture::core(&chain(links));
        canonical_mirrors(&mut fixture);
        fixture.write_to(&root);
        measure(&format!("chain of {links} links, core, canonical"), &root);
    }
}

/// Writes every mirror in the canonical emission.
fn canonical_mirrors(fixture: &mut Fixture) {
    fixture.seal();
    let documents = fixture.documents.iter().filter(|(folder, _)| *folder != "urdd.json");
    let mirrors: Vec<(String, String)> = documents
        .map(|(folder, document)| {
            (format!("{folder}/module.yaml"), urdd_directory::canonical::yaml_string(document))
        })
        .collect();
    for (path, text) in mirrors {
        fixture.put_file(&path, text);
    }
    fixture.seal();
}

/// A chain of revolute joints.
fn chain(links: usize) -> Robot {
    let mut robot = Robot::new("chain");
    let name = |i: usize| format!("link_{i}");
    robot.urdf.links = (0..links).map(|i| link(&name(i))).collect();
    for i in 1..links {
        let mut joint = joint(&format!("joint_{i}"), JointType::Revolute, &name(i - 1), &name(i));
        joint.origin = origin([0.1, 0.0, 0.02], [0.0, 0.1 * i as f64 % 3.0, 0.3]);
        joint.axis = Some(Axis { xyz: Some([0.0, 0.0, 1.0]) });
        joint.limit = limit(-1.0, 1.5);
        robot.urdf.joints.push(joint);
    }
    robot
}

fn measure(name: &str, path: &Path) {
    let texts = module_texts(path);
    let bytes: usize = texts.iter().map(|(_, text)| text.len()).sum();
    let parse = least(|| {
        for (yaml, text) in &texts {
            if *yaml {
                black_box(serde_yaml::from_str::<serde_yaml::Value>(text).expect("YAML"));
            } else {
                black_box(serde_json::from_str::<serde_json::Value>(text).expect("JSON"));
            }
        }
    });
    let settings = Settings::default();
    let [one, two] = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            least(|| {
                black_box(validate(&[path], &settings).expect("something to examine"));
            })
        })
    });
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    let mb = bytes as f64 / 1e6;
    println!(
        "{name:38} {mb:8.2} {:9.1} {:9.1} {:6.2} {:9.1} {:6.2} {:6.0}",
        ms(parse),
        ms(one),
        ms(one) / ms(parse),
        ms(two),
        ms(two) / ms(parse),
        mb / two.as_secs_f64()
    );
}

fn least(mut run: impl FnMut()) -> Duration {
    (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            run();
            start.elapsed()
        })
        .min()
        .unwrap_or_default()
}

/// The text of every `module.json` and `module.yaml` below a folder, and whether it is YAML.
fn module_texts(folder: &Path) -> Vec<(bool, String)> {
    let mut texts = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        let yaml = path.ends_with("module.yaml");
        if path.is_dir() {
            texts.extend(module_texts(&path));
        } else if yaml || path.ends_with("module.json") {
            texts.push((yaml, fs::read_to_string(&path).expect("text")));
        }
    }
    texts
}
