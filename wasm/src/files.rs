//! The files of a URDD: a zip archive, or files that the host provides one by one, on request.

use std::collections::BTreeMap;
#[cfg(feature = "lint")]
use std::collections::BTreeSet;
use std::io::{Cursor, Read};
use std::sync::{Arc, Mutex, PoisonError};

use serde_json::{Value, json};
use urdd_directory::listing::{Entry, EntryKind, Listing};
use urdd_directory::root::{ReadError, Root};
use urdd_directory::source::{Archive, OpenFile, Source};

#[cfg(feature = "lint")]
use crate::asked::Asked;
use crate::{answer, memory};
#[cfg(feature = "lint")]
use urdd_source::Content;

/// The files, and those that the host provides.
#[derive(Debug, Clone)]
pub struct Files {
    pub root: Root,
    given: Option<Arc<Given>>,
}

/// Files that the host provides: each has its size from the start, and its content once the host provides it.
#[derive(Debug)]
struct Given {
    name: String,
    files: Mutex<BTreeMap<String, Held>>,
    /// Files of which nobody knows where they belong; `None` if each file is where it belongs.
    #[cfg(feature = "lint")]
    lost: Mutex<Option<BTreeSet<String>>>,
}

/// A file's size, and its content.
type Held = (u64, Option<Arc<[u8]>>);

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
        let entry = |(path, (kind, size))| Entry { path, kind, size, utf8: true };
        Ok(Listing { entries: entries.into_iter().map(entry).collect(), ..Listing::default() })
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        let files = self.0.files.lock().unwrap_or_else(PoisonError::into_inner);
        match files.get(path) {
            Some((size, Some(bytes))) if *size == bytes.len() as u64 => {
                Ok((Box::new(Cursor::new(Arc::clone(bytes))), *size))
            }
            Some((_, Some(_))) => Err(ReadError::Changed),
            Some((_, None)) => Err(ReadError::Io("its bytes are not there yet".to_owned())),
            None => Err(ReadError::Missing),
        }
    }
}

impl Files {
    /// The files of a source.
    pub fn of(source: impl Source + 'static) -> Self {
        Files { root: Root::of(source), given: None }
    }

    /// The address of the open files, for the host.
    pub fn into_address(self) -> usize {
        Box::into_raw(Box::new(self)) as usize
    }

    /// The content of a file of at most `limit` bytes. What the host gave is shared, and what it named is asked for when it
    /// is needed.
    #[cfg(feature = "lint")]
    pub fn content(&self, path: &str, limit: u64) -> Result<Content, String> {
        if let Some(given) = &self.given {
            let files = given.files.lock().unwrap_or_else(PoisonError::into_inner);
            match files.get(path) {
                Some((_, Some(bytes))) if bytes.len() as u64 <= limit => {
                    return Ok(Content::Here(Arc::clone(bytes)));
                }
                Some((size, None)) => {
                    return Ok(Content::Elsewhere(Arc::new(Asked::of(path, *size))));
                }
                _ => {}
            }
        }
        Ok(Content::Here(self.read(path, limit)?.into()))
    }

    /// The files of which nobody knows where they belong; `None` if each file is where it belongs.
    #[cfg(feature = "lint")]
    pub fn lost(&self) -> Option<BTreeSet<String>> {
        let given = self.given.as_ref()?;
        given.lost.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Reads a file of at most `limit` bytes.
    pub fn read(&self, path: &str, limit: u64) -> Result<Vec<u8>, String> {
        let (file, size) = self.root.open(path).map_err(|error| error.to_string())?;
        if size > limit {
            return Err(format!("it has {size} bytes, more than {limit}"));
        }
        let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or_default());
        file.take(limit).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
        Ok(bytes)
    }
}

/// Creates files that the host will provide. `name` is the name of the folder, in UTF-8.
///
/// # Safety
/// The bytes are valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_new(name: *const u8, length: usize) -> *mut Files {
    // SAFETY: guaranteed by the caller.
    let name = String::from_utf8_lossy(unsafe { memory::bytes(name, length) }).into_owned();
    let given = Given {
        name,
        files: Mutex::default(),
        #[cfg(feature = "lint")]
        lost: Mutex::default(),
    };
    let given = Arc::new(given);
    Box::into_raw(Box::new(Files {
        root: Root::of(Shared(Arc::clone(&given))),
        given: Some(given),
    }))
}

/// Adds a file with its size. Its content may follow later.
///
/// # Safety
/// `files` is open; the path, in UTF-8, is valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_name(
    files: *mut Files,
    path: *const u8,
    path_length: usize,
    size: u32,
) {
    // SAFETY: guaranteed by the caller.
    let (files, path) = unsafe { (&*files, memory::bytes(path, path_length)) };
    if let Some(given) = &files.given {
        let path = String::from_utf8_lossy(path).into_owned();
        let mut known = given.files.lock().unwrap_or_else(PoisonError::into_inner);
        known.entry(path).or_insert((size.into(), None));
    }
}

