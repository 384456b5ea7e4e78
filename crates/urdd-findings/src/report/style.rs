//! Appearance of reports for people.

use std::fmt;

use urdd_format::report::Severity;

/// Appearance of the report for people.
#[derive(Debug, Clone, Copy)]
pub struct Style {
    /// Whether to use colours.
    pub color: bool,
    /// Whether to leave out URDDs without findings.
    pub quiet: bool,
    /// Whether to write every URDD in full, regardless of their number.
    pub full: bool,
    /// Maximum number of places per finding.
    pub max_places: usize,
    /// Whether to point to `urdd lint` below a URDF.
    pub suggests_lint: bool,
    /// Maximum line length of the summary, in characters.
    pub width: usize,
}

impl Default for Style {
    fn default() -> Self {
        Style {
            color: false,
            quiet: false,
            full: false,
            max_places: 3,
            suggests_lint: false,
            width: 100,
        }
    }
}

pub(super) const BOLD: &str = "\x1b[1m";
pub(super) const DIM: &str = "\x1b[2m";
pub(super) const RED: &str = "\x1b[31m";
pub(super) const GREEN: &str = "\x1b[32m";
pub(super) const YELLOW: &str = "\x1b[33m";
pub(super) const BLUE: &str = "\x1b[34m";
const PLAIN: &str = "\x1b[0m";

/// Every escape sequence that a report can contain.
pub const STYLES: &[&str] = &[BOLD, DIM, RED, GREEN, YELLOW, BLUE, PLAIN];

impl Style {
    pub(super) fn paint(self, code: &str, text: impl fmt::Display) -> String {
        if self.color { format!("{code}{text}{PLAIN}") } else { text.to_string() }
    }
}

/// The word for a severity, in its colour.
pub(super) fn severity(severity: Severity, style: Style) -> String {
    let color = match severity {
        Severity::Error => RED,
        Severity::Warning => YELLOW,
        Severity::Info => BLUE,
    };
    style.paint(color, severity.as_str())
}
