//! Paths of URDDs relative to the working directory.

use std::path::Path;

use crate::report::place::*;

#[test]
fn paths_are_seen_from_the_current_folder() {
    let seen = |path: &str| relative(Path::new(path), Path::new("/work/robots_repository"));
    let some = |text: &str| Some(text.to_owned());
    assert_eq!(seen("robots/ur5"), some("robots/ur5"));
    assert_eq!(seen("./robots/../robots/ur5/"), some("robots/ur5"));
    assert_eq!(seen("."), some(""));
    assert_eq!(seen("/work/robots_repository/ur5"), some("ur5"));
    assert_eq!(seen("../robots_repository/ur5"), some("ur5"));
    assert_eq!(seen("../ur5"), None);
    assert_eq!(seen("/work/robots_repository_2"), None);
}

#[test]
fn files_are_seen_from_there_too() {
    assert_eq!(file_in("robots/ur5", Some("a/b.json")), "robots/ur5/a/b.json");
    assert_eq!(file_in("", Some("urdd.json")), "urdd.json");
    assert_eq!(file_in("robots/ur5", Some("../panda/a.stl")), "robots/panda/a.stl");
    assert_eq!(file_in("ur5", Some("../../a.stl")), "ur5/");
    assert_eq!(file_in("ur5", None), "ur5/");
    assert_eq!(file_in("", None), "./");
}
