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
