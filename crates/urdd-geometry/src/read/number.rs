//! Numbers of a text mesh.

/// The words of a text, separated by white space.
#[derive(Clone)]
pub(super) struct Words<'a> {
    rest: &'a [u8],
}

impl<'a> Words<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Self { rest: text }
    }

    /// The next number, rounded to nearest; NaN for a word that is not a number.
    pub(super) fn float(&mut self) -> Option<f64> {
        self.next().map(float)
    }

    /// Skips to the end of the line, unless the last word ended it.
    pub(super) fn skip_line(&mut self) {
        let end = self.rest.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        self.rest = &self.rest[end.unwrap_or(self.rest.len())..];
    }

    /// The next index; `Some(None)` for a word that is not an index.
    pub(super) fn index(&mut self) -> Option<Option<u32>> {
        let word = self.next()?;
        Some(std::str::from_utf8(word).ok().and_then(|word| word.parse().ok()))
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    #[inline]
    fn next(&mut self) -> Option<&'a [u8]> {
        let start = self.rest.iter().position(|byte| *byte > b' ')?;
        let rest = &self.rest[start..];
        let end = rest.iter().position(|byte| *byte <= b' ').unwrap_or(rest.len());
        let (word, rest) = rest.split_at(end);
        self.rest = rest;
        Some(word)
    }
}

/// Parses a number; NaN for any other word (`1.#QNAN`, `-nan(ind)`).
#[inline]
pub(super) fn float(word: &[u8]) -> f64 {
    let word = std::str::from_utf8(word).ok();
    word.and_then(|word| word.parse().ok()).unwrap_or(f64::NAN)
}

#[cfg(test)]
#[path = "tests/number.rs"]
mod tests;
