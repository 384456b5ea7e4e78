//! Files that are larger than any real one in one respect: time and memory stay in proportion.
//!
//! Each takes a second or so on an idle machine. Each took minutes, or more memory than available, before its limit
//! existed.

use std::time::{Duration, Instant};

use urdd_geometry::read::{Fault, MeshError, Scene, read};
use urdd_programs::MeshFacts;
use urdd_source::read_urdf;
use urdd_validate::settings::Settings;
use urdd_validate::urdf_text;

/// Long enough for a machine that is busy with other work.
const LIMIT: Duration = Duration::from_secs(60);

/// Runs both readers of URDF, and returns the generator's messages.
fn read_robot(elements: impl Iterator<Item = String>) -> String {
    let text = format!("<robot name=\"r\">{}</robot>", elements.collect::<String>());
    let start = Instant::now();
    urdf_text::read(&text);
    let result = read_urdf(text.as_bytes(), "file");
    let took = start.elapsed();
    assert!(took < LIMIT, "{took:?}");
    result.map_or_else(|error| error.to_string(), |_| String::new())
}

fn read_mesh(text: &str, name: &str) -> Result<Scene, MeshError> {
    let start = Instant::now();
    let scene = read(text.as_bytes(), name, &mut |_| None);
    let took = start.elapsed();
    assert!(took < LIMIT, "{took:?}");
    scene
}

fn is_too_large(result: &Result<Scene, MeshError>) -> bool {
    matches!(result, Err(error) if matches!(error.fault, Fault::TooLarge { .. }))
}

#[test]
fn an_element_of_very_many_attributes() {
    let attributes: String = (0..200_000).map(|n| format!(" a{n}=\"\"")).collect();
    let said = read_robot(std::iter::once(format!("<link{attributes}/>")));
    assert!(said.contains("256 attributes"), "{said}");
    let error = read_mesh(&format!("<COLLADA{attributes}/>"), "mesh.dae").unwrap_err();
    assert!(error.to_string().contains("256 attributes"), "{error}");
}

#[test]
fn namespaces_that_are_inherited_by_very_many_elements() {
    let declared: String = (0..20_000).map(|n| format!(" xmlns:p{n}=\"u\"")).collect();
    let elements = (0..20_000).map(|n| format!("<b xmlns:p=\"{n}\"/>"));
    let said = read_robot(
        std::iter::once(format!("<a{declared}>"))
            .chain(elements)
            .chain(std::iter::once("</a>".to_owned())),
    );
    assert!(said.contains("256 attributes"), "{said}");
}

#[test]
fn one_line_with_very_many_faults() {
    let links = (0..50_000).map(|n| format!("<link name=\"a{n}\"/>"));
    let joints = (0..50_000).map(|n| {
        format!(
            "<joint name=\"j{n}\" type=\"fixed\"><parent link=\"p\"/><child link=\"A1 \"/></joint>"
        )
    });
    let said = read_robot(links.chain(joints));
    assert!(said.contains("there is `a1`"), "{said}");
}

#[test]
fn very_many_attributes_in_another_case() {
    let said = read_robot((0..150_000).map(|n| format!("<link NAME=\"a{n}\" Name=\"b\"/>")));
    assert!(said.contains("150000 links"), "{said}");
}

#[test]
fn a_long_chain_of_mimics() {
    let count = 90_000;
    let links = (0..=count).map(|n| format!("<link name=\"{n}\"/>"));
    let joints = (0..count).map(|n| {
        let next = n + 1;
        format!("<joint name=\"{n}\" type=\"revolute\"><parent link=\"0\"/><child link=\"{next}\"/><mimic joint=\"{next}\"/></joint>")
    });
    assert_eq!(read_robot(links.chain(joints)), "");
}

