//! An open robot is one robot, whatever happens to its files: each answer is that of the robot that was there when it
//! was opened, or an error that says that it changed.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::time::{Duration, SystemTime};

use testkit::files::below;
use urdd_directory::listing::ReadError;
use urdd_format::link_shapes_skips::SkipEdit;
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_generate::{Settings, generate};
use urdd_robot::{InverseSettings, Queries, Robot, RobotError, ShapeKind, Target};

use testkit::robots::made_of;

type Question = (&'static str, Box<dyn Fn(&Robot) -> Result<String, RobotError> + Sync + Send>);

/// An answer as text, in every digit.
fn shown(answer: impl Debug) -> String {
    format!("{answer:?}")
}

/// Every question that a robot can be asked.
static QUESTIONS: LazyLock<Vec<Question>> = LazyLock::new(|| {
    let mut all: Vec<Question> = Vec::new();
    macro_rules! ask {
        ($($name:literal: |$robot:ident| $answer:expr,)*) => {$(
            all.push(($name, Box::new(|$robot: &Robot| Ok(shown($answer)))));
        )*};
    }
    const Q: [f64; 6] = [0.3, -0.2, 0.1, 0.4, 0.2, -0.5];
    ask! {
        "link_names": |robot| robot.link_names()?,
        "joint_names": |robot| robot.joint_names()?,
        "dof_names": |robot| robot.dof_names()?,
        "dof_units": |robot| robot.dof_units()?,
        "root_link": |robot| robot.root_link()?,
        "bounds": |robot| robot.configurations()?.bounds(),
        "random": |robot| robot.configurations()?.random(7),
        "link_poses": |robot| robot.link_poses(&Q)?,
        "link_poses_batch": |robot| robot.link_poses_batch(&Q)?,
        "jacobian": |robot| robot.jacobian(&Q, 6)?,
        "inverse_kinematics": |robot| {
            let target = Target::pose(6, robot.link_poses(&Q)?[6]);
            let settings = InverseSettings { restarts: 3, ..Default::default() };
            robot.inverse_kinematics(&target, &[0.0; 6], &settings)?
        },
        "velocity_limits": |robot| robot.velocity_limits()?,
        "effort_limits": |robot| robot.effort_limits()?,
        "link_masses": |robot| robot.link_masses()?,
        "centre_of_mass": |robot| robot.centre_of_mass(&Q)?,
        "gravity_torques": |robot| robot.gravity_torques(&Q, &Default::default())?,
        "description": |robot| robot.description()?,
        "source": |robot| robot.source()?,
        "visuals": |robot| robot.visuals()?,
        "num_samples": |robot| robot.num_samples()?,
        "pair_statistics": |robot| robot.pair_statistics(ShapeKind::Hulls, 0, 2)?,
        "named_configurations": |robot| robot.named_configurations()?,
        "resolved_configurations": |robot| robot.resolved_configurations(&[home()])?,
        "with_named_configurations": |robot| robot.with_named_configurations(&[home()])?,
        "with_skip_edits": |robot| robot.with_skip_edits(vec![edit()], None)?,
        "collision_model": |robot| robot.collision_model()?,
        "source_file": |robot| {
            let path = robot.source()?.expect("a source").path;
            robot.root().read(&path, 1 << 20).map_err(|error| match error {
                ReadError::Changed => RobotError::Changed(robot.folder_name()),
                error => RobotError::List(error),
            })?
        },
    }
    for kind in ShapeKind::ALL {
        all.push(("shapes", Box::new(move |robot| Ok(shown(robot.shapes(kind)?)))));
        all.push(("skips", Box::new(move |robot| Ok(shown(robot.skips(kind)?)))));
        all.push((
            "proximity",
            Box::new(move |robot| Ok(shown(robot.proximity(kind)?.closest_points(&Q)?))),
        ));
    }
    all
});

fn home() -> ConfigurationEdit {
    let name = ConfigurationName::new("home").expect("a name");
    let dof_name = "joint_1".to_owned();
    ConfigurationEdit { name, positions: vec![DofPosition { dof_name, position: 0.25 }] }
}

fn edit() -> SkipEdit {
    let [link_a, link_b] = ["base_link", "forearm"].map(str::to_owned);
    SkipEdit { link_a, link_b, skip: true, reason: "test".to_owned() }
}

/// Two generations of an arm: other masses, sizes, limits and origins, the same names.
struct Generations {
    _folders: [tempfile::TempDir; 2],
    urdf: [String; 2],
    files: [BTreeMap<String, Vec<u8>>; 2],
}

static GENERATIONS: LazyLock<Generations> = LazyLock::new(|| {
    let robot = testkit::repository().join("conformance/robots/six_axis_arm.urdf");
    let first = fs::read_to_string(robot).expect("a robot");
    // Digits for digits: many files keep their sizes.
    let second = first.replace("0.1", "0.2").replace("mass value=\"", "mass value=\"1");
    let second = second.replace("velocity=\"", "velocity=\"1").replace("effort=\"", "effort=\"1");
    assert_ne!(first, second);
    let made = [&first, &second].map(|text| made_of(text));
    let files = made.each_ref().map(|(_, path)| below(path));
    Generations { _folders: made.map(|(folder, _)| folder), urdf: [first, second], files }
});

fn write(files: &BTreeMap<String, Vec<u8>>, path: &Path) {
    for (name, bytes) in files {
        let file = path.join(name);
        fs::create_dir_all(file.parent().expect("a folder")).expect("a folder");
        fs::write(file, bytes).expect("a file");
    }
}

/// What every question is answered for a generation.
fn answers(generation: usize) -> Vec<Result<String, RobotError>> {
    let folder = testkit::temporary::folder();
    let path = folder.path().join("robot");
    write(&GENERATIONS.files[generation], &path);
    let robot = Robot::open(&path).expect("a robot");
    QUESTIONS.iter().map(|(_, ask)| ask(&robot)).collect()
}

static FIRST: LazyLock<Vec<Result<String, RobotError>>> = LazyLock::new(|| answers(0));

/// Robots of the first generation at a path, one for each question, which it was asked. They are asked all questions after the change.
#[track_caller]
fn holds(what: &str, folder: &Path, change: impl FnOnce(&Path), may_refuse: bool) {
    let path = folder.join("robot");
    let open = |(_, ask): &Question| {
        let robot = Robot::open(&path).expect("a robot");
        let _ = ask(&robot);
        robot
    };
    let mut robots: Vec<Robot> = QUESTIONS.iter().map(open).collect();
    robots.push(Robot::open(&path).expect("a robot"));
    change(&path);
    let mut refused = 0;
    for (k, robot) in robots.iter().enumerate() {
        let before = QUESTIONS.get(k).map_or("nothing", |(name, _)| name);
        for ((name, ask), first) in QUESTIONS.iter().zip(&*FIRST) {
            match ask(robot) {
                Err(RobotError::Changed(_)) if may_refuse => refused += 1,
                answer => assert!(
                    answer == *first,
                    "{what}: {name} after {before}: {} in place of {}",
                    brief(&answer),
                    brief(first)
                ),
            }
        }
    }
    assert_eq!(refused > 0, may_refuse, "{what}");
}

fn brief(answer: &Result<String, RobotError>) -> String {
    format!("{answer:?}").chars().take(300).collect()
}

fn fresh() -> tempfile::TempDir {
    let folder = testkit::temporary::folder();
    write(&GENERATIONS.files[0], &folder.path().join("robot"));
    folder
}

/// Other bytes of the same number in the same file, with the same time of modification.
fn edit_in_place(file: &Path) {
    let metadata = fs::metadata(file).expect("a file");
    let mut bytes = fs::read(file).expect("a file");
    for byte in &mut bytes {
        match *byte {
            b'1' => *byte = b'3',
            b'3' => *byte = b'1',
            _ => {}
        }
    }
    fs::write(file, bytes).expect("written");
    let opened = fs::File::options().write(true).open(file).expect("a file");
    opened.set_modified(metadata.modified().expect("a time")).expect("set");
}

fn each_file(path: &Path, change: impl Fn(&Path)) {
    for name in below(path).into_keys() {
        change(&path.join(name));
    }
}

#[test]
fn the_two_generations_differ_in_nearly_every_answer() {
    let second = answers(1);
    let differ = FIRST.iter().zip(&second).filter(|(first, second)| first != second).count();
    let given = FIRST.iter().filter(|answer| answer.is_ok()).count();
    // Names are the same, and so are skips.
    assert!(differ + 12 >= QUESTIONS.len() && given + 1 >= QUESTIONS.len(), "{differ} {given}");
}

#[test]
fn files_that_are_edited_in_place() {
    let folder = fresh();
    holds("in place", folder.path(), |path| each_file(path, edit_in_place), true);
}

#[test]
fn files_that_are_replaced_one_by_one() {
    let folder = fresh();
    let replace = |path: &Path| {
        for (name, bytes) in &GENERATIONS.files[1] {
            let other = path.with_extension("other");
            fs::write(&other, bytes).expect("a file");
            fs::rename(other, path.join(name)).expect("renamed");
        }
    };
    holds("replaced", folder.path(), replace, true);
}

#[test]
fn a_folder_that_another_one_replaces() {
    let folder = fresh();
    let other = folder.path().join("other");
    write(&GENERATIONS.files[1], &other);
    // Its files are older than the open robots.
    std::thread::sleep(Duration::from_millis(50));
    let rename = |path: &Path| {
        fs::rename(path, path.with_extension("old")).expect("renamed");
        fs::rename(&other, path).expect("renamed");
    };
    holds("renamed", folder.path(), rename, true);
}

#[test]
fn a_module_that_another_one_replaces() {
    let folder = fresh();
    let other = folder.path().join("other");
    write(&GENERATIONS.files[1], &other);
    let rename = |path: &Path| {
        for module in ["urdf_module", "bounds_module", "link_shapes_modules", "mesh_modules"] {
            fs::rename(path.join(module), path.join(module).with_extension("old"))
                .expect("renamed");
            fs::rename(other.join(module), path.join(module)).expect("renamed");
        }
    };
    holds("a module renamed", folder.path(), rename, true);
}

#[test]
fn a_robot_that_is_generated_again_in_place() {
    let folder = fresh();
    let urdf = folder.path().join("robot.urdf");
    fs::write(&urdf, &GENERATIONS.urdf[1]).expect("a file");
    let again = |path: &Path| {
        generate(&urdf, path, &Settings::default(), &()).expect("a URDD");
    };
    holds("generated", folder.path(), again, true);
}

#[test]
fn a_folder_that_is_removed() {
    let folder = fresh();
    holds("removed", folder.path(), |path| fs::remove_dir_all(path).expect("removed"), true);
}

#[test]
fn a_folder_that_cannot_be_entered_any_more_or_moves() {
    let folder = fresh();
    let moved = |path: &Path| fs::rename(path, path.with_extension("moved")).expect("renamed");
    holds("moved", folder.path(), moved, true);
    let robot = Robot::open(folder.path().join("robot.moved")).expect("a robot");
    assert!(robot.link_masses().is_ok());
}

#[test]
fn a_link_to_a_folder_that_leads_elsewhere_later() {
    let folder = testkit::temporary::folder();
    let versions = ["one", "two"].map(|name| folder.path().join(name).join("robot"));
    for (files, path) in GENERATIONS.files.iter().zip(&versions) {
        write(files, path);
    }
    let link = folder.path().join("robot");
    std::os::unix::fs::symlink(&versions[0], &link).expect("a link");
    let lead = |path: &Path| {
        fs::remove_file(path).expect("removed");
        std::os::unix::fs::symlink(&versions[1], path).expect("a link");
    };
    holds("a link", folder.path(), lead, false);
}

#[test]
fn links_inside_lead_where_they_led() {
    let folder = fresh();
    let path = folder.path().join("robot");
    let (own, meshes) =
        ("urdf_module/module.json", "mesh_modules/convex_hull_meshes_module/meshes");
    fs::rename(path.join(own), path.join("first.json")).expect("renamed");
    std::os::unix::fs::symlink("../first.json", path.join(own)).expect("a link");
    fs::write(path.join("second.json"), &GENERATIONS.files[1][own]).expect("a file");
    fs::rename(path.join(meshes), path.join("first")).expect("renamed");
    std::os::unix::fs::symlink("../../first", path.join(meshes)).expect("a link");
    for (name, bytes) in &GENERATIONS.files[1] {
        if let Some(name) = name.strip_prefix(meshes) {
            let file = path.join("second").join(&name[1..]);
            fs::create_dir_all(file.parent().expect("a folder")).expect("a folder");
            fs::write(file, bytes).expect("a file");
        }
    }
    let lead = |path: &Path| {
        for (link, to) in [(own, "../second.json"), (meshes, "../../second")] {
            fs::remove_file(path.join(link)).expect("removed");
            std::os::unix::fs::symlink(to, path.join(link)).expect("a link");
        }
    };
    holds("links inside", folder.path(), lead, false);
}

#[test]
fn an_archive_that_is_replaced() {
    let folder = testkit::temporary::folder();
    let zip = |files: &BTreeMap<String, Vec<u8>>| {
        let mut writer = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
        for (name, bytes) in files {
            let options = zip::write::SimpleFileOptions::default();
            writer.start_file(format!("robot/{name}"), options).expect("an entry");
            std::io::Write::write_all(&mut writer, bytes).expect("written");
        }
        writer.finish().expect("an archive").into_inner()
    };
    let archives = GENERATIONS.files.each_ref().map(zip);
    fs::write(folder.path().join("robot"), &archives[0]).expect("a file");
    let replace = |path: &Path| fs::write(path, &archives[1]).expect("a file");
    holds("an archive", folder.path(), replace, false);
}

/// The file system's clock ticks every few milliseconds: two edits in one tick have the same time.
#[test]
fn an_edit_in_the_tick_of_the_opening_is_noticed() {
    let folder = fresh();
    let path = folder.path().join("robot");
    let file = path.join("urdf_module/module.json");
    let text = &GENERATIONS.files[0]["urdf_module/module.json"];
    for _ in 0..20 {
        fs::write(&file, text).expect("written");
        let robot = Robot::open(&path).expect("a robot");
        edit_in_place(&file);
        assert_eq!(robot.description(), Err(RobotError::Changed("robot".to_owned())));
    }
}

/// Robots that are opened while another program swaps two folders belong to one of them.
#[test]
fn a_robot_that_is_opened_during_a_change_is_one_of_the_two() {
    let folder = fresh();
    let [path, other, third] = ["robot", "other", "third"].map(|name| folder.path().join(name));
    write(&GENERATIONS.files[1], &other);
    let second = answers(1);
    let until = SystemTime::now() + Duration::from_secs(2);
    let swap = |from: &PathBuf, to: &PathBuf| fs::rename(from, to).expect("renamed");
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while SystemTime::now() < until {
                swap(&path, &third);
                swap(&other, &path);
                swap(&third, &other);
                std::thread::sleep(Duration::from_millis(3));
            }
        });
        let mut answered = 0;
        while SystemTime::now() < until {
            let Ok(robot) = Robot::open(&path) else { continue };
            let given = QUESTIONS.iter().map(|(_, ask)| ask(&robot));
            let given: Vec<_> = given.enumerate().filter(|(_, answer)| answer.is_ok()).collect();
            let is_of = |all: &[Result<String, RobotError>]| {
                given.iter().all(|(k, answer)| *answer == all[*k])
            };
            assert!(is_of(&FIRST) || is_of(&second), "a mix of two robots");
            answered += given.len();
        }
        assert!(answered > 0);
    });
}

/// A file that is changed while it is read is refused, whoever reads it and however.
#[test]
fn a_change_during_a_read_is_noticed() {
    let folder = fresh();
    let path = folder.path().join("robot");
    let name = "urdf_module/module.json";
    for reads_to_the_end in [true, false] {
        let robot = Robot::open(&path).expect("a robot");
        let (mut file, size) = robot.root().open_file(name).expect("a file");
        let mut first = [0; 10];
        file.read_exact(&mut first).expect("the first bytes");
        edit_in_place(&path.join(name));
        let mut rest = Vec::new();
        let read = match reads_to_the_end {
            true => file.read_to_end(&mut rest),
            false => file.take(size - 10).read_to_end(&mut rest),
        };
        assert!(read.is_err(), "{reads_to_the_end}");
    }
}
