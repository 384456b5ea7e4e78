//! MSH.

use serde_json::{Value, json};
use urdd_format::urdf::{Geometry, Joint, JointType, Link, Sphere};
use urdd_validate::code::Code::*;

use crate::legacy_robot::{GLB, LegacyRobot, STL};
use crate::{Case, changed, in_folder, invalid, near_miss};
use testkit::fixture::{Fixture, ROOT, URDF};
use testkit::robot::*;

pub const ORIGINAL: &str = "original_meshes_module";
pub const PLAIN: &str = "plain_meshes_module";
pub const HULLS: &str = "convex_hull_meshes_module";
pub const PIECES: &str = "convex_decomposition_meshes_module";
const APPROXIMATIONS: &str = "link_shapes_approximations_module";

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

/// Adds a chunk that GLB readers ignore.
fn with_chunk(glb: &[u8]) -> Vec<u8> {
    let mut glb = glb.to_vec();
    glb.extend([4, 0, 0, 0]);
    glb.extend(b"XTRA");
    glb.extend([0; 4]);
    let length = (glb.len() as u32).to_le_bytes();
    glb[8..12].copy_from_slice(&length);
    glb
}

pub fn legacy(
    code: urdd_validate::code::Code,
    name: &'static str,
    caught: bool,
    make: impl Fn() -> LegacyRobot + 'static,
) -> Case {
    in_folder(code, name, caught, move |root| make().write(root))
}

pub fn cases() -> Vec<Case> {
    let mut cases = files();
    cases.extend(links());
    cases
}

