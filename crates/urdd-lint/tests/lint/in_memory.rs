//! Files in memory are linted as those of a disk are: a browser has no disk.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use urdd_findings::code::Code;
use urdd_format::report::Urdd;
use urdd_lint::{LintSettings, lint_with_text, rules};
use urdd_source::Files;

use crate::cases::{cases, copied};

/// Every file below a folder, by its path from it.
fn below(folder: &Path, at: &str, found: &mut Vec<(String, Arc<[u8]>)>) {
    for entry in fs::read_dir(folder.join(at)).expect("a folder") {
        let entry = entry.expect("an entry");
        let path = format!("{at}{}", entry.file_name().to_string_lossy());
        match entry.path().is_dir() {
            true => below(folder, &format!("{path}/"), found),
            false => found.push((path, fs::read(entry.path()).expect("a file").into())),
        }
    }
}

fn report(file: &Path, files: Files) -> Vec<Urdd> {
    let mut settings = LintSettings::default();
    settings.source.files = files;
    let (run, _) = lint_with_text(file, &[], None, &settings).expect("a report");
    run.report.urdds
}

#[test]
fn each_case_is_linted_alike_in_memory_and_on_a_disk() {
    let mut compared = 0;
    // Of LNT065 a disk has xacro, where it is installed, and memory never.
    for rule in rules::all().into_iter().filter(|rule| rule.description.code != Code::LNT065) {
        for prefix in ["invalid", "near_miss"] {
            for case in cases(rule.description.code, prefix) {
                let (folder, file) = copied(&case);
                // A link counts as what it leads to.
                let mut all = Vec::new();
                below(folder.path(), "", &mut all);
                // Where the disk has it, so that absolute paths in messages are the same.
                let at = folder.path().strip_prefix("/").expect("an absolute path").to_owned();
                let name = |path: String| at.join(path).to_string_lossy().into_owned();
                let all = all.into_iter().map(|(path, bytes)| (name(path), bytes));
                let files = Files::in_memory(all).expect("files");
                let (on_disk, in_memory) = (report(&file, Files::Disk), report(&file, files));
                assert_eq!(in_memory, on_disk, "{}", case.display());
                compared += 1;
            }
        }
    }
    assert!(compared > 100, "{compared} cases");
}
