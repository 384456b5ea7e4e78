//! Every published `module.json` that we have a copy of is read by the registry.

use std::path::{Path, PathBuf};

use serde_json::Value;
use urdd_format::registry::{self, ModuleKind, Profile};

fn corpus() -> PathBuf {
    std::env::var_os("URDD_CORPUS").map_or_else(|| PathBuf::from("../shared/corpus"), PathBuf::from)
}

fn module_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            module_files(&path, found);
        } else if path.ends_with("module.json") {
            found.push(path);
        }
    }
}

#[test]
#[ignore = "needs ../shared/corpus"]
fn reads_every_published_module() {
    let mut files = Vec::new();
    module_files(&corpus(), &mut files);
    files.sort();
    for file in &files {
        let folder = file.parent().unwrap();
        let kind = ModuleKind::ALL
            .iter()
            .find(|kind| folder.ends_with(kind.folder()))
            .unwrap_or_else(|| panic!("{}: no such module", folder.display()));
        let version = std::fs::read_to_string(folder.join("VERSION")).unwrap_or_default();
        let spec = registry::find(*kind, version.trim_end())
            .unwrap_or_else(|| panic!("{}: no version {version}", folder.display()));
        assert_eq!(spec.profile, Profile::Legacy);

        let text = std::fs::read_to_string(file).unwrap();
        let value: Value = serde_json::from_str(&text).unwrap();
        let document = spec.read(&value).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        let written = serde_json::to_value(&document).unwrap();
        assert_eq!(spec.read(&written).unwrap(), document, "{}", file.display());

        let schema = jsonschema::draft202012::new(spec.schema().as_value()).unwrap();
        if let Err(error) = schema.validate(&value) {
            panic!("{}: {error}", file.display());
        }
    }
    assert!(files.len() > 60, "only {} documents", files.len());
}

/// The numbers of a legacy robot are those of a URDD generated from the same URDF.
#[test]
#[ignore = "needs the published URDDs"]
fn legacy_robots_move_as_their_urdfs_do() {
    use urdd_robot::{Queries, Robot, ShapeKind};
    for name in ["ur5", "z1", "robotiq_140"] {
        let folder = corpus().join(name);
        let legacy = Robot::open(&folder).unwrap();
        let made = testkit::temporary::folder();
        let settings = urdd_generate::Settings {
            selection: urdd_generate::Selection::parse(["core"]).unwrap(),
            ..urdd_generate::Settings::default()
        };
        let (urdf, target) = (folder.join(format!("{name}.urdf")), made.path().join(name));
        urdd_generate::generate(&urdf, &target, &settings, &()).unwrap();
        let now = Robot::open(target).unwrap();
        let q = now.configurations().unwrap().random(2);
        assert_eq!(legacy.dof_names().unwrap().len(), q.len(), "{name}");
        let poses = [&legacy, &now].map(|robot| robot.link_poses(&q).unwrap());
        for (link, pose) in now.link_names().unwrap().iter().zip(&poses[1]) {
            let other = &poses[0][legacy.link(link).unwrap()];
            let apart = (pose.translation.vector - other.translation.vector).norm();
            assert!(apart < 1e-9, "{name}: {link} is {apart} m off");
            assert!(pose.rotation.angle_to(&other.rotation) < 1e-7, "{name}: {link}");
        }
        let proximity = legacy.proximity(ShapeKind::Hulls).unwrap();
        assert!(proximity.num_pairs() > 0, "{name}");
        assert_eq!(proximity.closest_points(&q).unwrap().len(), proximity.num_pairs());
    }
}
