//! MSH016 for each row of the tables of SPEC 7.5: which files are meshes, and what they hold.
//!
//! The file is the collision mesh of a link that shows a box, so that only `usable` depends on it.

mod scenes;

use serde_json::json;
use urdd_format::urdf::Link;
use urdd_validate::code::Code::MSH016;

use crate::meshes::{ORIGINAL, boxy, robot_of};
use crate::{Case, changed};
use testkit::fixture::Fixture;
use testkit::robot::*;

/// A file that is carried, and whether it is usable.
struct Row {
    /// Name of the pair of cases: with the right answer, and with the other.
    name: &'static str,
    /// Name of the carried file.
    file: &'static str,
    bytes: Vec<u8>,
    usable: bool,
    /// Whether a URDD may also say the other: both cases are then accepted.
    free: bool,
}

fn row(name: &'static str, file: &'static str, bytes: impl Into<Vec<u8>>, usable: bool) -> Row {
    Row { name, file, bytes: bytes.into(), usable, free: false }
}

/// The cases of all rows.
pub fn cases() -> Vec<Case> {
    let rows = [stl_rows(), obj_rows(), scenes::collada_rows(), scenes::gltf_rows(), others()];
    let rows = rows.into_iter().flatten();
    let rows = rows.flat_map(|row| {
        let Row { name, file, bytes, usable, free } = row;
        [false, true].map(|otherwise| {
            let bytes = bytes.clone();
            let said = usable != otherwise;
            let name = match otherwise {
                true => format!("{name}-judged-otherwise").leak(),
                false => name,
            };
            changed(MSH016, name, otherwise && !free, base, move |f| {
                carry(f, file, &bytes, said);
            })
        })
    });
    rows.chain(side_files()).collect()
}

/// Two links that show boxes; the second collides with a mesh, which is not there.
fn base() -> Fixture {
    let with_mesh =
        Link { collision: vec![collision(None, mesh("package://robot/part", None))], ..boxy("b") };
    let mut fixture = Fixture::full(&robot_of(vec![boxy("a"), with_mesh]));
    carry(&mut fixture, "first.stl", &stl(1, &[TRIANGLE]), true);
    fixture
}

/// Puts the mesh there.
fn carry(f: &mut Fixture, file: &str, bytes: &[u8], usable: bool) {
    if let Some(before) = f.get(ORIGINAL, "/references/0/path").as_str().map(str::to_owned) {
        f.remove_file(&before);
        f.unlist(&before);
    }
    let path = format!("mesh_modules/{ORIGINAL}/meshes/{file}");
    f.put_file(&path, bytes);
    f.list(&path);
    f.set(ORIGINAL, "/references/0/path", json!(path));
    let carried = json!([{"path": path, "side_files": [], "usable": usable}]);
    f.set(ORIGINAL, "/files", carried);
}

/// A mesh that names another file, where that file is, and whether it is found by that name.
fn side_file(name: &'static str, file: &'static str, mesh: String, at: &'static str) -> [Case; 2] {
    [false, true].map(|caught| {
        let mesh = mesh.clone();
        let name = match caught {
            true => format!("{name}-not-named").leak(),
            false => name,
        };
        changed(MSH016, name, caught, base, move |f| {
            carry(f, file, mesh.as_bytes(), true);
            f.put_file(at, *b"0");
            if !caught {
                f.set(ORIGINAL, "/files/0/side_files", json!([at]));
            }
        })
    })
}

