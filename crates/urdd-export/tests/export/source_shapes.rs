//! Shapes of the source: what the text of the URDF says is what the formats have.

use std::collections::BTreeMap;

use tempfile::TempDir;
use urdd_export::{Choices, Detail, Export, ExportError, Format, Note, Shapes};
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_robot::{Robot, ShapeKind};

use crate::made::{export, robot, urdf};

/// A box of 1 x 2 x 3 m whose floor is at z = 0, twice as long along x where an L has its foot.
const BRICK: &str = "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
/// An L of 3 m2 and 1 m.
const ELL: &str = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n\
    v 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\n\
    f 4 3 2 1\nf 6 5 4 1\nf 7 8 9 10\nf 7 10 11 12\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n";

fn with_meshes(parts: &str) -> (TempDir, Robot) {
    let folder = TempDir::new().expect("a folder");
    std::fs::write(folder.path().join("brick.obj"), BRICK).expect("a mesh");
    std::fs::write(folder.path().join("ell.obj"), ELL).expect("a mesh");
    let source = folder.path().join("robot.urdf");
    std::fs::write(&source, urdf(parts)).expect("a URDF");
    let path = folder.path().join("urdd");
    urdd_generate::generate(&source, &path, &Default::default(), &()).expect("a URDD");
    let robot = Robot::open(&path).expect("a robot");
    (folder, robot)
}

fn of_source(robot: &Robot, format: Format) -> Export {
    let choices = Choices { shapes: Shapes::Source, ..Choices::default() };
    export(robot, format, &choices).expect("an export")
}

fn shape(tag: &str, pose: &str, geometry: &str) -> String {
    format!("<{tag}><origin {pose}/><geometry>{geometry}</geometry></{tag}>")
}

fn link(name: &str, inside: &str) -> String {
    format!("<link name=\"{name}\">{inside}</link>")
}

/// The attributes of the elements that `is_wanted` takes, as texts, in their order.
fn found(
    text: &str,
    is_wanted: impl Fn(&urdd_xml::Node) -> bool,
    keys: &[&str],
) -> Vec<Vec<String>> {
    let document = urdd_xml::parse(text, urdd_xml::Kind::Other).expect("well-formed");
    let nodes = document.descendants().filter(|node| node.is_element() && is_wanted(node));
    let of = |node: urdd_xml::Node, key: &str| node.attribute(key).unwrap_or("-").to_owned();
    nodes.map(|node| keys.iter().map(|key| of(node, key)).collect()).collect()
}

fn geoms(text: &str, class: &str) -> Vec<Vec<String>> {
    let is_wanted =
        |node: &urdd_xml::Node| node.has_tag_name("geom") && node.attribute("class") == Some(class);
    found(text, is_wanted, &["type", "size", "pos"])
}

/// One of each primitive, and a capsule as `urdd import` writes it, its spheres far from it in the list.
fn primitives() -> String {
    let each = [
        ("xyz=\"1 0 0\"", "<box size=\"0.2 0.4 0.6\"/>"),
        ("xyz=\"0 0 -0.5\"", "<sphere radius=\"0.25\"/>"),
        ("xyz=\"2 0 0\"", "<cylinder radius=\"0.1\" length=\"0.5\"/>"),
        ("xyz=\"0 0 0\"", "<cylinder radius=\"0.25\" length=\"1\"/>"),
        ("xyz=\"3 0 0\"", "<sphere radius=\"0.3\"/>"),
        ("xyz=\"0 0 0.5\"", "<sphere radius=\"0.25\"/>"),
    ];
    each.map(|(pose, geometry)| shape("collision", pose, geometry)).concat()
}

