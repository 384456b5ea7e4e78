//! Packs a URDD as a zip archive (SPEC 2.14).

use std::io::{self, Write};
use std::path::Path;

use flate2::write::DeflateEncoder;
use flate2::{Compression, Crc};
use serde::Deserialize;

use crate::data::URDD;
use crate::tree::{Node, Tree, TreeError, make_folder, write_file};

/// Where in its archive a URDD is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Packed {
    /// At the archive's root.
    AtRoot,
    /// In a folder at the archive's top.
    InFolder,
}

/// Version 2.0 of the format, which has folders and deflated entries.
const VERSION: u16 = 20;
/// The same, by a program on Unix: attributes are a Unix mode.
const MADE_BY: u16 = 3 << 8 | VERSION;
/// Names are UTF-8.
const UTF8: u16 = 1 << 11;
const STORED: u16 = 0;
const DEFLATED: u16 = 8;
/// 1 January 1980.
const DATE: u16 = 1 << 5 | 1;

const FILE: u32 = 0o100_644;
const LINK: u32 = 0o120_777;
const FOLDER: u32 = 0o040_755;

/// Writes a URDD as a zip archive.
/// Fails if it cannot be written, or has too much for an archive without zip64.
pub fn write(tree: &Tree, packed: Packed, path: &Path) -> Result<(), TreeError> {
    if let Some(folder) = path.parent() {
        make_folder(folder)?;
    }
    let bytes = pack(tree, packed).map_err(|error| TreeError::Write(path.to_owned(), error))?;
    write_file(path, &bytes)
}

/// The bytes of the archive. An entry that deflating does not make smaller is stored.
fn pack(tree: &Tree, packed: Packed) -> io::Result<Vec<u8>> {
    let folder = match packed {
        Packed::AtRoot => String::new(),
        Packed::InFolder => format!("{URDD}/"),
    };
    let mut archive = Archive::default();
    for (path, node) in &tree.nodes {
        let name = [folder.as_bytes(), path.as_bytes()].concat();
        match node {
            Node::File(content) => archive.add(&name, FILE, content)?,
            Node::Link(target) => archive.add(&name, LINK, target.as_bytes())?,
            Node::Folder => archive.add(&[&name[..], b"/"].concat(), FOLDER, b"")?,
        }
    }
    archive.finish()
}

#[derive(Default)]
struct Archive {
    bytes: Vec<u8>,
    list: Vec<u8>,
    entries: usize,
}

impl Archive {
    fn add(&mut self, name: &[u8], mode: u32, content: &[u8]) -> io::Result<()> {
        let mut crc = Crc::new();
        crc.update(content);
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(content)?;
        let deflated = encoder.finish()?;
        let (method, data) = match deflated.len() < content.len() {
            true => (DEFLATED, &deflated[..]),
            false => (STORED, content),
        };
        // What both headers of an entry say, without an extra field.
        let mut both = shorts(&[VERSION, UTF8, method, 0, DATE]);
        both.extend(words(&[crc.sum(), word(data.len())?, word(content.len())?]));
        both.extend(shorts(&[short(name.len())?, 0]));
        let start = word(self.bytes.len())?;
        self.bytes.extend([b"PK\x03\x04", &both[..], name, data].concat());
        // Without a comment, on the first disk, without internal attributes.
        let places = [shorts(&[0, 0, 0]), words(&[mode << 16, start])].concat();
        let listed = [b"PK\x01\x02", &shorts(&[MADE_BY])[..], &both, &places, name].concat();
        self.list.extend(listed);
        self.entries += 1;
        Ok(())
    }

    fn finish(mut self) -> io::Result<Vec<u8>> {
        let (start, entries) = (word(self.bytes.len())?, short(self.entries)?);
        self.bytes.extend(&self.list);
        self.bytes.extend(b"PK\x05\x06");
        self.bytes.extend(shorts(&[0, 0, entries, entries]));
        self.bytes.extend(words(&[word(self.list.len())?, start]));
        self.bytes.extend(shorts(&[0]));
        Ok(self.bytes)
    }
}

fn shorts(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn words(values: &[u32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn short(value: usize) -> io::Result<u16> {
    u16::try_from(value).map_err(io::Error::other)
}

fn word(value: usize) -> io::Result<u32> {
    u32::try_from(value).map_err(io::Error::other)
}
