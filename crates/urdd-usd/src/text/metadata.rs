//! Metadata in brackets.

use std::sync::Arc;

use super::super::error::{Fault, Wrong};
use super::super::layer::{MAX_FIELDS, put};
use super::super::value::{Item, ListOp, Name, Value};
use super::lexer::Token;
use super::values::Reader;

/// How a statement edits a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Edit {
    Explicit,
    Add,
    Append,
    Prepend,
    Delete,
    Reorder,
}

impl Edit {
    /// The edit of a word.
    pub fn of(word: &str) -> Option<Self> {
        match word {
            "add" => Some(Edit::Add),
            "append" => Some(Edit::Append),
            "prepend" => Some(Edit::Prepend),
            "delete" => Some(Edit::Delete),
            "reorder" => Some(Edit::Reorder),
            _ => None,
        }
    }

    /// The edit by these items. Orders do not matter to robots.
    pub fn list(self, items: Vec<Item>) -> ListOp {
        let mut list = ListOp::default();
        match self {
            Edit::Explicit => list.explicit = Some(items),
            Edit::Add => list.added = items,
            Edit::Append => list.appended = items,
            Edit::Prepend => list.prepended = items,
            Edit::Delete => list.deleted = items,
            Edit::Reorder => {}
        }
        list
    }
}

/// The texts or paths of a value as entries of a list; none of `None`.
pub fn items(value: &Value, each: fn(Name) -> Item) -> Vec<Item> {
    match value {
        Value::Text(one) | Value::Path(one) | Value::Asset(one) => vec![each(one.clone())],
        Value::Texts(all) => all.iter().cloned().map(each).collect(),
        Value::Number(number) => vec![each(Arc::from(number.to_string()))],
        Value::Numbers { values, .. } => {
            values.iter().map(|number| each(Arc::from(number.to_string()))).collect()
        }
        _ => Vec::new(),
    }
}

impl Reader<'_> {
    /// The fields in `( )`, if that is next.
    pub fn metadata(&mut self) -> Result<Vec<(Name, Value)>, Wrong> {
        let mut fields: Vec<(Name, Value)> = Vec::new();
        if !self.lexer.takes('(')? {
            return Ok(fields);
        }
        loop {
            let mut edit = Edit::Explicit;
            let mut word = match self.lexer.next()? {
                Token::Mark(')') => return Ok(fields),
                Token::Mark(';' | ',') => continue,
                Token::Text(text) => {
                    fields.push((self.name("comment"), Value::Text(self.name(&text))));
                    continue;
                }
                Token::Name(word) => word,
                other => return Err(self.lexer.expected("metadata or `)`", &other)),
            };
            if let Some(of) = Edit::of(word) {
                edit = of;
                word = self.lexer.name("the name of a list")?;
            }
            if fields.len() >= MAX_FIELDS {
                return Err(self.lexer.wrong(Fault::Fields(MAX_FIELDS)));
            }
            self.lexer.take('=', "`=`")?;
            if word == "symmetryFunction" {
                // Its value may be missing.
                if matches!(self.lexer.peek()?, Token::Name(_)) {
                    self.lexer.next()?;
                }
                continue;
            }
            let (field, value) = self.field(word, edit)?;
            put(&mut fields, self.name(field), value);
        }
    }

    /// A field by its word in text: its name, and its value.
    fn field<'w>(&mut self, word: &'w str, edit: Edit) -> Result<(&'w str, Value), Wrong> {
        let list = |items| Value::List(Arc::new(edit.list(items)));
        Ok(match word {
            "references" | "payload" => (word, list(self.references()?)),
            "inherits" => ("inheritPaths", list(items(&self.value(0)?, Item::Path))),
            "specializes" => (word, list(items(&self.value(0)?, Item::Path))),
            "variantSets" => ("variantSetNames", list(items(&self.value(0)?, Item::Text))),
            "apiSchemas" => (word, list(items(&self.value(0)?, Item::Text))),
            "variants" => ("variantSelection", self.value(0)?),
            "doc" => ("documentation", self.value(0)?),
            "subLayers" => (word, self.sublayers()?),
            "relocates" => {
                self.skip_pairs()?;
                (word, Value::Unread(Arc::from(word)))
            }
            _ => {
                let value = self.value(0)?;
                match edit {
                    Edit::Explicit => (word, value),
                    _ => (word, list(items(&value, Item::Text))),
                }
            }
        })
    }

    /// References or payloads: one, or a list.
    fn references(&mut self) -> Result<Vec<Item>, Wrong> {
        let is_list = self.lexer.takes('[')?;
        let mut all = Vec::new();
        loop {
            let item = match self.lexer.next()? {
                Token::Mark(']') if is_list => return Ok(all),
                Token::Mark(',') if is_list => continue,
                Token::Name("None") if !is_list => return Ok(all),
                Token::Path(path) => {
                    Item::Reference { asset: self.name(""), path: self.name(path) }
                }
                Token::Asset(asset) => {
                    let asset = self.name(&asset);
                    let path = match self.lexer.peek()? {
                        Token::Path(path) => {
                            let path = *path;
                            self.lexer.next()?;
                            self.name(path)
                        }
                        _ => self.name(""),
                    };
                    Item::Reference { asset, path }
                }
                other => return Err(self.lexer.expected("a reference", &other)),
            };
            self.metadata()?;
            all.push(item);
            if !is_list {
                return Ok(all);
            }
        }
    }

    /// The paths of sublayers.
    fn sublayers(&mut self) -> Result<Value, Wrong> {
        self.lexer.take('[', "`[`")?;
        let mut all = Vec::new();
        loop {
            match self.lexer.next()? {
                Token::Mark(']') => return Ok(Value::Texts(all.into())),
                Token::Mark(',') => {}
                Token::Asset(asset) => {
                    all.push(self.name(&asset));
                    self.metadata()?;
                }
                other => return Err(self.lexer.expected("the path of a layer or `]`", &other)),
            }
        }
    }

    /// `{ <path>: <path>, ... }`.
    fn skip_pairs(&mut self) -> Result<(), Wrong> {
        self.lexer.take('{', "`{`")?;
        loop {
            match self.lexer.next()? {
                Token::Mark('}') => return Ok(()),
                Token::Mark(':' | ',') | Token::Path(_) => {}
                other => return Err(self.lexer.expected("a path or `}`", &other)),
            }
        }
    }
}
