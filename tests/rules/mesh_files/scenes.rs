//! MSH015: what COLLADA and glTF can say besides, each in one file that a validator reads right or not (SPEC 7.5).
//! The body is that of `placed_scenes`.

use serde_json::{Value, json};
use urdd_geometry::Mesh;
use urdd_validate::code::Code::MSH015;

use super::placed_scenes::{CORNERS, FACES, Point, base, glb, scaled, show};
use crate::{Case, changed};

fn body(placing: impl Fn(Point) -> Point) -> Mesh {
    Mesh { vertices: CORNERS.map(placing).to_vec(), triangles: FACES.to_vec() }
}

fn as_it_is(point: Point) -> Point {
    point
}

fn right(name: &'static str, file: impl Into<Vec<u8>>, placing: fn(Point) -> Point) -> Case {
    let (file, mesh) = (file.into(), body(placing));
    changed(MSH015, name, false, base, move |f| show(f, &file, &mesh, &mesh))
}

const SHOWN: &str = r##"<instance_geometry url="#g"/>"##;
const TRIANGLES: &str = r##"<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>"##;

fn numbers() -> String {
    let numbers: Vec<String> = CORNERS.as_flattened().iter().map(f64::to_string).collect();
    numbers.join(" ")
}

/// Positions, of a float array and of what its accessor says.
fn positions(array: &str, accessor: &str) -> String {
    format!(
        r##"<source id="p"><float_array id="n">{array}</float_array><technique_common>{accessor}</technique_common></source>
<vertices id="v"><input semantic="NORMAL" source="#q"/><input semantic="POSITION" source="#p"/></vertices>"##
    )
}

