//! The files of a URDD: their contents, names and paths.

use super::versions::checked_modules;
use crate::rules::prelude::*;
use urdd_directory::file_entry::{Change, compare};
use urdd_directory::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use urdd_document::module::{JsonFile, Mirror, VersionFile};
use urdd_findings::finding::{KEPT_PLACES, Place};
use urdd_format::root_metadata::FileEntry;

declare_rule! {
    /// A file is not the one that `urdd.json` describes: its size or its SHA-256 differs.
    ///
    /// Somebody changed the file, or `urdd.json` was not written after it; so what else was made
    /// from it may not fit it any more. Two harmless causes are recognised. Git may have converted
    /// line endings: the `.gitattributes` beside `urdd.json` should say `* -text`, which keeps it
    /// from doing so. And with Git LFS a file may still be its pointer: `git lfs pull` fetches it.
    ///
    /// Bring the file back as it was, or write the modules that follow from it, and `urdd.json`, again.
    DIR014 "file-changed", Error, clause "2.7", since "0.1.0",
    phase Files, needs [Version1, RootMetadata], check file_changed,

    /// A file that belongs to the URDD cannot be read.
    ///
    /// There is something in its place that is not a regular file (a folder, a pipe), or reading it
    /// is not allowed, or it is larger than any such file should be. What it says is not checked.
    ///
    /// Put the file there, and make it readable.
    DIR023 "unreadable-file", Error, clause "2.9", since "0.1.0",
    phase Files, needs [], check unreadable_file,

    /// A path is not one that a URDD may name.
    ///
    /// Paths are relative to the URDD's root, with forward slashes, and have no empty part, no `.` or
    /// `..`, no backslash, colon or control character: only such a path means the same on every
    /// system, stays right when the URDD is moved, and cannot lead a reader out of it. An absolute
    /// path is right on one machine only.
    ///
    /// Write the path from the URDD's root, such as
    /// `mesh_modules/plain_meshes_module/meshes/stl/0_base.stl`.
    DIR015 "bad-path", Error, clause "2.8", since "0.1.0",
    phase References, needs [Version1], check bad_path,

    /// A symbolic link leads out of the URDD.
    ///
    /// Moved, packed or downloaded, the URDD lacks the file; and a link in a URDD from elsewhere may
    /// lead to any file of the reader's machine. What it leads to is not opened, and not checked.
    ///
    /// Put a copy of the file there instead of the link.
    DIR016 "link-leaves-root", Error, clause "2.8", since "0.1.0",
    phase Files, needs [], check link_leaves_root,

    /// A file in a module's folder has a name that is not UTF-8.
    ///
    /// No document can name it, archives garble it, and on other systems it cannot even be made.
    /// Most often it was unpacked from an archive with names in an old encoding.
    ///
    /// Rename it; derived files are named by link index and ASCII letters.
    DIR024 "name-not-utf8", Error, clause "2.9", since "0.1.0",
    phase Files, needs [], check name_not_utf8,

    /// Two names in one folder differ only in letter case.
    ///
    /// On Windows, on macOS and in many archives the two are one: when the URDD is copied or unpacked
    /// there, one file silently takes the place of the other, and the hashes in `urdd.json` no longer
    /// hold.
    ///
    /// Rename one of the two, and name it in the documents as it is called then.
    DIR027 "names-differ-in-case", Error, clause "2.9", since "0.2.0",
    phase Files, needs [Version1], check names_differ_in_case,
}

/// Maximum number of bytes hashed in a URDD: a file of a terabyte, which costs its author nothing, must not keep a
/// reader busy for an hour.
const MAX_HASHED_BYTES: u64 = 64 << 30;

struct Listed<'a> {
    pointer: String,
    file: &'a FileEntry,
}

