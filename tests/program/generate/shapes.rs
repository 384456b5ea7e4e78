//! Meshes and shapes of generated URDDs, compared with closed forms.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use urdd_generate::note::{Note, NoteKind};
use urdd_generate::{Generated, Settings, generate};

use crate::generate::{bytes_below, findings_of, our_robots, read_json};

const PLAIN: &str = "mesh_modules/plain_meshes_module";
const HULLS: &str = "mesh_modules/convex_hull_meshes_module";
const PIECES: &str = "mesh_modules/convex_decomposition_meshes_module";
const SHAPES: &str = "link_shapes_modules";

fn settings(num_samples: u32) -> Settings {
    Settings { num_samples, ..Settings::default() }
}

/// The notes, but for those that say how collisions are judged.
fn odd(generated: &Generated) -> Vec<&Note> {
    let of_collisions = [NoteKind::GeometryTaken, NoteKind::SkippedContact];
    generated.notes.iter().filter(|note| !of_collisions.contains(&note.kind)).collect()
}

/// A URDD of a robot in `conformance/robots`.
fn made(robot: &str, num_samples: u32) -> (tempfile::TempDir, PathBuf) {
    let folder = testkit::temporary::folder();
    let target = folder.path().join(robot);
    let robots = our_robots();
    let (_, source) = robots.iter().find(|(name, _)| name == robot).expect("ours");
    let generated = generate(source, &target, &settings(num_samples), &()).expect("a URDD");
    assert_eq!(odd(&generated), [] as [&Note; 0]);
    (folder, target)
}

/// A URDD of a text.
fn made_of(text: &str, num_samples: u32) -> (tempfile::TempDir, PathBuf) {
    let folder = testkit::temporary::folder();
    let source = folder.path().join("robot.urdf");
    fs::write(&source, text).expect("written");
    let target = folder.path().join("made");
    generate(&source, &target, &settings(num_samples), &()).expect("a URDD");
    (folder, target)
}

type Triangle = [[f64; 3]; 3];

/// The triangles of a binary STL file.
fn stl(path: &Path) -> Vec<Triangle> {
    let bytes = fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let number = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let count = u32::from_le_bytes(bytes[80..84].try_into().unwrap()) as usize;
    assert_eq!(bytes.len(), 84 + 50 * count, "{}", path.display());
    let corner = |at: usize| [0, 4, 8].map(|k| f64::from(number(at + k)));
    (0..count).map(|n| [12, 24, 36].map(|k| corner(84 + 50 * n + k))).collect()
}

/// The triangles of an OBJ file.
fn obj(path: &Path) -> Vec<Triangle> {
    let text = fs::read_to_string(path).expect("text");
    let rows = |first: &'static str| {
        let lines = text.lines().map(str::split_whitespace);
        lines.filter_map(move |mut words| (words.next() == Some(first)).then_some(words))
    };
    let points: Vec<[f64; 3]> = rows("v")
        .map(|words| {
            let numbers: Vec<f32> = words.map(|word| word.parse().unwrap()).collect();
            [0, 1, 2].map(|k| f64::from(numbers[k]))
        })
        .collect();
    rows("f")
        .map(|words| {
            let corners: Vec<usize> =
                words.map(|word| word.split('/').next().unwrap().parse().unwrap()).collect();
            [0, 1, 2].map(|k| points[corners[k] - 1])
        })
        .collect()
}

