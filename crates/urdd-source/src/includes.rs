//! The files that a xacro file includes, to notice their changes.

use std::path::{Path, PathBuf};

use crate::files::{Files, MAX_SOURCE_BYTES};
use crate::package_index::PackageIndex;
use crate::settings::Settings;
use crate::xacro::run;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::file_type::FileType;
use urdd_directory::regular;

/// Maximum number of folders, and of files, that are listed.
const MAX_LISTED: usize = 2000;

/// The files that xacro reads for a robot: what `xacro --deps` lists. If it fails, as for a broken file, or names cannot
/// be told apart, the xacro and YAML files of the robot's package. None for a URDF without macros, or in memory.
pub fn included(file: &Path, settings: &Settings, cancellation: &Cancellation) -> Vec<PathBuf> {
    if !matches!(settings.files, Files::Disk) {
        return Vec::new();
    }
    let is_xacro = FileType::Xacro.is_of(file);
    match is_xacro || settings.xacro.expand_urdf && has_macros(file) {
        true => listed(file, settings, cancellation).unwrap_or_else(|| beside(file)),
        false => Vec::new(),
    }
}

/// Whether xacro reads such files.
fn is_read(file: &Path) -> bool {
    use FileType::{Document, Urdf, Xacro, Xml};
    matches!(FileType::of(file), Some(Xacro | Xml | Urdf | Document))
}

fn has_macros(file: &Path) -> bool {
    let text = regular::read(file, MAX_SOURCE_BYTES);
    text.is_ok_and(|text| String::from_utf8_lossy(&text).contains("<xacro:"))
}

fn listed(file: &Path, settings: &Settings, cancellation: &Cancellation) -> Option<Vec<PathBuf>> {
    let given = PackageIndex::new(&settings.packages, file).ok()?;
    let text = run(&["--deps"], file, "", &settings.xacro, &given, None, cancellation).ok()?;
    let files: Vec<PathBuf> = text.split_whitespace().map(PathBuf::from).collect();
    // A name with a blank is listed as two.
    files.iter().all(|file| file.is_file()).then_some(files)
}

/// The files with such endings in the folder of the file's package, or else in its own.
fn beside(file: &Path) -> Vec<PathBuf> {
    let Ok(file) = file.canonicalize() else {
        return Vec::new();
    };
    let mut above = file.ancestors().skip(1);
    let package = above.find(|folder| folder.join("package.xml").is_file());
    let Some(folder) = package.or_else(|| file.parent()) else {
        return Vec::new();
    };
    let (mut found, mut waiting, mut visited) = (Vec::new(), vec![folder.to_owned()], 0);
    while let Some(folder) = waiting.pop() {
        visited += 1;
        if visited > MAX_LISTED || found.len() > MAX_LISTED {
            break;
        }
        for entry in std::fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            match entry.file_type() {
                Ok(kind) if kind.is_dir() => waiting.push(path),
                Ok(_) if is_read(&path) => found.push(path),
                _ => {}
            }
        }
    }
    found
}
