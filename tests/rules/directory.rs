mod odd_modules;

use std::path::Path;

use serde_json::json;
use urdd_validate::code::Code::*;

use crate::{Case, in_folder, invalid, legacy, near_miss, toy};
use testkit::fixture::{Fixture, ROOT, URDF};

const VERSION: &str = "dof_module/VERSION";
const YAML: &str = "dof_module/module.yaml";
const EXTENSION: &str = "x_acme_gripper_module";

/// An extension with a schema that allows everything.
pub fn add_extension(f: &mut Fixture) {
    f.put_file(&format!("{EXTENSION}/schema.json"), *b"true\n");
    f.add_module(EXTENSION, json!({"grip": 1}));
}

const SKIPS: &str = "link_shapes_skips_module";

/// As in the draft of the format.
fn set_simple_skips_dependencies(f: &mut Fixture) {
    let modules = f.get(ROOT, "/modules").as_array().expect("a list");
    let name = json!("link_shapes_simple_skips_module");
    let place = modules.iter().position(|module| module["name"] == name);
    let pointer = format!("/modules/{}/depends_on", place.expect("the module"));
    let names = json!(["chain_module", "link_shapes_distance_statistics_module"]);
    set_root(f, &pointer, names);
}

/// Matrices that skip only the diagonal, without edits.
fn unskip_all(f: &mut Fixture) {
    f.set(SKIPS, "/edits", json!([]));
    let document = f.doc_mut(SKIPS).as_object_mut().expect("an object");
    for (key, matrix) in document {
        if !key.ends_with("_skips") {
            continue;
        }
        let rows = matrix.as_array_mut().expect("a matrix").iter_mut();
        for (i, row) in rows.enumerate() {
            let row = row.as_array_mut().expect("a row").iter_mut();
            for (j, element) in row.enumerate() {
                *element = json!(i == j);
            }
        }
    }
}

/// A mesh file that a module names.
fn mesh(f: &Fixture) -> String {
    let inside = "mesh_modules/plain_meshes_module/meshes/stl/";
    let found = f.files.keys().find(|path| path.starts_with(inside));
    found.expect("a mesh").clone()
}

/// Index in `modules`, and in its `files`.
fn place(f: &Fixture, path: &str) -> (usize, usize) {
    let modules = f.get(ROOT, "/modules").as_array().expect("a list");
    let find = |m: usize| {
        let files = modules[m]["files"].as_array()?;
        Some((m, files.iter().position(|file| file["path"] == json!(path))?))
    };
    (0..modules.len()).find_map(find).expect("a listed file")
}

fn set_root(f: &mut Fixture, pointer: &str, value: serde_json::Value) {
    f.set(ROOT, pointer, value);
}

/// The toy, written, and then changed on disk.
fn on_disk(
    code: urdd_validate::code::Code,
    name: &'static str,
    caught: bool,
    change: impl Fn(&Path) + 'static,
) -> Case {
    in_folder(code, name, caught, move |root| {
        toy().write_to(root);
        change(root);
    })
}

fn to_crlf(bytes: &[u8]) -> Vec<u8> {
    let text = String::from_utf8(bytes.to_vec()).expect("UTF-8");
    text.replace('\n', "\r\n").into_bytes()
}

