//! What links of a USD have: shapes, looks, materials, and what the robot has.

use std::collections::BTreeMap;
use std::fs::write;

use testkit::usda::{Prim, Value, parsed};
use urdd_export::{Choices, Export, Format, Setup};
use urdd_robot::{Robot, ShapeKind};

use crate::made::{export, exported, robot, urdf};
use crate::mjcf_actuators::name_configuration;
use crate::textured_box::png;
use crate::usd::Read;
use crate::usd_input::{grid, joint, link};

/// A robot of one link `a` with these elements, beside files of these names.
fn robot_of(parts: &str, files: &[(&str, Vec<u8>)]) -> (tempfile::TempDir, Robot) {
    let folder = testkit::temporary::folder();
    for (name, bytes) in files {
        write(folder.path().join(name), bytes).expect("a file");
    }
    let source = folder.path().join("r.urdf");
    write(&source, urdf(&format!("<link name=\"a\">{parts}</link>"))).expect("a URDF");
    let target = folder.path().join("r");
    urdd_generate::generate(&source, &target, &Default::default(), &()).expect("a URDD");
    let robot = Robot::open(&target).expect("a robot");
    (folder, robot)
}

fn with_shapes(robot: &Robot, shapes: ShapeKind) -> (Export, Read) {
    let made = export(robot, Format::Usd, &Choices { shapes: shapes.into(), ..Choices::default() });
    let made = made.expect("an export");
    let read = Read::new(&made.text);
    (made, read)
}

fn file(made: &Export, path: &str) -> Prim {
    let found = made.files.iter().find(|(known, _)| known == path);
    let (_, bytes) = found.unwrap_or_else(|| panic!("{path} is not written"));
    parsed(std::str::from_utf8(bytes).expect("text"))
}

const BOX: &str =
    r#"<visual><origin xyz="1 2 3"/><geometry><box size="0.2 0.4 0.6"/></geometry></visual>"#;

#[test]
fn shapes_are_where_the_urdf_has_them_and_are_not_rendered() {
    let (_folder, robot) = robot_of(BOX, &[]);
    let is_near = |found: &[f64], expected: &[f64]| {
        assert_eq!(found.len(), expected.len());
        let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-6, "{found:?} {expected:?}");
    };
    for kind in [ShapeKind::Pieces, ShapeKind::Boxes, ShapeKind::Spheres] {
        let (_, read) = with_shapes(&robot, kind);
        let holder = read.links()[0].child("collisions");
        assert_eq!(holder.get("purpose").text(), "guide");
        let shape = holder.child("piece_0");
        assert!(shape.applies("PhysicsCollisionAPI"));
        if kind == ShapeKind::Pieces {
            assert!(shape.applies("PhysicsMeshCollisionAPI"));
            assert_eq!(shape.get("physics:approximation").text(), "convexHull");
            assert_eq!(shape.get("subdivisionScheme").text(), "none");
            is_near(&shape.numbers("extent"), &[0.9, 1.8, 2.7, 1.1, 2.2, 3.3]);
            continue;
        }
        is_near(&shape.numbers("xformOp:translate"), &[1.0, 2.0, 3.0]);
        if kind == ShapeKind::Boxes {
            assert_eq!(shape.numbers("size"), [1.0]);
            is_near(&shape.numbers("extent"), &[-0.5, -0.5, -0.5, 0.5, 0.5, 0.5]);
            // The order of its axes is the fit's.
            let mut sizes = shape.numbers("xformOp:scale");
            sizes.sort_by(f64::total_cmp);
            is_near(&sizes, &[0.2, 0.4, 0.6]);
        } else {
            let radius = (0.1f64 * 0.1 + 0.2 * 0.2 + 0.3 * 0.3).sqrt();
            is_near(&shape.numbers("radius"), &[radius]);
            is_near(&shape.numbers("extent")[3..], &[radius; 3]);
        }
    }
}

