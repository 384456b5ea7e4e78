//! The rows of formats with scenes: COLLADA and glTF.

use serde_json::{Value, json};

use super::{Row, TRIANGLE, row};
use crate::mesh_files::placed_scenes::glb;

/// A COLLADA document of one triangle; `scene` stands where the scene is.
fn collada(scene: &str) -> String {
    format!(
        r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><library_geometries><geometry id="g"><mesh><source id="p"><float_array id="n" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source="#n" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>{scene}</COLLADA>"##
    )
}

/// A COLLADA document with these images.
pub fn with_images(images: &str) -> String {
    collada("").replace("<library_geometries>", &format!("{images}<library_geometries>"))
}

/// A glTF document with an image of this URI.
pub fn with_uri(uri: &str) -> String {
    let mut gltf = gltf();
    gltf["images"] = json!([{ "uri": uri }]);
    gltf.to_string()
}

/// A COLLADA document of more than 20 million triangles: 300, shown 41 * 41 * 41 times.
fn many() -> String {
    let one =
        r##"<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p>"##;
    let triangles = one.replace("0 1 2", &vec!["0 1 2"; 300].join(" "));
    let nodes =
        |id: &str, inside: &str| format!(r##"<node id="{id}">{}</node>"##, inside.repeat(41));
    let of = |id: &str| format!(r##"<node><instance_node url="#{id}"/></node>"##);
    let last = r##"<node><instance_geometry url="#g"/></node>"##;
    let library = format!(
        "<library_nodes>{}{}{}</library_nodes>",
        nodes("a", last),
        nodes("b", &of("a")),
        nodes("c", &of("b"))
    );
    let scene = r##"<library_visual_scenes><visual_scene id="s"><node><instance_node url="#c"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene>"##;
    collada(&format!("{library}{scene}")).replace(one, &triangles)
}

pub fn collada_rows() -> Vec<Row> {
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
    let deep = |levels: usize| {
        let (begin, end) = ("<node>".repeat(levels - 1), "</node>".repeat(levels - 1));
        let inside = r##"<node><instance_geometry url="#g"/></node>"##;
        collada(&format!("{}{scene}", nodes(&format!("{begin}{inside}{end}"))))
    };
    // Elements inside one another, the root one of them.
    let nested = |levels: usize| {
        let (begin, end) = ("<a>".repeat(levels - 2), "</a>".repeat(levels - 2));
        collada(&format!("<extra>{begin}{end}</extra>{shown}{scene}"))
    };
    let placed = |transform: &str| {
        let inside = format!(r##"<node>{transform}<instance_geometry url="#g"/></node>"##);
        collada(&format!("{}{scene}", nodes(&inside)))
    };
    let utf16 = |mark: &str| -> Vec<u8> {
        format!("{mark}{whole}").encode_utf16().flat_map(u16::to_le_bytes).collect()
    };
    let far = |offset: usize| {
        let corner = |index: u8| format!("{}{index} ", "0 ".repeat(offset));
        let indices = format!("<p>{}</p>", [0, 1, 2].map(corner).concat());
        changed(r#"offset="0""#, &format!(r#"offset="{offset}""#)).replace("<p>0 1 2</p>", &indices)
    };
    // The node that is shown, 271 times one, and in it 368 times another: 100,000 visits.
    let visits = |more: &str| {
        let of = |id: &str, times: usize, inside: &str| {
            format!(
                r##"<node id="{id}">{}</node>"##,
                format!(r##"<instance_node url="#{inside}"/>"##).repeat(times)
            )
        };
        let library =
            format!("<library_nodes><node id=\"b\"/>{}</library_nodes>", of("a", 368, "b"));
        let inside =
            of("r", 271, "a").replace("</node>", r##"<instance_geometry url="#g"/></node>"##);
        collada(&format!("{library}{}{scene}", nodes(&format!("{inside}{more}"))))
    };
    let light = r##"<library_controllers><controller id="c"><skin source="#g"/></controller></library_controllers>"##;
    let polylist = |counts: &str| {
        changed("<triangles", "<polylist")
            .replace("</triangles>", "</polylist>")
            .replace("<p>", &format!("<vcount>{counts}</vcount><p>"))
    };
    vec![
        row("collada", "part.dae", whole.clone(), true),
        row(
            "collada-of-a-light-that-names-a-controller",
            "part.dae",
            collada(&format!(
                "{light}{}{scene}",
                nodes(r##"<node><instance_light url="#c"/></node>"##)
            )),
            false,
        ),
        row("collada-of-a-list-of-polygons", "part.dae", polylist("3"), true),
        row("collada-of-counts-that-are-no-whole-numbers", "part.dae", polylist("x 1.5 3"), true),
        Row {
            free: true,
            ..row(
                "collada-moved-without-end-beside-another-node",
                "part.dae",
                collada(&format!(
                    "{}{scene}",
                    nodes(
                        r##"<node><translate>inf 0 0</translate></node><node><instance_geometry url="#g"/></node>"##
                    )
                )),
                true,
            )
        },
        row(
            "collada-moved-without-end",
            "part.dae",
            placed("<translate>1e999 0 0</translate>"),
            false,
        ),
        row("collada-of-an-offset-of-1023", "part.dae", far(1023), true),
        row("collada-of-an-offset-of-1024-with-all-indices", "part.dae", far(1024), false),
        row("collada-of-100000-visits", "part.dae", visits(""), true),
        row("collada-of-100001-visits", "part.dae", visits("<node/>"), false),
        row(
            "collada-of-a-controller-of-itself",
            "part.dae",
            collada(&format!(
                r##"<library_controllers><controller id="c"><skin source="#c"/></controller></library_controllers>{}{scene}"##,
                nodes(r##"<node><instance_controller url="#c"/></node>"##)
            )),
            false,
        ),
        row(
            "collada-without-vertices",
            "part.dae",
            changed(r##"source="#v""##, r##"source="#w""##),
            false,
        ),
        row(
            "collada-of-vertices-without-positions",
            "part.dae",
            changed(r#"semantic="POSITION""#, r#"semantic="NORMAL""#),
            false,
        ),
        row(
            "collada-of-a-position-that-is-no-number",
            "part.dae",
            changed("0 0 0 1 0 0", "0 0 0 1 x 0"),
            false,
        ),
        row(
            "collada-of-two-numbers-each-with-an-area",
            "part.dae",
            changed(r#"stride="3""#, r#"stride="2""#)
                .replace("0 0 0 1 0 0 0 1 0", "0 0 1 0 0 1 1 1 0"),
            false,
        ),
        row(
            "collada-of-an-index-that-is-no-number",
            "part.dae",
            changed("<p>0 1 2</p>", "<p>0 1 x</p>"),
            false,
        ),
        row(
            "collada-skewed-in-no-direction",
            "part.dae",
            placed("<skew>45 0 0 0 0 1 0</skew>"),
            true,
        ),
        row(
            "collada-of-a-lookat-along-up-beside-another-node",
            "part.dae",
            collada(&format!(
                "{}{scene}",
                nodes(
                    r##"<node><instance_geometry url="#g"/></node><node><lookat>0 0 0 0 0 1 0 0 2</lookat></node>"##
                )
            )),
            false,
        ),
        row(
            "collada-with-two-declarations",
            "part.dae",
            format!(r#"<?xml version="1.0"?><?xml version="1.0"?>{whole}"#),
            false,
        ),
        row(
            "collada-with-a-primitive-without-indices",
            "part.dae",
            changed("</mesh>", r#"<triangles count="0"/></mesh>"#),
            true,
        ),
        row("collada-cut-off", "part.dae", changed("</COLLADA>", ""), false),
        row(
            "collada-of-another-root",
            "part.dae",
            whole.replace("COLLADA ", "Collada ").replace("/COLLADA", "/Collada"),
            false,
        ),
        row("collada-moved-by-a-word", "part.dae", placed("<translate>1 2 x</translate>"), false),
        row(
            "collada-with-a-prefix",
            "part.dae",
            whole.replace('<', "<c:").replace("<c:/", "</c:").replace("xmlns=", "xmlns:c="),
            true,
        ),
        row(
            "collada-with-a-fault-that-no-scene-reaches",
            "part.dae",
            changed(
                "</library_geometries>",
                r##"<geometry id="h"><mesh><triangles count="1"><input semantic="VERTEX" source="#q" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>"##,
            ),
            true,
        ),
        row("collada-without-an-offset", "part.dae", changed(r#" offset="0""#, ""), true),
        Row {
            free: true,
            ..row(
                "collada-of-four-numbers-each",
                "part.dae",
                changed(r#"stride="3""#, r#"stride="4""#)
                    .replace("0 0 0 1 0 0 0 1 0", "0 0 0 9 1 0 0 9 0 1 0 9"),
                true,
            )
        },
        row(
            "collada-of-four-numbers-each-without-an-area",
            "part.dae",
            changed(r#"stride="3""#, r#"stride="4""#)
                .replace("0 0 0 1 0 0 0 1 0", "0 0 0 9 1 0 0 9 2 0 0 9"),
            false,
        ),
        row(
            "collada-that-counts-more-positions",
            "part.dae",
            changed(r##"source="#n" count="3""##, r##"source="#n" count="9""##),
            true,
        ),
        row("collada-of-utf-16", "part.dae", utf16("\u{feff}"), true),
        row("collada-of-utf-16-without-a-mark", "part.dae", utf16(""), false),
        row("collada-of-200-nodes-in-one-another", "part.dae", deep(200), true),
        row("collada-of-201-nodes-in-one-another", "part.dae", deep(201), false),
        row("collada-moved", "part.dae", placed("<translate>1 2 3</translate>"), true),
        row(
            "collada-moved-by-two-numbers",
            "part.dae",
            placed("<translate>1 2</translate>"),
            false,
        ),
        row("collada-made-flat", "part.dae", placed("<scale>0 0 0</scale>"), false),
        row(
            "collada-with-an-offset-that-is-no-number",
            "part.dae",
            changed(r#"offset="0""#, r#"offset="a""#),
            false,
        ),
        row(
            "collada-with-an-offset-of-1024",
            "part.dae",
            changed(r#"offset="0""#, r#"offset="1024""#),
            false,
        ),
        row(
            "collada-without-indices-of-vertices",
            "part.dae",
            changed(r#"semantic="VERTEX""#, r#"semantic="NORMAL""#),
            false,
        ),
        row(
            "collada-of-a-unit-of-0",
            "part.dae",
            changed(
                "<library_geometries>",
                r#"<asset><unit meter="0"/></asset><library_geometries>"#,
            ),
            true,
        ),
        row("collada-named-stl", "part.stl", whole.clone(), true),
        row("collada-that-names-no-scene", "part.dae", collada(&shown), true),
        row("collada-without-scenes", "part.dae", collada(""), true),
        row(
            "collada-of-an-empty-scene",
            "part.dae",
            collada(&format!("{}{scene}", nodes(""))),
            false,
        ),
        row("collada-with-a-doctype", "part.dae", format!("<!DOCTYPE COLLADA>{whole}"), false),
        row("collada-with-text-behind", "part.dae", format!("{whole}end"), false),
        row("collada-not-well-formed", "part.dae", changed("</mesh>", ""), false),
        row(
            "collada-of-two-numbers-each",
            "part.dae",
            changed(r#"stride="3""#, r#"stride="2""#)
                .replace(r#"<param name="Z" type="float"/>"#, ""),
            false,
        ),
        row(
            "collada-without-positions",
            "part.dae",
            changed(r##"source="#p""##, r##"source="#q""##),
            false,
        ),
        row(
            "collada-of-an-index-beyond",
            "part.dae",
            changed("<p>0 1 2</p>", "<p>0 1 3</p>"),
            false,
        ),
        row(
            "collada-that-states-more-numbers",
            "part.dae",
            changed(r#"count="9""#, r#"count="12""#),
            true,
        ),
        row(
            "collada-of-a-lookat-along-up",
            "part.dae",
            collada(&format!("{looking}{scene}")),
            false,
        ),
        row("collada-of-256-levels", "part.dae", nested(256), true),
        row("collada-of-257-levels", "part.dae", nested(257), false),
        row("collada-of-20-million-triangles", "part.dae", many(), false),
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

pub fn gltf_rows() -> Vec<Row> {
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
    let sparse = |accessor: Value| {
        let mut gltf = gltf();
        gltf["accessors"] = json!([accessor]);
        let list = gltf["bufferViews"].as_array_mut().expect("a list");
        list.push(json!({"buffer": 1, "byteLength": 3}));
        let list = gltf["buffers"].as_array_mut().expect("a list");
        // 0, 1, 2, a byte each.
        let uri = "data:application/octet-stream;base64,AAEC";
        list.push(json!({"uri": uri, "byteLength": 3}));
        gltf.to_string()
    };
    let indices = json!({"bufferView": 1, "componentType": 5121});
    let replaced = json!({"count": 3, "indices": indices, "values": {"bufferView": 0}});
    // Nodes in one another, the last of which has the mesh.
    let deep = |levels: usize| {
        let mut gltf = gltf();
        let mut nodes: Vec<Value> = (1..levels).map(|child| json!({"children": [child]})).collect();
        nodes.push(json!({"mesh": 0}));
        gltf["nodes"] = json!(nodes);
        gltf.to_string()
    };
    let escaped = |bytes: &[u8]| {
        let bytes: String = bytes.iter().map(|byte| format!("%{byte:02X}")).collect();
        format!("data:application/octet-stream,{bytes}")
    };
    let corners = TRIANGLE.as_flattened().iter();
    let percent = escaped(&corners.flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>());
    // A second view, of indices.
    let indexed = |accessor: Value, view: Value, bytes: &[u8]| {
        let mut gltf = gltf();
        gltf["meshes"][0]["primitives"][0]["indices"] = json!(1);
        let list = gltf["accessors"].as_array_mut().expect("a list");
        list.push(accessor);
        let list = gltf["bufferViews"].as_array_mut().expect("a list");
        list.push(view);
        let list = gltf["buffers"].as_array_mut().expect("a list");
        list.push(json!({"uri": escaped(bytes), "byteLength": bytes.len()}));
        gltf.to_string()
    };
    let bytes =
        |kind: &str| json!({"bufferView": 1, "componentType": 5121, "count": 3, "type": kind});
    let of_bytes = json!({"buffer": 1, "byteLength": 3});
    let mut replaced_indices = bytes("SCALAR");
    replaced_indices["sparse"] = json!({
        "count": 1, "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 1},
    });
    let mut without_uri = gltf();
    without_uri["buffers"][0] = json!({"byteLength": 36});
    vec![
        row("gltf-of-200-nodes-in-one-another", "part.gltf", deep(200), true),
        row("gltf-of-201-nodes-in-one-another", "part.gltf", deep(201), false),
        row("gltf-of-a-mesh-below-0", "part.gltf", with("/nodes/0/mesh", json!(-1)), false),
        row("gltf-of-a-mesh-that-is-true", "part.gltf", with("/nodes/0/mesh", json!(false)), false),
        row(
            "gltf-of-a-view-beyond-its-buffer",
            "part.gltf",
            with("/bufferViews/0/byteLength", json!(48)),
            false,
        ),
        row("gltf-of-a-buffer-without-a-uri", "part.gltf", without_uri.to_string(), false),
        row(
            "gltf-of-sparse-positions",
            "part.gltf",
            sparse(json!({"componentType": 5126, "count": 3, "type": "VEC3", "sparse": replaced})),
            true,
        ),
        row(
            "gltf-of-positions-without-a-view",
            "part.gltf",
            sparse(json!({"componentType": 5126, "count": 3, "type": "VEC3"})),
            false,
        ),
        row(
            "gltf-that-requires-meshopt",
            "part.gltf",
            with("/extensionsRequired", json!(["EXT_meshopt_compression"])),
            false,
        ),
        row(
            "gltf-that-uses-meshopt",
            "part.gltf",
            with("/extensionsUsed", json!(["EXT_meshopt_compression"])),
            true,
        ),
        row(
            "gltf-of-a-primitive-of-draco",
            "part.gltf",
            with(
                "/meshes/0/primitives/0/extensions",
                json!({"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {}}}),
            ),
            false,
        ),
        row("gltf-of-a-fan", "part.gltf", with("/meshes/0/primitives/0/mode", json!(6)), true),
        row("gltf-of-points", "part.gltf", with("/meshes/0/primitives/0/mode", json!(0)), false),
        row("gltf", "part.gltf", gltf().to_string(), true),
        row("glb", "part.stl", glb(&gltf(), &[]), true),
        row("glb-in-capitals", "part.glb", [b"GLTF", &glb(&gltf(), &[])[4..]].concat(), false),
        row("gltf-of-version-2-alone", "part.gltf", with("/asset/version", json!("2")), false),
        row("gltf-of-version-2.1", "part.gltf", with("/asset/version", json!("2.1")), true),
        row("gltf-of-a-number-as-version", "part.gltf", with("/asset/version", json!(2.0)), false),
        row("gltf-without-an-asset", "part.gltf", with("/asset", json!(null)), false),
        row("gltf-of-version-1", "part.gltf", with("/asset/version", json!("1.0")), false),
        row("gltf-of-an-empty-scene", "part.gltf", with("/scenes/0", json!({})), false),
        row("gltf-of-a-scene-that-is-not-there", "part.gltf", with("/scene", json!(1)), false),
        row(
            "gltf-of-a-mesh-that-is-not-there",
            "part.gltf",
            with("/nodes/0/mesh", json!(1)),
            false,
        ),
        row("gltf-of-a-buffer-too-short", "part.gltf", with("/accessors/0/count", json!(4)), false),
        row(
            "gltf-of-a-file-that-is-not-carried",
            "part.gltf",
            with("/buffers/0/uri", json!("gone.bin")),
            false,
        ),
        row("gltf-of-lines", "part.gltf", with("/meshes/0/primitives/0/mode", json!(1)), false),
        row("gltf-of-a-strip", "part.gltf", with("/meshes/0/primitives/0/mode", json!(5)), true),
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
        row("gltf-of-a-node-in-itself", "part.gltf", with("/nodes/0/children", json!([0])), false),
        row("gltf-of-a-scene-where-there-is-none", "part.gltf", with("/scenes", json!([])), false),
        row(
            "gltf-of-a-buffer-shorter-than-it-states",
            "part.gltf",
            with("/buffers/0/byteLength", json!(40)),
            false,
        ),
        row(
            "gltf-of-a-buffer-with-percent-signs",
            "part.gltf",
            with("/buffers/0/uri", json!(percent)),
            true,
        ),
        row(
            "gltf-of-indices",
            "part.gltf",
            indexed(bytes("SCALAR"), of_bytes.clone(), &[0, 1, 2]),
            true,
        ),
        row(
            "gltf-of-sparse-indices",
            "part.gltf",
            indexed(replaced_indices, of_bytes, &[0, 1, 2]),
            false,
        ),
        row(
            "gltf-of-indices-in-pairs",
            "part.gltf",
            indexed(bytes("VEC2"), json!({"buffer": 1, "byteLength": 6}), &[0, 1, 2, 0, 1, 2]),
            false,
        ),
        row(
            "gltf-of-positions-of-two-numbers",
            "part.gltf",
            with("/accessors/0/type", json!("VEC2")),
            false,
        ),
        row("glb-of-a-header-alone", "part.glb", glb(&gltf(), &[])[..12].to_vec(), false),
        row("glb-of-half-a-header", "part.glb", glb(&gltf(), &[])[..8].to_vec(), false),
    ]
}
