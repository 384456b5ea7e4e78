//! A document to be written: in memory as a whole, or serialised row by row to save memory.

use std::fmt::{self, Write};
use std::sync::Arc;

use serde::Serialize;
use serde_json::Value;

use super::canonical;

/// A document that can be written.
pub enum Document {
    /// Any document.
    Whole(Value),
    /// An object that contains long lists. Its member names need no quotes in YAML.
    Object(Vec<(&'static str, Member)>),
}

/// A member of a [`Document::Object`].
pub enum Member {
    /// Any value.
    Value(Value),
    /// A long list.
    Rows(Rows),
    /// An object that contains long lists, with at least one member.
    Object(Vec<(&'static str, Member)>),
}

/// A list of lists and objects, each serialised when it is written.
pub struct Rows {
    length: usize,
    row: Box<dyn Fn(usize) -> Result<Value, serde_json::Error> + Send>,
}

impl Rows {
    /// Rows of values that serialise to lists or objects.
    pub fn new<T: Serialize + Send + 'static>(rows: Vec<T>) -> Self {
        Rows { length: rows.len(), row: Box::new(move |idx| serde_json::to_value(&rows[idx])) }
    }

    /// Rows that serialise to lists or objects and are part of a shared value.
    pub fn of<M: Send + Sync + 'static, T: Serialize>(
        whole: &Arc<M>,
        rows: impl Fn(&M) -> &[T] + Send + 'static,
    ) -> Self {
        let whole = Arc::clone(whole);
        Rows {
            length: rows(&whole).len(),
            row: Box::new(move |idx| serde_json::to_value(&rows(&whole)[idx])),
        }
    }

    fn row(&self, idx: usize) -> Result<Value, fmt::Error> {
        (self.row)(idx).map_err(|_| fmt::Error)
    }
}

impl Member {
    /// A long list, or null for `None`.
    pub fn rows_or_null(rows: Option<Rows>) -> Self {
        rows.map_or(Member::Value(Value::Null), Member::Rows)
    }
}

impl Document {
    /// Writes its canonical JSON.
    ///
    /// # Errors
    /// Those of `out`, or if a row cannot be serialised.
    pub fn json(&self, out: &mut impl Write) -> fmt::Result {
        match self {
            Document::Whole(value) => return canonical::json(value, out),
            Document::Object(members) => json_object(members, 0, out)?,
        }
        out.write_char('\n')
    }

    /// Writes its canonical YAML.
    ///
    /// # Errors
    /// Those of `out`, or if a row cannot be serialised.
    pub fn yaml(&self, out: &mut impl Write) -> fmt::Result {
        match self {
            Document::Whole(value) => canonical::yaml(value, out),
            Document::Object(members) => yaml_members(members, 0, out),
        }
    }
}

fn json_object(members: &[(&str, Member)], indent: usize, out: &mut impl Write) -> fmt::Result {
    let inner = indent + 2;
    let mut before = "{\n";
    for (name, member) in members {
        write!(out, "{before}{:inner$}\"{name}\": ", "")?;
        before = ",\n";
        match member {
            Member::Value(value) => canonical::json_node(value, inner, out)?,
            Member::Object(members) => json_object(members, inner, out)?,
            Member::Rows(rows) if rows.length == 0 => out.write_str("[]")?,
            Member::Rows(rows) => {
                let mut before = "[\n";
                for idx in 0..rows.length {
                    write!(out, "{before}{:inner$}  ", "")?;
                    before = ",\n";
                    canonical::json_node(&rows.row(idx)?, inner + 2, out)?;
                }
                write!(out, "\n{:inner$}]", "")?;
            }
        }
    }
    write!(out, "\n{:indent$}}}", "")
}

fn yaml_members(members: &[(&str, Member)], indent: usize, out: &mut impl Write) -> fmt::Result {
    for (name, member) in members {
        write!(out, "{:indent$}{name}:", "")?;
        match member {
            Member::Value(value) => canonical::yaml_rest(value, indent + 2, out)?,
            Member::Object(members) => {
                out.write_char('\n')?;
                yaml_members(members, indent + 2, out)?;
            }
            Member::Rows(rows) if rows.length == 0 => out.write_str(" []\n")?,
            Member::Rows(rows) => {
                out.write_char('\n')?;
                for idx in 0..rows.length {
                    canonical::yaml_element(&rows.row(idx)?, indent + 2, out)?;
                }
            }
        }
    }
    Ok(())
}
