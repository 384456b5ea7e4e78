//! MSH015: what a scene makes of a mesh (SPEC 7.5, 7.8). For each thing that a file can say, the plain mesh with it, and the
//! mesh as it would be without. The body has no symmetry, so that turns and mirrors show.

use serde_json::{Value, json};
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_validate::code::Code::MSH015;

use super::{ALL, BASE, put};
use crate::meshes::{HULLS, ORIGINAL, PIECES, PLAIN, boxy, robot_of, text};
use crate::numbers::geometry::geometry_alone;
use crate::{Case, changed};
use testkit::fixture::Fixture;
use testkit::robot::*;

pub const CORNERS: [[f64; 3]; 4] = [[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.25, 0.0], [0.0, 0.0, 0.125]];
pub const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

pub type Point = [f64; 3];

/// Where a point of the file is, in place.
type Placing = fn(Point) -> Point;

fn as_it_is(point: Point) -> Point {
    point
}

fn placed(placing: Placing, faces: &[[u32; 3]]) -> Mesh {
    Mesh { vertices: CORNERS.map(placing).to_vec(), triangles: faces.to_vec() }
}

fn turned([a, b, c]: [u32; 3]) -> [u32; 3] {
    [a, c, b]
}

/// A file, the mesh in it, and the mesh of who passes over what it is about.
struct Row {
    names: [&'static str; 2],
    file: Vec<u8>,
    right: Mesh,
    wrong: Mesh,
}

/// Of a file that places the body.
fn row(names: [&'static str; 2], file: impl Into<Vec<u8>>, placing: Placing) -> Row {
    let wrong = placed(as_it_is, &FACES);
    Row { names, file: file.into(), right: placed(placing, &FACES), wrong }
}

/// Shows the body by a file that the URDF names; its hull and its piece are those of `right`.
pub fn show(f: &mut Fixture, file: &[u8], right: &Mesh, shown: &Mesh) {
    let path = text(f, ORIGINAL, "/files/0/path");
    f.put_file(&path, file);
    let hull = ConvexHull::new(&right.vertices).expect("a hull").into_mesh();
    for format in ALL {
        put(f, HULLS, BASE, format, &hull);
        put(f, PIECES, BASE, format, &hull);
        put(f, PLAIN, BASE, format, shown);
    }
}

/// A link that shows the body, after one that shows a box. Class Geometry.
pub fn base() -> Fixture {
    scaled(None)
}

/// The same, with this scale in the URDF.
pub fn scaled(scale: Option<[f64; 3]>) -> Fixture {
    let mut robot = robot_of(vec![boxy("a"), link("b")]);
    robot.meshes.insert("part.dae".to_owned(), [0.5, 0.25, 0.125]);
    robot.link_mut("b").visual.push(visual(None, mesh("part.dae", scale)));
    let mut f = Fixture::full(&robot);
    geometry_alone(&mut f);
    let whole = placed(as_it_is, &FACES);
    show(&mut f, collada("", "").as_bytes(), &whole, &whole);
    f
}

pub fn cases() -> Vec<Case> {
    let rows = collada_rows().into_iter().chain(gltf_rows());
    rows.flat_map(|Row { names, file, right, wrong }| {
        [false, true].map(|caught| {
            let (file, right) = (file.clone(), right.clone());
            let shown = if caught { wrong.clone() } else { right.clone() };
            changed(MSH015, names[usize::from(caught)], caught, base, move |f| {
                show(f, &file, &right, &shown);
            })
        })
    })
    .collect()
}

/// The body, in a node with this transform; `asset` stands at the start.
fn collada(asset: &str, transform: &str) -> String {
    let shown = format!(r##"<node>{transform}<instance_geometry url="#g"/></node>"##);
    let faces = FACES.as_flattened().iter().map(u32::to_string).collect::<Vec<_>>().join(" ");
    let triangles = format!(
        r##"<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>{faces}</p></triangles>"##
    );
    document(asset, &triangles, "", &shown)
}

fn document(asset: &str, primitives: &str, library: &str, nodes: &str) -> String {
    let numbers: Vec<String> = CORNERS.as_flattened().iter().map(f64::to_string).collect();
    let numbers = numbers.join(" ");
    format!(
        r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">{asset}
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="n" count="12">{numbers}</float_array>
<technique_common><accessor source="#n" count="4" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>{primitives}</mesh></geometry></library_geometries>
{library}<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
"##
    )
}

fn collada_rows() -> Vec<Row> {
    let skin = r##"<library_controllers><controller id="c"><skin source="#g"><bind_shape_matrix>1 0 0 0.5 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix></skin></controller></library_controllers>"##;
    let skinned = r##"<node><instance_controller url="#c"/></node>"##;
    let faces = r##"<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>"##;
    // A face of the body as a polygon with a hole: its outline counts.
    let holed = r##"<polygons count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1</p><p>0 1 3</p><p>0 3 2</p><ph><p>1 2 3</p><h>0 1 3</h></ph></polygons>"##;
    let shown = r##"<node><instance_geometry url="#g"/></node>"##;
    let without_last = placed(as_it_is, &FACES[..3]);
    let mirrored = collada("", "<scale>-1 1 1</scale>");
    let mirror: Placing = |[x, y, z]| [-x, y, z];
    let names = ["node-that-mirrors", "node-that-mirrors-not-turned-round"];
    vec![
        Row {
            names,
            file: mirrored.into(),
            right: placed(mirror, &FACES.map(turned)),
            wrong: placed(mirror, &FACES),
        },
        row(
            ["skin-with-a-bind-shape", "skin-without-its-bind-shape"],
            document("", faces, skin, skinned),
            |[x, y, z]| [x + 0.5, y, z],
        ),
        // The frame looks along y, with z up: its x is x, its y is z, and its z is -y.
        row(
            ["node-that-looks", "node-that-looks-left-out"],
            collada("", "<lookat>0 0 0 0 1 0 0 0 1</lookat>"),
            |[x, y, z]| [x, -z, y],
        ),
        row(
            ["node-that-skews", "node-that-skews-left-out"],
            collada("", "<skew>45 0 1 0 1 0 0</skew>"),
            |[x, y, z]| [x + y, y, z],
        ),
        row(
            ["node-that-turns", "node-that-turns-left-out"],
            collada("", "<rotate>0 0 1 90</rotate>"),
            |[x, y, z]| [-y, x, z],
        ),
        // The first that is written is applied last.
        row(
            ["node-that-moves-and-turns", "node-that-moves-and-turns-left-out"],
            collada("", "<translate>1 0 0</translate><rotate>0 0 1 90</rotate>"),
            |[x, y, z]| [1.0 - y, x, z],
        ),
        row(
            ["unit-of-half-a-metre", "unit-of-half-a-metre-left-out"],
            collada(r#"<asset><unit meter="0.5"/></asset>"#, ""),
            |point| point.map(|x| x / 2.0),
        ),
        Row {
            names: ["y-up", "y-up-turned"],
            file: collada("<asset><up_axis>Y_UP</up_axis></asset>", "").into(),
            right: placed(as_it_is, &FACES),
            wrong: placed(|[x, y, z]| [x, -z, y], &FACES),
        },
        Row {
            names: ["polygon-with-a-hole", "polygon-with-a-hole-left-out"],
            file: document("", holed, "", shown).into(),
            right: placed(as_it_is, &FACES),
            wrong: without_last,
        },
    ]
}

/// A GLB of these indices, whose positions are numbers of a type with this many bytes each, padded to four.
pub fn glb(json: &Value, chunk: &[u8]) -> Vec<u8> {
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut chunk = chunk.to_vec();
    chunk.resize(chunk.len().next_multiple_of(4), 0);
    let length = |bytes: usize| u32::try_from(bytes).expect("short").to_le_bytes();
    let mut bytes = b"glTF".to_vec();
    bytes.extend(2_u32.to_le_bytes());
    bytes.extend(length(28 + text.len() + chunk.len()));
    bytes.extend(length(text.len()));
    bytes.extend(b"JSON");
    bytes.extend(text);
    bytes.extend(length(chunk.len()));
    bytes.extend(b"BIN\0");
    bytes.extend(chunk);
    bytes
}

/// The body as glTF: positions as binary32, these indices, and a change.
fn gltf(indices: &[u8], change: impl Fn(&mut Value)) -> Vec<u8> {
    let numbers = CORNERS.as_flattened().iter();
    let mut chunk: Vec<u8> = numbers.flat_map(|x| (*x as f32).to_le_bytes()).collect();
    chunk.extend(indices);
    let mut json = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5121, "count": indices.len(), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": indices.len()},
        ],
        "buffers": [{"byteLength": chunk.len()}],
    });
    change(&mut json);
    glb(&json, &chunk)
}

/// As URDF programs read glTF: y is up in the file, z in place.
fn up([x, y, z]: Point) -> Point {
    [x, -z, y]
}

fn gltf_rows() -> Vec<Row> {
    let faces: Vec<u8> = FACES.as_flattened().iter().map(|at| *at as u8).collect();
    // Every second triangle of a strip is turned round: these are the faces of the body.
    let strip =
        gltf(&[0, 2, 1, 3, 0, 2], |json| json["meshes"][0]["primitives"][0]["mode"] = json!(5));
    let not_turned = [[0, 2, 1], [2, 1, 3], [1, 3, 0], [3, 0, 2]];
    // Three faces are a fan; the fourth is left out of both.
    let fan = gltf(&[0, 2, 1, 3, 2], |json| json["meshes"][0]["primitives"][0]["mode"] = json!(6));
    let whole = gltf(&faces, |_| {});
    let of =
        |name, wrong, file, right, other| Row { names: [name, wrong], file, right, wrong: other };
    let moved = |node: Value| gltf(&faces, move |json| json["nodes"][0] = node.clone());
    vec![
        of(
            "gltf-with-y-up",
            "gltf-with-y-up-not-turned",
            whole,
            placed(up, &FACES),
            placed(as_it_is, &FACES),
        ),
        of("strip", "strip-not-turned-round", strip, placed(up, &FACES), placed(up, &not_turned)),
        of(
            "fan",
            "fan-as-a-strip",
            fan,
            placed(up, &FACES[..3]),
            placed(up, &[[0, 2, 1], [2, 3, 1], [1, 3, 2]]),
        ),
        of(
            "gltf-node-that-moves",
            "gltf-node-that-moves-left-out",
            moved(json!({"mesh": 0, "translation": [1, 0, 0], "scale": [2, 1, 1]})),
            placed(|[x, y, z]| up([2.0 * x + 1.0, y, z]), &FACES),
            placed(up, &FACES),
        ),
        of(
            "gltf-node-with-a-matrix",
            "gltf-node-with-a-matrix-by-rows",
            moved(json!({"mesh": 0, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]})),
            placed(|[x, y, z]| up([-y, x, z]), &FACES),
            placed(|[x, y, z]| up([y, -x, z]), &FACES),
        ),
        of(
            "gltf-node-that-mirrors",
            "gltf-node-that-mirrors-not-turned-round",
            moved(json!({"mesh": 0, "scale": [-1, 1, 1]})),
            placed(|[x, y, z]| up([-x, y, z]), &FACES.map(turned)),
            placed(|[x, y, z]| up([-x, y, z]), &FACES),
        ),
        quantised(&faces),
    ]
}

/// Positions in bytes, 127 of which are 1 m.
fn quantised(faces: &[u8]) -> Row {
    let corners: [[u8; 4]; 4] = [[0; 4], [127, 0, 0, 0], [0, 64, 0, 0], [0, 0, 32, 0]];
    let mut chunk = corners.as_flattened().to_vec();
    chunk.extend(faces);
    let json = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5120, "normalized": true, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5121, "count": faces.len(), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 16, "byteStride": 4},
            {"buffer": 0, "byteOffset": 16, "byteLength": faces.len()},
        ],
        "buffers": [{"byteLength": chunk.len()}],
    });
    let mesh = |one: f64| {
        let vertices = corners.map(|[x, y, z, _]| up([x, y, z].map(|x| f64::from(x) / one)));
        Mesh { vertices: vertices.to_vec(), triangles: FACES.to_vec() }
    };
    let names = ["positions-in-bytes", "positions-in-bytes-of-128"];
    Row { names, file: glb(&json, &chunk), right: mesh(127.0), wrong: mesh(128.0) }
}