#[test]
fn mujoco_gets_the_primitives_with_half_sizes() {
    let (_folder, robot) = robot(&urdf(&link("a", &primitives())));
    let made = of_source(&robot, Format::Mjcf);
    let expected = [
        ["box", "0.1 0.2 0.3", "1 0 0"],
        ["cylinder", "0.1 0.25", "2 0 0"],
        ["capsule", "0.25 0.5", "0 0 0"],
        ["sphere", "0.3", "3 0 0"],
    ];
    assert_eq!(geoms(&made.text, "collision"), expected);
    let said = "the source, 1 box, 1 cylinder, 1 capsule, 1 sphere;";
    assert!(made.notes.iter().any(|note| note.to_string().contains(said)), "{:?}", made.notes);
    assert!(made.report.contains(said), "{}", made.report);
    assert!(!made.files.iter().any(|(path, _)| path.contains("piece")), "no mesh");
}

#[test]
fn drake_sdf_and_usd_get_one_capsule_and_a_urdf_stays_as_it_is() {
    let (_folder, robot) = robot(&urdf(&link("a", &primitives())));
    let drake = of_source(&robot, Format::Drake).text;
    let is = |tag: &'static str| move |node: &urdd_xml::Node| node.tag_name().name() == tag;
    let capsules = found(&drake, is("capsule"), &["radius", "length"]);
    assert_eq!(capsules, [["0.25", "1"]]);
    assert_eq!(found(&drake, is("sphere"), &["radius"]), [["0.3"]]);
    let sdf = of_source(&robot, Format::Sdf).text;
    assert!(sdf.contains("<capsule>"), "{sdf}");
    let document = urdd_xml::parse(&sdf, urdd_xml::Kind::Other).expect("SDF");
    let capsule = document.descendants().find(|node| node.has_tag_name("capsule")).expect("one");
    let sizes: Vec<&str> = capsule
        .children()
        .filter_map(|node| node.text())
        .map(str::trim)
        .filter(|it| !it.is_empty())
        .collect();
    assert_eq!(sizes, ["0.25", "1"]);
    let usd = of_source(&robot, Format::Usd).text;
    for line in [
        "def Capsule \"piece_3\"",
        "double radius = 0.25",
        "double height = 1",
        "def Cylinder \"piece_2\"",
        "double height = 0.5",
        "def Sphere \"piece_4\"",
    ] {
        assert!(usd.contains(line), "{line}\n{usd}");
    }
    for format in [Format::Urdf, Format::Moveit] {
        let made = of_source(&robot, format);
        let is_urdf = |(path, _): &&(String, Vec<u8>)| path.ends_with(".urdf");
        let text = match made.files.iter().find(is_urdf) {
            Some((_, bytes)) => String::from_utf8(bytes.clone()).expect("UTF-8"),
            None => made.text,
        };
        let radii = found(&text, is("sphere"), &["radius"]);
        assert_eq!(radii, [["0.25"], ["0.3"], ["0.25"]], "{format:?}");
        let cylinders = found(&text, is("cylinder"), &["radius", "length"]);
        assert_eq!(cylinders, [["0.1", "0.5"], ["0.25", "1"]], "{format:?}");
        assert_eq!(found(&text, is("box"), &["size"]), [["0.2 0.4 0.6"]], "{format:?}");
    }
}

#[test]
fn a_sphere_that_is_not_at_the_end_stays() {
    for (pose, radius) in [("0 0 0.49", "0.25"), ("0 0 0.5", "0.24"), ("0 0 -0.5", "0.25")] {
        let parts = [
            shape("collision", "xyz=\"0 0 0\"", "<cylinder radius=\"0.25\" length=\"1\"/>"),
            shape("collision", "xyz=\"0 0 -0.5\"", "<sphere radius=\"0.25\"/>"),
            shape(
                "collision",
                &format!("xyz=\"{pose}\""),
                &format!("<sphere radius=\"{radius}\"/>"),
            ),
        ];
        let (_folder, robot) = robot(&urdf(&link("a", &parts.concat())));
        let geoms = geoms(&of_source(&robot, Format::Mjcf).text, "collision");
        let kinds: Vec<&str> = geoms.iter().map(|geom| geom[0].as_str()).collect();
        assert_eq!(kinds, ["cylinder", "sphere", "sphere"], "{pose}");
    }
}

