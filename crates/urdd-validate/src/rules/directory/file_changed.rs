use std::collections::HashMap;

use rayon::prelude::*;

use crate::context::Context;
use crate::finding::{Finding, Findings, KEPT_PLACES, Place};
use crate::rule::declare_rule;
use urdd_directory::digest::{Change, compare};
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::root::EntryKind;
use urdd_format::root_metadata::{FileEntry, Source};

use urdd_document::{entries, paths};

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
    check check,
}

/// Most bytes of one URDD that are hashed: a file of a terabyte, which costs its author nothing,
/// must not keep a reader busy for an hour.
const MAX_HASHED_BYTES: u64 = 64 << 30;

struct Listed<'a> {
    pointer: String,
    file: &'a FileEntry,
}

fn check(context: &Context, findings: &mut Findings) {
    let listed = listed(context);
    let mut left = MAX_HASHED_BYTES;
    let (mut to_read, mut too_large) = (Vec::new(), Vec::new());
    for listed in &listed {
        // Of what is not there, or cannot be read, other rules report.
        let Ok(size) = entries::look(context, &listed.file.path) else {
            continue;
        };
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
            Change::Size(actual) => (
                "size",
                format!("{} bytes", listed.file.size),
                format!("{actual} bytes"),
            ),
            Change::Hash(actual) => ("sha256", listed.file.sha256.to_string(), actual.clone()),
            Change::LfsPointer | Change::LineEndings => continue,
        };
        findings.report(
            Finding::at(
                ROOT_METADATA,
                format!("{}/{key}", listed.pointer),
                format!(
                    "{} does not have the size and SHA-256 that are stated here: restore the file; if it is the right one, write again what follows from it and run `urdd rehash`",
                    listed.file.path
                ),
            )
            .expected(expected)
            .actual(format!("{actual} ({})", listed.file.path)),
        );
    }
    for (listed, size) in too_large {
        findings.report(
            Finding::at(
                ROOT_METADATA,
                format!("{}/size", listed.pointer),
                "the files are too large to be checked: at most 64 GiB of a URDD are read",
            )
            .expected(format!("{} bytes", listed.file.size))
            .actual(format!("{size} bytes ({})", listed.file.path)),
        );
    }
}

/// Every file with a size and a hash, but for those that are listed twice, which DIR026 reports,
/// and those that are not files.
fn listed(context: &Context) -> Vec<Listed<'_>> {
    let Some(metadata) = context.metadata() else {
        return Vec::new();
    };
    let source = match &metadata.source {
        Some(Source::Urdf(file)) => Some(Listed {
            pointer: "/source/Urdf".to_owned(),
            file,
        }),
        _ => None,
    };
    let modules = entries::all(context).into_iter().flat_map(|entry| {
        let m = entry.index;
        let files = entry.entry.files.iter().enumerate();
        // A file of another module is not the one that is meant: DIR012 reports it.
        files
            .filter(move |(_, file)| entry.holds(&file.path))
            .map(move |(f, file)| Listed {
                pointer: format!("/modules/{m}/files/{f}"),
                file,
            })
    });
    let mut times: HashMap<&str, usize> = HashMap::new();
    for path in paths::of_metadata(metadata) {
        *times.entry(path.path).or_default() += 1;
    }
    source
        .into_iter()
        .chain(modules)
        .filter(|listed| times.get(listed.file.path.as_str()) == Some(&1))
        .filter(|listed| {
            context
                .listing()
                .get(&listed.file.path)
                .is_none_or(|entry| entry.kind == EntryKind::File)
        })
        .collect()
}

/// One finding for all files of a cause that is one mistake.
fn report_cause(
    findings: &mut Findings,
    changes: &[(&Listed<'_>, Change)],
    cause: Change,
    message: impl Fn(&str, &str) -> String,
) {
    let of_cause: Vec<&Listed<'_>> = changes
        .iter()
        .filter(|(_, change)| *change == cause)
        .map(|(listed, _)| *listed)
        .collect();
    let Some(first) = of_cause.first() else {
        return;
    };
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
        .map(|listed| Place {
            file: Some(listed.file.path.clone()),
            ..Place::default()
        })
        .collect();
    findings.report(finding);
}
