//! Values in text, what their types make of them, and metadata in brackets.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::lexer::{Lexer, Token};
use crate::error::{Fault, Wrong};
use crate::layer::{Item, Layer, ListOp, MAX_FIELDS, MAX_VALUE_LEVELS, Name, Value, put, to_half};

#[derive(Debug)]
pub struct Reader<'t> {
    pub lexer: Lexer<'t>,
    pub layer: Layer,
    pub names: HashSet<Name>,
    /// The properties of specs, by name.
    pub properties: HashMap<(u32, Name), usize>,
}

impl Reader<'_> {
    /// A name, which is there once.
    pub fn name(&mut self, text: &str) -> Name {
        if let Some(known) = self.names.get(text) {
            return known.clone();
        }
        let name: Name = Arc::from(text);
        self.names.insert(name.clone());
        name
    }

    pub fn value(&mut self, level: usize) -> Result<Value, Wrong> {
        Ok(match self.lexer.next()? {
            Token::Number(number) => Value::Number(number),
            Token::Text(text) => Value::Text(self.name(&text)),
            Token::Asset(path) => Value::Asset(self.name(&path)),
            Token::Path(path) => Value::Path(self.name(path)),
            Token::Name("None" | "AnimationBlock") => Value::Blocked,
            Token::Name(name) => match literal(name) {
                Some(value) => value,
                None => Value::Text(self.name(name)),
            },
            Token::Mark('(') => {
                let mut numbers = Vec::new();
                self.tuple(&mut numbers, level)?;
                Value::Tuple(numbers.into())
            }
            Token::Mark('[') => self.list()?,
            Token::Mark('{') => self.dictionary(level)?,
            other => return Err(self.lexer.expected("a value", &other)),
        })
    }

    /// The numbers of a tuple after its `(`.
    fn tuple(&mut self, numbers: &mut Vec<f64>, level: usize) -> Result<(), Wrong> {
        if level >= MAX_VALUE_LEVELS {
            return Err(self.lexer.wrong(Fault::DeepValue(MAX_VALUE_LEVELS)));
        }
        loop {
            match self.lexer.next()? {
                Token::Number(number) => numbers.push(number),
                Token::Name("inf") => numbers.push(f64::INFINITY),
                Token::Name("nan") => numbers.push(f64::NAN),
                Token::Mark('(') => self.tuple(numbers, level + 1)?,
                Token::Mark(',') => {}
                Token::Mark(')') => return Ok(()),
                other => return Err(self.lexer.expected("a number or `)`", &other)),
            }
        }
    }

    /// A list after its `[`.
    fn list(&mut self) -> Result<Value, Wrong> {
        let (mut numbers, mut texts, mut width) = (Vec::new(), Vec::new(), None);
        loop {
            let before = numbers.len();
            match self.lexer.next()? {
                Token::Mark(']') => break,
                Token::Mark(',') => continue,
                Token::Number(number) => numbers.push(number),
                Token::Mark('(') => self.tuple(&mut numbers, 0)?,
                Token::Name(name) => match literal(name) {
                    Some(Value::Bool(value)) => numbers.push(f64::from(value)),
                    Some(Value::Number(value)) => numbers.push(value),
                    _ => texts.push(self.name(name)),
                },
                Token::Text(text) | Token::Asset(text) => texts.push(self.name(&text)),
                Token::Path(path) => texts.push(self.name(path)),
                other => return Err(self.lexer.expected("an entry of a list or `]`", &other)),
            }
            let more = numbers.len() - before;
            let is_like_others = if more == 0 {
                numbers.is_empty()
            } else {
                texts.is_empty() && *width.get_or_insert(more) == more
            };
            if !is_like_others {
                let fault = Fault::Syntax {
                    expected: "entries of one type",
                    found: "one of another".to_owned(),
                };
                return Err(self.lexer.wrong(fault));
            }
        }
        Ok(match texts.is_empty() {
            false => Value::Texts(texts.into()),
            true => Value::Numbers { width: width.unwrap_or(1), values: numbers.into() },
        })
    }

    /// A dictionary after its `{`.
    pub fn dictionary(&mut self, level: usize) -> Result<Value, Wrong> {
        if level >= MAX_VALUE_LEVELS {
            return Err(self.lexer.wrong(Fault::DeepValue(MAX_VALUE_LEVELS)));
        }
        let mut entries = Vec::new();
        loop {
            let kind = match self.lexer.next()? {
                Token::Mark('}') => return Ok(Value::Dictionary(entries.into())),
                Token::Mark(';' | ',') => continue,
                Token::Name(kind) => kind,
                other => return Err(self.lexer.expected("a type or `}`", &other)),
            };
            let is_array = self.brackets()?;
            let key = match self.lexer.next()? {
                Token::Name(key) => self.name(key),
                Token::Text(key) => self.name(&key),
                other => return Err(self.lexer.expected("a name", &other)),
            };
            self.lexer.take('=', "`=`")?;
            let value = self.value(level + 1)?;
            entries.push((key, typed(kind, is_array, value)));
            self.lexer.ends()?;
        }
    }

    /// Whether `[]` is next, which is taken.
    pub fn brackets(&mut self) -> Result<bool, Wrong> {
        let is_array = self.lexer.takes('[')?;
        if is_array {
            self.lexer.take(']', "`]`")?;
        }
        Ok(is_array)
    }

    /// Values by time, of which the first is kept.
    pub fn samples(&mut self, kind: &str, is_array: bool) -> Result<Value, Wrong> {
        self.lexer.take('{', "`{`")?;
        let mut first = None;
        loop {
            let time = match self.lexer.next()? {
                Token::Mark('}') => break,
                Token::Mark(',') => continue,
                Token::Number(time) => time,
                other => return Err(self.lexer.expected("a time or `}`", &other)),
            };
            self.lexer.take(':', "`:`")?;
            let value = self.value(0)?;
            let is_first = first.as_ref().is_none_or(|(least, _)| time < *least);
            if is_first && value != Value::Blocked {
                first = Some((time, typed(kind, is_array, value)));
            }
        }
        Ok(first.map_or(Value::Blocked, |sample| Value::Samples(Arc::new(sample))))
    }
}

