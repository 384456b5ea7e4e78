//! PNG that MuJoCo 4.0.0 (lodepng) refuses, and other readers take: each was given to it, and what is written here too.

use std::io::Cursor;

use flate2::write::ZlibEncoder;
use flate2::{Compression, Crc};
use std::io::Write;
use urdd_export::Format;
use urdd_robot::Robot;

use crate::made::exported;
use crate::textured_box::obj;

fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let said = [&kind[..], data].concat();
    let mut crc = Crc::new();
    crc.update(&said);
    [&(data.len() as u32).to_be_bytes()[..], &said, &crc.sum().to_be_bytes()].concat()
}

fn broken(mut chunk: Vec<u8>) -> Vec<u8> {
    *chunk.last_mut().expect("a checksum") ^= 1;
    chunk
}

fn deflated(rows: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(rows).expect("written");
    encoder.finish().expect("finished")
}

/// Four by four pixels: depth, colour type, interlacing, chunks before and after the pixels, and these.
fn png(kind: [u8; 3], before: &[u8], data: &[u8], after: &[u8]) -> Vec<u8> {
    let [depth, color, interlace] = kind;
    let header = [0, 0, 0, 4, 0, 0, 0, 4, depth, color, 0, 0, interlace];
    [
        &b"\x89PNG\r\n\x1a\n"[..],
        &chunk(b"IHDR", &header)[..],
        before,
        &chunk(b"IDAT", data),
        after,
        &chunk(b"IEND", b""),
    ]
    .concat()
}

/// Rows of so many bytes each, unfiltered: 0, 1, 2 and so on.
fn rows(bytes: u8) -> Vec<u8> {
    (0..4).flat_map(|row| [0].into_iter().chain((0..bytes).map(move |k| row * bytes + k))).collect()
}

