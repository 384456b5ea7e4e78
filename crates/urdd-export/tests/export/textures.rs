//! Textures in each format: the images as they were, and where they are on the surface.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs::write;
use std::path::Path;

use crate::made::export;
use urdd_export::{Choices, Export, Format, Note};
use urdd_robot::Robot;

use crate::textured_box::{collada, faces, gltf, jpeg, obj, png};

/// A robot of one link for each mesh, of these names.
fn robot(folder: &Path, meshes: &[&str]) -> Robot {
    let mut urdf = String::from("<robot name=\"boxes\">");
    for (at, mesh) in meshes.iter().enumerate() {
        let _ = write!(
            urdf,
            r#"<link name="l{at}"><visual><geometry><mesh filename="{mesh}"/></geometry>
            <material name="grey"><color rgba="0.5 0.5 0.5 1"/></material></visual></link>"#
        );
        if at > 0 {
            let _ = write!(
                urdf,
                r#"<joint name="j{at}" type="fixed"><origin xyz="0 0 {at}0"/><parent link="l0"/><child link="l{at}"/></joint>"#
            );
        }
    }
    let path = folder.join("boxes.urdf");
    write(&path, urdf + "</robot>").expect("written");
    let urdd = folder.join("urdd");
    urdd_generate::generate(&path, &urdd, &Default::default(), &()).expect("generated");
    Robot::open(&urdd).expect("opened")
}

fn file<'e>(made: &'e Export, path: &str) -> &'e [u8] {
    let found = made.files.iter().find(|(known, _)| known == path);
    &found.unwrap_or_else(|| panic!("{path} is not written")).1
}

/// The corners of an OBJ's triangles: position and texture coordinates, and the normal's direction.
fn corners(obj: &[u8]) -> BTreeSet<String> {
    let text = std::str::from_utf8(obj).expect("text");
    let numbers = |keyword: &str| -> Vec<Vec<f64>> {
        let lines = text.lines().filter_map(|line| line.strip_prefix(keyword));
        let number = |word: &str| word.parse().expect("a number");
        lines.map(|line| line.split_whitespace().map(number).collect()).collect()
    };
    let (vertices, uvs) = (numbers("v "), numbers("vt "));
    let mut found = BTreeSet::new();
    let faces: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("f ")).collect();
    assert_eq!(faces.len(), 12);
    for face in faces {
        let index = |word: &str| word.parse::<usize>().expect("an index") - 1;
        let of = |word: &str| {
            let (vertex, uv) = word.split_once('/').expect("v/vt");
            (vertices[index(vertex)].clone(), uvs[index(uv)].clone())
        };
        let three: Vec<_> = face.split_whitespace().map(of).collect();
        let flat = |axis: usize| three.iter().all(|corner| corner.0[axis] == three[0].0[axis]);
        let axis = (0..3).find(|axis| flat(*axis)).expect("a side");
        found.extend(three.iter().map(|corner| format!("{axis} {:?} {:?}", corner.0, corner.1)));
    }
    found
}

fn expected() -> BTreeSet<String> {
    let faces = faces().into_iter().enumerate();
    let corners = faces.flat_map(|(at, face)| face.map(|corner| (at / 2, corner)));
    corners.map(|(at, (position, uv))| format!("{at} {position:?} {uv:?}")).collect()
}

fn report(made: &Export, key: &str) -> Option<u64> {
    let report: serde_json::Value = serde_json::from_str(&made.report).expect("JSON");
    let entries = report[key].as_array().expect("a list");
    let entry = entries.iter().find(|entry| entry["what"] == "textures of meshes")?;
    entry["count"].as_u64()
}