fn three_each() -> String {
    positions(&numbers(), r##"<accessor source="#n" stride="3"/>"##)
}

/// A document of a mesh; `rest` is what follows the geometries.
fn document(mesh: &str, rest: &str) -> String {
    format!(
        r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><library_geometries><geometry id="g">{mesh}</geometry></library_geometries>{rest}</COLLADA>"##
    )
}

fn mesh(positions: &str, primitives: &str) -> String {
    format!("<mesh>{positions}{primitives}</mesh>")
}

/// A library and a scene of these nodes.
fn scene(library: &str, nodes: &str) -> String {
    format!(
        r##"{library}<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene>"##
    )
}

fn of_primitives(primitives: &str) -> String {
    let node = format!("<node>{SHOWN}</node>");
    document(&mesh(&three_each(), primitives), &scene("", &node))
}

fn of_positions(positions: &str) -> String {
    document(&mesh(positions, TRIANGLES), &scene("", &format!("<node>{SHOWN}</node>")))
}

fn of_scene(rest: &str) -> String {
    document(&mesh(&three_each(), TRIANGLES), rest)
}

/// A controller that takes its mesh from `source`.
fn controller(id: &str, kind: &str, source: &str, bind: &str) -> String {
    format!(r##"<controller id="{id}"><{kind} source="#{source}">{bind}</{kind}></controller>"##)
}

fn controlled(controllers: &str) -> String {
    let library = format!("<library_controllers>{controllers}</library_controllers>");
    of_scene(&scene(&library, r##"<node><instance_controller url="#c"/></node>"##))
}

fn halved([x, y, z]: Point) -> Point {
    [x / 2.0, y / 2.0, z / 2.0]
}

fn moved([x, y, z]: Point) -> Point {
    [x + 0.5, y, z]
}

fn collada() -> Vec<Case> {
    let two_inputs = r##"<triangles count="4"><input semantic="NORMAL" source="#q" offset="0"/><input semantic="VERTEX" source="#v" offset="1"/><p>3 0 3 2 3 1 3 0 3 1 3 3 3 0 3 3 3 2 3 1 3 2 3 3</p></triangles>"##;
    let cut_off = TRIANGLES.replace("1 2 3</p>", "1 2 3 0 1</p>");
    let strips = r##"<tristrips count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 3 0 2</p></tristrips>"##;
    let fans = r##"<trifans count="2"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 3 2</p><p>1 2 3</p></trifans>"##;
    let polylist = r##"<polylist count="6"><input semantic="VERTEX" source="#v" offset="0"/><vcount>3 2 3 0 3 3</vcount><p>0 2 1 0 1 0 1 3 0 3 2 1 2 3</p></polylist>"##;
    let too_many = r##"<polylist count="5"><input semantic="VERTEX" source="#v" offset="0"/><vcount>3 3 3 3 3</vcount><p>0 2 1 0 1 3 0 3 2 1 2 3</p></polylist>"##;
    let polygons = r##"<polygons count="5"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1</p><p>0 1</p><p>0 1 3</p><p>0 3 2</p><p>1 2 3</p></polygons>"##;
    let lines = format!(
        r##"<lines count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></lines>{TRIANGLES}"##
    );
    let wide: String = CORNERS.map(|[x, y, z]| format!("9 {z} {x} {y} 8 ")).concat();
    let named = r##"<accessor source="#n" stride="5" offset="0"><param name="A"/><param name="Z"/><param name="X"/><param name="Y"/></accessor>"##;
    let unnamed = r##"<accessor source="#n" stride="5" offset="2"><param name="X"/><param name="Y"/><param name="S"/></accessor>"##;
    let shifted: String = CORNERS.map(|[x, y, z]| format!("{x} {y} {z} 7 8 ")).concat();
    let half = "<scale>0.5 0.5 0.5</scale>";
    let inner = format!("<node>{half}<node>{SHOWN}</node></node>");
    let library = format!(
        r##"<library_nodes><node id="m"><translate>0.5 0 0</translate>{SHOWN}</node></library_nodes>"##
    );
    let bind = "<bind_shape_matrix>1 0 0 0.5 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>";
    let two_scenes = format!(
        r##"<library_visual_scenes><visual_scene id="r"><node>{half}{SHOWN}</node></visual_scene><visual_scene id="s"><node>{SHOWN}</node></visual_scene></library_visual_scenes>"##
    );
    let named_scene = format!(r##"{two_scenes}<scene><instance_visual_scene url="#s"/></scene>"##);
    let gone = format!(
        r##"<node>{SHOWN}<instance_geometry url="#no"/><instance_node url="#g"/><instance_controller url="#no"/></node>"##
    );
    let curve = r##"<geometry id="k"><spline closed="1"/></geometry></library_geometries>"##;
    let curved = format!(r##"<node><instance_geometry url="#k"/>{SHOWN}</node>"##);
    vec![
        right("collada-of-two-inputs", of_primitives(two_inputs), as_it_is),
        right("collada-of-triangles-cut-off", of_primitives(&cut_off), as_it_is),
        right("collada-of-strips", of_primitives(strips), as_it_is),
        right("collada-of-fans", of_primitives(fans), as_it_is),
        right("collada-of-lists-of-polygons", of_primitives(polylist), as_it_is),
        right("collada-of-a-list-that-counts-too-many", of_primitives(too_many), as_it_is),
        right("collada-of-polygons", of_primitives(polygons), as_it_is),
        right("collada-with-lines", of_primitives(&lines), as_it_is),
        right("collada-of-positions-named", of_positions(&positions(&wide, named)), as_it_is),
        right(
            "collada-of-positions-from-an-offset",
            of_positions(&positions(&format!("6 6 {shifted}"), unnamed)),
            as_it_is,
        ),
        right("collada-of-a-node-in-a-node", of_scene(&scene("", &inner)), halved),
        right(
            "collada-of-a-node-elsewhere",
            of_scene(&scene(
                &library,
                &format!(r##"<node>{half}<instance_node url="#m"/></node>"##),
            )),
            |[x, y, z]| [x / 2.0 + 0.25, y / 2.0, z / 2.0],
        ),
        right(
            "collada-of-a-matrix",
            of_scene(&scene(
                "",
                &format!(
                    "<node><matrix>0 -1 0 0.5 1 0 0 0.25 0 0 1 0.125 0 0 0 1</matrix>{SHOWN}</node>"
                ),
            )),
            |[x, y, z]| [0.5 - y, x + 0.25, z + 0.125],
        ),
        right(
            "collada-that-scales-by-three-numbers",
            of_scene(&scene("", &format!("<node><scale>2 4 8</scale>{SHOWN}</node>"))),
            |[x, y, z]| [2.0 * x, 4.0 * y, 8.0 * z],
        ),
        right(
            "collada-that-turns-about-a-long-axis",
            of_scene(&scene("", &format!("<node><rotate>0 3 0 90</rotate>{SHOWN}</node>"))),
            |[x, y, z]| [z, y, -x],
        ),
        right(
            "collada-that-skews-by-long-axes",
            of_scene(&scene("", &format!("<node><skew>30 1 0 2 0 3 0</skew>{SHOWN}</node>"))),
            |[x, y, z]| [x, y + (x + 2.0 * z) / (5.0_f64.sqrt() * 3.0_f64.sqrt()), z],
        ),
        // x is (0, -0.8, 0.6), y is (0, 0.6, 0.8), and z is -x.
        right(
            "collada-that-looks-aside",
            of_scene(&scene(
                "",
                &format!("<node><lookat>0.5 0.25 1 3.5 0.25 1 5 3 4</lookat>{SHOWN}</node>"),
            )),
            |[x, y, z]| [0.5 - z, 0.25 - 0.8 * x + 0.6 * y, 1.0 + 0.6 * x + 0.8 * y],
        ),
        // From 45 degrees above y to 0.
        right(
            "collada-that-skews-back",
            of_scene(&scene("", &format!("<node><skew>-45 1 1 0 1 0 0</skew>{SHOWN}</node>"))),
            |[x, y, z]| [x - y, y, z],
        ),
        right(
            "collada-of-numbers-left-over",
            of_positions(&positions(
                &format!("{} 9 9", numbers()),
                r##"<accessor source="#n" stride="3"/>"##,
            )),
            as_it_is,
        ),
        // Seen from the eye, the interest is along -z, and up is along y.
        right(
            "collada-that-looks-from-elsewhere",
            of_scene(&scene(
                "",
                &format!("<node><lookat>0.5 0.25 1 0.5 4.25 1 0 1 5</lookat>{SHOWN}</node>"),
            )),
            |[x, y, z]| [0.5 + x, 0.25 - z, 1.0 + y],
        ),
        right(
            "collada-of-a-skin-without-a-bind-shape",
            controlled(&controller("c", "skin", "g", "")),
            as_it_is,
        ),
        right(
            "collada-of-a-skin-of-a-morph",
            controlled(&format!(
                "{}{}",
                controller("c", "skin", "d", bind),
                controller("d", "morph", "g", "")
            )),
            moved,
        ),
        right("collada-of-the-scene-that-is-named", of_scene(&named_scene), as_it_is),
        right("collada-of-the-first-scene", of_scene(&two_scenes), halved),
        right(
            "collada-with-a-curve",
            of_scene(&scene("", &curved)).replace("</library_geometries>", curve),
            as_it_is,
        ),
        right("collada-of-instances-of-nothing", of_scene(&scene("", &gone)), as_it_is),
        right(
            "collada-without-scenes-and-in-other-units",
            of_scene(r##"<asset><unit meter="2"/></asset>"##),
            |point| point.map(|x| 2.0 * x),
        ),
        right(
            "collada-of-a-unit-that-is-no-number",
            of_scene(&format!(
                r##"<asset><unit meter="inf"/></asset>{}"##,
                scene("", &format!("<node>{SHOWN}</node>"))
            )),
            as_it_is,
        ),
    ]
}

/// As URDF programs read glTF: y is up in the file, z in place.
fn up([x, y, z]: Point) -> Point {
    [x, -z, y]
}

fn floats(points: &[Point]) -> Vec<u8> {
    points.as_flattened().iter().flat_map(|x| (*x as f32).to_le_bytes()).collect()
}

/// A GLB of the body, with indices of two bytes behind its positions.
fn gltf(change: impl Fn(&mut Value)) -> Vec<u8> {
    let mut chunk = floats(&CORNERS);
    chunk.extend(FACES.as_flattened().iter().flat_map(|at| (*at as u16).to_le_bytes()));
    let mut json = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 0, "byteOffset": 48, "componentType": 5123, "count": 12, "type": "SCALAR"},
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 72}],
        "buffers": [{"byteLength": 72}],
    });
    change(&mut json);
    glb(&json, &chunk)
}

/// Positions in between other numbers, and without indices.
fn interleaved() -> Vec<u8> {
    let mut chunk = vec![7; 8];
    for corner in FACES.as_flattened() {
        chunk.extend(floats(&[CORNERS[*corner as usize]]));
        chunk.extend([9; 4]);
    }
    let json = json!({
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}, {"attributes": {"NORMAL": 0}}, {"attributes": {"POSITION": 0}, "mode": 1}]}],
        "accessors": [{"bufferView": 0, "byteOffset": 4, "componentType": 5126, "count": 12, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 4, "byteLength": 196, "byteStride": 16}],
        "buffers": [{"byteLength": 200}],
    });
    glb(&json, &chunk)
}

