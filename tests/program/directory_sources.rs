//! A URDD in a folder, in memory and in a zip archive is read alike. A hostile archive is rejected with a clear
//! message, in little memory.

use std::collections::BTreeMap;
use std::fs;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Arc;

use serde_json::Value;
use testkit::files;
use urdd_directory::file_entry;
use urdd_directory::listing::EntryKind;
use urdd_directory::listing::ReadError;
use urdd_directory::listing::{ArchiveFault, EntryFault};
use urdd_directory::root::Root;
use urdd_directory::source::{Archive, Disk, Memory};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/urdds")
}

fn urdd(arguments: &[&str], path: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_urdd"))
        .args(arguments)
        .arg(path)
        .output()
        .expect("the program runs")
}

/// An archive of files, each under a prefix.
fn pack(files: &BTreeMap<String, Vec<u8>>, prefix: &str) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, bytes) in files {
        let options = SimpleFileOptions::default();
        zip.start_file(format!("{prefix}{path}"), options).expect("an entry");
        zip.write_all(bytes).expect("written");
    }
    zip.finish().expect("an archive").into_inner()
}

fn arm() -> BTreeMap<String, Vec<u8>> {
    files::below(&examples().join("arm"))
}

fn refused(bytes: Vec<u8>) -> ArchiveFault {
    Archive::new("robot", bytes).expect_err("a fault")
}

fn findings(output: &Output) -> Value {
    let report: Value = serde_json::from_slice(&output.stdout).expect("a report");
    report["urdds"][0]["findings"].clone()
}

/// The report on a URDD with faults, in a folder and packed in two ways.
#[test]
fn a_urdd_in_memory_has_the_report_of_its_folder() {
    use urdd_validate::report;
    use urdd_validate::settings::Settings;
    use urdd_validate::{validate, validate_source};
    for (name, errors) in [("arm", 0), ("stale_gripper", 1)] {
        let folder = examples().join(name);
        let shared = files::below(&folder)
            .into_iter()
            .map(|(path, bytes)| (path, Arc::from(bytes)))
            .collect();
        let memory = Memory::new(name, shared).expect("sound paths");
        let settings = Settings::default();
        let from_memory = validate_source(memory, name, &settings).expect("a run");
        let from_folder = validate(&[folder], &settings).expect("a run");
        let text = |run: &urdd_validate::Run| report::json(&run.report).expect("a report");
        assert_eq!(text(&from_memory), text(&from_folder));
        let value: Value = serde_json::from_str(&text(&from_memory)).expect("JSON");
        assert!(value["totals"]["error"].as_u64() >= Some(errors), "{name}");
    }
}

#[test]
fn an_archive_has_the_findings_of_its_folder() {
    let mut urdd_files = arm();
    let bounds = urdd_files.get_mut("bounds_module/module.json").expect("it");
    let text = String::from_utf8(bounds.clone()).expect("UTF-8");
    *bounds =
        text.replacen("\"dof_lower_bounds\": [", "\"dof_lower_bounds\": [0.25, ", 1).into_bytes();
    urdd_files.insert("dof_module/notes.txt".to_owned(), b"stray".to_vec());
    let folder = testkit::temporary::folder();
    let root = folder.path().join("arm");
    for (path, bytes) in &urdd_files {
        let file = root.join(path);
        fs::create_dir_all(file.parent().expect("a folder")).expect("made");
        fs::write(file, bytes).expect("written");
    }
    let expected = findings(&urdd(&["validate", "--format", "json"], &root));
    assert!(expected.as_array().expect("a list").len() >= 3, "{expected}");
    for prefix in ["", "arm/"] {
        let zip = folder.path().join("robot.zip");
        fs::write(&zip, pack(&urdd_files, prefix)).expect("written");
        let output = urdd(&["validate", "--format", "json"], &zip);
        assert_eq!(findings(&output), expected, "prefix {prefix:?}");
        assert_eq!(output.status.code(), Some(1));
    }
}

