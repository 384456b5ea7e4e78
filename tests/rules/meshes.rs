//! MSH.

use serde_json::{Value, json};
use urdd_format::urdf::{Capsule, Cylinder, Geometry, Joint, JointType, Link, Sphere};
use urdd_validate::code::Code::*;

use crate::{Case, changed, near_miss};
use testkit::fixture::{Fixture, URDF};
use testkit::robot::*;

pub const ORIGINAL: &str = "original_meshes_module";
pub const PLAIN: &str = "plain_meshes_module";
pub const HULLS: &str = "convex_hull_meshes_module";
pub const PIECES: &str = "convex_decomposition_meshes_module";

/// A robot of these links, each fixed to the first at one metre along x.
pub fn robot_of(links: Vec<Link>) -> Robot {
    let mut robot = Robot::new("few links");
    let first = links.first().map(|link| link.name.clone());
    let first = first.unwrap_or_default();
    for (at, link) in links.iter().enumerate().skip(1) {
        robot.urdf.joints.push(Joint {
            origin: origin([at as f64, 0.0, 0.0], [0.0; 3]),
            ..joint(&format!("joint {at}"), JointType::Fixed, &first, &link.name)
        });
    }
    robot.urdf.links = links;
    robot
}

/// A link that shows a box.
pub fn boxy(name: &str) -> Link {
    Link { visual: vec![visual(None, cuboid([0.1, 0.2, 0.3]))], ..link(name) }
}

/// A URDD of class Shapes without any shape.
pub fn without_shapes() -> Fixture {
    Fixture::full(&robot_of(vec![link("a"), link("b")]))
}

/// The modules of the first robot with the URDF and `urdf_module` of the second.
fn with_urdf_of(modules: &Robot, urdf: &Robot) -> Fixture {
    let mut fixture = Fixture::full(modules);
    let other = Fixture::core(urdf);
    fixture.documents.insert("urdf_module".to_owned(), other.doc("urdf_module").clone());
    fixture.files.insert(URDF.to_owned(), other.file(URDF).to_vec());
    fixture
}

pub fn text(fixture: &Fixture, module: &str, pointer: &str) -> String {
    let text = fixture.get(module, pointer).as_str();
    text.expect("a string").to_owned()
}

/// Gives a file another name, in the document too.
pub fn rename(fixture: &mut Fixture, module: &str, pointer: &str, new: &str) {
    let old = text(fixture, module, pointer);
    let bytes = fixture.file(&old).to_vec();
    fixture.remove_file(&old);
    fixture.unlist(&old);
    fixture.put_file(new, bytes);
    fixture.list(new);
    fixture.set(module, pointer, json!(new));
}

pub fn cases() -> Vec<Case> {
    let mut cases = files();
    cases.extend(links());
    cases
}

/// MSH001 to MSH006, MSH010.
fn files() -> Vec<Case> {
    vec![
        changed(MSH001, "one-link", false, || Fixture::full(&robot_of(vec![boxy("a")])), |_| {}),
        near_miss(MSH003, "glb-alone", |f| {
            for module in [PLAIN, HULLS, PIECES] {
                without_formats(f, module);
            }
        }),
        // Two pieces, one, and none.
        changed(
            MSH004,
            "as-many-as-it-takes",
            false,
            || Fixture::full(&robot_of(vec![boxy("a"), boxy("b"), link("c")])),
            |_| {},
        ),
        changed(
            MSH006,
            "link-of-an-empty-name",
            false,
            || Fixture::full(&robot_of(["a", ""].map(boxy).into())),
            |_| {},
        ),
        changed(
            MSH006,
            "odd-names",
            false,
            || {
                let names = ["a//b", "-_-", "ÄÖÜ", &"long".repeat(30)];
                Fixture::full(&robot_of(names.map(boxy).into()))
            },
            |_| {},
        ),
    ]
}