#[test]
fn each_format_shows_a_texture_where_the_mesh_does() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    (0..3).for_each(|shade| write(at.join(format!("{shade}.png")), png(shade)).expect("written"));
    obj(at, "a", "0.png", true);
    collada(at, "b", "1.png");
    gltf(at, "c", Ok("2.png"));
    gltf(at, "d", Err(&png(3)));
    let robot = robot(at, &["a.obj", "b.dae", "c.gltf", "d.glb"]);
    for format in [Format::Mjcf, Format::Urdf, Format::Drake, Format::Sdf, Format::Moveit] {
        let made = export(&robot, format, &Choices::default()).expect("exported");
        assert_eq!(report(&made, "carried"), Some(4), "{format:?} {}", made.report);
        assert_eq!([report(&made, "otherwise"), report(&made, "lost")], [None; 2]);
        for link in 0..4_u8 {
            let image = format!("meshes/l{link}_texture_0.png");
            assert_eq!(file(&made, &image), png(link), "{format:?}");
            let mut name = format!("l{link}_visual_0");
            if format == Format::Mjcf {
                let geom = format!(r#"" material="l{link}_texture_0"/>"#);
                let before = made.text.split(&geom).next().expect("a geom");
                name = before.rsplit("mesh=\"").next().expect("a mesh").to_owned();
            }
            let mesh = file(&made, &format!("meshes/{name}.obj"));
            assert_eq!(corners(mesh), expected(), "{format:?}, link {link}");
            let text = std::str::from_utf8(mesh).expect("text");
            let library = text.lines().find_map(|line| line.strip_prefix("mtllib "));
            if format == Format::Mjcf {
                assert_eq!(library, None);
                for wanted in [
                    format!(r#"<texture name="l{link}_texture_0" type="2d" file="{image}"/>"#),
                    format!(r#"<material name="l{link}_texture_0" texture="l{link}_texture_0"/>"#),
                ] {
                    assert!(made.text.contains(&wanted), "{wanted}\n{}", made.text);
                }
                continue;
            }
            let library = file(&made, &format!("meshes/{}", library.expect("a library")));
            let library = std::str::from_utf8(library).expect("text");
            assert!(library.contains(&format!("map_Kd l{link}_texture_0.png\n")), "{library}");
            assert!(!made.text.contains("<material"), "its own material counts: {}", made.text);
        }
    }
}

/// The mesh of a USD as an OBJ.
fn obj_of(mesh: &testkit::usda::Prim) -> String {
    let mut text = String::new();
    for point in mesh.numbers("points").chunks(3) {
        let _ = writeln!(text, "v {} {} {}", point[0], point[1], point[2]);
    }
    for place in mesh.numbers("primvars:st").chunks(2) {
        let _ = writeln!(text, "vt {} {}", place[0], place[1]);
    }
    for face in mesh.numbers("faceVertexIndices").chunks(3) {
        let corner = |k: usize| format!("{0}/{0}", face[k] + 1.0);
        let _ = writeln!(text, "f {} {} {}", corner(0), corner(1), corner(2));
    }
    text
}

#[test]
fn usd_shows_a_texture_where_the_mesh_does() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    write(at.join("0.png"), png(0)).expect("written");
    write(at.join("1.jpg"), jpeg()).expect("written");
    obj(at, "a", "0.png", true);
    collada(at, "b", "1.jpg");
    obj(at, "c", "missing.png", true);
    let robot = robot(at, &["a.obj", "b.dae", "c.obj"]);
    let made = export(&robot, Format::Usd, &Choices::default()).expect("exported");
    assert_eq!([report(&made, "carried"), report(&made, "lost")], [Some(2), Some(1)]);
    let read = crate::usd::Read::new(&made.text);
    for (link, ending) in [(0, "png"), (1, "jpg")] {
        let mesh = read.links()[link].child("visuals").child("mesh");
        assert_eq!(corners(obj_of(mesh).as_bytes()), expected(), "{link}");
        let material = mesh.get("material:binding").text();
        let all = read.root.all();
        let image = all.iter().find(|prim| prim.path == format!("{material}/image"));
        let path = image.expect("an image").get("inputs:file").text();
        assert_eq!(path, format!("./meshes/l{link}_texture_0.{ending}"));
        file(&made, &path[2..]);
    }
    // What is missing has the colour of the URDF, half of the way by sRGB's curve.
    let plain = read.links()[2].child("visuals").child("mesh");
    let material = plain.get("material:binding").text();
    let all = read.root.all();
    let surface = all.iter().find(|prim| prim.path == format!("{material}/surface"));
    let grey = surface.expect("a surface").numbers("inputs:diffuseColor")[0];
    assert!((grey - ((0.5f64 + 0.055) / 1.055).powf(2.4)).abs() < 1e-7);
}

#[test]
fn programs_that_read_no_jpeg_get_png() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path().join("0.jpg"), jpeg()).expect("written");
    obj(folder.path(), "a", "0.jpg", true);
    let robot = robot(folder.path(), &["a.obj"]);
    let made = export(&robot, Format::Urdf, &Choices::default()).expect("exported");
    assert_eq!(file(&made, "meshes/l0_texture_0.jpg"), jpeg());
    assert_eq!([report(&made, "carried"), report(&made, "otherwise")], [Some(1), None]);
    for format in [Format::Mjcf, Format::Drake, Format::Sdf] {
        let made = export(&robot, format, &Choices::default()).expect("exported");
        let image = file(&made, "meshes/l0_texture_0.png");
        let mut image = png::Decoder::new(std::io::Cursor::new(image)).read_info().expect("PNG");
        let mut pixels = vec![0; image.output_buffer_size().expect("a size")];
        let size = image.next_frame(&mut pixels).expect("pixels");
        assert_eq!((size.width, size.height, size.color_type), (4, 4, png::ColorType::Rgb));
        // The source has 16 times the index of each pixel in grey; JPEG keeps it about.
        let off = pixels.chunks(3).zip(0..).map(|(rgb, at)| (i32::from(rgb[0]) - 16 * at).abs());
        assert!(off.clone().all(|off| off < 20), "{:?}", off.collect::<Vec<_>>());
        assert_eq!([report(&made, "carried"), report(&made, "otherwise")], [None, Some(1)]);
        assert!(made.notes.iter().any(|note| matches!(note, Note::ConvertedTextures(_))));
    }
}

