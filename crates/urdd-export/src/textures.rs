//! The textures of visual geometry: which can be written, and how.

use std::collections::{BTreeMap, HashSet};
use std::io::{Cursor, Read, copy, sink};
use std::sync::Arc;

use flate2::Crc;
use flate2::read::ZlibDecoder;
use png::{ColorType, Decoder, DecodingError, Encoder, Info, Transformations, Writer};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use crate::{ExportError, Format, Note, Subject};
use urdd_geometry::Mesh;
use urdd_geometry::read::{Part, Texture};

/// An image as it is written.
#[derive(Debug, Clone)]
pub(super) struct Image {
    pub bytes: Arc<[u8]>,
    pub ending: &'static str,
    is_converted: bool,
}

/// The images of a robot. Each is decoded once: a program refuses a whole robot for an image that is broken.
pub(super) struct Images<'a> {
    subject: &'a Subject<'a>,
    by_name: BTreeMap<String, Option<Image>>,
    /// Pixels that may still be decoded.
    pixels: u64,
    lost: Vec<Note>,
}

/// Limits of one image, and of all of a robot, pixels: a small file can have a huge image.
const MAX_PIXELS: u64 = 1 << 26;
const MAX_ALL_PIXELS: u64 = 1 << 29;

const MISSING: &str = "the URDD does not carry it";
const NO_UV: &str = "its mesh does not say where it is on the surface";
const NO_TRIANGLE: &str = "the link's plain mesh has other triangles";
const BROKEN: &str = "it is not an image, or broken";
const LARGE: &str =
    "it has more than 67 million pixels, or all textures have more than 537 million";

impl<'a> Images<'a> {
    pub fn new(subject: &'a Subject<'a>) -> Self {
        let by_name = BTreeMap::new();
        Images { subject, by_name, pixels: MAX_ALL_PIXELS, lost: Vec::new() }
    }

    /// The plain parts of a link, in which textured parts replace the same triangles where there is an image.
    pub fn painted(
        &mut self,
        mut plain: Vec<Part>,
        textured: Vec<Part>,
    ) -> Result<Vec<(Part, Option<Image>)>, ExportError> {
        let [mut known, mut painted] = [HashSet::new(), HashSet::new()];
        if !textured.is_empty() {
            known.extend(plain.iter().flat_map(|part| places(&part.mesh)));
        }
        let mut found = Vec::new();
        for mut part in textured {
            keep(&mut part.mesh, |triangle| known.contains(triangle));
            let texture = part.texture.as_ref();
            let image =
                texture.map(|texture| self.image(texture, &part.mesh)).transpose()?.flatten();
            if image.is_some() {
                painted.extend(places(&part.mesh));
                found.push((part, image));
            }
        }
        if !painted.is_empty() {
            plain.iter_mut().for_each(|part| keep(&mut part.mesh, |it| !painted.contains(it)));
            plain.retain(|part| !part.mesh.triangles.is_empty());
        }
        Ok(plain.into_iter().map(|part| (part, None)).chain(found).collect())
    }

    /// What became of textures that are not as they were.
    pub fn notes(self) -> Vec<Note> {
        let is_converted = |image: &Option<Image>| image.as_ref().is_some_and(|of| of.is_converted);
        let converted = self.by_name.into_iter().filter(|(_, image)| is_converted(image));
        let textures: Vec<String> = converted.map(|(name, _)| name).collect();
        let mut notes = self.lost;
        if !textures.is_empty() {
            notes.push(Note::ConvertedTextures(textures));
        }
        notes
    }

    /// The image of a texture of a mesh, unless it cannot be written.
    fn image(&mut self, texture: &Texture, mesh: &Mesh) -> Result<Option<Image>, ExportError> {
        let name = &texture.name;
        if !self.by_name.contains_key(name) {
            let bytes = match &texture.embedded {
                Some(bytes) => Some(bytes.to_vec()),
                None => self.subject.robot.listed_file(name)?,
            };
            let image = bytes.ok_or(MISSING.to_owned()).and_then(|bytes| self.decoded(bytes));
            let image = image.map_err(|reason| self.lost(name, reason)).ok();
            self.by_name.insert(name.clone(), image);
        }
        let is_placed = !texture.uv.is_empty() && !mesh.triangles.is_empty();
        let image = self.by_name[name].clone();
        if image.is_some() && !is_placed {
            let reason = if texture.uv.is_empty() { NO_UV } else { NO_TRIANGLE };
            self.lost(name, reason.to_owned());
        }
        Ok(image.filter(|_| is_placed))
    }

