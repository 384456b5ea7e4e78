//! A URDD in a zip archive: at the archive's root, or in the folder at its top.
//!
//! An archive comes from anybody. Its bytes are held in memory; nothing is unpacked to disk. Sizes
//! are bounded by what the archive states, and every file is inflated once, piece by piece, when the
//! archive is opened, and found to be of that size and of the checksum that is stated. So whoever
//! reads it later reads it to the end.

use std::collections::{BTreeSet, HashSet};
use std::io::{self, Cursor, Read};
use std::path::Path;
use std::sync::Arc;

use flate2::Crc;
use flate2::bufread::DeflateDecoder;
use zip::{CompressionMethod, ZipArchive};

use super::tree::{Node, Tree};
use super::{OpenFile, Source};
use crate::directory::archive_fault::{ArchiveFault, EntryFault};
use crate::directory::layout::ROOT_METADATA;
use crate::directory::limits::{
    MAX_ARCHIVE_BYTES, MAX_DOCUMENT_BYTES, MAX_INFLATED_BYTES, MAX_INFLATION, SMALL_ARCHIVE_BYTES,
};
use crate::directory::listing::Listing;
use crate::directory::read_error::ReadError;
use crate::directory::regular;
use crate::format::registry::ModuleKind;

/// Longest target of a symbolic link, bytes.
const MAX_LINK_BYTES: u64 = 4096;

/// What macOS puts beside the files of an archive.
const MACOS_FOLDER: &str = "__MACOSX";

/// Whether a file is a zip archive, by its name or its first bytes.
pub fn is_archive(path: &Path) -> bool {
    let by_name = path
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("zip"));
    let begins = || {
        let mut start = [0; 4];
        regular::open(path).ok()?.read_exact(&mut start).ok()?;
        Some(matches!(&start, b"PK\x03\x04" | b"PK\x05\x06"))
    };
    path.is_file() && (by_name || begins().unwrap_or(false))
}

/// A URDD in a zip archive.
#[derive(Debug)]
pub struct Archive {
    name: String,
    bytes: Arc<[u8]>,
    tree: Tree<Packed>,
}

/// Where the bytes of an entry lie in the archive, and what they are.
#[derive(Debug, Clone, Copy)]
struct Packed {
    start: usize,
    end: usize,
    is_deflated: bool,
    size: u64,
    crc: u32,
}

struct Member {
    path: String,
    utf8: bool,
    is_link: bool,
    node: Node<Packed>,
}

impl Archive {
    /// Reads an archive from disk.
    ///
    /// # Errors
    /// Where it cannot be read, or is not an archive of one URDD.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let from_io = |error: io::Error| ReadError::from_io(&error);
        let file = regular::open(path)?;
        let limit = MAX_ARCHIVE_BYTES;
        let mut bytes = Vec::new();
        file.take(limit + 1)
            .read_to_end(&mut bytes)
            .map_err(from_io)?;
        let size = bytes.len() as u64;
        if size > limit {
            return Err(ReadError::TooLarge { size, limit });
        }
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        Ok(Self::new(&name, bytes.into())?)
    }

    /// Of an archive's bytes. `name` is that of the root folder, where the URDD lies at the
    /// archive's root.
    ///
    /// # Errors
    /// Where it is not an archive of one URDD.
    pub fn new(name: &str, bytes: Arc<[u8]>) -> Result<Self, ArchiveFault> {
        let members = members(&bytes)?;
        let folder = urdd_folder(&members)?;
        let prefix = match folder.as_str() {
            "" => String::new(),
            folder => format!("{folder}/"),
        };
        let mut tree = Tree::default();
        for member in members {
            let Some(path) = member.path.strip_prefix(&prefix) else {
                continue;
            };
            if !tree.insert(path, member.node, member.utf8) {
                return Err(entry_fault(&member.path, EntryFault::Duplicate));
            }
        }
        let name = if folder.is_empty() { name } else { &folder };
        Ok(Archive {
            name: name.to_owned(),
            bytes,
            tree,
        })
    }
}

impl Source for Archive {
    fn folder_name(&self) -> String {
        self.name.clone()
    }

    fn list(&self) -> Result<Listing, ReadError> {
        Ok(self.tree.listing())
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        let (packed, size) = self.tree.file(path)?;
        Ok((Box::new(inflate(&self.bytes, packed)), size))
    }
}

fn entry_fault(name: &str, fault: EntryFault) -> ArchiveFault {
    ArchiveFault::Entry {
        name: name.to_owned(),
        fault,
    }
}