/// Sets the content of a file. One that has content keeps it; one of another size than was named cannot be read.
///
/// # Safety
/// `files` is open; both byte ranges are valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_give(
    files: *mut Files,
    path: *const u8,
    path_length: usize,
    data: *const u8,
    length: usize,
) {
    // SAFETY: guaranteed by the caller.
    let (files, path, data) =
        unsafe { (&*files, memory::bytes(path, path_length), memory::bytes(data, length)) };
    if let Some(given) = &files.given {
        let path = String::from_utf8_lossy(path).into_owned();
        let mut known = given.files.lock().unwrap_or_else(PoisonError::into_inner);
        let (_, content) = known.entry(path).or_insert((data.len() as u64, None));
        content.get_or_insert_with(|| Arc::from(data));
    }
}

/// Sets the content of a file, in place of any that it had.
///
/// # Safety
/// As for [`urdd_files_give`].
#[cfg(feature = "make")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_put(
    files: *mut Files,
    path: *const u8,
    path_length: usize,
    data: *const u8,
    length: usize,
) {
    // SAFETY: guaranteed by the caller.
    let (files, path, data) =
        unsafe { (&*files, memory::bytes(path, path_length), memory::bytes(data, length)) };
    if let Some(given) = &files.given {
        let path = String::from_utf8_lossy(path).into_owned();
        let mut known = given.files.lock().unwrap_or_else(PoisonError::into_inner);
        known.insert(path, (data.len() as u64, Some(Arc::from(data))));
    }
}

/// States that nobody knows where a file belongs, such as one that was dropped without its folder: it is found by its last
/// name where nothing is at the path that a description names. So is any file by a name that leads out of the files. An
/// empty path states that alone.
///
/// # Safety
/// `files` is open; the path, in UTF-8, is valid for [`memory::bytes`].
#[cfg(feature = "lint")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_lost(files: *mut Files, path: *const u8, length: usize) {
    // SAFETY: guaranteed by the caller.
    let (files, path) = unsafe { (&*files, memory::bytes(path, length)) };
    if let Some(given) = &files.given {
        let mut lost = given.lost.lock().unwrap_or_else(PoisonError::into_inner);
        lost.get_or_insert_default().insert(String::from_utf8_lossy(path).into_owned());
    }
}

/// Opens the files in a zip archive; null if it is not an archive of a URDD ([`urdd_zip_fault`] says why).
///
/// # Safety
/// Both byte ranges are valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_of_zip(
    name: *const u8,
    name_length: usize,
    zip: *const u8,
    length: usize,
) -> *mut Files {
    // SAFETY: guaranteed by the caller.
    let (name, zip) = unsafe { (memory::bytes(name, name_length), memory::bytes(zip, length)) };
    match Archive::new(&String::from_utf8_lossy(name), Arc::from(zip)) {
        Ok(archive) => Box::into_raw(Box::new(Files::of(archive))),
        Err(_) => std::ptr::null_mut(),
    }
}

/// Opens the files in a zip archive, whatever they are: an answer with the address of `files`.
///
/// # Safety
/// The bytes are valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_of_any_zip(zip: *const u8, length: usize) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let zip = unsafe { memory::bytes(zip, length) };
    let archive = Archive::of_any("", Arc::<[u8]>::from(zip)).map_err(|error| error.to_string());
    answer::result(archive.map(|archive| json!({ "files": Files::of(archive).into_address() })))
}

/// Why a zip archive is not one of a URDD; null if it is.
///
/// # Safety
/// The bytes are valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_zip_fault(zip: *const u8, length: usize) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let zip = unsafe { memory::bytes(zip, length) };
    match Archive::new("robot", Arc::from(zip)) {
        Ok(_) => answer::result(Ok(Value::Null)),
        Err(error) => answer::result(Err(error.to_string())),
    }
}

/// The `path` and `size` of each file, and the name of the folder.
///
/// # Safety
/// `files` is open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_list(files: *mut Files) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let files = unsafe { &*files };
    answer::result(files.root.list().map_err(|error| error.to_string()).map(|listing| {
        let regular = listing.entries.iter().filter(|entry| entry.kind == EntryKind::File);
        let file = |entry: &Entry| json!({ "path": entry.path, "size": entry.size });
        json!({ "name": files.root.folder_name(), "files": regular.map(file).collect::<Vec<_>>() })
    }))
}

/// Maximum size of a file that is returned, in bytes.
const MAX_FILE_BYTES: u64 = 1 << 30;

/// The content of a file: an answer of [`answer::bytes_or_error`].
///
/// # Safety
/// `files` is open; the path, in UTF-8, is valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_read(
    files: *mut Files,
    path: *const u8,
    length: usize,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (files, path) = unsafe { (&*files, memory::bytes(path, length)) };
    answer::bytes_or_error(files.read(&String::from_utf8_lossy(path), MAX_FILE_BYTES))
}

/// Closes files. Robots opened from them remain usable.
///
/// # Safety
/// `files` is open, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_close(files: *mut Files) {
    // SAFETY: guaranteed by the caller.
    drop(unsafe { Box::from_raw(files) });
}
