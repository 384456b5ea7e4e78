//! Text of a file in a message or report.

use urdd_format::short::{Short, name};

#[test]
fn long_text_is_cut_between_characters() {
    for (length, is_cut) in [(0, false), (60, false), (61, true), (1_000_000, true)] {
        let short = Short::of(&"é".repeat(length));
        assert_eq!(short.ends_with('…'), is_cut, "{length}");
        assert_eq!(short.chars().count(), length.min(60) + usize::from(is_cut));
    }
    let ordinary = "n".repeat(250);
    assert_eq!(name(&ordinary), ordinary);
    assert_eq!(name(&"n".repeat(40_000)).chars().count(), 251);
}