/// Positions of zeros, of which the last three are replaced.
fn sparse() -> Vec<u8> {
    let mut chunk = floats(&CORNERS[1..]);
    chunk.extend(FACES.as_flattened().iter().map(|at| *at as u8));
    chunk.extend([0, 1, 2, 3]);
    let json = json!({
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"componentType": 5126, "count": 4, "type": "VEC3", "sparse": {
                "count": 3,
                "indices": {"bufferView": 2, "byteOffset": 1, "componentType": 5121},
                "values": {"bufferView": 0},
            }},
            {"bufferView": 1, "componentType": 5121, "count": 12, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 36},
            {"buffer": 0, "byteOffset": 36, "byteLength": 12},
            {"buffer": 0, "byteOffset": 48, "byteLength": 4},
        ],
        "buffers": [{"byteLength": 52}],
    });
    glb(&json, &chunk)
}

/// Positions in whole numbers, and indices of four bytes. A node makes up for their size.
fn quantised(component: u32, bytes: usize, most: u64) -> Vec<u8> {
    let mut chunk = Vec::new();
    for corner in CORNERS {
        for at in 0..4 {
            let number = corner.get(at).map_or(0, |x| if *x > 0.0 { most } else { 0 });
            chunk.extend(&number.to_le_bytes()[..bytes]);
        }
    }
    let positions = chunk.len();
    chunk.extend(FACES.as_flattened().iter().flat_map(|at| at.to_le_bytes()));
    let json = json!({
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "scale": [0.5, 0.25, 0.125]}],
        "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": component, "normalized": true, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": 12, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": positions, "byteStride": 4 * bytes},
            {"buffer": 0, "byteOffset": positions, "byteLength": 48},
        ],
        "buffers": [{"byteLength": chunk.len()}],
    });
    glb(&json, &chunk)
}

