//! A YAML tree and its serialization.

use std::fmt::Write;

use urdd_format::escape;
use urdd_xml::number::number;

/// Maximum length of a key that is followed by `:`. Readers take 1,024 characters.
const MAX_KEY: usize = 1000;

/// A value.
#[derive(Debug, Clone)]
pub enum Yaml {
    /// A value on one line, already in YAML.
    Plain(String),
    /// Keys, already in YAML, and their values.
    Map(Vec<(String, Yaml)>),
    List(Vec<Yaml>),
}

impl Yaml {
    /// An empty mapping.
    pub const EMPTY: Yaml = Yaml::Map(Vec::new());

    /// A quoted string.
    pub fn text(text: &str) -> Yaml {
        Yaml::Plain(quoted(text))
    }

    /// A list of quoted strings, an item a line.
    pub fn texts<'t>(texts: impl IntoIterator<Item = &'t str>) -> Yaml {
        Yaml::List(texts.into_iter().map(Yaml::text).collect())
    }

    pub fn number(value: f64) -> Yaml {
        Yaml::Plain(real(value))
    }

    /// Numbers on one line.
    pub fn numbers(values: &[f64]) -> Yaml {
        let values: Vec<String> = values.iter().map(|value| real(*value)).collect();
        Yaml::Plain(format!("[{}]", values.join(", ")))
    }

    pub fn plain(text: &str) -> Yaml {
        Yaml::Plain(text.to_owned())
    }

    /// A mapping of fixed keys.
    pub fn map<const N: usize>(fixed: [(&str, Yaml); N]) -> Yaml {
        Yaml::Map(entries(fixed))
    }

    /// A mapping of names.
    pub fn named<'n>(names: impl IntoIterator<Item = (&'n str, Yaml)>) -> Yaml {
        let names = names.into_iter();
        Yaml::Map(names.map(|(name, value)| (quoted(name), value)).collect())
    }

    /// The document, after comments.
    pub fn document(&self, comments: &[String]) -> String {
        let mut text = head(comments);
        self.write(&mut text, 0, true);
        text
    }

    /// Writes the value after its key or dash.
    fn write(&self, text: &mut String, depth: usize, begins_line: bool) {
        let margin = "  ".repeat(depth);
        match self {
            Yaml::Plain(plain) => {
                let _ = writeln!(text, "{}{plain}", if begins_line { "" } else { " " });
            }
            Yaml::Map(entries) if entries.is_empty() => {
                *text += if begins_line { "{}\n" } else { " {}\n" };
            }
            Yaml::List(items) if items.is_empty() => {
                *text += if begins_line { "[]\n" } else { " []\n" };
            }
            Yaml::Map(entries) => {
                if !begins_line {
                    text.push('\n');
                }
                for (key, value) in entries {
                    // A longer key says where it begins (YAML 1.2.2, 7.4.2 and 8.2.2).
                    if key.chars().count() > MAX_KEY {
                        _ = write!(text, "{margin}? {key}\n{margin}:")
                    } else {
                        _ = write!(text, "{margin}{key}:")
                    }
                    value.write(text, depth + 1, false);
                }
            }
            Yaml::List(items) => {
                if !begins_line {
                    text.push('\n');
                }
                for item in items {
                    let _ = write!(text, "{margin}-");
                    match item {
                        // The first key is on the line of the dash.
                        Yaml::Map(entries) if !entries.is_empty() => {
                            let start = text.len();
                            item.write(text, depth + 1, true);
                            text.replace_range(start..start + margin.len() + 1, "");
                        }
                        _ => item.write(text, depth + 1, false),
                    }
                }
            }
        }
    }
}

/// The head of a document: comments.
pub(super) fn head(comments: &[String]) -> String {
    let braces = |comment: &String| comment.replace('{', "\\u{7b}");
    comments.iter().map(|comment| format!("# {}\n", escape::line(&braces(comment)))).collect()
}

/// Entries of fixed keys.
pub(super) fn entries<const N: usize>(fixed: [(&str, Yaml); N]) -> Vec<(String, Yaml)> {
    fixed.map(|(key, value)| (key.to_owned(), value)).into()
}

/// A number with a decimal point, and a sign in its exponent: without them, YAML 1.1 (PyYAML) reads a text.
pub fn real(value: f64) -> String {
    let text = number(value);
    let (digits, exponent) = match text.split_once('e') {
        Some((digits, exponent)) if exponent.starts_with('-') => (digits, format!("e{exponent}")),
        Some((digits, exponent)) => (digits, format!("e+{exponent}")),
        None => (text.as_str(), String::new()),
    };
    let point = if digits.contains('.') { "" } else { ".0" };
    format!("{digits}{point}{exponent}")
}

/// A double-quoted string that every reader of YAML, TOML and Python decodes exactly. It is JSON's, except for
/// characters beyond U+FFFF that are escaped: JSON uses two surrogates, which YAML does not combine. Braces are escaped, since
/// MoveIt renders YAML by Jinja before it reads it.
pub(super) fn quoted(name: &str) -> String {
    let mut text = String::new();
    for c in serde_json::Value::from(name).to_string().chars() {
        match escape::is_hidden(c) || c == '{' {
            true if c > '\u{ffff}' => _ = write!(text, "\\U{:08x}", u32::from(c)),
            true => _ = write!(text, "\\u{:04x}", u32::from(c)),
            false => text.push(c),
        }
    }
    text
}
