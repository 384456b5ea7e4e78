//! A URDD in a zip archive: at the archive's root, or in a top-level folder.
//!
//! An archive is untrusted. Its bytes are in memory once, and shared; nothing is unpacked to disk. The stated sizes are
//! checked against limits first. Opening the archive inflates every file once, in chunks, and verifies its size and
//! checksum. So later reads cannot fail midway.

use std::collections::BTreeSet;
use std::fmt;
use std::io::{self, Cursor, Read};
use std::path::Path;
use std::str::Utf8Chunk;
use std::sync::Arc;

use flate2::Crc;
use flate2::bufread::DeflateDecoder;

use super::memory::{Item, Node, Tree};
use super::zip_list::{self, Listed, Packed, entry_fault};
use super::{OpenFile, Source};
use crate::file_type::ROOT_METADATA;
use crate::limits::{
    MAX_ARCHIVE_BYTES, MAX_DOCUMENT_BYTES, MAX_INFLATED_BYTES, MAX_INFLATION, MAX_NAME_BYTES,
    MAX_PART_BYTES, SMALL_ARCHIVE_BYTES,
};
use crate::listing::{ArchiveFault, EntryFault, Listing, ReadError};
use crate::regular;
use urdd_format::registry::ModuleKind;

/// Longest target of a symbolic link, bytes.
const MAX_LINK_BYTES: u64 = 4096;

/// Compression methods.
const STORED: u16 = 0;
const DEFLATED: u16 = 8;

/// Folder that macOS adds to archives.
const MACOS_FOLDER: &str = "__MACOSX";

/// The shared bytes of an archive.
#[derive(Clone)]
struct Bytes(Arc<dyn AsRef<[u8]> + Send + Sync>);

impl Bytes {
    fn all(&self) -> &[u8] {
        (*self.0).as_ref()
    }
}

impl fmt::Debug for Bytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes", self.all().len())
    }
}

/// A URDD in a zip archive.
#[derive(Debug)]
pub struct Archive {
    name: String,
    bytes: Bytes,
    tree: Tree<Packed>,
}

type Member = Item<Packed>;

impl Archive {
    /// Reads an archive from disk.
    ///
    /// # Errors
    /// If it cannot be read, or is not an archive of one URDD.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let file = regular::open(path)?;
        let size = file.metadata()?.len();
        let bytes = regular::read_sized(file, size, MAX_ARCHIVE_BYTES)?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        Ok(Self::new(&name, bytes)?)
    }

    /// Opens an archive from its bytes. `name` names the root folder if the URDD is at the archive's root.
    ///
    /// # Errors
    /// If it is not an archive of one URDD.
    pub fn new(
        name: &str,
        bytes: impl AsRef<[u8]> + Send + Sync + 'static,
    ) -> Result<Self, ArchiveFault> {
        let bytes = Bytes(Arc::new(bytes));
        if zip_list::read(bytes.all())?.iter().any(|entry| entry.is_zip64) {
            return Err(ArchiveFault::Zip64);
        }
        let mut members = members(&bytes, exact)?;
        let mut paths = BTreeSet::new();
        if let Some(member) = members.iter().find(|member| !paths.insert(&*member.path)) {
            return Err(entry_fault(member.path.as_bytes(), EntryFault::Duplicate));
        }
        let folder = urdd_folder(&members)?;
        if !folder.is_empty() {
            members.retain_mut(|member| match member.path.split_once('/') {
                Some((top, rest)) if top == folder => {
                    member.path = rest.to_owned();
                    true
                }
                _ => false,
            });
        }
        let name = if folder.is_empty() { name } else { &folder };
        Self::of(name, bytes, members)
    }

    /// Opens an archive of any files, from its bytes, whatever program packed it: names may have backslashes if it is of
    /// Windows, be in code page 437, and begin with `./`. `name` names the root folder.
    ///
    /// # Errors
    /// If it is no archive whose files can all be read.
    pub fn of_any(
        name: &str,
        bytes: impl AsRef<[u8]> + Send + Sync + 'static,
    ) -> Result<Self, ArchiveFault> {
        let bytes = Bytes(Arc::new(bytes));
        let mut members = members(&bytes, as_packed)?;
        members.retain(|member| !matches!(member.path.split('/').next(), Some("" | MACOS_FOLDER)));
        Self::of(name, bytes, members)
    }

    fn of(name: &str, bytes: Bytes, members: Vec<Member>) -> Result<Self, ArchiveFault> {
        let tree = Tree::new(members)
            .map_err(|path| entry_fault(path.as_bytes(), EntryFault::Duplicate))?;
        Ok(Archive { name: name.to_owned(), bytes, tree })
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

/// The name of an entry of a URDD. Two that are not UTF-8 stay two.
fn exact(entry: &Listed<'_>) -> String {
    let text = |chunk: Utf8Chunk<'_>| {
        let odd = chunk.invalid().iter().map(|byte| format!("\u{fffd}{byte:02X}"));
        chunk.valid().to_owned() + &odd.collect::<String>()
    };
    entry.name.utf8_chunks().map(text).collect()
}

