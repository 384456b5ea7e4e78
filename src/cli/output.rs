//! Printing. A pipe that is closed early is not an error worth a word.

use std::io::Write;

/// Prints to standard output.
pub fn print(text: &str) {
    let mut out = std::io::stdout().lock();
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}

/// Prints an error to standard error.
pub fn error(message: &str) {
    let _ = writeln!(std::io::stderr().lock(), "urdd: {message}");
}

/// Whether to use colours on a stream: on a terminal, unless the user asked for none.
pub fn color(terminal: bool) -> bool {
    terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}
