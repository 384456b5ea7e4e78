//! Packs a URDD as a zip archive (SPEC 2.14). For cases about archives, it says [`Oddities`] too.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::Path;

use flate2::write::DeflateEncoder;
use flate2::{Compression, Crc};
use serde::Deserialize;

use crate::data::URDD;
use crate::tree::{Base64, FilePath, Node, Tree, TreeError, make_folder, write_file};

/// Where in its archive a URDD is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Packed {
    /// At the archive's root.
    AtRoot,
    /// In a folder at the archive's top. Files beside the URDD are beside that folder.
    InFolder,
}

/// How an archive differs from what a program packs.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Oddities {
    /// By the names that the entries have in the archive.
    entries: BTreeMap<String, OddEntry>,
    /// Text before the first entry; offsets count it.
    before: String,
    /// Text between the last entry and the list.
    between: String,
    /// Text after the archive's end.
    after: String,
    comment: String,
    /// Whether no entry is deflated.
    stored: bool,
    /// Number of this part of a split archive; a whole one is part 0.
    part: u16,
    /// Whether the records of zip64 are before the end record.
    zip64: bool,
    /// Whether all bytes are there twice.
    twice: bool,
    /// Number of bytes that are missing at the end.
    cut: usize,
}

/// How an entry differs from what a program packs.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct OddEntry {
    /// What its own header and the list say.
    both: Said,
    /// What its own header alone says.
    header: Said,
    /// What the list alone says.
    list: Said,
    /// Its packed bytes, for another method, or encrypted.
    data_base64: Option<Base64>,
    /// Whether the list is without it.
    unlisted: bool,
    /// A data descriptor after it; its header says 0 for checksum and sizes.
    descriptor: Option<Descriptor>,
}

/// What a header says instead of the truth.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Said {
    name: Option<String>,
    flags: Option<u16>,
    method: Option<u16>,
    crc: Option<u32>,
    packed: Option<u32>,
    size: Option<u32>,
    /// The Unix mode. Only the list has it.
    mode: Option<u32>,
    /// The disk of a split archive. Only the list has it.
    disk: Option<u16>,
    /// The last change, as of MS-DOS.
    time: Option<u16>,
    extra_base64: Option<Base64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Descriptor {
    WithSignature,
    WithoutSignature,
}

/// Version 2.0 of the format, which has folders and deflated entries.
const VERSION: u16 = 20;
/// The same, by a program on Unix: attributes are a Unix mode.
const MADE_BY: u16 = 3 << 8 | VERSION;
/// Bits of an entry's flags: a data descriptor follows; names are UTF-8.
const DESCRIBED: u16 = 1 << 3;
const UTF8: u16 = 1 << 11;
const STORED: u16 = 0;
const DEFLATED: u16 = 8;
/// 1 January 1980.
const DATE: u16 = 1 << 5 | 1;

const FILE: u32 = 0o100_644;
const LINK: u32 = 0o120_777;
const FOLDER: u32 = 0o040_755;

/// Writes a URDD as a zip archive.
/// Fails if it cannot be written, has too much for an archive without zip64, or an odd entry is missing.
pub fn write(tree: &Tree, packed: Packed, odd: &Oddities, path: &Path) -> Result<(), TreeError> {
    let entries = entries(tree, packed);
    let is_there = |name: &&String| entries.iter().any(|entry| entry.name == name.as_bytes());
    if let Some(missing) = odd.entries.keys().find(|name| !is_there(name)) {
        return Err(TreeError::NoEntry(missing.clone()));
    }
    if let Some(folder) = path.parent() {
        make_folder(folder)?;
    }
    let bytes = pack(&entries, odd).map_err(|error| TreeError::Write(path.to_owned(), error))?;
    write_file(path, &bytes)
}

struct Entry<'a> {
    name: Vec<u8>,
    mode: u32,
    content: &'a [u8],
}

fn entries(tree: &Tree, packed: Packed) -> Vec<Entry<'_>> {
    let name = |path: &FilePath| match (packed, path.as_bytes().strip_prefix(b"../")) {
        (Packed::AtRoot, _) => path.as_bytes().to_vec(),
        (Packed::InFolder, Some(beside)) => beside.to_vec(),
        (Packed::InFolder, None) => [URDD.as_bytes(), b"/", path.as_bytes()].concat(),
    };
    let mut entries = Vec::new();
    for (path, node) in &tree.nodes {
        let name = name(path);
        entries.push(match node {
            Node::File(content) => Entry { name, mode: FILE, content: &content[..] },
            Node::Link(target) => Entry { name, mode: LINK, content: target.as_bytes() },
            Node::Folder => Entry { name: [&name[..], b"/"].concat(), mode: FOLDER, content: b"" },
        });
    }
    entries
}

