//! Files that are written together: what a killed run leaves, and what the next one makes of it.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::fs::{self, Permissions};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;

use sha2::{Digest, Sha256};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::outputs::{Output, OutputError, Target, stage, write};
use urdd_directory::staging::{Staging, StagingError};
use urdd_directory::writer::Writer;

/// The three files of a robot.
fn robot(text: &'static str, replaces: bool) -> Vec<Output<'static>> {
    let output = |path: &str| Output { path: path.into(), bytes: text.as_bytes(), replaces };
    ["meshes/a", "r.srdf", "r.urdf"].map(output).into()
}

/// The texts below a folder, hidden ones too.
fn texts(folder: &Path) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    let mut open = vec![folder.to_owned()];
    while let Some(here) = open.pop() {
        for entry in fs::read_dir(&here).unwrap() {
            let path = entry.unwrap().path();
            let name = path.strip_prefix(folder).unwrap().to_str().unwrap().to_owned();
            match fs::symlink_metadata(&path).unwrap().is_dir() {
                true => open.push(path),
                false => _ = found.insert(name, fs::read_to_string(path).unwrap_or_default()),
            }
        }
    }
    found
}

fn of(pairs: &[(&str, &str)]) -> BTreeMap<String, String> {
    pairs.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect()
}

/// A folder with an old robot and a file of a person.
fn old() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    write(Target::Folder(&out), robot("old", false)).unwrap();
    fs::write(out.join("mine"), "mine").unwrap();
    (folder, out)
}

/// The hidden folder in a folder.
fn hidden(out: &Path) -> PathBuf {
    hidden_of(&out.join("output"))
}

/// The hidden folder beside what is written.
fn hidden_of(target: &Path) -> PathBuf {
    let hash = Sha256::digest(target.file_name().unwrap().as_encoded_bytes());
    let hash: String = hash.iter().take(8).map(|byte| format!("{byte:02x}")).collect();
    target.with_file_name(format!(".urdd-{hash}"))
}

/// What a run leaves that is killed when the first `moved` of its files are in place.
fn killed(out: &Path, moved: usize) -> PathBuf {
    let workplace = hidden(out);
    fs::write(workplace.with_extension("lock"), "").unwrap();
    for (number, file) in robot("new", true).iter().enumerate() {
        let (ready, was) = (workplace.join("ready"), workplace.join("was"));
        for folder in [&ready, &was] {
            fs::create_dir_all(folder.join(&file.path).parent().unwrap()).unwrap();
        }
        fs::copy(out.join(&file.path), was.join(&file.path)).unwrap();
        let place = if number < moved { out } else { &ready };
        fs::write(place.join(&file.path), file.bytes).unwrap();
    }
    workplace
}

const NEW: [(&str, &str); 4] =
    [("meshes/a", "new"), ("mine", "mine"), ("r.srdf", "new"), ("r.urdf", "new")];

#[test]
fn the_next_run_completes_a_killed_one_and_takes_away_what_it_left() {
    for moved in 0..=3 {
        let (_folder, out) = old();
        killed(&out, moved);
        // It would have to replace the old files, and may not: it finds the new ones.
        assert_eq!(write(Target::Folder(&out), robot("new", false)).unwrap(), 0, "{moved}");
        assert_eq!(texts(&out), of(&NEW), "{moved}");
    }
}

#[test]
fn what_a_person_changed_after_a_kill_stays() {
    let (_folder, out) = old();
    killed(&out, 1);
    fs::write(out.join("r.urdf"), "edited").unwrap();
    let error = write(Target::Folder(&out), robot("new", false)).unwrap_err();
    assert!(matches!(&error, OutputError::Exists(path) if path.ends_with("r.urdf")), "{error}");
    let mut wanted = of(&NEW);
    wanted.insert("r.urdf".to_owned(), "edited".to_owned());
    assert_eq!(texts(&out), wanted);
    // A file that was not there before, and is now.
    let (_folder, out) = old();
    let workplace = killed(&out, 3);
    fs::write(workplace.join("ready/new"), "new").unwrap();
    fs::write(out.join("new"), "mine").unwrap();
    write(Target::Folder(&out), robot("new", false)).unwrap();
    assert_eq!(texts(&out)["new"], "mine");
}

/// A hidden folder may come from a stranger, with links in it.
#[test]
fn what_is_left_is_not_followed_out_of_the_folder() {
    let secret = tempfile::tempdir().unwrap();
    for name in ["meshes/a", "r.srdf", "key"] {
        fs::create_dir_all(secret.path().join(name).parent().unwrap()).unwrap();
        fs::write(secret.path().join(name), "secret").unwrap();
    }
    let before = texts(secret.path());
    for link in ["", "ready", "old", "new", "ready/meshes", "ready/r.srdf"] {
        let (_folder, out) = old();
        let workplace = killed(&out, 0);
        let place = if link.is_empty() { workplace.clone() } else { workplace.join(link) };
        let _ = fs::remove_dir_all(&place);
        let _ = fs::remove_file(&place);
        symlink(secret.path(), &place).unwrap();
        let _ = write(Target::Folder(&out), robot("new", true));
        assert_eq!(texts(secret.path()), before, "{link}");
        assert!(!texts(&out).values().any(|text| text == "secret"), "{link}");
        assert!(!out.join("key").exists());
    }
    // Nor through links in the folder.
    let (_folder, out) = old();
    let workplace = killed(&out, 0);
    fs::write(workplace.join("ready/meshes/new"), "new").unwrap();
    fs::remove_dir_all(out.join("meshes")).unwrap();
    symlink(secret.path().join("meshes"), out.join("meshes")).unwrap();
    let error = write(Target::Folder(&out), robot("new", true)).unwrap_err();
    assert!(error.to_string().contains("out/meshes: a link is in the way"), "{error}");
    assert_eq!(texts(secret.path()), before);
    // A link is no old folder, where the folder is gone.
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    fs::create_dir(hidden_of(&out)).unwrap();
    symlink(secret.path(), hidden_of(&out).join("old")).unwrap();
    write(Target::Folder(&out), robot("new", true)).unwrap();
    assert!(!out.is_symlink() && texts(secret.path()) == before);
    // A lock that is a link makes no file elsewhere.
    let (_folder, out) = old();
    let lock = killed(&out, 3).with_extension("lock");
    fs::remove_file(&lock).unwrap();
    symlink(secret.path().join("lock"), &lock).unwrap();
    assert!(write(Target::Folder(&out), robot("newer", true)).is_err());
    assert_eq!(texts(secret.path()), before);
}

