//! Text for people.

use super::content::{Line, Span, headline, sections, side};
use urdd_format::diff_report::DiffReport;
use urdd_format::escape;

/// A comparison as text. Names from the input are escaped.
pub fn text(report: &DiffReport) -> String {
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

fn line(spans: &[Span]) -> String {
    let spans = spans.iter().map(|span| match span {
        Span::Words(text) => text.clone(),
        Span::Name(text) | Span::Value(text) => escape::line(text).into_owned(),
        Span::Arrow => " -> ".to_owned(),
    });
    spans.collect()
}
