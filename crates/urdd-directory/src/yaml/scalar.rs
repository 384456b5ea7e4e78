//! How YAML 1.1 and YAML 1.2 readers interpret a plain scalar.
//!
//! YAML 1.2 is the core schema (YAML 1.2.2, 10.3.2). YAML 1.1 is what PyYAML's `SafeLoader` resolves, plus the booleans
//! `y` and `n`, which the YAML 1.1 types define and yaml-cpp reads.

use std::sync::LazyLock;

use regex::Regex;
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
        Self { yaml12: reading, yaml11: reading, ambiguous: false }
    }
}

/// The forms of numbers and timestamps.
struct Forms {
    non_finite: Regex,
    integer12: Regex,
    float12: Regex,
    /// Binary, hexadecimal, octal, decimal, base 60.
    integer11: Regex,
    /// PyYAML does not allow a sign before a bare point; before version 6 it allowed a leading `_` after it.
    float11: Regex,
    /// A date of ten characters, or a less strict date followed by a time.
    timestamp: Regex,
}

static FORMS: LazyLock<Forms> = LazyLock::new(|| {
    let whole = |form: &str| {
        let form = Regex::new(&format!("^(?:{form})$"));
        form.unwrap_or_else(|error| unreachable!("{error}"))
    };
    Forms {
        non_finite: whole(r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)"),
        integer12: whole(r"[-+]?[0-9]+|0x[0-9a-fA-F]+|0o[0-7]+"),
        float12: whole(r"[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?"),
        integer11: whole(r"[-+]?(0b[01_]+|0x[0-9a-fA-F_]+|0|0[0-7_]+|[1-9][0-9_]*(:[0-5]?[0-9])*)"),
        float11: whole(
            r"[-+]?[0-9][0-9_]*(\.[0-9_]*([eE][-+][0-9]+)?|(:[0-5]?[0-9])+\.[0-9_]*)|\.[0-9_]*[0-9][0-9_]*([eE][-+][0-9]+)?",
        ),
        timestamp: whole(
            r"[0-9]{4}-[0-9]{2}-[0-9]{2}|[0-9]{4}-[0-9]{1,2}-[0-9]{1,2}([Tt]|[ \t]+)[0-9]{1,2}:[0-9]{2}:[0-9]{2}(\.[0-9]*)?([ \t]*(Z|[-+][0-9]{1,2}(:[0-9]{2})?))?",
        ),
    }
});

/// Classifies a plain scalar by both versions of YAML.
pub fn classify(text: &str) -> Readings {
    // Fast path: nearly all scalars of a generated file are numbers or names.
    match text.as_bytes() {
        [b'0'..=b'9' | b'-', ..] => {
            if let Some(reading) = usual_number(text) {
                return Readings::same(reading);
            }
        }
        [b'a'..=b'z' | b'A'..=b'Z', _, _, _, _, _, ..] => return Readings::same(Reading::Text),
        _ => {}
    }
    let (yaml12, yaml11) = (yaml12(text), yaml11(text));
    // Octal in YAML 1.1, decimal in YAML 1.2: the same for one digit behind the zeros.
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    let leading_zero = yaml12 == Reading::Integer
        && digits.starts_with('0')
        && digits.bytes().all(|digit| digit.is_ascii_digit())
        && digits.trim_start_matches('0').len() > 1;
    Readings { yaml12, yaml11, ambiguous: yaml12 != yaml11 || leading_zero }
}

/// Numbers that all readers interpret alike: those of JSON with an exponent only after a fraction and with a sign.
fn usual_number(text: &str) -> Option<Reading> {
    text.parse::<Number>().ok()?;
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "+"));
    match (mantissa.contains('.'), exponent.starts_with(['+', '-'])) {
        (true, true) => Some(Reading::Float),
        (false, true) if mantissa == text => Some(Reading::Integer),
        _ => None,
    }
}

/// What a plain scalar is by YAML 1.2.
pub fn yaml12(text: &str) -> Reading {
    match text {
        "" | "~" | "null" | "Null" | "NULL" => Reading::Null,
        "true" | "True" | "TRUE" => Reading::Bool(true),
        "false" | "False" | "FALSE" => Reading::Bool(false),
        _ if FORMS.non_finite.is_match(text) => Reading::NonFinite,
        _ if FORMS.integer12.is_match(text) => Reading::Integer,
        _ if FORMS.float12.is_match(text) => Reading::Float,
        _ => Reading::Text,
    }
}

/// What a plain scalar is by YAML 1.1.
pub fn yaml11(text: &str) -> Reading {
    match text {
        "" | "~" | "null" | "Null" | "NULL" => Reading::Null,
        "true" | "True" | "TRUE" | "yes" | "Yes" | "YES" | "on" | "On" | "ON" | "y" | "Y" => {
            Reading::Bool(true)
        }
        "false" | "False" | "FALSE" | "no" | "No" | "NO" | "off" | "Off" | "OFF" | "n" | "N" => {
            Reading::Bool(false)
        }
        "<<" | "=" => Reading::Special,
        _ if FORMS.non_finite.is_match(text) => Reading::NonFinite,
        _ if FORMS.integer11.is_match(text) => Reading::Integer,
        _ if FORMS.float11.is_match(text) => Reading::Float,
        _ if FORMS.timestamp.is_match(text) => Reading::Timestamp,
        _ => Reading::Text,
    }
}

/// Whether a plain scalar, read by YAML 1.2, equals this JSON value.
pub fn agrees(reading: Reading, text: &str, json: &Value) -> bool {
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
