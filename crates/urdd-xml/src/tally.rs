//! How often this thread parsed documents: for tests that hold that each kind of parser reads a file once. Counts only
//! where debug assertions are.

use std::cell::RefCell;
use std::collections::BTreeMap;

thread_local! {
    static PARSES: RefCell<BTreeMap<&'static str, usize>> = const { RefCell::new(BTreeMap::new()) };
}

/// Counts a document, by the parser that reads it.
pub fn count(parser: &'static str) {
    if cfg!(debug_assertions) {
        PARSES.with_borrow_mut(|parses| *parses.entry(parser).or_default() += 1);
    }
}

/// The number of documents since this was last asked, by parser.
pub fn take() -> BTreeMap<&'static str, usize> {
    PARSES.take()
}
