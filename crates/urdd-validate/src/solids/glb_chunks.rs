//! The header of a binary glTF, and the list of its chunks (SPEC 7.6). What the chunks hold is not looked at.

use std::io::{self, Read};

/// Length of the header: magic, version, length of the file.
const HEADER: u64 = 12;
/// Length of what is before a chunk's content: its length and kind.
const CHUNK_HEAD: u64 = 8;

/// The fault of the header or the chunks of a file of `size` bytes. Reads up to the head of the last chunk.
///
/// # Errors
/// If the file cannot be read.
pub fn fault(file: impl Read, size: u64) -> io::Result<Option<String>> {
    let mut file = file.take(size);
    let header = part(&mut file, HEADER)?;
    match header_fault(&header, size) {
        Some(fault) => Ok(Some(fault)),
        None => chunk_fault(&mut file, size),
    }
}

/// The next bytes, fewer where the file ends.
fn part(file: &mut impl Read, length: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(length).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let bytes = bytes.get(at..at + 4)?;
    Some(u32::from_le_bytes(bytes.try_into().ok()?))
}

fn header_fault(header: &[u8], size: u64) -> Option<String> {
    let begins = |text: &[u8]| header.starts_with(text);
    Some(match (word(header, 4), word(header, 8)) {
        _ if begins(b"{") => "it is glTF as JSON (a .gltf file)".to_owned(),
        _ if begins(b"version http") => "it is a Git LFS pointer; fetch the file itself".to_owned(),
        _ if !begins(b"glTF") => "it does not begin with `glTF`".to_owned(),
        (Some(2), Some(length)) if u64::from(length) == size => return None,
        (Some(2), Some(length)) => format!("its header says {length} bytes, and it has {size}"),
        (Some(version), Some(_)) => format!("it is of glTF version {version}"),
        _ => format!("it has only {} bytes", header.len()),
    })
}

/// The fault of the chunks, which follow the header up to the file's end.
fn chunk_fault(file: &mut impl Read, size: u64) -> io::Result<Option<String>> {
    let mut at = HEADER;
    loop {
        let head = part(file, CHUNK_HEAD)?;
        let (Some(length), Some(kind)) = (word(&head, 0), head.get(4..8)) else {
            let what = if at == HEADER { "header" } else { "last chunk" };
            return Ok(Some(format!(
                "{} bytes follow its {what}, too few for a chunk",
                head.len()
            )));
        };
        let (length, room) = (u64::from(length), size.saturating_sub(at + CHUNK_HEAD));
        if at == HEADER && kind != b"JSON" {
            return Ok(Some("its first chunk is not JSON".to_owned()));
        }
        if !length.is_multiple_of(4) {
            let text = "bytes, which is not a multiple of four";
            return Ok(Some(format!("its chunk at byte {at} has {length} {text}")));
        }
        if length > room {
            let text = format!("its chunk at byte {at} says {length} bytes, and {room} follow");
            return Ok(Some(text));
        }
        if length == room {
            return Ok(None);
        }
        at += CHUNK_HEAD + length;
        io::copy(&mut file.by_ref().take(length), &mut io::sink())?;
    }
}