#[test]
fn info_reads_an_archive() {
    let folder = testkit::temporary::folder();
    let zip = folder.path().join("arm.zip");
    fs::write(&zip, pack(&arm(), "arm/")).expect("written");
    let text = |path: &Path| {
        let output = urdd(&["info"], path);
        assert!(output.status.success(), "{output:?}");
        let text = String::from_utf8(output.stdout).expect("UTF-8");
        text.split_once('\n').expect("lines").1.to_owned()
    };
    assert_eq!(text(&zip), text(&examples().join("arm")));
}

#[test]
fn sources_list_and_read_alike() {
    let urdd_files = arm();
    let disk = Root::of(Disk::open(&examples().join("arm")).expect("a folder"));
    let shared = urdd_files
        .iter()
        .map(|(path, bytes)| (path.clone(), Arc::from(bytes.as_slice())))
        .collect();
    let memory = Root::of(Memory::new("arm", shared).expect("sound paths"));
    let packed = pack(&urdd_files, "arm/");
    let archive = Root::of(Archive::new("other", packed).expect("an archive"));
    let expected = disk.list().expect("a listing");
    assert!(expected.entries.len() > 15);
    for root in [&memory, &archive] {
        assert_eq!(root.list().expect("a listing"), expected);
        assert_eq!(root.folder_name(), "arm");
        assert!(root.folder().is_none());
        assert!(root.sibling("rover").is_none());
        for (path, bytes) in &urdd_files {
            assert_eq!(&root.read(path, u64::MAX >> 1).expect("a file"), bytes);
            assert_eq!(file_entry::of(root, path), file_entry::of(&disk, path));
        }
        assert_eq!(root.read("none", 10), Err(ReadError::Missing));
        assert_eq!(root.read("urdd.json/x", 10), Err(ReadError::Missing));
        assert_eq!(root.read("dof_module", 10), Err(ReadError::NotAFile));
        assert!(matches!(root.read("../arm/urdd.json", 10), Err(ReadError::Path(_))));
        let too_large = root.read("urdd.json", 10);
        assert!(matches!(too_large, Err(ReadError::TooLarge { limit: 10, .. })));
    }
}

/// Other URDDs' reports are kept, and the archive's own report says why there is none.
#[test]
fn an_archive_that_cannot_be_read_is_unreadable() {
    let folder = testkit::temporary::folder();
    let zip = folder.path().join("cut.zip");
    let whole = pack(&arm(), "");
    fs::write(&zip, &whole[..whole.len() / 2]).expect("written");
    let output = Command::new(env!("CARGO_BIN_EXE_urdd"))
        .args(["validate", "--format", "json"])
        .args([&zip, &examples().join("arm")])
        .output()
        .expect("the program runs");
    let report: Value = serde_json::from_slice(&output.stdout).expect("a report");
    assert_eq!(report["urdds"][0]["verdict"], "unreadable");
    assert_eq!(report["urdds"][1]["verdict"], "pass");
    assert_eq!(output.status.code(), Some(1));
    let alone = urdd(&["validate"], &zip);
    assert_eq!(alone.status.code(), Some(2));
    let words = String::from_utf8_lossy(&alone.stdout).into_owned();
    assert!(words.contains("not a complete zip archive"), "{words}");
}

#[test]
fn an_archive_cut_anywhere_is_refused() {
    let whole = pack(&arm(), "");
    for at in (0..whole.len()).step_by(whole.len() / 50) {
        let fault = refused(whole[..at].to_vec());
        assert!(matches!(fault, ArchiveFault::Broken { .. }), "{at}: {fault}");
    }
}

fn entry_fault(bytes: Vec<u8>) -> EntryFault {
    match refused(bytes) {
        ArchiveFault::Entry { fault, .. } => fault,
        other => panic!("{other}"),
    }
}

/// Like [`pack`], with one entry beside `urdd.json`, whose name is then changed byte by byte.
fn renamed(from: &str, to: &str) -> Vec<u8> {
    assert_eq!(from.len(), to.len());
    let two = [("urdd.json", "{}"), (from, "text")];
    let files = two.map(|(path, text)| (path.to_owned(), text.as_bytes().to_vec()));
    let mut bytes = pack(&files.into(), "");
    let places: Vec<usize> = (0..bytes.len() - from.len())
        .filter(|at| bytes[*at..].starts_with(from.as_bytes()))
        .collect();
    assert_eq!(places.len(), 2, "in its own header and in the archive's list");
    for at in places {
        bytes[at..at + to.len()].copy_from_slice(to.as_bytes());
    }
    bytes
}

