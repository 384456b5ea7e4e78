//! Numbers as text: the shortest that mean the same binary64.

/// A number.
pub(super) fn number(value: f64) -> String {
    // Adding 0 turns -0 into 0.
    let text = format!("{:?}", value + 0.0);
    match text.strip_suffix(".0") {
        Some(whole) => whole.to_owned(),
        None => text,
    }
}

/// Numbers with spaces between them.
pub(super) fn numbers(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|value| number(*value)).collect();
    values.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_mean_the_same() {
        assert_eq!(
            numbers(&[1.0, -0.0, 0.1, 1e-9, 1e300]),
            "1 0 0.1 1e-9 1e300"
        );
        for value in [std::f64::consts::PI, 1.0 / 3.0, 5e-324, -1e22] {
            assert_eq!(number(value).parse::<f64>(), Ok(value));
        }
    }
}
