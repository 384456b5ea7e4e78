//! Parts of pages that tests write.

use std::fs;

use crate::repository;

/// Fails unless a page of the repository has this text between two marks. With `URDD_UPDATE=1`, writes it. `how` is the
/// command that writes it.
#[track_caller]
pub fn assert_between(file: &str, [begin, end]: [&str; 2], expected: &str, how: &str) {
    let path = repository().join(file);
    let page = fs::read_to_string(&path).expect("a page");
    let start = page.find(begin).expect("the beginning") + begin.len();
    let stop = start + page[start..].find(end).expect("the end");
    if std::env::var_os("URDD_UPDATE").is_some() {
        let text = format!("{}{expected}{}", &page[..start], &page[stop..]);
        fs::write(path, text).expect("written");
        return;
    }
    assert!(
        &page[start..stop] == expected,
        "{file} has something else behind `{}`: run URDD_UPDATE=1 {how}",
        begin.trim()
    );
}
