//! Positions in a text as 1-based line and column.

use urdd_directory::position::*;

const fn at(line: u32, column: u32) -> Position {
    Position { line, column }
}

#[test]
fn columns_count_characters_not_bytes() {
    let text = "é\u{1F916}x\r\ny\rz\n";
    let index = LineIndex::new(text);
    assert_eq!(index.position(0), at(1, 1));
    assert_eq!(index.position(text.find('x').unwrap()), at(1, 3));
    assert_eq!(index.position(text.find('y').unwrap()), at(2, 1));
    assert_eq!(index.position(text.find('z').unwrap()), at(3, 1));
    assert_eq!(index.position(usize::MAX), at(4, 1));
    assert_eq!(index.offset(at(4, 1)), Some(text.len()));
    assert_eq!(index.offset(at(1, 3)), text.find('x'));
    assert_eq!([index.offset(at(5, 1)), index.offset(at(4, 2)), index.offset(at(1, 0))], [None; 3]);
}

#[test]
fn long_lines_are_counted_as_short_ones() {
    let text = format!("{}\n{}", "é".repeat(3000), "\u{1F916}x".repeat(2000));
    let index = LineIndex::new(&text);
    for (offset, _) in text.char_indices() {
        let before = &text[..offset];
        let line = before.rsplit('\n').next().unwrap();
        let expected = at(1 + u32::from(offset > 6000), line.chars().count() as u32 + 1);
        assert_eq!(index.position(offset), expected, "{offset}");
        assert_eq!(index.offset(expected), Some(offset));
    }
}

#[test]
fn finds_values_by_pointer() {
    let text = "{\n  \"a/b\": [1, {\"~\": \"]}\\\"\", \"\\u00e9\": [ 7 ]}],\n  \"\": null\n}";
    assert_eq!(locate(text, ""), Some(at(1, 1)));
    assert_eq!(locate(text, "/a~1b"), Some(at(2, 10)));
    assert_eq!(locate(text, "/a~1b/0"), Some(at(2, 11)));
    assert_eq!(locate(text, "/a~1b/1/~0"), Some(at(2, 20)));
    assert_eq!(locate(text, "/a~1b/1/é/0"), Some(at(2, 40)));
    assert_eq!(locate(text, "/"), Some(at(3, 7)));
    for absent in ["/b", "/a~1b/2", "/a~1b/01", "/a~1b/-", "/a~1b/0/x", "a", "/~2"] {
        assert_eq!(locate(text, absent), None, "{absent}");
    }
}

#[test]
fn of_a_key_named_twice_the_last_counts() {
    let text = r#"{"a": {"b": 1}, "c": 2, "a": {"b": 3, "b": 4}}"#;
    assert_eq!(locate(text, "/a/b"), Some(at(1, 44)));
}
