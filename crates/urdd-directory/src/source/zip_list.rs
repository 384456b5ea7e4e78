//! The list of a zip archive's entries, and that it is the only one that can be read from its bytes.
//!
//! A zip archive says twice what it holds: in the list at its end, and in a header before each entry. Programs differ in
//! which they believe, and in where they look for the list. So both have to agree here, and each byte has to belong to
//! one entry, to the list, or to the record at the end: what one program shows of an archive, every other shows too.

use crate::archive_fault::{ArchiveFault, EntryFault};

const END: &[u8] = b"PK\x05\x06";
const END_LENGTH: usize = 22;
const LOCATOR: &[u8] = b"PK\x06\x07";
const LOCATOR_LENGTH: usize = 20;
const LISTED: &[u8] = b"PK\x01\x02";
const LISTED_LENGTH: usize = 46;
const HEADER: &[u8] = b"PK\x03\x04";
const HEADER_LENGTH: usize = 30;
/// What may follow the bytes of an entry: its checksum and sizes, once they are known.
const LONGEST_DESCRIPTOR: usize = 24;

/// Bits of an entry's flags.
const ENCRYPTED: u16 = 1;
const HAS_DESCRIPTOR: u16 = 1 << 3;

/// Systems whose entries have a mode of Unix.
const UNIX: [u8; 2] = [3, 19];

/// An entry, as the list says it.
#[derive(Debug, Clone, Copy)]
pub struct Listed<'a> {
    /// Its name, of any bytes.
    pub name: &'a [u8],
    /// Whether it is encrypted.
    pub is_encrypted: bool,
    /// How it is compressed.
    pub method: u16,
    /// CRC-32 of its content.
    pub crc: u32,
    /// Size of its content, bytes.
    pub size: u64,
    /// Where its packed bytes begin.
    pub start: usize,
    /// Where they end.
    pub end: usize,
    /// The kind in its mode of Unix; 0 where it has none.
    pub kind: u32,
}

/// Every entry, in the order of the list.
///
/// # Errors
/// Where this is not one whole archive, or its list and its headers differ.
pub fn read(bytes: &[u8]) -> Result<Vec<Listed<'_>>, ArchiveFault> {
    let end = end(bytes)?;
    let record = Fields(&bytes[end..]);
    let (stated, size, start) = (record.short(10), record.word(12), record.word(16));
    if record.short(4) != 0 || record.short(6) != 0 || record.short(8) != stated {
        return Err(broken("it is one part of several"));
    }
    let (start, size) = (start as usize, size as usize);
    if start.checked_add(size) != Some(end) {
        return Err(ArchiveFault::OtherBytes);
    }
    let mut at = start;
    let mut entries = Vec::with_capacity(usize::from(stated));
    let mut places = Vec::with_capacity(usize::from(stated));
    while at < end {
        let Some(fields) = Fields::at(bytes, at, end, LISTED, LISTED_LENGTH) else {
            return Err(broken("its list of entries is cut off"));
        };
        let [name, extra, comment] = [28, 30, 32].map(|at| usize::from(fields.short(at)));
        let name_start = at + LISTED_LENGTH;
        at = name_start + name + extra + comment;
        if at > end {
            return Err(broken("its list of entries is cut off"));
        }
        let name = &bytes[name_start..name_start + name];
        let (entry, place) = entry(bytes, start, fields, name)?;
        entries.push(entry);
        places.push(place);
    }
    if entries.len() != usize::from(stated) {
        return Err(ArchiveFault::Count {
            stated: stated.into(),
            listed: entries.len(),
        });
    }
    without_gaps(places, start)?;
    Ok(entries)
}

/// Where the record at the end begins.
fn end(bytes: &[u8]) -> Result<usize, ArchiveFault> {
    let last = bytes.len().saturating_sub(END_LENGTH);
    let first = last.saturating_sub(u16::MAX.into());
    let mut found = memchr::memmem::rfind_iter(&bytes[first..], END).map(|at| first + at);
    let Some(end) = found.find(|end| *end <= last) else {
        return Err(broken("it has no record at its end"));
    };
    // Another reader takes the first one that it finds.
    let comment = usize::from(Fields(&bytes[end..]).short(20));
    if end + END_LENGTH + comment != bytes.len() || found.any(|other| is_end(bytes, other)) {
        return Err(ArchiveFault::OtherBytes);
    }
    let locator = end.checked_sub(LOCATOR_LENGTH);
    match locator.is_some_and(|at| bytes[at..].starts_with(LOCATOR)) {
        true => Err(ArchiveFault::Zip64),
        false => Ok(end),
    }
}

