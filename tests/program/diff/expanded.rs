//! Xacro files.

use super::command::run;
use crate::lint::xacro::hand;

#[test]
fn xacro_files_are_compared_as_what_they_become() {
    let folder = hand("hand");
    let root = folder.path();
    let file = "hand/hand.urdf.xacro";
    let changed = std::fs::read_to_string(root.join(file)).unwrap();
    let changed = changed.replace("\"left\"", "\"right\"");
    std::fs::write(root.join("hand/other.urdf.xacro"), changed).unwrap();
    let path = root.join("bin");
    let diff = |arguments: &[&str]| run(root, arguments, Some(&path));
    assert_eq!(diff(&[file, file]).0, 0);
    let (status, out, err) = diff(&[file, "hand/other.urdf.xacro", "--no-findings", "a:=1"]);
    assert_eq!((status, err.as_str()), (1, ""), "{out}");
    assert!(out.contains("added: right_tip"), "{out}");
    let (status, _, err) = diff(&[file, file, "third.urdf"]);
    assert!(status == 2 && err.contains("third.urdf: not an argument of xacro"), "{err}");
}
