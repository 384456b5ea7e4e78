//! Sizes and hashes of files, and comparison with stated values, in bounded memory.

use urdd_directory::file_entry::*;
use urdd_directory::root::Root;

fn sha256(bytes: &[u8]) -> String {
    hashes(&mut &bytes[..], false).unwrap().plain
}

#[test]
fn converted_line_endings_are_known_across_buffers() {
    let mut text = Vec::new();
    for i in 0..20_000 {
        text.extend_from_slice(format!("line {i}\n").as_bytes());
    }
    text.extend_from_slice(b"a lone \r is no line end\r");
    let dos = String::from_utf8(text.clone()).unwrap().replace('\n', "\r\n");
    let from_dos = hashes(&mut dos.as_bytes(), true).unwrap();
    assert_eq!(from_dos.lf.unwrap(), sha256(&text));
    let to_dos = hashes(&mut &text[..], true).unwrap();
    assert_eq!(to_dos.crlf.unwrap(), sha256(dos.as_bytes()));
}

#[test]
fn tells_what_became_of_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let root = Root::open(folder.path()).unwrap();
    let compare = |now: &[u8], then: &[u8]| {
        std::fs::write(folder.path().join("f"), now).unwrap();
        compare(&root, "f", then.len() as u64, &sha256(then))
    };
    assert_eq!(compare(b"a\nb\n", b"a\nb\n"), None);
    assert_eq!(compare(b"a\nb\n", b"a\r\nb\r\n"), Some(Change::LineEndings));
    assert_eq!(compare(b"a\r\nb\r\n", b"a\nb\n"), Some(Change::LineEndings));
    assert_eq!(compare(b"abc\n", b"abc"), Some(Change::Size(4)));
    assert_eq!(compare(b"a", &[0; 100]), Some(Change::Size(1)));
    assert!(matches!(compare(b"a", b"b"), Some(Change::Hash(_))));
    let pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n";
    assert_eq!(compare(pointer, b"solid"), Some(Change::LfsPointer));
}
