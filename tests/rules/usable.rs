//! MSH016 for each row of the tables of SPEC 7.5: which files are meshes, and what they hold.
//!
//! The file is the collision mesh of a link that shows a box, so that only `usable` depends on it.

use serde_json::{Value, json};
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
}

fn row(name: &'static str, file: &'static str, bytes: impl Into<Vec<u8>>, usable: bool) -> Row {
    Row {
        name,
        file,
        bytes: bytes.into(),
        usable,
    }
}

/// The cases of all rows.
pub fn cases() -> Vec<Case> {
    let rows = [
        stl_rows(),
        obj_rows(),
        collada_rows(),
        gltf_rows(),
        others(),
    ];
    let rows = rows.into_iter().flatten();
    rows.flat_map(|row| {
        let Row {
            name,
            file,
            bytes,
            usable,
        } = row;
        [false, true].map(|caught| {
            let bytes = bytes.clone();
            let said = usable != caught;
            let name = match caught {
                true => format!("{name}-judged-otherwise").leak(),
                false => name,
            };
            changed(MSH016, name, caught, base, move |f| {
                carry(f, file, &bytes, said);
            })
        })
    })
    .collect()
}

/// Two links that show boxes; the second collides with a mesh, which is not there.
fn base() -> Fixture {
    let with_mesh = Link {
        collision: vec![collision(None, mesh("package://robot/part", None))],
        ..boxy("b")
    };
    let mut fixture = Fixture::full(&robot_of(vec![boxy("a"), with_mesh]));
    carry(&mut fixture, "first.stl", &stl(1, &[TRIANGLE]), true);
    fixture
}

