//! `urdd conformance export`.

use std::fs;

use crate::conformance::{conformance, stderr};

#[test]
fn files_of_others_are_never_overwritten() {
    let folder = testkit::temporary::folder();
    fs::write(folder.path().join("mine"), "mine").expect("written");
    let refused = conformance(&["export", folder.path().to_str().expect("UTF-8")]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("not empty"), "{}", stderr(&refused));
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
}
