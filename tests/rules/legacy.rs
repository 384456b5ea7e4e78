use std::path::Path;

use serde_json::{Value, json};
use urdd_directory::canonical;
use urdd_validate::code::Code::{self, *};

use crate::legacy_robot::{GLB, LegacyRobot, OBJ, STL};
use crate::{Case, in_folder};

const MESH: &str = "mesh_modules/original_meshes_module/meshes/a.stl";

/// Writes a module as the first producers did: minified JSON, and the same in YAML.
pub fn write_module(root: &Path, folder: &str, version: Option<&str>, document: &Value) {
    let folder = root.join(folder);
    std::fs::create_dir_all(&folder).expect("made");
    let write = |name: &str, bytes: &[u8]| {
        std::fs::write(folder.join(name), bytes).expect("written");
    };
    write("module.json", document.to_string().as_bytes());
    write("module.yaml", canonical::yaml_string(document).as_bytes());
    if let Some(version) = version {
        write("VERSION", version.as_bytes());
    }
}

fn link(name: &str, visual: Value) -> Value {
    json!({
        "name": name,
        "inertial": {
            "origin": {"xyz": [0.0, 0.0, 0.0], "rpy": [0.0, 0.0, 0.0]},
            "mass": {"value": 0.0},
            "inertia": {"ixx": 0.0, "ixy": 0.0, "ixz": 0.0, "iyy": 0.0, "iyz": 0.0, "izz": 0.0},
        },
        "visual": visual, "collision": [],
    })
}

/// A URDD from before version 1, whose robot has the name of its folder: two links, one joint, no meshes.
pub fn write_legacy(root: &Path) {
    let urdf = json!({
        "name": "robot",
        "links": [link("base", json!([])), link("arm", json!([]))],
        "joints": [{
            "name": "shoulder", "joint_type": "Revolute",
            "origin": {"xyz": [0.0, 0.0, 0.5], "rpy": [0.0, 0.0, 0.0]},
            "parent": {"link": "base"}, "child": {"link": "arm"},
            "axis": {"xyz": [0.0, 0.0, 1.0]},
            "limit": {"lower": -1.0, "upper": 1.0, "effort": 1.0, "velocity": 1.0},
            "dynamics": null, "mimic": null, "safety_controller": null,
        }],
        "materials": [],
    });
    let dof = json!({
        "num_dofs": 1, "dof_idx_to_joint_idx_mapping": [0], "joint_idx_to_dof_idxs_mapping": [[0]],
    });
    write_module(root, "urdf_module", Some("0.0.3"), &urdf);
    write_module(root, "dof_module", Some("0.0.2"), &dof);
}

/// A URDD from before version 1, with one change.
pub fn case(
    code: Code,
    name: &'static str,
    caught: bool,
    change: impl Fn(&Path) + 'static,
) -> Case {
    in_folder(code, name, caught, move |root| {
        write_legacy(root);
        change(root);
    })
}

fn change_urdf(root: &Path, change: impl Fn(&mut Value)) {
    let text = std::fs::read(root.join("urdf_module/module.json")).expect("read");
    let mut document = serde_json::from_slice(&text).expect("JSON");
    change(&mut document);
    write_module(root, "urdf_module", Some("0.0.3"), &document);
}

fn write_mesh(root: &Path, name_in_path: &str, file: &Path) {
    let visual = json!([{
        "name": null, "origin": {"xyz": [0.0, 0.0, 0.0], "rpy": [0.0, 0.0, 0.0]},
        "geometry": {"Mesh": {"filename": "package://toy/a.stl", "scale": null}},
        "material": null,
    }]);
    change_urdf(root, |urdf| urdf["links"][0] = link("base", visual.clone()));
    let paths = json!([format!("{name_in_path}/{MESH}"), null]);
    let document = json!({"link_mesh_relative_paths": paths});
    let folder = "mesh_modules/original_meshes_module";
    write_module(root, folder, Some("0.0.1"), &document);
    std::fs::create_dir_all(file.parent().expect("a folder")).expect("made");
    // One triangle in binary STL.
    let mut stl = vec![0; 84 + 50];
    stl[80] = 1;
    for (vertex, coordinate) in [(1, 0), (2, 1)] {
        let at = 84 + 12 + vertex * 12 + coordinate * 4;
        stl[at..at + 4].copy_from_slice(&1.0_f32.to_le_bytes());
    }
    std::fs::write(file, stl).expect("written");
}

pub fn cases() -> Vec<Case> {
    vec![
        case(LEG001, "as-they-were", true, |_| {}),
        crate::near_miss(LEG001, "version-1", |_| {}),
        case(LEG002, "own-folder", true, |root| {
            write_mesh(root, "robot", &root.join(MESH));
        }),
        case(LEG002, "sibling", true, |root| {
            let sibling = root.parent().expect("a parent").join("other");
            write_legacy(&sibling);
            write_mesh(root, "other", &sibling.join(MESH));
        }),
        case(LEG002, "no-meshes", false, |_| {}),
        case(LEG003, "other-name", true, |root| {
            change_urdf(root, |urdf| urdf["name"] = json!("robot_description"));
        }),
        case(LEG003, "same-name", false, |_| {}),
        // SPEC 10.7: shapes count, as in version 1.
        in_folder(MSH011, "legacy-box-without-a-mesh", true, |root| {
            let mut robot = LegacyRobot::new("robot", 0.0);
            let visual = &mut robot.doc("urdf_module")["links"][1]["visual"][0];
            visual["geometry"] = json!({"Box": {"size": [0.1, 0.1, 0.1]}});
            robot.doc("original_meshes_module")["link_mesh_relative_paths"][1] = Value::Null;
            for list in [STL, OBJ, GLB] {
                robot.doc("plain_meshes_module")[list][1] = Value::Null;
                robot.doc("convex_hull_meshes_module")[list][1] = Value::Null;
                robot.doc("convex_decomposition_meshes_module")[list][1] = json!([]);
            }
            robot.write(root);
        }),
        in_folder(LEG007, "same-mesh-placed-alike", true, |root| {
            LegacyRobot::new("robot", 0.0).write(root);
        }),
        case(LEG007, "no-meshes", false, |_| {}),
    ]
}
