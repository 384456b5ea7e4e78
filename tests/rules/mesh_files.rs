//! MSH013 to MSH023: the content of mesh files.

use serde_json::{Value, json};
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::read::Part;
use urdd_geometry::write;
use urdd_validate::code::Code::*;

use crate::legacy_robot::LegacyRobot;
use crate::meshes::{HULLS, ORIGINAL, PIECES, PLAIN, boxy, legacy, robot_of, text};
use crate::{Case, changed, in_folder, invalid, near_miss};
use testkit::fixture::{Fixture, ROOT};
use testkit::robot::*;

/// The base: a box of 0.4 by 0.4 by 0.1 m around its link's origin, which is also its only piece.
pub const BASE: usize = 1;

/// The path of the entry of a link, or of its first piece.
pub fn entry(module: &str, link: usize) -> String {
    match module {
        PLAIN => format!("/link_meshes/{link}/files"),
        HULLS => format!("/link_hulls/{link}"),
        _ => format!("/link_pieces/{link}/0"),
    }
}

pub fn path(f: &Fixture, module: &str, link: usize, format: &str) -> String {
    text(f, module, &format!("{}/{format}", entry(module, link)))
}

/// A mesh, as read from its OBJ file.
pub fn read(f: &Fixture, module: &str, link: usize) -> Mesh {
    let obj = String::from_utf8(f.file(&path(f, module, link, "obj")).to_vec()).expect("text");
    let mut mesh = Mesh::default();
    for line in obj.lines() {
        let mut words = line.split(' ');
        let kind = words.next();
        match kind {
            Some("v") => {
                let numbers: Vec<f64> = words.map(|w| w.parse().expect("a number")).collect();
                mesh.vertices.push(numbers.try_into().expect("three numbers"));
            }
            Some("f") => {
                let corners: Vec<u32> = words.map(|w| w.parse().expect("an index")).collect();
                let [a, b, c]: [u32; 3] = corners.try_into().expect("three corners");
                mesh.triangles.push([a - 1, b - 1, c - 1]);
            }
            _ => {}
        }
    }
    mesh
}

pub fn put(f: &mut Fixture, module: &str, link: usize, format: &str, mesh: &Mesh) {
    let parts = [Part::from(mesh.clone())];
    let bytes = match format {
        "stl" => write::stl(&parts),
        "obj" => write::obj(&parts),
        _ => write::glb(&parts),
    };
    let path = path(f, module, link, format);
    f.put_file(&path, bytes.expect("a mesh that can be written"));
}

/// Changes a mesh in some of its formats.
pub fn rewrite(f: &mut Fixture, module: &str, formats: &[&str], change: impl Fn(&mut Mesh)) {
    let mut mesh = read(f, module, BASE);
    change(&mut mesh);
    for format in formats {
        put(f, module, BASE, format, &mesh);
    }
}

pub const ALL: &[&str] = &["stl", "obj", "glb"];

/// The next binary32.
fn up(x: f64) -> f64 {
    f64::from((x as f32).next_up())
}

/// Two boxes; the second names a file without a surface.
pub fn bare() -> Fixture {
    let mut bare = link("b");
    bare.visual.push(visual(None, mesh("package://robot/bare.stl", None)));
    let mut fixture = Fixture::full(&robot_of(vec![boxy("a"), bare]));
    let path = format!("mesh_modules/{ORIGINAL}/meshes/bare.stl");
    fixture.put_file(&path, vec![0; 84]);
    fixture.set(ORIGINAL, "/references/0/path", json!(path));
    let file = json!({"path": path, "side_files": [], "usable": false});
    fixture.set(ORIGINAL, "/files/-", file);
    let entry = json!({"path": path, "size": 0, "sha256": ""});
    let listed = fixture.doc_mut(ROOT).pointer_mut("/modules/6/files");
    let listed = listed.and_then(Value::as_array_mut).expect("a list");
    listed.insert(1, entry);
    fixture
}

/// Changes the JSON of a GLB.
pub fn change_gltf(f: &mut Fixture, module: &str, change: impl Fn(&mut Value)) {
    let path = path(f, module, BASE, "glb");
    let bytes = f.file(&path).to_vec();
    let length = |at: usize| {
        let four: [u8; 4] = bytes[at..at + 4].try_into().expect("four");
        u32::from_le_bytes(four) as usize
    };
    let end = 20 + length(12);
    let mut gltf: Value = serde_json::from_slice(&bytes[20..end]).expect("JSON");
    change(&mut gltf);
    let mut json = gltf.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut new = bytes[..12].to_vec();
    new.extend((json.len() as u32).to_le_bytes());
    new.extend(b"JSON");
    new.extend(json);
    new.extend(&bytes[end..]);
    let total = (new.len() as u32).to_le_bytes();
    new[8..12].copy_from_slice(&total);
    f.put_file(&path, new);
}

