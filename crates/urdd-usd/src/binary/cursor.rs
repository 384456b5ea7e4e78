//! Numbers in bytes, and what is packed: LZ4, and lists of integers by their differences.
//!
//! LZ4 makes at most 255 bytes of one, so a size that a file declares is compared with that before anything is made.

use crate::error::{Fault, Place, Wrong};

/// Methods that read a number of the type that they are called by.
macro_rules! numbers {
    ($($number:ident)*) => {
        $(pub fn $number(&mut self) -> Result<$number, Wrong> {
            Ok($number::from_le_bytes(self.array()?))
        })*
    };
}

/// A place in bytes, from which they are read. All numbers are little-endian.
#[derive(Debug, Clone, Copy)]
pub struct Cursor<'b> {
    pub bytes: &'b [u8],
    pub at: usize,
}

impl<'b> Cursor<'b> {
    pub fn new(bytes: &'b [u8], at: usize) -> Self {
        Cursor { bytes, at }
    }

    /// That the file is damaged here.
    pub fn damaged(&self, what: &'static str) -> Wrong {
        (Place::Byte(self.at as u64), Fault::Damaged(what))
    }

    pub fn take(&mut self, count: usize) -> Result<&'b [u8], Wrong> {
        let end = self.at.checked_add(count);
        let Some(taken) = end.and_then(|end| self.bytes.get(self.at..end)) else {
            return Err(self.damaged("it ends too early"));
        };
        self.at += count;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Wrong> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    numbers! { u8 u16 u32 i32 u64 i64 f64 }

    pub fn f32(&mut self) -> Result<f64, Wrong> {
        Ok(f64::from(f32::from_le_bytes(self.array()?)))
    }

    /// A number of bytes or entries, of which each has this many bytes after it.
    pub fn count(&mut self, bytes_of_each: usize) -> Result<usize, Wrong> {
        let before = *self;
        let count = usize::try_from(self.u64()?).ok();
        let left = self.bytes.len().saturating_sub(self.at);
        let fits = |count: &usize| count.checked_mul(bytes_of_each).is_some_and(|all| all <= left);
        count.filter(fits).ok_or_else(|| before.damaged("a count is larger than the file"))
    }
}

/// The most that LZ4 makes of one byte, bytes.
const MAX_LZ4: usize = 255;
/// What is added to that, bytes: the last literals.
const LZ4_REST: usize = 64;

/// The largest size that is unpacked of some bytes.
fn most(packed: usize) -> usize {
    packed.saturating_mul(MAX_LZ4).saturating_add(LZ4_REST)
}

/// Unpacks bytes of which at most `size` come.
///
/// The first byte is the number of chunks, 0 if there is one without a size.
pub fn unpacked(cursor: &mut Cursor<'_>, packed: usize, size: usize) -> Result<Vec<u8>, Wrong> {
    let before = *cursor;
    let taken = cursor.take(packed)?;
    let fault = || before.damaged("packed data do not unpack");
    let (chunks, mut rest) = taken.split_first().ok_or_else(fault)?;
    if size > most(packed) {
        return Err(fault());
    }
    let mut all = vec![0; size];
    if *chunks == 0 {
        let length = lz4_flex::block::decompress_into(rest, &mut all).map_err(|_| fault())?;
        all.truncate(length);
        return Ok(all);
    }
    let mut end = 0;
    for _ in 0..*chunks {
        let (head, after) = rest.split_first_chunk::<4>().ok_or_else(fault)?;
        let length = usize::try_from(i32::from_le_bytes(*head)).map_err(|_| fault())?;
        let (chunk, after) = after.split_at_checked(length).ok_or_else(fault)?;
        end += lz4_flex::block::decompress_into(chunk, &mut all[end..]).map_err(|_| fault())?;
        rest = after;
    }
    all.truncate(end);
    Ok(all)
}

/// A list of `count` integers of 4 or 8 bytes, packed.
///
/// After the commonest difference come two bits for each integer, and then the differences that these bits say: the
/// commonest, or one of 1, 2 or 4 bytes (2, 4 or 8).
pub fn integers(cursor: &mut Cursor<'_>, count: usize, is_long: bool) -> Result<Vec<i64>, Wrong> {
    let before = *cursor;
    let fault = || before.damaged("a list of integers does not unpack");
    let packed = cursor.count(1)?;
    if count == 0 {
        cursor.take(packed)?;
        return Ok(Vec::new());
    }
    let width = if is_long { 8 } else { 4 };
    let codes = count.div_ceil(4);
    // Each integer has two bits at least.
    if codes > most(packed) {
        return Err(fault());
    }
    let largest = count.checked_mul(width).and_then(|all| all.checked_add(codes + width));
    let size = largest.ok_or_else(fault)?.min(most(packed));
    let bytes = unpacked(cursor, packed, size)?;
    let mut head = Cursor::new(&bytes, 0);
    let next = |width: usize, cursor: &mut Cursor<'_>| {
        let value = match width {
            1 => cursor.u8().map(|value| i64::from(value as i8)),
            2 => cursor.u16().map(|value| i64::from(value as i16)),
            4 => cursor.i32().map(i64::from),
            _ => cursor.i64(),
        };
        value.map_err(|_| fault())
    };
    let common = next(width, &mut head)?;
    let codes = head.take(codes).map_err(|_| fault())?;
    let mut all = Vec::with_capacity(count);
    let mut last = 0_i64;
    for at in 0..count {
        let difference = match codes[at / 4] >> (2 * (at % 4)) & 3 {
            0 => common,
            code => next(width >> (3 - code), &mut head)?,
        };
        last = last.wrapping_add(difference);
        if !is_long {
            last = i64::from(last as i32);
        }
        all.push(last);
    }
    Ok(all)
}
