use std::fs;
use std::path::PathBuf;

use urdd_directory::target_lock::TargetLock;
use urdd_directory::target_lock::Temporary;

#[test]
fn what_is_left_goes_with_the_next_and_what_is_used_stays() {
    let place = tempfile::tempdir().unwrap();
    let living = Temporary::begin(place.path(), "shown").unwrap();
    fs::write(living.path().join("x"), "1").unwrap();
    // As a killed program leaves them: the folder, and its lock file, which no process holds.
    let left = place.path().join("urdd-shown-0123456789abcdef");
    fs::create_dir(&left).unwrap();
    fs::write(left.join("x"), "1").unwrap();
    // Not ours, though it has a lock file: a shorter number.
    let short = place.path().join("urdd-shown-0123");
    fs::create_dir(&short).unwrap();
    let lock = [&left, &short].map(|folder| TargetLock::at_once(folder).unwrap().unwrap());
    let file = fs::read_dir(place.path()).unwrap().flatten().map(|entry| entry.path());
    let file = file.filter(|file| file.extension().is_some_and(|ending| ending == "lock"));
    let files: Vec<PathBuf> = file.collect();
    drop(lock);
    files.iter().for_each(|file| fs::write(file, "").unwrap());
    // Not ours: another name, or no lock file.
    let others = ["results", "0123456789abcdeg", "fedcba9876543210", "0123456789ABCDEF"];
    let others = others.map(|name| place.path().join(format!("urdd-shown-{name}")));
    others.iter().for_each(|other| fs::create_dir(other).unwrap());
    let mine = place.path().join("urdd-mine-0123456789abcdef");
    fs::create_dir(&mine).unwrap();
    let second = Temporary::begin(place.path(), "shown").unwrap();
    assert!(!left.exists() && short.exists() && others.iter().all(|other| other.exists()));
    drop(second);
    assert!(living.path().join("x").exists() && mine.exists());
    let path = living.path().to_owned();
    drop(living);
    assert!(!path.exists());
}