/// A PNG whose header states another size.
fn png_of(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    png::Encoder::new(&mut bytes, width, height).write_header().expect("a header");
    bytes
}

/// A JPEG whose header states another size.
fn jpeg_of(width: u16, height: u16) -> Vec<u8> {
    let mut bytes = jpeg();
    let frame = bytes.windows(2).position(|mark| mark == [0xff, 0xc0]).expect("a frame");
    let size = [height.to_be_bytes(), width.to_be_bytes()].concat();
    bytes[frame + 5..frame + 9].copy_from_slice(&size);
    bytes
}

/// A colour profile of 256 MB, in a file of 300 kB.
#[test]
fn a_profile_that_inflates_without_end_ends() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    let mut info = png::Info::with_size(4, 4);
    info.color_type = png::ColorType::Rgb;
    info.icc_profile = Some(vec![0; 256 << 20].into());
    let mut bytes = Vec::new();
    let encoder = png::Encoder::with_info(&mut bytes, info).expect("an encoder");
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[7; 48]).expect("an image");
    drop(writer);
    assert!(bytes.len() < 1 << 20, "{}", bytes.len());
    write(at.join("a.png"), bytes).expect("written");
    obj(at, "a", "a.png", true);
    let robot = robot(at, &["a.obj"]);
    let start = std::time::Instant::now();
    export(&robot, Format::Mjcf, &Choices::default()).expect("exported");
    assert!(start.elapsed().as_secs() < 30, "{:?}", start.elapsed());
}