#[test]
fn a_flat_piece_is_a_thin_box() {
    let corners = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
    let plate = r#"<visual><geometry><mesh filename="plate.obj"/></geometry></visual>"#;
    let (_folder, robot) = robot_of(plate, &[("plate.obj", corners.into())]);
    let (made, read) = with_shapes(&robot, ShapeKind::Pieces);
    let plate = read.links()[0].child("collisions").child("piece_0");
    assert_eq!(plate.kind, "Cube");
    let mut sizes = plate.numbers("xformOp:scale");
    sizes.sort_by(f64::total_cmp);
    assert!(sizes[0] < 1e-5 && sizes[0] > 0.0, "{sizes:?}");
    assert!((sizes[1] - 1.0).abs() < 1e-6 && (sizes[2] - 2.0).abs() < 1e-6, "{sizes:?}");
    // The thin side is along z.
    let [w, x, y, z] = plate.numbers("xformOp:orient")[..] else { panic!("a quaternion") };
    let turn = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
    let scale = plate.numbers("xformOp:scale");
    let thin = scale.iter().position(|size| *size == sizes[0]).expect("a side");
    let axis = turn.to_rotation_matrix().matrix().column(thin).into_owned();
    assert!((axis.z.abs() - 1.0).abs() < 1e-6, "{axis}");
    assert!(made.notes.iter().any(|note| note.to_string().contains("flat")), "{:?}", made.notes);
}

