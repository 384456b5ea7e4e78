//! A file as PyBullet reads it: in lines of at most 8,191 bytes.

use std::borrow::Cow;

const LONGEST: usize = 8191;

/// A file in lines. A longer one is broken, what follows a carriage return is lost, and a NUL ends a line.
pub(super) struct Lines<'a> {
    pub bytes: Cow<'a, [u8]>,
    /// Where each piece of a line begins in `bytes`, and in the file; none if nothing was changed.
    pieces: Vec<(usize, usize)>,
}

impl Lines<'_> {
    pub fn of(file: &[u8]) -> Lines<'_> {
        let is_plain = file.split(|&byte| byte == b'\n').all(|line| {
            let end = line.iter().position(|&byte| byte == b'\r').unwrap_or(line.len());
            line.len() <= LONGEST && !line.contains(&0) && end + 1 >= line.len()
        });
        if is_plain {
            return Lines { bytes: file.into(), pieces: Vec::new() };
        }
        let (mut bytes, mut pieces, mut start) = (Vec::with_capacity(file.len()), Vec::new(), 0);
        for line in file.split(|&byte| byte == b'\n' || byte == 0) {
            for piece in line.chunks(LONGEST) {
                pieces.push((bytes.len(), start));
                let end = piece.iter().position(|&byte| byte == b'\r').unwrap_or(piece.len());
                bytes.extend_from_slice(&piece[..end]);
                bytes.push(b'\n');
                start += piece.len();
            }
            start += 1;
        }
        Lines { bytes: bytes.into(), pieces }
    }

    /// The place in the file of a place in the lines.
    pub fn place(&self, at: usize) -> usize {
        let after = self.pieces.partition_point(|(begin, _)| *begin <= at);
        let piece = after.checked_sub(1).and_then(|index| self.pieces.get(index));
        piece.map_or(at, |(begin, start)| start + (at - begin))
    }
}
