//! MSH015 and MSH016: plain meshes, and the files that the URDF names.

use serde_json::json;
use urdd_geometry::Mesh;
use urdd_geometry::surface::is_thin;
use urdd_validate::code::Code::*;

use super::placed_scenes::{CORNERS, FACES, base, show};
use super::{ALL, BASE, bare, put, read, rewrite, up};
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

/// Shows a body with a sliver in it of these heights above each other, in the file and in the `.glb`, `.stl` and `.obj` of the
/// plain mesh, or without it in some of these.
pub fn sliver_of(f: &mut Fixture, [low, high]: [f64; 2], holds: [bool; 4]) {
    let sliver = [[0.0625, 0.03125, low], [0.125, 0.03125, low], [0.09375, 0.03125, high]];
    let body = Mesh { vertices: CORNERS.to_vec(), triangles: FACES.to_vec() };
    let mut more = body.clone();
    more.vertices.extend(sliver);
    more.triangles.push([4, 5, 6]);
    let all = holds.map(|holds| if holds { &more } else { &body });
    let mut text = String::new();
    all[0].vertices.iter().for_each(|[x, y, z]| text += &format!("v {x} {y} {z}\n"));
    let from_one = |t: &[u32; 3]| t.map(|at| at + 1);
    all[0].triangles.iter().map(from_one).for_each(|[a, b, c]| text += &format!("f {a} {b} {c}\n"));
    show(f, text.as_bytes(), &body, &body);
    for (format, mesh) in ["glb", "stl", "obj"].into_iter().zip(&all[1..]) {
        let rounded = mesh.vertices.iter().map(|place| place.map(|x| f64::from(x as f32)));
        let rounded = Mesh { vertices: rounded.collect(), triangles: mesh.triangles.clone() };
        put(f, PLAIN, BASE, format, &rounded);
    }
}

/// Two heights of six digits, a micrometre apart: by rounding no more than the tolerance in binary64 and more in binary32, or
/// the reverse.
fn micrometre(thin_in_file: bool) -> [f64; 2] {
    let heights =
        (15_000..).map(|k| [k, k + 1].map(|k| format!("0.{k:06}").parse().expect("a number")));
    let is_thin = |[low, high]: [f64; 2]| {
        is_thin([[0.0625, 0.03125, low], [0.125, 0.03125, low], [0.09375, 0.03125, high]], 1e-6)
    };
    let mut heights = heights.filter(|of: &[f64; 2]| {
        is_thin(*of) == thin_in_file && is_thin(of.map(|x| f64::from(x as f32))) != thin_in_file
    });
    heights.next().expect("two heights")
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
        changed(MSH015, "sliver-thin-in-the-file-alone", false, base, |f| {
            sliver_of(f, micrometre(true), [true; 4]);
        }),
        changed(MSH015, "sliver-thin-in-the-plain-mesh-alone", false, base, |f| {
            sliver_of(f, micrometre(false), [true; 4]);
        }),
        changed(MSH016, "called-usable", true, bare, |f| {
            f.set(ORIGINAL, "/files/0/usable", json!(true));
        }),
        changed(MSH016, "without-a-surface", false, bare, |_| {}),
    ]
}
