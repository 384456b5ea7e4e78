//! Reads the central directory of a zip archive, and verifies that no other listing can be read from its bytes.
//!
//! A zip archive describes its entries twice: in the central directory at its end, and in a local header before each
//! entry. Programs differ in which one they use, and in where they look for the directory. So both must agree, and each
//! byte must belong to one entry, the directory, or the end record. Then every program extracts the same files.

use crate::listing::{ArchiveFault, EntryFault};

const END: &[u8] = b"PK\x05\x06";
const END_LENGTH: usize = 22;
const LOCATOR: &[u8] = b"PK\x06\x07";
const LOCATOR_LENGTH: usize = 20;
const LISTED: &[u8] = b"PK\x01\x02";
const LISTED_LENGTH: usize = 46;
const HEADER: &[u8] = b"PK\x03\x04";
const HEADER_LENGTH: usize = 30;
/// The signature that most programs write before a data descriptor.
const DESCRIPTOR: &[u8] = b"PK\x07\x08";

const SPLIT: &str = "it is one part of a split archive";

/// Bits of an entry's flags.
const ENCRYPTED: u16 = 1;
const HAS_DESCRIPTOR: u16 = 1 << 3;

/// Host systems whose entries have a Unix mode.
const UNIX: [u8; 2] = [3, 19];
/// Host systems of Microsoft: MS-DOS and NTFS.
const MICROSOFT: [u8; 2] = [0, 10];

/// An entry of the central directory.
#[derive(Debug, Clone, Copy)]
pub struct Listed<'a> {
    /// Its name, as arbitrary bytes.
    pub name: &'a [u8],
    pub is_encrypted: bool,
    /// Whether a program of Windows may have written it.
    pub is_of_windows: bool,
    /// Whether its own header leaves its sizes to an extra field of zip64.
    pub is_zip64: bool,
    /// The file type bits of its Unix mode; 0 if it has none.
    pub kind: u32,
    pub packed: Packed,
}

/// Location and properties of an entry's packed bytes.
#[derive(Debug, Clone, Copy)]
pub struct Packed {
    pub method: u16,
    /// CRC-32 of the content.
    pub crc: u32,
    /// Size of the content, bytes.
    pub size: u64,
    /// Start of the packed bytes.
    pub start: usize,
    /// End of the packed bytes.
    pub end: usize,
}

/// What an entry and its local header occupy.
struct Place {
    begin: usize,
    end: usize,
    /// Checksum and both sizes, where a data descriptor with them may follow.
    descriptor: Option<[u32; 3]>,
}

/// Every entry, in the order of the central directory.
///
/// # Errors
/// If this is not one complete archive, or the directory and the local headers differ.
pub fn read(bytes: &[u8]) -> Result<Vec<Listed<'_>>, ArchiveFault> {
    let end = end(bytes)?;
    let record = Fields(&bytes[end..]);
    let (stated, size, start) = (record.short(10), record.word(12), record.word(16));
    if record.short(4) != 0 || record.short(6) != 0 || record.short(8) != stated {
        return Err(broken(SPLIT));
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
        return Err(ArchiveFault::Count { stated: stated.into(), listed: entries.len() });
    }
    without_gaps(bytes, places, start)?;
    Ok(entries)
}

