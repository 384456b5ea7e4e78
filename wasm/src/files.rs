//! The files of a URDD: a zip archive, or files that the host gives one by one, when they are asked for.

use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use std::sync::{Arc, Mutex, PoisonError};

use serde_json::{Value, json};
use urdd_directory::listing::{Entry, EntryKind, Listing};
use urdd_directory::root::ReadError;
use urdd_directory::source::{Archive, OpenFile, Source};

use crate::{answer, memory};

/// Where the files lie. Clones share them.
#[derive(Debug, Clone)]
pub struct Files {
    source: Arc<dyn Source>,
    given: Option<Arc<Given>>,
}

/// Files that the host gives: each has a size from the start, and its bytes once the host has them.
#[derive(Debug)]
struct Given {
    name: String,
    files: Mutex<BTreeMap<String, Held>>,
}

/// A file's size, and its bytes.
type Held = (u64, Option<Arc<[u8]>>);

impl Source for Files {
    fn folder_name(&self) -> String {
        self.source.folder_name()
    }

    fn list(&self) -> Result<Listing, ReadError> {
        self.source.list()
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        self.source.open(path)
    }

    fn sibling(&self, folder_name: &str) -> Option<Arc<dyn Source>> {
        self.source.sibling(folder_name)
    }
}

/// The same files behind an [`Arc`], as a source.
#[derive(Debug)]
struct Shared(Arc<Given>);

impl Source for Shared {
    fn folder_name(&self) -> String {
        self.0.name.clone()
    }

    fn list(&self) -> Result<Listing, ReadError> {
        let files = self.0.files.lock().unwrap_or_else(PoisonError::into_inner);
        let mut entries: BTreeMap<String, (EntryKind, u64)> = BTreeMap::new();
        for (path, (size, _)) in files.iter() {
            for (slash, _) in path.match_indices('/') {
                entries.insert(path[..slash].to_owned(), (EntryKind::Folder, 0));
            }
            entries.insert(path.clone(), (EntryKind::File, *size));
        }
        let entry = |(path, (kind, size))| Entry {
            path,
            kind,
            size,
            utf8: true,
        };
        Ok(Listing {
            entries: entries.into_iter().map(entry).collect(),
            ..Listing::default()
        })
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        let files = self.0.files.lock().unwrap_or_else(PoisonError::into_inner);
        match files.get(path) {
            Some((_, Some(bytes))) => {
                Ok((Box::new(Cursor::new(Arc::clone(bytes))), bytes.len() as u64))
            }
            Some((_, None)) => Err(ReadError::Io("its bytes are not there yet".to_owned())),
            None => Err(ReadError::Missing),
        }
    }
}

impl Files {
    /// Reads a file of at most `limit` bytes.
    pub fn read(&self, path: &str, limit: u64) -> Result<Vec<u8>, String> {
        let (file, size) = self.open(path).map_err(|error| error.to_string())?;
        if size > limit {
            return Err(format!("it has {size} bytes, more than {limit}"));
        }
        let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or_default());
        file.take(limit)
            .read_to_end(&mut bytes)
            .map_err(|error| error.to_string())?;
        Ok(bytes)
    }
}

/// Files that the host will give. `name` is that of the folder, UTF-8.
///
/// # Safety
/// The bytes are the host's, as [`memory::bytes`] wants them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_new(name: *const u8, length: usize) -> *mut Files {
    // SAFETY: as the caller promises.
    let name = String::from_utf8_lossy(unsafe { memory::bytes(name, length) }).into_owned();
    let given = Arc::new(Given {
        name,
        files: Mutex::default(),
    });
    Box::into_raw(Box::new(Files {
        source: Arc::new(Shared(Arc::clone(&given))),
        given: Some(given),
    }))
}