#[test]
fn primitives_that_share_positions_that_the_file_does_not_hold() {
    let primitives = vec![r#"{"attributes":{"POSITION":0}}"#; 2000].join(",");
    let text = |count: usize| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{primitives}]}}],
            "accessors":[{{"componentType":5126,"count":{count},"type":"VEC3"}}]}}"#
        )
    };
    assert!(is_too_large(&read_mesh(&text(1_000_000), "mesh.gltf")));
    assert!(is_too_large(&read_mesh(&text(16_000_000), "mesh.gltf")));
    assert!(read_mesh(&text(3), "mesh.gltf").is_ok());
}

#[test]
fn one_source_by_very_many_names() {
    let numbers = "0 0 0 1 0 0 0 1 0 ".repeat(10_000);
    // White space around a reference means nothing.
    let triangles: String = (0..8192)
        .map(|n: u32| {
            let spaces = (0..13).map(|bit| if n >> bit & 1 == 1 { "&#9;" } else { " " });
            let spaces: String = spaces.collect();
            format!(r##"<triangles><input semantic="POSITION" source="{spaces}#s"/><p>0 1 2</p></triangles>"##)
        })
        .collect();
    let text = format!(
        r#"<COLLADA><library_geometries><geometry><mesh><source id="s"><float_array>{numbers}</float_array></source>
        {triangles}</mesh></geometry></library_geometries></COLLADA>"#
    );
    let scene = read_mesh(&text, "mesh.dae").unwrap();
    assert_eq!(scene.triangle_count(), 8192);
}

#[test]
fn a_long_node_that_is_placed_very_often() {
    let text = format!(
        r#"<COLLADA><library_nodes><node id="n">{}</node></library_nodes>
        <library_visual_scenes><visual_scene><node>{}</node></visual_scene></library_visual_scenes></COLLADA>"#,
        "<extra/>".repeat(200_000),
        r##"<instance_node url="#n"/>"##.repeat(50_000)
    );
    assert!(is_too_large(&read_mesh(&text, "mesh.dae")));
}

#[test]
fn an_effect_of_very_many_parameters_that_is_used_very_often() {
    let text = format!(
        r##"<COLLADA><library_geometries><geometry><mesh><source id="s"><float_array>0 0 0 1 0 0 0 1 0</float_array></source>
        {}</mesh></geometry></library_geometries>
        <library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
        <library_effects><effect id="e">{}<newparam sid="q"><float3>1 0 0</float3></newparam><profile_COMMON><technique>
        <phong><diffuse><param ref="q"/></diffuse></phong></technique></profile_COMMON></effect></library_effects></COLLADA>"##,
        r##"<triangles material="m"><input semantic="POSITION" source="#s"/><p>0 1 2</p></triangles>"##.repeat(40_000),
        r#"<newparam sid="z"/>"#.repeat(100_000)
    );
    let scene = read_mesh(&text, "mesh.dae").unwrap();
    assert_eq!(scene.parts[0].color, Some([1.0, 0.0, 0.0, 1.0]));
}

#[test]
fn a_pattern_that_nests_very_deep() {
    for depth in [300, 100_000] {
        let pattern = "{a,".repeat(depth) + &"}".repeat(depth);
        let text = format!("[[ignore]]\ncode = \"SRC001\"\npath = \"{pattern}\"\nreason = \"r\"\n");
        let error = Settings::from_toml(&text).unwrap_err().to_string();
        assert!(error.contains("cannot be read"), "{error}");
    }
}

/// An element of very many prefixes, and children that have one each: the parser copies all of them for each.
fn prefixes_times_children(count: usize) -> String {
    let declared: String = (0..count).map(|n| format!(" xmlns:p{n}=\"u{n}\"")).collect();
    let children: String = (0..count).map(|n| format!("<c xmlns:q{n}=\"v{n}\"/>")).collect();
    format!("<x{declared}>{children}</x>")
}

#[test]
fn prefixes_times_children_are_counted_wherever_xml_is_read() {
    let inside = prefixes_times_children(6000);
    let start = Instant::now();
    let mesh = MeshFacts::of("m.dae", format!("<COLLADA>{inside}</COLLADA>").as_bytes());
    assert!(mesh.collada.is_none());
    // The carried URDF of a URDD, which DIR020 reads if the names of the robot differ.
    let folder = testkit::temporary::folder();
    let (source, urdd) = (folder.path().join("r.urdf"), folder.path().join("r"));
    std::fs::write(&source, "<robot name=\"r\"><link name=\"a\"/></robot>").unwrap();
    let settings = urdd_generate::Settings::default();
    urdd_generate::generate(&source, &urdd, &settings, &()).unwrap();
    let text = format!("<robot name=\"y\"><link name=\"a\"/>{inside}</robot>");
    std::fs::write(urdd.join("r.urdf"), text).unwrap();
    let metadata = std::fs::read_to_string(urdd.join("urdd.json")).unwrap();
    let other = metadata.replace("\"robot_name\": \"r\"", "\"robot_name\": \"z\"");
    assert_ne!(metadata, other);
    std::fs::write(urdd.join("urdd.json"), other).unwrap();
    let run = urdd_validate::validate(&[urdd], &Settings::default()).unwrap();
    let codes = |code: &str| run.report.urdds[0].findings.iter().any(|of| of.code == code);
    assert!(codes("DIR020") && codes("URD011"), "{:?}", run.report.urdds[0].findings);
    let took = start.elapsed();
    assert!(took < LIMIT, "{took:?}");
}

#[test]
fn what_a_mesh_states_is_not_believed() {
    let stated = u32::MAX.to_le_bytes();
    let stl = [&[0; 80][..], &stated, &[0; 50]].concat();
    let glb = [b"glTF\x02\0\0\0", &stated[..], &stated, b"JSON{}"].concat();
    let collada = |what: &str| {
        format!("<COLLADA><library_geometries>{what}</library_geometries></COLLADA>").into_bytes()
    };
    let arrays = "<geometry id=\"g\"><mesh><source id=\"s\"><float_array count=\"4000000000\">0</float_array>\
        <technique_common><accessor source=\"#s\" count=\"4000000000\" stride=\"4000000000\"/></technique_common></source>\
        <triangles count=\"4000000000\"><input semantic=\"POSITION\" source=\"#s\" offset=\"4000000000\"/><p>0</p></triangles></mesh></geometry>";
    let gltf = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":4000000000000}],"bufferViews":[{"buffer":0,"byteLength":4000000000000}]}"#;
    for (name, bytes) in [
        ("a.stl", stl),
        ("a.glb", glb),
        (
            "a.obj",
            b"v 0 0 0\nf -1 -9223372036854775808 9223372036854775807\nf 4294967297 1 1\n".to_vec(),
        ),
        ("a.obj", b"f -1 -2 -3\n".repeat(200_000)),
        ("a.dae", collada(arrays)),
        ("a.gltf", gltf.as_bytes().to_vec()),
    ] {
        let start = Instant::now();
        let _ = read(&bytes, name, &mut |_| None).map(|scene| assert!(scene.triangle_count() < 3));
        let facts = MeshFacts::of(name, &bytes);
        assert!(facts.size == bytes.len());
        let took = start.elapsed();
        assert!(took < Duration::from_secs(10), "{name}: {took:?}");
    }
}

#[test]
fn toml_takes_time_in_proportion() {
    let bytes = 1 << 20;
    let numbered = |piece: &str| -> String {
        (0..bytes / 16).map(|n| piece.replace('#', &n.to_string())).collect()
    };
    for text in [
        format!("{}a = 1", "a.".repeat(bytes / 2)),
        format!("[{}a]", "a.".repeat(bytes / 2)),
        format!("a = {}", "[".repeat(bytes)),
        format!("a = {}", "{a=".repeat(bytes / 3)),
        "[[ignore]]\n".repeat(bytes / 11),
        "a = 1\n".repeat(bytes / 6),
        numbered("a#.b.c = 1\n"),
        numbered("[a.b#.c]\n"),
        "= ] [".repeat(bytes / 5),
    ] {
        let start = Instant::now();
        assert!(Settings::from_toml(&text).is_err(), "{text:.40}");
        let took = start.elapsed();
        assert!(took < Duration::from_secs(20), "{text:.40}: {took:?}");
    }
}
