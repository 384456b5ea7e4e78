//! Runs that are killed at any moment.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use super::{files, mjcf};
use testkit::trials::trials;

type Written = Vec<(String, Vec<u8>)>;

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
    command.args(arguments).current_dir(folder).stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// Writes two robots into one place in turn, and kills each run at another moment. What is there is one of the two, but
/// for what is hidden, and the next run takes that away. `mine` is a file of a person in the same folder.
fn kill(arguments: [&[&str]; 2], folder: &Path, place: &Path, mine: Option<&str>) {
    let visible = |files: Written| -> Written {
        let is_hidden = |name: &str| name.split('/').any(|part| part.starts_with(".urdd-"));
        files.into_iter().filter(|(name, _)| !is_hidden(name)).collect()
    };
    let run = |which: usize| command(folder, arguments[which]);
    let whole = [0, 1].map(|which| {
        if let Some(name) = mine {
            fs::create_dir_all(place).unwrap();
            fs::write(place.join(name), "mine").unwrap();
        }
        assert!(run(which).status().unwrap().success());
        files(place)
    });
    assert!(whole[0] != whole[1]);
    let usual = (0..4).map(|number| {
        let begun = Instant::now();
        assert!(run(number % 2).status().unwrap().success());
        begun.elapsed()
    });
    let usual = usual.min().unwrap();
    let beside = files(folder).len();
    let kills = trials(30);
    let (mut killed, mut seen) = (0, [0, 0]);
    for number in 0..kills {
        let mut child = run(number as usize % 2).spawn().unwrap();
        std::thread::sleep(usual.mul_f64(1.1 * f64::from(number) / f64::from(kills)));
        let _ = child.kill();
        killed += usize::from(child.wait().unwrap().code().is_none());
        let found = visible(files(place));
        let mut which = whole.iter().position(|whole| *whole == found);
        // Among other files, a kill may come between two moves. The next run moves the rest: without `--force`.
        if which.is_none() && mine.is_some() {
            let is_of_one = |file| whole.iter().any(|whole| whole.contains(file));
            assert!(found.iter().all(is_of_one), "kill {number}");
            let (force, next) = arguments[number as usize % 2].split_last().unwrap();
            assert_eq!(*force, "--force");
            let is_next = command(folder, next).status().unwrap().success();
            which = whole.iter().position(|whole| *whole == files(place));
            // The run that was killed may have been moving the rest of the one before it, which is the other robot's: the
            // next run moves that too, and then refuses to write over it.
            let other = usize::from(!is_next);
            assert_eq!(which, Some((number as usize + other) % 2), "kill {number}");
        }
        let which = which.unwrap_or_else(|| {
            let names: Vec<&String> = found.iter().map(|(name, _)| name).collect();
            panic!("kill {number}: neither of the two: {names:?}")
        });
        seen[which] += 1;
    }
    assert!(killed > 2, "{killed} of {kills} were killed: {seen:?}");
    for which in [0, 1] {
        assert!(run(which).status().unwrap().success());
        assert!(files(place) == whole[which]);
        assert_eq!(files(folder).len(), beside, "{:?}", files(folder));
    }
}

#[test]
fn a_killed_import_leaves_the_old_files_or_the_new_ones() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    fs::write(folder.join("one.xml"), mjcf(1)).unwrap();
    fs::write(folder.join("two.xml"), mjcf(2)).unwrap();
    let arguments: [&[&str]; 2] = [
        &["import", "one.xml", "-o", "out", "--force"],
        &["import", "two.xml", "-o", "out", "--force"],
    ];
    kill(arguments, folder, &folder.join("out"), None);
    fs::remove_dir_all(folder.join("out")).unwrap();
    kill(arguments, folder, &folder.join("out"), Some("mine"));
}

#[test]
fn a_killed_export_leaves_the_old_files_or_the_new_ones() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    for (number, name) in [(1, "one"), (2, "two")] {
        let source = format!("{name}.xml");
        fs::write(folder.join(&source), mjcf(number)).unwrap();
        let made = command(folder, &["generate", &source, "-o", name]).status().unwrap();
        assert!(made.success());
    }
    let arguments: [&[&str]; 2] = [
        &["export", "moveit", "one", "-o", "out", "--package", "r", "--force"],
        &["export", "moveit", "two", "-o", "out", "--package", "r", "--force"],
    ];
    kill(arguments, folder, &folder.join("out"), None);
    let arguments: [&[&str]; 2] = [
        &["export", "mjcf", "one", "-o", "place/r.xml", "--force"],
        &["export", "mjcf", "two", "-o", "place/r.xml", "--force"],
    ];
    fs::create_dir(folder.join("place")).unwrap();
    kill(arguments, folder, &folder.join("place"), Some("mine"));
}