pub fn cases() -> Vec<Case> {
    let mut cases = vec![
        invalid(DIR001, "no-urdd-json", |f| f.remove_file(ROOT)),
        legacy::case(DIR001, "legacy-needs-none", false, |_| {}),
        on_disk(DIR002, "folder-gone", true, |root| {
            std::fs::remove_dir_all(root.join("link_shapes_modules/link_shapes_skips_module"))
                .expect("removed");
        }),
        near_miss(DIR002, "not-listed-and-not-there", |f| {
            f.remove_module("link_shapes_skips_module");
            set_root(f, "/conformance_class", json!("Geometry"));
        }),
        invalid(DIR003, "entry-taken-out", |f| {
            f.remove(ROOT, "/modules/5");
        }),
        invalid(DIR003, "extension-not-listed", |f| {
            add_extension(f);
            f.remove(ROOT, "/modules/15");
        }),
        near_miss(DIR003, "other-folders-in-the-root", |f| {
            f.put_file("docs/readme.md", *b"hello\n");
            f.put_file("x_notes/VERSION", *b"1.0.0");
        }),
        invalid(DIR004, "no-module-json", |f| {
            f.remove_file("kinematics_samples_module/module.json");
        }),
        legacy::case(DIR004, "legacy-version-alone", true, |root| {
            std::fs::create_dir(root.join("bounds_module")).expect("made");
            std::fs::write(root.join("bounds_module/VERSION"), "0.0.1").expect("written");
        }),
        near_miss(DIR004, "all-there", |_| {}),
        invalid(DIR005, "no-version", |f| f.remove_file(VERSION)),
        legacy::case(DIR005, "legacy-no-version", true, |root| {
            std::fs::remove_file(root.join("bounds_module/VERSION")).ok();
            std::fs::remove_file(root.join("urdf_module/VERSION")).expect("removed");
        }),
        legacy::case(DIR005, "legacy-that-never-had-one", false, |root| {
            let document = json!({"name": "robot", "attached_robots": []});
            legacy::write_module(root, "combined_robot_module", None, &document);
        }),
        invalid(DIR006, "two-numbers", |f| f.put_file(VERSION, *b"1.0\n")),
        invalid(DIR006, "two-newlines", |f| f.put_file(VERSION, *b"1.0.0\n\n")),
        invalid(DIR006, "carriage-return", |f| f.put_file(VERSION, *b"1.0.0\r\n")),
        invalid(DIR006, "pre-release", |f| f.put_file(VERSION, *b"1.0.0-rc1")),
        invalid(DIR006, "leading-zero", |f| f.put_file(VERSION, *b"1.00.0")),
        invalid(DIR006, "blank-before", |f| f.put_file(VERSION, *b" 1.0.0")),
        invalid(DIR006, "empty", |f| f.put_file(VERSION, *b"")),
        invalid(DIR006, "too-long", |f| f.put_file(VERSION, vec![b'1'; 5000])),
        near_miss(DIR006, "no-newline", |f| f.put_file(VERSION, *b"1.0.0")),
        invalid(DIR007, "version-file-newer", |f| {
            f.put_file(VERSION, *b"1.1.0\n");
        }),
        invalid(DIR007, "version-file-legacy", |f| {
            f.put_file(VERSION, *b"0.0.2\n");
        }),
        invalid(DIR007, "entry-unknown", |f| {
            f.put_file(VERSION, *b"1.0.0\n");
            set_root(f, "/modules/1/version", json!("7.0.0"));
        }),
        near_miss(DIR007, "newline-in-the-one", |f| {
            f.put_file(VERSION, *b"1.0.0\n");
        }),
        invalid(DIR008, "major-two", |f| set_root(f, "/modules/5/version", json!("2.0.0"))),
        legacy::case(DIR008, "legacy-never-published", true, |root| {
            std::fs::write(root.join("urdf_module/VERSION"), "0.0.2").expect("written");
        }),
        near_miss(DIR008, "extension-has-its-own", |f| {
            add_extension(f);
            set_root(f, "/modules/15/version", json!("7.8.9"));
        }),
        invalid(DIR009, "module-one-one", |f| {
            set_root(f, "/modules/1/version", json!("1.1.0"));
            f.set("dof_module", "/new_key", json!(1));
        }),
        invalid(DIR009, "specification-one-one", |f| {
            set_root(f, "/urdd_version", json!("1.1.0"));
        }),
        near_miss(DIR009, "as-known", |f| set_root(f, "/urdd_version", json!("1.0.0"))),
        invalid(DIR029, "urdf-in-the-root", |f| {
            set_root(f, "/source", json!(null));
        }),
        invalid(DIR029, "named-in-upper-case", |f| {
            let urdf = f.file(URDF).to_vec();
            f.remove_file(URDF);
            f.put_file("ROBOT.URDF", urdf);
            set_root(f, "/source", json!(null));
        }),
        near_miss(DIR029, "no-urdf-in-the-root", |f| {
            let urdf = f.file(URDF).to_vec();
            f.remove_file(URDF);
            f.put_file("notes/robot.urdf", urdf);
            set_root(f, "/source", json!(null));
        }),
        invalid(DIR030, "as-urdd-0-1-0-wrote-it", |f| {
            f.remove(SKIPS, "/skipped_reasons");
            set_simple_skips_dependencies(f);
        }),
        invalid(DIR030, "without-skipped-reasons", |f| {
            f.remove(SKIPS, "/skipped_reasons");
        }),
        invalid(DIR030, "dependencies-of-the-draft", set_simple_skips_dependencies),
        near_miss(DIR030, "nothing-skipped", |f| {
            f.set(SKIPS, "/skipped_reasons", json!([]));
            unskip_all(f);
        }),
        invalid(DIR010, "no-yaml", |f| {
            f.remove_file(YAML);
            f.unlist(YAML);
        }),
        legacy::case(DIR010, "legacy-no-yaml", true, |root| {
            std::fs::remove_file(root.join("urdf_module/module.yaml")).expect("removed");
        }),
        near_miss(DIR010, "all-there", |_| {}),
        invalid(DIR011, "yaml-listed-and-gone", |f| f.remove_file(YAML)),
        invalid(DIR011, "source-gone", |f| f.remove_file(URDF)),
        invalid(DIR011, "path-changed", |f| {
            let (m, i) = place(f, YAML);
            let pointer = format!("/modules/{m}/files/{i}/path");
            set_root(f, &pointer, json!("dof_module/module.yml"));
        }),
        near_miss(DIR011, "listed-besides-what-must-be", |f| {
            f.put_file("dof_module/notes.txt", *b"hello\n");
            f.list("dof_module/notes.txt");
        }),
        invalid(DIR012, "mesh-not-listed", |f| {
            let mesh = mesh(f);
            f.unlist(&mesh);
        }),
        invalid(DIR012, "version-not-listed", |f| f.unlist(VERSION)),
        invalid(DIR012, "file-of-another-module", |f| {
            let (m, i) = place(f, VERSION);
            let pointer = format!("/modules/{m}/files/{i}/path");
            set_root(f, &pointer, json!("chain_module/VERSION"));
        }),
        invalid(DIR012, "schema-of-extension-not-listed", |f| {
            add_extension(f);
            f.unlist(&format!("{EXTENSION}/schema.json"));
        }),
        near_miss(DIR012, "extension-lists-what-it-likes", |f| {
            f.put_file(&format!("{EXTENSION}/data.bin"), *b"\0\x01");
            add_extension(f);
        }),
        invalid(DIR013, "leftover-mesh", |f| {
            let mesh = mesh(f).replace("/stl/", "/stl/99_");
            f.put_file(&mesh, *b"solid\n");
        }),
        near_miss(DIR013, "in-the-root-or-an-extension", |f| {
            f.put_file("LICENSE", *b"MIT\n");
            f.put_file(".gitattributes", *b"* -text\n");
            f.put_file("mesh_modules/README", *b"meshes\n");
            add_extension(f);
            f.put_file(&format!("{EXTENSION}/notes.txt"), *b"hello\n");
        }),
        legacy::case(DIR013, "legacy-files-are-left-alone", false, |root| {
            std::fs::write(root.join("urdf_module/module.ron"), "()").expect("written");
        }),
        invalid(DIR014, "hash-of-another-file", |f| {
            let (m, i) = place(f, YAML);
            f.keep_hash(YAML);
            f.seal();
            let pointer = format!("/modules/{m}/files/{i}/sha256");
            set_root(f, &pointer, json!("0".repeat(64)));
        }),
        invalid(DIR014, "yaml-of-another-size", |f| {
            f.seal();
            f.keep_hash(YAML);
            let yaml = [f.file(YAML), b"\n# a comment\n"].concat();
            f.put_file(YAML, yaml);
        }),
        invalid(DIR014, "line-endings-converted", |f| {
            f.seal();
            f.keep_hashes();
            for path in ["dof_module/module.json", YAML] {
                let bytes = to_crlf(f.file(path));
                f.put_file(path, bytes);
            }
        }),
        invalid(DIR014, "git-lfs-pointer", |f| {
            let pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n";
            f.put_file("dof_module/notes.bin", *b"the notes");
            f.list("dof_module/notes.bin");
            f.seal();
            f.keep_hashes();
            f.put_file("dof_module/notes.bin", pointer);
        }),
        near_miss(DIR014, "crlf-that-is-described", |f| {
            f.seal();
            let bytes = to_crlf(f.file(YAML));
            f.put_file(YAML, bytes);
        }),
        invalid(DIR015, "absolute-source", |f| {
            set_root(f, "/source/Urdf/path", json!("/robot.urdf"));
        }),
        invalid(DIR015, "module-path-up", |f| {
            set_root(f, "/modules/1/path", json!("../robot/dof_module"));
        }),
        invalid(DIR015, "file-with-backslash", |f| {
            let (m, i) = place(f, YAML);
            let pointer = format!("/modules/{m}/files/{i}/path");
            set_root(f, &pointer, json!("dof_module\\module.yaml"));
        }),
        invalid(DIR015, "control-character-of-c1", |f| {
            let (m, i) = place(f, YAML);
            let pointer = format!("/modules/{m}/files/{i}/path");
            set_root(f, &pointer, json!("dof_module/module\u{85}.yaml"));
        }),
        near_miss(DIR015, "odd-but-right", |f| {
            f.put_file("dof_module/ä b..c", *b"hello\n");
            f.list("dof_module/ä b..c");
        }),
        invalid(DIR017, "class-above-the-claim", |f| {
            set_root(f, "/conformance_class", json!("Core"));
            for module in ["link_shapes_skips_module", "link_shapes_simple_skips_module"] {
                f.remove_module(module);
            }
            f.remove_module("link_shapes_distance_statistics_module");
            f.remove_module("link_shapes_max_distance_from_origin_module");
            f.remove_module("link_shapes_approximations_module");
            f.remove_module("original_meshes_module");
        }),
        invalid(DIR017, "extension-of-nothing", |f| {
            add_extension(f);
            set_root(f, "/modules/15/depends_on", json!(["x_acme_other_module"]));
        }),
        near_miss(DIR017, "extension-of-a-module", |f| {
            add_extension(f);
            set_root(f, "/modules/15/depends_on", json!(["dof_module"]));
        }),
        invalid(DIR018, "one-too-few", |f| {
            f.remove(ROOT, "/modules/4/depends_on/0");
        }),
        invalid(DIR018, "one-too-many", |f| {
            set_root(f, "/modules/1/depends_on/-", json!("chain_module"));
        }),
        invalid(DIR018, "unknown", |f| {
            set_root(f, "/modules/1/depends_on/0", json!("urdf_modul"));
        }),
        invalid(DIR018, "twice", |f| {
            set_root(f, "/modules/1/depends_on/-", json!("urdf_module"));
        }),
        near_miss(DIR018, "in-another-order", |f| {
            set_root(f, "/modules/4/depends_on", json!(["dof_module", "urdf_module"]));
        }),
        invalid(DIR019, "shapes-without-skips", |f| {
            f.remove_module("link_shapes_skips_module");
        }),
        invalid(DIR019, "core-without-dofs", |f| f.remove_module("dof_module")),
        near_miss(DIR019, "more-than-claimed", |f| {
            set_root(f, "/conformance_class", json!("Core"));
        }),
        invalid(DIR020, "other-name", |f| set_root(f, "/robot_name", json!("toy"))),
        near_miss(DIR020, "folder-of-another-name", |_| {}),
        invalid(DIR021, "other-name", |f| {
            set_root(f, "/modules/1/name", json!("dofs_module"));
        }),
        invalid(DIR021, "other-path", |f| {
            set_root(f, "/modules/1/path", json!("dofs_module"));
        }),
        invalid(DIR021, "name-of-another-module", |f| {
            set_root(f, "/modules/1/name", json!("chain_module"));
        }),
        invalid(DIR021, "name-of-a-module-with-other-dependencies", |f| {
            set_root(f, "/modules/1/name", json!("bounds_module"));
        }),
        invalid(DIR021, "twice", |f| {
            add_extension(f);
            let entry = f.get(ROOT, "/modules/15").clone();
            set_root(f, "/modules/-", entry);
        }),
        near_miss(DIR021, "extension", add_extension),
        on_disk(DIR022, "not-an-extension", true, |root| {
            std::fs::create_dir(root.join("gripper_module")).expect("made");
            std::fs::write(root.join("gripper_module/module.json"), "not json").expect("written");
        }),
        invalid(DIR022, "capital-letters", |f| {
            f.put_file("x_Acme_gripper_module/VERSION", *b"");
        }),
        near_miss(DIR022, "extension", add_extension),
        legacy::case(DIR022, "known-of-old", false, |root| {
            let document = json!({"done": null});
            let folder = "bevy_modules/first_look_vis_module";
            legacy::write_module(root, folder, Some("0.0.1"), &document);
        }),
        on_disk(DIR023, "folder-in-its-place", true, |root| {
            let file = root.join("dof_module/module.json");
            std::fs::remove_file(&file).expect("removed");
            std::fs::create_dir(&file).expect("made");
        }),
        on_disk(DIR023, "urdd-json-is-a-folder", true, |root| {
            std::fs::remove_file(root.join(ROOT)).expect("removed");
            std::fs::create_dir(root.join(ROOT)).expect("made");
        }),
        near_miss(DIR023, "all-there", |_| {}),
        near_miss(DIR024, "utf8", |f| f.put_file("gerät.txt", *b"hello")),
        invalid(DIR025, "two", |f| set_root(f, "/urdd_version", json!("2.0.0"))),
        invalid(DIR025, "two-with-keys-of-its-own", |f| {
            set_root(f, "/urdd_version", json!("2.0.0"));
            set_root(f, "/new_key", json!(1));
        }),
        near_miss(DIR025, "one", |f| set_root(f, "/urdd_version", json!("1.0.0"))),
        invalid(DIR026, "modules-swapped", |f| {
            let entry = f.remove(ROOT, "/modules/1");
            f.doc_mut(ROOT)["modules"].as_array_mut().expect("a list").insert(2, entry);
        }),
        invalid(DIR026, "file-twice", |f| {
            let entry = f.get(ROOT, "/modules/1/files/2").clone();
            set_root(f, "/modules/1/files/-", entry);
        }),
        invalid(DIR026, "files-swapped", |f| {
            let entry = f.remove(ROOT, "/modules/1/files/0");
            set_root(f, "/modules/1/files/-", entry);
        }),
        near_miss(DIR026, "extensions-by-name", |f| {
            add_extension(f);
            f.put_file("x_acme_zero_module/schema.json", *b"true\n");
            f.add_module("x_acme_zero_module", json!({}));
        }),
        invalid(DIR027, "listed-files", |f| {
            for name in ["data.bin", "Data.bin"] {
                f.put_file(&format!("{EXTENSION}/{name}"), name.as_bytes());
            }
            add_extension(f);
        }),
        invalid(DIR027, "listed-files-beyond-ascii", |f| {
            for name in ["\u{e4}.bin", "\u{c4}.bin"] {
                f.put_file(&format!("{EXTENSION}/{name}"), name.as_bytes());
            }
            add_extension(f);
        }),
        invalid(DIR027, "metadata", |f| f.put_file("URDD.json", *b"{}\n")),
        invalid(DIR027, "module", |f| {
            f.put_file("DOF_module/notes.txt", *b"hello\n");
        }),
        invalid(DIR027, "folder-of-modules", |f| {
            f.put_file("Mesh_Modules/notes.txt", *b"hello\n");
        }),
        near_miss(DIR027, "files-that-are-nobodys-business", |f| {
            f.put_file("README", *b"hello\n");
            f.put_file("readme", *b"hello\n");
        }),
        near_miss(DIR027, "in-other-folders", |f| {
            f.put_file("docs/A.txt", *b"hello\n");
            f.put_file(&format!("{EXTENSION}/a.txt"), *b"hello\n");
            add_extension(f);
        }),
        invalid(DIR028, "in-a-folder", |f| {
            let urdf = f.file(URDF).to_vec();
            f.remove_file(URDF);
            f.put_file("source/robot.urdf", urdf);
            set_root(f, "/source/Urdf/path", json!("source/robot.urdf"));
        }),
        near_miss(DIR028, "under-any-name", |f| {
            let urdf = f.file(URDF).to_vec();
            f.remove_file(URDF);
            f.put_file("Some robot.xml", urdf);
            set_root(f, "/source/Urdf/path", json!("Some robot.xml"));
        }),
    ];
    cases.extend(odd_modules::cases());
    #[cfg(unix)]
    cases.extend(unix_cases());
    #[cfg(unix)]
    cases.extend(odd_modules::links());
    cases
}

