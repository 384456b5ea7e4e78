//! Robots of meshes that are hard to judge, as authors and programs make them: corners on a grid of 1e-6 or 1e-3, slivers of a
//! few steps, triangles twice, turned round, without an area, used mirrored and scaled. What we make of them has no finding.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use urdd_generate::{GenerateError, Pieces, Selection, Settings, generate};

use crate::generate::findings_of;
use testkit::dice::Dice;
use testkit::trials::trials;

/// Trials by default. Each takes some hundredths of a second.
const FEW: u32 = 60;

/// SPEC 7.2: of such a shape there is no URDD.
const NO_WIDTH: &str = "its shape is too thin, or too far from the link's frame";

#[test]
fn robots_of_slivers_have_no_findings() {
    let mut refused = 0;
    let count = trials(FEW);
    for seed in 0..u64::from(count) {
        let mut dice = Dice(seed << 20);
        let folder = testkit::temporary::folder();
        let urdf = robot(&mut dice, folder.path());
        let (source, target) = (folder.path().join("robot.urdf"), folder.path().join("out"));
        fs::write(&source, &urdf).unwrap();
        let pieces = Pieces { most: 1 + dice.below(4) as u8, tolerance: None };
        let selection = if seed % 8 == 0 { ["all", "link_shapes_spheres"] } else { ["all"; 2] };
        let selection = Selection::parse(selection).unwrap();
        let settings = Settings { selection, pieces, num_samples: 20, ..Settings::default() };
        match generate(&source, &target, &settings, &()) {
            Err(GenerateError::Source(error)) if error.to_string().contains(NO_WIDTH) => {
                refused += 1
            }
            Err(error) => panic!("seed {seed}: {error}\n{urdf}"),
            Ok(_) => {
                let mut findings = findings_of(&target);
                findings.retain(|(code, ..)| !code.starts_with("SRC"));
                assert_eq!(findings, [], "seed {seed}\n{urdf}");
            }
        }
    }
    assert!(4 * refused < count, "{refused} of {count} were refused");
}

type Point = [i64; 3];

/// Faces on a grid.
struct Faces {
    step: f64,
    faces: Vec<Vec<Point>>,
}

fn one_of<T: Copy>(dice: &mut Dice, all: &[T]) -> T {
    all[dice.below(all.len())]
}

fn between(dice: &mut Dice, low: i64, high: i64) -> i64 {
    low + dice.below((high - low) as usize) as i64
}

/// Some coordinates of a point along axes in this order.
fn along(order: [usize; 3], p: Point, by: Point) -> Point {
    let mut moved = p;
    (0..3).for_each(|k| moved[order[k]] += by[k]);
    moved
}

impl Faces {
    fn new(dice: &mut Dice) -> Faces {
        let mut faces = Faces { step: one_of(dice, &[1e-6, 1e-6, 1e-5, 1e-3]), faces: Vec::new() };
        let far = if faces.step < 1e-3 { one_of(dice, &[50, 5_000, 500_000]) } else { 500 };
        let middle = [0; 3].map(|_: i64| between(dice, -far, far));
        for number in 0..2 + dice.below(14) {
            let spread = one_of(dice, &[3, 30, 3_000]);
            let p = middle.map(|x| x + between(dice, -spread, spread));
            if number == 0 && dice.below(8) > 0 {
                faces.body(dice, p);
            } else {
                faces.add(dice, p);
            }
        }
        faces
    }

    fn body(&mut self, dice: &mut Dice, p: Point) {
        let size =
            [0; 3].map(|_: i64| one_of(dice, &[7, 50, 400, 20_000]).min((0.5 / self.step) as i64));
        let corner = |k: usize| [0, 1, 2].map(|axis| p[axis] + size[axis] * (k >> axis & 1) as i64);
        let sides =
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        self.faces.extend(sides.map(|side| side.map(corner).to_vec()));
    }

