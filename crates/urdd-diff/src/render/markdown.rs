//! Markdown for a pull request.

use super::content::{Line, Span, headline, sections, side};
use urdd_format::diff_report::DiffReport;
use urdd_format::escape;

/// Maximum length of the text in bytes: GitHub takes comments of 65,536 characters.
const MAX_BYTES: usize = 60_000;

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
        Span::Name(text) | Span::Value(text) => escape::code_span(text),
        Span::Arrow => " → ".to_owned(),
    });
    spans.collect()
}