/// All entries, each of which can be read.
fn members(bytes: &Arc<[u8]>) -> Result<Vec<Member>, ArchiveFault> {
    if is_zip64(bytes) {
        return Err(ArchiveFault::Zip64);
    }
    let broken = |error: zip::result::ZipError| ArchiveFault::Broken {
        reason: error.to_string(),
    };
    let mut zip = ZipArchive::new(Cursor::new(Arc::clone(bytes))).map_err(broken)?;
    check_names(bytes, zip.central_directory_start(), zip.len())?;
    let limit = MAX_INFLATED_BYTES.min(SMALL_ARCHIVE_BYTES + MAX_INFLATION * bytes.len() as u64);
    let mut members = Vec::with_capacity(zip.len());
    for idx in 0..zip.len() {
        let entry = zip.by_index_raw(idx).map_err(broken)?;
        members.push(member(&entry, bytes.len())?);
    }
    // Nothing is inflated before it is known how much there is.
    let sizes = members.iter().map(|member| match member.node {
        Node::File { size, .. } => size,
        _ => 0,
    });
    let size = sizes.sum();
    if size > limit {
        return Err(ArchiveFault::Inflates { size, limit });
    }
    for member in &mut members {
        if let Node::File { data, .. } = &member.node {
            let mut file = inflate(bytes, data);
            let mut target = Vec::new();
            let read = match member.is_link {
                true => file.read_to_end(&mut target).map(|_| ()),
                false => io::copy(&mut file, &mut io::sink()).map(|_| ()),
            };
            read.map_err(|error| {
                let reason = error.to_string();
                entry_fault(&member.path, EntryFault::Damaged { reason })
            })?;
            if member.is_link {
                member.node = Node::Link(String::from_utf8_lossy(&target).into_owned());
            }
        }
    }
    Ok(members)
}

/// Whether there is a zip64 record where a reader would look for it. Such an archive may state any
/// number of entries, for which a reader sets memory aside.
fn is_zip64(bytes: &[u8]) -> bool {
    const END: &[u8] = b"PK\x05\x06";
    const LOCATOR: &[u8] = b"PK\x06\x07";
    const LOCATOR_LENGTH: usize = 20;
    let mut ends = memchr::memmem::find_iter(bytes, END);
    ends.any(|end| {
        end.checked_sub(LOCATOR_LENGTH)
            .is_some_and(|at| bytes[at..].starts_with(LOCATOR))
    })
}

/// Counts the entries that are listed and compares their names: of two with one name, the library
/// keeps one.
fn check_names(bytes: &[u8], start: u64, stated: usize) -> Result<(), ArchiveFault> {
    const ENTRY: &[u8] = b"PK\x01\x02";
    const LENGTH: usize = 46;
    let mut at = usize::try_from(start).unwrap_or(usize::MAX);
    let mut names = HashSet::new();
    let mut listed = 0;
    while let Some(header) = bytes.get(at..at.saturating_add(LENGTH))
        && header.starts_with(ENTRY)
    {
        let length = |at: usize| usize::from(u16::from_le_bytes([header[at], header[at + 1]]));
        let (name, extra, comment) = (length(28), length(30), length(32));
        let name_start = at + LENGTH;
        let Some(raw) = bytes.get(name_start..name_start + name) else {
            break;
        };
        if !names.insert(raw) {
            let name = String::from_utf8_lossy(raw);
            return Err(entry_fault(&name, EntryFault::Duplicate));
        }
        listed += 1;
        at = name_start + name + extra + comment;
    }
    match listed == stated {
        true => Ok(()),
        false => Err(ArchiveFault::Count { stated, listed }),
    }
}