#[test]
fn what_is_no_texture_leaves_a_plain_colour() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    let cut = png(0)[..png(0).len() - 20].to_vec();
    let mut flipped = png(0);
    let middle = flipped.len() / 2;
    flipped[middle] ^= 1;
    let images = [
        ("missing", None, "does not carry it"),
        ("text", Some(b"not an image".to_vec()), "does not carry it"),
        ("../out", None, "does not carry it"),
        ("cut", Some(cut), "broken"),
        ("flipped", Some(flipped), "broken"),
        ("half", Some(jpeg()[..165].to_vec()), "broken"),
        ("huge", Some(png_of(100_000, 100_000)), "pixels"),
        ("vast", Some(png_of(i32::MAX.cast_unsigned(), i32::MAX.cast_unsigned())), "pixels"),
        ("wide", Some(jpeg_of(16_000, 16_000)), "pixels"),
        (
            "bitmap",
            Some(
                b"BM\x3a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x01\0\0\0\x01\0\0\0\x01\0\x18\0"
                    .to_vec(),
            ),
            "Bmp",
        ),
        ("unplaced", Some(png(1)), "does not say where"),
    ];
    let mut meshes = Vec::new();
    for (name, image, _) in &images {
        if let Some(image) = image {
            write(at.join(format!("{name}.png")), image).expect("written");
        }
        let mesh = name.trim_start_matches("../");
        obj(at, mesh, &format!("{name}.png"), *name != "unplaced");
        meshes.push(format!("{mesh}.obj"));
    }
    write(at.join("good.png"), png(2)).expect("written");
    obj(at, "good", "good.png", true);
    meshes.push("good.obj".to_owned());
    let robot = robot(at, &meshes.iter().map(String::as_str).collect::<Vec<_>>());
    for format in [Format::Mjcf, Format::Urdf, Format::Drake, Format::Sdf] {
        let made = export(&robot, format, &Choices::default()).expect("exported");
        for (name, _, why) in &images {
            let name = name.trim_start_matches("../");
            let is_it = |note: &&Note| match note {
                Note::LostTexture { texture, .. } => texture.ends_with(&format!("/{name}.png")),
                _ => false,
            };
            let note =
                made.notes.iter().find(is_it).unwrap_or_else(|| panic!("{name}: {:?}", made.notes));
            assert!(note.to_string().contains(why), "{note}");
        }
        assert_eq!([report(&made, "carried"), report(&made, "lost")], [Some(1), Some(11)]);
        // SDF has it as ambient and diffuse, URDF as the name of a material too.
        let each = if format == Format::Mjcf { 1 } else { 2 };
        assert_eq!(made.text.matches("0.5 0.5 0.5 1").count(), each * 11);
        // All that is plain is one mesh.
        let painted = made.files.iter().filter(|(_, bytes)| bytes.starts_with(b"mtllib")).count();
        assert_eq!(painted, usize::from(format != Format::Mjcf));
        let pictures = made.files.iter().filter(|(path, _)| path.ends_with(".png")).count();
        assert_eq!(pictures, 1);
    }
}

#[test]
fn names_of_files_stay_in_the_folder_and_apart() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    write(at.join("0.png"), png(0)).expect("written");
    write(at.join("1.png"), png(1)).expect("written");
    obj(at, "a", "0.png", true);
    obj(at, "b", "1.png", true);
    let urdf = r#"<robot name="names"><link name="../x"/><link name="/x"/><link name=".._x"/>
        <joint name="j" type="fixed"><parent link="../x"/><child link="/x"/></joint>
        <joint name="k" type="fixed"><parent link="../x"/><child link=".._x"/></joint></robot>"#;
    let visual = |mesh: &str| {
        format!(r#"<visual><geometry><mesh filename="{mesh}.obj"/></geometry></visual>"#)
    };
    let urdf = urdf.replacen("\"../x\"/>", &format!("\"../x\">{}</link>", visual("a")), 1);
    let urdf = urdf.replacen("\"/x\"/>", &format!("\"/x\">{}</link>", visual("b")), 1);
    let urdf = urdf.replacen("\".._x\"/>", &format!("\".._x\">{}</link>", visual("a")), 1);
    write(at.join("names.urdf"), urdf).expect("written");
    urdd_generate::generate(&at.join("names.urdf"), &at.join("urdd"), &Default::default(), &())
        .expect("generated");
    let robot = Robot::open(at.join("urdd")).expect("opened");
    let made = export(&robot, Format::Urdf, &Choices::default()).expect("exported");
    let mut paths: Vec<String> =
        made.files.iter().map(|(path, _)| path.to_ascii_lowercase()).collect();
    for path in &paths {
        let name = path.strip_prefix("meshes/").expect("in the folder");
        assert!(!name.contains(['/', '\\', ' ']) && !name.starts_with('.'), "{path}");
    }
    paths.dedup();
    assert_eq!(paths.len(), made.files.len());
    // One image, one library and one mesh of each kind: `.._x` looks as `../x` does.
    assert_eq!(
        paths.iter().filter(|path| path.contains("visual") || path.contains("texture")).count(),
        4,
        "{paths:?}"
    );
}
