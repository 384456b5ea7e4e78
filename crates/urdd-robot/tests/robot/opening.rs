use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use std::sync::{Arc, Mutex};

use urdd_directory::listing::Listing;
use urdd_directory::listing::ReadError;
use urdd_directory::source::{Disk, Memory, OpenFile, Source};
use urdd_robot::{Queries, Robot, RobotError, ShapeKind};

use testkit::robots::{made, our_robots};

/// The files of a URDD, as a source in memory takes them.
fn files(root: &Path) -> BTreeMap<String, Arc<[u8]>> {
    let files = testkit::files::below(root).into_iter();
    files.map(|(path, bytes)| (path, bytes.into())).collect()
}

#[test]
fn folder_zip_and_memory_are_the_same_robot() {
    let (folder, path) = made(&our_robots()[8].1);
    let zip = folder.path().join("robot.zip");
    let mut writer = zip::ZipWriter::new(std::fs::File::create(&zip).unwrap());
    for (name, bytes) in files(&path) {
        writer.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
        writer.write_all(&bytes).unwrap();
    }
    writer.finish().unwrap();
    let robots = [
        Robot::open(&path).unwrap(),
        Robot::open(&zip).unwrap(),
        Robot::of(Memory::new("robot", files(&path)).unwrap()),
    ];
    let asked = robots.each_ref().map(|robot| {
        let q = robot.configurations().unwrap().random(3);
        let proximity = robot.proximity(ShapeKind::Pieces).unwrap();
        (robot.link_poses(&q).unwrap(), proximity.closest_points(&q).unwrap())
    });
    assert!(!asked[0].1.is_empty());
    assert_eq!(asked[0], asked[1]);
    assert_eq!(asked[0], asked[2]);
}

/// A folder that records which files were opened.
#[derive(Debug)]
struct Watched {
    disk: Disk,
    opened: Arc<Mutex<Vec<String>>>,
}

impl Source for Watched {
    fn folder_name(&self) -> String {
        self.disk.folder_name()
    }
    fn list(&self) -> Result<Listing, ReadError> {
        self.disk.list()
    }
    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        self.opened.lock().unwrap().push(path.to_owned());
        self.disk.open(path)
    }
}

#[test]
fn only_what_is_asked_for_is_read() {
    let (_folder, path) = made(&our_robots()[8].1);
    let opened = Arc::new(Mutex::new(Vec::new()));
    let watched = Watched { disk: Disk::open(&path).unwrap(), opened: Arc::clone(&opened) };
    let robot = Robot::of(watched);
    let modules = |suffix: &str| -> Vec<String> {
        let mut opened = opened.lock().unwrap().clone();
        opened.retain(|path| path.ends_with(suffix));
        opened.sort();
        opened
    };
    assert_eq!(modules(""), [""; 0]);
    robot.link("base").unwrap();
    assert_eq!(modules("module.json"), ["chain_module/module.json", "dof_module/module.json"]);
    let before = modules("").len();
    robot.link_poses(&[0.0; 6]).unwrap();
    assert_eq!(modules("").len(), before, "nothing is read twice");
    robot.shapes(ShapeKind::Boxes).unwrap();
    assert_eq!(modules("urdf"), [""; 0]);
    assert!(modules(".stl").is_empty() && modules(".yaml").is_empty(), "{:?}", modules(""));
    robot.shapes(ShapeKind::Hulls).unwrap();
    assert!(!modules(".stl").is_empty());
    assert!(modules(".glb").is_empty() && modules(".obj").is_empty());
    // What was asked once is never read again, whatever it is asked for.
    let all = |robot: &Robot| {
        let q = [0.0; 6];
        robot.centre_of_mass(&q).unwrap();
        robot.velocity_limits().unwrap();
        robot.link_masses().unwrap();
        robot.description().unwrap();
        robot.source().unwrap();
        robot.num_samples().unwrap();
        robot.configurations().unwrap();
        robot.named_configurations().unwrap();
        for kind in ShapeKind::ALL {
            robot.pair_statistics(kind, 0, 1).unwrap();
            robot.proximity(kind).unwrap().in_collision(&q).unwrap();
        }
    };
    all(&robot);
    let before = modules("").len();
    all(&robot);
    assert_eq!(modules("").len(), before);
    let json = modules("module.json");
    let once: std::collections::BTreeSet<&String> = json.iter().collect();
    assert_eq!(json.len(), once.len(), "{json:?}");
}