/// Whether a reader that looks from elsewhere may take this for the record at the end.
fn is_end(bytes: &[u8], at: usize) -> bool {
    let Some(record) = bytes.get(at..at + END_LENGTH) else {
        return false;
    };
    let record = Fields(record);
    let comment = usize::from(record.short(20));
    let (size, start) = (record.word(12) as usize, record.word(16) as usize);
    at + END_LENGTH + comment == bytes.len() || start.checked_add(size) == Some(at)
}

/// An entry, and its place with its own header: where it begins, where it ends, and whether something may follow.
fn entry<'a>(
    bytes: &[u8],
    list: usize,
    fields: Fields<'_>,
    name: &'a [u8],
) -> Result<(Listed<'a>, (usize, usize, bool)), ArchiveFault> {
    let fail = |fault| Err(entry_fault(name, fault));
    let (crc, packed, size) = (fields.word(16), fields.word(20), fields.word(24));
    let begin = fields.word(42) as usize;
    let Some(header) = Fields::at(bytes, begin, list, HEADER, HEADER_LENGTH) else {
        return fail(damaged("its own header is not where the list says"));
    };
    let [name_length, extra] = [26, 28].map(|at| usize::from(header.short(at)));
    let name_start = begin + HEADER_LENGTH;
    let start = name_start + name_length + extra;
    let end = start.saturating_add(packed as usize);
    if end > list {
        return fail(damaged("it lies beyond the archive's end"));
    }
    let flags = fields.short(8);
    let has_descriptor = header.short(6) & HAS_DESCRIPTOR != 0;
    // What is not known yet when the header is written is 0 there, or, where it may be large, all ones.
    let agrees = |at: usize, listed: u32| {
        let own = header.word(at);
        own == listed || (own == 0 && has_descriptor) || (own == u32::MAX && at != 14)
    };
    let is_same = bytes[name_start..name_start + name_length] == *name
        && header.short(8) == fields.short(10)
        && (header.short(6) ^ flags) & ENCRYPTED == 0
        && agrees(14, crc)
        && agrees(18, packed)
        && agrees(22, size);
    if !is_same {
        return fail(EntryFault::Header);
    }
    let has_mode = UNIX.contains(&fields.0[5]);
    let listed = Listed {
        name,
        is_encrypted: flags & ENCRYPTED != 0,
        method: fields.short(10),
        crc,
        size: size.into(),
        start,
        end,
        kind: if has_mode {
            (fields.word(38) >> 16) & 0o170_000
        } else {
            0
        },
    };
    Ok((listed, (begin, end, has_descriptor)))
}

/// Whether entries follow one another from the first byte to the list: what is between them, or before them, may be
/// another archive.
fn without_gaps(mut places: Vec<(usize, usize, bool)>, list: usize) -> Result<(), ArchiveFault> {
    places.sort_unstable();
    let mut at = 0;
    let mut room = 0;
    for (begin, end, has_descriptor) in places.into_iter().chain([(list, list, false)]) {
        if begin < at || begin - at > room {
            return Err(ArchiveFault::OtherBytes);
        }
        at = end;
        room = if has_descriptor {
            LONGEST_DESCRIPTOR
        } else {
            0
        };
    }
    Ok(())
}

fn broken(reason: &str) -> ArchiveFault {
    let reason = reason.to_owned();
    ArchiveFault::Broken { reason }
}

fn damaged(reason: &str) -> EntryFault {
    let reason = reason.to_owned();
    EntryFault::Damaged { reason }
}

/// What is wrong with an entry.
pub fn entry_fault(name: &[u8], fault: EntryFault) -> ArchiveFault {
    ArchiveFault::Entry {
        name: String::from_utf8_lossy(name).into_owned(),
        fault,
    }
}

/// A record of numbers of two and four bytes, the lowest first; long enough for what is asked of it.
#[derive(Clone, Copy)]
struct Fields<'a>(&'a [u8]);

impl<'a> Fields<'a> {
    /// The record of a kind that begins at a place and ends before `limit`.
    fn at(bytes: &'a [u8], at: usize, limit: usize, kind: &[u8], length: usize) -> Option<Self> {
        let record = bytes.get(..limit)?.get(at..at.checked_add(length)?)?;
        record.starts_with(kind).then_some(Fields(record))
    }

    fn short(self, at: usize) -> u16 {
        u16::from_le_bytes([self.0[at], self.0[at + 1]])
    }

    fn word(self, at: usize) -> u32 {
        u32::from(self.short(at)) | u32::from(self.short(at + 2)) << 16
    }
}