#[test]
fn names_that_leave_the_archive_are_refused() {
    for (from, to) in [
        ("aaaa.txt", "../a.txt"),
        ("aaaa.txt", "/etc/txt"),
        ("aaaa.txt", "..\\a.txt"),
        ("aaaa.txt", "\\etc\\txt"),
        ("aaaa.txt", "C:/a.txt"),
        ("aaaa.txt", "./../txt"),
        ("aaaa.txt", "aaa\0.txt"),
    ] {
        assert_eq!(entry_fault(renamed(from, to)), EntryFault::Path, "{to:?}");
    }
}

#[test]
fn names_that_are_there_twice_are_refused() {
    assert_eq!(entry_fault(renamed("urdd.jsom", "urdd.json")), EntryFault::Duplicate);
    // A file and a folder.
    let two = [("urdd.json", ""), ("a", "x"), ("a/b", "y")];
    let files = two.map(|(path, text)| (path.to_owned(), text.as_bytes().to_vec()));
    assert_eq!(entry_fault(pack(&files.into(), "")), EntryFault::Duplicate);
}

/// Where the central directory and the entry's header state a property of an entry: offset from the directory's
/// signature.
fn set_in_both(bytes: &mut [u8], name: &str, offset: usize, value: &[u8]) {
    set_in_list(bytes, name, offset, value);
    let at = (0..bytes.len()).find(|at| bytes[*at..].starts_with(name.as_bytes()));
    let header = at.expect("the name") - 30;
    assert!(bytes[header..].starts_with(b"PK\x03\x04"));
    let place = header + offset - 2;
    bytes[place..place + value.len()].copy_from_slice(value);
}

/// Like [`set_in_both`], only in the central directory.
fn set_in_list(bytes: &mut [u8], name: &str, offset: usize, value: &[u8]) {
    let at =
        (0..bytes.len()).rfind(|at| bytes[*at..].starts_with(name.as_bytes())).expect("the name");
    let header = at - 46;
    assert!(bytes[header..].starts_with(b"PK\x01\x02"));
    bytes[header + offset..header + offset + value.len()].copy_from_slice(value);
}

#[test]
fn entries_that_are_not_what_is_stated_are_refused() {
    let change = |offset: usize, value: &[u8]| {
        let mut bytes = pack(&arm(), "");
        set_in_both(&mut bytes, "urdd.json", offset, value);
        entry_fault(bytes)
    };
    assert_eq!(change(8, &[1, 0]), EntryFault::Encrypted);
    assert!(matches!(change(10, &[12, 0]), EntryFault::Method { .. }));
    let damaged = |fault: EntryFault, words: &str| match fault {
        EntryFault::Damaged { reason } => assert!(reason.contains(words), "{reason}"),
        other => panic!("{other}"),
    };
    damaged(change(16, &[1, 2, 3, 4]), "checksum");
    damaged(change(24, &100_u32.to_le_bytes()), "longer than stated");
    damaged(change(24, &1_000_000_u32.to_le_bytes()), "shorter than stated");
    damaged(change(20, &u32::MAX.to_le_bytes()[..3]), "beyond");
    let too_large = change(24, &0xFFFF_FFF0_u32.to_le_bytes());
    assert!(matches!(too_large, EntryFault::TooLarge { .. }), "{too_large}");
}

/// Some programs trust the central directory, others the headers.
#[test]
fn an_entry_that_is_described_in_two_ways_is_refused() {
    let whole = pack(&arm(), "");
    for (offset, value) in [
        (8, &[1, 0][..]),
        (10, &[0, 0]),
        (16, &[1, 2, 3, 4]),
        (20, &[1, 0, 0, 0]),
        (24, &[1, 0, 0, 0]),
    ] {
        let mut bytes = whole.clone();
        set_in_list(&mut bytes, "urdd.json", offset, value);
        assert_eq!(entry_fault(bytes), EntryFault::Header, "at {offset}");
    }
    let mut bytes = whole;
    let at = (0..bytes.len()).find(|at| bytes[*at..].starts_with(b"urdd.json"));
    bytes[at.expect("the name")] = b'v';
    assert_eq!(entry_fault(bytes), EntryFault::Header, "the name");
}