/// The least of a signed number stands for -1, as the one above it.
fn least() -> Vec<u8> {
    let corners: [[i8; 4]; 4] = [[0; 4], [-128, 0, 0, 0], [0, -127, 0, 0], [0, 0, 127, 0]];
    let mut chunk: Vec<u8> = corners.as_flattened().iter().map(|x| x.cast_unsigned()).collect();
    // Two of three axes are mirrored, which turns nothing round.
    chunk.extend(FACES.as_flattened().iter().map(|at| *at as u8));
    let json = json!({
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5120, "normalized": true, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5121, "count": 12, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 16, "byteStride": 4}, {"buffer": 0, "byteOffset": 16, "byteLength": 12},
        ],
        "buffers": [{"byteLength": 28}],
    });
    glb(&json, &chunk)
}

/// Of the body without its last face.
fn three_faces(name: &'static str, file: Vec<u8>) -> Case {
    let shown = Mesh { vertices: CORNERS.map(up).to_vec(), triangles: FACES[..3].to_vec() };
    changed(MSH015, name, false, base, move |f| show(f, &file, &shown, &shown))
}

fn gltf_cases() -> Vec<Case> {
    let s = 0.5_f64.sqrt();
    let lines = json!({"attributes": {"POSITION": 0}, "indices": 1, "mode": 2});
    vec![
        right("gltf-of-indices-in-two-bytes", gltf(|_| {}), up),
        right(
            "gltf-that-turns",
            gltf(move |json| json["nodes"][0]["rotation"] = json!([0, 0, s, s])),
            |[x, y, z]| up([-y, x, z]),
        ),
        right(
            "gltf-that-moves-turns-and-scales",
            gltf(move |json| {
                json["nodes"][0] = json!({"mesh": 0, "rotation": [s, 0, 0, s], "scale": [2, 4, 8], "translation": [0.5, 0.25, 1]});
            }),
            |[x, y, z]| up([0.5 + 2.0 * x, 0.25 - 8.0 * z, 1.0 + 4.0 * y]),
        ),
        right(
            "gltf-of-a-node-in-a-node",
            gltf(|json| {
                json["nodes"] = json!([{"children": [1], "scale": [0.5, 0.5, 0.5]}, {"mesh": 0, "translation": [1, 0, 0]}]);
            }),
            |[x, y, z]| up([x / 2.0 + 0.5, y / 2.0, z / 2.0]),
        ),
        right(
            "gltf-of-a-matrix-that-moves",
            gltf(|json| {
                json["nodes"][0]["matrix"] =
                    json!([0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0.5, 0.25, 1, 1]);
            }),
            |[x, y, z]| up([0.5 - y, 0.25 + x, 1.0 + z]),
        ),
        right(
            "gltf-of-the-first-scene",
            gltf(|json| {
                json["scenes"] = json!([{"nodes": [1]}, {"nodes": [0]}]);
                json["nodes"] = json!([{"mesh": 0}, {"mesh": 0, "scale": [0.5, 0.5, 0.5]}]);
                let all = json.as_object_mut().expect("an object");
                all.remove("scene");
            }),
            |point| up(halved(point)),
        ),
        right(
            "gltf-of-the-scene-that-is-named",
            gltf(|json| {
                json["scenes"] = json!([{"nodes": [1]}, {"nodes": [0]}]);
                json["nodes"] = json!([{"mesh": 0}, {"mesh": 0, "scale": [0.5, 0.5, 0.5]}]);
                json["scene"] = json!(1);
            }),
            up,
        ),
        right(
            "gltf-without-scenes",
            gltf(|json| {
                json["nodes"] = json!([{"mesh": 0}, {"children": [0], "scale": [0.5, 0.5, 0.5]}]);
                let all = json.as_object_mut().expect("an object");
                all.remove("scene");
                all.remove("scenes");
            }),
            |point| up(halved(point)),
        ),
        right(
            "gltf-with-lines",
            gltf(move |json| {
                let list = json["meshes"][0]["primitives"].as_array_mut().expect("a list");
                list.push(lines.clone());
            }),
            up,
        ),
        right("gltf-between-other-numbers", interleaved(), up),
        right("gltf-of-sparse-positions", sparse(), up),
        right("gltf-of-unsigned-bytes", quantised(5121, 1, 255), up),
        right("gltf-of-numbers-in-two-bytes", quantised(5122, 2, 32_767), up),
        right("gltf-of-unsigned-numbers-in-two-bytes", quantised(5123, 2, 65_535), up),
        right("gltf-of-the-least-byte", least(), |[x, y, z]| up([-2.0 * x, -4.0 * y, 8.0 * z])),
        three_faces(
            "gltf-of-triangles-cut-off",
            gltf(|json| json["accessors"][1]["count"] = json!(11)),
        ),
        // The last face has an index of 4 in place of 3.
        three_faces("gltf-of-an-index-beyond", {
            let mut bytes = gltf(|_| {});
            let last = bytes.len() - 2;
            bytes[last] = 4;
            bytes
        }),
    ]
}