    fn add(&mut self, dice: &mut Dice, p: Point) {
        let order = one_of(dice, &[[0, 1, 2], [1, 2, 0], [2, 0, 1], [1, 0, 2]]);
        let long = one_of(dice, &[2, 4, 13, 700, 30_000]).min((0.5 / self.step) as i64);
        let earlier = (self.faces.len()).checked_sub(1).map(|_| dice.below(self.faces.len()));
        let earlier = earlier.map(|at| self.faces[at].clone());
        let face = match (dice.below(8), earlier) {
            // As high as so many steps.
            (0..=2, _) => {
                let high = one_of(dice, &[1, 1, 1, 2, 3, 5, 6]);
                let foot = between(dice, -1, long + 2);
                vec![p, along(order, p, [long, 0, 0]), along(order, p, [foot, high, 0])]
            }
            (3, _) => vec![p, along(order, p, [long, 1, 0]), along(order, p, [2 * long, 2, 0])],
            (4, Some(mut same)) => {
                same.rotate_left(1);
                same
            }
            (5, Some(mut turned)) => {
                turned.reverse();
                turned
            }
            (6, Some(mut near)) => {
                let at = dice.below(near.len());
                near[at][order[0]] += 1;
                near
            }
            // Round, on the grid.
            (7, _) => {
                let corners = 5 + dice.below(8);
                let angle = |k: usize| std::f64::consts::TAU * k as f64 / corners as f64;
                let on = |k: usize| {
                    let (sine, cosine) = angle(k).sin_cos();
                    along(order, p, [cosine, sine, 0.0].map(|x| (x * long as f64).round() as i64))
                };
                (0..corners).map(on).collect()
            }
            (_, _) => vec![p, p, along(order, p, [0, long, 0])],
        };
        self.faces.push(face);
    }

    /// Numbers as a file has them: six digits behind the point.
    fn number(&self, x: i64) -> String {
        format!("{:.6}", x as f64 * self.step)
    }

    fn numbers(&self, p: Point) -> String {
        p.map(|x| self.number(x)).join(" ")
    }

    fn value(&self, p: Point) -> [f32; 3] {
        p.map(|x| self.number(x).parse().unwrap())
    }

    fn triangles(&self) -> impl Iterator<Item = [Point; 3]> {
        let fan = |face: &'_ Vec<Point>| {
            (1..face.len() - 1).map(|k| [face[0], face[k], face[k + 1]]).collect::<Vec<_>>()
        };
        self.faces.iter().flat_map(fan)
    }

    fn obj(&self) -> Vec<u8> {
        let (mut text, mut last) = (String::new(), 0);
        for face in &self.faces {
            face.iter().for_each(|p| writeln!(text, "v {}", self.numbers(*p)).unwrap());
            let indices: Vec<String> =
                face.iter().zip(last + 1..).map(|(_, at)| at.to_string()).collect();
            writeln!(text, "f {}", indices.join(" ")).unwrap();
            last += face.len();
        }
        text.into_bytes()
    }

    fn stl(&self) -> Vec<u8> {
        let triangles: Vec<[Point; 3]> = self.triangles().collect();
        let mut bytes = vec![0; 80];
        bytes.extend((triangles.len() as u32).to_le_bytes());
        for triangle in triangles {
            let numbers = [[0.0; 3]].into_iter().chain(triangle.map(|p| self.value(p))).flatten();
            numbers.for_each(|x| bytes.extend(x.to_le_bytes()));
            bytes.extend([0, 0]);
        }
        bytes
    }

    fn stl_text(&self) -> Vec<u8> {
        let mut text = "solid a\n".to_owned();
        for triangle in self.triangles() {
            let corners = triangle.map(|p| format!("vertex {}\n", self.numbers(p))).concat();
            write!(text, "facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n").unwrap();
        }
        (text + "endsolid a\n").into_bytes()
    }

    fn dae(&self, node: &str) -> Vec<u8> {
        let corners: Vec<String> = self.faces.iter().flatten().map(|p| self.numbers(*p)).collect();
        let counts: Vec<String> = self.faces.iter().map(|face| face.len().to_string()).collect();
        let indices: Vec<String> = (0..corners.len()).map(|at| at.to_string()).collect();
        format!(
            r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><library_geometries><geometry id="g"><mesh>
<source id="s"><float_array id="f" count="{}">{}</float_array><technique_common><accessor source="#f" count="{}" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<polylist count="{}"><input semantic="VERTEX" source="#v" offset="0"/><vcount>{}</vcount><p>{}</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="a"><node>{node}<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#a"/></scene></COLLADA>"##,
            3 * corners.len(),
            corners.join(" "),
            corners.len(),
            counts.len(),
            counts.join(" "),
            indices.join(" "),
        )
        .into_bytes()
    }

    fn glb(&self, node: &str) -> Vec<u8> {
        let corners: Vec<[f32; 3]> = self.triangles().flatten().map(|p| self.value(p)).collect();
        let bin: Vec<u8> = corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        let mut json = format!(
            r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0{node}}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}}],"bufferViews":[{{"buffer":0,"byteLength":{1}}}],"buffers":[{{"byteLength":{1}}}]}}"#,
            corners.len(),
            bin.len(),
        );
        json += &" ".repeat(json.len().next_multiple_of(4) - json.len());
        let mut bytes = b"glTF".to_vec();
        bytes.extend(2_u32.to_le_bytes());
        bytes.extend((28 + json.len() as u32 + bin.len() as u32).to_le_bytes());
        for (kind, chunk) in [(b"JSON", json.as_bytes()), (b"BIN\0", &bin)] {
            bytes.extend((chunk.len() as u32).to_le_bytes());
            bytes.extend(kind);
            bytes.extend(chunk);
        }
        bytes
    }
}

