//! A proportion of counted configurations, with its 95 % confidence interval.

use std::fmt;

use serde::Serialize;

use super::readable::grouped;

/// The 97.5 % quantile of the standard normal distribution.
const Z: f64 = 1.959963984540054;

/// `count` out of `of`, with the 95 % interval of SPEC 8.8.11 (Wilson score interval).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rate {
    /// The counted configurations.
    pub count: u32,
    /// All configurations.
    pub of: u32,
    /// Lower end of the interval, 0 to 1.
    pub lower: f64,
    /// Upper end of the interval, 0 to 1.
    pub upper: f64,
}

impl Rate {
    /// The rate of two counts. A `count` above `of` is clamped to `of` for the interval.
    pub fn new(count: u32, of: u32) -> Self {
        let [lower, upper] = interval(count.min(of) as usize, of as usize);
        Self { count, of, lower, upper }
    }

    /// The proportion, 0 to 1; `None` if `of` is 0.
    pub fn share(&self) -> Option<f64> {
        (self.of > 0).then(|| f64::from(self.count) / f64::from(self.of))
    }

    /// Whether the whole interval is above the other's.
    pub fn is_above(&self, other: &Rate) -> bool {
        self.lower > other.upper
    }
}

/// The 95 % interval of a proportion (E. B. Wilson, JASA 22, 1927); 0 to 1 if `of` is 0.
pub fn interval(count: usize, of: usize) -> [f64; 2] {
    if of == 0 {
        return [0.0, 1.0];
    }
    let (n, p) = (of as f64, count as f64 / of as f64);
    let middle = p + Z * Z / (2.0 * n);
    let half = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
    let under = 1.0 + Z * Z / n;
    [
        if count == 0 { 0.0 } else { (middle - half) / under },
        if count == of { 1.0 } else { (middle + half) / under },
    ]
}

/// `0.69 % (0.50 to 0.96 %) of 5,078`.
impl fmt::Display for Rate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(share) = self.share() else {
            return f.write_str("none of 0");
        };
        let [share, lower, upper] = [share, self.lower, self.upper].map(percent);
        write!(f, "{share} % ({lower} to {upper} %) of {}", grouped(self.of))
    }
}

/// Two decimals, as many as are significant for a proportion below 10 %.
fn percent(share: f64) -> String {
    format!("{:.2}", 100.0 * share)
}
