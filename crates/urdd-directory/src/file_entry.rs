//! Sizes and hashes of files, in bounded memory, and the entries of `urdd.json` that state them, as JSON.

use std::io::{self, Read};

use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use crate::root::{ReadError, Root};
use urdd_format::hexadecimal::hexadecimal;
use urdd_format::registry::{FIRST_SPEC_VERSION, ModuleKind};
use urdd_xml::foreign::LFS_POINTER;

/// How a file differs from its stated size and hash.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Change {
    /// It is a Git LFS pointer.
    LfsPointer,
    /// Only the line endings differ.
    LineEndings,
    /// The size differs: the actual size, bytes.
    Size(u64),
    /// The hash differs: the actual SHA-256.
    Hash(String),
}

/// Size in bytes and SHA-256 (64 lower-case hexadecimal digits) of a file. Reads in chunks: meshes are large.
///
/// # Errors
/// If the file cannot be read.
pub fn of(root: &Root, path: &str) -> Result<(u64, String), ReadError> {
    let (file, _) = root.open_file(path)?;
    of_reader(file).map_err(|error| ReadError::Io(error.to_string()))
}

/// Size and SHA-256 of what a reader returns, as [`of`] returns them.
///
/// # Errors
/// If it cannot be read.
pub fn of_reader(mut reader: impl Read) -> io::Result<(u64, String)> {
    let mut hasher = Sha256::new();
    let mut piece = vec![0; 1 << 16];
    let mut size = 0;
    loop {
        match reader.read(&mut piece)? {
            0 => return Ok((size, hexadecimal(&hasher.finalize()))),
            read => {
                size += read as u64;
                hasher.update(&piece[..read]);
            }
        }
    }
}

/// Size and SHA-256 of a file's content, as [`of`] returns them.
pub fn of_bytes(bytes: &[u8]) -> (u64, String) {
    (bytes.len() as u64, hexadecimal(&Sha256::digest(bytes)))
}

/// Pointers of Git LFS are shorter.
const LONGEST_LFS_POINTER: u64 = 1024;

/// Larger files are unlikely to be text with converted line endings. If their size differs, they are not hashed.
const LARGEST_TEXT: u64 = 1 << 30;

/// How a file differs from the stated size and hash. `None` if it does not, or cannot be read.
pub fn compare(root: &Root, path: &str, size: u64, sha256: &str) -> Option<Change> {
    let (mut file, actual) = root.open_file(path).ok()?;
    if actual != size && actual < LONGEST_LFS_POINTER {
        let start = root.read(path, LONGEST_LFS_POINTER).ok()?;
        if start.starts_with(LFS_POINTER) {
            return Some(Change::LfsPointer);
        }
    }
    // A conversion changes the size by at most one byte per line end.
    let could_be_converted =
        actual <= LARGEST_TEXT && size <= actual.saturating_mul(2) && size >= actual / 2;
    if actual != size && !could_be_converted {
        return Some(Change::Size(actual));
    }
    let hashes = hashes(&mut file, actual != size)?;
    if actual == size && hashes.plain == sha256 {
        return None;
    }
    if hashes.lf.as_deref() == Some(sha256) || hashes.crlf.as_deref() == Some(sha256) {
        return Some(Change::LineEndings);
    }
    Some(if actual == size { Change::Hash(hashes.plain) } else { Change::Size(actual) })
}

/// SHA-256 of a file, in hexadecimal.
#[doc(hidden)]
pub struct Hashes {
    /// Of its bytes as they are.
    pub plain: String,
    /// With every CR LF converted to LF.
    pub lf: Option<String>,
    /// With every LF (and CR LF) converted to CR LF.
    pub crlf: Option<String>,
}

/// The hashes of a file, those with other line ends only if they are wanted. None if it cannot be read.
#[doc(hidden)]
pub fn hashes(file: &mut impl Read, converted: bool) -> Option<Hashes> {
    let mut plain = Sha256::new();
    let mut lf = Sha256::new();
    let mut crlf = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    let (mut as_lf, mut as_crlf) = (Vec::new(), Vec::new());
    let mut carriage_return = false;
    loop {
        let read = match file.read(&mut buffer) {
            Ok(0) => break,
            Ok(read) => read,
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => continue,
            Err(_) => return None,
        };
        let bytes = buffer.get(..read)?;
        plain.update(bytes);
        if !converted {
            continue;
        }
        as_lf.clear();
        as_crlf.clear();
        for &byte in bytes {
            // Hold back a CR until the next byte shows whether it belongs to a CR LF.
            if carriage_return && byte != b'\n' {
                as_lf.push(b'\r');
            }
            carriage_return = byte == b'\r';
            if !carriage_return {
                as_lf.push(byte);
            }
        }
        for &byte in &as_lf {
            as_crlf.extend((byte == b'\n').then_some(b'\r'));
            as_crlf.push(byte);
        }
        lf.update(&as_lf);
        crlf.update(&as_crlf);
    }
    if carriage_return {
        lf.update(b"\r");
        crlf.update(b"\r");
    }
    let digits = |hash: Sha256| hexadecimal(&hash.finalize());
    Some(Hashes {
        plain: digits(plain),
        lf: converted.then(|| digits(lf)),
        crlf: converted.then(|| digits(crlf)),
    })
}