#[cfg(unix)]
fn unix_cases() -> Vec<Case> {
    use std::os::unix::ffi::OsStrExt;
    use std::os::unix::fs::symlink;

    let link = |file: &'static str, target: &'static str| {
        move |root: &Path| {
            let path = root.join(file);
            let outside = root.parent().expect("a parent").join(target);
            std::fs::copy(&path, &outside).expect("copied");
            std::fs::remove_file(&path).expect("removed");
            let up = "../".repeat(file.split('/').count());
            symlink(up + target, &path).expect("a link");
        }
    };
    vec![
        on_disk(DIR016, "document-outside", true, link("dof_module/module.json", "out")),
        on_disk(DIR016, "mirror-outside", true, link(YAML, "out")),
        on_disk(DIR016, "source-outside", true, link(URDF, "out")),
        on_disk(DIR016, "module-folder-outside", true, |root| {
            let folder = root.join("link_shapes_modules/link_shapes_skips_module");
            let outside = root.parent().expect("a parent").join("out");
            std::fs::rename(&folder, &outside).expect("moved");
            symlink("../../out", &folder).expect("a link");
        }),
        on_disk(DIR016, "link-to-itself-inside", false, |root| {
            symlink("loop", root.join("loop")).expect("a link");
            symlink(".", root.join("here")).expect("a link");
        }),
        on_disk(DIR016, "nobodys-business", false, |root| {
            symlink("/etc/hostname", root.join("NOTES")).expect("a link");
        }),
        on_disk(DIR016, "link-inside", false, |root| {
            let file = root.join(YAML);
            std::fs::rename(&file, root.join("elsewhere")).expect("moved");
            symlink("../elsewhere", &file).expect("a link");
        }),
        legacy::case(DIR016, "legacy-document-outside", true, |root| {
            let file = root.join("dof_module/module.yaml");
            let outside = root.parent().expect("a parent").join("out");
            std::fs::rename(&file, &outside).expect("moved");
            symlink("../../out", &file).expect("a link");
        }),
        on_disk(DIR024, "latin-1", true, |root| {
            let name = std::ffi::OsStr::from_bytes(b"dof_module/ger\xE4t.txt");
            std::fs::write(root.join(name), "hello").expect("written");
        }),
    ]
}
