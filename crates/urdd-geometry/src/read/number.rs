//! Fast number parsing: most of a text mesh is numbers.

/// The words of a text, separated by white space.
#[derive(Clone)]
pub(super) struct Words<'a> {
    rest: &'a [u8],
}

impl<'a> Words<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Self { rest: text }
    }

    /// The next number, rounded to nearest like Rust's own parser; NaN for a word that is not a number.
    pub(super) fn float(&mut self) -> Option<f64> {
        self.next().map(float)
    }

    /// Skips to the end of the line, unless the last word ended it.
    pub(super) fn skip_line(&mut self) {
        let end = self
            .rest
            .iter()
            .position(|byte| matches!(byte, b'\n' | b'\r'))
            .unwrap_or(self.rest.len());
        self.rest = &self.rest[end..];
    }

    /// The next index; `Some(None)` for a word that is not an index.
    pub(super) fn index(&mut self) -> Option<Option<u32>> {
        self.next().map(index)
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    #[inline]
    fn next(&mut self) -> Option<&'a [u8]> {
        let start = self.rest.iter().position(|byte| *byte > b' ')?;
        let rest = &self.rest[start..];
        let end = rest
            .iter()
            .position(|byte| *byte <= b' ')
            .unwrap_or(rest.len());
        let (word, rest) = rest.split_at(end);
        self.rest = rest;
        Some(word)
    }
}

/// Parses a non-negative integer that fits `u32`.
#[inline]
pub(super) fn index(word: &[u8]) -> Option<u32> {
    if word.is_empty() || word.len() > 10 {
        return std::str::from_utf8(word).ok()?.parse().ok();
    }
    let mut value = 0_u64;
    for byte in word {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            return std::str::from_utf8(word).ok()?.parse().ok();
        }
        value = value * 10 + u64::from(digit);
    }
    u32::try_from(value).ok()
}

/// The powers of ten that binary64 represents exactly.
const TENS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Parses a number; NaN for any other word (`1.#QNAN`, `-nan(ind)`).
///
/// Fast path (Clinger 1990): if the digits (at most 19) and the power of ten are exact in binary64, one product or
/// quotient rounds once, hence correctly. All other words go to the standard library.
#[inline]
pub(super) fn float(word: &[u8]) -> f64 {
    fast_float(word).unwrap_or_else(|| {
        std::str::from_utf8(word)
            .ok()
            .and_then(|word| word.parse().ok())
            .unwrap_or(f64::NAN)
    })
}

#[inline]
fn fast_float(word: &[u8]) -> Option<f64> {
    let (negative, digits) = match word.first()? {
        b'-' => (true, &word[1..]),
        b'+' => (false, &word[1..]),
        _ => (false, word),
    };
    if digits.is_empty() || digits.len() > 24 {
        return None;
    }
    let mut mantissa = 0_u64;
    let mut count = 0_usize;
    let mut power = 0_i32;
    let mut seen_point = false;
    let mut at = 0;
    while at < digits.len() {
        let digit = digits[at].wrapping_sub(b'0');
        if digit <= 9 {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
            // Leading zeros are not digits of the mantissa.
            count += usize::from(mantissa != 0);
            power -= i32::from(seen_point);
        } else if digits[at] == b'.' && !seen_point {
            seen_point = true;
        } else if matches!(digits[at], b'e' | b'E') && at > 0 {
            power += small_exponent(&digits[at + 1..])?;
            break;
        } else {
            return None;
        }
        at += 1;
    }
    if count > 19 || mantissa > (1 << 53) || (at == 1 && seen_point) {
        return None;
    }
    #[allow(clippy::cast_precision_loss)]
    let value = mantissa as f64;
    let scale = *TENS.get(power.unsigned_abs() as usize)?;
    let value = if power < 0 {
        value / scale
    } else {
        value * scale
    };
    Some(if negative { -value } else { value })
}

fn small_exponent(text: &[u8]) -> Option<i32> {
    let (negative, digits) = match text.first()? {
        b'-' => (true, &text[1..]),
        b'+' => (false, &text[1..]),
        _ => (false, text),
    };
    if digits.is_empty() || digits.len() > 3 || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let value = digits
        .iter()
        .fold(0, |value, digit| value * 10 + i32::from(digit - b'0'));
    Some(if negative { -value } else { value })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Compares with the standard library's parser.
        #[test]
        fn floats_are_those_of_the_standard_library(text in "[+-]?[0-9]{0,12}(\\.[0-9]{0,12})?([eE][+-]?[0-9]{1,3})?") {
            let expected = text.parse::<f64>().unwrap_or(f64::NAN);
            let found = float(text.as_bytes());
            prop_assert!(found.to_bits() == expected.to_bits() || (found.is_nan() && expected.is_nan()), "{text}: {found} for {expected}");
        }

        #[test]
        fn any_finite_float_comes_back(value in any::<f64>()) {
            let text = format!("{value:e}");
            prop_assert_eq!(float(text.as_bytes()).to_bits(), text.parse::<f64>().unwrap().to_bits());
        }
    }

    #[test]
    fn what_is_no_number_is_nan() {
        for word in [
            "",
            ".",
            "-",
            "+",
            "e5",
            ".e5",
            "1e",
            "1.2.3",
            "1.#QNAN",
            "-nan(ind)",
            "1,5",
            "0x10",
        ] {
            assert!(float(word.as_bytes()).is_nan(), "{word}");
        }
    }

    #[test]
    fn more_digits_than_64_bits_hold() {
        // 2^64 + 1, which is 1 in 64 bits.
        assert_eq!(
            float(b"18446744073709551617").to_bits(),
            2.0_f64.powi(64).to_bits()
        );
        assert_eq!(
            float(b"0.0000000000000000000000001").to_bits(),
            1e-25_f64.to_bits()
        );
    }

    #[test]
    fn indices() {
        assert_eq!(index(b"4294967295"), Some(u32::MAX));
        assert_eq!(index(b"4294967296"), None);
        assert_eq!(index(b"00000000000007"), Some(7));
        assert_eq!(index(b"-1"), None);
        assert_eq!(index(b""), None);
    }
}
