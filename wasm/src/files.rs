//! The files of a URDD: a zip archive, or files that the host provides one by one, on request.

#[cfg(feature = "make")]
use std::collections::BTreeMap;
#[cfg(feature = "lint")]
use std::collections::BTreeSet;
use std::io;
use std::sync::Arc;
#[cfg(feature = "lint")]
use std::sync::{Mutex, PoisonError};

use serde_json::{Value, json};
use urdd_directory::limits::MAX_FILE_BYTES;
use urdd_directory::listing::{Entry, EntryKind};
use urdd_directory::regular;
use urdd_directory::root::Root;
use urdd_directory::source::{Archive, Memory, Source};

use crate::{answer, memory};

/// The files, and those that the host provides.
#[derive(Debug, Clone)]
pub struct Files {
    pub root: Root,
    given: Option<GivenFile>,
}

/// Files that the host provides: each has its size from the start, and its content once the host provides it.
#[derive(Debug, Clone)]
struct GivenFile {
    files: Memory,
    /// Files of which nobody knows where they belong; `None` if each file is where it belongs.
    #[cfg(feature = "lint")]
    lost: Arc<Mutex<Option<BTreeSet<String>>>>,
}

impl Files {
    /// The files of a source.
    fn of(source: impl Source + 'static) -> Self {
        Files { root: Root::of(source), given: None }
    }

    /// The address of new files, for the host. `name` names their folder.
    #[cfg(feature = "make")]
    pub fn address_of(name: &str, files: BTreeMap<String, Arc<[u8]>>) -> Result<usize, String> {
        let memory = Memory::new(name, files);
        let named = |(path, fault): (String, _)| format!("`{}`: {fault}", path.escape_debug());
        Ok(Files::of(memory.map_err(named)?).into_address())
    }

    /// The address of the open files, for the host.
    fn into_address(self) -> usize {
        Box::into_raw(Box::new(self)) as usize
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
        regular::read_sized(file, size, limit).map_err(|error| error.to_string())
    }
}

#[cfg(all(target_arch = "wasm32", feature = "lint"))]
#[link(wasm_import_module = "urdd")]
unsafe extern "C" {
    /// The content of a file by its path: an answer of `answer::bytes_or_error`; null if the host has none.
    fn read(path: *const u8, length: usize) -> *mut u8;
}

/// The content of a file that the host named; `None` if it has none.
fn asked(path: &str) -> io::Result<Option<Arc<[u8]>>> {
    let Some(given) = given(path) else { return Ok(None) };
    match given.split_first() {
        Some((1, bytes)) => Ok(Some(bytes.into())),
        Some((_, error)) => Err(io::Error::other(String::from_utf8_lossy(error))),
        None => Err(io::ErrorKind::UnexpectedEof.into()),
    }
}

#[cfg(all(target_arch = "wasm32", feature = "lint"))]
fn given(path: &str) -> Option<Vec<u8>> {
    use crate::memory::{bytes, urdd_free_answer};
    // SAFETY: the host reads the path before it returns. Its answer begins with its length, and is not used again.
    unsafe {
        let answer = read(path.as_ptr(), path.len());
        if answer.is_null() {
            return None;
        }
        let length = u32::from_le_bytes(*answer.cast::<[u8; 4]>());
        let content = bytes(answer.add(4), length as usize).to_vec();
        urdd_free_answer(answer);
        Some(content)
    }
}

#[cfg(not(all(target_arch = "wasm32", feature = "lint")))]
fn given(_: &str) -> Option<Vec<u8>> {
    None
}

/// Creates files that the host will provide. `name` is the name of the folder, in UTF-8.
///
/// # Safety
/// The bytes are valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_new(name: *const u8, length: usize) -> *mut Files {
    // SAFETY: guaranteed by the caller.
    let name = String::from_utf8_lossy(unsafe { memory::bytes(name, length) }).into_owned();
    let given = GivenFile {
        files: Memory::empty(&name, asked),
        #[cfg(feature = "lint")]
        lost: Arc::default(),
    };
    Box::into_raw(Box::new(Files { root: Root::of(given.files.clone()), given: Some(given) }))
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
        given.files.name(&String::from_utf8_lossy(path), size.into());
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
        given.files.give(&String::from_utf8_lossy(path), data);
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
        given.files.put(&String::from_utf8_lossy(path), data);
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

/// The paths of those files that are not among the files of before with the same content.
///
/// # Safety
/// Both are open.
#[cfg(feature = "make")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_files_changed(files: *mut Files, before: *mut Files) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (files, before) = unsafe { (&*files, &*before) };
    answer::result(files.root.list().map_err(|error| error.to_string()).map(|listing| {
        let regular = listing.entries.iter().filter(|entry| entry.kind == EntryKind::File);
        let is_as_before = |path: &str| {
            let before = before.read(path, MAX_FILE_BYTES);
            before.is_ok_and(|before| files.read(path, MAX_FILE_BYTES).as_ref() == Ok(&before))
        };
        let changed = regular.filter(|entry| !is_as_before(&entry.path));
        Value::from(changed.map(|entry| entry.path.as_str()).collect::<Vec<_>>())
    }))
}

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
