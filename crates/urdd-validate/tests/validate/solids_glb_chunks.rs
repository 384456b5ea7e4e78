//! The header of a binary glTF, and its chunks.

use urdd_validate::solids::file::glb_fault;

/// Kind, stated length, content.
type Chunk = (&'static [u8; 4], u32, &'static [u8]);

fn header(version: u32, length: usize) -> Vec<u8> {
    let mut header = b"glTF".to_vec();
    header.extend(version.to_le_bytes());
    header.extend((length as u32).to_le_bytes());
    header
}

fn glb(chunks: &[Chunk]) -> Vec<u8> {
    let mut rest = Vec::new();
    for (kind, length, content) in chunks {
        rest.extend(length.to_le_bytes());
        rest.extend(*kind);
        rest.extend(*content);
    }
    [header(2, 12 + rest.len()), rest].concat()
}

fn fault(bytes: &[u8]) -> Option<String> {
    fault_in(bytes, bytes.len() as u64)
}

fn fault_in(bytes: &[u8], size: u64) -> Option<String> {
    glb_fault(bytes, size).expect("bytes can be read")
}

#[test]
fn a_header_is_sound_only_with_magic_version_and_length() {
    let sound = glb(&[(b"JSON", 4, b"null")]);
    assert_eq!(fault(&sound), None);
    for (bytes, size, words) in [
        (sound.clone(), 23, "says 24 bytes"),
        (header(1, 12), 12, "version 1"),
        (b"{\"accessors\"".to_vec(), 5000, "as JSON"),
        (b"version http".to_vec(), 130, "Git LFS"),
        (b"glTF".to_vec(), 4, "only 4 bytes"),
        (Vec::new(), 0, "begin with"),
    ] {
        let fault = fault_in(&bytes, size).expect("a fault");
        assert!(fault.contains(words), "{fault}");
    }
}

#[test]
fn chunks_follow_one_another_up_to_the_end() {
    let json: Chunk = (b"JSON", 4, b"null");
    let bin: Chunk = (b"BIN\0", 8, &[0; 8]);
    let sound: [&[Chunk]; 4] =
        [&[json], &[json, bin], &[json, bin, (b"XTRA", 0, b"")], &[json, bin, json]];
    for chunks in sound {
        assert_eq!(fault(&glb(chunks)), None);
    }
    let faulty: [(&[Chunk], &str); 6] = [
        (&[], "0 bytes follow its header"),
        (&[bin, json], "first chunk is not JSON"),
        (&[(b"JSON", 5, b"null "), bin], "byte 12 has 5 bytes, which is not a multiple of four"),
        (&[json, (b"BIN\0", 12, &[0; 8])], "byte 24 says 12 bytes, and 8 follow"),
        (&[json, (b"BIN\0", u32::MAX - 3, &[0; 8])], "and 8 follow"),
        (&[json, (b"BIN\0", 4, &[0; 8])], "4 bytes follow its last chunk"),
    ];
    for (chunks, words) in faulty {
        let fault = fault(&glb(chunks)).expect("a fault");
        assert!(fault.contains(words), "{fault}");
    }
    // A file that ends earlier than its size says.
    let cut = &glb(&[json, bin])[..20];
    assert!(fault_in(cut, 40).is_some());
}