/// Writes the meshes of a robot of two links, and gives its URDF.
fn robot(dice: &mut Dice, folder: &Path) -> String {
    let mut urdf = "<robot name=\"slivers\">\n".to_owned();
    for link in ["a", "b"] {
        let mut elements = String::new();
        let faces = Faces::new(dice);
        let (end, bytes) = match dice.below(7) {
            0 => ("stl", faces.stl()),
            1 => ("stl", faces.stl_text()),
            2 => ("dae", faces.dae("")),
            3 => (
                "dae",
                faces.dae("<matrix>-0.001 0 0 0.2 0 0.001 0 0 0 0 0.001 -0.1 0 0 0 1</matrix>"),
            ),
            4 => ("glb", faces.glb("")),
            5 => ("glb", faces.glb(r#","scale":[1,-0.5,1],"translation":[0.01,0,0.3]"#)),
            _ => ("obj", faces.obj()),
        };
        let name = format!("{link}.{end}");
        fs::write(folder.join(&name), bytes).unwrap();
        for _ in 0..1 + dice.below(2) {
            let scale = one_of(
                dice,
                &["", "1 1 1", "0.001 0.001 0.001", "-1 1 1", "1 -0.5 2", "0.3 0.3 -0.3", "1 0 1"],
            );
            let scale =
                if scale.is_empty() { String::new() } else { format!(" scale=\"{scale}\"") };
            let geometry = format!("<mesh filename=\"{name}\"{scale}/>");
            write!(elements, "<visual>{}<geometry>{geometry}</geometry></visual>", origin(dice))
                .unwrap();
        }
        if dice.below(3) == 0 {
            let step = one_of(dice, &[1e-6, 1e-5, 1e-3]);
            let mut size = || format!("{:.6}", step * between(dice, 1, 60) as f64);
            let sizes = [size(), size(), size()];
            let geometry = match dice.below(3) {
                0 => format!("<box size=\"{}\"/>", sizes.join(" ")),
                1 => format!("<sphere radius=\"{}\"/>", sizes[0]),
                _ => format!("<cylinder radius=\"{}\" length=\"{}\"/>", sizes[0], sizes[1]),
            };
            write!(elements, "<visual>{}<geometry>{geometry}</geometry></visual>", origin(dice))
                .unwrap();
        }
        writeln!(urdf, "<link name=\"{link}\">{elements}</link>").unwrap();
    }
    urdf += r#"<joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0.1 0 0.25"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"#;
    urdf
}

fn origin(dice: &mut Dice) -> String {
    let shift = |dice: &mut Dice| format!("{:.3}", 0.001 * between(dice, -900, 900) as f64);
    let xyz = [shift(dice), shift(dice), shift(dice)].join(" ");
    match dice.below(4) {
        0 => String::new(),
        1 => format!("<origin xyz=\"{xyz}\"/>"),
        2 => "<origin rpy=\"1.5707963 0 -1.5707963\"/>".to_owned(),
        _ => format!(
            "<origin xyz=\"{xyz}\" rpy=\"{}\"/>",
            [shift(dice), shift(dice), shift(dice)].join(" ")
        ),
    }
}
