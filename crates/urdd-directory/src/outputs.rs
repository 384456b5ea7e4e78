//! The one way in which a run writes files among those of a person: all of them or none, and never through a link, into
//! a pipe, or over a file with other content that it was not told to replace.
//!
//! A folder that is new, or that holds nothing but these files, is replaced as a whole ([`crate::staging`]). Elsewhere the
//! files are prepared in a hidden folder and moved one by one. If a run is killed meanwhile, the next one finishes what it
//! began.
#![expect(clippy::disallowed_methods, reason = "this is where files are written")]

use std::collections::BTreeSet;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Component, Path, PathBuf};

use thiserror::Error;

use crate::cancellation::Cancellation;
use crate::file_type::ROOT_METADATA;
use crate::regular;
use crate::staging::{Staging, StagingError};
use crate::unfinished::{Unfinished, What, writing};
use crate::writer::Writer;
use urdd_format::escape;

/// Why no file was written.
#[derive(Debug, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say it")]
pub enum OutputError {
    #[error("{} already exists with other content", shown(.0))]
    Exists(PathBuf),
    #[error("{}: {what} is in the way; remove it, or write to another place", shown(path))]
    InTheWay { path: PathBuf, what: &'static str },
    #[error("{}: this is outside of the folder that is written", shown(.0))]
    Outside(PathBuf),
    #[error(
        "{}: a file with this name makes its folder a URDD, which the next `urdd validate` would examine; give it another name, such as urdd-report.json", shown(.0)
    )]
    MakesUrdd(PathBuf),
    #[error("{}: cannot be written: {error}", shown(path))]
    Write { path: PathBuf, error: io::Error },
    #[error(transparent)]
    Folder(#[from] StagingError),
}

fn shown(path: &Path) -> String {
    escape::line(&path.display().to_string()).into_owned()
}

/// What a person named. It is followed where it is a link to a folder; what is below it is not.
#[derive(Debug, Clone, Copy)]
pub enum Target<'a> {
    /// A folder for all files.
    Folder(&'a Path),
    /// A file, with others beside it.
    File(&'a Path),
}

impl<'a> Target<'a> {
    /// The folder that the paths of files are relative to.
    pub fn folder(self) -> &'a Path {
        match self {
            Target::Folder(folder) => folder,
            Target::File(file) => match file.parent() {
                Some(folder) if !folder.as_os_str().is_empty() => folder,
                _ => Path::new("."),
            },
        }
    }
}

/// A file to write.
#[derive(Debug, Clone)]
pub struct Output<'a> {
    /// Its path below [`Target::folder`].
    pub path: PathBuf,
    /// Its content.
    pub bytes: &'a [u8],
    /// Whether it replaces a file with other content.
    pub replaces: bool,
}

/// Files that are prepared and not in place yet.
#[derive(Debug)]
#[must_use = "nothing is in place before `put`"]
pub struct Staged<'a> {
    folder: PathBuf,
    files: Vec<Output<'a>>,
    /// The number of those that are not there yet.
    changed: usize,
    staging: Staging,
    /// Whether the folder is replaced as a whole.
    is_whole: bool,
    /// Keeps other runs from replacing the folder.
    outer: Option<Staging>,
    /// Last: what is in them is removed before.
    folders: NewFolders,
}

/// Writes files that belong together, the last one last. One that exists with the same content is left as it is. Returns
/// how many were not.
///
/// # Errors
/// If a file may not or cannot be written. None is then.
pub fn write(target: Target, files: Vec<Output>) -> Result<usize, OutputError> {
    match files.is_empty() {
        true => Ok(0),
        false => stage(target, files)?.put(),
    }
}

/// Prepares files that belong together, after checking that each may be written. Waits for other runs of the same target.
///
/// # Errors
/// As for [`write()`].
pub fn stage<'a>(target: Target, files: Vec<Output<'a>>) -> Result<Staged<'a>, OutputError> {
    let folder = target.folder().to_owned();
    let mut folders = NewFolders::default();
    folders.make(match target {
        Target::Folder(folder) => folder.parent().unwrap_or(folder),
        Target::File(_) => &folder,
    })?;
    let outer = match target {
        Target::Folder(folder) => Some(Staging::begin(folder, &Cancellation::default())),
        Target::File(_) => None,
    };
    let among = || {
        let name = match target {
            // The same for all files that are written there.
            Target::Folder(_) => OUTPUT.as_ref(),
            Target::File(file) => file.file_name().unwrap_or(OUTPUT.as_ref()),
        };
        Staging::begin_among(&folder.join(name)).map_err(|error| match error {
            StagingError::Write { error, .. } => OutputError::Write { path: folder.clone(), error },
            error => error.into(),
        })
    };
    let (staging, is_whole, outer) = match outer {
        Some(Ok(staging)) if holds_only(&folder, &files) => (staging, true, None),
        Some(Err(error)) if !folder.is_dir() => return Err(error.into()),
        outer => (among()?, false, outer.and_then(Result::ok)),
    };
    let changed = 0;
    let mut staged = Staged { folder, files, changed, staging, is_whole, outer, folders };
    staged.prepare()?;
    Ok(staged)
}