/// The triangles of a GLB file whose primitives all have indices.
fn glb(path: &Path) -> Vec<Triangle> {
    let bytes = fs::read(path).expect("a file");
    let size = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let document: Value = serde_json::from_slice(&bytes[20..20 + size]).expect("JSON");
    let data = &bytes[28 + size..];
    let at = |accessor: &Value| -> (usize, usize, u64) {
        let view = &document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let offset = |value: &Value| value["byteOffset"].as_u64().unwrap_or(0) as usize;
        let count = accessor["count"].as_u64().unwrap() as usize;
        let component = accessor["componentType"].as_u64().unwrap();
        (offset(view) + offset(accessor), count, component)
    };
    let mut triangles = Vec::new();
    for primitive in document["meshes"][0]["primitives"].as_array().unwrap() {
        let accessor = |value: &Value| &document["accessors"][value.as_u64().unwrap() as usize];
        let (start, _, _) = at(accessor(&primitive["attributes"]["POSITION"]));
        let point = |n: usize| {
            [0, 1, 2].map(|k| {
                let at = start + 12 * n + 4 * k;
                f64::from(f32::from_le_bytes(data[at..at + 4].try_into().unwrap()))
            })
        };
        let (start, count, component) = at(accessor(&primitive["indices"]));
        let index = |n: usize| match component {
            5123 => u16::from_le_bytes([data[start + 2 * n], data[start + 2 * n + 1]]) as usize,
            _ => u32::from_le_bytes(data[start + 4 * n..start + 4 * n + 4].try_into().unwrap())
                as usize,
        };
        triangles.extend((0..count / 3).map(|t| [0, 1, 2].map(|k| point(index(3 * t + k)))));
    }
    triangles
}

fn bounds(triangles: &[Triangle]) -> [[f64; 3]; 2] {
    let corners = || triangles.iter().flatten();
    [
        corners().fold([f64::INFINITY; 3], |low, p| [0, 1, 2].map(|k| low[k].min(p[k]))),
        corners().fold([f64::NEG_INFINITY; 3], |high, p| [0, 1, 2].map(|k| high[k].max(p[k]))),
    ]
}

/// The volume inside a closed surface: positive where the triangles face outward.
fn volume(triangles: &[Triangle]) -> f64 {
    let of = |[a, b, c]: &Triangle| {
        (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]))
            / 6.0
    };
    triangles.iter().map(of).sum()
}

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found}, expected {expected}");
}

fn file(urdd: &Path, pointer: &str, module: &str) -> PathBuf {
    let document = read_json(&urdd.join(module).join("module.json"));
    let path = document.pointer(pointer).and_then(Value::as_str);
    urdd.join(path.unwrap_or_else(|| panic!("{pointer}: no path")))
}

/// The wedge of `left/part.stl`: 0.2 by 0.08 by 0.12 m, with a side view of five corners.
#[test]
fn scale_and_mirrors_are_applied_with_the_winding_put_right() {
    let (_folder, urdd) = made("scaled_parts", 10);
    assert_eq!(findings_of(&urdd), Vec::new());
    let side_view: f64 = 0.05 * 0.12 + 0.15 * (0.12 + 0.03) / 2.0;
    let expected = [
        (0, [0.0, -0.04, 0.0], [0.2, 0.04, 0.12]),
        (1, [-0.2, -0.04, 0.0], [0.0, 0.04, 0.12]),
        (2, [-0.2, -0.04, -0.12], [0.0, 0.04, 0.0]),
    ];
    for (link, low, high) in expected {
        let triangles = stl(&file(&urdd, &format!("/link_meshes/{link}/files/stl"), PLAIN));
        let found = bounds(&triangles);
        for k in 0..3 {
            assert_near(found[0][k], low[k], 1e-7);
            assert_near(found[1][k], high[k], 1e-7);
        }
        assert_near(volume(&triangles), side_view * 0.08, 1e-9);
    }
    // Two files called part.stl: the peg's, stretched, has its own height and not the wedge's.
    let peg = bounds(&stl(&file(&urdd, "/link_meshes/3/files/stl", PLAIN)));
    assert_near(peg[1][2] - peg[0][2], 0.1 * 0.5, 1e-7);
    // Three visuals: two pegs, one upside down, and a box.
    let several = stl(&file(&urdd, "/link_meshes/4/files/stl", PLAIN));
    assert_near(bounds(&several)[0][2], -0.1, 1e-7);
    assert_near(bounds(&several)[1][2], 0.1, 1e-7);
}

#[test]
fn the_three_formats_hold_the_same_triangles() {
    let (_folder, urdd) = made("welding_arm", 10);
    assert_eq!(findings_of(&urdd), Vec::new());
    let mut compared = 0;
    for path in bytes_below(&urdd).into_keys() {
        if !path.ends_with(".stl") || path.contains("original_meshes_module") {
            continue;
        }
        let as_stl = stl(&urdd.join(&path));
        let beside = |extension: &str| {
            let folders = path.replace("/stl/", &format!("/{extension}/"));
            urdd.join(folders.replace(".stl", &format!(".{extension}")))
        };
        assert!(as_stl == obj(&beside("obj")), "{path}");
        assert!(as_stl == glb(&beside("glb")), "{path}");
        compared += 1;
    }
    assert!(compared > 25, "{compared}");
}

