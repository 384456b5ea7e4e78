//! A document's text, and positions in it as editors count them.

use lsp_types::{Position, TextDocumentContentChangeEvent};
use urdd_lsp::text::*;

fn at(line: u32, character: u32) -> Position {
    Position { line, character }
}

#[test]
fn columns_are_in_the_unit_that_was_agreed() {
    let text = "é\u{1F916}x\r\ny\rz\n";
    for (encoding, column) in [(Encoding::Utf8, 6), (Encoding::Utf16, 3), (Encoding::Utf32, 2)] {
        let text = Text::new(text.to_owned(), encoding);
        let x = text.as_str().find('x').unwrap();
        assert_eq!(text.position(x), at(0, column));
        assert_eq!(text.offset(at(0, column)), x);
        // Beyond the line, and inside of its end.
        assert_eq!(text.offset(at(0, 99)), x + 1);
        assert_eq!(text.position(x + 2), at(0, column + 1));
        assert_eq!(text.position(text.as_str().find('z').unwrap()), at(2, 0));
        assert_eq!(text.position(usize::MAX), at(3, 0));
        assert_eq!(text.offset(at(9, 0)), text.as_str().len());
    }
}

#[test]
fn long_lines_are_counted_as_short_ones() {
    let line = "é\u{1F916}x".repeat(2000);
    for encoding in [Encoding::Utf8, Encoding::Utf16, Encoding::Utf32] {
        let mut text = Text::new(format!("\n{line}"), encoding);
        let mut units = 0;
        for (column, (offset, c)) in line.char_indices().enumerate() {
            assert_eq!(text.position(offset + 1), at(1, units));
            // A fifth of them, at each kind of character, and all about the ends of the blocks that are counted.
            if column % 5 == 0 || (offset + 5) % 1024 < 10 {
                assert_eq!(text.offset(at(1, units)), offset + 1);
                assert_eq!(text.reported(2, column + 1), offset + 1);
            }
            units += encoding.units(c) as u32;
        }
        // A change is counted too.
        let range = Some(text.range(0..1));
        let (range_length, added) = (None, "é".to_owned());
        text.apply(TextDocumentContentChangeEvent { range, range_length, text: added });
        let shift = encoding.units('é') as u32;
        assert_eq!(text.position(usize::MAX), at(0, units + shift));
    }
}

#[test]
fn half_of_a_surrogate_pair_is_its_start() {
    let text = Text::new("a\u{1F916}b".to_owned(), Encoding::Utf16);
    assert_eq!(text.offset(at(0, 2)), 1);
    assert_eq!(text.offset(at(0, 3)), 5);
}

#[test]
fn a_byte_order_mark_is_no_column_of_reports_but_one_of_editors() {
    let text = Text::new("\u{feff}<a/>\n<b/>".to_owned(), Encoding::Utf16);
    assert_eq!(text.content(), "<a/>\n<b/>");
    assert_eq!(text.position(text.reported(1, 1)), at(0, 1));
    assert_eq!(text.position(text.reported(2, 2)), at(1, 1));
    assert_eq!(text.reported(7, 1), text.as_str().len());
}

/// Every change of a small text, by every small text, has the lines of the text read anew.
#[test]
fn changes_keep_the_lines() {
    let texts = ["", "a\r\nb\rc\n\nd", "\r\n", "\n\n\n", "x\r", "é\u{1F916}\r\n"];
    let inserts = ["", "\r", "\n", "\r\n", "q", "\nq\r", "u\r\nv"];
    for text in texts {
        let ends: Vec<usize> = (0..=text.len()).filter(|at| text.is_char_boundary(*at)).collect();
        for (&start, &end) in ends.iter().flat_map(|a| ends.iter().map(move |b| (a, b))) {
            for insert in inserts.iter().filter(|_| start <= end) {
                let mut changed = Text::new(text.to_owned(), Encoding::Utf16);
                let range = changed.range(start..end);
                changed.apply(TextDocumentContentChangeEvent {
                    range: Some(range),
                    range_length: None,
                    text: (*insert).to_owned(),
                });
                let anew = Text::new(changed.as_str().to_owned(), Encoding::Utf16);
                for at in 0..=changed.as_str().len() {
                    let places = [&changed, &anew].map(|text| text.position(at));
                    assert_eq!(places[0], places[1], "{text:?} {start}..{end} {insert:?} {at}");
                }
            }
        }
    }
}
