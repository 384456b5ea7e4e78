//! Numbers in bytes.

use super::super::error::{Fault, Place, Wrong};

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

    /// The next bytes.
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

    pub fn u8(&mut self) -> Result<u8, Wrong> {
        Ok(self.array::<1>()?[0])
    }

    pub fn u16(&mut self) -> Result<u16, Wrong> {
        Ok(u16::from_le_bytes(self.array()?))
    }

    pub fn u32(&mut self) -> Result<u32, Wrong> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    pub fn i32(&mut self) -> Result<i32, Wrong> {
        Ok(i32::from_le_bytes(self.array()?))
    }

    pub fn u64(&mut self) -> Result<u64, Wrong> {
        Ok(u64::from_le_bytes(self.array()?))
    }

    pub fn i64(&mut self) -> Result<i64, Wrong> {
        Ok(i64::from_le_bytes(self.array()?))
    }

    pub fn f32(&mut self) -> Result<f64, Wrong> {
        Ok(f64::from(f32::from_le_bytes(self.array()?)))
    }

    pub fn f64(&mut self) -> Result<f64, Wrong> {
        Ok(f64::from_le_bytes(self.array()?))
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
