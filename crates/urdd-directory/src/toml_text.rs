//! TOML as this program writes it: what is not printable is escaped.

use std::fmt::Write;

use urdd_format::escape::is_hidden;

/// A TOML without comments, in which each hidden character of a string is an escape: those that turn text around, that are
/// not seen, and control characters.
pub fn printable(text: &str) -> String {
    let is_raw = |c| !matches!(c, '\n' | '\t') && is_hidden(c);
    if !text.contains(is_raw) {
        return text.to_owned();
    }
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(['"', '\'']) {
        let (before, from) = rest.split_at(start);
        out.push_str(before);
        let of = |quote: &'static str| from.starts_with(quote).then_some(quote);
        let quotes = of("\"\"\"").or(of("'''")).or(of("\"")).unwrap_or("'");
        let inside = &from[quotes.len()..];
        let (inside, after) = inside.split_at(length(inside, quotes));
        rest = after.get(quotes.len()..).unwrap_or_default();
        if !inside.contains(is_raw) {
            out.extend([quotes, inside, quotes]);
            continue;
        }
        // A literal string has no escapes, and the first line break of three quotes is none of the text.
        let is_literal = quotes.starts_with('\'');
        let (quotes, inside) = match is_literal {
            true => ("\"", inside.strip_prefix('\n').unwrap_or(inside)),
            false => (quotes, inside),
        };
        out.push_str(quotes);
        for c in inside.chars() {
            match c {
                '"' | '\\' if is_literal => out.extend(['\\', c]),
                '\n' if is_literal => out.push_str("\\n"),
                c if is_raw(c) => _ = write!(out, "\\U{:08X}", u32::from(c)),
                c => out.push(c),
            }
        }
        out.push_str(quotes);
    }
    out + rest
}

/// The bytes of a string up to the quotes that end it.
fn length(inside: &str, quotes: &str) -> usize {
    let mut is_escaped = false;
    for (at, c) in inside.char_indices() {
        match c {
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = quotes.starts_with('"'),
            _ if inside[at..].starts_with(quotes) => {
                // Up to two quotes before three are of the text.
                let is_later = |more: &usize| {
                    quotes.len() > 1
                        && inside.get(at + more..).is_some_and(|it| it.starts_with(quotes))
                };
                return at + (1..=2).take_while(is_later).count();
            }
            _ => {}
        }
    }
    inside.len()
}
