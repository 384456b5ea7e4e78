//! Numbers, counts and lists formatted for people, the same in every message and report.

use std::fmt::Display;

/// Rounds to `digits` significant digits, but keeps all digits before the decimal point. Omits trailing zeros.
/// Uses an exponent only below 1e-3 and from 1e6.
pub fn number(value: f64, digits: usize) -> String {
    let size = value.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    if !size.is_finite() {
        return value.to_string();
    }
    let digits = digits.max(1);
    if (1e-3..1e6).contains(&size) {
        let before = size.log10().floor() as i32 + 1;
        let places = (digits as i32 - before).max(0) as usize;
        return trimmed(&format!("{value:.places$}")).to_owned();
    }
    let text = format!("{value:.*e}", digits - 1);
    match text.split_once('e') {
        Some((mantissa, exponent)) => format!("{}e{exponent}", trimmed(mantissa)),
        None => text,
    }
}

/// A length in metres, to three significant digits.
pub fn metres(length: f64) -> String {
    format!("{} m", number(length, 3))
}

/// A number with a comma before each three digits of its whole part.
pub fn grouped(number: impl Into<f64>) -> String {
    let text = number.into().to_string();
    let end = text.find('.').unwrap_or(text.len());
    let mut out = String::new();
    for (at, c) in text.chars().enumerate() {
        if at > 0 && at < end && (end - at).is_multiple_of(3) {
            out.push(',');
        }
        out.push(c);
    }
    out
}

/// A number of things: `1 pair`, `2 pairs`. A thing whose name ends in `s`, as `dynamics`, is its own plural.
pub fn counted(number: usize, thing: &str) -> String {
    let stays = number == 1 || thing.ends_with('s');
    format!("{number} {thing}{}", if stays { "" } else { "s" })
}

/// The first `most` of these names, and the number of the others: `a, b and 3 more`.
pub fn first_of(names: impl ExactSizeIterator<Item: Display>, most: usize) -> String {
    let more = names.len().saturating_sub(most);
    let shown: Vec<String> = names.take(most).map(|name| name.to_string()).collect();
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    shown.join(", ") + &more
}

fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}
