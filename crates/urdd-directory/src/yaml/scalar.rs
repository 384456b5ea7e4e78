//! How YAML 1.1 and YAML 1.2 readers interpret a plain scalar.
//!
//! YAML 1.2 is the core schema (YAML 1.2.2, 10.3.2). YAML 1.1 is what PyYAML's `SafeLoader` resolves, plus the booleans
//! `y` and `n`, which the YAML 1.1 types define and yaml-cpp reads.

use serde_json::{Number, Value};

/// The type of a plain scalar to a reader.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// Null.
    Null,
    /// A boolean.
    Bool(bool),
    /// An integer.
    Integer,
    /// A number with a fraction or an exponent.
    Float,
    /// An infinity or NaN.
    NonFinite,
    /// A string.
    Text,
    /// A date or a timestamp; YAML 1.1 only.
    Timestamp,
    /// `<<` or `=`, which are special in YAML 1.1.
    Special,
}

/// The types of a plain scalar in both versions of YAML.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Readings {
    /// In YAML 1.2.
    pub yaml12: Reading,
    /// In YAML 1.1.
    pub yaml11: Reading,
    /// Whether the two differ, or individual readers disagree.
    pub ambiguous: bool,
}

impl Readings {
    const fn same(reading: Reading) -> Self {
        Self {
            yaml12: reading,
            yaml11: reading,
            ambiguous: false,
        }
    }
}

/// Classifies a plain scalar by both versions of YAML.
pub fn classify(text: &str) -> Readings {
    let bytes = text.as_bytes();
    // Fast path: nearly all scalars of a generated file are numbers or names.
    match bytes.first() {
        Some(b'0'..=b'9' | b'-') => {
            if let Some(reading) = json_number(bytes) {
                return Readings::same(reading);
            }
        }
        Some(b'a'..=b'z' | b'A'..=b'Z') if bytes.len() > 5 => return Readings::same(Reading::Text),
        _ => {}
    }
    let (yaml12, yaml11) = (yaml12(text), yaml11(text));
    // Octal in YAML 1.1, decimal in YAML 1.2, and a string to some readers.
    let leading_zero = yaml12 == Reading::Integer && {
        let digits = unsigned(bytes);
        digits.len() > 1 && digits[0] == b'0' && digits[1].is_ascii_digit()
    };
    Readings {
        yaml12,
        yaml11,
        ambiguous: yaml12 != yaml11 || leading_zero,
    }
}

/// Numbers that all readers interpret alike: no leading zero, a digit on each side of the point, and an exponent only
/// after a fraction and with a sign.
fn json_number(bytes: &[u8]) -> Option<Reading> {
    let digits = bytes.strip_prefix(b"-").unwrap_or(bytes);
    let (whole, rest) = split_digits(digits);
    if whole.is_empty() || (whole.len() > 1 && whole[0] == b'0') {
        return None;
    }
    if rest.is_empty() {
        return Some(Reading::Integer);
    }
    let (fraction, rest) = split_digits(rest.strip_prefix(b".")?);
    if fraction.is_empty() {
        return None;
    }
    (rest.is_empty() || is_signed_exponent(rest)).then_some(Reading::Float)
}

fn yaml12(text: &str) -> Reading {
    let bytes = text.as_bytes();
    match text {
        "" | "~" | "null" | "Null" | "NULL" => return Reading::Null,
        "true" | "True" | "TRUE" => return Reading::Bool(true),
        "false" | "False" | "FALSE" => return Reading::Bool(false),
        _ if is_non_finite(text) => return Reading::NonFinite,
        _ => {}
    }
    let radix = |prefix: &[u8], is_digit: fn(u8) -> bool| {
        bytes.strip_prefix(prefix).is_some_and(|d| all(d, is_digit))
    };
    if radix(b"0x", |b| b.is_ascii_hexdigit()) || radix(b"0o", |b| matches!(b, b'0'..=b'7')) {
        return Reading::Integer;
    }
    let (whole, rest) = split_digits(unsigned(bytes));
    if rest.is_empty() && !whole.is_empty() {
        return Reading::Integer;
    }
    let (fraction, rest) = match rest.strip_prefix(b".") {
        Some(after) => split_digits(after),
        None => (&b""[..], rest),
    };
    let has_digits = !whole.is_empty() || !fraction.is_empty();
    if has_digits && (rest.is_empty() || is_exponent(rest)) {
        Reading::Float
    } else {
        Reading::Text
    }
}

