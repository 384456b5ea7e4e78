//! Pictures of robots without meshes of their own.

use std::fs;
use std::path::Path;

use urdd_generate::{Selection, Settings, generate};

use super::asking::Running;

/// Red, green, blue and opacity of each pixel.
fn pixels(png: &[u8]) -> Vec<u8> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut pixels).expect("a frame");
    pixels
}

/// The pictures of a URDD with meshes and of one with these modules look alike: of the same robot, they are drawn of the
/// URDF's shapes and of the meshes that were made of them.
fn looks_the_same_with(modules: &[&str], urdf: &Path) {
    let folder = testkit::temporary::folder();
    let [whole, part] = [["plain_meshes"].as_slice(), modules].map(|modules| {
        let target = folder.path().join(format!("with_{}", modules.len()));
        let selection = Selection::parse(modules.iter().copied()).expect("modules");
        let settings = Settings { selection, ..Settings::default() };
        generate(urdf, &target, &settings, &()).expect("a URDD");
        let name = target.file_name().and_then(|name| name.to_str()).expect("a name");
        let picture = Running::on(&target).get(&format!("/robots/{name}/picture.png"));
        assert_eq!(picture.status, 200, "{modules:?}");
        pixels(&picture.body)
    });
    let differ = whole
        .chunks(4)
        .zip(part.chunks(4))
        .filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 8));
    let (differ, seen) = (differ.count(), whole.chunks(4).filter(|pixel| pixel[3] > 0).count());
    assert!(seen > 2000 && differ * 200 < seen, "{differ} of {seen} pixels differ");
}

#[test]
fn a_robot_without_meshes_is_drawn_of_the_shapes_of_its_urdf() {
    let folder = testkit::temporary::folder();
    let urdf = folder.path().join("shapes.urdf");
    let text = r#"<robot name="shapes"><material name="red"><color rgba="1 0 0 1"/></material>
        <link name="a"><visual><origin xyz="0 0 1" rpy="0.4 0.3 0.2"/><geometry><box size="1 2 3"/></geometry>
        <material name="red"/></visual>
        <visual><geometry><cylinder radius="0.3" length="4"/></geometry></visual></link>
        <link name="b"><visual><origin xyz="0 0 2"/><geometry><sphere radius="1"/></geometry></visual>
        <collision><geometry><box size="9 9 9"/></geometry></collision></link>
        <joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin xyz="1 1 0" rpy="0 1 0"/></joint></robot>"#;
    fs::write(&urdf, text).expect("written");
    looks_the_same_with(&[], &urdf);
}

#[test]
fn a_robot_without_plain_meshes_is_drawn_of_the_meshes_that_its_urdf_names() {
    let urdf = testkit::repository().join("conformance/robots/scaled_parts.urdf");
    looks_the_same_with(&["original_meshes", "bounds"], &urdf);
}

#[test]
fn a_link_without_a_visual_shape_is_drawn_of_its_collision_elements() {
    let folder = testkit::temporary::folder();
    let urdf = folder.path().join("shapes.urdf");
    let text = r#"<robot name="r"><link name="a"><visual/>
        <collision><geometry><capsule radius="1" length="2"/></geometry></collision></link></robot>"#;
    fs::write(&urdf, text).expect("written");
    looks_the_same_with(&[], &urdf);
}
