//! Lists of known failures of an external program.
//!
//! A line has the skipped item, `#`, and the reason. Empty lines and lines that begin with `#` are ignored.

/// A known failure.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Skip {
    /// Line in the file, from 1.
    pub line: usize,
    /// The words before the reason.
    pub words: Vec<String>,
    /// Reason.
    pub reason: String,
}

impl Skip {
    /// The line as written, without the reason.
    pub fn what(&self) -> String {
        self.words.join(" ")
    }
}

/// Errors in a skip list.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SkipError {
    /// A line without a reason.
    #[error("line {0}: say why, after a `#`: `{1}  # reason`")]
    NoReason(usize, String),
    /// A line with too many words.
    #[error("line {0}: unexpected `{1}`; write {2}")]
    TooMany(usize, String, &'static str),
    /// A line that names something that does not exist.
    #[error("line {0}: there is no `{1}`")]
    Unknown(usize, String),
}

/// Reads a list whose lines have at most `most` words. `form` describes a line, for messages.
///
/// # Errors
/// The first line with too many words or without a reason.
pub fn read(text: &str, most: usize, form: &'static str) -> Result<Vec<Skip>, SkipError> {
    let mut skips = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let (what, reason) = line.split_once('#').unwrap_or((line, ""));
        let words: Vec<String> = what.split_whitespace().map(str::to_owned).collect();
        let skip = Skip { line: index + 1, words, reason: reason.trim().to_owned() };
        match skip.words.len() {
            0 => continue,
            words if words > most => {
                return Err(SkipError::TooMany(skip.line, skip.what(), form));
            }
            _ if skip.reason.is_empty() => {
                return Err(SkipError::NoReason(skip.line, skip.what()));
            }
            _ => skips.push(skip),
        }
    }
    Ok(skips)
}

/// Checks that each skip is about something.
///
/// # Errors
/// The first one that is not.
pub fn check(skips: &[Skip], is_known: impl Fn(&Skip) -> bool) -> Result<(), SkipError> {
    match skips.iter().find(|skip| !is_known(skip)) {
        Some(skip) => Err(SkipError::Unknown(skip.line, skip.what())),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_skip_has_a_reason() {
        let text = "# what we know\n\ngripper # no mimics yet\nhand  dof_module\t# same # here\n";
        let skips = read(text, 2, "").unwrap();
        assert_eq!(skips.len(), 2);
        assert_eq!(skips[0].reason, "no mimics yet");
        assert_eq!((skips[1].line, skips[1].what().as_str()), (4, "hand dof_module"));
        assert_eq!(skips[1].reason, "same # here");
        assert_eq!(
            read("a # b\ngripper", 2, ""),
            Err(SkipError::NoReason(2, "gripper".to_owned()))
        );
        assert!(matches!(read("a b c # d", 2, ""), Err(SkipError::TooMany(1, ..))));
    }
}