fn yaml11(text: &str) -> Reading {
    match text {
        "" | "~" | "null" | "Null" | "NULL" => return Reading::Null,
        "true" | "True" | "TRUE" | "yes" | "Yes" | "YES" | "on" | "On" | "ON" | "y" | "Y" => {
            return Reading::Bool(true);
        }
        "false" | "False" | "FALSE" | "no" | "No" | "NO" | "off" | "Off" | "OFF" | "n" | "N" => {
            return Reading::Bool(false);
        }
        "<<" | "=" => return Reading::Special,
        _ if is_non_finite(text) => return Reading::NonFinite,
        _ => {}
    }
    let bytes = text.as_bytes();
    let digits = unsigned(bytes);
    if is_integer11(digits) {
        Reading::Integer
    } else if is_float11(digits, digits.len() < bytes.len()) {
        Reading::Float
    } else if is_timestamp(bytes) {
        Reading::Timestamp
    } else {
        Reading::Text
    }
}

fn is_non_finite(text: &str) -> bool {
    let bare = text.strip_prefix(['+', '-']).unwrap_or(text);
    matches!(bare, ".inf" | ".Inf" | ".INF") || matches!(text, ".nan" | ".NaN" | ".NAN")
}

fn is_integer11(digits: &[u8]) -> bool {
    if let Some(binary) = digits.strip_prefix(b"0b") {
        return all(binary, |b| matches!(b, b'0' | b'1' | b'_'));
    }
    if let Some(hexadecimal) = digits.strip_prefix(b"0x") {
        return all(hexadecimal, |b| b.is_ascii_hexdigit() || b == b'_');
    }
    match digits {
        [b'0'] => true,
        [b'0', octal @ ..] => all(octal, |b| matches!(b, b'0'..=b'7' | b'_')),
        [b'1'..=b'9', ..] => {
            let (_, rest) = split_while(digits, |b| b.is_ascii_digit() || b == b'_');
            rest.is_empty() || is_base60_tail(rest)
        }
        _ => false,
    }
}

fn is_float11(digits: &[u8], signed: bool) -> bool {
    if let Some(after) = digits.strip_prefix(b".") {
        // PyYAML does not allow a sign before a bare point; before version 6 it allowed a leading `_` after it.
        let (fraction, rest) = split_while(after, |b| b.is_ascii_digit() || b == b'_');
        return !signed
            && fraction.iter().any(u8::is_ascii_digit)
            && (rest.is_empty() || is_signed_exponent(rest));
    }
    let (whole, rest) = split_while(digits, |b| b.is_ascii_digit() || b == b'_');
    if !whole.first().is_some_and(u8::is_ascii_digit) {
        return false;
    }
    let is_fraction = |b: u8| b.is_ascii_digit() || b == b'_';
    if let Some(after) = rest.strip_prefix(b".") {
        let (_, rest) = split_while(after, is_fraction);
        return rest.is_empty() || is_signed_exponent(rest);
    }
    match rest.iter().position(|&b| b == b'.') {
        Some(point) => {
            is_base60_tail(&rest[..point]) && rest[point + 1..].iter().all(|&b| is_fraction(b))
        }
        None => false,
    }
}

/// One or more groups of `:` and a number of one or two digits below 60.
fn is_base60_tail(mut rest: &[u8]) -> bool {
    if rest.is_empty() {
        return false;
    }
    while let Some(after) = rest.strip_prefix(b":") {
        let (digits, next) = split_digits(after);
        if !matches!(digits, [_] | [b'0'..=b'5', _]) {
            return false;
        }
        rest = next;
    }
    rest.is_empty()
}

/// PyYAML's timestamps: a date of ten characters, or a less strict date followed by a time.
fn is_timestamp(bytes: &[u8]) -> bool {
    let (year, rest) = split_digits(bytes);
    let Some(rest) = rest.strip_prefix(b"-").filter(|_| year.len() == 4) else {
        return false;
    };
    let (month, rest) = split_digits(rest);
    let Some(rest) = rest.strip_prefix(b"-") else {
        return false;
    };
    let (day, rest) = split_digits(rest);
    if rest.is_empty() {
        return month.len() == 2 && day.len() == 2;
    }
    let short = |digits: &[u8]| matches!(digits.len(), 1 | 2);
    let is_blank = |b: u8| matches!(b, b' ' | b'\t');
    let time = match rest {
        [b'T' | b't', time @ ..] => time,
        [b' ' | b'\t', ..] => split_while(rest, is_blank).1,
        _ => return false,
    };
    let (hour, time) = split_digits(time);
    if !short(month) || !short(day) || !short(hour) || time.len() < 6 {
        return false;
    }
    let [b':', m1, m2, b':', s1, s2, after @ ..] = time else {
        return false;
    };
    if ![m1, m2, s1, s2].iter().all(|b| b.is_ascii_digit()) {
        return false;
    }
    let after = match after {
        [b'.', fraction @ ..] => split_digits(fraction).1,
        _ => after,
    };
    let zone = split_while(after, is_blank).1;
    match zone {
        // Blanks may precede a time zone, but not replace it; a scalar never ends with blanks.
        [] | [b'Z'] => true,
        [b'+' | b'-', zone @ ..] => {
            let (hours, rest) = split_digits(zone);
            short(hours) && matches!(rest, [] | [b':', b'0'..=b'9', b'0'..=b'9'])
        }
        _ => false,
    }
}