#[test]
fn visual_primitives_stay_primitives_with_their_colours() {
    let red = "<material name=\"red\"/>";
    let visual = |geometry: &str| {
        format!("<visual><origin xyz=\"0 0 1\"/><geometry>{geometry}</geometry>{red}</visual>")
    };
    let both = visual("<cylinder radius=\"0.5\" length=\"2\"/>")
        + &visual("<mesh filename=\"brick.obj\"/>");
    let parts = "<material name=\"red\"><color rgba=\"1 0 0 1\"/></material>".to_owned()
        + &link("a", &(both + &shape("collision", "", "<sphere radius=\"1\"/>")));
    let (_folder, robot) = with_meshes(&parts);
    let mjcf = of_source(&robot, Format::Mjcf).text;
    let is_visual = |node: &urdd_xml::Node| {
        node.attribute("class") == Some("visual") && node.has_tag_name("geom")
    };
    let visuals = found(&mjcf, is_visual, &["type", "size", "pos", "rgba"]);
    assert_eq!(visuals[0][0], "mesh");
    assert_eq!(visuals[0][3], "1 0 0 1");
    assert_eq!(visuals[1], ["cylinder", "0.5 1", "0 0 1", "1 0 0 1"]);
    let urdf = of_source(&robot, Format::Urdf).text;
    let cylinder = found(&urdf, |node| node.has_tag_name("cylinder"), &["radius", "length"]);
    assert_eq!(cylinder, [["0.5", "2"]]);
    let usd = of_source(&robot, Format::Usd).text;
    assert!(usd.contains("def Cylinder \"primitive_0\""), "{usd}");
    let sdf = of_source(&robot, Format::Sdf).text;
    assert!(sdf.contains("primitive_0"), "{sdf}");
    // Without visuals there are none.
    let choices =
        Choices { shapes: Shapes::Source, visuals: Detail::Nothing, ..Choices::default() };
    let bare = export(&robot, Format::Mjcf, &choices).expect("an export").text;
    assert!(geoms(&bare, "visual").is_empty());
}

/// The vertices and triangles of a binary STL.
fn stl(bytes: &[u8]) -> Vec<[[f64; 3]; 3]> {
    let number = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().expect("4 bytes"));
    let corner = |at: usize| [0, 4, 8].map(|k| f64::from(number(at + k)));
    (84..bytes.len()).step_by(50).map(|at| [12, 24, 36].map(|k| corner(at + k))).collect()
}