/// The file entries that are objects: that of the source, then those of the modules.
pub fn all(metadata: &mut Value) -> impl Iterator<Item = &mut Value> {
    let (mut source, mut modules) = (None, None);
    for (key, value) in metadata.as_object_mut().into_iter().flatten() {
        match key.as_str() {
            "source" => source = value.get_mut("Urdf"),
            "modules" => modules = value.as_array_mut(),
            _ => {}
        }
    }
    let modules = modules.into_iter().flatten().flat_map(of_module);
    let entries = source.into_iter().chain(modules);
    entries.filter(|entry| entry.is_object())
}

/// The file entries of all modules.
pub fn of_modules(metadata: &mut Value) -> impl Iterator<Item = &mut Value> {
    let modules = metadata.get_mut("modules").and_then(Value::as_array_mut);
    modules.into_iter().flatten().flat_map(of_module)
}

/// The file entries of a module.
pub fn of_module(module: &mut Value) -> impl Iterator<Item = &mut Value> {
    let files = module.get_mut("files").and_then(Value::as_array_mut);
    files.into_iter().flatten()
}

/// The path of an entry.
pub fn path(entry: &Value) -> Option<&str> {
    entry.get("path").and_then(Value::as_str)
}

/// Updates the entries of those files that `bytes` returns. Returns whether one of them changed.
pub fn reseal<'a>(metadata: &mut Value, bytes: impl Fn(&str) -> Option<&'a [u8]>) -> bool {
    let mut changed = false;
    for entry in all(metadata) {
        if let Some(bytes) = path(entry).and_then(&bytes) {
            let (size, sha256) = of_bytes(bytes);
            changed |= update(entry, size, &sha256);
        }
    }
    changed
}

/// Removes the entries of files of modules.
pub fn unlist(metadata: &mut Value, is_gone: impl Fn(&str) -> bool) {
    let modules = metadata.get_mut("modules").and_then(Value::as_array_mut);
    for module in modules.into_iter().flatten() {
        if let Some(files) = module.get_mut("files").and_then(Value::as_array_mut) {
            files.retain(|entry| !path(entry).is_some_and(&is_gone));
        }
    }
}

/// Writes size and SHA-256 into an entry. Returns whether they changed.
pub fn update(entry: &mut Value, size: u64, sha256: &str) -> bool {
    let (size, sha256) = (json!(size), json!(sha256));
    let changed = entry["size"] != size || entry["sha256"] != sha256;
    entry["size"] = size;
    entry["sha256"] = sha256;
    changed
}

/// Lists a new module in `modules`, at its place: modules of the specification in the order of its table, then all others
/// by name. `files` are its files, by their paths relative to the root.
pub fn insert_module<'a>(
    modules: &mut Vec<Value>,
    name: &str,
    version: &str,
    folder: &str,
    depends_on: &[ModuleKind],
    files: impl Iterator<Item = (String, &'a [u8])>,
) {
    let mut files: Vec<_> = files.collect();
    files.sort();
    let files = files.iter().map(|(path, bytes)| {
        let (size, sha256) = of_bytes(bytes);
        json!({ "path": path, "size": size, "sha256": sha256 })
    });
    let depends_on: Vec<&str> = depends_on.iter().map(|kind| kind.name()).collect();
    let entry = json!({
        "name": name, "version": version, "path": folder, "depends_on": depends_on,
        "files": files.collect::<Vec<_>>(),
    });
    let follows = |module: &Value| rank(module["name"].as_str().unwrap_or_default()) > rank(name);
    let place = modules.iter().position(follows);
    modules.insert(place.unwrap_or(modules.len()), entry);
}

/// States the version of the specification that has this module first, where the one that is stated is older.
pub fn raise_version(metadata: &mut Value, kind: ModuleKind) {
    let numbers = |version: &str| -> Vec<u64> {
        version.split('.').map(|number| number.parse().unwrap_or_default()).collect()
    };
    let stated = metadata.get("urdd_version").and_then(Value::as_str);
    if stated.is_some_and(|stated| numbers(stated) < numbers(kind.since())) {
        metadata["urdd_version"] = kind.since().into();
    }
}

/// Orders modules by their names: those of 1.0 as the table has them, and all others behind them (SPEC 2.6).
fn rank(name: &str) -> (usize, &str) {
    let mut kinds = ModuleKind::ALL.iter();
    let is_it = |kind: &ModuleKind| kind.name() == name && kind.since() == FIRST_SPEC_VERSION;
    match kinds.position(is_it) {
        Some(place) => (place, ""),
        None => (ModuleKind::ALL.len(), name),
    }
}
