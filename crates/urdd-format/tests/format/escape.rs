//! Text from files, printed.

use urdd_format::escape::{code_span, json, line, lines, quoted};

#[test]
fn what_can_be_seen_stays() {
    for text in ["", "left arm/ü 1", "关节_1", "кисть", "🤖", "a\\b \"c\" `d`"] {
        assert_eq!(line(text), text);
        assert_eq!(json(text), text);
    }
}

#[test]
fn what_is_hidden_is_shown() {
    for (text, shown) in [
        ("\u{1b}[2J", "\\u{1b}[2J"),
        ("a\r\n\tb", "a\\r\\n\\tb"),
        ("\u{7f}\u{9b}\u{85}", "\\u{7f}\\u{9b}\\u{85}"),
        ("\u{202e}\u{2066}\u{61c}", "\\u{202e}\\u{2066}\\u{61c}"),
        ("\u{2028}\u{2029}", "\\u{2028}\\u{2029}"),
        ("\u{200b}\u{feff}\u{ad}", "\\u{200b}\\u{feff}\\u{ad}"),
        ("\u{3164}\u{fe0f}\u{e0041}", "\\u{3164}\\u{fe0f}\\u{e0041}"),
        ("\u{fffe}", "\\u{fffe}"),
    ] {
        assert_eq!(line(text), shown);
    }
    assert_eq!(lines("a\n\u{1b}b\r\n"), "a\n\\u{1b}b\\r\n");
}

#[test]
fn a_name_in_quotes_ends_where_it_ends() {
    assert_eq!(quoted("left arm"), "\"left arm\"");
    assert_eq!(quoted("a\", 9 links \\"), "\"a\\\", 9 links \\\\\"");
    assert_eq!(quoted("a\nb"), "\"a\\nb\"");
}

#[test]
fn json_says_the_same_with_escapes() {
    let value = "\u{1b}\u{9b}\u{202e}\u{e0041}🤖é";
    let text = serde_json::to_string(value).unwrap();
    let safe = json(&text);
    assert_eq!(safe, "\"\\u001b\\u009b\\u202e\\udb40\\udc41🤖é\"");
    assert_eq!(serde_json::from_str::<String>(&safe).unwrap(), value);
}

#[test]
fn a_code_span_holds_any_name() {
    for (name, span) in [
        ("tool0", "`tool0`"),
        ("a`b", "``a`b``"),
        ("``", "``` `` ```"),
        ("<img src=x>", "`<img src=x>`"),
        ("a\nb", "`a\\nb`"),
        ("", "(empty)"),
    ] {
        assert_eq!(code_span(name), span);
    }
    assert!(code_span(&"x".repeat(100_000)).len() < 2_100);
}