/// Unit, up axis and node transforms of COLLADA; the colour reaches the .glb.
#[test]
fn a_collada_file_is_placed_scaled_and_coloured() {
    let (_folder, urdd) = made("welding_arm", 10);
    let glb = fs::read(file(&urdd, "/link_meshes/0/files/glb", PLAIN)).expect("a file");
    let text = String::from_utf8_lossy(&glb);
    assert!(text.contains("0.35,0.36,0.38"), "{text:.400}");
    // The foot, of 220 mm: up_axis is not applied, as in RViz. The box of cables is beside it.
    let [low, high] = bounds(&stl(&file(&urdd, "/link_meshes/0/files/stl", PLAIN)));
    assert_near(high[2] - low[2], 0.22, 1e-7);
    assert_near(low[0], -0.19, 1e-7);
}

#[test]
fn hulls_stand_on_corners_of_the_mesh_and_pieces_hold_its_volume() {
    let (_folder, urdd) = made("welding_arm", 10);
    let module = read_json(&urdd.join(PIECES).join("module.json"));
    // Links of one closed body each.
    for link in 1..6 {
        let mesh = stl(&file(&urdd, &format!("/link_meshes/{link}/files/stl"), PLAIN));
        let hull = stl(&file(&urdd, &format!("/link_hulls/{link}/stl"), HULLS));
        for corner in hull.iter().flatten() {
            assert!(mesh.iter().flatten().any(|p| p == corner), "link {link}");
        }
        let pieces = module["link_pieces"][link].as_array().expect("pieces");
        let volumes =
            pieces.iter().map(|piece| volume(&stl(&urdd.join(piece["stl"].as_str().unwrap()))));
        let sum: f64 = volumes.sum();
        let (inside, outside) = (volume(&mesh), volume(&hull));
        assert!(sum >= inside * (1.0 - 1e-6), "link {link}: {sum} {inside}");
        assert!(outside >= inside * (1.0 - 1e-6), "link {link}");
    }
    // The fork is not convex: its pieces leave out the gap that the hull fills.
    assert!(module["link_pieces"][1].as_array().unwrap().len() >= 3);
}

