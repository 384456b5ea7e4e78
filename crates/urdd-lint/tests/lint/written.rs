//! The place in a .xacro file that a link or joint of its expansion was written at, as far as its name tells.

use urdd_lint::written::*;

#[test]
fn a_name_is_found_by_its_fixed_parts() {
    assert_eq!(fixed_parts("${p}wrist_$(arg n)_é"), ["", "wrist_", "_é"]);
    let text = "<robot xmlns:xacro=\"x\">\n<xacro:macro name=\"arm\">\n<link name=\"${p}wrist\"/>\n\
            <link name=\"${p}wrist_${n}\"/><joint name=\"${p}\"/></xacro:macro><link name=\"base\"/><link name=\"base\"/></robot>";
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("urdf/arm.xacro");
    std::fs::create_dir(folder.path().join("urdf")).expect("a folder");
    std::fs::write(&file, text).expect("written");
    let sources = Sources::read(&[file], &folder.path().join("other"));
    let at = |subject: &str| {
        let at = sources.find(subject)?;
        Some((at.file.clone(), at.line?.get(), at.macro_name.clone()))
    };
    let arm = |line| Some(("../urdf/arm.xacro".to_owned(), line, Some("arm".to_owned())));
    assert_eq!(at("link `left_wrist`"), arm(3));
    assert_eq!(at("link `left_wrist_1`"), arm(4));
    assert_eq!(at("link `left_elbow`"), None);
    assert_eq!(at("joint `left_wrist`"), None, "nothing of its name is fixed");
    assert_eq!(at("link `base`"), None, "two places");
}
