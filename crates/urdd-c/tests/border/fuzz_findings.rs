//! Replays the seeds of the fuzz target `border`, and what fuzzing found.

use crate::calls;

/// Calls with spheres, of numbers that are all kinds.
#[test]
fn spheres() {
    let mut state = 1u64;
    for call in 242..=255u8 {
        for _ in 0..300 {
            let mut bytes = vec![call];
            bytes.extend((0..80).map(|_| {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                (state >> 56) as u8
            }));
            calls::border(&bytes);
        }
    }
}

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