/// STL and OBJ, whose content decides what they are.
fn others() -> Vec<Case> {
    let corner = |at: u32| CORNERS[at as usize].map(|x| x.to_string()).join(" ");
    let facet = |face: [u32; 3]| {
        let corners = face.map(|at| format!("vertex {}\n", corner(at))).concat();
        format!("facet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\n")
    };
    let facets = FACES.map(facet).concat();
    let text = format!(
        "solid vertex 9 9 9\n{facets}facet\nvertex 9 9 9\nvertex 8 8 8\nendfacet\nendsolid vertex 9 9 9\nvertex 7 7"
    );
    let vertices: String = (0..4).map(|at| format!("v {} # {at}\n", corner(at))).collect();
    let obj = format!(
        "\n# words\n{vertices}f 1/1 3/2 2/3\nf -4 -3 -1\nfo 1 4 3\nf 2 \\\n3 4 # words\nf 1 2\nf 0 1 2\nf 1 2 5\nf -5 1 2\nf 1 2 x\n"
    );
    let mut stl = b"solid words".to_vec();
    stl.resize(80, b' ');
    stl.extend(4_u32.to_le_bytes());
    for face in FACES {
        // The normal counts for nothing, nor do the two bytes at the end.
        stl.extend([1; 12]);
        stl.extend(floats(&face.map(|at| CORNERS[at as usize])));
        stl.extend([1; 2]);
    }
    vec![
        right("stl-as-text-in-many-ways", text, as_it_is),
        right("stl-with-other-normals", stl, as_it_is),
        right("obj-in-many-ways", obj, as_it_is),
    ]
}

/// An element that is mirrored along z alone, and as it would be if it was not turned round.
fn mirrored() -> [Case; 2] {
    [("element-mirrored-along-z", false), ("element-mirrored-along-z-not-turned-round", true)].map(
        |(name, caught)| {
            let file = of_primitives(TRIANGLES);
            let mut mesh = body(|[x, y, z]| [x, y, -z]);
            let flat = mesh.clone();
            for triangle in &mut mesh.triangles {
                triangle.swap(1, 2);
            }
            let shown = if caught { flat } else { mesh.clone() };
            let base = || scaled(Some([1.0, 1.0, -1.0]));
            changed(MSH015, name, caught, base, move |f| show(f, file.as_bytes(), &mesh, &shown))
        },
    )
}

pub fn cases() -> Vec<Case> {
    let mut cases = collada();
    cases.extend(mirrored());
    cases.extend(others());
    cases.extend(gltf_cases());
    cases
}