/// A box that is its own only piece, and a link without a shape.
pub fn lone_box() -> Fixture {
    Fixture::full(&robot_of(vec![link("a"), boxy("b")]))
}

/// Makes the piece of the lone box larger, and its box and sphere with it.
pub fn grow_piece(f: &mut Fixture, factor: f64) {
    const APPROXIMATIONS: &str = "link_shapes_approximations_module";
    const REACH: &str = "link_shapes_max_distance_from_origin_module";
    let mut mesh = read(f, PIECES, BASE);
    for vertex in &mut mesh.vertices {
        *vertex = vertex.map(|x| f64::from((x * factor) as f32));
    }
    for format in ALL {
        put(f, PIECES, BASE, format, &mesh);
    }
    let half = mesh.vertices[0].map(f64::abs);
    let reach = half.iter().map(|h| h * h).sum::<f64>().sqrt();
    f.set(APPROXIMATIONS, "/decomposition_obbs/1/0/half_extents", json!(half));
    f.set(APPROXIMATIONS, "/decomposition_bounding_spheres/1/0/radius", json!(reach));
    for list in ["convex_hulls", "obbs", "bounding_spheres"] {
        let pointer = format!("/decomposition_{list}_maximum_distances/1/0");
        f.set(REACH, &pointer, json!(reach));
    }
}

pub fn cases() -> Vec<Case> {
    let mut cases = files();
    cases.extend(sources());
    cases.extend(bodies());
    cases
}

