//! Values of a crate file that hold others: dictionaries, lists that edit others, times.

use std::sync::Arc;

use super::cursor::Cursor;
use super::sections::Crate;
use crate::error::Wrong;
use crate::layer::{Item, ListOp, Name, Value};

/// Bytes of an entry in memory, with its place in a list.
const ENTRY: usize = 96;

/// Bits of what a list has.
const EXPLICIT: u8 = 1;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Entries {
    Tokens,
    Strings,
    Paths,
    References,
    Payloads,
    Ints,
    Longs,
}

impl<'b> Crate<'b> {
    /// A value that holds others.
    pub fn composite(
        &mut self,
        kind: u8,
        cursor: &mut Cursor<'b>,
        level: usize,
    ) -> Result<Value, Wrong> {
        let list = |items| Value::List(Arc::new(ListOp::explicit(items)));
        Ok(match kind {
            31 => self.dictionary(cursor, level)?,
            32 => self.list(Entries::Tokens, cursor, level)?,
            33 => self.list(Entries::Strings, cursor, level)?,
            34 => self.list(Entries::Paths, cursor, level)?,
            35 => self.list(Entries::References, cursor, level)?,
            36 | 38 => self.list(Entries::Ints, cursor, level)?,
            37 | 39 => self.list(Entries::Longs, cursor, level)?,
            55 => self.list(Entries::Payloads, cursor, level)?,
            40 => list(self.entries_of(Entries::Paths, cursor, level)?),
            41 => texts(&self.entries_of(Entries::Tokens, cursor, level)?),
            50 => texts(&self.entries_of(Entries::Strings, cursor, level)?),
            45 => self.selections(cursor)?,
            46 => self.samples(cursor, level)?,
            47 => list(vec![self.entry(Entries::Payloads, cursor, level)?]),
            48 => {
                let count = cursor.count(8)?;
                self.charge(cursor, 8 * count)?;
                let mut values = Vec::with_capacity(count);
                for _ in 0..count {
                    values.push(cursor.f64()?);
                }
                Value::Numbers { width: 1, values: values.into() }
            }
            51 => Value::Blocked,
            52 | 53 => self.nested(cursor, level)?,
            // Relocates: none of them are as if nothing was said.
            58 if cursor.count(8)? == 0 => Value::Dictionary(Arc::from([])),
            _ => unread(kind),
        })
    }

    /// A value elsewhere: how far away its eight bytes are. What follows is behind these.
    fn nested(&mut self, cursor: &mut Cursor<'b>, level: usize) -> Result<Value, Wrong> {
        self.seek(cursor)?;
        let rep = cursor.u64()?;
        self.value(rep, level + 1)
    }

    fn seek(&mut self, cursor: &mut Cursor<'b>) -> Result<(), Wrong> {
        let start = cursor.at as i64;
        let offset = cursor.i64()?;
        let target = start.checked_add(offset).and_then(|at| usize::try_from(at).ok());
        cursor.at = target.ok_or_else(|| cursor.damaged("a value is out of the file"))?;
        Ok(())
    }

    fn dictionary(&mut self, cursor: &mut Cursor<'b>, level: usize) -> Result<Value, Wrong> {
        let count = cursor.count(1)?;
        let mut entries = Vec::new();
        for _ in 0..count {
            self.charge(cursor, ENTRY)?;
            let key = cursor.u32()?;
            let key = self.string(cursor, key)?;
            entries.push((key, self.nested(cursor, level)?));
        }
        Ok(Value::Dictionary(entries.into()))
    }

    fn selections(&mut self, cursor: &mut Cursor<'b>) -> Result<Value, Wrong> {
        let count = cursor.count(8)?;
        self.charge(cursor, ENTRY * count)?;
        let mut entries = Vec::new();
        for _ in 0..count {
            let (key, value) = (cursor.u32()?, cursor.u32()?);
            entries.push((self.string(cursor, key)?, Value::Text(self.string(cursor, value)?)));
        }
        Ok(Value::Dictionary(entries.into()))
    }

    /// The first value by time.
    fn samples(&mut self, cursor: &mut Cursor<'b>, level: usize) -> Result<Value, Wrong> {
        self.seek(cursor)?;
        let times = cursor.u64()?;
        let times = self.value(times, level + 1)?;
        let first = times.numbers().and_then(|times| times.first()).copied();
        self.seek(cursor)?;
        let count = cursor.count(8)?;
        let Some(time) = first.filter(|_| count > 0) else { return Ok(Value::Blocked) };
        let rep = cursor.u64()?;
        match self.value(rep, level + 1)? {
            Value::Blocked => Ok(Value::Blocked),
            value => Ok(Value::Samples(Arc::new((time, value)))),
        }
    }

    fn list(&mut self, of: Entries, cursor: &mut Cursor<'b>, level: usize) -> Result<Value, Wrong> {
        let has = cursor.u8()?;
        let mut part = |bit: u8| match has >> bit & 1 {
            1 => self.entries_of(of, cursor, level),
            _ => Ok(Vec::new()),
        };
        let explicit = part(1)?;
        let (added, prepended, appended, deleted) = (part(2)?, part(5)?, part(6)?, part(3)?);
        let explicit = (has & EXPLICIT != 0).then_some(explicit);
        Ok(Value::List(Arc::new(ListOp { explicit, deleted, added, prepended, appended })))
    }

    fn entries_of(
        &mut self,
        of: Entries,
        cursor: &mut Cursor<'b>,
        level: usize,
    ) -> Result<Vec<Item>, Wrong> {
        let count = cursor.count(4)?;
        let mut all = Vec::new();
        for _ in 0..count {
            all.push(self.entry(of, cursor, level)?);
        }
        Ok(all)
    }

    fn entry(&mut self, of: Entries, cursor: &mut Cursor<'b>, level: usize) -> Result<Item, Wrong> {
        self.charge(cursor, ENTRY)?;
        Ok(match of {
            Entries::Ints => Item::Text(Arc::from(cursor.i32()?.to_string())),
            Entries::Longs => Item::Text(Arc::from(cursor.i64()?.to_string())),
            Entries::Tokens => Item::Text(cursor.u32().and_then(|at| self.token(cursor, at))?),
            Entries::Strings => Item::Text(cursor.u32().and_then(|at| self.string(cursor, at))?),
            Entries::Paths => Item::Path(cursor.u32().and_then(|at| self.path_text(cursor, at))?),
            Entries::References | Entries::Payloads => {
                let (asset, path) = (cursor.u32()?, cursor.u32()?);
                let asset = self.string(cursor, asset)?;
                let path = self.path_text(cursor, path)?;
                // A shift of time.
                if of == Entries::References || self.version >= 8 {
                    cursor.take(16)?;
                }
                if of == Entries::References {
                    self.dictionary(cursor, level + 1)?;
                }
                Item::Reference { asset, path }
            }
        })
    }
}

/// A value of a type that is not read.
pub fn unread(kind: u8) -> Value {
    Value::Unread(Arc::from(format!("type {kind} of crate files")))
}

fn texts(items: &[Item]) -> Value {
    let texts: Vec<Name> = items.iter().map(|item| item.text().clone()).collect();
    Value::Texts(texts.into())
}
