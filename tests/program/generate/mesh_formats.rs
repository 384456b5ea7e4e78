//! `--mesh-formats`: the files of each derived mesh.

use std::path::Path;

use crate::generate::{bytes_below, findings_of, read_json, urdd};

/// The extensions of the files of derived meshes, with the number of each.
fn extensions(urdd: &Path) -> [usize; 3] {
    let files = bytes_below(urdd);
    ["glb", "stl", "obj"].map(|extension| {
        let derived = files.keys().filter(|path| {
            path.starts_with("mesh_modules/")
                && !path.contains("original")
                && path.ends_with(&format!(".{extension}"))
        });
        derived.count()
    })
}

fn generate(target: &Path, more: &[&str]) {
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/robots/gripper.urdf");
    let robot = robot.to_str().unwrap();
    let mut arguments = vec!["generate", robot, "-o", target.to_str().unwrap()];
    arguments.extend(["--samples", "10", "--modules", "geometry"]);
    arguments.extend(more);
    let output = urdd(&arguments).output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
}

#[test]
fn those_asked_for_are_made_and_a_glb_always() {
    let folder = testkit::temporary::folder();
    let target = folder.path().join("gripper");
    generate(&target, &[]);
    let [glb, stl, obj] = extensions(&target);
    assert!(glb > 3 && stl == glb && obj == glb, "{glb} {stl} {obj}");

    // Replaced: no file of a format that is not requested remains.
    generate(&target, &["--mesh-formats", "glb"]);
    assert_eq!(extensions(&target), [glb, 0, 0]);
    assert_eq!(findings_of(&target), []);
    for (module, mesh) in [
        ("plain_meshes_module", "/link_meshes/0/files"),
        ("convex_hull_meshes_module", "/link_hulls/0"),
        ("convex_decomposition_meshes_module", "/link_pieces/0/0"),
    ] {
        let path = format!("mesh_modules/{module}/module.json");
        let module = read_json(&target.join(path));
        let files = module.pointer(mesh).unwrap();
        assert!(files["stl"].is_null() && files["obj"].is_null(), "{files}");
        assert!(files["glb"].is_string(), "{files}");
    }

    generate(&target, &["--mesh-formats", "stl"]);
    assert_eq!(extensions(&target), [glb, stl, 0]);
    assert_eq!(findings_of(&target), []);

    generate(&target, &[]);
    assert_eq!(extensions(&target), [glb, stl, obj]);
    assert_eq!(findings_of(&target), []);
}