/// The start of the central directory, from the record at the end of an archive.
fn move_list(archive: &mut [u8], by: usize) {
    let end = archive.len() - 22;
    assert!(archive[end..].starts_with(b"PK\x05\x06"));
    let add = |archive: &mut [u8], at: usize| {
        let word = u32::from_le_bytes(archive[at..at + 4].try_into().expect("four"));
        let moved = word + u32::try_from(by).expect("small");
        archive[at..at + 4].copy_from_slice(&moved.to_le_bytes());
    };
    let list = u32::from_le_bytes(archive[end + 16..end + 20].try_into().expect("four"));
    let mut at = list as usize;
    while archive[at..].starts_with(b"PK\x01\x02") {
        add(archive, at + 42);
        let length =
            |k: usize| usize::from(archive[at + k]) + 256 * usize::from(archive[at + k + 1]);
        at += 46 + length(28) + length(30) + length(32);
    }
    add(archive, end + 16);
}

#[test]
fn two_archives_in_one_file_are_refused() {
    let (one, two) = (pack(&arm(), ""), pack(&arm(), "arm/"));
    let other = |bytes: Vec<u8>, what: &str| {
        assert_eq!(refused(bytes), ArchiveFault::OtherBytes, "{what}");
    };
    other([one.clone(), two.clone()].concat(), "one after another");
    let mut moved = two.clone();
    move_list(&mut moved, one.len());
    other([one.clone(), moved].concat(), "the second one knows of the first");
    let mut commented = one.clone();
    let length = u16::try_from(two.len()).expect("short");
    let end = commented.len() - 2;
    commented[end..].copy_from_slice(&length.to_le_bytes());
    other([commented, two.clone()].concat(), "the second one is a comment of the first");
    other([b"#!/bin/sh\n".to_vec(), one.clone()].concat(), "something before");
    other([one.clone(), b"\n".to_vec()].concat(), "something after");
    let mut prefixed = one.clone();
    move_list(&mut prefixed, 10);
    other([b"#!/bin/sh\n".to_vec(), prefixed].concat(), "something before, known of");
    // An archive inside an archive is a file like any other.
    let mut files = arm();
    files.insert("dof_module/notes.zip".to_owned(), two);
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let stored = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    for (path, bytes) in &files {
        zip.start_file(path, stored).expect("an entry");
        zip.write_all(bytes).expect("written");
    }
    let bytes = zip.finish().expect("an archive").into_inner();
    assert!(Archive::new("robot", bytes).is_ok());
}

#[test]
fn names_that_no_file_system_takes_are_refused() {
    for (name, is_too_long) in [
        ("n".repeat(1020), false),
        ("n".repeat(1021), true),
        (["n"; 2048].join("/"), false),
        (["n"; 2049].join("/"), true),
        ("n".repeat(60_000), true),
    ] {
        let two = [("urdd.json".to_owned(), b"{}".to_vec()), (name.clone(), Vec::new())];
        let archive = Archive::new("robot", pack(&two.into(), ""));
        match archive {
            Ok(_) => assert!(!is_too_long, "{} bytes", name.len()),
            Err(ArchiveFault::Entry { fault, .. }) => {
                assert!(is_too_long && matches!(fault, EntryFault::LongName { .. }), "{fault}");
            }
            Err(fault) => panic!("{fault}"),
        }
    }
}

#[test]
fn bombs_are_refused_before_they_are_inflated() {
    // 400 MB of zeros in 400 kB, and an entry that states this size.
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default();
    zip.start_file("urdd.json", options).expect("an entry");
    let zeros = vec![0; 1 << 20];
    for _ in 0..400 {
        zip.write_all(&zeros).expect("written");
    }
    let bytes = zip.finish().expect("an archive").into_inner();
    assert!(bytes.len() < 500_000);
    let fault = refused(bytes);
    let ArchiveFault::Inflates { size, limit } = fault else { panic!("{fault}") };
    assert_eq!(size, 400 << 20);
    assert!(limit < 200 << 20);
}