fn file_changed(context: &Context, findings: &mut Findings) -> Option<()> {
    let listed = listed(context)?;
    let mut left = MAX_HASHED_BYTES;
    let (mut to_read, mut too_large) = (Vec::new(), Vec::new());
    for listed in &listed {
        // Other rules report files that are missing or unreadable.
        let Ok(size) = entries::look(context, &listed.file.path) else { continue };
        match left.checked_sub(size) {
            Some(rest) => {
                left = rest;
                to_read.push(listed);
            }
            None => too_large.push((listed, size)),
        }
    }
    let changes: Vec<(&Listed<'_>, Change)> = to_read
        .into_par_iter()
        .filter_map(|listed| {
            let (size, sha256) = (u64::from(listed.file.size.0), listed.file.sha256.as_str());
            let change = compare(context.root(), &listed.file.path, size, sha256)?;
            Some((listed, change))
        })
        .collect();
    report_cause(findings, &changes, Change::LfsPointer, |first, others| {
        format!(
            "{first}{others} is the pointer that Git LFS left in place of the file: run `git lfs pull`"
        )
    });
    report_cause(findings, &changes, Change::LineEndings, |first, others| {
        format!(
            "line endings of {first}{others} were converted, by Git most likely: put a .gitattributes with `* -text` beside urdd.json, and check the files out again"
        )
    });
    for (listed, change) in &changes {
        let (key, expected, actual) = match change {
            Change::Size(actual) => {
                ("size", format!("{} bytes", listed.file.size), format!("{actual} bytes"))
            }
            Change::Hash(actual) => ("sha256", listed.file.sha256.to_string(), actual.clone()),
            Change::LfsPointer | Change::LineEndings => continue,
        };
        let pointer = format!("{}/{key}", listed.pointer);
        let message = format!(
            "{} does not have the size and SHA-256 that are stated here: restore the file; if it is the right one, generate again what depends on it and run `urdd rehash`",
            listed.file.path
        );
        Finding::at(ROOT_METADATA, pointer, message)
            .values(expected, format!("{actual} ({})", listed.file.path))
            .report(findings);
    }
    for (listed, size) in too_large {
        let message = "the files are too large to be checked: at most 64 GiB of a URDD are read";
        Finding::at(ROOT_METADATA, format!("{}/size", listed.pointer), message)
            .expected(format!("{} bytes", listed.file.size))
            .actual(format!("{size} bytes ({})", listed.file.path))
            .report(findings);
    }
    Some(())
}

/// Every file with a size and a hash, except duplicates, which DIR026 reports, and entries that are not files.
fn listed(context: &Context) -> Option<Vec<Listed<'_>>> {
    let metadata = context.metadata()?;
    let source = source(context).map(|file| Listed { pointer: "/source/Urdf".to_owned(), file });
    let modules = entries::all(context).into_iter().flat_map(|entry| {
        let m = entry.index;
        let files = entry.entry.files.iter().enumerate();
        // DIR012 reports a file of another module.
        files
            .filter(move |(_, file)| entry.holds(&file.path))
            .map(move |(f, file)| Listed { pointer: format!("/modules/{m}/files/{f}"), file })
    });
    let mut times: HashMap<&str, usize> = HashMap::new();
    for path in paths::of_metadata(metadata) {
        *times.entry(path.path).or_default() += 1;
    }
    let once = source
        .into_iter()
        .chain(modules)
        .filter(|listed| times.get(listed.file.path.as_str()) == Some(&1));
    let files = once.filter(|listed| {
        let entry = context.listing().get(&listed.file.path);
        entry.is_none_or(|entry| entry.kind == EntryKind::File)
    });
    Some(files.collect())
}

