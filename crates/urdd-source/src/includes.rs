//! The files that a xacro file includes, to notice their changes.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

use crate::files::Files;
use crate::process::{Ended, Running};
use crate::settings::Settings;
use crate::xacro::PackageIndex;
use urdd_directory::cancellation::Cancellation;

/// Maximum length of the list, bytes, and maximum number of files.
const MAX_LIST: u64 = 1 << 20;
const MAX_FILES: usize = 2000;
/// Files that xacro reads.
const ENDINGS: &[&str] = &["xacro", "yaml", "yml", "urdf", "xml"];

/// The files that xacro reads for a robot: what `xacro --deps` lists. If it fails, as for a broken file, or names cannot
/// be told apart, the xacro and YAML files of the robot's package. None for a URDF without macros, or in memory.
pub fn included(file: &Path, settings: &Settings, cancellation: &Cancellation) -> Vec<PathBuf> {
    if !matches!(settings.files, Files::Disk) {
        return Vec::new();
    }
    let is_xacro = file.extension().is_some_and(|ending| ending == "xacro");
    match is_xacro || settings.xacro.expand_urdf && has_macros(file) {
        true => listed(file, settings, cancellation).unwrap_or_else(|| beside(file)),
        false => Vec::new(),
    }
}

fn has_macros(file: &Path) -> bool {
    std::fs::read_to_string(file).is_ok_and(|text| text.contains("<xacro:"))
}

fn listed(file: &Path, settings: &Settings, cancellation: &Cancellation) -> Option<Vec<PathBuf>> {
    let mut command = Command::new("xacro");
    command.arg("--deps").arg(file.canonicalize().ok()?);
    command.args(&settings.xacro.arguments);
    let given = PackageIndex::new(&settings.packages).ok()?;
    given.tell(&mut command);
    let mut running = Running::start(command).ok()?;
    let (output, errors) = running.streams();
    let read = |stream: Option<Box<dyn Read + Send>>| {
        thread::spawn(move || {
            let mut text = String::new();
            stream?.take(MAX_LIST).read_to_string(&mut text).ok()?;
            Some(text)
        })
    };
    let output = read(output.map(|stream| Box::new(stream) as _));
    read(errors.map(|stream| Box::new(stream) as _));
    let limit = settings.xacro.time_limit;
    let ended = running.wait(limit, cancellation, || false).ok()?;
    if !matches!(ended, Ended::Itself(status) if status.success()) {
        return None;
    }
    let text = output.join().ok()??;
    let files = text.split_whitespace().map(PathBuf::from);
    let files: Vec<PathBuf> = files.map(|file| given.lasting(file)).collect();
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
        if visited > MAX_FILES || found.len() > MAX_FILES {
            break;
        }
        for entry in std::fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let ending = path.extension().unwrap_or_default();
            match entry.file_type() {
                Ok(kind) if kind.is_dir() => waiting.push(path),
                Ok(_) if ENDINGS.iter().any(|known| ending == *known) => found.push(path),
                _ => {}
            }
        }
    }
    found
}