/// What the hidden folder in a folder is named after.
const OUTPUT: &str = "output";

impl Staged<'_> {
    fn prepare(&mut self) -> Result<(), OutputError> {
        let mut changed = BTreeSet::new();
        for file in &self.files {
            if check(&self.folder, file)? {
                changed.insert(file.path.clone());
            }
        }
        self.changed = changed.len();
        if changed.is_empty() {
            self.files.clear();
        }
        if !self.is_whole {
            self.files.retain(|file| changed.contains(&file.path));
        }
        for file in &self.files {
            let place = self.folder.join(&file.path);
            let written = Writer::new(self.staging.content()).synced(&file.path, file.bytes);
            written.map_err(|error| OutputError::Write { path: place, error })?;
        }
        Ok(())
    }

    /// Moves the files into place, and returns the number of those that were not there.
    ///
    /// # Errors
    /// If one cannot be moved. What was there before is in place then.
    pub fn put(self) -> Result<usize, OutputError> {
        let _writing = writing();
        let Staged { folder, files, changed, staging, is_whole, outer, mut folders } = self;
        if files.is_empty() {
            return Ok(0);
        }
        if is_whole {
            match staging.commit() {
                // A folder where a file system is mounted cannot be replaced.
                Err(_) if folder.is_dir() => {
                    let staging = Staging::begin_among(&folder.join(OUTPUT))?;
                    let is_whole = false;
                    let mut staged =
                        Staged { folder, files, changed, staging, is_whole, outer, folders };
                    staged.prepare()?;
                    return staged.put();
                }
                committed => committed?,
            }
        } else {
            let paths: Vec<&Path> = files.iter().map(|file| file.path.as_path()).collect();
            staging
                .put_among(&folder, &paths)
                .map_err(|(path, error)| OutputError::Write { path: folder.join(path), error })?;
        }
        folders.0.clear();
        Ok(changed)
    }
}

/// Writes a report to the file that a person named: links are followed, and devices and pipes are written to. Anything
/// else is as for [`write()`].
///
/// # Errors
/// If it may not or cannot be written.
pub fn report(file: &Path, bytes: &[u8], replaces: bool) -> Result<(), OutputError> {
    check_report(file, bytes, replaces)?;
    if is_stream(file) {
        let written = stream(file, false).and_then(|mut out| out.write_all(bytes));
        return written.map_err(|error| OutputError::Write { path: file.to_owned(), error });
    }
    let target = followed(file);
    let output = Output { path: name_of(&target).into(), bytes, replaces };
    write(Target::File(&target), vec![output]).map(|_| ())
}

/// Checks that [`report()`] may write.
///
/// # Errors
/// As for [`report()`].
pub fn check_report(file: &Path, bytes: &[u8], replaces: bool) -> Result<(), OutputError> {
    check_name(file)?;
    let target = followed(file);
    let output = Output { path: name_of(&target).into(), bytes, replaces };
    if is_stream(file) {
        return Ok(());
    }
    let folder = Target::File(&target).folder();
    // A folder that is not there is a slip of the person's.
    fs::metadata(folder).map_err(|error| OutputError::Write { path: file.to_owned(), error })?;
    check(folder, &output).map(|_| ())
}

/// Writes a file that is not there yet, in a folder of the program's own, and the folders above it.
///
/// # Errors
/// If something is there, or it cannot be written.
pub fn fresh(place: &Path, bytes: &[u8]) -> io::Result<()> {
    let _writing = writing();
    fs::create_dir_all(Target::File(place).folder())?;
    File::create_new(place)?.write_all(bytes)
}

/// Opens what is written bit by bit: a device, a pipe, a log. `creates` makes an empty file of it first.
///
/// # Errors
/// If it cannot be opened.
pub fn stream(path: &Path, creates: bool) -> io::Result<File> {
    OpenOptions::new().write(true).create(creates).truncate(creates).open(path)
}

/// Whether this leads to a device, a pipe or a socket.
pub fn is_stream(file: &Path) -> bool {
    fs::metadata(file).is_ok_and(|there| !there.is_file() && !there.is_dir())
}

/// The path that a link leads to, also if nothing is there yet.
fn followed(file: &Path) -> PathBuf {
    match fs::read_link(file) {
        Ok(to) => file.canonicalize().unwrap_or_else(|_| Target::File(file).folder().join(to)),
        Err(_) => file.to_owned(),
    }
}