/// u(k, i) of SPEC 9.3, written from it.
fn unit(k: u64, i: u64) -> f64 {
    let mut z = (k * (1 << 32) + i + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Two cubes on a rail, 0.1 m wide: the distance of hulls and boxes is that of their centres less 0.1 m, that of
/// spheres less the cubes' diagonal.
#[test]
fn statistics_of_two_cubes_on_a_rail() {
    let cube = |name: &str| {
        format!(
            "<link name=\"{name}\"><visual><geometry><box size=\"0.1 0.1 0.1\"/></geometry></visual></link>"
        )
    };
    let text = format!(
        "<robot name=\"rail\">{}{}<joint name=\"j\" type=\"prismatic\"><parent link=\"a\"/><child link=\"b\"/>\
         <axis xyz=\"1 0 0\"/><limit lower=\"0.05\" upper=\"0.45\" effort=\"1\" velocity=\"1\"/></joint></robot>",
        cube("a"),
        cube("b")
    );
    let samples = 200;
    let (_folder, urdd) = made_of(&text, samples);
    assert_eq!(findings_of(&urdd), Vec::new());
    let folder = urdd.join(SHAPES).join("link_shapes_distance_statistics_module");
    let found = read_json(&folder.join("module.json"));
    let centres = (0..u64::from(samples)).map(|k| 0.05 + 0.4 * unit(k, 0));
    for (shapes, less) in [
        ("full_convex_hulls", 0.1),
        ("full_obbs", 0.1),
        ("full_bounding_spheres", 0.1 * f64::sqrt(3.0)),
        ("decomposition_convex_hulls", 0.1),
        ("decomposition_obbs", 0.1),
        ("decomposition_bounding_spheres", 0.1 * f64::sqrt(3.0)),
    ] {
        let distances: Vec<f64> = centres.clone().map(|x| (x - less).max(0.0)).collect();
        let at = |list: &str| {
            let distance = found[shapes][list][0][1].as_f64().expect("a number");
            // Seven significant digits.
            let rounded = format!("{distance:.6e}").parse();
            assert_eq!(rounded, Ok(distance), "{shapes} {list}");
            distance
        };
        let mean = distances.iter().sum::<f64>() / f64::from(samples);
        assert_near(at("mean_distances"), mean, 1e-7);
        let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
        assert_near(at("min_distances"), least, 1e-7);
        assert_near(at("max_distances"), distances.into_iter().fold(0.0, f64::max), 1e-7);
    }
    let shapes = read_json(
        &urdd.join(SHAPES).join("link_shapes_max_distance_from_origin_module/module.json"),
    );
    let far = 0.05 * f64::sqrt(3.0);
    for list in ["full_convex_hulls", "full_obbs", "full_bounding_spheres"] {
        let list = &shapes[format!("{list}_maximum_distances")];
        assert_near(list[0].as_f64().expect("a number"), far, 1e-8);
    }
}

/// A user's edits of the skips are kept when the URDD is generated again; those of lost links are dropped, with a note.
#[test]
fn edits_of_skips_outlive_a_new_run() {
    let folder = testkit::temporary::folder();
    let (source, target) = (folder.path().join("robot.urdf"), folder.path().join("made"));
    let link = |name: &str| {
        format!(
            "<link name=\"{name}\"><visual><geometry><sphere radius=\"0.1\"/></geometry></visual></link>"
        )
    };
    let joint = |child: &str, y: f64| {
        format!(
            "<joint name=\"to_{child}\" type=\"continuous\"><parent link=\"a\"/><child link=\"{child}\"/>\
             <origin xyz=\"1 {y} 0\"/><axis xyz=\"0 0 1\"/></joint>"
        )
    };
    let robot = |parts: &[String]| format!("<robot name=\"r\">{}</robot>", parts.concat());
    let both = [link("a"), link("b"), link("c"), joint("b", 1.0), joint("c", -1.0)];
    fs::write(&source, robot(&both)).expect("written");
    let run = || generate(&source, &target, &settings(10), &()).expect("a URDD");
    run();
    let module = target.join(SHAPES).join("link_shapes_skips_module/module.json");
    let mut document = read_json(&module);
    let edit = |link: &str| json!({"link_a": "a", "link_b": link, "skip": true, "reason": "they never meet"});
    document["edits"] = json!([edit("b"), edit("c")]);
    fs::write(&module, document.to_string()).expect("written");

    let generated = run();
    assert_eq!(odd(&generated), [] as [&Note; 0]);
    assert_eq!(findings_of(&target), Vec::new());
    let document = read_json(&module);
    assert_eq!(document["edits"].as_array().map(Vec::len), Some(2));
    assert_eq!(document["full_convex_hulls_skips"][0][2], json!(true));
    assert_eq!(document["full_convex_hulls_skips"][1][2], json!(false));

    fs::write(&source, robot(&[link("a"), link("b"), joint("b", 1.0)])).expect("written");
    let generated = run();
    assert_eq!(odd(&generated).len(), 1, "{:?}", generated.notes);
    assert_eq!(read_json(&module)["edits"], json!([edit("b")]));
    assert_eq!(findings_of(&target), Vec::new());
}

/// A mesh with implausible coordinates is reported with its link, and nothing is written.
#[test]
fn a_mesh_beyond_all_measure_is_refused() {
    let folder = testkit::temporary::folder();
    let source = folder.path().join("robot.urdf");
    let text = "v 0 0 0\nv 1e12 0 0\nv 0 1e12 0\nf 1 2 3\n";
    fs::write(folder.path().join("far.obj"), text).expect("written");
    let link = "<link name=\"probe\"><visual><geometry><mesh filename=\"far.obj\"/></geometry></visual></link>";
    fs::write(&source, format!("<robot name=\"r\">{link}</robot>")).expect("written");
    let target = folder.path().join("made");
    let error = generate(&source, &target, &settings(10), &()).expect_err("no URDD");
    let text = error.to_string();
    assert!(text.contains("link `probe`") && text.contains("--modules geometry"), "{text}");
    assert!(!target.exists());
}