/// The last table of 7.5. The files are outside of the module's folder, where only `side_files` speaks of them.
fn side_files() -> Vec<Case> {
    let image = "../../../materials/light%20grey.png";
    let there = "materials/light grey.png";
    let obj = |library: &str| format!("mtllib {library}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let images =
        |inside: &str| format!("<library_images><image id=\"i\">{inside}</image></library_images>");
    let in_reference = images(&format!("<init_from><ref>{image}</ref></init_from>"));
    let in_itself = images(&format!("<init_from>{image}</init_from>"));
    let mut cases = Vec::new();
    cases.extend(side_file("image-of-collada", "part.dae", scenes::with_images(&in_itself), there));
    cases.extend(side_file(
        "image-of-collada-in-a-reference",
        "part.dae",
        scenes::with_images(&in_reference),
        there,
    ));
    cases.extend(side_file("image-of-gltf", "part.gltf", scenes::with_uri(image), there));
    // An absolute path, and a URI with a scheme, are taken from the folder of the file.
    for (name, library, at) in [
        ("library-by-an-absolute-path", "/a/b.mtl", "a/b.mtl"),
        ("library-by-a-uri", "file:///a/b.mtl", "file_/a/b.mtl"),
    ] {
        let mesh = obj(library);
        cases.push(changed(MSH016, name, false, base, move |f| {
            carry(f, "part.obj", mesh.as_bytes(), true);
            let path = format!("mesh_modules/{ORIGINAL}/meshes/{at}");
            f.put_file(&path, *b"newmtl grey\n");
            f.list(&path);
            f.set(ORIGINAL, "/files/0/side_files", json!([path]));
        }));
    }
    // Of what is no mesh, any may stand there; an STL without triangles names nothing.
    let cut = stl(1, &[TRIANGLE])[..114].to_vec();
    for (name, caught, file, bytes) in [
        ("any-side-file-of-a-comment", false, "part.words", b"# a note\n".to_vec()),
        ("any-side-file-of-an-stl-that-is-cut-off", false, "part.stl", cut),
        ("side-file-of-an-stl-without-triangles", true, "part.stl", stl(0, &[])),
    ] {
        cases.push(changed(MSH016, name, caught, base, move |f| {
            carry(f, file, &bytes, false);
            f.put_file("materials/steel.mtl", *b"newmtl steel\n");
            f.set(ORIGINAL, "/files/0/side_files", json!(["materials/steel.mtl"]));
        }));
    }
    cases
}

type Triangle = [[f32; 3]; 3];
const TRIANGLE: Triangle = [[0.0, 0.0, 0.0], [0.25, 0.0, 0.0], [0.0, 0.5, 0.0]];
const POINT: Triangle = [[0.25, 0.0, 0.0]; 3];
const NO_NUMBER: Triangle = [[0.0, 0.0, 0.0], [f32::NAN, 0.0, 0.0], [0.0, 0.5, 0.0]];

/// A binary STL that states `count` triangles.
fn stl(count: u32, triangles: &[Triangle]) -> Vec<u8> {
    let mut bytes = b"solid part".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(count.to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        let numbers = triangle.as_flattened().iter();
        bytes.extend(numbers.flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn stl_rows() -> Vec<Row> {
    let whole = stl(1, &[TRIANGLE]);
    let cut = |bytes: &[u8], by: usize| bytes[..bytes.len() - by].to_vec();
    let longer = [&whole[..], b"notes"].concat();
    // Cut off, so that its length does not say what it is.
    let begins = |start: &[u8]| [start, &cut(&stl(2, &[TRIANGLE; 2]), 20)[start.len()..]].concat();
    let facet = |last: &str| {
        format!(
            "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex {last}\nendloop\nendfacet\n"
        )
    };
    let text = |facets: &str| format!("solid part\n{facets}endsolid part\n");
    vec![
        row("binary-stl-that-begins-with-solid", "part.stl", whole.clone(), true),
        row("binary-stl-that-begins-with-off", "part.stl", [b"OFF\r", &whole[4..]].concat(), true),
        row("binary-stl-named-otherwise", "part.obj", whole, true),
        row("binary-stl-cut-off", "part.stl", cut(&stl(2, &[TRIANGLE; 2]), 20), true),
        row(
            "binary-stl-without-a-whole-triangle",
            "part.stl",
            cut(&stl(1, &[TRIANGLE]), 20),
            false,
        ),
        row("binary-stl-with-more-behind", "part.stl", longer, true),
        row("binary-stl-of-a-point-before-more", "part.stl", stl(1, &[POINT, TRIANGLE]), false),
        row("binary-stl-of-count-0", "part.stl", stl(0, &[TRIANGLE]), true),
        row("binary-stl-of-a-point", "part.stl", stl(1, &[POINT]), false),
        row("binary-stl-of-no-number", "part.stl", stl(1, &[NO_NUMBER]), false),
        row(
            "binary-stl-of-no-number-beside-numbers",
            "part.stl",
            stl(2, &[NO_NUMBER, TRIANGLE]),
            true,
        ),
        row("stl-as-text", "part.stl", text(&facet("0 1 0")), true),
        row("stl-as-text-in-capitals", "part.stl", text(&facet("0 1 0")).to_uppercase(), true),
        row(
            "stl-as-text-in-mixed-case",
            "part.stl",
            text(&facet("0 1 0")).replace("vertex", "Vertex").replace("endloop", "EndLoop"),
            true,
        ),
        row(
            "stl-as-text-cut-off",
            "part.stl",
            format!("solid part\n{}facet normal 0 0 1\nouter", facet("0 1 0")),
            true,
        ),
        row("stl-as-text-of-no-number", "part.stl", text(&facet("0 one 0")), false),
        row("stl-as-text-without-facets", "part.stl", text(""), false),
        row("binary-stl-named-stlb", "part.stlb", cut(&stl(2, &[TRIANGLE; 2]), 20), true),
        row("binary-stl-named-so-otherwise", "part.stlc", cut(&stl(2, &[TRIANGLE; 2]), 20), false),
        // No white space before, and no other letter case: these are not the first bytes of PLY.
        row("binary-stl-that-begins-with-a-space", "part.stl", begins(b" ply\n"), true),
        row("binary-stl-that-begins-in-capitals", "part.stl", begins(b"PLY\n"), true),
        row("binary-stl-that-begins-with-ply", "part.stl", begins(b"ply\n"), false),
        row("binary-stl-that-begins-as-utf-16", "part.stl", begins(b"\xff\xfe"), true),
        row(
            "binary-stl-with-words-of-stl",
            "part.stl",
            begins(b"solid part facet\n\0 endsolid"),
            true,
        ),
        row(
            "stl-as-text-without-the-word-facet",
            "part.stl",
            text(&facet("0 1 0")).replace("facet normal 0 0 1\n", "").replace("endfacet\n", ""),
            true,
        ),
        row(
            "stl-as-text-without-its-end",
            "part.stl",
            format!("solid part\n{}", facet("0 1 0")),
            true,
        ),
        row(
            "stl-as-text-with-a-byte-that-is-no-text",
            "part.mesh",
            text(&format!("{}\u{1}\n", facet("0 1 0"))),
            true,
        ),
        row(
            "stl-as-text-with-other-words-between-corners",
            "part.stl",
            text(&facet("0 1 0")).replace("vertex 1", "edge vertex 1"),
            true,
        ),
        row(
            "stl-as-text-of-a-loop-of-two-corners",
            "part.stl",
            text(&facet("0 1 0")).replace("vertex 1 0 0\n", ""),
            false,
        ),
    ]
}

fn obj_rows() -> Vec<Row> {
    let latin = [b"# St\xfcck\n".as_slice(), b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"].concat();
    let obj = |rest: &str| format!("# a part\nv 0 0 0\nv 1 0 0\nv 0 1 0\n{rest}\n");
    vec![
        row("obj", "part.obj", obj("f 1 2 3"), true),
        row("obj-named-stl", "part.stl", obj("f 1 2 3"), true),
        row("obj-counted-from-the-end", "part.obj", obj("f -3 -2 -1"), true),
        row("obj-of-index-0", "part.obj", obj("f 0 1 2"), false),
        row("obj-of-an-index-beyond", "part.obj", obj("f 1 2 4"), false),
        row("obj-of-an-index-beyond-beside-a-face", "part.obj", obj("f 1 2 4\nf 1 2 3"), true),
        row("obj-of-a-quad-with-an-index-beyond", "part.obj", obj("f 1 2 3 9"), false),
        row(
            "obj-of-vertices-after-their-face",
            "part.obj",
            "f 1 2 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n",
            true,
        ),
        row("obj-of-an-index-that-is-no-integer", "part.obj", obj("f 1 2 three"), false),
        row("obj-of-a-face-on-two-lines", "part.obj", obj("f 1 2 \\\n3"), true),
        row("obj-of-an-old-face", "part.obj", obj("fo 1 2 3"), true),
        row("obj-of-a-face-before-a-comment", "part.obj", obj("f 1 2 #3"), false),
        row("obj-of-a-face-with-textures", "part.obj", obj("f 1/9/9 2//9 3/9"), true),
        row("obj-of-a-face-in-capitals", "part.obj", obj("F 1 2 3"), false),
        row(
            "obj-of-a-vertex-of-two-numbers",
            "part.obj",
            "v 0 0 0\nv 1 0\nv 0 1 0\nv 1 1 0\nf 1 3 4\n",
            true,
        ),
        row(
            "obj-of-a-face-with-a-vertex-of-two-numbers",
            "part.obj",
            "v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n",
            false,
        ),
        row("obj-of-no-number", "part.obj", "v 0 0 0\nv x 0 0\nv 0 1 0\nf 1 2 3\n", false),
        row("obj-of-bytes-in-latin-1", "part.obj", latin, true),
        row("obj-with-a-substitute", "part.obj", obj("# \u{1a}\u{b}\nf 1 2 3"), true),
        row("obj-with-a-control-character", "part.obj", obj("# \u{1}\nf 1 2 3"), false),
        row(
            "obj-with-a-control-character-behind",
            "part.obj",
            obj(&format!("f 1 2 3\n{}\u{1}", "# words\n".repeat(8_192))),
            true,
        ),
        row("obj-without-faces", "part.obj", obj(""), false),
        row("obj-of-a-face-of-two-corners", "part.obj", obj("f 1 2"), false),
        row("obj-with-words-of-stl", "part.obj", obj("# facet endsolid\nf 1 2 3"), true),
        row(
            "obj-that-begins-with-solid",
            "part.obj",
            format!("solid part\n{}", obj("f 1 2 3")),
            true,
        ),
        row("obj-named-so-of-other-words", "part.obj", "a shopping list\n", false),
    ]
}

/// What is no mesh, whatever it is called.
fn others() -> Vec<Row> {
    let ply = "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n";
    // Long enough for a triangle, where it is taken for binary STL.
    let off = format!("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n# {}\n", "filler ".repeat(30));
    vec![
        row("empty-file", "part.stl", "", false),
        row("ply", "part.stl", [ply.as_bytes(), &[b' '; 60]].concat(), false),
        row("off", "part.obj", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", false),
        row("off-with-carriage-returns", "part.stl", off.replace('\n', "\r\n"), false),
        row("packed-by-gzip", "part.stl", [&[0x1f, 0x8b][..], &[8; 100]].concat(), false),
        row(
            "pointer-of-git-lfs",
            "part.stl",
            "version https://git-lfs.github.com/spec/v1\noid sha256:0000000000000000000000000000000000000000000000000000000000000000\nsize 1\n",
            false,
        ),
        row(
            "fbx",
            "part.stl",
            "Kaydara FBX Binary                                                                      ",
            false,
        ),
        row("other-xml", "part.dae", "<mesh/>", false),
        row("archive", "part.stl", [b"PK\x03\x04".as_slice(), &[1; 100]].concat(), false),
    ]
}