/// Points of a ball, a hull of which is long as text.
fn ball() -> String {
    let (rings, sides) = (30, 40);
    let mut text = String::new();
    for ring in 1..rings {
        let theta = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
        for side in 0..sides {
            let phi = std::f64::consts::TAU * f64::from(side) / f64::from(sides);
            let (x, y, z) = (theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
            text += &format!("v {x} {y} {z}\n");
        }
    }
    for ring in 0..rings - 2 {
        for side in 0..sides {
            let at = |ring: i32, side: i32| ring * sides + side % sides + 1;
            let [a, b] = [at(ring, side), at(ring, side + 1)];
            let [c, d] = [at(ring + 1, side), at(ring + 1, side + 1)];
            text += &format!("f {a} {c} {b}\nf {b} {c} {d}\n");
        }
    }
    let cap = |first: i32| (0..sides).map(|k| (first + k).to_string()).collect::<Vec<_>>();
    text += &format!("f {}\n", cap(1).join(" "));
    let mut last = cap((rings - 2) * sides + 1);
    last.reverse();
    text + &format!("f {}\n", last.join(" "))
}

#[test]
fn a_long_shape_is_a_file_that_the_link_refers_to() {
    let visual = r#"<visual><geometry><mesh filename="ball.obj"/></geometry></visual>"#;
    let (_folder, robot) = robot_of(visual, &[("ball.obj", ball().into())]);
    let output = Some("x@y.usda".into());
    let odd = Choices { shapes: ShapeKind::Hulls.into(), output, ..Choices::default() };
    let odd = export(&robot, Format::Usd, &odd).expect("an export").text;
    // A path with `@` in it has three around it.
    assert!(odd.contains("@@@./x@y_meshes/a_piece_0.usda@@@"), "{odd}");
    let (made, read) = with_shapes(&robot, ShapeKind::Hulls);
    let piece = read.links()[0].child("collisions").child("piece_0");
    let path = piece.metadata["references"].text();
    assert_eq!(path, "./meshes/a_piece_0.usda");
    assert!(piece.applies("PhysicsMeshCollisionAPI") && !piece.properties.contains_key("points"));
    let mesh = &file(&made, &path[2..]).children[0];
    assert_eq!((mesh.kind.as_str(), mesh.numbers("points").len()), ("Mesh", 3 * 29 * 40));
}

#[test]
fn colours_of_one_link_are_subsets_of_its_mesh() {
    let visual = |z: f64, color: &str| {
        format!(
            r#"<visual><origin xyz="0 0 {z}"/><geometry><box size="0.1 0.1 0.1"/></geometry>{color}</visual>"#
        )
    };
    let color = |name: &str, rgba: &str| {
        format!(r#"<material name="{name}"><color rgba="{rgba}"/></material>"#)
    };
    let parts = visual(0.0, &color("red", "1 0 0 1"))
        + &visual(1.0, "")
        + &visual(2.0, &color("blue", "0 0 1 0.5"));
    let (_folder, robot) = robot_of(&parts, &[]);
    let read = Read::new(&exported(&robot, Format::Usd).text);
    let mesh = read.links()[0].child("visuals").child("mesh");
    assert_eq!(mesh.numbers("doubleSided"), [1.0]);
    assert_eq!(mesh.get("subsetFamily:materialBind:familyType").text(), "nonOverlapping");
    let points = mesh.numbers("points");
    let corners = mesh.numbers("faceVertexIndices");
    let all = read.root.all();
    let mut found: Vec<(f64, Vec<f64>, f64)> = Vec::new();
    for subset in &mesh.children {
        assert_eq!(subset.kind, "GeomSubset");
        assert!(subset.applies("MaterialBindingAPI"));
        let heights = subset.numbers("indices").into_iter().flat_map(|face| {
            (0..3)
                .map(move |k| 3 * face as usize + k)
                .map(|corner| points[3 * corners[corner] as usize + 2])
        });
        let height = heights.clone().fold(f64::INFINITY, f64::min) + 0.05;
        assert!(heights.clone().all(|z| z <= height + 0.05 + 1e-6), "one box");
        assert_eq!(heights.count(), 36);
        let material = subset.get("material:binding").text();
        let of = |path: String| all.iter().find(|prim| prim.path == path).expect("a prim");
        let material = of(material.to_owned());
        let surface = of(format!("{}/surface", material.path));
        let output = material.get("outputs:surface.connect").text();
        assert_eq!(output, format!("{}.outputs:surface", surface.path));
        found.push((
            height.round(),
            surface.numbers("inputs:diffuseColor"),
            surface.numbers("inputs:opacity")[0],
        ));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let expected = [(0.0, vec![1.0, 0.0, 0.0], 1.0), (2.0, vec![0.0, 0.0, 1.0], 0.5)];
    assert_eq!(found, expected);
}

#[test]
fn a_payload_has_its_own_textures() {
    let text = grid(2000);
    let places: String = (0..=2000).map(|k| format!("vt {} 0\nvt {} 1\n", k % 2, k % 2)).collect();
    let faces = text.lines().filter_map(|line| line.strip_prefix("f "));
    let faces: String = faces
        .map(|face| {
            let corners: Vec<_> = face.split(' ').map(|of| format!("{of}/{of}")).collect();
            format!("f {}\n", corners.join(" "))
        })
        .collect();
    let vertices: String = text
        .lines()
        .filter(|line| line.starts_with("v "))
        .map(|line| format!("{line}\n"))
        .collect();
    let mesh = format!("mtllib m.mtl\n{vertices}{places}usemtl m\n{faces}");
    let files = [
        ("long.obj", mesh.into_bytes()),
        ("m.mtl", b"newmtl m\nmap_Kd 0.png\n".to_vec()),
        ("0.png", png(0)),
    ];
    let visual = r#"<visual><geometry><mesh filename="long.obj"/></geometry></visual>"#;
    let (_folder, robot) = robot_of(visual, &files);
    let made = exported(&robot, Format::Usd);
    let read = Read::new(&made.text);
    let visuals = read.links()[0].child("visuals");
    assert_eq!(visuals.metadata["instanceable"].text(), "true");
    let path = visuals.metadata["payload"].text();
    let payload = file(&made, &path[2..]);
    let material = payload.children[0].child("Looks").child("texture_0");
    // Beside the payload, which is where the images are.
    assert_eq!(material.child("image").get("inputs:file").text(), "./a_texture_0.png");
    assert!(made.files.iter().any(|(known, _)| known == "meshes/a_texture_0.png"));
    let connects = |prim: &Prim, input: &str, output: &str| {
        let found = prim.get(&format!("inputs:{input}.connect")).text().to_owned();
        assert_eq!(found, format!("{}/{output}", material.path));
    };
    connects(material.child("surface"), "diffuseColor", "image.outputs:rgb");
    connects(material.child("image"), "st", "place.outputs:result");
    assert_eq!(material.child("image").get("inputs:sourceColorSpace").text(), "sRGB");
    assert_eq!(material.child("image").get("inputs:wrapS").text(), "repeat");
    let mesh = payload.children[0].child("mesh");
    assert_eq!(mesh.numbers("primvars:st").len() / 2, mesh.numbers("points").len() / 3);
}

#[test]
fn a_friction_that_a_person_chose_is_that_of_all_shapes() {
    let (_folder, robot) = robot_of(BOX, &[]);
    let setup = Setup::from_toml("robot = \"r\"\n[contact]\nfriction = 0.75", "x", &robot);
    let choices = Choices { setup: Some(setup.expect("a setup")), ..Choices::default() };
    let read = Read::new(&export(&robot, Format::Usd, &choices).expect("an export").text);
    let material = read.root.child("Looks").child("contact");
    assert!(material.applies("PhysicsMaterialAPI"));
    for kind in ["static", "dynamic"] {
        assert_eq!(material.numbers(&format!("physics:{kind}Friction")), [0.75]);
    }
    let shape = read.links()[0].child("collisions").child("piece_0");
    assert_eq!(shape.get("material:binding:physics").text(), material.path);
}

fn custom(prim: &Prim) -> &BTreeMap<String, Value> {
    let Value::Dictionary(data) = &prim.metadata["customData"] else { panic!("data") };
    let Value::Dictionary(data) = &data["urdd"] else { panic!("data") };
    data
}

#[test]
fn the_robot_is_one_articulation_whose_parts_say_what_they_are() {
    let element = "<note>two\nlines</note>";
    let parts = format!("<link name=\"a\">{element}</link>")
        + &link("Looks", "")
        + &joint("turn", "continuous", "a", "Looks", &format!("<axis xyz=\"0 0 1\"/>{element}"));
    let name = "1st robot";
    let (folder, robot) = robot(&format!("<robot name=\"{name}\">{parts}</robot>"));
    name_configuration(&robot, &folder.path().join("robot"), "at home", "turn");
    let robot = Robot::open(folder.path().join("robot")).expect("a robot");
    let made = exported(&robot, Format::Usd);
    let read = Read::new(&made.text);
    assert_eq!((read.root.name(), read.root.shown()), ("_1st_robot", name));
    assert!(read.root.applies("PhysicsArticulationRootAPI"));
    assert_eq!(read.root.metadata["kind"].text(), "component");
    assert!(read.links().iter().all(|link| link.applies("PhysicsMassAPI")));
    assert!(made.notes.iter().any(|note| note.to_string().contains(name)), "{:?}", made.notes);
    for prim in [read.links()[0], read.joint("turn")] {
        assert_eq!(custom(prim)["elements"].list()[0].text(), element);
    }
    let position = BTreeMap::from([("turn".to_owned(), Value::Number(0.5))]);
    let named = BTreeMap::from([("at home".to_owned(), Value::Dictionary(position))]);
    assert_eq!(custom(&read.root)["configurations"], Value::Dictionary(named));
    let file = parsed(&made.text);
    assert!(file.metadata["doc"].text().contains(name), "{:?}", file.metadata["doc"]);
}

/// Each mesh has a normal for each triangle: of length 1, perpendicular to its sides, outwards by its winding.
#[test]
fn meshes_have_normals() {
    let mut count = 0;
    for (name, urdf) in testkit::robots::our_robots() {
        let (_folder, path) = testkit::robots::made(&urdf);
        let robot = urdd_robot::Robot::open(path).expect("a robot");
        let made = crate::made::exported(&robot, urdd_export::Format::Usd);
        let files = made.files.iter().filter(|(path, _)| path.ends_with(".usda"));
        let texts = files.map(|(_, bytes)| std::str::from_utf8(bytes).expect("text"));
        for text in texts.chain([made.text.as_str()]) {
            for mesh in testkit::usda::parsed(text).children[0].all() {
                if mesh.kind != "Mesh" || !mesh.properties.contains_key("points") {
                    continue;
                }
                let three = |key: &str| -> Vec<nalgebra::Vector3<f64>> {
                    let numbers = mesh.numbers(key);
                    numbers.chunks(3).map(nalgebra::Vector3::from_column_slice).collect()
                };
                let (points, normals) = (three("points"), three("normals"));
                let faces = mesh.numbers("faceVertexIndices");
                assert_eq!(normals.len(), faces.len() / 3, "{name}");
                for (face, normal) in faces.chunks(3).zip(&normals) {
                    let [a, b, c] = [0, 1, 2].map(|k| points[face[k] as usize]);
                    let across = (b - a).cross(&(c - a));
                    assert!((normal.norm() - 1.0).abs() < 1e-4, "{name}: {normal}");
                    // Points are binary32: the direction of a sliver is known to its height.
                    let long = (b - a).norm().max((c - a).norm()).max((c - b).norm());
                    let off = 1e-4
                        + 1e-6 * long * points.iter().map(|p| p.amax()).fold(long, f64::max)
                            / across.norm();
                    assert!(
                        (normal - across.normalize()).amax() < off.min(2.0) || across.norm() == 0.0
                    );
                    count += 1;
                }
            }
        }
    }
    assert!(count > 500, "{count}");
}
