//! Numbers about mesh files, plain meshes, hulls and pieces.

use serde_json::{Value, json};
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::read::Part;
use urdd_geometry::write;
use urdd_validate::code::Code::*;

use super::{Number, Sides, least, most, number, sides, there, wide};
use crate::mesh_files::originals::sliver_of;
use crate::mesh_files::placed_scenes::base;
use crate::mesh_files::{ALL, BASE, change_gltf, grow_piece, lone_box, path, put, read, rewrite};
use crate::meshes::{HULLS, ORIGINAL, PIECES, PLAIN, boxy, robot_of};
use testkit::fixture::{Fixture, ROOT};
use testkit::robot::*;
use urdd_format::urdf::Link;

/// 8 * 2^-23.
pub const RESOLUTION: f64 = 9.5367431640625e-7;

const BINARY32: &str = "coordinates are binary32";

/// Takes away the modules of shapes: the fixture is then of class Geometry.
pub fn geometry_alone(f: &mut Fixture) {
    for module in [
        "link_shapes_approximations_module",
        "link_shapes_max_distance_from_origin_module",
        "link_shapes_distance_statistics_module",
        "link_shapes_simple_skips_module",
        "link_shapes_skips_module",
    ] {
        f.remove_module(module);
    }
    f.set(ROOT, "/conformance_class", json!("Geometry"));
}

fn toy() -> Fixture {
    let mut f = Fixture::toy();
    geometry_alone(&mut f);
    f
}

/// A box of this size, and a link without a shape.
fn box_of(size: [f64; 3]) -> Fixture {
    let shown = Link { visual: vec![visual(None, cuboid(size))], ..link("b") };
    let mut f = Fixture::full(&robot_of(vec![link("a"), shown]));
    geometry_alone(&mut f);
    f
}

/// A box of 0.1 m at (2, 2, 2), and a link without a shape. All of it is above z = 0.
fn far_box() -> Fixture {
    let far = visual(origin([2.0; 3], [0.0; 3]), cuboid([0.1; 3]));
    let mut f = Fixture::full(&robot_of(vec![link("a"), Link { visual: vec![far], ..link("b") }]));
    geometry_alone(&mut f);
    f
}

/// Raises the top of the box of link 1: its plain mesh, hull and piece.
fn raise_top(f: &mut Fixture, by: f64) {
    for module in [PLAIN, HULLS, PIECES] {
        let mut mesh = read(f, module, BASE);
        for vertex in mesh.vertices.iter_mut().filter(|vertex| vertex[2] > 0.0) {
            vertex[2] += by;
        }
        for format in ALL {
            put(f, module, BASE, format, &mesh);
        }
    }
}

/// A sliver of this height in a body of 0.5 m.
fn sliver(f: &mut Fixture, height: f64, holds: [bool; 4]) {
    sliver_of(f, [1.0 / 64.0, 1.0 / 64.0 + height], holds);
}

/// Moves a vertex at z = 0 in the OBJ of link 0, whose largest coordinate is 0.08.
fn lift_in_one_format(f: &mut Fixture, by: f64) {
    let mut mesh = read(f, PLAIN, 0);
    let vertex = mesh.vertices.iter_mut().find(|vertex| vertex[2] == 0.0);
    vertex.expect("a vertex")[2] = by;
    put(f, PLAIN, 0, "obj", &mesh);
}

/// Adds this to the x of a normal along z, in the STL of a hull.
fn tilt_normal(f: &mut Fixture, by: f64) {
    let path = path(f, HULLS, BASE, "stl");
    let mut bytes = f.file(&path).to_vec();
    let number = |record: usize, axis: usize| 84 + 50 * record + 4 * axis;
    let along_z = (0..12).find(|record| {
        let at = number(*record, 2);
        bytes[at..at + 4] == 1.0_f32.to_le_bytes()
    });
    let at = number(along_z.expect("a face along z"), 0);
    bytes[at..at + 4].copy_from_slice(&(by as f32).to_le_bytes());
    f.put_file(&path, bytes);
}

