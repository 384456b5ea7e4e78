//! The validator as a whole: one file of a small URDD is changed.

use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;

use tempfile::TempDir;
use urdd_format::report::Status;
use urdd_generate::{Settings as Generation, generate};
use urdd_validate::report;
use urdd_validate::settings::Settings;
use urdd_validate::validate;

/// Two moving joints, one of them a mimic, and a shape for each link: every rule has something to check, in little
/// time.
const ROBOT: &str = r#"<robot name="r">
<link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
<link name="b"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="0 0 1"/><geometry><box size="1 2 3"/></geometry></collision></link>
<link name="c"><visual><geometry><box size=".1 .1 .1"/></geometry></visual></link>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="2 0 0" rpy="0 1 0"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<joint name="k" type="prismatic"><parent link="b"/><child link="c"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
<mimic joint="j" multiplier="0.5"/></joint>
</robot>"#;

/// The files that are changed. The first byte of an input selects the file, and whether all of it is replaced or a
/// piece. For a piece, two bytes give its start, and one its length.
const FILES: &[&str] = &[
    "urdd.json",
    "robot.urdf",
    "urdf_module/VERSION",
    "urdf_module/module.json",
    "urdf_module/module.yaml",
    "dof_module/module.json",
    "chain_module/module.json",
    "connections_module/module.json",
    "bounds_module/module.json",
    "kinematics_samples_module/module.json",
    "mesh_modules/original_meshes_module/module.json",
    "mesh_modules/plain_meshes_module/module.json",
    "mesh_modules/plain_meshes_module/meshes/stl/0_a.stl",
    "mesh_modules/plain_meshes_module/meshes/obj/0_a.obj",
    "mesh_modules/plain_meshes_module/meshes/glb/0_a.glb",
    "mesh_modules/convex_hull_meshes_module/module.json",
    "mesh_modules/convex_decomposition_meshes_module/module.json",
    "link_shapes_modules/link_shapes_approximations_module/module.json",
    "link_shapes_modules/link_shapes_max_distance_from_origin_module/module.json",
    "link_shapes_modules/link_shapes_distance_statistics_module/module.json",
    "link_shapes_modules/link_shapes_simple_skips_module/module.json",
    "link_shapes_modules/link_shapes_skips_module/module.json",
    "x_fuzz_extension_module/schema.json",
    "x_fuzz_extension_module/module.json",
];

/// The bit of the first byte that selects replacing a piece.
const PIECE: u8 = 0x80;

struct Small {
    folder: TempDir,
    /// The content of the files that exist.
    contents: Vec<Option<Vec<u8>>>,
}

impl Small {
    fn path(&self, file: &str) -> PathBuf {
        self.folder.path().join("r").join(file)
    }
}

static SMALL: LazyLock<Small> = LazyLock::new(|| {
    let folder = testkit::temporary::folder();
    let source = folder.path().join("robot.urdf");
    fs::write(&source, ROBOT).expect("the robot");
    generate(&source, &folder.path().join("r"), &Generation::default(), &()).expect("its URDD");
    let mut small = Small { folder, contents: Vec::new() };
    let extension = small.path("x_fuzz_extension_module");
    fs::create_dir(&extension).expect("a folder");
    fs::write(extension.join("VERSION"), "1.0.0").expect("a version");
    fs::write(extension.join("schema.json"), r#"{"type": "object"}"#).expect("a schema");
    fs::write(extension.join("module.json"), "{}").expect("a document");
    small.contents = FILES.iter().map(|file| fs::read(small.path(file)).ok()).collect();
    small
});

/// No rule crashes, and the report can be written.
///
/// # Panics
/// If that is not so; also if two threads try at once, since there is one URDD.
pub fn urdd(bytes: &[u8]) {
    let Some((choice, content)) = bytes.split_first() else {
        return;
    };
    let small = &*SMALL;
    let at = usize::from(choice & !PIECE) % FILES.len();
    let path = small.path(FILES[at]);
    let changed = match (choice & PIECE, small.contents[at].as_deref()) {
        (PIECE, Some(whole)) => spliced(whole, content),
        _ => content.to_owned(),
    };
    fs::write(&path, changed).expect("the file is changed");
    let run = validate(&[small.path("")], &Settings::default()).expect("a URDD is there");
    match &small.contents[at] {
        Some(content) => fs::write(&path, content).expect("the file is put back"),
        None => fs::remove_file(&path).expect("the file is removed"),
    }
    for check in run.report.urdds.iter().flat_map(|urdd| &urdd.checks) {
        let crashed = check.status == Status::Crashed;
        assert!(!crashed, "{}: {:?}", check.code, check.reason);
    }
    report::json(&run.report).expect("a report");
}

/// A file with a piece of it replaced.
fn spliced(whole: &[u8], edit: &[u8]) -> Vec<u8> {
    let (place, piece) = edit.split_at(edit.len().min(3));
    let byte = |at: usize| usize::from(place.get(at).copied().unwrap_or_default());
    let start = (byte(0) + 256 * byte(1)) % (whole.len() + 1);
    let end = (start + byte(2)).min(whole.len());
    [&whole[..start], piece, &whole[end..]].concat()
}