#[test]
fn what_is_missing_is_said_when_it_is_needed() {
    let (_folder, path) = made(&our_robots()[8].1);
    std::fs::remove_dir_all(path.join("link_shapes_modules/link_shapes_skips_module")).unwrap();
    std::fs::remove_dir_all(path.join("link_shapes_modules/link_shapes_simple_skips_module"))
        .unwrap();
    std::fs::remove_dir_all(path.join("bounds_module")).unwrap();
    let broken = path.join("link_shapes_modules/link_shapes_approximations_module/module.json");
    std::fs::write(&broken, "{\"full_obbs\": [").unwrap();
    let robot = Robot::open(&path).unwrap();
    assert!(robot.link_poses(&[0.0; 6]).is_ok());
    assert!(!robot.shapes(ShapeKind::Hulls).unwrap().is_empty());
    assert_eq!(
        robot.configurations().unwrap_err().to_string(),
        "bounds_module is missing: generate it with `urdd generate ROBOT.urdf -o DIR --modules bounds`"
    );
    let error = robot.proximity(ShapeKind::Hulls).unwrap_err().to_string();
    assert!(error.starts_with("link_shapes_skips_module is missing: "), "{error}");
    let error = robot.shapes(ShapeKind::Boxes).unwrap_err();
    assert!(matches!(error, RobotError::Unusable { .. }));
    let error = error.to_string();
    assert!(
        error.starts_with("link_shapes_approximations_module: link_shapes_modules/link_shapes_approximations_module/module.json:1:"),
        "{error}"
    );
    std::fs::remove_file(path.join("mesh_modules/convex_hull_meshes_module/meshes/stl/base.stl"))
        .ok();
    let nowhere = Robot::open(path.join("nowhere")).unwrap_err();
    assert!(nowhere.to_string().contains("nowhere: "), "{nowhere}");
}

#[test]
fn a_mesh_that_cannot_be_read_is_named() {
    let (_folder, path) = made(&our_robots()[8].1);
    let file = files(&path)
        .into_keys()
        .find(|file| file.contains("convex_hull") && file.ends_with(".stl"))
        .unwrap();
    std::fs::write(path.join(&file), "solid").unwrap();
    let error = Robot::open(&path).unwrap().proximity(ShapeKind::Hulls).unwrap_err();
    assert!(matches!(&error, RobotError::Mesh { path, .. } if *path == file), "{error}");
    std::fs::remove_file(path.join(&file)).unwrap();
    let error = Robot::open(&path).unwrap().shapes(ShapeKind::Hulls).unwrap_err().to_string();
    assert_eq!(error, format!("{file}: there is no such file"));
}

#[test]
fn names_that_are_not_there_bring_the_nearest() {
    let (_folder, path) = made(&our_robots()[8].1);
    let robot = Robot::open(&path).unwrap();
    assert_eq!(robot.link_names().unwrap()[robot.link("turret").unwrap()], "turret");
    assert_eq!(
        robot.link("turet").unwrap_err().to_string(),
        "there is no link `turet`; did you mean `turret`?"
    );
    assert_eq!(
        robot.dof("axis_9").unwrap_err().to_string(),
        "there is no DOF `axis_9`; did you mean `axis_1`?"
    );
    assert_eq!(
        robot.link("\u{202e}x\ny").unwrap_err().to_string(),
        "there is no link `\\u{202e}x\\ny`"
    );
    let error = robot.jacobian(&[0.0; 6], 99).unwrap_err();
    assert!(matches!(error, RobotError::OutOfRange { index: 99, .. }));
}