/// A cube whose corners are at this distance from its middle, and are its normals too.
fn normals_of(f: &mut Fixture, length: f64) {
    *f = box_of([2.0 * length / 3.0_f64.sqrt(); 3]);
    change_gltf(f, PLAIN, |gltf| {
        gltf["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(0);
    });
}

fn unit_cube() -> Fixture {
    box_of([2.0 / 3.0_f64.sqrt(); 3])
}

/// A link that shows a mesh file, a box of 0.1 m.
fn shown_mesh() -> Fixture {
    let mut robot = robot_of(vec![link("a"), boxy("b")]);
    robot.meshes.insert("part.stl".to_owned(), [0.1; 3]);
    robot.link_mut("a").visual.push(visual(None, mesh("part.stl", None)));
    let mut f = Fixture::full(&robot);
    geometry_alone(&mut f);
    f.set(PIECES, "/method/surface_tolerance", Value::Null);
    f
}

/// Puts a vertex on the middle of the top of that mesh, this far above it. Its hull stays.
fn roof(f: &mut Fixture, by: f64) {
    let mut mesh = read(f, PLAIN, 0);
    let top = |mesh: &Mesh, triangle: &[u32; 3]| {
        mesh.corners(*triangle).iter().all(|corner| corner[2] > 0.0)
    };
    let faces: Vec<[u32; 3]> = mesh.triangles.iter().filter(|t| top(&mesh, t)).copied().collect();
    mesh.triangles = mesh.triangles.iter().filter(|t| !top(&mesh, t)).copied().collect();
    let height = mesh.vertices[faces[0][0] as usize][2];
    let middle = mesh.vertices.len() as u32;
    mesh.vertices.push([0.0, 0.0, height + by]);
    // The four edges around the two triangles, each with the middle.
    let edges: Vec<[u32; 2]> =
        (faces.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]])).collect();
    for [a, b] in &edges {
        if !edges.contains(&[*b, *a]) {
            mesh.triangles.push([*a, *b, middle]);
        }
    }
    for format in ALL {
        put(f, PLAIN, 0, format, &mesh);
    }
    let original = f.get(ORIGINAL, "/files/0/path").as_str().expect("a path").to_owned();
    let bytes = write::stl(&[Part::from(mesh)]).expect("a mesh");
    f.put_file(&original, bytes);
}

/// How far outside of the top of the hull of that box a point may be: half of a square of 0.1 m has a height of
/// 0.1 / sqrt 2.
fn outside_of_hull() -> f64 {
    RESOLUTION * 0.05 * (1.0 + 0.1 * 3.0_f64.sqrt() / (0.1 / 2.0_f64.sqrt()))
}

/// The lone box with its piece lower than it by this.
fn lower_piece(f: &mut Fixture, by: f64) {
    geometry_alone(f);
    rewrite(f, PIECES, ALL, |mesh| {
        for vertex in mesh.vertices.iter_mut().filter(|vertex| vertex[2] > 0.0) {
            vertex[2] -= by;
        }
    });
}

fn without_a_promise(f: &mut Fixture, by: f64) {
    f.set(PIECES, "/method/surface_tolerance", Value::Null);
    lower_piece(f, by);
}

fn with_a_promise(f: &mut Fixture, by: f64) {
    f.set(PIECES, "/method/surface_tolerance", json!(0.01));
    lower_piece(f, by);
}

/// The diagonal of the lone box.
const DIAGONAL: f64 = 0.374_165_738_677_394_1;

/// The lone box with a piece that lacks the last corner: its three edges end this far from it. The corner is that over
/// sqrt 3 outside, and 5 % of the diagonal is 0.0187.
fn cut_corner(f: &mut Fixture, by: f64) {
    geometry_alone(f);
    f.set(PIECES, "/method/surface_tolerance", Value::Null);
    let corner = read(f, PLAIN, BASE).vertices[7];
    rewrite(f, PIECES, ALL, |mesh| {
        let mut points = mesh.vertices.clone();
        points.retain(|point| *point != corner);
        for axis in 0..3 {
            let mut point = corner;
            point[axis] -= by * corner[axis].signum();
            points.push(point.map(|x| f64::from(x as f32)));
        }
        *mesh = ConvexHull::new(&points).expect("a hull").into_mesh();
    });
}

/// The lone box with a piece that reaches out of the hull by this.
fn reach_out(f: &mut Fixture, by: f64) {
    grow_piece(f, 1.0 + by / 0.15);
}

