//! What a file is: by its first bytes, before any text in it.

use std::fs;
use std::path::Path;

use urdd_directory::file_type::{Format, RobotFile, is_archive};

const ROBOT: &[u8] = b"<robot name='a'/>";

fn kind(name: &str, start: &[u8]) -> Option<RobotFile> {
    RobotFile::of(Path::new(name), &[start, ROBOT].concat())
}

#[test]
fn what_is_stored_in_a_binary_file_is_not_what_it_is() {
    let usd = Some(RobotFile::Imported(Format::Usd));
    for start in [&b"PK\x03\x04"[..], b"PK\x05\x06"] {
        for name in ["a.zip", "a", "a.xml", "a.urdf", "a.xacro", "a.srdf", "a.mjcf"] {
            assert_eq!(kind(name, start), None, "{name}");
        }
        assert_eq!((kind("a.usdz", start), kind("a.USD", start)), (usd, usd));
    }
    for start in [
        &b"glTF\x02\0\0\0"[..],
        b"\x89PNG\r\n",
        b"\xff\xd8\xff\xe0",
        b"%PDF-1.7\n",
        b"\x1f\x8b\x08",
    ] {
        assert_eq!((kind("a", start), kind("a.xml", start)), (None, None), "{start:?}");
        // Then its name is all that there is.
        assert_eq!(kind("a.urdf", start), Some(RobotFile::Urdf), "{start:?}");
    }
    assert_eq!((kind("a.xml", b"#usda 1.0\n"), kind("a.txt", b"PXR-USDC")), (usd, usd));
    for start in [&b""[..], b"\xef\xbb\xbf", b"\n", b"<!-- PK\x03\x04 -->"] {
        assert_eq!(kind("a.xml", start), Some(RobotFile::Urdf), "{start:?}");
    }
}

#[test]
fn an_archive_is_one_whatever_it_is_called() {
    let folder = tempfile::tempdir().unwrap();
    let is = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).expect("written");
        is_archive(&path)
    };
    let stored = [b"PK\x03\x04", ROBOT].concat();
    assert!(is("a.zip", &stored) && is("a.urdf", &stored) && is("b", b"PK\x05\x06"));
    // A package of USD is a robot's description, and what is only called an archive may be one.
    assert!(
        !is("a.usdz", &stored) && !is("c.zip", ROBOT) && is("d.zip", b"") && is("e.zip", b"PK")
    );
    assert!(!is_archive(folder.path()) && !is_archive(&folder.path().join("none.zip")));
}
