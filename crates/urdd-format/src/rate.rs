//! A share of counted configurations, with its 95 % interval.

use std::fmt;

use serde::Serialize;

/// The quantile of the normal distribution at 97.5 %.
const Z: f64 = 1.959963984540054;

/// `count` out of `of`, with the 95 % interval of SPEC 8.8.11 (Wilson's score interval).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rate {
    /// How many.
    pub count: u32,
    /// Out of how many.
    pub of: u32,
    /// Lower end of the interval, 0 to 1.
    pub lower: f64,
    /// Upper end of the interval, 0 to 1.
    pub upper: f64,
}

impl Rate {
    /// Of two counts; a `count` above `of` is taken as `of`.
    pub fn new(count: u32, of: u32) -> Self {
        let (lower, upper) = interval(f64::from(count.min(of)), f64::from(of));
        Self {
            count,
            of,
            lower,
            upper,
        }
    }

    /// The share, 0 to 1; `None` out of nothing.
    pub fn share(&self) -> Option<f64> {
        (self.of > 0).then(|| f64::from(self.count) / f64::from(self.of))
    }

    /// Whether the whole interval is above that of another rate.
    pub fn is_above(&self, other: &Rate) -> bool {
        self.lower > other.upper
    }
}

/// Nothing is known out of nothing.
fn interval(count: f64, of: f64) -> (f64, f64) {
    if of == 0.0 {
        return (0.0, 1.0);
    }
    let (p, z2) = (count / of, Z * Z);
    let scale = 1.0 + z2 / of;
    let centre = (p + z2 / (2.0 * of)) / scale;
    let half = Z / scale * (p * (1.0 - p) / of + z2 / (4.0 * of * of)).sqrt();
    let lower = if count == 0.0 { 0.0 } else { centre - half };
    let upper = if count == of { 1.0 } else { centre + half };
    (lower, upper)
}

/// `0.69 % (0.50 to 0.96 %) of 5,078`.
impl fmt::Display for Rate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(share) = self.share() else {
            return f.write_str("none of 0");
        };
        let [share, lower, upper] = [share, self.lower, self.upper].map(percent);
        write!(
            f,
            "{share} % ({lower} to {upper} %) of {}",
            grouped(self.of)
        )
    }
}

/// Two digits after the point, as many as are sure of a share below 10 %.
fn percent(share: f64) -> String {
    format!("{:.2}", 100.0 * share)
}

/// With a comma between thousands.
fn grouped(number: u32) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `conformance/vectors/self_collision_model.json` holds more, by scipy.
    #[test]
    fn ends_at_nothing_and_all_are_closed_forms() {
        // 0 of n: z^2 / (n + z^2), and 1 less that for all of n.
        for n in [1, 10, 300, 50_000] {
            let most = Z * Z / (f64::from(n) + Z * Z);
            let (none, all) = (Rate::new(0, n), Rate::new(n, n));
            assert!((none.upper - most).abs() < 1e-15 && none.lower == 0.0);
            assert!((all.lower - (1.0 - most)).abs() < 1e-15 && all.upper == 1.0);
        }
    }

    #[test]
    fn out_of_nothing_nothing_is_known() {
        let rate = Rate::new(0, 0);
        assert_eq!((rate.lower, rate.upper, rate.share()), (0.0, 1.0, None));
        assert_eq!(rate.to_string(), "none of 0");
    }

    #[test]
    fn words() {
        assert_eq!(
            Rate::new(9, 903).to_string(),
            "1.00 % (0.53 to 1.88 %) of 903"
        );
        assert!(
            Rate::new(50, 1_234_567)
                .to_string()
                .ends_with("of 1,234,567")
        );
        assert!(Rate::new(50, 100).is_above(&Rate::new(9, 903)));
        assert!(!Rate::new(2, 100).is_above(&Rate::new(9, 903)));
    }
}
