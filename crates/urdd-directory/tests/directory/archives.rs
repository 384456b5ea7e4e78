//! Archives as people's programs pack them. `testkit/archives/make.py` made these.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use urdd_directory::limits::MAX_ARCHIVE_BYTES;
use urdd_directory::listing::EntryKind;
use urdd_directory::listing::ReadError;
use urdd_directory::listing::{ArchiveFault, EntryFault};
use urdd_directory::root::Root;
use urdd_directory::source::Archive;

fn archives() -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../testkit/archives");
    let paths =
        fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let zips = paths.filter(|path| path.extension().is_some_and(|extension| extension == "zip"));
    let named = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
    let mut all: Vec<_> = zips.map(|path| (named(&path), fs::read(path).unwrap())).collect();
    all.sort();
    all
}

#[test]
fn archives_of_every_program_have_the_same_files() {
    let found = archives();
    assert_eq!(found.len(), 10, "Info-ZIP, Git, 7-Zip, libarchive, macOS, Windows");
    for (name, bytes) in found {
        let root =
            Root::of(Archive::of_any("", bytes).unwrap_or_else(|error| panic!("{name}: {error}")));
        let entries = root.list().expect("a list").entries;
        let files = entries.iter().filter(|entry| entry.kind == EntryKind::File);
        let paths = files.map(|entry| entry.path.trim_start_matches("arm-main/"));
        let paths: Vec<&str> = paths.filter(|path| !path.ends_with(".DS_Store")).collect();
        let expected = ["meshes/base.stl", "meshes/äußen.stl", "package.xml", "urdf/arm.urdf"];
        assert_eq!(paths, expected.map(|path| format!("arm_description/{path}")), "{name}");
    }
}

#[test]
fn what_is_no_urdd_is_none_however_it_is_packed() {
    for (name, bytes) in archives() {
        let error = Archive::new("robot", Arc::<[u8]>::from(bytes)).expect_err("no URDD");
        assert_eq!(error, ArchiveFault::NoUrdd, "{name}: {error}");
    }
}

/// An archive of entries that are not compressed: names, modes and content.
fn stored(entries: &[(&str, u32, &[u8])]) -> Vec<u8> {
    let (mut bytes, mut list) = (Vec::new(), Vec::new());
    let word = |number: usize| u32::try_from(number).unwrap().to_le_bytes();
    let short = |number: usize| u16::try_from(number).unwrap().to_le_bytes();
    for (name, mode, content) in entries {
        let mut crc = flate2::Crc::new();
        crc.update(content);
        let size = word(content.len());
        let common =
            [&[0; 8][..], &crc.sum().to_le_bytes(), &size, &size, &short(name.len())].concat();
        let start = word(bytes.len());
        let head = [&b"PK\x03\x04\x14\0"[..], &common, &[0; 2], name.as_bytes(), content].concat();
        bytes.extend(head);
        // Version 3: made by Unix, whose modes are in the upper half of the attributes.
        let listed =
            [&b"PK\x01\x02\x14\x03\x14\0"[..], &common, &[0; 8], &(mode << 16).to_le_bytes()];
        list.extend([&listed.concat()[..], &start, name.as_bytes()].concat());
    }
    let (count, size, start) = (short(entries.len()), word(list.len()), word(bytes.len()));
    let end = [&b"PK\x05\x06\0\0\0\0"[..], &count, &count, &size, &start, &[0; 2]].concat();
    [bytes, list, end].concat()
}

const FILE: u32 = 0o100_644;

#[test]
fn what_an_archive_states_is_not_believed() {
    let metadata = ("urdd.json", FILE, &b"{}"[..]);
    let open = |bytes: Vec<u8>| Archive::new("robot", bytes).map(|_| ());
    assert_eq!(open(stored(&[metadata])), Ok(()));
    // A link may be as long as a path.
    for (length, is_read) in [(4096, true), (4097, false)] {
        let found = open(stored(&[metadata, ("link", 0o120_777, &vec![b'a'; length])]));
        let is_too_large = matches!(
            found,
            Err(ArchiveFault::Entry { fault: EntryFault::TooLarge { limit: 4096, .. }, .. })
        );
        assert_eq!((found.is_ok(), is_too_large), (is_read, !is_read), "{length}");
    }
    // Another number of entries than there are.
    let mut bytes = stored(&[metadata]);
    let end = bytes.len() - 22;
    (bytes[end + 8], bytes[end + 10]) = (2, 2);
    assert_eq!(open(bytes), Err(ArchiveFault::Count { stated: 2, listed: 1 }));
    // The content of a file is the end of an archive without entries that begins there.
    let end = |start: u8| [&b"PK\x05\x06"[..], &[0; 12], &[start, 0, 0, 0, 0, 0]].concat();
    assert_eq!(open(stored(&[("a", FILE, &end(32)), metadata])), Ok(()));
    let other = open(stored(&[("a", FILE, &end(31)), metadata]));
    assert_eq!(other, Err(ArchiveFault::OtherBytes));
}