/// A face of five corners in the file that the tool shows, which turns back at the third by this sine. The plain mesh
/// has another cut than the fan from the first corner.
fn nearly_convex(f: &mut Fixture, sine: f64) {
    geometry_alone(f);
    let files = f.get(ORIGINAL, "/files").as_array().expect("a list");
    let mut paths = files.iter().filter_map(|file| file["path"].as_str());
    let original = paths.find(|path| path.ends_with(".obj")).expect("an OBJ").to_owned();
    let obj = String::from_utf8(f.file(&original).to_vec()).expect("text");
    let corners: Vec<[f64; 3]> = obj
        .lines()
        .filter(|line| line.starts_with("v "))
        .map(|line| {
            let numbers = line.split(' ').skip(1).map(|word| word.parse().expect("a number"));
            numbers.collect::<Vec<f64>>().try_into().expect("three")
        })
        .collect();
    // The last two triangles are the side (4, 5, 7, 6); its edge from 5 to 7 gets a middle that is moved towards 4 and 6.
    let [four, five, seven] = [4, 5, 7].map(|i| corners[i]);
    let along = |i: usize| seven[i] - five[i];
    let inward = |i: usize| four[i] - five[i];
    let length = |of: &dyn Fn(usize) -> f64| (0..3).map(|i| of(i) * of(i)).sum::<f64>().sqrt();
    let depth = sine * length(&along) / 4.0;
    let middle: [f64; 3] =
        [0, 1, 2].map(|i| five[i] + along(i) / 2.0 + inward(i) * depth / length(&inward));
    let mut lines: Vec<String> = obj.lines().map(str::to_owned).collect();
    lines.truncate(lines.len() - 2);
    lines.push(format!("v {:?} {:?} {:?}", middle[0], middle[1], middle[2]));
    lines.push("f 5 6 9 8 7".to_owned());
    f.put_file(&original, lines.join("\n") + "\n");
    let mut mesh = read(f, PLAIN, 6);
    let half = [0, 1, 2].map(|i| (mesh.vertices[5][i] + mesh.vertices[7][i]) / 2.0);
    mesh.vertices.push(half);
    mesh.triangles.truncate(10);
    mesh.triangles.extend([[5, 8, 6], [8, 7, 6], [4, 5, 6]]);
    for format in ALL {
        put(f, PLAIN, 6, format, &mesh);
    }
}