/// The bytes of the archive. An entry that deflating does not make smaller is stored.
fn pack(entries: &[Entry<'_>], odd: &Oddities) -> io::Result<Vec<u8>> {
    let mut archive = Archive { bytes: odd.before.clone().into_bytes(), ..Archive::default() };
    let usual = OddEntry::default();
    for entry in entries {
        let name = std::str::from_utf8(&entry.name).unwrap_or_default();
        archive.add(entry, odd.entries.get(name).unwrap_or(&usual), !odd.stored)?;
    }
    archive.finish(odd)
}

/// What both headers of an entry say.
#[derive(Clone)]
struct Header {
    name: Vec<u8>,
    flags: u16,
    method: u16,
    crc: u32,
    packed: u32,
    size: u32,
    mode: u32,
    disk: u16,
    time: u16,
    extra: Vec<u8>,
}

impl Header {
    fn saying(mut self, said: &Said) -> Header {
        if let Some(name) = &said.name {
            self.name = name.clone().into_bytes();
        }
        if let Some(Base64(extra)) = &said.extra_base64 {
            self.extra.clone_from(extra);
        }
        self.flags = said.flags.unwrap_or(self.flags);
        self.method = said.method.unwrap_or(self.method);
        self.crc = said.crc.unwrap_or(self.crc);
        self.packed = said.packed.unwrap_or(self.packed);
        self.size = said.size.unwrap_or(self.size);
        self.mode = said.mode.unwrap_or(self.mode);
        self.disk = said.disk.unwrap_or(self.disk);
        self.time = said.time.unwrap_or(self.time);
        self
    }

    fn sizes(&self) -> Vec<u8> {
        words(&[self.crc, self.packed, self.size])
    }

    fn bytes(&self) -> io::Result<Vec<u8>> {
        let start = shorts(&[VERSION, self.flags, self.method, self.time, DATE]);
        let lengths = shorts(&[short(self.name.len())?, short(self.extra.len())?]);
        Ok([start, self.sizes(), lengths].concat())
    }
}

#[derive(Default)]
struct Archive {
    bytes: Vec<u8>,
    list: Vec<u8>,
    entries: usize,
}

impl Archive {
    fn add(&mut self, entry: &Entry<'_>, odd: &OddEntry, deflates: bool) -> io::Result<()> {
        let content = entry.content;
        let mut crc = Crc::new();
        crc.update(content);
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(content)?;
        let deflated = encoder.finish()?;
        let is_smaller = deflates && deflated.len() < content.len();
        let (method, data) = match (&odd.data_base64, is_smaller) {
            (Some(Base64(data)), _) => (STORED, &data[..]),
            (None, true) => (DEFLATED, &deflated[..]),
            (None, false) => (STORED, content),
        };
        let truth = Header {
            name: entry.name.clone(),
            flags: if odd.descriptor.is_some() { UTF8 | DESCRIBED } else { UTF8 },
            method,
            crc: crc.sum(),
            packed: word(data.len())?,
            size: word(content.len())?,
            mode: entry.mode,
            disk: 0,
            time: 0,
            extra: Vec::new(),
        };
        let listed = truth.clone().saying(&odd.both).saying(&odd.list);
        let own = match odd.descriptor {
            Some(_) => Header { crc: 0, packed: 0, size: 0, ..truth },
            None => truth,
        };
        let own = own.saying(&odd.both).saying(&odd.header);
        let start = word(self.bytes.len())?;
        self.bytes.extend([b"PK\x03\x04", &own.bytes()?[..], &own.name, &own.extra, data].concat());
        match odd.descriptor {
            Some(Descriptor::WithSignature) => {
                self.bytes.extend([b"PK\x07\x08", &listed.sizes()[..]].concat());
            }
            Some(Descriptor::WithoutSignature) => self.bytes.extend(listed.sizes()),
            None => {}
        }
        if odd.unlisted {
            return Ok(());
        }
        // Without a comment, and without internal attributes.
        let places = [shorts(&[0, listed.disk, 0]), words(&[listed.mode << 16, start])].concat();
        let start = [b"PK\x01\x02", &shorts(&[MADE_BY])[..], &listed.bytes()?[..]].concat();
        self.list.extend([start, places, listed.name, listed.extra].concat());
        self.entries += 1;
        Ok(())
    }

    fn finish(mut self, odd: &Oddities) -> io::Result<Vec<u8>> {
        self.bytes.extend(odd.between.as_bytes());
        let (start, length) = (word(self.bytes.len())?, word(self.list.len())?);
        let entries = short(self.entries)?;
        self.bytes.extend(&self.list);
        if odd.zip64 {
            let at = self.bytes.len() as u64;
            let counts = [entries.into(), entries.into(), length.into(), start.into()];
            let record =
                [&longs(&[44])[..], &shorts(&[MADE_BY, 45]), &words(&[0, 0]), &longs(&counts)];
            let locator = [&words(&[0])[..], &longs(&[at]), &words(&[1])];
            self.bytes.extend(
                [b"PK\x06\x06", &record.concat()[..], b"PK\x06\x07", &locator.concat()].concat(),
            );
        }
        self.bytes.extend(b"PK\x05\x06");
        self.bytes.extend(shorts(&[odd.part, 0, entries, entries]));
        self.bytes.extend(words(&[length, start]));
        self.bytes.extend(shorts(&[short(odd.comment.len())?]));
        self.bytes.extend([odd.comment.as_bytes(), odd.after.as_bytes()].concat());
        if odd.twice {
            self.bytes.extend_from_within(..);
        }
        self.bytes.truncate(self.bytes.len().saturating_sub(odd.cut));
        Ok(self.bytes)
    }
}

fn shorts(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn words(values: &[u32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn longs(values: &[u64]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn short(value: usize) -> io::Result<u16> {
    u16::try_from(value).map_err(io::Error::other)
}

fn word(value: usize) -> io::Result<u32> {
    u32::try_from(value).map_err(io::Error::other)
}