fn unsigned(bytes: &[u8]) -> &[u8] {
    match bytes {
        [b'+' | b'-', rest @ ..] => rest,
        _ => bytes,
    }
}

fn all(bytes: &[u8], is: impl Fn(u8) -> bool) -> bool {
    !bytes.is_empty() && bytes.iter().all(|&b| is(b))
}

fn split_while(bytes: &[u8], is: impl Fn(u8) -> bool) -> (&[u8], &[u8]) {
    bytes.split_at(bytes.iter().position(|&b| !is(b)).unwrap_or(bytes.len()))
}

fn split_digits(bytes: &[u8]) -> (&[u8], &[u8]) {
    split_while(bytes, |b| b.is_ascii_digit())
}

fn is_exponent(bytes: &[u8]) -> bool {
    match bytes {
        [b'e' | b'E', rest @ ..] => all(unsigned(rest), |b| b.is_ascii_digit()),
        _ => false,
    }
}

fn is_signed_exponent(bytes: &[u8]) -> bool {
    is_exponent(bytes) && matches!(bytes.get(1), Some(b'+' | b'-'))
}

/// Whether a plain scalar, read by YAML 1.2, equals this JSON value.
pub(super) fn agrees(reading: Reading, text: &str, json: &Value) -> bool {
    match (reading, json) {
        (Reading::Null, Value::Null) => true,
        (Reading::Bool(b), Value::Bool(json)) => b == *json,
        (Reading::Text, Value::String(json)) => text == json,
        (Reading::Integer | Reading::Float, Value::Number(json)) => same_number(text, json),
        _ => false,
    }
}

/// The integer in `text`, if it is one and fits into 128 bits.
fn integer(text: &str) -> Option<i128> {
    if let Some(hexadecimal) = text.strip_prefix("0x") {
        i128::from_str_radix(hexadecimal, 16).ok()
    } else if let Some(octal) = text.strip_prefix("0o") {
        i128::from_str_radix(octal, 8).ok()
    } else {
        text.parse().ok()
    }
}

/// `1` and `1.0` are the same number; `9007199254740993` and `9007199254740992.0` are not.
fn same_number(text: &str, json: &Number) -> bool {
    if let Some(exact) = json.as_i128() {
        return match integer(text) {
            Some(n) => n == exact,
            // Whole floats below 2^64 in magnitude convert exactly.
            None => text
                .parse::<f64>()
                .is_ok_and(|x| x.fract() == 0.0 && x.abs() < 2e19 && x as i128 == exact),
        };
    }
    let Some(float) = json.as_f64() else {
        return false;
    };
    match text.parse::<f64>() {
        Ok(x) => x == float,
        Err(_) => integer(text).is_some_and(|n| n as f64 == float),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn numbers_are_compared_by_value() {
        let same = |text, json: Value| agrees(classify(text).yaml12, text, &json);
        assert!(same("1", json!(1.0)) && same("1.0", json!(1)) && same("0x1F", json!(31)));
        assert!(same("-0.0", json!(0)) && same("1.0e-7", json!(1e-7)));
        assert!(same("18446744073709551615", json!(u64::MAX)));
        assert!(same(
            "18446744073709551616",
            json!(18_446_744_073_709_551_616.0)
        ));
        assert!(!same("9007199254740993", json!(9_007_199_254_740_992_i64)));
        assert!(!same(
            "9007199254740993.0",
            json!(9_007_199_254_740_993_i64)
        ));
        assert!(!same("1", json!("1")) && !same("a", json!(1)) && !same(".inf", json!(1)));
        assert!(!same("1.5", json!(1)) && !same("1e999", json!(1)));
    }

    #[test]
    fn the_quick_way_agrees_with_the_long_one() {
        for text in [
            "0",
            "-1",
            "12",
            "0.5",
            "-1.25e-7",
            "10.0E+3",
            "length",
            "Falsehood",
        ] {
            let long = (yaml12(text), yaml11(text));
            let quick = classify(text);
            assert_eq!((quick.yaml12, quick.yaml11), long, "{text}");
            assert!(!quick.ambiguous, "{text}");
        }
    }
}