/// MSH007 to MSH012, except MSH010.
fn links() -> Vec<Case> {
    let collision_only = || {
        let mut links = vec![link("a"), link("b")];
        for link in &mut links {
            link.collision.push(collision(None, cuboid([0.1, 0.1, 0.2])));
        }
        Fixture::full(&robot_of(links))
    };
    let cylinder = |radius: f64, length: f64| Geometry::Cylinder(Cylinder { radius, length });
    // A link "b" that has this geometry, in a URDD without a mesh of it.
    let unseen = |geometry: Geometry| {
        let shown = Link { visual: vec![visual(None, geometry)], ..link("b") };
        let without = robot_of(vec![boxy("a"), link("b")]);
        with_urdf_of(&without, &robot_of(vec![boxy("a"), shown]))
    };
    vec![
        changed(MSH008, "collision-only", false, collision_only, |_| {}),
        changed(MSH011, "box-without-mesh", true, move || unseen(cuboid([0.1; 3])), |_| {}),
        changed(
            MSH011,
            "mesh-of-nothing",
            true,
            || {
                let with = robot_of(vec![boxy("a"), boxy("b")]);
                with_urdf_of(&with, &robot_of(vec![boxy("a"), link("b")]))
            },
            |_| {},
        ),
        changed(
            MSH011,
            "sphere-of-no-size",
            false,
            move || unseen(Geometry::Sphere(Sphere { radius: 0.0 })),
            |_| {},
        ),
        // A disk.
        changed(MSH011, "disk-without-mesh", true, move || unseen(cylinder(0.1, 0.0)), |_| {}),
        changed(
            MSH011,
            "capsule-without-length-and-mesh",
            true,
            move || unseen(Geometry::Capsule(Capsule { radius: 0.1, length: 0.0 })),
            |_| {},
        ),
        changed(
            MSH011,
            "cylinder-of-negative-length",
            false,
            move || unseen(cylinder(0.1, -0.1)),
            |_| {},
        ),
        changed(MSH011, "box-of-one-side", false, move || unseen(cuboid([0.1, 0.0, 0.0])), |_| {}),
        changed(
            MSH011,
            "box-of-a-negative-side",
            false,
            move || unseen(cuboid([0.1, 0.1, -0.1])),
            |_| {},
        ),
        changed(
            MSH011,
            "flat-box-without-mesh",
            true,
            move || unseen(cuboid([0.1, 0.0, 0.1])),
            |_| {},
        ),
        changed(MSH011, "cylinder-of-no-radius", false, move || unseen(cylinder(0.0, 0.1)), |_| {}),
        changed(MSH011, "carried-file-without-a-surface", false, crate::mesh_files::bare, |_| {}),
        changed(
            MSH012,
            "one-file-for-all",
            false,
            || {
                let mut robot = robot_of(vec![link("a"), link("b"), link("c")]);
                robot.meshes.insert("m/part.stl".to_owned(), [0.1; 3]);
                for link in &mut robot.urdf.links {
                    link.visual.push(visual(None, mesh("m/part.stl", None)));
                }
                Fixture::full(&robot)
            },
            |_| {},
        ),
    ]
}

/// Removes the STL and OBJ files of a module.
fn without_formats(f: &mut Fixture, module: &str) {
    fn clear(value: &mut Value, paths: &mut Vec<String>) {
        match value {
            Value::Object(object) => {
                for (key, value) in object {
                    match (key.as_str(), &value) {
                        ("stl" | "obj", Value::String(path)) => {
                            paths.push(path.clone());
                            *value = Value::Null;
                        }
                        _ => clear(value, paths),
                    }
                }
            }
            Value::Array(list) => list.iter_mut().for_each(|value| clear(value, paths)),
            _ => {}
        }
    }
    let mut paths = Vec::new();
    clear(f.doc_mut(module), &mut paths);
    assert!(!paths.is_empty());
    for path in paths {
        f.remove_file(&path);
        f.unlist(&path);
    }
}