/// SPEC 2.14: a name may go about inside of the archive, and no path is there twice.
#[test]
fn names_stay_inside_on_every_system() {
    let open = |name: &str| {
        let entries = [("urdd.json", FILE, &b"{}"[..]), ("b/c", FILE, b""), (name, FILE, b"")];
        let archive = Archive::new("robot", stored(&entries)).map_err(|error| match error {
            ArchiveFault::Entry { fault, .. } => fault,
            other => panic!("{name:?}: {other}"),
        })?;
        let entries = Root::of(archive).list().expect("a list").entries;
        let files = entries.into_iter().filter(|entry| entry.kind == EntryKind::File);
        Ok(files.map(|file| file.path).find(|path| !matches!(&**path, "urdd.json" | "b/c")))
    };
    for (name, path) in [
        ("./a", "a"),
        ("b//a", "b/a"),
        ("b/../a", "a"),
        ("x/.././y/./a", "y/a"),
        ("a\\b", "a\\b"),
        ("b\\..\\a", "b\\..\\a"),
        ("ab:c", "ab:c"),
        ("..a", "..a"),
    ] {
        assert_eq!(open(name), Ok(Some(path.to_owned())), "{name:?}");
    }
    // Those that name the archive itself are folders, whatever is in them.
    assert_eq!((open("./"), open("b/..")), (Ok(None), Ok(None)));
    for name in ["../a", "b/../../a", "/a", "\\a", "..\\a", "b\\..\\..\\a", "C:a", "c:/a", "a\0"] {
        assert_eq!(open(name), Err(EntryFault::Path), "{name:?}");
    }
    for name in ["b/./c", "b//c", "d/../b/c", "./urdd.json"] {
        assert_eq!(open(name), Err(EntryFault::Duplicate), "{name:?}");
    }
}

/// SPEC 2.14 allows no zip64: not for an entry whose list has its sizes either, as Python's `force_zip64` writes it.
#[test]
fn sizes_in_an_extra_field_are_of_zip64() {
    let mut bytes = stored(&[("urdd.json", FILE, b"{}")]);
    assert!(Archive::new("robot", bytes.clone()).is_ok());
    bytes[18..26].fill(0xff);
    assert_eq!(Archive::new("robot", bytes.clone()).err(), Some(ArchiveFault::Zip64));
    assert!(Archive::of_any("robot", bytes).is_ok(), "what other programs pack is read");
}

/// After an entry whose flags allow a data descriptor there may be one, and no other bytes.
#[test]
fn a_data_descriptor_states_checksum_and_sizes() {
    let whole = stored(&[("urdd.json", FILE, b"{}")]);
    let [size, crc] = [18, 14].map(|at| <[u8; 4]>::try_from(&whole[at..at + 4]).unwrap());
    let narrow = [crc, size, size].concat();
    let wide = [&crc[..], &size, &[0; 4], &size, &[0; 4]].concat();
    let after = |descriptor: &[u8]| {
        let (entry, rest) = whole.split_at(30 + "urdd.json{}".len());
        let mut bytes = [entry, descriptor, rest].concat();
        bytes[6] = 1 << 3;
        let list = entry.len() + descriptor.len();
        bytes[list + 8] = 1 << 3;
        let start = bytes.len() - 6;
        bytes[start] = list.try_into().unwrap();
        Archive::new("robot", bytes).map(|_| ())
    };
    for form in [narrow, wide] {
        for right in [form.clone(), [b"PK\x07\x08", &form[..]].concat()] {
            assert_eq!(after(&right), Ok(()), "{right:?}");
            for at in 0..right.len() {
                let mut other = right.clone();
                other[at] ^= 1;
                assert_eq!(after(&other), Err(ArchiveFault::OtherBytes), "{other:?}");
            }
            assert_eq!(after(&right[1..]), Err(ArchiveFault::OtherBytes), "{right:?}");
        }
    }
    assert_eq!(after(&[]), Ok(()), "some programs set the flag of an entry without one");
    assert_eq!(after(&[0; 24]), Err(ArchiveFault::OtherBytes));
}

#[test]
fn an_archive_beyond_the_limit_is_not_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.zip");
    // Without its bytes, which are a hole.
    fs::File::create(&path).unwrap().set_len(MAX_ARCHIVE_BYTES + 1).unwrap();
    let (size, limit) = (MAX_ARCHIVE_BYTES + 1, MAX_ARCHIVE_BYTES);
    assert_eq!(Archive::open(&path).err(), Some(ReadError::TooLarge { size, limit }));
}