/// The name of an entry, as the program meant it that packed it.
fn as_packed(entry: &Listed<'_>) -> String {
    let name = match std::str::from_utf8(entry.name) {
        Ok(name) => name.to_owned(),
        Err(_) => entry.name.iter().map(|byte| in_code_page_437(*byte)).collect(),
    };
    if entry.is_of_windows { name.replace('\\', "/") } else { name }
}

fn in_code_page_437(byte: u8) -> char {
    const UPPER: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜ¢£¥₧ƒáíóúñÑªº¿⌐¬½¼¡«»░▒▓│┤╡╢╖╕╣║╗╝╜╛┐└┴┬├─┼╞╟╚╔╩╦╠═╬╧╨╤╥╙╘╒╓╫╪┘┌█▄▌▐▀\
                         αßΓπΣσµτΦΘΩδ∞φε∩≡±≥≤⌠⌡÷≈°∙·√ⁿ²■\u{a0}";
    let upper = byte.checked_sub(0x80).and_then(|at| UPPER.chars().nth(at.into()));
    upper.unwrap_or(char::from(byte))
}

/// All entries, verified to be readable. `name_of` gives their names.
fn members(bytes: &Bytes, name_of: fn(&Listed<'_>) -> String) -> Result<Vec<Member>, ArchiveFault> {
    let all = bytes.all();
    let listed = zip_list::read(all)?;
    let limit = MAX_INFLATED_BYTES.min(SMALL_ARCHIVE_BYTES + MAX_INFLATION * all.len() as u64);
    let mut paths = Vec::with_capacity(listed.len());
    for entry in &listed {
        let path = check(entry, &name_of(entry));
        paths.push(path.map_err(|fault| entry_fault(entry.name, fault))?);
    }
    // Check the total size before inflating anything.
    let size = listed.iter().map(|entry| entry.packed.size).sum();
    if size > limit {
        return Err(ArchiveFault::Inflates { size, limit });
    }
    let read = |(entry, path): (&Listed<'_>, String)| {
        let node = node(bytes, entry).map_err(|error| {
            let reason = error.to_string();
            entry_fault(entry.name, EntryFault::Damaged { reason })
        })?;
        Ok(Item { path, utf8: std::str::from_utf8(entry.name).is_ok(), node })
    };
    // What is packed from `.` has an entry for that.
    let inside = listed.iter().zip(paths).filter(|(_, path)| !path.is_empty());
    inside.map(read).collect()
}

const KIND_FOLDER: u32 = 0o040_000;
const KIND_LINK: u32 = 0o120_000;

/// Checks an entry without inflating it. Returns its path; "" for the archive itself.
fn check(entry: &Listed<'_>, name: &str) -> Result<String, EntryFault> {
    let length = entry.name.len();
    let part = entry.name.split(|byte| *byte == b'/').map(<[u8]>::len).max();
    if length > MAX_NAME_BYTES || part > Some(MAX_PART_BYTES) {
        return Err(EntryFault::LongName { length, limit: MAX_NAME_BYTES, part: MAX_PART_BYTES });
    }
    let path = path_inside(name).ok_or(EntryFault::Path)?;
    if path.is_empty() && !is_named_as_folder(entry) {
        return Err(EntryFault::Path);
    }
    if entry.is_encrypted {
        return Err(EntryFault::Encrypted);
    }
    let limit = match entry.kind {
        KIND_LINK => MAX_LINK_BYTES,
        _ => MAX_DOCUMENT_BYTES,
    };
    let size = entry.packed.size;
    if size > limit {
        return Err(EntryFault::TooLarge { size, limit });
    }
    match entry.packed.method {
        STORED | DEFLATED => Ok(path),
        method => Err(EntryFault::Method { method }),
    }
}

/// Reads an entry to its end.
fn node(bytes: &Bytes, entry: &Listed<'_>) -> io::Result<Node<Packed>> {
    let data = entry.packed;
    let mut file = inflate(bytes, &data);
    if entry.kind == KIND_LINK {
        let mut target = Vec::new();
        file.read_to_end(&mut target)?;
        return Ok(Node::Link(String::from_utf8_lossy(&target).into_owned()));
    }
    io::copy(&mut file, &mut io::sink())?;
    Ok(match entry.kind == KIND_FOLDER || is_named_as_folder(entry) {
        true => Node::Folder,
        false => Node::File { size: data.size, data },
    })
}

fn is_named_as_folder(entry: &Listed<'_>) -> bool {
    let is_separator = |byte: &u8| *byte == b'/' || (*byte == b'\\' && entry.is_of_windows);
    let last = entry.name.rsplit(is_separator).next();
    matches!(last, Some(b"" | b"." | b".."))
}

/// The path of a name without `.`, `..` and empty parts; `None` if it leads out of the archive on any system. The rules
/// report other violations of SPEC 2.8, as they do for a folder.
fn path_inside(name: &str) -> Option<String> {
    let is_drive = matches!(name.as_bytes(), [drive, b':', ..] if drive.is_ascii_alphabetic());
    if is_drive || name.starts_with(['/', '\\']) || name.contains('\0') {
        return None;
    }
    let parts = |separators: &[char]| {
        name.split(separators).try_fold(Vec::new(), |mut parts, part| {
            match part {
                "" | "." => {}
                ".." => drop(parts.pop()?),
                part => parts.push(part),
            }
            Some(parts)
        })
    };
    parts(&['/', '\\'])?;
    Some(parts(&['/'])?.join("/"))
}

/// The folder in the archive that is the URDD's root; "" for the archive itself.
fn urdd_folder(members: &[Member]) -> Result<String, ArchiveFault> {
    let is_of_root = |member: &Member, path: &str| {
        let is_module = |kind: &ModuleKind| {
            path.strip_prefix(kind.folder())
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        };
        (path == ROOT_METADATA && !matches!(member.node, Node::Folder))
            || ModuleKind::ALL.iter().any(is_module)
    };
    if members.iter().any(|member| is_of_root(member, &member.path)) {
        return Ok(String::new());
    }
    let tops: BTreeSet<&str> = members
        .iter()
        .filter_map(|member| Some((member, member.path.split_once('/')?)))
        .filter(|(member, (top, rest))| *top != MACOS_FOLDER && is_of_root(member, rest))
        .map(|(_, (top, _))| top)
        .collect();
    let mut found = tops.into_iter();
    match (found.next(), found.next()) {
        (None, _) => Err(ArchiveFault::NoUrdd),
        (Some(only), None) => Ok(only.to_owned()),
        (Some(first), Some(second)) => {
            Err(ArchiveFault::ManyUrdds { first: first.to_owned(), second: second.to_owned() })
        }
    }
}

/// The packed bytes of an entry.
struct Slice(Bytes, Packed);

impl AsRef<[u8]> for Slice {
    fn as_ref(&self) -> &[u8] {
        let packed = self.0.all().get(self.1.start..self.1.end);
        packed.unwrap_or_default()
    }
}

fn inflate(bytes: &Bytes, packed: &Packed) -> Checked {
    let slice = Cursor::new(Slice(bytes.clone(), *packed));
    let inner: OpenFile = match packed.method {
        DEFLATED => Box::new(DeflateDecoder::new(slice)),
        _ => Box::new(slice),
    };
    Checked { inner, left: packed.size, crc: Crc::new(), stated: packed.crc }
}

/// Reads exactly the stated number of bytes, and verifies the checksum.
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
                (0, false) => wrong("its checksum does not match the stated one"),
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