/// MSH001 to MSH006, MSH010.
fn files() -> Vec<Case> {
    vec![
        invalid(MSH001, "hull-list-short", |f| {
            f.remove(HULLS, "/link_hulls/14");
        }),
        legacy(MSH001, "stl-list-long", true, || {
            let mut robot = LegacyRobot::new("robot", 0.0);
            let list = robot.doc(PLAIN)[STL].as_array_mut();
            list.expect("a list").push(Value::Null);
            robot
        }),
        changed(MSH001, "one-link", false, || Fixture::full(&robot_of(vec![boxy("a")])), |_| {}),
        invalid(MSH002, "gone-and-not-listed", |f| {
            let path = text(f, HULLS, "/link_hulls/1/obj");
            f.remove_file(&path);
            f.unlist(&path);
        }),
        invalid(MSH002, "side-file-named-wrongly", |f| {
            let old = text(f, ORIGINAL, "/files/0/side_files/0");
            f.set(ORIGINAL, "/files/0/side_files/0", json!(old + ".bak"));
        }),
        in_folder(MSH002, "sibling-gone", true, |root| {
            LegacyRobot::new("arm", 0.0).write(root);
            let sibling = root.parent().expect("a folder above").join("arm");
            std::fs::remove_dir_all(sibling).expect("the sibling");
        }),
        in_folder(MSH002, "gone-in-sibling", true, |root| {
            LegacyRobot::new("arm", 0.0).write(root);
            let sibling = root.parent().expect("a folder above").join("arm");
            let file = "mesh_modules/plain_meshes_module/meshes/obj/finger.obj";
            std::fs::remove_file(sibling.join(file)).expect("a file");
        }),
        legacy(MSH002, "in-sibling", false, || LegacyRobot::new("arm", 0.0)),
        invalid(MSH003, "obj-for-stl", |f| {
            let obj = text(f, HULLS, "/link_hulls/1/obj");
            f.set(HULLS, "/link_hulls/1/stl", json!(obj));
        }),
        invalid(MSH003, "one-mesh-without-stl", |f| {
            let path = text(f, HULLS, "/link_hulls/1/stl");
            f.set(HULLS, "/link_hulls/1/stl", Value::Null);
            f.remove_file(&path);
            f.unlist(&path);
        }),
        near_miss(MSH003, "glb-alone", |f| {
            for module in [PLAIN, HULLS, PIECES] {
                without_formats(f, module);
            }
        }),
        legacy(MSH003, "not-in-every-format", true, || {
            let mut robot = LegacyRobot::new("robot", 0.0);
            robot.doc(PLAIN)[GLB][1] = Value::Null;
            robot
        }),
        legacy(MSH003, "upper-case", false, || {
            let mut robot = LegacyRobot::new("robot", 0.0);
            for at in [0, 1] {
                robot.doc(PLAIN)[STL][at] = json!("robot/mesh_modules/finger.STL");
            }
            robot
        }),
        invalid(MSH004, "box-missing", |f| {
            f.remove(APPROXIMATIONS, "/decomposition_obbs/0/1");
        }),
        // The last piece of a link is missing only from the mesh module: five lists still have it.
        invalid(MSH004, "piece-missing", |f| {
            f.remove(PIECES, "/link_pieces/0/1");
        }),
        // The same mistake makes the names of the remaining ones wrong.
        invalid(MSH004, "first-piece-missing", |f| {
            f.remove(PIECES, "/link_pieces/0/0");
        }),
        near_miss(MSH004, "geometry-class", |f| {
            for module in [
                APPROXIMATIONS,
                "link_shapes_max_distance_from_origin_module",
                "link_shapes_distance_statistics_module",
                "link_shapes_simple_skips_module",
                "link_shapes_skips_module",
            ] {
                f.remove_module(module);
            }
            f.set(ROOT, "/conformance_class", json!("Geometry"));
        }),
        // Two pieces, one, and none.
        changed(
            MSH004,
            "as-many-as-it-takes",
            false,
            || Fixture::full(&robot_of(vec![boxy("a"), boxy("b"), link("c")])),
            |_| {},
        ),
        invalid(MSH005, "another-links-hull", |f| {
            let other = text(f, HULLS, "/link_hulls/0/stl");
            f.set(HULLS, "/link_hulls/1/stl", json!(other));
        }),
        invalid(MSH005, "piece-twice", |f| {
            let piece = f.get(PIECES, "/link_pieces/0/1").clone();
            f.set(PIECES, "/link_pieces/0/-", piece);
        }),
        // With the originals, MSH015 says which of the two has the other's mesh.
        legacy(MSH005, "same-mesh-elsewhere", true, || {
            LegacyRobot::new("robot", 0.25).without_originals()
        }),
        legacy(MSH005, "same-mesh-placed-alike", false, || {
            LegacyRobot::new("robot", 0.0).without_originals()
        }),
        invalid(MSH006, "named-otherwise", |f| {
            let new = "mesh_modules/convex_hull_meshes_module/meshes/stl/1_bass.stl";
            rename(f, HULLS, "/link_hulls/1/stl", new);
        }),
        invalid(MSH006, "in-another-folder", |f| {
            let new = "mesh_modules/convex_decomposition_meshes_module/meshes/glb/1_base.glb";
            rename(f, PIECES, "/link_pieces/1/0/glb", new);
        }),
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
        invalid(MSH010, "json", |f| {
            let path = text(f, HULLS, "/link_hulls/1/glb");
            f.put_file(&path, "{\"asset\": {\"version\": \"2.0\"}}");
        }),
        invalid(MSH010, "cut-off", |f| {
            let path = text(f, PIECES, "/link_pieces/0/1/glb");
            let bytes = f.file(&path).to_vec();
            f.put_file(&path, &bytes[..bytes.len() - 4]);
        }),
        near_miss(MSH010, "chunk-of-another-kind", |f| {
            let path = text(f, HULLS, "/link_hulls/1/glb");
            let bytes = with_chunk(f.file(&path));
            f.put_file(&path, bytes);
        }),
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
    // A link "b" that has this geometry, in a URDD without a mesh of it.
    let unseen = |geometry: Geometry| {
        let shown = Link { visual: vec![visual(None, geometry)], ..link("b") };
        let without = robot_of(vec![boxy("a"), link("b")]);
        with_urdf_of(&without, &robot_of(vec![boxy("a"), shown]))
    };
    vec![
        invalid(MSH007, "hull-missing", |f| {
            f.set(HULLS, "/link_hulls/1", Value::Null);
        }),
        invalid(MSH007, "pieces-missing", |f| {
            f.set(PIECES, "/link_pieces/1", json!([]));
        }),
        invalid(MSH007, "plain-mesh-missing", |f| {
            f.set(PLAIN, "/link_meshes/1", Value::Null);
        }),
        // The names and the geometry are then another link's too.
        invalid(MSH007, "mesh-at-another-link", |f| {
            let mesh = f.get(PLAIN, "/link_meshes/2").clone();
            f.set(PLAIN, "/link_meshes/14", mesh);
            f.set(PLAIN, "/link_meshes/2", Value::Null);
        }),
        invalid(MSH007, "hull-of-another-link", |f| {
            let hull = f.get(HULLS, "/link_hulls/0").clone();
            f.set(HULLS, "/link_hulls/4", hull);
        }),
        changed(MSH007, "no-mesh-at-all", false, without_shapes, |_| {}),
        invalid(MSH008, "said-to-be-collision", |f| {
            f.set(PLAIN, "/link_meshes/1/geometry", json!("Collision"));
        }),
        invalid(MSH008, "collision-only-said-to-be-visual", |f| {
            f.set(PLAIN, "/link_meshes/5/geometry", json!("Visual"));
        }),
        changed(MSH008, "collision-only", false, collision_only, |_| {}),
        invalid(MSH009, "reference-missing", |f| {
            f.remove(ORIGINAL, "/references/1");
        }),
        invalid(MSH009, "another-name", |f| {
            f.set(ORIGINAL, "/references/0/filename", json!("turret.stl"));
        }),
        invalid(MSH009, "visual-said-to-be-collision", |f| {
            f.set(ORIGINAL, "/references/2/geometry", json!("Collision"));
        }),
        legacy(MSH009, "another-links-mesh", true, || {
            let mut robot = LegacyRobot::new("robot", 0.0);
            robot.doc(ORIGINAL)["link_mesh_relative_paths"][1] =
                json!("robot/mesh_modules/palm.dae");
            robot
        }),
        legacy(MSH009, "several-meshes", false, || {
            let mut robot = LegacyRobot::new("robot", 0.0);
            let module = robot.modules.iter_mut().find(|(f, ..)| f.ends_with(ORIGINAL));
            let module = module.expect("the module");
            module.1 = "0.0.2";
            let list = module.2["link_mesh_relative_paths"].clone();
            module.2["link_mesh_relative_paths"] = json!([[list[0]], [list[1]]]);
            robot
        }),
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
        changed(MSH011, "carried-file-without-a-surface", false, crate::mesh_files::bare, |_| {}),
        invalid(MSH012, "file-not-listed", |f| {
            f.set(ORIGINAL, "/references/1/path", json!("nothing.stl"));
        }),
        invalid(MSH012, "mesh-exchanged", |f| {
            let other = f.get(ORIGINAL, "/references/2/path").clone();
            f.set(ORIGINAL, "/references/1/path", other);
        }),
        invalid(MSH012, "side-file-not-named", |f| {
            let files = f.get(ORIGINAL, "/files").as_array().expect("a list");
            let with = files.iter().position(|file| file["side_files"] != json!([]));
            let pointer = format!("/files/{}/side_files/0", with.expect("a side file"));
            f.remove(ORIGINAL, &pointer);
        }),
        invalid(MSH012, "unsorted", |f| {
            let first = f.remove(ORIGINAL, "/files/0");
            f.set(ORIGINAL, "/files/-", first);
        }),
        invalid(MSH012, "listed-twice", |f| {
            let last = f.get(ORIGINAL, "/files/1").clone();
            f.set(ORIGINAL, "/files/-", last);
        }),
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