pub fn numbers() -> Vec<Number> {
    let tiny = || box_of([0.002; 3]);
    let large = || box_of([4.0, 4.0, 0.02]);
    vec![
        number(
            "stl-normal",
            "7.6",
            "that of its corners to 1e-3",
            ("1e-3", 1e-3),
            vec![most(MSH013, Fixture::toy, tilt_normal, 1e-3)],
        ),
        number(
            "unit-normal",
            "7.6",
            "of unit length to 1e-3",
            ("1e-3", 1e-3),
            vec![
                most(MSH013, unit_cube, |f, by| normals_of(f, 1.0 + by), 1e-3),
                most(MSH013, unit_cube, |f, by| normals_of(f, 1.0 - by), 1e-3),
            ],
        ),
        number(
            "resolution",
            "7.6.1",
            "the *resolution*: 8 * 2^-23 of the largest absolute coordinate",
            ("8 * 2^-23", RESOLUTION),
            vec![most(MSH014, Fixture::toy, lift_in_one_format, RESOLUTION * 0.08)],
        ),
        number(
            "counterpart",
            "7.6.1",
            "not more than 5 times the tolerance",
            ("5", 5.0),
            vec![
                most(MSH015, base, |f, by| sliver(f, by, [true, false, false, false]), 5e-6),
                most(MSH015, base, |f, by| sliver(f, by, [false, true, true, true]), 5e-6),
                most(
                    MSH014,
                    base,
                    |f, by| sliver(f, by, [true, true, true, false]),
                    5.0 * 0.5 * RESOLUTION,
                ),
                most(
                    MSH014,
                    base,
                    |f, by| sliver(f, by, [true, true, false, true]),
                    5.0 * 0.5 * RESOLUTION,
                ),
            ],
        ),
        number(
            "placing-of-large-meshes",
            "7.6.1",
            "the larger of 8 * 2^-23 E",
            ("8 * 2^-23", RESOLUTION),
            vec![most(MSH015, large, raise_top, RESOLUTION * 2.0)],
        ),
        number(
            "placing",
            "7.6.1",
            "the smaller of 1e-6 m",
            ("1e-6", 1e-6),
            vec![most(MSH015, toy, raise_top, 1e-6)],
        ),
        number(
            "placing-of-small-meshes",
            "7.6.1",
            "and 1e-4 E",
            ("1e-4", 1e-4),
            vec![most(MSH015, tiny, raise_top, 1e-4 * 0.001)],
        ),
        number(
            "convex",
            "7.8",
            "by a sine above 1e-6",
            ("1e-6", 1e-6),
            // Just convex: the fan from the first corner is asked for.
            vec![least(MSH015, Fixture::toy, nearly_convex, 1e-6)],
        ),
        number(
            "convex-or-not",
            "7.8",
            "from 0.999e-6 to 1.001e-6",
            ("0.999e-6", 0.999e-6),
            vec![sides(MSH015, Fixture::toy, nearly_convex, 0.999e-6, [0.9985e-6, 0.9995e-6])],
        ),
        number(
            "not-convex-or-convex",
            "7.8",
            "to 1.001e-6, a face",
            ("1.001e-6", 1.001e-6),
            vec![Sides::Elsewhere(
                "beyond it, a fan differs from a cut by slivers that need no counterpart",
            )],
        ),
        number(
            "outside-of-a-hull",
            "7.9",
            "the resolution times 1 + size / h",
            ("1", 1.0),
            vec![wide(
                MSH018,
                shown_mesh,
                roof,
                outside_of_hull(),
                [1.03 * outside_of_hull(), 0.97 * outside_of_hull()],
                BINARY32,
            )],
        ),
        number(
            "out-of-hull",
            "7.10",
            "by more than 2 % of the diagonal",
            ("2 %", 0.02),
            vec![there("MSH021/just-above-2-percent", "MSH023/just-below-2-percent")],
        ),
        number(
            "barely-out-of-hull",
            "7.10",
            "by more than 1e-4 of it",
            ("1e-4", 1e-4),
            vec![most(MSH023, lone_box, reach_out, 1e-4 * DIAGONAL)],
        ),
        number(
            "splinter-out-of-hull",
            "7.10",
            "8 times the resolution of the hull",
            ("8", 8.0),
            vec![Sides::Elsewhere("the robots of tests/program/generate/slivers.rs")],
        ),
        number(
            "coverage",
            "7.10",
            "the smaller of `surface_tolerance` of `method` and 5 % of the diagonal",
            ("5 %", 0.05),
            vec![
                most(MSH022, lone_box, without_a_promise, 0.05 * DIAGONAL),
                most(MSH022, lone_box, with_a_promise, 0.01),
            ],
        ),
    ]
}

/// What is accepted below 2 % is a warning of another rule.
pub fn cases() -> Vec<crate::Case> {
    let case = |code, name, of: f64| {
        crate::changed(code, name, true, lone_box, move |f| reach_out(f, of * 0.02 * DIAGONAL))
    };
    vec![
        case(MSH021, "just-above-2-percent", 1.005),
        case(MSH023, "just-below-2-percent", 0.995),
        // E is 3.51 m, and the tolerance 3.35e-6 m; no coordinate is above 2.05 m.
        crate::changed(MSH015, "shape-far-along-a-diagonal", false, far_box, |f| {
            raise_top(f, 3e-6);
        }),
        crate::changed(MSH015, "shape-too-far-along-a-diagonal", true, far_box, |f| {
            raise_top(f, 3.6e-6);
        }),
        // The mesh's corner is still inside the hull.
        crate::changed(MSH019, "off-by-four-resolutions", true, lone_box, |f| {
            geometry_alone(f);
            rewrite(f, HULLS, ALL, |mesh| {
                let mut points = mesh.vertices.clone();
                points[7][0] += 4.0 * RESOLUTION * 0.15;
                *mesh = ConvexHull::new(&points).expect("a hull").into_mesh();
            });
        }),
        crate::changed(MSH022, "one-corner-left-out", true, lone_box, |f| {
            cut_corner(f, 0.04);
        }),
        crate::changed(MSH022, "less-of-a-corner-left-out", false, lone_box, |f| {
            cut_corner(f, 0.03);
        }),
    ]
}