/// An entry, held to what can be known without inflating it.
fn member(
    entry: &zip::read::ZipFile<'_, Cursor<Arc<[u8]>>>,
    archive: usize,
) -> Result<Member, ArchiveFault> {
    let raw = entry.name_raw();
    let utf8 = std::str::from_utf8(raw).is_ok();
    let name = String::from_utf8_lossy(raw).into_owned();
    let fail = |fault| Err(entry_fault(&name, fault));
    let path = name.strip_suffix('/').unwrap_or(&name);
    if !is_inside(path) {
        return fail(EntryFault::Path);
    }
    let path = path.to_owned();
    if entry.encrypted() {
        return fail(EntryFault::Encrypted);
    }
    const KIND: u32 = 0o170_000;
    let kind = entry.unix_mode().map_or(0, |mode| mode & KIND);
    let is_link = kind == 0o120_000;
    let node = match kind {
        _ if name.ends_with('/') => Node::Folder,
        0o040_000 => Node::Folder,
        0 | 0o100_000 | 0o120_000 => {
            let (size, packed) = (entry.size(), entry.compressed_size());
            let limit = if is_link {
                MAX_LINK_BYTES
            } else {
                MAX_DOCUMENT_BYTES
            };
            if size > limit {
                return fail(EntryFault::TooLarge { size, limit });
            }
            let is_deflated = match entry.compression() {
                CompressionMethod::Stored => false,
                CompressionMethod::Deflated => true,
                other => {
                    let method = other.to_string();
                    return fail(EntryFault::Method { method });
                }
            };
            let place = entry.data_start().and_then(|start| {
                let end = usize::try_from(start.checked_add(packed)?).ok()?;
                Some((usize::try_from(start).ok()?, end))
            });
            let Some((start, end)) = place.filter(|(_, end)| *end <= archive) else {
                let reason = "it lies beyond the archive's end".to_owned();
                return fail(EntryFault::Damaged { reason });
            };
            let crc = entry.crc32();
            let data = Packed {
                start,
                end,
                is_deflated,
                size,
                crc,
            };
            Node::File { size, data }
        }
        _ => Node::Other,
    };
    Ok(Member {
        path,
        utf8,
        is_link,
        node,
    })
}

/// Whether a name is a path that stays in the archive, wherever it is unpacked. What else SPEC 2.8
/// forbids is for rules to report, as of a folder.
fn is_inside(path: &str) -> bool {
    let mut parts = path.split('/');
    let is_drive = matches!(path.as_bytes(), [drive, b':', ..] if drive.is_ascii_alphabetic());
    !is_drive && !path.contains(['\\', '\0']) && parts.all(|part| !matches!(part, "" | "." | ".."))
}

/// The folder of the archive that is the URDD's root; "" for the archive itself.
fn urdd_folder(members: &[Member]) -> Result<String, ArchiveFault> {
    let is_urdd = |prefix: &str| {
        members.iter().any(|member| {
            let path = member.path.strip_prefix(prefix).unwrap_or_default();
            let is_module = |kind: &ModuleKind| {
                path.strip_prefix(kind.folder())
                    .is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
            };
            path == ROOT_METADATA || ModuleKind::ALL.iter().any(is_module)
        })
    };
    if is_urdd("") {
        return Ok(String::new());
    }
    let tops: BTreeSet<&str> = members
        .iter()
        .filter_map(|member| member.path.split_once('/'))
        .map(|(top, _)| top)
        .filter(|top| *top != MACOS_FOLDER)
        .collect();
    let mut found = tops.into_iter().filter(|top| is_urdd(&format!("{top}/")));
    match (found.next(), found.next()) {
        (None, _) => Err(ArchiveFault::NoUrdd),
        (Some(only), None) => Ok(only.to_owned()),
        (Some(first), Some(second)) => Err(ArchiveFault::ManyUrdds {
            first: first.to_owned(),
            second: second.to_owned(),
        }),
    }
}

/// The bytes of an entry as they are packed.
struct Slice {
    bytes: Arc<[u8]>,
    start: usize,
    end: usize,
}

impl AsRef<[u8]> for Slice {
    fn as_ref(&self) -> &[u8] {
        self.bytes.get(self.start..self.end).unwrap_or_default()
    }
}

fn inflate(bytes: &Arc<[u8]>, packed: &Packed) -> Checked {
    let slice = Cursor::new(Slice {
        bytes: Arc::clone(bytes),
        start: packed.start,
        end: packed.end,
    });
    let inner: OpenFile = match packed.is_deflated {
        true => Box::new(DeflateDecoder::new(slice)),
        false => Box::new(slice),
    };
    Checked {
        inner,
        left: packed.size,
        crc: Crc::new(),
        stated: packed.crc,
    }
}

/// Reads what the archive states, not a byte more or less.
struct Checked {
    inner: OpenFile,
    left: u64,
    crc: Crc,
    stated: u32,
}

impl Read for Checked {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let wrong = |words: &str| Err(io::Error::new(io::ErrorKind::InvalidData, words));
        let read = self.inner.read(buffer)?;
        if read == 0 && !buffer.is_empty() {
            return match (self.left, self.crc.sum() == self.stated) {
                (0, true) => Ok(0),
                (0, false) => wrong("its checksum is not the stated one"),
                _ => wrong("it is shorter than stated"),
            };
        }
        self.crc.update(&buffer[..read]);
        match self.left.checked_sub(read as u64) {
            Some(left) => self.left = left,
            None => return wrong("it is longer than stated"),
        }
        Ok(read)
    }
}
