//! Markup of XML, found without parsing.

/// What a `<` begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MarkupKind {
    /// A comment, or a CDATA section.
    Text,
    /// `<?target …?>`.
    Instruction,
    /// `<!DOCTYPE …` up to its `[`, and the declarations inside it.
    Declaration,
    /// `<a>`, `<a/>`, `</a>`.
    Tag,
}

/// A piece of markup.
pub(super) struct Markup {
    pub kind: MarkupKind,
    /// Byte offset of its `<`.
    pub start: usize,
    /// Byte offset of its end; `None` if it has none.
    pub end: Option<usize>,
}

/// The first markup from byte `at` on.
pub(super) fn next(text: &str, at: usize) -> Option<Markup> {
    let start = at + text[at..].find('<')?;
    let rest = &text[start..];
    // `<!-->` starts a comment but does not end it.
    let until =
        |head: &str, mark: &str| Some(head.len() + rest[head.len()..].find(mark)? + mark.len());
    let (kind, length) = if rest.starts_with("<!--") {
        (MarkupKind::Text, until("<!--", "-->"))
    } else if rest.starts_with("<![CDATA[") {
        (MarkupKind::Text, until("<![CDATA[", "]]>"))
    } else if rest.starts_with("<?") {
        (MarkupKind::Instruction, until("<?", "?>"))
    } else if rest.starts_with("<!DOCTYPE") {
        (MarkupKind::Declaration, tag_length(rest, b">["))
    } else if rest.starts_with("<!") {
        // The parser knows no quotes in them.
        (MarkupKind::Declaration, until("<!", ">"))
    } else {
        (MarkupKind::Tag, tag_length(rest, b">"))
    };
    Some(Markup { kind, start, end: length.map(|length| start + length) })
}

/// The length up to the first of `ends` outside quotes.
fn tag_length(text: &str, ends: &[u8]) -> Option<usize> {
    let mut quote = None;
    let end = text.bytes().position(|byte| match quote {
        Some(open) => {
            quote = (byte != open).then_some(open);
            false
        }
        None => {
            quote = matches!(byte, b'"' | b'\'').then_some(byte);
            ends.contains(&byte)
        }
    });
    Some(end? + 1)
}

/// The qualified name of the outermost element of a text, found without parsing it; `None` if there is none.
pub fn root_name(text: &str) -> Option<&str> {
    let mut at = 0;
    loop {
        let markup = next(text, at)?;
        if markup.kind == MarkupKind::Tag {
            // White space there is tinyxml2's.
            let name = text[markup.start + 1..].trim_start();
            let end = name.find(|c: char| c.is_ascii_whitespace() || matches!(c, '>' | '/'))?;
            return Some(&name[..end]).filter(|name| !name.is_empty());
        }
        at = markup.end?;
    }
}