/// Names a file and its size, whose bytes may come later.
///
/// # Safety
/// `files` is open; the path is the host's, UTF-8, as [`memory::bytes`] wants it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_name(
    files: *mut Files,
    path: *const u8,
    path_length: usize,
    size: u32,
) {
    // SAFETY: as the caller promises.
    let (files, path) = unsafe { (&*files, memory::bytes(path, path_length)) };
    if let Some(given) = &files.given {
        let path = String::from_utf8_lossy(path).into_owned();
        let mut known = given.files.lock().unwrap_or_else(PoisonError::into_inner);
        known.entry(path).or_insert((size.into(), None));
    }
}

/// Gives the bytes of a file, instead of those it had.
///
/// # Safety
/// `files` is open; both stretches of bytes are the host's, as [`memory::bytes`] wants them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_give(
    files: *mut Files,
    path: *const u8,
    path_length: usize,
    data: *const u8,
    length: usize,
) {
    // SAFETY: as the caller promises.
    let (files, path, data) = unsafe {
        (
            &*files,
            memory::bytes(path, path_length),
            memory::bytes(data, length),
        )
    };
    if let Some(given) = &files.given {
        let path = String::from_utf8_lossy(path).into_owned();
        let mut known = given.files.lock().unwrap_or_else(PoisonError::into_inner);
        known.insert(path, (data.len() as u64, Some(Arc::from(data))));
    }
}

/// The files in a zip archive; null where it is no archive of a URDD ([`urdd_zip_fault`] says why).
///
/// # Safety
/// Both stretches of bytes are the host's, as [`memory::bytes`] wants them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_of_zip(
    name: *const u8,
    name_length: usize,
    zip: *const u8,
    length: usize,
) -> *mut Files {
    // SAFETY: as the caller promises.
    let (name, zip) = unsafe { (memory::bytes(name, name_length), memory::bytes(zip, length)) };
    match Archive::new(&String::from_utf8_lossy(name), Arc::from(zip)) {
        Ok(archive) => Box::into_raw(Box::new(Files {
            source: Arc::new(archive),
            given: None,
        })),
        Err(_) => std::ptr::null_mut(),
    }
}

/// Why a zip archive is not one of a URDD; null where it is.
///
/// # Safety
/// The bytes are the host's, as [`memory::bytes`] wants them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_zip_fault(zip: *const u8, length: usize) -> *mut u8 {
    // SAFETY: as the caller promises.
    let zip = unsafe { memory::bytes(zip, length) };
    match Archive::new("robot", Arc::from(zip)) {
        Ok(_) => answer::result(Ok(Value::Null)),
        Err(error) => answer::result(Err(error.to_string())),
    }
}

/// A list with `path` and `size` of each file; and the name of the folder.
///
/// # Safety
/// `files` is open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_list(files: *mut Files) -> *mut u8 {
    // SAFETY: as the caller promises.
    let files = unsafe { &*files };
    answer::result(files.list().map_err(|error| error.to_string()).map(|listing| {
        let regular = listing.entries.iter().filter(|entry| entry.kind == EntryKind::File);
        let file = |entry: &Entry| json!({ "path": entry.path, "size": entry.size });
        json!({ "name": files.folder_name(), "files": regular.map(file).collect::<Vec<_>>() })
    }))
}

/// Most bytes of a file that is handed out.
const MAX_FILE_BYTES: u64 = 1 << 30;

/// The bytes of a file: an answer as [`answer::bytes_or_error`] makes it.
///
/// # Safety
/// `files` is open; the path is the host's, UTF-8, as [`memory::bytes`] wants it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_read(
    files: *mut Files,
    path: *const u8,
    length: usize,
) -> *mut u8 {
    // SAFETY: as the caller promises.
    let (files, path) = unsafe { (&*files, memory::bytes(path, length)) };
    answer::bytes_or_error(files.read(&String::from_utf8_lossy(path), MAX_FILE_BYTES))
}

/// Closes files. Robots that were opened of them stay.
///
/// # Safety
/// `files` is open, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_close(files: *mut Files) {
    // SAFETY: as the caller promises.
    drop(unsafe { Box::from_raw(files) });
}