/// Reports all files with the same cause as one finding.
fn report_cause(
    findings: &mut Findings,
    changes: &[(&Listed<'_>, Change)],
    cause: Change,
    message: impl Fn(&str, &str) -> String,
) {
    let of_cause: Vec<&Listed<'_>> =
        changes.iter().filter(|(_, change)| *change == cause).map(|(listed, _)| *listed).collect();
    let Some(first) = of_cause.first() else { return };
    let others = match of_cause.len() {
        1 => String::new(),
        n => format!(" (and of {} more)", n - 1),
    };
    let path = &first.file.path;
    let mut finding = Finding::in_file(path, message(path, &others)).count(of_cause.len());
    finding.more = of_cause
        .iter()
        .skip(1)
        .take(KEPT_PLACES - 1)
        .map(|listed| Place { file: Some(listed.file.path.clone()), ..Place::default() })
        .collect();
    findings.report(finding);
}

fn unreadable_file(context: &Context, findings: &mut Findings) -> Option<()> {
    // By path, so that a document that is also listed is reported once.
    let mut unreadable: BTreeMap<String, ReadError> = BTreeMap::new();
    if let JsonFile::Unreadable(error) = &context.metadata_file().json {
        unreadable.insert(ROOT_METADATA.to_owned(), error.clone());
    }
    for module in entries::known_modules(context) {
        if let JsonFile::Unreadable(error) = &module.json {
            unreadable.insert(module.file("module.json"), error.clone());
        }
        if let Mirror::Unreadable(error) = &module.mirror {
            unreadable.insert(module.file("module.yaml"), error.clone());
        }
        match &module.version_file {
            // DIR006 reports a VERSION file that is too long.
            VersionFile::Unreadable(ReadError::TooLarge { .. }) => {}
            VersionFile::Unreadable(error) => {
                unreadable.insert(module.file("VERSION"), error.clone());
            }
            _ => {}
        }
    }
    let source = source(context).map(|file| file.path.as_str());
    let listed = context.metadata().map(listed_files).into_iter().flatten();
    // A document may name a file outside of its module's folder, which is not listed.
    let modules = MESH_MODULES.iter().filter_map(|kind| context.module(*kind));
    let named = modules.flat_map(paths::of_module).filter(|named| !named.from_parent());
    // Most are listed, too: each is opened once.
    let needed: BTreeSet<&str> =
        listed.chain(source).chain(named.map(|named| named.path)).collect();
    for needed in needed {
        let opened = entries::look(context, needed).and_then(|_| context.root().open_file(needed));
        match opened {
            // DIR015 reports an invalid path.
            Ok(_) | Err(ReadError::Path(_)) => {}
            Err(error) => {
                unreadable.entry(needed.to_owned()).or_insert(error);
            }
        }
    }
    for (folder, error) in &context.listing().unreadable {
        unreadable.insert(folder.clone(), error.clone());
    }
    for (path, error) in unreadable {
        // DIR011 reports missing files, DIR016 links that leave the root.
        if !matches!(error, ReadError::Missing | ReadError::LeavesRoot) {
            Finding::in_file(path, error.to_string()).report(findings);
        }
    }
    if context.listing().cut {
        let message = format!(
            "there are more than {MAX_FILES} files, or folders more than {MAX_FOLDER_DEPTH} deep: the rest was not checked"
        );
        Finding::in_directory(message).report(findings);
    }
    Some(())
}

fn bad_path(context: &Context, findings: &mut Findings) -> Option<()> {
    for path in paths::all(context) {
        if !path.from_parent()
            && let Err(fault) = path::check(path.path)
        {
            Finding::at(path.file(), path.pointer.clone(), fault.to_string())
                .values("a path relative to the URDD's root", format!("{:?}", path.path))
                .report(findings);
        }
    }
    Some(())
}

fn link_leaves_root(context: &Context, findings: &mut Findings) -> Option<()> {
    let paths = paths::all(context);
    let here = paths.iter().filter_map(|path| match path.place(context) {
        paths::Place::Here(path) => Some(path),
        _ => None,
    });
    let module_folders = Kind::ALL.iter().map(|kind| kind.folder());
    let named: HashSet<&str> = here.chain(module_folders).flat_map(with_parents).collect();
    let modules: HashSet<&str> =
        checked_modules(context).map(|module| module.folder.as_str()).collect();
    for entry in &context.listing().entries {
        let path = entry.path.as_str();
        // Other files in the root do not belong to the URDD.
        let matters = path == ROOT_METADATA
            || named.contains(path)
            || with_parents(path).any(|parent| modules.contains(parent));
        if entry.kind == EntryKind::LinkOut && matters {
            let message =
                "this symbolic link leads out of the URDD: put what it leads to here instead";
            Finding::in_file(path, message).report(findings);
        }
    }
    Some(())
}

/// A path, and every folder above it.
fn with_parents(path: &str) -> impl Iterator<Item = &str> {
    std::iter::successors(Some(path), |path| Some(path.rsplit_once('/')?.0))
}

fn name_not_utf8(context: &Context, findings: &mut Findings) -> Option<()> {
    for module in entries::known_modules(context) {
        let mut bad = context.listing().below(&module.folder).filter(|entry| !entry.utf8);
        if let Some(first) = bad.next() {
            let message = "the name is not UTF-8 (shown with replacement characters): rename it";
            Finding::in_file(&first.path, message).count(1 + bad.count()).report(findings);
        }
    }
    Some(())
}

fn names_differ_in_case(context: &Context, findings: &mut Findings) -> Option<()> {
    let source = source(context).map(|file| file.path.as_str());
    // Other files in the root do not belong to the URDD.
    let is_of_urdd = |path: &str| {
        let folders = entries::known_modules(context).map(|module| module.folder.as_str());
        path == ROOT_METADATA
            || Some(path) == source
            || folders
                .into_iter()
                .any(|folder| path == folder || is_in(path, folder) || is_in(folder, path))
    };
    let mut alike: BTreeMap<(&str, String), Vec<&str>> = BTreeMap::new();
    for entry in &context.listing().entries {
        let (folder, name) = entry.path.rsplit_once('/').unwrap_or(("", &entry.path));
        let paths = alike.entry((folder, name.to_lowercase())).or_default();
        paths.push(&entry.path);
    }
    for paths in alike.values() {
        if let [first, second, ..] = paths.as_slice()
            && paths.iter().any(|path| is_of_urdd(path))
        {
            let message = format!(
                "this name differs from that of {first} only in letter case, and many file systems treat the two as one: rename one"
            );
            Finding::in_file(*second, message).count(paths.len() - 1).report(findings);
        }
    }
    Some(())
}

/// Whether a path is below a folder.
fn is_in(path: &str, folder: &str) -> bool {
    let rest = path.strip_prefix(folder);
    rest.is_some_and(|rest| rest.starts_with('/'))
}