/// Offset of the end record.
fn end(bytes: &[u8]) -> Result<usize, ArchiveFault> {
    let Some(last) = bytes.len().checked_sub(END_LENGTH) else {
        return Err(broken("its end record is missing"));
    };
    let first = last.saturating_sub(u16::MAX.into());
    let mut found = memchr::memmem::rfind_iter(&bytes[first..], END).map(|at| first + at);
    let Some(end) = found.find(|end| *end <= last) else {
        return Err(broken("its end record is missing"));
    };
    // Other readers take the first end record that they find.
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

/// Whether another reader may take this for the end record.
fn is_end(bytes: &[u8], at: usize) -> bool {
    let Some(record) = bytes.get(at..at + END_LENGTH) else {
        return false;
    };
    let record = Fields(record);
    let comment = usize::from(record.short(20));
    let (size, start) = (record.word(12) as usize, record.word(16) as usize);
    at + END_LENGTH + comment == bytes.len() || start.checked_add(size) == Some(at)
}

/// An entry, and what it occupies with its local header.
fn entry<'a>(
    bytes: &[u8],
    list: usize,
    fields: Fields<'_>,
    name: &'a [u8],
) -> Result<(Listed<'a>, Place), ArchiveFault> {
    let fail = |fault| Err(entry_fault(name, fault));
    let (crc, packed, size) = (fields.word(16), fields.word(20), fields.word(24));
    if fields.short(34) != 0 {
        return Err(broken(SPLIT));
    }
    let begin = fields.word(42) as usize;
    let Some(header) = Fields::at(bytes, begin, list, HEADER, HEADER_LENGTH) else {
        return fail(damaged("its own header is not where the list says"));
    };
    let [name_length, extra] = [26, 28].map(|at| usize::from(header.short(at)));
    let name_start = begin + HEADER_LENGTH;
    let start = name_start + name_length + extra;
    let end = start.saturating_add(packed as usize);
    if end > list {
        return fail(damaged("it extends beyond the archive's end"));
    }
    let flags = fields.short(8);
    let has_descriptor = header.short(6) & HAS_DESCRIPTOR != 0;
    // A local header written before the value is known has 0, or all ones for large sizes.
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
        is_of_windows: MICROSOFT.contains(&fields.0[5]),
        is_zip64: [18, 22].iter().any(|at| header.word(*at) == u32::MAX),
        kind: if has_mode { (fields.word(38) >> 16) & 0o170_000 } else { 0 },
        packed: Packed { method: fields.short(10), crc, size: size.into(), start, end },
    };
    let descriptor = has_descriptor.then_some([crc, packed, size]);
    Ok((listed, Place { begin, end, descriptor }))
}

/// Whether entries are contiguous from the first byte to the central directory, apart from data descriptors. Other bytes
/// may contain another archive.
fn without_gaps(bytes: &[u8], mut places: Vec<Place>, list: usize) -> Result<(), ArchiveFault> {
    places.sort_unstable_by_key(|place| (place.begin, place.end));
    let mut at = 0;
    let mut descriptor = None;
    for place in places.into_iter().chain([Place { begin: list, end: list, descriptor: None }]) {
        let between = bytes.get(at..place.begin).ok_or(ArchiveFault::OtherBytes)?;
        let is_descriptor = || descriptor.is_some_and(|values| describes(between, values));
        if !between.is_empty() && !is_descriptor() {
            return Err(ArchiveFault::OtherBytes);
        }
        (at, descriptor) = (place.end, place.descriptor);
    }
    Ok(())
}

/// Whether these bytes are a data descriptor with this checksum and these sizes, which are of 32 or 64 bits.
fn describes(bytes: &[u8], [crc, packed, size]: [u32; 3]) -> bool {
    let narrow = [crc, packed, size].map(u32::to_le_bytes).concat();
    let wide = [packed, size].map(|size| u64::from(size).to_le_bytes()).concat();
    let wide = [&crc.to_le_bytes()[..], &wide].concat();
    let unsigned = bytes.strip_prefix(DESCRIPTOR).unwrap_or(bytes);
    // A checksum may equal the signature.
    [bytes, unsigned].iter().any(|bytes| *bytes == narrow || *bytes == wide)
}

fn broken(reason: &str) -> ArchiveFault {
    let reason = reason.to_owned();
    ArchiveFault::Broken { reason }
}

fn damaged(reason: &str) -> EntryFault {
    let reason = reason.to_owned();
    EntryFault::Damaged { reason }
}

pub fn entry_fault(name: &[u8], fault: EntryFault) -> ArchiveFault {
    ArchiveFault::Entry { name: String::from_utf8_lossy(name).into_owned(), fault }
}

/// A record of little-endian fields of two and four bytes. The caller has checked its length.
#[derive(Clone, Copy)]
struct Fields<'a>(&'a [u8]);

impl<'a> Fields<'a> {
    /// The record with this signature at an offset, if it ends before `limit`.
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
