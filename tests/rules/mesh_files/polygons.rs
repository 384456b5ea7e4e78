//! MSH015: how a face of more than three corners is cut (SPEC 7.8). A face is inside of the body of `placed_scenes`, so that
//! hull and piece do not depend on it.

use urdd_geometry::Mesh;
use urdd_validate::code::Code::MSH015;

use super::placed_scenes::{CORNERS, FACES, Point, base, scaled, show};
use crate::{Case, changed};

/// A corner, in 64ths of a metre.
type Corner = [u8; 3];

/// A face with one corner that turns back, the second, and one out of the plane of the others.
const DART: [Corner; 4] = [[4, 1, 1], [8, 2, 1], [12, 1, 2], [8, 5, 1]];

/// The same, with a corner more in the middle of an edge, and in a plane.
const LONG_DART: [Corner; 5] = [[4, 1, 1], [8, 2, 1], [12, 1, 1], [10, 3, 1], [8, 5, 1]];

/// A star of five points: it turns in one direction, and goes round twice.
const STAR: [Corner; 5] = [[11, 4, 1], [6, 6, 1], [9, 1, 1], [9, 7, 1], [6, 2, 1]];

/// A convex face.
const QUAD: [Corner; 4] = [[4, 1, 1], [12, 1, 1], [10, 4, 1], [5, 4, 1]];

/// The same, with the second corner twice.
const TWICE: [Corner; 5] = [[4, 1, 1], [12, 1, 1], [12, 1, 1], [10, 4, 1], [5, 4, 1]];

/// Two triangles that meet in a corner, on an edge: it touches itself, and does not cross itself.
const TOUCHING: [Corner; 5] = [[4, 1, 1], [12, 1, 1], [12, 5, 1], [8, 1, 1], [4, 5, 1]];

/// The same, from another corner on.
const TOUCHED: [Corner; 5] = [[12, 5, 1], [8, 1, 1], [4, 5, 1], [4, 1, 1], [12, 1, 1]];

fn corners(face: &[Corner]) -> Vec<Point> {
    let inside = face.iter().map(|corner| corner.map(|x| f64::from(x) / 64.0));
    CORNERS.into_iter().chain(inside).collect()
}

/// The body, and this face in it, in a node with this transform.
fn collada(face: &[Corner], transform: &str) -> String {
    fn words(numbers: impl Iterator<Item = impl ToString>) -> String {
        numbers.map(|number| number.to_string()).collect::<Vec<_>>().join(" ")
    }
    let positions = corners(face);
    let (count, numbers) = (positions.len(), words(positions.as_flattened().iter()));
    let all = FACES.as_flattened().iter().copied().chain(4..count as u32);
    let (indices, counts) = (words(all), words([3, 3, 3, 3, face.len()].iter()));
    format!(
        r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="n" count="{}">{numbers}</float_array>
<technique_common><accessor source="#n" count="{count}" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="5"><input semantic="VERTEX" source="#v" offset="0"/><vcount>{counts}</vcount><p>{indices}</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node>{transform}<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
"##,
        3 * count
    )
}

/// The mesh of the body and these triangles. Corners of the face are numbered from 4.
fn with(face: &[Corner], cut: &[[u32; 3]]) -> Mesh {
    let all: Vec<[u32; 3]> = FACES.iter().chain(cut).copied().collect();
    let positions = corners(face);
    let mut used: Vec<u32> = all.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    let place = |corner: u32| used.binary_search(&corner).expect("used") as u32;
    Mesh {
        vertices: used.iter().map(|corner| positions[*corner as usize]).collect(),
        triangles: all.iter().map(|triangle| triangle.map(place)).collect(),
    }
}

/// In a node that mirrors along x.
fn mirrored(mesh: Mesh) -> Mesh {
    Mesh {
        vertices: mesh.vertices.into_iter().map(|[x, y, z]| [-x, y, z]).collect(),
        triangles: mesh.triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect(),
    }
}

/// In a node that leans, and does not mirror.
const LEANING: [[f64; 3]; 3] = [[-1.0, -1.0, -1.0], [0.0, 1.0, -1.0], [1.0, -1.0, 2.0]];

fn leaning(mesh: Mesh) -> Mesh {
    let moved = |p: Point| LEANING.map(|row| (0..3).map(|i| row[i] * p[i]).sum());
    Mesh { vertices: mesh.vertices.into_iter().map(moved).collect(), ..mesh }
}

fn case(name: &'static str, caught: bool, file: String, shown: Mesh) -> Case {
    changed(MSH015, name, caught, base, move |f| show(f, file.as_bytes(), &shown, &shown))
}

/// A file of one triangle, and its mesh where the third coordinate is this.
fn one_triangle(z: f64) -> (String, Mesh) {
    let file = "v 0 0 0.25\nv 0.5 0 0.25\nv 0 0.5 0.25\nf 1 2 3\n".to_owned();
    let vertices = vec![[0.0, 0.0, z], [0.5, 0.0, z], [0.0, 0.5, z]];
    (file, Mesh { vertices, triangles: vec![[0, 1, 2]] })
}

