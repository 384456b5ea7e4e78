//! URDDs of the project's robots, and of URDFs written by tests.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use crate::files;
use urdd_generate::note::Note;
use urdd_generate::{Selection, Settings, generate};

/// The URDFs of the project's robots.
pub fn our_robots() -> Vec<(String, PathBuf)> {
    let folder = crate::repository().join("conformance/robots");
    let entries = std::fs::read_dir(folder).expect("our robots");
    let mut robots: Vec<(String, PathBuf)> = entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "urdf"))
        .map(|path| (path.file_stem().expect("a name").to_string_lossy().into_owned(), path))
        .collect();
    robots.sort();
    assert_eq!(robots.len(), 9);
    robots
}

/// The files of a URDD by their paths in it, and what was noted while it was made.
type Made = (BTreeMap<String, Vec<u8>>, Vec<Note>);

/// A URDD of one of these robots, generated once, in a temporary folder that is removed with the returned guard.
pub fn made(urdf: &Path) -> (tempfile::TempDir, PathBuf) {
    let (folder, target, _) = made_with_notes(urdf);
    (folder, target)
}

/// As [`made`], with the notes.
pub fn made_with_notes(urdf: &Path) -> (tempfile::TempDir, PathBuf, Vec<Note>) {
    static MADE: Mutex<BTreeMap<PathBuf, Arc<OnceLock<Made>>>> = Mutex::new(BTreeMap::new());
    let mut all = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    let one = Arc::clone(all.entry(urdf.to_owned()).or_default());
    drop(all);
    let folder = crate::temporary::folder();
    let target = folder.path().join("robot");
    let generated = || {
        let made = generate(urdf, &target, &Settings::default(), &()).expect("a URDD");
        let files = files::below(&target);
        std::fs::remove_dir_all(&target).expect("a folder");
        (files, made.notes)
    };
    let (files, notes) = one.get_or_init(generated);
    for (path, bytes) in files {
        let path = target.join(path);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, bytes).expect("a file");
    }
    (folder, target, notes.clone())
}

/// A URDD of one of our robots, in a folder of its name.
pub fn made_named(robot: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = crate::temporary::folder();
    let target = folder.path().join(robot);
    let urdf = crate::repository().join(format!("conformance/robots/{robot}.urdf"));
    generate(&urdf, &target, &Settings::default(), &()).expect("a URDD");
    (folder, target)
}

/// A URDD generated from the text of a URDF.
pub fn made_of(urdf: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = crate::temporary::folder();
    let file = folder.path().join("robot.urdf");
    std::fs::write(&file, urdf).expect("a file");
    let target = folder.path().join("robot");
    generate(&file, &target, &Settings::default(), &()).expect("a URDD");
    (folder, target)
}

/// Three bars in a row on two hinges, which swing past each other, and a link without a shape.
pub const BARS: &str = r#"<robot name="bars">
<link name="a"><collision><geometry><box size="0.4 0.05 0.05"/></geometry></collision></link>
<link name="b"><collision><origin xyz="0.2 0 0"/><geometry><box size="0.4 0.05 0.05"/></geometry></collision></link>
<link name="c"><collision><origin xyz="0.2 0 0"/><geometry><box size="0.4 0.05 0.05"/></geometry></collision></link>
<link name="frame"/>
<joint name="ab" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
<joint name="bc" type="revolute"><parent link="b"/><child link="c"/><origin xyz="0.5 0 0"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
<joint name="cf" type="fixed"><parent link="c"/><child link="frame"/></joint>
</robot>"#;

/// The URDD of [`BARS`] with these modules, in `folder/bars`.
pub fn made_bars(folder: &Path, modules: &[&str]) -> PathBuf {
    let (source, target) = (folder.join("bars.urdf"), folder.join("bars"));
    std::fs::write(&source, BARS).expect("a URDF");
    let selection = Selection::parse(modules.iter().copied()).expect("modules");
    let settings = Settings { selection, num_samples: 100, ..Settings::default() };
    generate(&source, &target, &settings, &()).expect("a URDD");
    target
}