/// MSH013 and MSH014.
fn files() -> Vec<Case> {
    vec![
        invalid(MSH013, "stl-cut-off", |f| {
            let path = path(f, HULLS, BASE, "stl");
            let bytes = f.file(&path).to_vec();
            f.put_file(&path, &bytes[..bytes.len() - 1]);
        }),
        invalid(MSH013, "obj-names-a-vertex-that-is-not-there", |f| {
            let path = path(f, PLAIN, BASE, "obj");
            let obj = String::from_utf8(f.file(&path).to_vec()).expect("text");
            f.put_file(&path, obj.replacen("f 1 5 3", "f 1 5 9", 1));
        }),
        invalid(MSH013, "coordinate-not-finite", |f| {
            let path = path(f, PIECES, BASE, "stl");
            let mut bytes = f.file(&path).to_vec();
            bytes[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
            f.put_file(&path, bytes);
        }),
        invalid(MSH013, "stl-as-text", |f| {
            let mesh = read(f, PLAIN, BASE);
            let mut text = "solid base\n".to_owned();
            for triangle in &mesh.triangles {
                text.push_str("facet normal 0 0 0\nouter loop\n");
                for [x, y, z] in mesh.corners(*triangle) {
                    text.push_str(&format!("vertex {x} {y} {z}\n"));
                }
                text.push_str("endloop\nendfacet\n");
            }
            text.push_str("endsolid base\n");
            let path = path(f, PLAIN, BASE, "stl");
            f.put_file(&path, text);
        }),
        invalid(MSH013, "normal-of-another-triangle", |f| {
            let path = path(f, HULLS, BASE, "stl");
            let mut bytes = f.file(&path).to_vec();
            bytes[84 + 3] ^= 0x80;
            f.put_file(&path, bytes);
        }),
        invalid(MSH013, "obj-holds-stl", |f| {
            let stl = f.file(&path(f, HULLS, BASE, "stl")).to_vec();
            let path = path(f, HULLS, BASE, "obj");
            f.put_file(&path, stl);
        }),
        invalid(MSH013, "vertex-that-no-face-uses-in-the-obj", |f| {
            let path = path(f, HULLS, BASE, "obj");
            let obj = String::from_utf8(f.file(&path).to_vec()).expect("text");
            f.put_file(&path, format!("{obj}v 1000 0 0\n"));
        }),
        invalid(MSH013, "vertex-that-no-face-uses-in-the-glb", |f| {
            let mut mesh = read(f, PIECES, BASE);
            mesh.vertices.push([1000.0, 0.0, 0.0]);
            put(f, PIECES, BASE, "glb", &mesh);
        }),
        invalid(MSH013, "material-library-outside", |f| {
            let path = path(f, PLAIN, BASE, "obj");
            let obj = String::from_utf8(f.file(&path).to_vec()).expect("text");
            f.put_file(&path, format!("mtllib ../../../../secret.mtl\n{obj}"));
        }),
        invalid(MSH013, "image-outside", |f| {
            change_gltf(f, PLAIN, |gltf| {
                gltf["images"] = json!([{ "uri": "../../../../secret.png" }]);
            });
        }),
        invalid(MSH013, "morph-target", |f| {
            change_gltf(f, PLAIN, |gltf| {
                let primitive = &mut gltf["meshes"][0]["primitives"][0];
                primitive["targets"] = json!([{ "POSITION": 0 }]);
            });
        }),
        invalid(MSH013, "skin", |f| {
            change_gltf(f, PLAIN, |gltf| gltf["nodes"][0]["skin"] = json!(0));
        }),
        invalid(MSH013, "instances", |f| {
            change_gltf(f, HULLS, |gltf| {
                gltf["nodes"][0]["extensions"] = json!({ "EXT_mesh_gpu_instancing": {} });
            });
        }),
        invalid(MSH013, "animation", |f| {
            change_gltf(f, PLAIN, |gltf| {
                gltf["animations"] = json!([{ "channels": [], "samplers": [] }]);
            });
        }),
        invalid(MSH013, "least-coordinate-of-other-positions", |f| {
            change_gltf(f, HULLS, |gltf| gltf["accessors"][0]["min"][0] = json!(-1));
        }),
        invalid(MSH013, "node-with-a-transform", |f| {
            change_gltf(f, HULLS, |gltf| {
                // Within the resolution, nothing has moved.
                gltf["nodes"][0]["translation"] = json!([1e-9, 0, 0]);
            });
        }),
        invalid(MSH013, "normals-of-no-length", |f| {
            // The positions in place of the normals.
            change_gltf(f, PLAIN, |gltf| {
                gltf["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(0);
            });
        }),
        near_miss(MSH013, "embedded-image-and-nodes-in-their-place", |f| {
            change_gltf(f, PLAIN, |gltf| {
                gltf["images"] = json!([{ "uri": "data:image/png;base64,iVBORw0KGgo=" }]);
                gltf["nodes"] = json!([
                    { "mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] },
                    { "children": [0], "translation": [0, 0, 0], "scale": [1, 1, 1] },
                ]);
                gltf["scenes"][0]["nodes"] = json!([1]);
            });
        }),
        near_miss(MSH013, "what-formats-leave-open", |f| {
            let stl = path(f, HULLS, BASE, "stl");
            let mut bytes = f.file(&stl).to_vec();
            bytes[..20].copy_from_slice(b"solid, but binary   ");
            f.put_file(&stl, bytes);
            let obj = path(f, HULLS, BASE, "obj");
            let text = String::from_utf8(f.file(&obj).to_vec()).expect("text");
            f.put_file(&obj, format!("# a hull\no base\n{text}\n"));
        }),
        invalid(MSH014, "vertex-moved-in-the-obj", |f| {
            rewrite(f, PLAIN, &["obj"], |mesh| mesh.vertices[3][0] += 1e-4);
        }),
        invalid(MSH014, "glb-turned-to-y-up", |f| {
            rewrite(f, HULLS, &["glb"], |mesh| {
                for [_, y, z] in &mut mesh.vertices {
                    (*y, *z) = (*z, -*y);
                }
            });
        }),
        invalid(MSH014, "triangle-turned-round-in-the-stl", |f| {
            rewrite(f, PIECES, &["stl"], |mesh| mesh.triangles[4].swap(0, 1));
        }),
        near_miss(MSH014, "another-order", |f| {
            rewrite(f, PLAIN, &["obj"], |mesh| {
                mesh.triangles.reverse();
                for triangle in &mut mesh.triangles {
                    triangle.rotate_left(1);
                }
            });
        }),
        near_miss(MSH014, "rounded-otherwise", |f| {
            rewrite(f, PLAIN, &["glb"], |mesh| {
                mesh.vertices[5] = mesh.vertices[5].map(up);
            });
        }),
    ]
}

/// Makes a side of the tool's box, in the file that the URDF names, an L of six corners and a quad. The plain mesh has
/// these triangles for the L.
fn cut_face(f: &mut Fixture, cut: [[u32; 3]; 4]) {
    let files = f.get(ORIGINAL, "/files").as_array().expect("a list");
    let mut paths = files.iter().filter_map(|file| file["path"].as_str());
    let original = paths.find(|path| path.ends_with(".obj")).expect("an OBJ");
    let original = original.to_owned();
    let middle = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| (a[i] + b[i]) / 2.0);
    let add = |v: &mut Vec<[f64; 3]>| {
        v.extend([middle(v[5], v[7]), middle(v[4], v[7]), middle(v[6], v[7])])
    };
    let l = [4, 5, 8, 9, 10, 6];
    let mut mesh = read(f, PLAIN, 6);
    add(&mut mesh.vertices);
    mesh.triangles.truncate(10);
    mesh.triangles.extend(cut.map(|triangle| triangle.map(|corner| l[corner as usize])));
    mesh.triangles.extend([[8, 7, 10], [8, 10, 9]]);
    for format in ALL {
        put(f, PLAIN, 6, format, &mesh);
    }
    let text = String::from_utf8(f.file(&original).to_vec()).expect("text");
    let corner = |line: &str| -> [f64; 3] {
        let numbers = line.split(' ').skip(1).map(|word| word.parse().expect("a number"));
        numbers.collect::<Vec<_>>().try_into().expect("three numbers")
    };
    let mut vertices: Vec<[f64; 3]> =
        text.lines().filter(|line| line.starts_with("v ")).map(corner).collect();
    add(&mut vertices);
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    lines.truncate(lines.len() - 2);
    lines.extend(vertices[8..].iter().map(|[x, y, z]| format!("v {x} {y} {z}")));
    lines.extend(["f 5 6 9 10 11 7".to_owned(), "f 9 8 11 10".to_owned()]);
    f.put_file(&original, lines.join("\n") + "\n");
}

/// MSH015 and MSH016.
fn sources() -> Vec<Case> {
    vec![
        invalid(MSH015, "moved", |f| {
            rewrite(f, PLAIN, ALL, |mesh| {
                for vertex in &mut mesh.vertices {
                    vertex[2] += 1e-3;
                }
            });
        }),
        invalid(MSH015, "corner-moved", |f| {
            rewrite(f, PLAIN, ALL, |mesh| mesh.vertices[6][1] += 1e-4);
        }),
        invalid(MSH015, "scale-left-out", |f| {
            // The tool's mesh is in millimetres.
            let mut mesh = read(f, PLAIN, 6);
            for vertex in &mut mesh.vertices {
                *vertex = vertex.map(|x| x * 1000.0);
            }
            for format in ALL {
                put(f, PLAIN, 6, format, &mesh);
            }
        }),
        invalid(MSH015, "another-links-mesh", |f| {
            // The turret's mesh in place of the tool's.
            let mesh = read(f, PLAIN, 2);
            for format in ALL {
                put(f, PLAIN, 6, format, &mesh);
            }
        }),
        invalid(MSH015, "triangle-missing", |f| {
            rewrite(f, PLAIN, ALL, |mesh| {
                mesh.triangles.pop();
            });
        }),
        in_folder(MSH015, "legacy-origin-left-out", true, |root| {
            let mut robot = LegacyRobot::new("robot", 0.0);
            for link in [0, 1] {
                robot.doc("urdf_module")["links"][link]["visual"][0]["origin"]["xyz"] =
                    json!([0.0, 0.25, 0.0]);
            }
            robot.write(root);
        }),
        near_miss(MSH015, "computed-in-binary32", |f| {
            rewrite(f, PLAIN, ALL, |mesh| {
                for vertex in &mut mesh.vertices {
                    *vertex = vertex.map(up);
                }
            });
        }),
        near_miss(MSH015, "face-cut-otherwise", |f| {
            cut_face(f, [[0, 1, 2], [0, 2, 3], [5, 0, 3], [3, 4, 5]])
        }),
        invalid(MSH015, "face-cut-overlaps", |f| {
            cut_face(f, [[0, 1, 2], [0, 2, 4], [0, 4, 5], [2, 4, 3]])
        }),
        legacy(MSH015, "legacy", false, || LegacyRobot::new("robot", 0.0)),
        invalid(MSH016, "called-unusable", |f| {
            f.set(ORIGINAL, "/files/0/usable", json!(false));
        }),
        changed(MSH016, "called-usable", true, bare, |f| {
            f.set(ORIGINAL, "/files/0/usable", json!(true));
        }),
        invalid(MSH016, "side-file-that-is-not-named", |f| {
            let files = f.get(ORIGINAL, "/files").as_array().expect("a list");
            let sides = |file: &Value| file["side_files"] != json!([]);
            let with = files.iter().position(sides).expect("a side file");
            let without = files.iter().position(|file| !sides(file)).expect("none");
            let side = files[with]["side_files"].clone();
            f.set(ORIGINAL, &format!("/files/{without}/side_files"), side);
        }),
        changed(MSH016, "without-a-surface", false, bare, |_| {}),
        near_miss(MSH016, "names-what-is-not-carried", |f| {
            let files = f.get(ORIGINAL, "/files").as_array().expect("a list");
            let obj = files.iter().filter_map(|file| file["path"].as_str());
            let obj = obj.filter(|path| path.ends_with(".obj")).map(str::to_owned);
            let obj = obj.max().expect("an OBJ");
            let text = String::from_utf8(f.file(&obj).to_vec()).expect("text");
            f.put_file(&obj, format!("mtllib gone.mtl\n{text}"));
        }),
    ]
}

/// MSH017 to MSH022.
fn bodies() -> Vec<Case> {
    vec![
        invalid(MSH017, "open", |f| {
            rewrite(f, HULLS, ALL, |mesh| {
                mesh.triangles.pop();
            });
        }),
        invalid(MSH017, "inward", |f| rewrite(f, HULLS, ALL, Mesh::flip)),
        changed(
            MSH017,
            "flat",
            false,
            || {
                let mut flat = link("flat");
                flat.visual.push(visual(None, cuboid([0.3, 0.2, 0.0])));
                Fixture::full(&robot_of(vec![flat, boxy("b")]))
            },
            |_| {},
        ),
        invalid(MSH018, "corner-cut-off", |f| {
            rewrite(f, HULLS, ALL, |mesh| {
                let seven = &mesh.vertices[..7];
                *mesh = ConvexHull::new(seven).expect("a hull").into_mesh();
            });
        }),
        near_miss(MSH018, "rounded-otherwise", |f| {
            rewrite(f, HULLS, ALL, |mesh| {
                mesh.vertices[0] = mesh.vertices[0].map(up);
            });
        }),
        invalid(MSH019, "vertex-that-is-not-the-meshs", |f| {
            rewrite(f, HULLS, ALL, |mesh| {
                let mut points = mesh.vertices.clone();
                points.push([0.0, 0.0, 0.0625]);
                *mesh = ConvexHull::new(&points).expect("a hull").into_mesh();
            });
        }),
        near_miss(MSH019, "rounded-otherwise", |f| {
            rewrite(f, HULLS, ALL, |mesh| {
                mesh.vertices[7] = mesh.vertices[7].map(up);
            });
        }),
        invalid(MSH020, "open", |f| {
            rewrite(f, PIECES, ALL, |mesh| {
                mesh.triangles.remove(0);
            });
        }),
        near_miss(MSH020, "another-order", |f| {
            rewrite(f, PIECES, ALL, |mesh| mesh.triangles.reverse());
        }),
        invalid(MSH021, "larger-than-the-link", |f| {
            rewrite(f, PIECES, ALL, |mesh| {
                for vertex in &mut mesh.vertices {
                    *vertex = vertex.map(|x| f64::from((x * 1.1) as f32));
                }
            });
        }),
        changed(MSH023, "barely-larger-than-the-link", true, lone_box, |f| {
            grow_piece(f, 1.01);
        }),
        changed(MSH023, "larger-by-rounding-of-voxels", false, lone_box, |f| {
            // 15 micrometres of a hull that is 0.37 m across.
            grow_piece(f, 1.0001);
        }),
        near_miss(MSH021, "rounded-otherwise", |f| {
            rewrite(f, PIECES, ALL, |mesh| {
                mesh.vertices[7] = mesh.vertices[7].map(up);
            });
        }),
        invalid(MSH022, "part-of-the-link", |f| {
            rewrite(f, PIECES, ALL, |mesh| {
                for vertex in &mut mesh.vertices {
                    vertex[0] = vertex[0].min(0.1);
                }
            });
        }),
        near_miss(MSH022, "no-promise", |f| {
            f.set(PIECES, "/method/surface_tolerance", Value::Null);
        }),
    ]
}