pub fn cases() -> Vec<Case> {
    let (triangle, shown) = one_triangle(0.25);
    let flat = one_triangle(0.0).1;
    let plain = |face: &[Corner]| collada(face, "");
    let mirror = collada(&QUAD, "<scale>-1 1 1</scale>");
    let twice = [FACES, FACES].concat();
    let body =
        |triangles: &[[u32; 3]]| Mesh { vertices: CORNERS.to_vec(), triangles: triangles.to_vec() };
    vec![
        case("one-triangle", false, triangle.clone(), shown),
        changed(
            MSH015,
            "one-triangle-that-its-scale-makes-flat",
            false,
            || scaled(Some([1.0, 1.0, 0.0])),
            move |f| show(f, triangle.as_bytes(), &flat, &flat),
        ),
        changed(
            MSH015,
            "one-triangle-that-its-scale-makes-flat-in-y",
            false,
            || scaled(Some([1.0, 0.0, 1.0])),
            |f| {
                let mesh = Mesh {
                    vertices: vec![[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.0, 0.5]],
                    triangles: vec![[0, 1, 2]],
                };
                show(f, b"v 0 1 0\nv 0.5 1 0\nv 0 1 0.5\nf 1 2 3\n", &mesh, &mesh);
            },
        ),
        case("dart", false, plain(&DART), with(&DART, &[[5, 6, 7], [5, 7, 4]])),
        case(
            "dart-in-a-list-of-its-own",
            false,
            plain(&DART)
                .replace("polylist", "polygons")
                .replace("<vcount>3 3 3 3 4</vcount>", "")
                .replace(
                    "<p>0 2 1 0 1 3 0 3 2 1 2 3 ",
                    "<p>0 2 1</p><p>0 1 3</p><p>0 3 2</p><p>1 2 3</p><p>",
                ),
            with(&DART, &[[5, 6, 7], [5, 7, 4]]),
        ),
        case(
            "dart-of-one-triangle-twice",
            true,
            plain(&DART),
            with(&DART, &[[5, 6, 7], [5, 6, 7]]),
        ),
        case("dart-turned-round", true, plain(&DART), with(&DART, &[[5, 7, 6], [5, 4, 7]])),
        case(
            "dart-without-a-triangle-of-no-height",
            false,
            plain(&LONG_DART),
            with(&LONG_DART, &[[5, 6, 8], [5, 8, 4]]),
        ),
        case(
            "dart-without-a-triangle-of-some-height",
            true,
            plain(&LONG_DART),
            with(&LONG_DART, &[[5, 6, 8], [6, 7, 8]]),
        ),
        case("dart-left-out", true, plain(&DART), with(&DART, &[])),
        case("corner-twice", false, plain(&TWICE), with(&TWICE, &[[4, 5, 7], [4, 7, 8]])),
        case(
            "corner-twice-and-cut-from-another",
            true,
            plain(&TWICE),
            with(&TWICE, &[[5, 7, 8], [5, 8, 4]]),
        ),
        case(
            "face-that-touches-itself",
            false,
            plain(&TOUCHING),
            with(&TOUCHING, &[[5, 6, 7], [4, 7, 8]]),
        ),
        case(
            "half-of-a-face-that-touches-itself",
            true,
            plain(&TOUCHING),
            with(&TOUCHING, &[[5, 6, 7]]),
        ),
        case(
            "half-of-a-face-that-touches-itself-later",
            true,
            plain(&TOUCHED),
            with(&TOUCHED, &[[4, 5, 8]]),
        ),
        case(
            "face-that-touches-itself-later",
            false,
            plain(&TOUCHED),
            with(&TOUCHED, &[[4, 5, 8], [5, 6, 7]]),
        ),
        case(
            "leaning-quad",
            false,
            collada(&QUAD, "<matrix>-1 -1 -1 0 0 1 -1 0 1 -1 2 0 0 0 0 1</matrix>"),
            leaning(with(&QUAD, &[[4, 5, 6], [4, 6, 7]])),
        ),
        case("star-left-out", false, plain(&STAR), with(&STAR, &[])),
        case("star-as-some-triangle", false, plain(&STAR), with(&STAR, &[[4, 7, 8]])),
        case("star-with-a-corner-of-the-body", true, plain(&STAR), with(&STAR, &[[4, 7, 0]])),
        case(
            "mirrored-quad",
            false,
            mirror.clone(),
            mirrored(with(&QUAD, &[[4, 5, 6], [4, 6, 7]])),
        ),
        // As if the face was turned round before it is cut.
        case(
            "mirrored-quad-cut-from-its-last-corner",
            true,
            mirror,
            mirrored(with(&QUAD, &[[7, 5, 6], [7, 4, 5]])),
        ),
        case(
            "triangles-twice",
            false,
            plain(&[]).replace(" 0</vcount>", "</vcount>"),
            body(&twice),
        ),
        case(
            "triangle-twice-and-another-missing",
            true,
            plain(&[]).replace(" 0</vcount>", "</vcount>"),
            body(&[FACES[0], FACES[1], FACES[2], FACES[2]]),
        ),
    ]
}
