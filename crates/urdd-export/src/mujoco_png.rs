//! PNG as MuJoCo's reader (lodepng) takes it: it refuses an image for a fault in a chunk that says nothing of pixels, a
//! wrong checksum, or data after the last pixel, which other readers pass over.

use std::io::{Cursor, Read, copy, sink};

use flate2::Crc;
use flate2::read::ZlibDecoder;
use png::{ColorType, Decoder, DecodingError, Encoder, Info, Transformations, Writer};

const SIGNATURE: usize = 8;
/// Length, type and checksum of a chunk.
const FRAME: usize = 12;

/// The same pixels, in a file that MuJoCo reads. The image was decoded before: it is as large as it says.
pub(super) fn for_mujoco(bytes: &[u8]) -> Result<Vec<u8>, DecodingError> {
    match stripped(bytes) {
        Some(bytes) => Ok(bytes),
        None => written_anew(bytes),
    }
}

/// The image without chunks that say nothing of pixels; `None` if its pixels have to be written anew.
fn stripped(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut kept = bytes.get(..SIGNATURE)?.to_vec();
    let mut pixels = Vec::new();
    let mut rest = bytes.get(SIGNATURE..)?;
    loop {
        let length = u32::from_be_bytes(*rest.first_chunk()?);
        let length = usize::try_from(length).ok()?;
        let chunk = rest.get(..length.checked_add(FRAME)?)?;
        rest = rest.get(chunk.len()..)?;
        let (kind, data) = chunk.get(4..chunk.len() - 4)?.split_at_checked(4)?;
        let is_sound = has_checksum(chunk);
        match kind {
            // It may say of a pixel that it is transparent.
            b"tRNS" => return None,
            b"IHDR" | b"PLTE" | b"IEND" if is_sound => kept.extend(chunk),
            b"IDAT" if is_sound => {
                kept.extend(chunk);
                pixels.extend(data);
            }
            b"sRGB" if is_sound && length == 1 => kept.extend(chunk),
            _ => {}
        }
        if kind == b"IEND" {
            return is_exact(&kept, &pixels).then_some(kept);
        }
    }
}

fn has_checksum(chunk: &[u8]) -> bool {
    let Some((said, checksum)) = chunk.get(4..).and_then(<[u8]>::split_last_chunk::<4>) else {
        return false;
    };
    let mut crc = Crc::new();
    crc.update(said);
    crc.sum() == u32::from_be_bytes(*checksum)
}

/// Whether the compressed pixels are as many as the header says, with nothing after them.
fn is_exact(image: &[u8], pixels: &[u8]) -> bool {
    let Ok(header) = Decoder::new(Cursor::new(image)).read_info() else {
        return false;
    };
    let info = header.info();
    if info.color_type == ColorType::Indexed && info.palette.is_none() {
        return false;
    }
    let expected = (info.raw_row_length() as u64).checked_mul(u64::from(info.height));
    let Some(expected) = expected.filter(|_| !info.interlaced) else {
        return false;
    };
    let mut decoder = ZlibDecoder::new(pixels);
    let count = copy(&mut decoder.by_ref().take(expected + 1), &mut sink());
    count.is_ok_and(|count| count == expected) && decoder.total_in() == pixels.len() as u64
}

/// The pixels in a new file, with 8 bits a channel: MuJoCo has no more.
fn written_anew(bytes: &[u8]) -> Result<Vec<u8>, DecodingError> {
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::normalize_to_color8());
    let mut reader = decoder.read_info()?;
    let size = reader.output_buffer_size().ok_or(DecodingError::LimitsExceeded)?;
    let mut pixels = vec![0; size];
    let frame = reader.next_frame(&mut pixels)?;
    let mut info = Info::with_size(frame.width, frame.height);
    (info.color_type, info.bit_depth) = reader.output_color_type();
    info.srgb = reader.info().srgb;
    let mut written = Vec::new();
    let write = |mut writer: Writer<_>| writer.write_image_data(&pixels);
    let done =
        Encoder::with_info(&mut written, info).and_then(Encoder::write_header).and_then(write);
    done.map(|()| written).map_err(|_| DecodingError::LimitsExceeded)
}