#[test]
fn paths_that_lead_out_pipes_and_metadata_are_refused_and_leave_no_folder() {
    let folder = tempfile::tempdir().unwrap();
    let new = folder.path().join("new");
    let refused = |out: &Path, path: &str| {
        let files = vec![Output { path: path.into(), bytes: b"", replaces: true }];
        write(Target::Folder(out), files).unwrap_err()
    };
    for path in ["../x", "a/../../x", "/x", "./x"] {
        let error = refused(&new.join("out"), path);
        assert!(matches!(error, OutputError::Outside(_)), "{path}: {error}");
    }
    for path in ["urdd.json", "a/URDD.JSON"] {
        let error = refused(&new.join("out"), path);
        assert!(matches!(error, OutputError::MakesUrdd(_)), "{path}: {error}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    fs::create_dir(&new).unwrap();
    let made = Command::new("mkfifo").arg(new.join("pipe")).status().unwrap();
    assert!(made.success());
    for path in ["pipe", "pipe/x"] {
        let error = refused(&new, path);
        assert!(matches!(error, OutputError::InTheWay { .. }), "{path}: {error}");
    }
}

#[test]
fn the_current_folder_and_the_root_are_not_replaced() {
    let never = Cancellation::default();
    let current = std::env::current_dir().unwrap();
    for folder in [&*current, current.parent().unwrap(), Path::new("/")] {
        let refused = Staging::begin(folder, &never);
        assert!(matches!(refused, Err(StagingError::Place { .. })), "{folder:?}");
    }
    let refused = Staging::begin_inside(Path::new("/"), &never);
    assert!(matches!(refused, Err(StagingError::Place { .. })));
}

#[test]
fn a_urdd_is_not_written_through_links() {
    let folder = tempfile::tempdir().unwrap();
    let (root, other) = (folder.path().join("urdd"), folder.path().join("other"));
    [&root, &other].into_iter().for_each(|folder| fs::create_dir(folder).unwrap());
    fs::write(other.join("mine"), "mine").unwrap();
    fs::hard_link(other.join("mine"), root.join("hard")).unwrap();
    symlink(other.join("mine"), root.join("soft")).unwrap();
    symlink(&other, root.join("folder")).unwrap();
    let writer = Writer::new(&root);
    for name in ["hard", "soft"] {
        writer.file(name, b"new").unwrap();
        assert_eq!(fs::read_to_string(root.join(name)).unwrap(), "new");
    }
    for name in ["folder/mine", "folder/new", "folder/a/b"] {
        assert!(matches!(writer.file(name, b"new"), Err(StagingError::Link { .. })), "{name}");
    }
    assert_eq!(texts(&other), of(&[("mine", "mine")]));
}

/// The last file cannot be moved: it vanishes after the files were prepared.
#[test]
fn an_error_between_two_moves_takes_the_first_back() {
    let (_folder, out) = old();
    fs::remove_file(out.join("r.urdf")).unwrap();
    fs::remove_dir_all(out.join("meshes")).unwrap();
    let before = texts(&out);
    let staged = stage(Target::Folder(&out), robot("new", true)).unwrap();
    fs::remove_file(hidden(&out).join("new/r.urdf")).unwrap();
    let error = staged.put().unwrap_err();
    assert!(error.to_string().contains("out/r.urdf: cannot be written"), "{error}");
    assert_eq!(texts(&out), before);
    assert!(!out.join("meshes").exists());
    // Something takes the place of the last file meanwhile.
    let staged = stage(Target::Folder(&out), robot("new", true)).unwrap();
    fs::create_dir(out.join("r.urdf")).unwrap();
    let error = staged.put().unwrap_err();
    assert!(error.to_string().contains("out/r.urdf: cannot be written"), "{error}");
    fs::remove_dir(out.join("r.urdf")).unwrap();
    assert_eq!(texts(&out), before);
}

#[test]
fn modes_stay_and_a_folder_of_nothing_else_is_replaced_as_a_whole() {
    use std::os::unix::fs::MetadataExt;

    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    write(Target::Folder(&out), robot("old", false)).unwrap();
    fs::set_permissions(out.join("r.urdf"), Permissions::from_mode(0o640)).unwrap();
    let number = |path: &Path| fs::metadata(path).unwrap().ino();
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
    let before = number(&out);
    assert_eq!(write(Target::Folder(&out), robot("new", true)).unwrap(), 3);
    assert_ne!(number(&out), before);
    assert_eq!(mode(&out.join("r.urdf")), 0o640);
    fs::write(out.join("mine"), "mine").unwrap();
    let before = number(&out);
    assert_eq!(write(Target::Folder(&out), robot("newer", true)).unwrap(), 3);
    assert_eq!((number(&out), mode(&out.join("r.urdf"))), (before, 0o640));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}
