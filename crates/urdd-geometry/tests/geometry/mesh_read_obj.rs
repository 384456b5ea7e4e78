//! OBJ and its material libraries. All files are written here.

use urdd_geometry::read::{Format, NoteCode, Options, Scene, read, read_with};

fn load_with(text: &str, files: &[(&str, &str)]) -> Scene {
    let mut fetch = |name: &str| {
        files.iter().find(|(file, _)| *file == name).map(|(_, text)| text.as_bytes().to_vec())
    };
    read(text.as_bytes(), "a.obj", &mut fetch).unwrap()
}

fn load(text: &str) -> Scene {
    load_with(text, &[])
}

fn codes(scene: &Scene) -> Vec<NoteCode> {
    scene.notes.iter().map(|note| note.code).collect()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn faces_in_all_spellings() {
    for (faces, triangles, area) in [
        ("f 1 2 3\nf 1 3 4", 2, 1.0),
        ("f 1 2 3 4", 2, 1.0),
        ("vt 0.5\nvt 1\nvn 0 0 1\nf 1/1 2/2 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/2/1 3/1/1", 3, 1.5),
        ("f -4 -3 -2 -1", 2, 1.0),
        ("f -4 -3 -2\nv 9 9 9\nf -5 -3 -2", 2, 1.0),
        ("f 1 2 \\\n3\\\n4\r", 2, 1.0),
        ("g group\no object\ns off\nf 1 2 3 # comment\nl 1 2 3\np 1\ncurv 0 1 2", 1, 0.5),
        ("f 1 2\nf 1", 0, 0.0),
    ] {
        let scene = load(&format!("# comment\n{SQUARE}{faces}\n"));
        assert_eq!(scene.format, Format::Obj);
        assert_eq!((scene.triangle_count(), scene.merged().area()), (triangles, area), "{faces}");
        assert!(
            codes(&scene)
                .iter()
                .all(|code| matches!(code, NoteCode::NoTriangles | NoteCode::UnusedVertices)),
            "{faces}: {:?}",
            scene.notes
        );
    }
    assert_eq!(
        load("f 1 2 3\nv 0 0 0 1.0\nv 2 0 0 0.5 0.5 0.5\nv 0 1 0").merged().area(),
        1.0,
        "vertices after the face, with weight or colour"
    );
}

#[test]
fn a_face_that_is_not_convex() {
    // An arrow head: the square 2 by 2 without its right quarter.
    let scene = load("v 0 0 0\nv 2 0 0\nv 1 1 0\nv 2 2 0\nv 0 2 0\nf 2 3 4 5 1\n");
    assert_eq!(scene.merged().area(), 3.0);
    // A fan around corner 2 of this quad covers more than the quad.
    let scene = load("v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf 2 3 4 1\n");
    assert_eq!(scene.merged().area(), 4.0);
}

#[test]
fn a_face_that_is_not_convex_keeps_its_winding_in_every_plane() {
    // An L of area 3 and its mirror image, facing along each axis: the vector area is 3 along it.
    let corners =
        [[0.0, 1.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    for axis in 0..3 {
        for (face, sign) in [("f 1 2 3 4 5 6 7", 1.0), ("f 7 6 5 4 3 2 1", -1.0)] {
            let mut text = String::new();
            for [u, v] in corners {
                let mut place = [0.5; 3];
                place[(axis + 1) % 3] = u;
                place[(axis + 2) % 3] = v;
                text += &format!("v {} {} {}\n", place[0], place[1], place[2]);
            }
            let mesh = load(&(text + face)).merged();
            let mut sum = [0.0; 3];
            for triangle in &mesh.triangles {
                let [a, b, c] = mesh.corners(*triangle).map(nalgebra::Vector3::from);
                let normal = (b - a).cross(&(c - a)) / 2.0;
                (0..3).for_each(|at| sum[at] += normal[at]);
            }
            let mut expected = [0.0; 3];
            expected[axis] = 3.0 * sign;
            assert_eq!((sum, mesh.area()), (expected, 3.0), "axis {axis}");
        }
    }
}

#[test]
fn bad_faces_and_numbers_are_dropped_with_a_note() {
    let scene = load(&format!(
        "{SQUARE}f 1 2 3\nf 0 1 2\nf 1 2 5\nf 1 2 x\nf -5 1 2\nf 1 2 4294967299\nf 1 2 99999999999999999999\n"
    ));
    assert_eq!(
        (scene.triangle_count(), codes(&scene)),
        (1, vec![NoteCode::IndexOutOfRange, NoteCode::UnusedVertices, NoteCode::IndexOutOfRange])
    );
    let notes = scene.notes.iter();
    let out_of_range = notes.filter(|note| note.code == NoteCode::IndexOutOfRange);
    assert_eq!(out_of_range.map(|note| note.count).sum::<usize>(), 6);
    let scene = load("v nan 0 0\nv 1 0 0\nv 0 1 0\nv 1 1\nf 1 2 3\nf 2 3 4\n");
    assert_eq!(
        (scene.triangle_count(), codes(&scene), scene.notes[0].count),
        (0, vec![NoteCode::NotFinite, NoteCode::NoTriangles], 2)
    );
}

#[test]
fn a_face_with_a_vertex_that_the_file_lacks_is_dropped_whole() {
    let (library, material) = ("newmtl m\nmap_Kd a.png\n", "mtllib m.mtl\nusemtl m\n");
    let uv = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    let faces = "f 1/1 2/2 3/3 9/4\nf 1/1 2/2 3/3\nf 2/1 9/4 3/2 4/3\n";
    let text = format!("{material}{SQUARE}{uv}{faces}");
    for textures in [false, true] {
        let options = Options { textures, ..Options::default() };
        let mut fetch = |_: &str| Some(library.as_bytes().to_vec());
        let scene = read_with(text.as_bytes(), "a.obj", &mut fetch, &options).unwrap();
        assert_eq!((scene.triangle_count(), scene.merged().area()), (1, 0.5));
        assert!(codes(&scene).contains(&NoteCode::IndexOutOfRange));
        let uv = scene.parts[0].texture.as_ref().map(|texture| texture.uv.clone());
        assert_eq!(uv, textures.then(|| vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]));
    }
    // A vertex that comes later in the file is there.
    let scene = load(&format!("f 1 2 3 4\n{SQUARE}f 5 1 2 3\n"));
    assert_eq!((scene.triangle_count(), scene.merged().area()), (2, 1.0));
}

#[test]
fn colours_come_from_the_library() {
    let library = "newmtl red paint\nKd 1 0 0\nd 0.5\nmap_Ks gloss.png\nnewmtl gray\nKd 0.25\nTr 0.25\nnewmtl photo\nKd 1 1 1\nmap_Kd -s 1 1 1 img\\photo.png\nnewmtl spectral\nKd spectral a.rfl\nnewmtl red paint\nKd 0 0 1\n";
    let text = format!(
        "mtllib sub/my colours.mtl\n{SQUARE}f 1 2 3\nusemtl red paint\nf 1 2 3\nusemtl gray\nf 1 2 3\nusemtl red paint\nf 1 3 4\nusemtl photo\nf 1 2 3\nusemtl spectral\nf 1 2 3\nusemtl none\nf 1 2 3\n"
    );
    let scene = load_with(&text, &[("sub/my colours.mtl", library)]);
    let parts: Vec<_> = scene
        .parts
        .iter()
        .map(|part| (part.material.as_deref(), part.color, part.mesh.triangles.len()))
        .collect();
    assert_eq!(
        parts,
        [
            (None, None, 1),
            (Some("red paint"), Some([1.0, 0.0, 0.0, 0.5]), 2),
            (Some("gray"), Some([0.25, 0.25, 0.25, 0.75]), 1),
            (Some("photo"), None, 1),
            (Some("spectral"), None, 1),
            (Some("none"), None, 1),
        ]
    );
    assert_eq!(scene.side_files, ["sub/gloss.png", "sub/img/photo.png", "sub/my colours.mtl"]);
    assert_eq!(scene.notes, []);
}

#[test]
fn libraries_that_are_missing_or_several() {
    let text = format!("mtllib a.mtl b.mtl\nmtllib my colours.mtl\n{SQUARE}usemtl x\nf 1 2 3\n");
    let scene = load_with(&text, &[("b.mtl", "newmtl x\nKd 0 1 0\n")]);
    assert_eq!(scene.parts[0].color, Some([0.0, 1.0, 0.0, 1.0]));
    assert_eq!(
        codes(&scene),
        [NoteCode::SideFileMissing, NoteCode::SideFileMissing, NoteCode::UnusedVertices]
    );
    assert_eq!(scene.side_files, ["a.mtl", "b.mtl", "my colours.mtl"]);
}

#[test]
fn parts_do_not_multiply_vertices() {
    let mut text = String::from(SQUARE);
    for material in 0..100 {
        text += &format!("usemtl m{material}\nf 1 2 3\n");
    }
    let scene = load(&text);
    assert_eq!(scene.parts.len(), 100);
    assert!(scene.parts.iter().all(|part| part.mesh.vertices.len() == 3));
}
