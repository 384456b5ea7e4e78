//! The suite's files as one compressed archive. `build.rs` also compiles this file, so it must not use the rest of the
//! library.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Read};
use std::path::Path;

use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;

/// Files by path, with forward slashes.
pub type Files = BTreeMap<String, Vec<u8>>;

/// Every file below a folder.
///
/// # Errors
/// If a file cannot be read, or a name is not UTF-8.
#[allow(dead_code, reason = "build.rs reads it, and a debug build of the library")]
pub fn read_folder(folder: &Path) -> io::Result<Files> {
    let mut files = Files::new();
    let mut folders = vec![(folder.to_owned(), String::new())];
    while let Some((folder, inside)) = folders.pop() {
        let failed = |path: &Path, error: io::Error| {
            io::Error::new(error.kind(), format!("{}: {error}", path.display()))
        };
        for entry in fs::read_dir(&folder).map_err(|error| failed(&folder, error))? {
            let entry = entry?;
            let path = entry.path();
            let Ok(name) = entry.file_name().into_string() else {
                let error = io::Error::other("the name is not UTF-8");
                return Err(failed(&path, error));
            };
            let name = format!("{inside}{name}");
            if entry.file_type()?.is_dir() {
                folders.push((path, name + "/"));
            } else {
                let bytes = fs::read(&path).map_err(|error| failed(&path, error))?;
                files.insert(name, bytes);
            }
        }
    }
    Ok(files)
}

/// Packs the files into one archive, deterministically. Files that begin alike stand together: compression looks back
/// 32 KiB.
///
/// # Errors
/// If a name is too long.
#[cfg_attr(not(test), allow(dead_code, reason = "build.rs packs, the library unpacks"))]
pub fn pack(files: &Files) -> io::Result<Vec<u8>> {
    let mut archive = tar::Builder::new(GzEncoder::new(Vec::new(), Compression::best()));
    let mut files: Vec<(&String, &Vec<u8>)> = files.iter().collect();
    files.sort_by_key(|(path, bytes)| (path.rsplit('.').next(), *bytes));
    for (path, bytes) in files {
        let mut header = tar::Header::new_gnu();
        header.set_size(bytes.len() as u64);
        header.set_mode(0o644);
        archive.append_data(&mut header, path, bytes.as_slice())?;
    }
    archive.into_inner()?.finish()
}

/// Unpacks the files of an archive.
///
/// # Errors
/// If it is damaged.
#[allow(dead_code, reason = "build.rs packs, the library unpacks")]
pub fn unpack(archive: &[u8]) -> io::Result<Files> {
    let mut files = Files::new();
    for entry in tar::Archive::new(GzDecoder::new(archive)).entries()? {
        let mut entry = entry?;
        let path = String::from_utf8_lossy(&entry.path_bytes()).into_owned();
        let mut bytes = Vec::new();
        entry.read_to_end(&mut bytes)?;
        files.insert(path, bytes);
    }
    Ok(files)
}
