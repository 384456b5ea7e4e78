//! What is in the meshes of the bases.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock, Mutex};

use urdd_programs::{Fault, File, Mesh, MeshFacts, Program};
use urdd_xml::{Counted, Kind};

use crate::table::folder;

/// Files that were read, by their paths and the names that they were asked by.
static READ: LazyLock<Mutex<HashMap<(PathBuf, String), Mesh>>> = LazyLock::new(Mutex::default);

/// The mesh that a base, `file`, names, where a program looks for it: the table was made with the base's folder beside the
/// file, `packages/` in `base/`, and packages in the latter.
pub fn find(program: Program, file: &str, name: &str) -> Mesh {
    let packages = folder().join("base/packages");
    let base = folder().join("base").join(file);
    let base = base.parent().unwrap_or(Path::new(""));
    let (scheme, rest) = match name.split_once("://") {
        Some((scheme, rest)) => (scheme, rest),
        None => ("", name),
    };
    let in_any =
        |rest: &str| [base, &packages].map(|folder| folder.join(rest.trim_start_matches('/')));
    let places: Vec<PathBuf> = match (program.id(), scheme) {
        // Programs were given the files in a folder of another name.
        (_, "") if rest.starts_with("../base/") => Vec::new(),
        // What is no scheme is a name, relative ones in the folders of packages too.
        ("pinocchio", "") if !rest.starts_with('/') => in_any(rest).into(),
        ("pinocchio", "package" | "model") => in_any(rest).into(),
        (_, "package" | "model") => vec![packages.join(rest)],
        ("usd", "file") => vec![base.join(rest)],
        (_, "file") => vec![rest.into()],
        // A person puts all meshes together for it.
        ("mujoco33", _) => vec![base.join(name), base.join("together").join(name)],
        _ => vec![base.join(name)],
    };
    // `base/` had another name there.
    if name.contains("../base/") {
        return Mesh::Missing;
    }
    let Some(path) = places.into_iter().find(|path| path.exists()) else { return Mesh::Missing };
    let mut read = READ.lock().unwrap();
    let mesh = read.entry((path, name.to_owned())).or_insert_with_key(|(path, _)| {
        let bytes = fs::read(path).unwrap_or_default();
        Mesh::Found(Arc::new(MeshFacts::of(name, &bytes)))
    });
    mesh.clone()
}

/// White space at the beginning is tried in Pinocchio 4.1.0, PyBullet 3.2.7 and pycollada 0.9.3 (of urdf-usd-converter) with a
/// mesh of Doosan's H2017; what follows the root in Pinocchio and PyBullet.
#[test]
fn what_is_around_a_collada_mesh_loses_it_to_strict_readers() {
    let dae = "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\">\
        <asset/><library_geometries><geometry id=\"g\"><mesh>\
        <triangles count=\"1\"><p>0 1 2</p></triangles></mesh></geometry></library_geometries>\
        <library_visual_scenes><visual_scene id=\"s\"><node><instance_geometry url=\"#g\"/></node>\
        </visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
    let robot = r#"<robot name="r"><link name="a"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0"
        iyy="1" iyz="0" izz="1"/></inertial><visual><geometry><mesh filename="a.dae"/></geometry></visual></link></robot>"#;
    let losing = |mesh: &str| {
        let mesh = Mesh::Found(Arc::new(MeshFacts::of("a.dae", mesh.as_bytes())));
        let find = |_: &str| mesh.clone();
        let loses = |program: &Program| {
            let counted = Counted::new(robot.as_bytes(), Kind::Robot).unwrap();
            let effects = program.read(&File::new(counted, &find));
            effects.kept().iter().any(|effect| matches!(effect.fault, Fault::Mesh(_)))
        };
        let mut all: Vec<&str> =
            Program::ALL.iter().filter(|one| loses(one)).map(|one| one.id()).collect();
        all.sort_unstable();
        all
    };
    assert_eq!(losing(dae), [""; 0]);
    assert_eq!(losing(&format!("\n  {dae}")), ["urdf_loader", "usd"]);
    for more in ["<a/>", "\0\0\n</scene></COLLADA>", "\0"] {
        assert_eq!(losing(&format!("{dae}\n{more}")), ["urdf_loader", "usd"], "{more}");
    }
    let all_but_assimp = ["pybullet", "urdf_loader", "usd"];
    assert_eq!(losing(&format!("{dae}\nsome text")), all_but_assimp);
    // What is cut off, or is not closed, nobody reads.
    let all = ["pinocchio", "pybullet", "urdf_loader", "usd"];
    assert_eq!(losing(&format!("{dae}\n<a><b>")), all);
    assert_eq!(losing(&dae[..dae.len() - 20]), all);
}
