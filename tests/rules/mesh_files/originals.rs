//! MSH015 and MSH016: plain meshes, and the files that the URDF names.

use serde_json::json;
use urdd_validate::code::Code::*;

use super::{ALL, bare, put, read, rewrite, up};
use crate::meshes::{ORIGINAL, PLAIN};
use crate::{Case, changed, invalid, near_miss};
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
        changed(MSH016, "called-usable", true, bare, |f| {
            f.set(ORIGINAL, "/files/0/usable", json!(true));
        }),
        changed(MSH016, "without-a-surface", false, bare, |_| {}),
    ]
}
