//! The first twelve bytes of a binary glTF.

use urdd_validate::solids::glb_header::header_fault;

fn header(version: u32, length: u32) -> Vec<u8> {
    let mut header = b"glTF".to_vec();
    header.extend(version.to_le_bytes());
    header.extend(length.to_le_bytes());
    header
}

#[test]
fn a_header_is_sound_only_with_magic_version_and_length() {
    assert_eq!(header_fault(&header(2, 100), 100), None);
    assert!(header_fault(&header(2, 100), 99).is_some());
    assert!(header_fault(&header(1, 100), 100).is_some());
    assert!(header_fault(b"{\"accessors\"", 5000).is_some());
    assert!(header_fault(b"version http", 130).is_some());
    assert!(header_fault(b"glTF", 4).is_some());
    assert!(header_fault(b"", 0).is_some());
}
