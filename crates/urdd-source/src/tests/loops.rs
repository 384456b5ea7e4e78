//! Where a file of loops is looked for.

use std::path::Path;
use std::sync::Arc;

use crate::loops::beside;
use crate::{Files, Settings};

#[test]
fn a_file_of_loops_has_the_name_of_the_robot_without_its_endings() {
    let toml: Arc<[u8]> = Arc::from(&b"independent = [\"a\"]\n"[..]);
    let found = |robot: &str| {
        let files = Files::in_memory([("d/x.loops.toml".to_owned(), Arc::clone(&toml))]);
        let settings = Settings { files: files.expect("files"), ..Settings::default() };
        beside(Path::new(robot), &settings).expect("readable").is_some()
    };
    for robot in ["/d/x.urdf", "/d/x.URDF", "/d/x.xacro", "/d/x.urdf.xacro", "/d/x.xml"] {
        assert!(found(robot), "{robot}");
    }
    for robot in ["/d/y.urdf", "/x.urdf", "/d/x.y.urdf"] {
        assert!(!found(robot), "{robot}");
    }
}
