//! Numbers as the shortest text that denotes the same binary64.

/// A number. Zero has no sign.
pub fn number(value: f64) -> String {
    let text = format!("{:?}", value + 0.0);
    match text.strip_suffix(".0") {
        Some(whole) => whole.to_owned(),
        None => text,
    }
}

/// Numbers separated by spaces.
pub fn numbers(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|value| number(*value)).collect();
    values.join(" ")
}
