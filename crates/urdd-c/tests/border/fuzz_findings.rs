//! Replays the seeds of the fuzz target `border`, and what fuzzing found.

use crate::calls;

#[test]
fn border() {
    let folder = testkit::repository().join("tests/data/fuzz/border");
    let mut count = 0;
    for file in std::fs::read_dir(folder).expect("a folder of inputs") {
        calls::border(&std::fs::read(file.expect("an entry").path()).expect("an input"));
        count += 1;
    }
    assert!(count > 2);
}