    fn lost(&mut self, texture: &str, reason: String) {
        let note = Note::LostTexture { texture: texture.to_owned(), reason };
        if !self.lost.contains(&note) {
            self.lost.push(note);
        }
    }

    fn decoded(&mut self, bytes: Vec<u8>) -> Result<Image, String> {
        if bytes.starts_with(b"\x89PNG") {
            let mut decoder = png::Decoder::new(Cursor::new(&bytes[..]));
            let size = decoder.read_header_info().map_err(|_| BROKEN)?.size();
            self.take(size)?;
            let mut reader = decoder.read_info().map_err(|_| BROKEN)?;
            while reader.next_row().map_err(|_| BROKEN)?.is_some() {}
            reader.finish().map_err(|_| BROKEN)?;
            let bytes = match self.subject.format {
                Format::Mjcf => for_mujoco(&bytes).map_err(|_| BROKEN)?,
                _ => bytes,
            };
            return Ok(Image { bytes: bytes.into(), ending: "png", is_converted: false });
        }
        if !bytes.starts_with(&[0xff, 0xd8, 0xff]) {
            let kind = imagesize::image_type(&bytes).map_err(|_| BROKEN)?;
            return Err(format!(
                "it is {kind:?}, not PNG or JPEG; convert it, and generate the URDD again"
            ));
        }
        // What is cut off lacks the mark of its end, and is decoded all the same.
        let end = &bytes[bytes.len().saturating_sub(1024)..];
        if !end.windows(2).any(|mark| mark == [0xff, 0xd9]) {
            return Err(BROKEN.to_owned());
        }
        let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGB);
        let mut decoder = JpegDecoder::new_with_options(ZCursor::new(&bytes[..]), options);
        decoder.decode_headers().map_err(|_| BROKEN)?;
        let size = decoder.info().ok_or(BROKEN)?;
        let [width, height] = [size.width, size.height].map(u32::from);
        self.take((width, height))?;
        let pixels = decoder.decode().map_err(|_| BROKEN)?;
        if !matches!(self.subject.format, Format::Mjcf | Format::Drake | Format::Sdf) {
            return Ok(Image { bytes: bytes.into(), ending: "jpg", is_converted: false });
        }
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, width, height);
        encoder.set_color(png::ColorType::Rgb);
        let write = |mut writer: png::Writer<_>| writer.write_image_data(&pixels);
        encoder.write_header().and_then(write).map_err(|_| BROKEN)?;
        Ok(Image { bytes: png.into(), ending: "png", is_converted: true })
    }

    fn take(&mut self, (width, height): (u32, u32)) -> Result<(), String> {
        let pixels = u64::from(width) * u64::from(height);
        let left = self.pixels.checked_sub(pixels).filter(|_| pixels <= MAX_PIXELS);
        self.pixels = left.ok_or(LARGE)?;
        Ok(())
    }
}

/// Where the corners of each triangle are, in any order; what is nearly 0 is 0, since it may be what rounding left.
fn places(mesh: &Mesh) -> impl Iterator<Item = [[u32; 3]; 3]> {
    let bits = |x: f64| if x.abs() < 1e-9 { 0 } else { (x as f32).to_bits() };
    mesh.triangles.iter().map(move |triangle| {
        let mut corners = mesh.corners(*triangle).map(|corner| corner.map(bits));
        corners.sort_unstable();
        corners
    })
}

fn keep(mesh: &mut Mesh, is_wanted: impl Fn(&[[u32; 3]; 3]) -> bool) {
    let wanted: Vec<bool> = places(mesh).map(|triangle| is_wanted(&triangle)).collect();
    let mut wanted = wanted.into_iter();
    mesh.triangles.retain(|_| wanted.next() == Some(true));
}

const SIGNATURE: usize = 8;
/// Length, type and checksum of a chunk.
const FRAME: usize = 12;

/// The same pixels, in a file that MuJoCo reads. Its reader (lodepng) refuses an image for a fault in a chunk that says
/// nothing of pixels, a wrong checksum, or data after the last pixel, which other readers pass over. The image was decoded
/// before: it is as large as it says.
fn for_mujoco(bytes: &[u8]) -> Result<Vec<u8>, DecodingError> {
    stripped(bytes).map_or_else(|| written_anew(bytes), Ok)
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
    let Ok(header) = Decoder::new(Cursor::new(image)).read_info() else { return false };
    let info = header.info();
    if info.color_type == ColorType::Indexed && info.palette.is_none() {
        return false;
    }
    let expected = (info.raw_row_length() as u64).checked_mul(u64::from(info.height));
    let Some(expected) = expected.filter(|_| !info.interlaced) else { return false };
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