#[test]
fn an_archive_of_too_many_entries_is_refused() {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default();
    for i in 0..100_001 {
        zip.start_file(format!("urdf_module/{i}"), options).expect("an entry");
    }
    let mut bytes = zip.finish().expect("an archive").into_inner();
    assert_eq!(refused(bytes.clone()), ArchiveFault::Zip64);
    // Without the zip64 record, the count is taken modulo 65,536.
    let locator = (0..bytes.len()).rfind(|at| bytes[*at..].starts_with(b"PK\x06\x07"));
    bytes[locator.expect("a locator")] = 0;
    let end = bytes.len() - 22;
    bytes[end + 8..end + 12].copy_from_slice(&[0xA1, 0x86, 0xA1, 0x86]);
    let fault = refused(bytes);
    assert!(
        matches!(fault, ArchiveFault::Count { listed: 100_001, .. } | ArchiveFault::OtherBytes),
        "{fault}"
    );
}

#[test]
fn which_urdd_is_meant_must_be_clear() {
    let one = |path: &str| BTreeMap::from([(path.to_owned(), b"{}".to_vec())]);
    assert_eq!(refused(pack(&one("a/b/urdd.json"), "")), ArchiveFault::NoUrdd);
    assert_eq!(refused(pack(&one("readme.txt"), "")), ArchiveFault::NoUrdd);
    let mut two = one("a/urdd.json");
    two.extend(one("b/dof_module/module.json"));
    assert!(matches!(refused(pack(&two, "")), ArchiveFault::ManyUrdds { .. }));
    let mut beside = one("a/urdd.json");
    beside.extend(one("__MACOSX/a/._urdd.json"));
    beside.extend(one("docs/readme.txt"));
    let archive = Archive::new("robot", pack(&beside, "")).expect("one URDD");
    let listing = Root::of(archive).list().expect("a listing");
    assert_eq!(listing.entries.len(), 1);
}

#[test]
fn links_in_an_archive_are_as_on_disk() {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default();
    for (path, text) in [("urdd.json", "{}"), ("a/b/file", "text")] {
        zip.start_file(path, options).expect("an entry");
        zip.write_all(text.as_bytes()).expect("written");
    }
    for (path, target) in [
        ("to_file", "a/b/file"),
        ("a/up", "../a/./b/file"),
        ("to_folder", "a/b"),
        ("to_nothing", "c"),
        ("out", "../secret"),
        ("absolute", "/etc/passwd"),
        ("circle", "circle"),
    ] {
        zip.add_symlink(path, target, options).expect("a link");
    }
    let bytes = zip.finish().expect("an archive").into_inner();
    let root = Root::of(Archive::new("robot", bytes).expect("an archive"));
    let listing = root.list().expect("a listing");
    let kind = |path: &str| listing.get(path).expect("an entry").kind;
    assert_eq!(kind("to_file"), EntryKind::File);
    assert_eq!(kind("a/up"), EntryKind::File);
    assert_eq!(kind("to_folder"), EntryKind::Link);
    assert_eq!(kind("to_nothing"), EntryKind::Link);
    assert_eq!(kind("circle"), EntryKind::Link);
    assert_eq!(kind("out"), EntryKind::LinkOut);
    assert_eq!(kind("absolute"), EntryKind::LinkOut);
    for path in ["to_file", "a/up", "to_folder/file"] {
        assert_eq!(root.read(path, 100).expect("a file"), b"text");
    }
    assert_eq!(root.read("out", 100), Err(ReadError::LeavesRoot));
    assert_eq!(root.read("absolute", 100), Err(ReadError::LeavesRoot));
    assert!(root.read("circle", 100).is_err());
}

#[test]
fn rehash_says_that_it_writes_to_no_archive() {
    let folder = testkit::temporary::folder();
    let zip = folder.path().join("arm.zip");
    let bytes = pack(&arm(), "");
    fs::write(&zip, &bytes).expect("written");
    let output = urdd(&["rehash"], &zip);
    assert_eq!(output.status.code(), Some(2));
    let words = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(words.contains("unpack it"), "{words}");
    assert!(fs::read(&zip).expect("it") == bytes);
}