/// The three channels of each pixel.
fn rgb(image: &[u8]) -> Vec<[u8; 3]> {
    let mut decoder = png::Decoder::new(Cursor::new(image));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().expect("PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let size = reader.next_frame(&mut pixels).expect("pixels");
    assert_eq!((size.width, size.height), (4, 4));
    let channels = reader.output_color_type().0.samples();
    let of =
        |pixel: &[u8]| if channels < 3 { [pixel[0]; 3] } else { [pixel[0], pixel[1], pixel[2]] };
    pixels.chunks(channels).map(of).collect()
}

fn chunks(image: &[u8]) -> Vec<(String, Vec<u8>)> {
    let (mut rest, mut found) = (&image[8..], Vec::new());
    while !rest.is_empty() {
        let length = u32::from_be_bytes(rest[..4].try_into().expect("four bytes")) as usize;
        let whole = &rest[..length + 12];
        let kind: [u8; 4] = whole[4..8].try_into().expect("four bytes");
        let data = whole[8..8 + length].to_vec();
        assert_eq!(whole, chunk(&kind, &data), "the checksum");
        found.push((String::from_utf8_lossy(&kind).into_owned(), data));
        rest = &rest[whole.len()..];
    }
    found
}

/// What is written for MuJoCo of an image, and for a reader of URDF.
fn written(image: &[u8]) -> [Option<Vec<u8>>; 2] {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    std::fs::write(at.join("0.png"), image).expect("written");
    obj(at, "a", "0.png", true);
    let urdf = r#"<robot name="box"><link name="l"><visual><geometry><mesh filename="a.obj"/></geometry></visual></link></robot>"#;
    std::fs::write(at.join("box.urdf"), urdf).expect("written");
    urdd_generate::generate(&at.join("box.urdf"), &at.join("urdd"), &Default::default(), &())
        .expect("generated");
    let robot = Robot::open(at.join("urdd")).expect("opened");
    [Format::Mjcf, Format::Urdf].map(|format| {
        let files = exported(&robot, format).files;
        files.into_iter().find(|(path, _)| path.ends_with(".png")).map(|(_, bytes)| bytes)
    })
}

#[test]
fn an_image_without_its_palette_is_none() {
    let data = deflated(&[[0, 1, 1, 1, 1]; 4].concat());
    assert_eq!(written(&png([8, 3, 0], b"", &data, b""))[0], None);
}

#[test]
fn mujoco_gets_the_pixels_without_what_it_refuses() {
    const RGB: [u8; 3] = [8, 2, 0];
    // Seven passes of 1, 0, 0, 1, 2, 2 times 2 and 2 times 4 pixels.
    const INTERLACED: [u8; 23] =
        [0, 7, 0, 7, 0, 7, 7, 0, 7, 7, 0, 7, 7, 0, 7, 7, 7, 7, 0, 7, 7, 7, 7];
    let all: Vec<[u8; 3]> = (0..16).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let grey = |step: u8| (0..16).map(|k| [k * step; 3]).collect::<Vec<_>>();
    let palette = chunk(b"PLTE", &(0..48).collect::<Vec<u8>>());
    let data = deflated(&rows(12));
    let mut wrong_sum = data.clone();
    *wrong_sum.last_mut().expect("a checksum") ^= 1;
    let of = |before: &[u8]| png(RGB, before, &data, b"");
    type Case = (&'static str, Vec<u8>, Vec<[u8; 3]>);
    let cases: Vec<Case> = vec![
        ("significant bits, too many", of(&chunk(b"sBIT", &[9, 8, 8])), all.clone()),
        ("significant bits of another type", of(&chunk(b"sBIT", &[8])), all.clone()),
        ("gamma", of(&chunk(b"gAMA", &[0])), all.clone()),
        ("chromaticities", of(&chunk(b"cHRM", &[0])), all.clone()),
        ("rendering intent", of(&chunk(b"sRGB", &[0, 0])), all.clone()),
        ("profile", of(&chunk(b"iCCP", b"x\0\0garbage")), all.clone()),
        ("text", of(&chunk(b"tEXt", b"")), all.clone()),
        ("compressed text", of(&chunk(b"zTXt", b"a\0\0xx")), all.clone()),
        ("time", of(&chunk(b"tIME", b"a")), all.clone()),
        ("size of pixels", of(&chunk(b"pHYs", b"a")), all.clone()),
        ("background", of(&chunk(b"bKGD", b"a")), all.clone()),
        ("after the pixels", png(RGB, b"", &data, &chunk(b"tEXt", b"")), all.clone()),
        ("checksum of a text", of(&broken(chunk(b"tEXt", b"a\0b"))), all.clone()),
        ("checksum of the intent", of(&broken(chunk(b"sRGB", &[0]))), all.clone()),
        ("transparent colour", of(&chunk(b"tRNS", &[0])), all.clone()),
        ("checksum of the pixels", png(RGB, b"", &wrong_sum, b""), all.clone()),
        (
            "data after the last pixel",
            png(RGB, b"", &deflated(&[rows(12), vec![0; 50]].concat()), b""),
            all.clone(),
        ),
        (
            "data after the compressed",
            png(RGB, b"", &[&data[..], b"junk"].concat(), b""),
            all.clone(),
        ),
        (
            "more transparencies than colours",
            png(
                [8, 3, 0],
                &[palette.clone(), chunk(b"tRNS", &[0; 40])].concat(),
                &deflated(&[[0; 5]; 4].concat()),
                b"",
            ),
            vec![[0, 1, 2]; 16],
        ),
        // MuJoCo takes these as they are.
        ("plain", of(b""), all.clone()),
        (
            "palette",
            png([8, 3, 0], &palette, &deflated(&[[0, 1, 1, 1, 1]; 4].concat()), b""),
            vec![[3, 4, 5]; 16],
        ),
        ("grey", png([8, 0, 0], b"", &deflated(&rows(4)), b""), grey(1)),
        ("grey and opacity", png([8, 4, 0], b"", &deflated(&rows(8)), b""), grey(2)),
        ("16 bits of grey", png([16, 0, 0], b"", &deflated(&rows(8)), b""), grey(2)),
        ("interlaced", png([8, 0, 1], b"", &deflated(&INTERLACED), b""), vec![[7; 3]; 16]),
    ];
    for (name, image, pixels) in cases {
        let [mujoco, others] = written(&image).map(|image| image.expect(name));
        assert_eq!(others, image, "{name}");
        assert_eq!(rgb(&mujoco), pixels, "{name}");
        let found = chunks(&mujoco);
        let data: Vec<u8> = found
            .iter()
            .filter(|(kind, _)| kind == "IDAT")
            .flat_map(|(_, data)| data.clone())
            .collect();
        for (kind, data) in &found {
            let is_known = ["IHDR", "PLTE", "IDAT", "IEND"].contains(&kind.as_str());
            // What an encoder writes beside `sRGB` says the same in other words.
            assert!(is_known || (kind == "sRGB" && data.len() == 1), "{name}: {kind}");
        }
        let info = png::Decoder::new(Cursor::new(&mujoco)).read_info().expect("PNG");
        let rows = 4 * info.info().raw_row_length();
        let mut inflated = Vec::new();
        let mut decoder = flate2::read::ZlibDecoder::new(&data[..]);
        std::io::Read::read_to_end(&mut decoder, &mut inflated).expect("sound data");
        assert_eq!((inflated.len(), decoder.total_in()), (rows, data.len() as u64), "{name}");
        if name == "plain" || name == "palette" || name == "grey" {
            assert_eq!(mujoco, image, "{name}");
        }
    }
    // MuJoCo takes the colour space of an image from it.
    let said = of(&chunk(b"sRGB", &[0]));
    assert_eq!(written(&said), [Some(said.clone()), Some(said)]);
}
