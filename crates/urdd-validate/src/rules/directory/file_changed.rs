use crate::rules::prelude::*;
use urdd_directory::digest::{Change, compare};
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
    phase Files, needs [Version1, RootMetadata],
}

/// Maximum number of bytes hashed in a URDD: a file of a terabyte, which costs its author nothing, must not keep a
/// reader busy for an hour.
const MAX_HASHED_BYTES: u64 = 64 << 30;

struct Listed<'a> {
    pointer: String,
    file: &'a FileEntry,
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
