//! Values of a crate file: eight bytes say the type, and the value or where it is.

use std::sync::Arc;

use super::cursor::Cursor;
use super::lists::unread;
use super::sections::Crate;
use crate::error::{Fault, Place, Wrong};
use crate::layer::{MAX_VALUE_LEVELS, Name, Value, from_half};

/// Arrays of fewer numbers are not packed.
const MIN_PACKED: usize = 16;

/// How one number is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scalar {
    U8,
    I32,
    U32,
    I64,
    U64,
    Half,
    Single,
    Double,
}

use Scalar::*;

/// The numbers of a type: how each is written, and how many there are.
const fn numbers_of(kind: u8) -> Option<(Scalar, usize)> {
    Some(match kind {
        1 | 2 => (U8, 1),
        3 => (I32, 1),
        4 => (U32, 1),
        5 => (I64, 1),
        6 => (U64, 1),
        7 => (Half, 1),
        8 => (Single, 1),
        9 | 56 => (Double, 1),
        14 => (Double, 9),
        15 => (Double, 16),
        13 | 16 => (Double, 4),
        17 => (Single, 4),
        18 => (Half, 4),
        19 | 23 | 27 => (Double, 2 + (kind as usize - 19) / 4),
        20 | 24 | 28 => (Single, 2 + (kind as usize - 20) / 4),
        21 | 25 | 29 => (Half, 2 + (kind as usize - 21) / 4),
        22 | 26 | 30 => (I32, 2 + (kind as usize - 22) / 4),
        _ => return None,
    })
}

impl Scalar {
    fn bytes(self) -> usize {
        match self {
            U8 => 1,
            Half => 2,
            I32 | U32 | Single => 4,
            I64 | U64 | Double => 8,
        }
    }

    fn read(self, cursor: &mut Cursor<'_>) -> Result<f64, Wrong> {
        Ok(match self {
            U8 => f64::from(cursor.u8()?),
            I32 => f64::from(cursor.i32()?),
            U32 => f64::from(cursor.u32()?),
            I64 => cursor.i64()? as f64,
            U64 => cursor.u64()? as f64,
            Half => from_half(cursor.u16()?),
            Single => cursor.f32()?,
            Double => cursor.f64()?,
        })
    }
}

/// What eight bytes say of a value.
struct Rep {
    kind: u8,
    is_array: bool,
    is_inlined: bool,
    is_packed: bool,
    payload: u64,
}

impl Rep {
    fn of(rep: u64) -> Self {
        Rep {
            kind: (rep >> 48) as u8,
            is_array: rep >> 63 & 1 == 1,
            is_inlined: rep >> 62 & 1 == 1,
            is_packed: rep >> 61 & 1 == 1,
            payload: rep & ((1 << 48) - 1),
        }
    }
}

impl<'b> Crate<'b> {
    /// A value by its eight bytes. It is read once.
    pub fn value(&mut self, rep: u64, level: usize) -> Result<Value, Wrong> {
        if let Some(known) = self.known.get(&rep) {
            return Ok(known.clone());
        }
        if level > MAX_VALUE_LEVELS {
            return Err((Place::Layer, Fault::DeepValue(MAX_VALUE_LEVELS)));
        }
        let of = Rep::of(rep);
        let value = if of.is_inlined {
            self.inlined(&of)?
        } else if of.is_array {
            self.array(&of)?
        } else {
            let mut cursor = Cursor::new(self.bytes, of.payload as usize);
            self.written(of.kind, &mut cursor, level)?
        };
        let cursor = Cursor::new(self.bytes, of.payload as usize);
        self.charge(&cursor, 64)?;
        self.known.insert(rep, value.clone());
        Ok(value)
    }

    /// A value that is in the eight bytes.
    fn inlined(&self, of: &Rep) -> Result<Value, Wrong> {
        let bytes = (of.payload as u32).to_le_bytes();
        let mut cursor = Cursor::new(&bytes, 0);
        let index = of.payload as u32;
        Ok(match of.kind {
            1 => Value::Bool(bytes[0] != 0),
            10 => Value::Text(self.string(&cursor, index)?),
            11 => Value::Text(self.token(&cursor, index)?),
            12 => Value::Asset(self.token(&cursor, index)?),
            31 => Value::Dictionary(Arc::from([])),
            42 => Value::Text(Arc::from(
                ["def", "over", "class"].get(index as usize).copied().unwrap_or("over"),
            )),
            43 => Value::Text(Arc::from(if index == 0 { "public" } else { "private" })),
            44 => Value::Text(Arc::from(if index == 0 { "varying" } else { "uniform" })),
            51 => Value::Blocked,
            57 => Value::Text(self.string(&cursor, index)?),
            13..=15 => {
                let size = usize::from(of.kind) - 11;
                let mut all = vec![0.0; size * size];
                for row in 0..size {
                    all[row * size + row] = f64::from(bytes[row] as i8);
                }
                Value::Tuple(all.into())
            }
            19..=30 => {
                let width = numbers_of(of.kind).map_or(0, |(_, width)| width);
                Value::Tuple(bytes[..width].iter().map(|byte| f64::from(*byte as i8)).collect())
            }
            // Doubles are inlined as singles, long integers as short ones.
            5 => Value::Number(f64::from(cursor.i32()?)),
            6 => Value::Number(f64::from(index)),
            9 | 56 => Value::Number(cursor.f32()?),
            kind => match numbers_of(kind) {
                Some((scalar, 1)) => Value::Number(scalar.read(&mut cursor)?),
                _ => unread(kind),
            },
        })
    }

