//! Names that formats can hold, and names of files.

use std::collections::HashSet;

use super::Format;
use super::error::ExportError;

/// Longest part of a file's name that is taken from a link.
const LONGEST: usize = 80;

/// An error where a format cannot hold a name.
pub(super) fn check(format: Format, what: &'static str, name: &str) -> Result<(), ExportError> {
    let is_xml = !matches!(format, Format::Curobo | Format::Foam);
    let reason = if name.is_empty() && what != "robot" {
        "it is empty"
    } else if is_xml && name.chars().any(|c| c.is_control() || is_no_character(c)) {
        "it has characters that XML cannot hold in an attribute"
    } else if format == Format::Mjcf && what == "link" && name == "world" {
        "MuJoCo has a body of that name already"
    } else {
        return Ok(());
    };
    Err(ExportError::Name {
        format,
        what,
        name: name.to_owned(),
        reason,
    })
}

fn is_no_character(c: char) -> bool {
    matches!(c, '\u{fffe}' | '\u{ffff}')
}

/// Makes names of files out of names of links: letters, digits, `.`, `-` and `_`, and no name twice, whatever the case.
#[derive(Debug, Default)]
pub(super) struct FileNames {
    taken: HashSet<String>,
}

impl FileNames {
    /// A name that was not given before.
    pub fn of(&mut self, wanted: &str) -> String {
        let kept = |c: char| match c {
            'a'..='z' | 'A'..='Z' | '0'..='9' | '.' | '-' | '_' => c,
            _ => '_',
        };
        let mut base: String = wanted.chars().map(kept).take(LONGEST).collect();
        if base.is_empty() || base.starts_with('.') {
            base.insert(0, '_');
        }
        let mut name = base.clone();
        let mut number = 2;
        while !self.taken.insert(name.to_ascii_lowercase()) {
            name = format!("{base}-{number}");
            number += 1;
        }
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_safe_and_differ() {
        let mut names = FileNames::default();
        assert_eq!(names.of("../a b"), "_.._a_b");
        assert_eq!(names.of("Arm"), "Arm");
        assert_eq!(names.of("arm"), "arm-2");
        assert_eq!(names.of("arm"), "arm-3");
        assert_eq!(names.of(""), "_");
        assert!(names.of(&"x".repeat(500)).len() <= LONGEST);
    }

    #[test]
    fn a_name_that_xml_cannot_hold_is_an_error() {
        assert!(check(Format::Srdf, "link", "a<b>\"&'").is_ok());
        assert!(check(Format::Srdf, "link", "a\nb").is_err());
        assert!(check(Format::Curobo, "link", "a\nb").is_ok());
        assert!(check(Format::Mjcf, "link", "world").is_err());
        assert!(check(Format::Urdf, "link", "world").is_ok());
        assert!(check(Format::Urdf, "link", "").is_err());
    }
}
