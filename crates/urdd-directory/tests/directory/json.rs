//! Reads untrusted JSON, and reports every fault of the text with its position.

use serde_json::Value;
use urdd_directory::json::*;
use urdd_directory::limits::DEPTH_LIMIT;
use urdd_directory::position::{TextFault, TextFaultKind};

fn only_fault(bytes: &[u8]) -> TextFault {
    let error = read(bytes).expect_err("unreadable");
    assert_eq!(error.faults.iter().count(), 1, "{error}");
    error.faults.iter().next().unwrap().clone()
}

fn place(fault: &TextFault) -> (u32, u32) {
    let position = fault.position.expect("a position");
    (position.line, position.column)
}

#[test]
fn reads_what_serde_json_reads() {
    let text = r#"{"a": [1, -2, 1.5e-7, -0.0, 18446744073709551615, null, true], "b": {"é": "\ud83e\udd16"}}"#;
    let document = read(text.as_bytes()).unwrap();
    assert_eq!(document.value, serde_json::from_str::<Value>(text).unwrap());
    assert_eq!(document.text, text);
    assert!(document.faults.is_empty());
}

#[test]
fn a_byte_order_mark_is_a_fault_and_reading_goes_on() {
    let document = read(b"\xEF\xBB\xBF{\"a\": 1}").unwrap();
    assert_eq!(document.faults.total(TextFaultKind::ByteOrderMark), 1);
    assert_eq!(document.value["a"], 1);
    assert_eq!(document.text, "{\"a\": 1}");
}

#[test]
fn repeated_keys_are_placed_and_the_last_is_kept() {
    let document = read(b"{\"a\": [{\"x\": 1,\n \"x\": 2}]}").unwrap();
    let fault = document.faults.iter().next().unwrap();
    assert_eq!(fault.kind, TextFaultKind::DuplicateKey);
    assert_eq!(fault.pointer.as_deref(), Some("/a/0/x"));
    assert_eq!(place(fault), (2, 2));
    assert_eq!(document.value["a"][0]["x"], 2);
}

#[test]
fn what_is_not_json_says_where() {
    type Case<'a> = (&'a [u8], (u32, u32), &'a str, &'a str);
    let cases: [Case<'_>; 8] = [
        (b"{\"a\":\n [1, x]}", (2, 6), "/a/1", "expected value"),
        (b"{\"a\": 1} 2", (1, 10), "", "trailing"),
        (b"[\"\\ud800\"]", (1, 9), "/0", "surrogate"),
        (b"[1,]", (1, 4), "/1", "trailing comma"),
        ("[\"é\", x]".as_bytes(), (1, 7), "/1", "expected value"),
        (b"{\"a\": [1,", (1, 10), "/a/1", "ends early"),
        (b"", (1, 1), "", "empty"),
        (b" \n", (2, 1), "", "empty"),
    ];
    for (bytes, expected, pointer, part) in cases {
        let fault = only_fault(bytes);
        let shown = String::from_utf8_lossy(bytes);
        assert_eq!(fault.kind, TextFaultKind::Syntax, "{shown}");
        assert!(fault.message.contains(part), "{shown}: {}", fault.message);
        assert_eq!(place(&fault), expected, "{shown}: {}", fault.message);
        assert_eq!(fault.pointer.as_deref(), Some(pointer), "{shown}");
    }
}

#[test]
fn numbers_that_are_not_finite_have_their_own_kind() {
    for word in ["NaN", "Infinity", "-Infinity", "1e999", "-1E+999", "nan", "-inf"] {
        let text = format!("{{\"a\": [0.5,\n  {word}, 2]}}");
        let fault = only_fault(text.as_bytes());
        assert_eq!(fault.kind, TextFaultKind::NonFiniteNumber, "{word}");
        assert_eq!(place(&fault), (2, 3), "{word}");
        assert_eq!(fault.pointer.as_deref(), Some("/a/1"), "{word}");
        assert_eq!(fault.found.as_deref(), Some(word));
    }
}

#[test]
fn depth_is_bounded() {
    let nested = |open: &str, close: &str, n: usize| open.repeat(n) + "1" + &close.repeat(n);
    assert!(read(nested("[", "]", DEPTH_LIMIT).as_bytes()).is_ok());
    assert!(read(nested("{\"a\":", "}", DEPTH_LIMIT).as_bytes()).is_ok());
    for n in [DEPTH_LIMIT + 1, 10_000] {
        for text in [nested("[", "]", n), nested("{\"a\":", "}", n), "[".repeat(n)] {
            assert_eq!(only_fault(text.as_bytes()).kind, TextFaultKind::TooDeep);
        }
    }
}

#[test]
fn what_is_not_utf8_says_which_byte() {
    let fault = only_fault(b"{\n\"\xC3\xA9\xFF\": 1}");
    assert_eq!(fault.kind, TextFaultKind::NotUtf8);
    assert!(fault.message.contains("byte 5"), "{}", fault.message);
    assert_eq!(place(&fault), (2, 3));
    assert!(only_fault(b"\xFF\xFE{\0").message.contains("UTF-16"));
}

#[test]
fn the_first_fault_of_a_text_is_its_cause() {
    let before = |text: &[u8]| only_fault(text).kind;
    assert_eq!(before(b"{\"a\": 01, \"b\": \"\xFF\"}"), TextFaultKind::Syntax);
    assert_eq!(before(b"{\"a\": NaN, \"b\": \"\xFF\"}"), TextFaultKind::NonFiniteNumber);
    for text in [&b"{\"a\": 1, \"b\": \"\xFF\"}"[..], b"[tr\xFF", b"{}\xFF", b"[1, \xFF 01]"] {
        assert_eq!(before(text), TextFaultKind::NotUtf8);
    }
}