    /// An array, which is at a place.
    fn array(&mut self, of: &Rep) -> Result<Value, Wrong> {
        let numbers = numbers_of(of.kind);
        if of.payload == 0 {
            return Ok(match numbers {
                Some((_, width)) => Value::Numbers { width, values: Arc::from([]) },
                None => Value::Texts(Arc::from([])),
            });
        }
        let mut cursor = Cursor::new(self.bytes, of.payload as usize);
        if self.version < 5 {
            cursor.u32()?;
        }
        let count = if self.version < 7 { u64::from(cursor.u32()?) } else { cursor.u64()? };
        let count = usize::try_from(count).map_err(|_| cursor.damaged("an array is too long"))?;
        let Some((scalar, width)) = numbers else {
            return self.texts(of.kind, count, &mut cursor);
        };
        if of.is_packed && width == 1 && count >= MIN_PACKED {
            let values = self.packed(scalar, count, &mut cursor)?.into();
            return Ok(Value::Numbers { width, values });
        }
        let all = count.checked_mul(width * scalar.bytes());
        let taken = cursor.take(all.ok_or_else(|| cursor.damaged("an array is too long"))?)?;
        self.charge(&cursor, count * width * 8)?;
        let mut inside = Cursor::new(taken, 0);
        let mut values = Vec::with_capacity(count * width);
        for _ in 0..count * width {
            values.push(scalar.read(&mut inside)?);
        }
        if (16..=18).contains(&of.kind) {
            values.as_chunks_mut::<4>().0.iter_mut().for_each(|four| four.rotate_right(1));
        }
        Ok(Value::Numbers { width, values: values.into() })
    }

    fn packed(
        &mut self,
        scalar: Scalar,
        count: usize,
        cursor: &mut Cursor<'b>,
    ) -> Result<Vec<f64>, Wrong> {
        self.charge(cursor, count.saturating_mul(8))?;
        let as_numbers = |all: Vec<i64>| all.into_iter().map(|one| one as f64).collect();
        match scalar {
            I32 | U8 => Ok(as_numbers(self.integers(cursor, count, false)?)),
            U32 => {
                let all = self.integers(cursor, count, false)?;
                Ok(all.into_iter().map(|one| f64::from(one as u32)).collect())
            }
            I64 => Ok(as_numbers(self.integers(cursor, count, true)?)),
            U64 => {
                let all = self.integers(cursor, count, true)?;
                Ok(all.into_iter().map(|one| one as u64 as f64).collect())
            }
            Half | Single | Double => match cursor.u8()? {
                b'i' => Ok(as_numbers(self.integers(cursor, count, false)?)),
                b't' => {
                    let size = cursor.u32()? as usize;
                    let bytes = size.saturating_mul(scalar.bytes());
                    self.charge(cursor, bytes)?;
                    let mut table = Cursor::new(cursor.take(bytes)?, 0);
                    let table: Vec<f64> =
                        (0..size).map(|_| scalar.read(&mut table)).collect::<Result<_, _>>()?;
                    let indices = self.integers(cursor, count, false)?;
                    let value = |index: i64| table.get(usize::try_from(index).ok()?).copied();
                    let all = indices.into_iter().map(value).collect::<Option<_>>();
                    all.ok_or_else(|| cursor.damaged("a table of numbers is too short"))
                }
                _ => Err(cursor.damaged("an array is packed in an unknown way")),
            },
        }
    }

    fn texts(&mut self, kind: u8, count: usize, cursor: &mut Cursor<'b>) -> Result<Value, Wrong> {
        if !matches!(kind, 10..=12 | 57) {
            return Ok(unread(kind));
        }
        let mut inside = Cursor::new(cursor.take(count.saturating_mul(4))?, 0);
        self.charge(cursor, count * 16)?;
        let mut all: Vec<Name> = Vec::with_capacity(count);
        for _ in 0..count {
            let index = inside.u32()?;
            all.push(match kind {
                11 => self.token(cursor, index)?,
                _ => self.string(cursor, index)?,
            });
        }
        Ok(Value::Texts(all.into()))
    }

    /// A value that is at a place.
    fn written(&mut self, kind: u8, cursor: &mut Cursor<'b>, level: usize) -> Result<Value, Wrong> {
        if let Some((scalar, width)) = numbers_of(kind) {
            let mut values = Vec::with_capacity(width);
            for _ in 0..width {
                values.push(scalar.read(cursor)?);
            }
            if (16..=18).contains(&kind) {
                values.rotate_right(1);
            }
            self.charge(cursor, 8 * width)?;
            return Ok(match (kind, &values[..]) {
                (1, [one]) => Value::Bool(*one != 0.0),
                (_, [one]) => Value::Number(*one),
                _ => Value::Tuple(values.into()),
            });
        }
        self.composite(kind, cursor, level)
    }
}
