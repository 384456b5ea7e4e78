//! A comparison as text for people, and as Markdown for a pull request.

mod content;

use self::content::{Line, Span, headline, sections, side};
use urdd_format::diff_report::DiffReport;
use urdd_format::escape;

pub(super) use self::content::count;

/// Maximum length of Markdown in bytes: GitHub takes comments of 65,536 characters.
const MAX_BYTES: usize = 60_000;

/// A comparison as text. Names from the input are escaped.
pub fn text(report: &DiffReport) -> String {
    let line = |spans: &[Span]| line(spans, " -> ", |text| escape::line(text).into_owned());
    let mut out = String::new();
    for (word, of) in [("A", &report.before), ("B", &report.after)] {
        out.push_str(&format!("{word}  {}\n", line(&side(of))));
    }
    for section in sections(report) {
        out.push_str(&format!("\n{}\n", section.title));
        for Line { depth, spans } in &section.lines {
            let margin = "    ".repeat(*depth);
            out.push_str(&format!("  {margin}{}\n", line(spans)));
        }
    }
    out.push_str(&format!("\n{}\n", headline(report)));
    out
}

/// A comparison as Markdown. All text from the input is in code spans: no name becomes a link, a mention or HTML. Long
/// comparisons are cut; the last line says so.
pub fn markdown(report: &DiffReport) -> String {
    let line = |spans: &[Span]| line(spans, " → ", escape::code_span);
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

fn line(spans: &[Span], arrow: &str, escaped: impl Fn(&str) -> String) -> String {
    let spans = spans.iter().map(|span| match span {
        Span::Words(text) => text.clone(),
        Span::Input(text) => escaped(text),
        Span::Arrow => arrow.to_owned(),
    });
    spans.collect()
}
