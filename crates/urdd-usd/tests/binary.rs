//! Crate files and packages: the same as text, and damaged in each place.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests")]

mod common;

use std::io::{Cursor, Write};
use std::sync::Arc;

use common::{Memory, find, memory, said, take};
use urdd_usd::{Authored, Stage, UsdError, Value, file, open};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

const ARM: &str = include_str!("fixtures/arm.usda");
const ARM_CRATE: &[u8] = include_bytes!("fixtures/arm.usdc");
const ARM_ZIP: &[u8] = include_bytes!("fixtures/arm.usdz");
const KINDS: &str = include_str!("fixtures/kinds.usda");
const KINDS_CRATE: &[u8] = include_bytes!("fixtures/kinds.usdc");

fn binary(name: &str, bytes: &[u8]) -> (Result<Stage, UsdError>, Memory) {
    let mut files = memory(&[("arm.usda", ARM)]);
    files.files.insert(name.to_owned(), Arc::from(bytes));
    (open(name, &mut files), files)
}

#[test]
fn crate_files_say_what_text_says() {
    let text = common::stage(&[("kinds.usda", KINDS), ("arm.usda", ARM)]).unwrap();
    let crated = binary("kinds.usdc", KINDS_CRATE).0.unwrap();
    let (text, crated) = (said(&text), said(&crated));
    assert!(text.len() > 70, "{}", text.len());
    for (one, other) in text.iter().zip(&crated) {
        assert_eq!(one, other);
    }
    assert_eq!(text.len(), crated.len());
}

#[test]
fn values_of_crate_files() {
    let stage = binary("kinds.usdc", KINDS_CRATE).0.unwrap();
    let kinds = &stage.prims[find(&stage, "/Kinds").unwrap()];
    let number = |name: &str| kinds.value(name).and_then(Authored::number).unwrap();
    // The shortest decimals of 0.1 in half and single precision are not those of the double.
    assert_eq!(number("one:half"), 0.0999755859375);
    assert_eq!(number("one:float"), f64::from(0.1f32));
    assert_eq!(number("one:double"), 0.1);
    assert_eq!((number("one:int"), number("one:uint")), (-7.0, 4e9));
    assert_eq!((number("one:int64"), number("one:uint64")), (-(2f64.powi(40)), 2f64.powi(41)));
    assert_eq!((number("one:inf"), number("one:minusInf")), (f64::INFINITY, f64::NEG_INFINITY));
    assert_eq!(kinds.value("one:quatd").unwrap().tuple(), Some([0.5, 0.1, 0.2, 0.3]));
    assert_eq!(kinds.value("one:int3").unwrap().tuple(), Some([1.0, -2.0, 3000.0]));
    assert_eq!(take(kinds.value("one:matrix3d")).numbers().unwrap()[4], 2.0);
    let matrix = take(kinds.value("one:matrix4d")).numbers().unwrap();
    assert_eq!(matrix[12..], [1.0, 2.0, 3.5, 1.0]);
    let numbers = |name: &str| take(kinds.value(name)).numbers().unwrap();
    assert_eq!(numbers("many:ints")[39..], [3.0, 70000.0, -5.0]);
    assert_eq!(numbers("many:int64s")[19], 2f64.powi(40) + 57.0);
    assert_eq!(numbers("many:halves")[19], 9.5);
    assert_eq!(numbers("many:tableFloats")[39], f64::from(0.7f32));
    assert_eq!(numbers("many:quats")[4..], [0.5, 0.1, 0.2, 0.3].map(|part: f32| f64::from(part)));
    assert_eq!(number("timed"), 2.5);
    assert_eq!(stage.sampled, 1);
    assert!(kinds.value("blocked").is_none());
    assert_eq!(number("size"), 10.0);
    assert!(find(&stage, "/Kinds/Of_large").is_some() && find(&stage, "/Kinds/Of_small").is_none());
    let data = take(kinds.field("customData"));
    assert_eq!(data.get("numbers").unwrap().get("b"), Some(&Value::Number(2.25)));
    assert_eq!(stage.metadata("metersPerUnit").unwrap().number(), Some(0.01));
}

#[test]
fn a_package_is_its_first_layer() {
    let (text, ..) = binary("arm.usdc", ARM_CRATE);
    let package = binary("arm.usdz", ARM_ZIP).0.unwrap();
    assert_eq!(said(&package), said(&text.unwrap()));
    assert_eq!(&*package.layers[0], "arm.usdz[arm.usdc]");
    let nothing = binary("arm.usdz", &ARM_ZIP[..100]).0.unwrap_err().to_string();
    assert!(nothing.contains("not a usdz that can be read"), "{nothing}");
}

/// A package of one file.
fn packed(name: &str, bytes: &[u8]) -> Vec<u8> {
    packed_as(CompressionMethod::Stored, name, bytes)
}

fn packed_as(method: CompressionMethod, name: &str, bytes: &[u8]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    zip.start_file(name, SimpleFileOptions::default().compression_method(method)).unwrap();
    zip.write_all(bytes).unwrap();
    zip.finish().unwrap().into_inner()
}

