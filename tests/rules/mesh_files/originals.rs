//! MSH015 and MSH016: plain meshes, and the files that the URDF names.

use serde_json::{Value, json};
use urdd_validate::code::Code::*;

use super::{ALL, bare, put, read, rewrite, up};
use crate::legacy_robot::LegacyRobot;
use crate::meshes::{ORIGINAL, PLAIN, legacy};
use crate::{Case, changed, in_folder, invalid, near_miss};
use testkit::fixture::Fixture;

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

pub fn cases() -> Vec<Case> {
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
        near_miss(MSH016, "side-file-outside-of-meshes", |f| {
            let files = f.get(ORIGINAL, "/files").as_array().expect("a list");
            let obj = |file: &Value| file["path"].as_str().is_some_and(|p| p.ends_with(".obj"));
            let at = files.iter().position(obj).expect("an OBJ");
            let path = crate::meshes::text(f, ORIGINAL, &format!("/files/{at}/path"));
            let up = "../".repeat(path.matches('/').count());
            let text = String::from_utf8(f.file(&path).to_vec()).expect("text");
            f.put_file(&path, format!("mtllib {up}materials/steel.mtl\n{text}"));
            f.put_file("materials/steel.mtl", *b"newmtl steel\nKd 0.5 0.5 0.5\n");
            let sides = f.doc_mut(ORIGINAL).pointer_mut(&format!("/files/{at}/side_files"));
            let sides = sides.and_then(Value::as_array_mut).expect("a list");
            sides.insert(0, json!("materials/steel.mtl"));
        }),
    ]
}
