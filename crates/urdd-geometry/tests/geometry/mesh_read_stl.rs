//! STL files that are valid, odd and broken.

use urdd_geometry::read::{Fault, Format, MeshError, NoteCode, Options, Scene, read, read_with};

const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

fn load(bytes: &[u8], name: &str) -> Result<Scene, MeshError> {
    read(bytes, name, &mut |_| None)
}

/// A binary STL with `triangles` copies of one triangle of area 6, and `count` in its header.
fn binary(header: &[u8], count: u32, triangles: usize) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend(count.to_le_bytes());
    for _ in 0..triangles {
        bytes.extend([0; 12]);
        bytes.extend(CORNERS.iter().flatten().flat_map(|value| value.to_le_bytes()));
        bytes.extend([0xff, 0x7f]);
    }
    bytes
}

fn codes(scene: &Scene) -> Vec<NoteCode> {
    scene.notes.iter().map(|note| note.code).collect()
}

#[test]
fn binary_with_any_header_and_extension_case() {
    for header in [&b"solid exported by a CAD system"[..], b"facet", b"", b"\xff\xfe"] {
        let scene = load(&binary(header, 2, 2), "part.STL").unwrap();
        assert_eq!(scene.format, Format::StlBinary);
        assert_eq!((scene.triangle_count(), scene.merged().area()), (2, 12.0));
        assert_eq!(scene.notes, []);
    }
}

#[test]
fn counts_that_do_not_fit() {
    let scene = load(&binary(b"x", 0, 3), "a.stl").unwrap();
    assert_eq!((scene.triangle_count(), codes(&scene)), (3, vec![NoteCode::WrongCount]));
    let scene = load(&binary(b"solid x", u32::MAX, 3), "a.stl").unwrap();
    assert_eq!((scene.triangle_count(), codes(&scene)), (3, vec![NoteCode::CutOff]));
    let mut bytes = binary(b"x", 3, 3);
    bytes.extend(*b"some comment after the last triangle, longer than a triangle is");
    let scene = load(&bytes, "a.stl").unwrap();
    assert_eq!((scene.triangle_count(), codes(&scene)), (3, vec![NoteCode::WrongCount]));
    // Only the extension identifies a truncated file.
    bytes.truncate(84 + 3 * 50 - 1);
    assert_eq!(load(&bytes, "a.STL").unwrap().triangle_count(), 2);
    assert_eq!(load(&bytes, "a.dae").unwrap_err().fault, Fault::UnknownFormat);
    let scene = load(&bytes, "a.stl").unwrap();
    assert_eq!((scene.triangle_count(), codes(&scene)), (2, vec![NoteCode::CutOff]));
}

#[test]
fn too_many_triangles_are_an_error() {
    let load = |max_triangles| {
        let options = Options { max_triangles, ..Options::default() };
        read_with(&binary(b"x", 3, 3), "a.stl", &mut |_| None, &options)
    };
    assert_eq!(load(3).unwrap().triangle_count(), 3);
    assert_eq!(load(2).unwrap_err().fault, Fault::TooLarge { what: "triangles", limit: 2 });
}

#[test]
fn nothing_whole_is_an_error() {
    let bytes = binary(b"x", 3, 1);
    let error = load(&bytes[..84 + 49], "cut.stl").unwrap_err();
    assert!(matches!(error.fault, Fault::Truncated(_)), "{error}");
    assert!(error.to_string().starts_with("cut.stl: byte 133: the file is cut off"), "{error}");
    assert!(matches!(load(&bytes[..70], "cut.stl").unwrap_err().fault, Fault::Truncated(_)));
    assert_eq!(load(b"", "empty.stl").unwrap_err().fault, Fault::Empty);
    let none = load(&binary(b"x", 0, 0), "none.stl").unwrap();
    assert_eq!((none.parts.len(), codes(&none)), (0, vec![NoteCode::NoTriangles]));
}

#[test]
fn corners_that_are_no_numbers_are_dropped() {
    let mut bytes = binary(b"x", 2, 2);
    bytes[84 + 12..84 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    let scene = load(&bytes, "nan.stl").unwrap();
    assert_eq!(
        (scene.triangle_count(), scene.merged().vertices.len(), codes(&scene)),
        (1, 3, vec![NoteCode::NotFinite])
    );
}

const TEXT: &str = "solid vertex 1 2 3 facet\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 3e0 0 0\n   vertex 0 4. 0\n  endloop\n endfacet\nendsolid vertex\n";

#[test]
fn text_in_any_case_with_any_name_and_several_solids() {
    let twice = format!("{TEXT}{TEXT}");
    for text in [
        twice.clone(),
        twice.to_uppercase(),
        twice.replace('\n', "\r\n"),
        twice.replace('\n', "\r"),
        format!("\u{feff} {twice}"),
    ] {
        let scene = load(text.as_bytes(), "a.stl").unwrap();
        assert_eq!(scene.format, Format::StlAscii);
        assert_eq!((scene.triangle_count(), scene.merged().area()), (2, 12.0), "{text}");
        assert_eq!(scene.notes, []);
    }
}

#[test]
fn text_with_a_loop_of_four_and_one_cut_off() {
    let square = "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nfacet\nouter loop\nvertex 0 0 0\nvertex 1";
    let scene = load(square.as_bytes(), "a.stl").unwrap();
    assert_eq!((scene.merged().area(), codes(&scene)), (1.0, vec![NoteCode::CutOff]));
}

#[test]
fn the_content_decides_and_says_so() {
    let scene = load(&binary(b"x", 1, 1), "a.dae").unwrap();
    assert_eq!((scene.format, codes(&scene)), (Format::StlBinary, vec![NoteCode::WrongExtension]));
    let scene = load(TEXT.as_bytes(), "a.obj").unwrap();
    assert_eq!((scene.format, codes(&scene)), (Format::StlAscii, vec![NoteCode::WrongExtension]));
    let scene = load(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.stl").unwrap();
    assert_eq!((scene.format, codes(&scene)), (Format::Obj, vec![NoteCode::WrongExtension]));
    assert_eq!(load(&binary(b"x", 1, 1), "no_extension").unwrap().notes, []);
    for (bytes, name) in [
        (&b"PK\x03\x04abcdefg"[..], "a.stl"),
        (b"ply\nformat", "a.ply"),
        (b"version https://git-lfs.github.com/spec/v1\n", "a.stl"),
        (b"<svg/>", "a.dae"),
    ] {
        assert!(matches!(load(bytes, name).unwrap_err().fault, Fault::NotSupported(_)), "{name}");
    }
    assert_eq!(load(b"\x01\x02\x03", "a.xyz").unwrap_err().fault, Fault::UnknownFormat);
}