#[test]
fn packages_in_packages() {
    let mut bytes = packed("b.usdz", ARM_ZIP);
    let (package, mut files) = binary("a.usdz", &bytes);
    let package = package.unwrap();
    assert_eq!(said(&package), said(&binary("arm.usdc", ARM_CRATE).0.unwrap()));
    assert_eq!(&*package.layers[0], "a.usdz[b.usdz[arm.usdc]]");
    assert_eq!(&*file("a.usdz[b.usdz[arm.usdc]]", &mut files).unwrap(), ARM_CRATE);
    let gone = file("a.usdz[b.usdz[gone.png]]", &mut files).unwrap_err().to_string();
    assert_eq!(gone, "cannot read `a.usdz[b.usdz[gone.png]]`: it is not in the package");
    for _ in 0..7 {
        bytes = packed("a.usdz", &bytes);
    }
    let deep = binary("a.usdz", &bytes).0.unwrap_err().to_string();
    assert!(deep.ends_with("packages are nested more than 8 levels deep"), "{deep}");
}

#[test]
fn packages_that_lie() {
    // A megabyte of spaces in a kilobyte.
    let bomb = packed_as(CompressionMethod::Deflated, "a.usda", &[b' '; 1 << 20]);
    assert!(bomb.len() < 2000);
    // An entry that says that it is 2 GB long: in its own head, and in the list.
    let mut long = packed("a.usda", ARM.as_bytes());
    let list = long.windows(4).position(|of| of == b"PK\x01\x02").unwrap();
    for at in [18, list + 20] {
        long[at..at + 8].copy_from_slice(&[255, 255, 255, 127, 255, 255, 255, 127]);
    }
    for bytes in [bomb, long] {
        let (stage, files) = binary("a.usdz", &bytes);
        let error = stage.unwrap_err().to_string();
        assert!(error.ends_with("`a.usda` is compressed, or longer than the package"), "{error}");
        assert!(files.most.get() < 1 << 16, "{}", files.most.get());
    }
}

/// Nothing panics, and no memory is made that the bytes do not account for.
#[test]
fn cut_at_each_byte() {
    for (name, bytes) in
        [("arm.usdc", ARM_CRATE), ("kinds.usdc", KINDS_CRATE), ("arm.usdz", ARM_ZIP)]
    {
        for end in 0..bytes.len() {
            let (stage, files) = binary(name, &bytes[..end]);
            assert!(stage.is_err(), "{name} cut at {end} is read");
            assert!(files.most.get() < 1 << 20, "{name} cut at {end}: {}", files.most.get());
        }
    }
}

#[test]
fn each_byte_changed() {
    for (name, bytes) in
        [("arm.usdc", ARM_CRATE), ("kinds.usdc", KINDS_CRATE), ("arm.usdz", ARM_ZIP)]
    {
        let mut read = 0;
        for at in 0..bytes.len() {
            for change in [0xff, 0x80, 1] {
                let mut bytes = bytes.to_vec();
                bytes[at] ^= change;
                let (stage, files) = binary(name, &bytes);
                read += usize::from(stage.is_ok());
                // Counts that the bytes do not account for are refused by whoever keeps the account.
                assert!(
                    stage.is_err() || files.left.get() > 900 << 20,
                    "{name}, byte {at}: {}",
                    files.left.get()
                );
            }
        }
        // Many bytes are those of numbers and names.
        assert!(read > 100, "{name}: {read}");
    }
}

/// A size that is declared, where the bytes for it are missing: refused before memory is made.
#[test]
fn sizes_that_are_not_there() {
    // The counts of tokens, of their bytes, of fields, of paths and of specs are at the start of their sections.
    let toc = u64::from_le_bytes(ARM_CRATE[16..24].try_into().unwrap()) as usize;
    let sections = u64::from_le_bytes(ARM_CRATE[toc..toc + 8].try_into().unwrap()) as usize;
    assert_eq!(sections, 6);
    for section in 0..sections {
        let entry = toc + 8 + 32 * section;
        let start =
            u64::from_le_bytes(ARM_CRATE[entry + 16..entry + 24].try_into().unwrap()) as usize;
        for count in [1 << 20, 1 << 32, u64::MAX >> 2, u64::MAX] {
            let mut bytes = ARM_CRATE.to_vec();
            bytes[start..start + 8].copy_from_slice(&count.to_le_bytes());
            let (stage, _) = binary("arm.usdc", &bytes);
            let error = stage.unwrap_err().to_string();
            assert!(
                error.contains("the crate file is damaged")
                    || error.contains("needs more memory or work"),
                "{error}"
            );
        }
    }
}

#[test]
fn old_versions_are_refused() {
    let mut bytes = ARM_CRATE.to_vec();
    bytes[9] = 3;
    let error = binary("arm.usdc", &bytes).0.unwrap_err().to_string();
    assert!(error.contains("version 0.3 of crate files is not read"), "{error}");
}
