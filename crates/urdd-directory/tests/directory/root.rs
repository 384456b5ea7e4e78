//! A root leads to nothing outside of it.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;

use urdd_directory::listing::ReadError;
use urdd_directory::root::Root;

#[test]
fn a_sibling_is_a_urdd_in_the_same_folder() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["arm/dof_module", "hand/dof_module", "elsewhere/secret/dof_module", "plain"] {
        fs::create_dir_all(folder.path().join(name)).unwrap();
    }
    symlink(folder.path().join("elsewhere/secret"), folder.path().join("link")).unwrap();
    let root = Root::open_folder(&folder.path().join("arm")).unwrap();
    for root in [root.kept(), root] {
        assert!(root.sibling("hand").is_some());
        for name in ["none", "plain", "link", "elsewhere/secret", "..", "../hand", "/", ""] {
            assert!(root.sibling(name).is_none(), "{name}");
        }
    }
}

#[test]
fn a_path_that_the_specification_forbids_is_not_opened() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("a")).unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    let root = Root::open_folder(folder.path()).unwrap();
    assert_eq!(root.read("file", 10), Ok(Vec::new()));
    for path in ["a/../file", "./file", "a//../file", ""] {
        assert!(matches!(root.read(path, 10), Err(ReadError::Path(_))), "{path}");
    }
}
