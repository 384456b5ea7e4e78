//! MSH015: a face that is convex in the file, and not in place, where a node has widened it (SPEC 7.8).

use serde_json::json;
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_validate::code::Code::*;

use super::{ALL, BASE, put};
use crate::meshes::{HULLS, ORIGINAL, PIECES, PLAIN, boxy, robot_of, text};
use crate::numbers::geometry::geometry_alone;
use crate::{Case, changed};
use testkit::fixture::Fixture;
use testkit::robot::*;

/// How many times as wide the node makes the prism along y.
const WIDER: f64 = 16384.0;

const LENGTH: f64 = 0.5;
const WIDTH: f64 = 0.25;
const HEIGHT: f64 = 0.125;

/// How far the second corner of the outline is moved inward, in place. The outline turns back there by a sine of
/// 4 DENT / LENGTH: 8e-3 in place, 5e-7 in the file.
const DENT: f64 = 1.0 / 1024.0;

/// The corners of the prism, those of the bottom first, `narrower` times as wide as in place.
fn corners(narrower: f64) -> Vec<[f64; 3]> {
    let half = LENGTH / 2.0;
    let outline = [[-half, 0.0], [0.0, DENT], [half, 0.0], [half, WIDTH], [-half, WIDTH]];
    let ends = [0.0, HEIGHT].into_iter();
    ends.flat_map(|z| outline.map(|[x, y]| [x, y / narrower, z])).collect()
}

/// Bottom, top and sides.
fn faces() -> Vec<Vec<u32>> {
    let ends = [vec![0, 4, 3, 2, 1], vec![5, 6, 7, 8, 9]];
    let sides = (0..5).map(|at| {
        let next = (at + 1) % 5;
        vec![at, next, next + 5, at + 5]
    });
    ends.into_iter().chain(sides).collect()
}

fn fan(face: &[u32]) -> Vec<[u32; 3]> {
    face[1..].windows(2).map(|pair| [face[0], pair[0], pair[1]]).collect()
}

fn collada() -> String {
    let words = |numbers: Vec<String>| numbers.join(" ");
    let numbers = corners(WIDER).as_flattened().iter().map(f64::to_string).collect();
    let counts = faces().iter().map(|face| face.len().to_string()).collect();
    let indices = faces().concat().iter().map(u32::to_string).collect();
    let (numbers, counts, indices) = (words(numbers), words(counts), words(indices));
    format!(
        r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_geometries><geometry id="prism"><mesh>
<source id="p"><float_array id="a" count="30">{numbers}</float_array>
<technique_common><accessor source="#a" count="10" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="7"><input semantic="VERTEX" source="#v" offset="0"/><vcount>{counts}</vcount><p>{indices}</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><scale>1 {WIDER} 1</scale><instance_geometry url="#prism"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
"##
    )
}

/// A link that shows the prism, after one that shows a box. Class Geometry.
fn prism() -> Fixture {
    let mut robot = robot_of(vec![boxy("a"), link("b")]);
    robot.meshes.insert("part.dae".to_owned(), [LENGTH, WIDTH, HEIGHT]);
    robot.link_mut("b").visual.push(visual(None, mesh("part.dae", None)));
    let mut f = Fixture::full(&robot);
    geometry_alone(&mut f);
    let path = text(&f, ORIGINAL, "/files/0/path");
    f.put_file(&path, collada());
    let hull = ConvexHull::new(&corners(1.0)).expect("a hull").into_mesh();
    for format in ALL {
        put(&mut f, HULLS, BASE, format, &hull);
        put(&mut f, PIECES, BASE, format, &hull);
    }
    cut_top(&mut f, fan(&faces()[1]));
    f
}

/// Gives the plain mesh these triangles for the top, and fans for all other faces.
fn cut_top(f: &mut Fixture, top: Vec<[u32; 3]>) {
    let others = faces().into_iter().enumerate().filter(|(at, _)| *at != 1);
    let others = others.flat_map(|(_, face)| fan(&face));
    let triangles = top.into_iter().chain(others).collect();
    let mesh = Mesh { vertices: corners(1.0), triangles };
    for format in ALL {
        put(f, PLAIN, BASE, format, &mesh);
    }
}

pub fn cases() -> Vec<Case> {
    vec![
        changed(MSH015, "face-convex-only-before-its-scale", false, prism, |f| {
            assert_eq!(f.get(ORIGINAL, "/files/0/usable"), &json!(true));
        }),
        changed(MSH015, "face-convex-before-its-scale-cut-otherwise", true, prism, |f| {
            cut_top(f, vec![[5, 6, 9], [6, 8, 9], [6, 7, 8]]);
        }),
    ]
}