fn volume(triangles: &[[[f64; 3]; 3]]) -> f64 {
    let det = |[a, b, c]: &[[f64; 3]; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    triangles.iter().map(det).sum::<f64>() / 6.0
}

#[test]
fn meshes_are_scaled_mirrored_and_placed() {
    let mesh = "<mesh filename=\"brick.obj\" scale=\"-0.1 0.1 0.1\"/>";
    let (_folder, robot) = with_meshes(&link("a", &shape("collision", "xyz=\"5 0 0\"", mesh)));
    let made = of_source(&robot, Format::Urdf);
    let (_, bytes) = made.files.iter().find(|(path, _)| path.ends_with(".stl")).expect("a mesh");
    let triangles = stl(bytes);
    // 0.1 x 0.2 x 0.3 m, outward in spite of the mirror, from x = 5 down to 4.9.
    assert!((volume(&triangles) - 0.006).abs() < 1e-6, "{}", volume(&triangles));
    let xs: Vec<f64> = triangles.iter().flatten().map(|corner| corner[0]).collect();
    let (low, high) = xs.iter().fold((9.0f64, 0.0f64), |(l, h), x| (l.min(*x), h.max(*x)));
    assert!((low - 4.9).abs() < 1e-6 && (high - 5.0).abs() < 1e-6, "{low} {high}");
}

#[test]
fn a_mesh_that_is_not_convex_is_written_as_it_is_and_said() {
    let ell = shape("collision", "", "<mesh filename=\"ell.obj\"/>");
    let brick = shape("collision", "", "<mesh filename=\"brick.obj\"/>");
    let (_folder, robot) = with_meshes(&link("a", &(ell + &brick)));
    for format in [Format::Mjcf, Format::Drake, Format::Sdf, Format::Usd, Format::Urdf] {
        let made = of_source(&robot, format);
        let is_said = |note: &&Note| note.to_string().contains("not convex");
        let notes: Vec<String> =
            made.notes.iter().filter(is_said).map(ToString::to_string).collect();
        assert_eq!(notes.len(), 1, "{format:?}");
        let takes_hulls = format != Format::Urdf;
        assert_eq!(notes[0].contains("convex hulls"), takes_hulls, "{notes:?}");
        if matches!(format, Format::Drake | Format::Sdf) {
            // Of the brick alone.
            assert_eq!(made.text.matches("drake:declare_convex").count(), 1, "{format:?}");
        }
    }
    let made = of_source(&robot, Format::Urdf);
    let volumes: Vec<f64> = (made.files.iter().filter(|(path, _)| path.ends_with(".stl")))
        .map(|(_, bytes)| volume(&stl(bytes)))
        .collect();
    assert!((volumes[0] - 3.0).abs() < 1e-6 && (volumes[1] - 6.0).abs() < 1e-6, "{volumes:?}");
}

#[test]
fn links_without_collision_elements_have_pieces() {
    let ball = shape("collision", "", "<sphere radius=\"0.1\"/>");
    let seen = shape("visual", "", "<box size=\"1 1 1\"/>");
    let joint = "<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint>";
    let parts = link("a", &ball) + &link("b", &seen) + joint;
    let (_folder, robot) = robot(&urdf(&parts));
    let made = of_source(&robot, Format::Mjcf);
    let kinds: Vec<String> =
        geoms(&made.text, "collision").into_iter().map(|of| of[0].clone()).collect();
    assert_eq!(kinds, ["sphere", "mesh"]);
    let is_said = |note: &Note| matches!(note, Note::Links { links, what } if links == &["b"] && what.starts_with("no collision geometry"));
    assert!(made.notes.iter().any(is_said), "{:?}", made.notes);
    // Pieces say so as well, whatever the format.
    for format in Format::ALL {
        let choices = Choices { samples: 100, ..Choices::default() };
        let made = export(&robot, *format, &choices).expect("an export");
        assert!(made.notes.iter().any(is_said), "{format:?} {:?}", made.notes);
    }
}

#[test]
fn what_is_missing_is_left_out_and_said() {
    let parts = [
        shape("collision", "", "<sphere radius=\"0.1\"/>"),
        shape("collision", "", "<mesh filename=\"gone.stl\"/>"),
        shape("collision", "", "<sphere radius=\"0\"/>"),
        shape("collision", "xyz=\"1 0 0\"", "<cylinder radius=\"0.2\" length=\"0\"/>"),
    ];
    let (_folder, robot) = robot(&urdf(&link("a", &parts.concat())));
    let made = of_source(&robot, Format::Mjcf);
    let kinds: Vec<Vec<String>> = geoms(&made.text, "collision");
    // A disk has a thickness that MuJoCo accepts.
    assert_eq!(kinds[0], ["sphere", "0.1", "0 0 0"]);
    assert_eq!(kinds[1][0], "cylinder");
    let sizes: Vec<f64> =
        kinds[1][1].split(' ').map(|size| size.parse().expect("a size")).collect();
    assert_eq!(sizes, [0.2, 1e-6]);
    assert!(
        made.notes.iter().any(|note| note.to_string().contains("left out: a size is 0")),
        "{:?}",
        made.notes
    );
    // A link with nothing that can be used has neither shapes nor an end.
    let (_folder, robot) =
        crate::made::robot(&urdf(&link("a", &shape("collision", "", "<sphere radius=\"0\"/>"))));
    assert!(of_source(&robot, Format::Mjcf).notes.contains(&Note::NoShapes(Shapes::Source)));
}

#[test]
fn spheres_of_the_source_are_refused() {
    let (_folder, robot) = robot(&urdf(&link("a", &primitives())));
    for format in [Format::Curobo, Format::Foam, Format::Spherized] {
        let choices = Choices { shapes: Shapes::Source, ..Choices::default() };
        let refused = export(&robot, format, &choices);
        assert_eq!(refused, Err(ExportError::SpheresOf(Shapes::Source)), "{format:?}");
    }
}

#[test]
fn pieces_say_what_became_of_primitives() {
    let (_folder, of_collision) = robot(&urdf(&link("a", &primitives())));
    let seen = shape("visual", "", "<box size=\"1 1 1\"/>");
    let (_other, of_visual) = robot(&urdf(&link("a", &(seen + &primitives()))));
    for (robot, is_visual) in [(of_collision, false), (of_visual, true)] {
        let made = export(&robot, Format::Mjcf, &Choices::default()).expect("an export");
        let found = made.notes.iter().find_map(|note| match note {
            Note::NotOfSource { elements, shapes, is_visual } => {
                Some((elements.to_string(), *shapes, *is_visual))
            }
            _ => None,
        });
        let elements = "1 box, 2 cylinders, 3 spheres".to_owned();
        assert_eq!(found, Some((elements, ShapeKind::Pieces.into(), is_visual)));
        assert!(made.text.contains("choose the shapes `source`"), "{}", made.text);
        assert!(made.report.contains("choose the shapes `source`"), "{}", made.report);
    }
}

/// Three links in a row. The shapes of the first and of the last overlap, or not, as collision elements; their visual
/// elements do the opposite.
fn row(distance: f64, visual: f64, middle: &str) -> String {
    let ball =
        |tag: &str, x: f64| shape(tag, &format!("xyz=\"{x} 0 0\""), "<sphere radius=\"0.1\"/>");
    let joint = |name: &str, a: &str, b: &str, kind: &str| {
        format!(
            "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{a}\"/><child link=\"{b}\"/>\
             <axis xyz=\"1 0 0\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>"
        )
    };
    [
        link("a", &(ball("collision", 0.0) + &ball("visual", 0.0))),
        link("m", middle),
        link("b", &(ball("collision", distance) + &ball("visual", visual))),
        joint("i", "a", "m", "revolute"),
        joint("j", "m", "b", "revolute"),
    ]
    .concat()
}

/// The pairs of an SRDF, with those that never touch.
fn pairs(robot: &Robot, shapes: Shapes) -> BTreeMap<[String; 2], String> {
    let reasons = Some(vec![SkippedReason::Always, SkippedReason::Default, SkippedReason::Never]);
    let choices = Choices { shapes, reasons, ..Choices::default() };
    let text = export(robot, Format::Srdf, &choices).expect("an export").text;
    let is = |node: &urdd_xml::Node| node.has_tag_name("disable_collisions");
    let all = found(&text, is, &["link1", "link2", "reason"]).into_iter();
    all.map(|of| ([of[0].clone(), of[1].clone()], of[2].clone())).collect()
}

#[test]
fn pairs_are_judged_by_what_is_written() {
    let reason = |robot: &Robot, shapes: Shapes| {
        let found = pairs(robot, shapes);
        found.get(&["a".to_owned(), "b".to_owned()]).cloned().unwrap_or_default()
    };
    // Balls on the axes of both joints: 0.1 m apart they always overlap, 0.5 m apart never.
    let (_folder, near) = robot(&urdf(&row(0.1, 0.5, "")));
    assert_eq!(reason(&near, Shapes::Source), "Always");
    let (_folder, far) = robot(&urdf(&row(0.5, 0.1, "")));
    assert_eq!(reason(&far, Shapes::Source), "Never");
    // By pieces, which are of the visual geometry, it is the other way round.
    assert_eq!(reason(&near, ShapeKind::Pieces.into()), "Never");
    assert_eq!(reason(&far, ShapeKind::Pieces.into()), "Always");
    // SPEC 8.6 counts a gap of 1 mm as contact.
    let (_folder, gap) = robot(&urdf(&row(0.2009, 0.5, "")));
    assert_eq!(reason(&gap, Shapes::Source), "Always");
    let (_folder, gap) = robot(&urdf(&row(0.2011, 0.5, "")));
    assert_eq!(reason(&gap, Shapes::Source), "Never");
}

#[test]
fn moveit_judges_a_hollow_by_its_pieces_and_mujoco_by_its_hull() {
    // A ball in the corner that an L leaves free: within the hull, 0.3 m from the mesh.
    let ell = shape("collision", "", "<mesh filename=\"ell.obj\"/>");
    let ball = shape("collision", "xyz=\"1.4 1.4 0.5\"", "<sphere radius=\"0.1\"/>");
    let fixed = |name: &str, a: &str, b: &str| {
        format!(
            "<joint name=\"{name}\" type=\"fixed\"><parent link=\"{a}\"/><child link=\"{b}\"/></joint>"
        )
    };
    let parts = link("a", &ell) + &link("m", "") + &link("b", &ball);
    let (_folder, robot) = with_meshes(&(parts + &fixed("i", "a", "m") + &fixed("j", "m", "b")));
    assert_eq!(pairs(&robot, Shapes::Source).into_values().collect::<Vec<_>>(), ["Never"]);
    let drake = of_source(&robot, Format::Drake).text;
    assert!(
        drake.contains("ignored_collision_filter_group"),
        "always in contact with the hull: {drake}"
    );
}

/// Fewer than the limit, and more when each L is two pieces.
#[test]
fn pieces_count_as_shapes() {
    let ells = |count: usize| -> String {
        let at = |k: usize| format!("xyz=\"{k} 0 0\"");
        let each = (0..count).map(|k| shape("collision", &at(k), "<mesh filename=\"ell.obj\"/>"));
        each.collect()
    };
    let seen = shape("visual", "", "<box size=\"1 1 1\"/>");
    let (_folder, robot) = with_meshes(&link("a", &(seen + &ells(501))));
    let choices = Choices { shapes: Shapes::Source, ..Choices::default() };
    let error = export(&robot, Format::Srdf, &choices).expect_err("too many");
    let is_counted = |count: usize| (1002..=3006).contains(&count);
    assert!(
        matches!(error, ExportError::TooManyShapes { count, .. } if is_counted(count)),
        "{error}"
    );
    assert!(export(&robot, Format::Mjcf, &choices).is_ok(), "as hulls");
}

/// A mesh of 20,000 triangles, which the file has once.
#[test]
fn one_mesh_by_very_many_elements_is_refused() {
    let height = |x: u32, y: u32| ((x * 7 + y * 13) % 5) as f32 * 0.01;
    let corner = |x: u32, y: u32| [x as f32, y as f32, height(x, y)];
    let mut bytes = vec![0; 80];
    bytes.extend(20_000_u32.to_le_bytes());
    for (x, y) in (0..100).flat_map(|x| (0..100).map(move |y| (x, y))) {
        let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| corner(x + i, y + j));
        for triangle in [[a, b, c], [a, c, d]] {
            bytes.extend([0; 12]);
            bytes.extend(triangle.as_flattened().iter().flat_map(|value| value.to_le_bytes()));
            bytes.extend([0; 2]);
        }
    }
    let uses = |count: usize| {
        let folder = TempDir::new().expect("a folder");
        std::fs::write(folder.path().join("grid.stl"), &bytes).expect("a mesh");
        let seen = shape("visual", "", "<box size=\"1 1 1\"/>");
        let each = shape("collision", "", "<mesh filename=\"grid.stl\"/>").repeat(count);
        let source = folder.path().join("robot.urdf");
        std::fs::write(&source, urdf(&link("a", &(seen + &each)))).expect("a URDF");
        let path = folder.path().join("urdd");
        urdd_generate::generate(&source, &path, &Default::default(), &()).expect("a URDD");
        let robot = Robot::open(&path).expect("a robot");
        let choices = Choices { shapes: Shapes::Source, ..Choices::default() };
        export(&robot, Format::Urdf, &choices).map(drop)
    };
    assert!(uses(2).is_ok());
    let error = uses(40).expect_err("too much").to_string();
    assert!(error.contains("needs more memory or work"), "{error}");
}
