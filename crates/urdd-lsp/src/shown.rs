//! Texts that editors show.

use lsp_types::{Hover, HoverContents, MarkupContent, MarkupKind, Range};

use urdd_format::escape;

pub fn markdown(value: String, range: Option<Range>) -> Hover {
    Hover {
        contents: HoverContents::Markup(MarkupContent { kind: MarkupKind::Markdown, value }),
        range,
    }
}

/// A sentence that may quote a file: nothing in it begins anything of Markdown.
pub fn sentence(text: &str) -> String {
    let mut shown = String::new();
    for c in escape::line(text).chars() {
        if "\\`*_[]<>&|~#".contains(c) {
            shown.push('\\');
        }
        shown.push(c);
    }
    shown
}

/// A name as code: no name ends it, or begins something else.
pub fn code(name: &str) -> String {
    let name = escape::line(name).replace('`', "'");
    format!("`{name}`")
}
