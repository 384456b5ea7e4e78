//! Where YAML readers disagree: plain scalars, the end of a file without a final line break, keys in braces whose colon is
//! on another line, and tabs outside quotes and comments.
//!
//! YAML 1.2 is the core schema (YAML 1.2.2, 10.3.2). YAML 1.1 is what PyYAML's `SafeLoader` resolves, plus the booleans
//! `y` and `n`, which the YAML 1.1 types define and yaml-cpp reads.

use std::ops::RangeInclusive;
use std::sync::LazyLock;

use regex::Regex;
use saphyr_parser::{ScalarStyle, Span};
use serde_json::{Number, Value};

use crate::position::{Offsets, Position, TextFault, TextFaultKind, TextFaults, position};

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

/// The end of a text.
pub struct End<'y> {
    text: &'y str,
    /// Number of characters, if the final line break is missing.
    open: Option<usize>,
}

impl<'y> End<'y> {
    /// Finds the end.
    pub fn new(text: &'y str) -> Self {
        let is_open = !text.ends_with(['\n', '\r']);
        Self { text, open: is_open.then(|| text.chars().count()) }
    }

    /// Whether a block scalar ends at the end of the file without a line break. Some readers add one.
    pub fn is_disputed(&self, scalar: &str, style: ScalarStyle, span: Span) -> bool {
        matches!(style, ScalarStyle::Literal | ScalarStyle::Folded)
            && scalar.ends_with('\n')
            && self.open.is_some_and(|count| span.end.index() >= count)
    }

    /// Limits a position to the end of the text: the parser assumes a final line break, and may report a line that does
    /// not exist.
    pub fn at_most(&self, at: Position) -> Position {
        at.min(position(self.text, self.text.len()))
    }
}

/// Message for a key in a flow mapping whose colon is on another line. YAML 1.2 allows it; YAML 1.1 readers reject it.
pub const TORN: &str = "a key in braces and its `:` on different lines make YAML 1.1 readers such as PyYAML refuse the file: write both on one line";

/// A forward scan of a text.
pub struct Keys<'y> {
    text: &'y str,
    offsets: Offsets<'y>,
}

impl<'y> Keys<'y> {
    /// Starts at the beginning of a text.
    pub fn new(text: &'y str) -> Self {
        Self { text, offsets: Offsets::new(text) }
    }

    /// Whether a line break is inside a key or before its colon. Explicit keys after `?` are exempt.
    pub fn is_torn(&mut self, key: Span) -> bool {
        let start = self.offsets.bytes(key.start.index());
        let end = self.offsets.bytes(key.end.index());
        let before = &self.text[..start];
        let space = before.trim_end();
        if space.len() < before.len() && space.ends_with('?') {
            return false;
        }
        let key = self.text[start..end].trim_end();
        if key.contains(['\n', '\r']) {
            return true;
        }
        let mut broken = false;
        let mut rest = &self.text[start + key.len()..];
        loop {
            rest = rest.trim_start_matches([' ', '\t']);
            if rest.starts_with(['\n', '\r']) {
                broken = true;
                rest = &rest[1..];
            } else if rest.starts_with('#') {
                rest = rest.trim_start_matches(|c| !matches!(c, '\n' | '\r'));
            } else {
                return broken && rest.starts_with(':');
            }
        }
    }
}

/// Message for a line of a flow collection that is no farther in than the value around it.
pub const OUTDENTED: &str = "a line in brackets or braces is not indented more than the value around it: write spaces before it";

/// The lines of a text, found when they are first needed.
pub struct Outdents<'y> {
    text: &'y str,
    lines: Vec<&'y str>,
}

impl<'y> Outdents<'y> {
    /// Starts without the lines.
    pub fn new(text: &'y str) -> Self {
        Self { text, lines: Vec::new() }
    }

    /// The first of these lines, from 1, that begins before or at a column, from 1. Empty lines and comments may.
    pub fn find(&mut self, lines: RangeInclusive<usize>, column: usize) -> Option<Position> {
        if lines.is_empty() {
            return None;
        }
        if self.lines.is_empty() {
            self.lines = self.text.lines().collect();
        }
        lines.into_iter().find_map(|number| {
            let line = self.lines.get(number - 1)?;
            let begins = line.trim_start_matches(' ');
            let before = line.len() - begins.len();
            let counts = !begins.is_empty() && !begins.starts_with('#');
            (counts && before < column).then(|| Position::of(number, before + 1))
        })
    }
}

const BETWEEN_TOKENS: &str = "a tab between tokens or in an unquoted scalar makes YAML 1.1 readers such as PyYAML refuse the file: write spaces";
const IN_BLOCK_SCALAR: &str =
    "a tab in a block scalar: write the text in double quotes, and the tab as \\t";

struct Tab {
    /// From 1, as in the parser.
    line: usize,
    /// From 0, as in the parser.
    column: usize,
    /// Column of the last `#` before it on its line.
    hash: Option<usize>,
}

/// The tabs of a text, consumed in step with the parser.
pub struct Tabs {
    ahead: std::iter::Peekable<std::vec::IntoIter<Tab>>,
    /// Line and column of the previous token's end.
    passed: (usize, usize),
}

impl Tabs {
    /// Finds all tabs.
    pub fn find(text: &str) -> Self {
        let mut tabs = Vec::new();
        if text.contains('\t') {
            let text = text.strip_suffix('\n').unwrap_or(text);
            for (line, content) in text.split('\n').enumerate() {
                let mut hash = None;
                for (column, c) in content.chars().enumerate() {
                    match c {
                        '#' => hash = Some(column),
                        '\t' => tabs.push(Tab { line: line + 1, column, hash }),
                        _ => {}
                    }
                }
            }
        }
        Self { ahead: tabs.into_iter().peekable(), passed: (1, 0) }
    }

    /// Reports the tabs up to the end of a token, except in quotes and comments.
    pub fn pass(&mut self, span: Span, style: Option<ScalarStyle>, faults: &mut TextFaults) {
        if self.ahead.peek().is_none() {
            return;
        }
        let start = (span.start.line(), span.start.col());
        let end = (span.end.line(), span.end.col());
        let (is_quoted, is_block) = match style {
            Some(ScalarStyle::SingleQuoted | ScalarStyle::DoubleQuoted) => (true, false),
            Some(ScalarStyle::Literal | ScalarStyle::Folded) => (false, true),
            Some(ScalarStyle::Plain) | None => (false, false),
        };
        // The span of a bracket includes the spaces and the comment after it. That of a block scalar begins after its
        // header and the comment there.
        let bounds = if style.is_some() { start } else { end };
        let last = end.max(start);
        while let Some(tab) = self.ahead.next_if(|tab| (tab.line, tab.column) < last) {
            let Tab { line, column, hash } = tab;
            let between = (line, column) < bounds;
            let from = if self.passed.0 == line { self.passed.1 } else { 0 };
            let comment = between && hash.is_some_and(|hash| hash >= from);
            if comment || (is_quoted && !between) {
                continue;
            }
            let message = if is_block && !between { IN_BLOCK_SCALAR } else { BETWEEN_TOKENS };
            faults.add(TextFaultKind::YamlSyntax, || {
                TextFault::new(TextFaultKind::YamlSyntax, message)
                    .at(Position::of(line, column + 1))
            });
        }
        self.passed = self.passed.max(end);
    }
}