/// Puts the mesh there.
fn carry(f: &mut Fixture, file: &str, bytes: &[u8], usable: bool) {
    if let Some(before) = f
        .get(ORIGINAL, "/references/0/path")
        .as_str()
        .map(str::to_owned)
    {
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
    let facet = |last: &str| {
        format!(
            "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex {last}\nendloop\nendfacet\n"
        )
    };
    let text = |facets: &str| format!("solid part\n{facets}endsolid part\n");
    vec![
        row(
            "binary-stl-that-begins-with-solid",
            "part.stl",
            whole.clone(),
            true,
        ),
        row("binary-stl-named-otherwise", "part.obj", whole, true),
        row(
            "binary-stl-cut-off",
            "part.stl",
            cut(&stl(2, &[TRIANGLE; 2]), 20),
            true,
        ),
        row(
            "binary-stl-without-a-whole-triangle",
            "part.stl",
            cut(&stl(1, &[TRIANGLE]), 20),
            false,
        ),
        row("binary-stl-with-more-behind", "part.stl", longer, true),
        row(
            "binary-stl-of-count-0",
            "part.stl",
            stl(0, &[TRIANGLE]),
            true,
        ),
        row("binary-stl-of-a-point", "part.stl", stl(1, &[POINT]), false),
        row(
            "binary-stl-of-no-number",
            "part.stl",
            stl(1, &[NO_NUMBER]),
            false,
        ),
        row(
            "binary-stl-of-no-number-beside-numbers",
            "part.stl",
            stl(2, &[NO_NUMBER, TRIANGLE]),
            true,
        ),
        row("stl-as-text", "part.stl", text(&facet("0 1 0")), true),
        row(
            "stl-as-text-in-capitals",
            "part.stl",
            text(&facet("0 1 0")).to_uppercase(),
            true,
        ),
        row(
            "stl-as-text-cut-off",
            "part.stl",
            format!("solid part\n{}facet normal 0 0 1\nouter", facet("0 1 0")),
            true,
        ),
        row(
            "stl-as-text-of-no-number",
            "part.stl",
            text(&facet("0 one 0")),
            false,
        ),
        row("stl-as-text-without-facets", "part.stl", text(""), false),
    ]
}

fn obj_rows() -> Vec<Row> {
    let obj = |rest: &str| format!("# a part\nv 0 0 0\nv 1 0 0\nv 0 1 0\n{rest}\n");
    vec![
        row("obj", "part.obj", obj("f 1 2 3"), true),
        row("obj-named-stl", "part.stl", obj("f 1 2 3"), true),
        row(
            "obj-counted-from-the-end",
            "part.obj",
            obj("f -3 -2 -1"),
            true,
        ),
        row("obj-of-index-0", "part.obj", obj("f 0 1 2"), false),
        row("obj-of-an-index-beyond", "part.obj", obj("f 1 2 4"), false),
        row(
            "obj-of-an-index-beyond-beside-a-face",
            "part.obj",
            obj("f 1 2 4\nf 1 2 3"),
            true,
        ),
        row(
            "obj-of-an-index-that-is-no-integer",
            "part.obj",
            obj("f 1 2 three"),
            false,
        ),
        row(
            "obj-of-no-number",
            "part.obj",
            "v 0 0 0\nv x 0 0\nv 0 1 0\nf 1 2 3\n",
            false,
        ),
        row("obj-without-faces", "part.obj", obj(""), false),
        row(
            "obj-named-so-of-other-words",
            "part.obj",
            "a shopping list\n",
            false,
        ),
    ]
}

/// A COLLADA document of one triangle; `scene` stands where the scene is.
fn collada(scene: &str) -> String {
    format!(
        r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><library_geometries><geometry id="g"><mesh><source id="p"><float_array id="n" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source="#n" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>{scene}</COLLADA>"##
    )
}

fn collada_rows() -> Vec<Row> {
    let nodes = |nodes: &str| {
        format!(
            r##"<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>"##
        )
    };
    let shown = nodes(r##"<node><instance_geometry url="#g"/></node>"##);
    let scene = r##"<scene><instance_visual_scene url="#s"/></scene>"##;
    let whole = collada(&format!("{shown}{scene}"));
    let looking =
        nodes(r##"<node><lookat>0 0 0 0 0 1 0 0 2</lookat><instance_geometry url="#g"/></node>"##);
    let within_itself =
        r##"<library_nodes><node id="a"><instance_node url="#a"/></node></library_nodes>"##;
    let within_itself = format!(
        "{within_itself}{}{scene}",
        nodes(r##"<node><instance_node url="#a"/><instance_geometry url="#g"/></node>"##)
    );
    let changed = |from: &str, to: &str| {
        assert!(whole.contains(from), "{from}");
        whole.replace(from, to)
    };
    vec![
        row("collada", "part.dae", whole.clone(), true),
        row("collada-named-stl", "part.stl", whole.clone(), true),
        row("collada-that-names-no-scene", "part.dae", collada(&shown), true),
        row("collada-without-scenes", "part.dae", collada(""), true),
        row("collada-of-an-empty-scene", "part.dae", collada(&format!("{}{scene}", nodes(""))), false),
        row("collada-with-a-doctype", "part.dae", format!("<!DOCTYPE COLLADA>{whole}"), false),
        row("collada-with-text-behind", "part.dae", format!("{whole}end"), false),
        row("collada-not-well-formed", "part.dae", changed("</mesh>", ""), false),
        row("collada-of-two-numbers-each", "part.dae", changed(r#"stride="3""#, r#"stride="2""#).replace(r#"<param name="Z" type="float"/>"#, ""), false),
        row("collada-without-positions", "part.dae", changed(r#"source="#p""#, r#"source="#q""#), false),
        row("collada-of-an-index-beyond", "part.dae", changed("<p>0 1 2</p>", "<p>0 1 3</p>"), false),
        row("collada-that-states-more-numbers", "part.dae", changed(r#"count="9""#, r#"count="12""#), true),
        row("collada-of-a-lookat-along-up", "part.dae", collada(&format!("{looking}{scene}")), false),
        row("collada-of-a-node-in-itself", "part.dae", collada(&within_itself), false),
    ]
}

/// glTF of one triangle, in a buffer of its own.
fn gltf() -> Value {
    // The corners of TRIANGLE, as binary32.
    let base64 = "AAAAAAAAAAAAAAAAAACAPgAAAAAAAAAAAAAAAAAAAD8AAAAA";
    json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"uri": format!("data:application/octet-stream;base64,{base64}"), "byteLength": 36}],
    })
}

fn gltf_rows() -> Vec<Row> {
    let with = |pointer: &str, value: Value| {
        let mut gltf = gltf();
        let (around, key) = pointer.rsplit_once('/').expect("a pointer");
        let around = gltf.pointer_mut(around).expect("a place");
        match around {
            Value::Array(list) => list[key.parse::<usize>().expect("an index")] = value,
            _ => around[key] = value,
        }
        gltf.to_string()
    };
    vec![
        row("gltf", "part.gltf", gltf().to_string(), true),
        row(
            "gltf-of-version-1",
            "part.gltf",
            with("/asset/version", json!("1.0")),
            false,
        ),
        row(
            "gltf-of-an-empty-scene",
            "part.gltf",
            with("/scenes/0", json!({})),
            false,
        ),
        row(
            "gltf-of-a-scene-that-is-not-there",
            "part.gltf",
            with("/scene", json!(1)),
            false,
        ),
        row(
            "gltf-of-a-mesh-that-is-not-there",
            "part.gltf",
            with("/nodes/0/mesh", json!(1)),
            false,
        ),
        row(
            "gltf-of-a-buffer-too-short",
            "part.gltf",
            with("/accessors/0/count", json!(4)),
            false,
        ),
        row(
            "gltf-of-a-file-that-is-not-carried",
            "part.gltf",
            with("/buffers/0/uri", json!("gone.bin")),
            false,
        ),
        row(
            "gltf-of-lines",
            "part.gltf",
            with("/meshes/0/primitives/0/mode", json!(1)),
            false,
        ),
        row(
            "gltf-of-a-strip",
            "part.gltf",
            with("/meshes/0/primitives/0/mode", json!(5)),
            true,
        ),
        row(
            "gltf-that-requires-draco",
            "part.gltf",
            with("/extensionsRequired", json!(["KHR_draco_mesh_compression"])),
            false,
        ),
        row(
            "gltf-that-uses-lights",
            "part.gltf",
            with("/extensionsUsed", json!(["KHR_lights_punctual"])),
            true,
        ),
        row(
            "gltf-of-a-node-in-itself",
            "part.gltf",
            with("/nodes/0/children", json!([0])),
            false,
        ),
    ]
}

/// What is no mesh, whatever it is called.
fn others() -> Vec<Row> {
    let ply = "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n";
    vec![
        row("empty-file", "part.stl", "", false),
        row(
            "ply",
            "part.stl",
            [ply.as_bytes(), &[b' '; 60]].concat(),
            false,
        ),
        row(
            "off",
            "part.obj",
            "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
            false,
        ),
        row(
            "packed-by-gzip",
            "part.stl",
            [&[0x1f, 0x8b][..], &[8; 100]].concat(),
            false,
        ),
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
        row(
            "archive",
            "part.stl",
            [b"PK\x03\x04".as_slice(), &[1; 100]].concat(),
            false,
        ),
    ]
}
