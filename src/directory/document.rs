//! A document on its way to disk: whole, or row by row where the whole would be much memory.

use std::fmt::{self, Write};

use serde::Serialize;
use serde_json::Value;

use super::canonical;

/// A document that can be written.
pub enum Document {
    /// Any.
    Whole(Value),
    /// An object whose members are long lists, or null. Their names need no quotes in YAML.
    Lists(Vec<(&'static str, Option<Rows>)>),
}

/// A list of lists and objects, each made when it is written.
pub struct Rows {
    length: usize,
    row: Box<dyn Fn(usize) -> Result<Value, serde_json::Error> + Send>,
}

impl Rows {
    /// Of things that are written as lists or objects.
    pub fn new<T: Serialize + Send + 'static>(rows: Vec<T>) -> Self {
        Rows {
            length: rows.len(),
            row: Box::new(move |idx| serde_json::to_value(&rows[idx])),
        }
    }

    fn row(&self, idx: usize) -> Result<Value, fmt::Error> {
        (self.row)(idx).map_err(|_| fmt::Error)
    }
}

impl Document {
    /// Writes its canonical JSON.
    ///
    /// # Errors
    /// Those of `out`, and where a row cannot be made a value.
    pub fn json(&self, out: &mut impl Write) -> fmt::Result {
        let lists = match self {
            Document::Whole(value) => return canonical::json(value, out),
            Document::Lists(lists) => lists,
        };
        let mut before = "{\n";
        for (name, rows) in lists {
            write!(out, "{before}  \"{name}\": ")?;
            before = ",\n";
            match rows {
                None => out.write_str("null")?,
                Some(rows) if rows.length == 0 => out.write_str("[]")?,
                Some(rows) => {
                    let mut before = "[\n    ";
                    for idx in 0..rows.length {
                        out.write_str(before)?;
                        before = ",\n    ";
                        canonical::json_node(&rows.row(idx)?, 4, out)?;
                    }
                    out.write_str("\n  ]")?;
                }
            }
        }
        out.write_str("\n}\n")
    }

    /// Writes its canonical YAML.
    ///
    /// # Errors
    /// Those of `out`, and where a row cannot be made a value.
    pub fn yaml(&self, out: &mut impl Write) -> fmt::Result {
        let lists = match self {
            Document::Whole(value) => return canonical::yaml(value, out),
            Document::Lists(lists) => lists,
        };
        for (name, rows) in lists {
            match rows {
                None => writeln!(out, "{name}: null")?,
                Some(rows) if rows.length == 0 => writeln!(out, "{name}: []")?,
                Some(rows) => {
                    writeln!(out, "{name}:")?;
                    for idx in 0..rows.length {
                        canonical::yaml_element(&rows.row(idx)?, 2, out)?;
                    }
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn row_by_row_is_as_the_whole() {
        let rows = json!([[1, 2], [[], [1.5]], {"a": {"b": [[]]}, "c": "no"}, {}, [], [null]]);
        let list = rows.as_array().unwrap().clone();
        let whole = json!({"first": rows, "none": null, "empty": [], "last": [[0]]});
        let lists = Document::Lists(vec![
            ("first", Some(Rows::new(list))),
            ("none", None),
            ("empty", Some(Rows::new(Vec::<Value>::new()))),
            ("last", Some(Rows::new(vec![[0]]))),
        ]);
        let (mut json, mut yaml) = (String::new(), String::new());
        lists.json(&mut json).unwrap();
        lists.yaml(&mut yaml).unwrap();
        assert_eq!(json, canonical::json_string(&whole));
        assert_eq!(yaml, canonical::yaml_string(&whole));
    }
}