/// The name of a file that a person named; a path without one is a folder, and is refused as such.
pub fn name_of(file: &Path) -> &Path {
    file.file_name().map_or(file, Path::new)
}

/// Refuses the file name that marks a folder as a URDD.
///
/// # Errors
/// [`OutputError::MakesUrdd`] if the file has that name.
pub fn check_name(file: &Path) -> Result<(), OutputError> {
    match file.file_name().is_some_and(|name| name.eq_ignore_ascii_case(ROOT_METADATA)) {
        true => Err(OutputError::MakesUrdd(file.to_owned())),
        false => Ok(()),
    }
}

/// Whether something is in the place of a file that is not this file.
pub fn is_other(place: &Path, bytes: &[u8]) -> bool {
    fs::symlink_metadata(place).is_ok_and(|there| !is_same(place, &there, bytes))
}

fn is_same(place: &Path, there: &Metadata, bytes: &[u8]) -> bool {
    let is_as_long = there.is_file() && there.len() == bytes.len() as u64;
    is_as_long && regular::read(place, there.len()).is_ok_and(|there| there == bytes)
}

/// Checks that a file may be written. `false` if it is there already.
fn check(folder: &Path, file: &Output) -> Result<bool, OutputError> {
    check_name(&file.path)?;
    let place = folder.join(&file.path);
    if !file.path.components().all(|part| matches!(part, Component::Normal(_))) {
        return Err(OutputError::Outside(place));
    }
    match at(folder, &file.path)? {
        Some(there) if is_same(&place, &there, file.bytes) => Ok(false),
        Some(_) if !file.replaces => Err(OutputError::Exists(place)),
        _ => Ok(true),
    }
}

/// The regular file in the place of an output, if there is one. Anything else is in the way, and so is a link to it.
fn at(folder: &Path, path: &Path) -> Result<Option<Metadata>, OutputError> {
    let mut place = folder.to_owned();
    let mut parts = path.components().peekable();
    while let Some(part) = parts.next() {
        place.push(part);
        let there = match fs::symlink_metadata(&place) {
            Ok(there) => there,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(OutputError::Write { path: place, error }),
        };
        let (kind, is_last) = (there.file_type(), parts.peek().is_none());
        let what = match kind {
            kind if kind.is_symlink() => "a link",
            kind if kind.is_dir() && !is_last => continue,
            kind if kind.is_dir() => "a folder",
            kind if !kind.is_file() => "a pipe, a device or a socket",
            _ if !is_last => "a file",
            _ => return Ok(Some(there)),
        };
        return Err(OutputError::InTheWay { path: place, what });
    }
    Err(OutputError::InTheWay { path: place, what: "a folder" })
}

/// Whether a folder is missing, or has nothing but some of these files.
fn holds_only(folder: &Path, files: &[Output]) -> bool {
    let paths = files.iter().flat_map(|file| file.path.ancestors()).collect();
    fn of(folder: &Path, below: &Path, paths: &BTreeSet<&Path>) -> io::Result<bool> {
        for entry in fs::read_dir(folder.join(below))? {
            let entry = entry?;
            let (path, kind) = (below.join(entry.file_name()), entry.file_type()?);
            let is_known = paths.contains(path.as_path()) && (kind.is_dir() || kind.is_file());
            if !is_known || kind.is_dir() && !of(folder, &path, paths)? {
                return Ok(false);
            }
        }
        Ok(true)
    }
    let is_missing = fs::symlink_metadata(folder).is_err();
    is_missing || of(folder, Path::new(""), &paths).unwrap_or(false)
}

/// New folders. Those that are empty are removed when this is dropped.
#[derive(Debug, Default)]
struct NewFolders(Vec<(PathBuf, Unfinished)>);

impl NewFolders {
    fn make(&mut self, folder: &Path) -> Result<(), OutputError> {
        let missing = folder.ancestors().take_while(|folder| {
            !folder.as_os_str().is_empty() && fs::symlink_metadata(folder).is_err()
        });
        let missing: Vec<PathBuf> = missing.map(Path::to_owned).collect();
        for path in missing.into_iter().rev() {
            let _writing = writing();
            if let Err(error) = fs::create_dir(&path) {
                return Err(OutputError::Write { path, error });
            }
            let unfinished = Unfinished::new(&path, What::Folder);
            self.0.push((path, unfinished));
        }
        Ok(())
    }
}

impl Drop for NewFolders {
    fn drop(&mut self) {
        for (folder, _) in self.0.iter().rev() {
            let _ = fs::remove_dir(folder);
        }
    }
}
