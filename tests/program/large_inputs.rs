//! Files that are larger than any real one in one respect: time and memory stay in proportion.
//!
//! Each takes a second or so on an idle machine. Each took minutes, or more memory than available, before its limit
//! existed.

use std::time::{Duration, Instant};

use urdd_geometry::read::{Fault, MeshError, Scene, read};
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