fn literal(name: &str) -> Option<Value> {
    match name {
        "true" | "True" | "yes" => Some(Value::Bool(true)),
        "false" | "False" | "no" => Some(Value::Bool(false)),
        "inf" => Some(Value::Number(f64::INFINITY)),
        "nan" => Some(Value::Number(f64::NAN)),
        _ => None,
    }
}

/// A value as one of a type: rounded to its precision, and an empty array of its entries.
pub fn typed(kind: &str, is_array: bool, value: Value) -> Value {
    let round: Option<fn(f64) -> f64> = match kind {
        "half" | "half2" | "half3" | "half4" => Some(to_half),
        "float" | "float2" | "float3" | "float4" => Some(single),
        _ if kind.starts_with("matrix") => None,
        // Names of types before 2016.
        _ if kind.ends_with("Float") || kind == "Color" => Some(single),
        _ if kind.ends_with(['f']) => Some(single),
        _ if kind.ends_with(['h']) => Some(to_half),
        _ => None,
    };
    let all = |values: Arc<[f64]>| match round {
        Some(round) => values.iter().map(|value| round(*value)).collect(),
        None => values,
    };
    match (kind, value) {
        ("asset", Value::Text(path)) => Value::Asset(path),
        ("bool", Value::Number(number)) => Value::Bool(number != 0.0),
        ("token" | "string" | "asset" | "pathExpression", Value::Numbers { values, .. })
            if values.is_empty() && is_array =>
        {
            Value::Texts(Arc::from([]))
        }
        (_, Value::Number(number)) => Value::Number(round.map_or(number, |round| round(number))),
        (_, Value::Tuple(values)) => Value::Tuple(all(values)),
        (_, Value::Numbers { width, values }) => {
            let width = if values.is_empty() { width_of(kind) } else { width };
            Value::Numbers { width, values: all(values) }
        }
        (_, other) => other,
    }
}

fn single(value: f64) -> f64 {
    f64::from(value as f32)
}

fn width_of(kind: &str) -> usize {
    match kind {
        "quath" | "quatf" | "quatd" => 4,
        "frame4d" => 16,
        _ => {
            let digit =
                kind.bytes().find(u8::is_ascii_digit).map_or(1, |byte| usize::from(byte - b'0'));
            let is_int64 = kind.ends_with("int64");
            match (kind.starts_with("matrix"), is_int64) {
                (true, _) => digit * digit,
                (_, true) => 1,
                _ => digit.clamp(1, 4),
            }
        }
    }
}

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
                    self.lexer.ends()?;
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
            self.lexer.ends()?;
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
