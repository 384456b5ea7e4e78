//! How much tests try. Tests of arbitrary inputs, and tests that sample a long list, try a little by default, and
//! `URDD_TRIALS` times as much where it is set. `.ci/run` and `.ci/full` set it.

use std::sync::OnceLock;

/// The factor: `URDD_TRIALS`, 1 by default.
fn factor() -> u32 {
    static FACTOR: OnceLock<u32> = OnceLock::new();
    *FACTOR.get_or_init(|| match std::env::var("URDD_TRIALS") {
        Err(_) => 1,
        Ok(text) => match text.parse() {
            Ok(factor @ 1..) => factor,
            _ => panic!("URDD_TRIALS={text}: write a number of at least 1"),
        },
    })
}

/// The number of arbitrary inputs to try, where `few` are tried by default.
pub fn trials(few: u32) -> u32 {
    few.saturating_mul(factor())
}

/// Every `step`-th item, the first one included. Every item where `URDD_TRIALS` is at least `step`.
pub fn sample<T>(items: impl IntoIterator<Item = T>, step: u32) -> impl Iterator<Item = T> {
    items.into_iter().step_by((step / factor()).max(1) as usize)
}
