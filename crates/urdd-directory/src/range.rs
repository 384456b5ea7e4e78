//! Ranges of options. The library that has an option holds its range, for all languages.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use urdd_format::readable::grouped;

/// The numbers that an option takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// The option's name, as in Python.
    pub option: &'static str,
    /// The least number.
    pub least: f64,
    /// The greatest number.
    pub most: f64,
    /// Its unit, such as `Hz`; `None` for a whole number.
    pub unit: Option<&'static str>,
}

/// A number that an option does not take.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("`{}` must be {range}, not {}", .range.option, as_given(*given))]
pub struct OutOfRange {
    /// The option, and what it takes.
    pub range: Range,
    /// What was given.
    pub given: f64,
}

impl Range {
    /// A whole number.
    pub const fn whole(option: &'static str, least: u32, most: u32) -> Range {
        Range { option, least: least as f64, most: most as f64, unit: None }
    }

    /// A number in a unit.
    pub const fn real(option: &'static str, least: f64, most: f64, unit: &'static str) -> Range {
        Range { option, least, most, unit: Some(unit) }
    }

    /// A number above 0, in a unit.
    pub const fn above_zero(option: &'static str, unit: &'static str) -> Range {
        Range::real(option, f64::MIN_POSITIVE, f64::MAX, unit)
    }

    /// The number, if it is in the range.
    ///
    /// # Errors
    /// If it is not, which names the option and its range.
    pub fn check(self, given: f64) -> Result<f64, OutOfRange> {
        let is_of_kind = self.unit.is_some() || given.fract() == 0.0;
        if is_of_kind && (self.least..=self.most).contains(&given) {
            Ok(given)
        } else {
            Err(OutOfRange { range: self, given })
        }
    }

    /// The number that a word is, for the command line, which names the option and the word itself.
    ///
    /// # Errors
    /// If it is not a number in the range: what was expected.
    pub fn parse<T: FromStr + Copy + Into<f64>>(self, word: &str) -> Result<T, String> {
        let number = word.parse().ok();
        let number = number.filter(|number: &T| self.check((*number).into()).is_ok());
        number.ok_or_else(|| format!("it must be {self}"))
    }
}

/// With all digits, and no hundreds of zeros.
fn as_given(number: f64) -> String {
    let is_usual = number == 0.0 || (1e-5..1e15).contains(&number.abs());
    if is_usual || !number.is_finite() { number.to_string() } else { format!("{number:e}") }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.unit.is_none() {
            f.write_str("a whole number ")?;
        }
        match (self.least, self.most) {
            (f64::MIN_POSITIVE, f64::MAX) => f.write_str("above 0")?,
            (f64::MIN_POSITIVE, most) => write!(f, "above 0 and at most {}", grouped(most))?,
            (least, f64::MAX) => write!(f, "at least {least}")?,
            (least, most) => write!(f, "from {} to {}", grouped(least), grouped(most))?,
        }
        self.unit.filter(|unit| !unit.is_empty()).map_or(Ok(()), |unit| write!(f, " {unit}"))
    }
}
