//! The first twelve bytes of a binary glTF.

/// Length of a GLB's header: magic, version, length.
pub const HEADER: usize = 12;

/// The fault of the GLB header of a file of `size` bytes.
pub fn header_fault(header: &[u8], size: u64) -> Option<String> {
    let word = |at: usize| {
        let bytes = header.get(at..at + 4)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?))
    };
    if header.starts_with(b"{") {
        return Some("it is glTF as JSON (a .gltf file)".to_owned());
    }
    if header.starts_with(b"version http") {
        return Some("it is a Git LFS pointer; fetch the file itself".to_owned());
    }
    if !header.starts_with(b"glTF") {
        return Some("it does not begin with `glTF`".to_owned());
    }
    match (word(4), word(8)) {
        (Some(2), Some(length)) if u64::from(length) == size => None,
        (Some(2), Some(length)) => {
            Some(format!("its header says {length} bytes, and it has {size}"))
        }
        (Some(version), Some(_)) => Some(format!("it is of glTF version {version}")),
        _ => Some(format!("it has only {} bytes", header.len())),
    }
}

#[cfg(test)]
mod tests {
    use super::header_fault;

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
}
