//! Markdown for a pull request.

use super::content::{Line, Span, headline, sections, side};
use urdd_format::diff_report::DiffReport;
use urdd_format::escape;

/// Maximum length of the text in bytes: GitHub takes comments of 65,536 characters.
const MAX_BYTES: usize = 60_000;

/// Maximum length of one value in bytes.
const MAX_VALUE_BYTES: usize = 2_000;

/// A comparison as Markdown. All text from the input is in code spans: no name becomes a link, a mention or HTML. Long
/// comparisons are cut; the last line says so.
pub fn markdown(report: &DiffReport) -> String {
    let mut out = format!("### `urdd diff`: {}\n\n", headline(report));
    for (word, of) in [("A", &report.before), ("B", &report.after)] {
        out.push_str(&format!("- {word}: {}\n", line(&side(of))));
    }
    for section in sections(report) {
        let mut heading = format!("\n#### {}\n\n", section.title);
        for Line { depth, spans } in &section.lines {
            let margin = "  ".repeat(*depth);
            let next = format!("{heading}{margin}- {}\n", line(spans));
            if out.len() + next.len() > MAX_BYTES {
                out.push_str(
                    "\n*The rest is left out here. `urdd diff` without `--format markdown` prints all.*\n",
                );
                return out;
            }
            out.push_str(&next);
            heading.clear();
        }
    }
    out
}

fn line(spans: &[Span]) -> String {
    let spans = spans.iter().map(|span| match span {
        Span::Words(text) => text.clone(),
        Span::Name(text) | Span::Value(text) => code(text),
        Span::Arrow => " → ".to_owned(),
    });
    spans.collect()
}

/// A code span: its fence is longer than any run of backticks in the text.
fn code(text: &str) -> String {
    // A runner of GitHub Actions takes what follows for a command, anywhere in a line.
    let text = escape::line(text).replace("##[", "#\\u0023[");
    let mut starts = text.char_indices().map(|(at, _)| at);
    let end = starts.find(|at| *at > MAX_VALUE_BYTES);
    let (text, rest) = text.split_at(end.unwrap_or(text.len()));
    let more = if rest.is_empty() { "" } else { " …" };
    if text.is_empty() {
        return "(empty)".to_owned();
    }
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest + 1);
    let pad = match text.starts_with('`') || text.ends_with('`') || text.trim().is_empty() {
        true => " ",
        false => "",
    };
    format!("{fence}{pad}{text}{pad}{fence}{more}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_span_holds_any_name() {
        for (name, span) in [
            ("tool0", "`tool0`"),
            ("a`b", "``a`b``"),
            ("``", "``` `` ```"),
            ("<img src=x>", "`<img src=x>`"),
            ("a\nb", "`a\\nb`"),
            ("", "(empty)"),
        ] {
            assert_eq!(code(name), span);
        }
        assert!(code(&"x".repeat(100_000)).len() < 2_100);
    }
}
