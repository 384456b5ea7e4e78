//! Plans the number of configurations.

use urdd_validate::reference::samples::*;

fn kinds() -> [Option<Work>; 4] {
    let work = |each| Some(Work { once: 0, each });
    [work(10), None, work(1), work(30)]
}

#[test]
fn all_in_full_where_there_is_time() {
    assert_eq!(configurations(&kinds(), 100, 4_100), [100, 0, 100, 100]);
}

#[test]
fn the_cheap_ones_in_full_and_the_others_in_part() {
    // 1,100 for the first two. 2,400 remain, and eight configurations of the last take 240.
    assert_eq!(configurations(&kinds(), 100, 3_500), [100, 0, 100, 80]);
    assert_eq!(configurations(&kinds(), 100, 1_100), [100, 0, 100, 8]);
}

#[test]
fn eight_at_least_and_never_more_than_there_are() {
    assert_eq!(configurations(&kinds(), 100, 0), [8, 0, 8, 8]);
    assert_eq!(configurations(&kinds(), 5, 0), [5, 0, 5, 5]);
    assert_eq!(configurations(&kinds(), u32::MAX, u64::MAX), [u32::MAX, 0, u32::MAX, u32::MAX]);
}
