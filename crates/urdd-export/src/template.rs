//! Text that some programs would expand before they read the file that holds it.

/// Escapes each `{` that begins an expression, a statement or a comment of Jinja: `launch_param_builder`, by which MoveIt
/// reads YAML, renders files by Jinja first. `brace` is the file's escape for `{`, so that its reader gets the text back.
pub fn without_jinja(text: &str, brace: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut characters = text.chars().peekable();
    while let Some(c) = characters.next() {
        match (c, characters.peek()) {
            ('{', Some('{' | '%' | '#')) => out += brace,
            _ => out.push(c),
        }
    }
    out
}

/// Text that xacro gives back unchanged, in attributes and characters. Of several `$` before a brace, xacro drops one; it
/// takes no others, but an expression whose value is `$`.
pub fn for_xacro(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('$') {
        let (before, from) = rest.split_at(at);
        rest = from.trim_start_matches('$');
        let count = from.len() - rest.len();
        out += before;
        out += &match rest.starts_with(['{', '(']) {
            true => "$".repeat(count + 1),
            false => "${'$'}".repeat(count - 1) + "$",
        };
    }
    out + rest
}
