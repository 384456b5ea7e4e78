//! `urdd combine` as a program.

use crate::combine::support::ours;
use crate::program::urdd;

const CORE: [&str; 2] = ["--modules", "core"];

#[test]
fn two_robots_need_no_recipe() {
    let folder = testkit::temporary::folder();
    let (arm, gripper) = (ours("six_axis_arm"), ours("gripper"));
    let pair = [arm.to_str().expect("a path"), gripper.to_str().expect("a path")];
    let run = |more: &[&str]| urdd(&[&["combine"], &pair[..], more, &CORE].concat(), folder.path());
    let made = run(&["--at", "tool0", "--xyz", "0", "0", "-0.1", "-o", "cell"]);
    assert_eq!(
        made,
        (0, "cell: 16 links, 15 joints, 7 DOFs; 7 modules\n".to_owned(), String::new())
    );
    let (_, text, _) = run(&["--at", "tool0", "--xyz", "0", "0", "-0.1", "-o", "cell"]);
    assert!(text.contains("unchanged"), "{text}");
    let urdf = folder.path().join("cell/six_axis_arm_gripper.urdf");
    let urdf = std::fs::read_to_string(urdf).expect("the URDF");
    assert!(urdf.contains("<link name=\"tool0\"/>") && urdf.contains("<origin xyz=\"0 0 -0.1\""));
    let (status, _, said) = run(&["--at", "tol0", "-o", "other"]);
    assert_eq!(status, 1);
    assert_eq!(
        said,
        "urdd: command line: part `six_axis_arm` has no link `tol0`; did you mean `tool0`?\n"
    );
    assert_eq!(run(&["-o", "other"]).0, 2);
    assert!(!folder.path().join("other").exists());
}

#[test]
fn a_part_that_does_not_pass_is_refused_unless_asked() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    let (arm, gripper) = (ours("six_axis_arm"), ours("gripper"));
    let (arm, gripper) = (arm.to_str().expect("a path"), gripper.to_str().expect("a path"));
    let (status, _, said) = urdd(&["generate", gripper, "-o", "g", "--modules", "core"], folder);
    assert_eq!(status, 0, "{said}");
    // A bound that differs from the joint's.
    let bounds = folder.join("g/bounds_module/module.json");
    let text = std::fs::read_to_string(&bounds).expect("a file");
    std::fs::write(&bounds, text.replace("4.0", "5.0").replace("[0, 4]", "[0, 5]"))
        .expect("a file");
    let run = |more: &[&str]| {
        let all = ["combine", arm, "g", "--at", "tool0", "-o", "cell"];
        urdd(&[&all[..], &CORE, more].concat(), folder)
    };
    let (status, _, said) = run(&[]);
    assert_eq!(status, 1, "{said}");
    assert!(
        said.contains("part `g`: g: it does not pass `urdd validate`: ") && said.contains("BND"),
        "{said}"
    );
    let (_, text, _) = run(&["--format", "json"]);
    let told: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(told["error"]["code"], "part-fails");
    let (status, _, said) = run(&["--force"]);
    assert_eq!((status, said.as_str()), (0, ""));
}

#[test]
fn results_are_told_as_json() {
    let folder = testkit::temporary::folder();
    let recipe = format!(
        "[[part]]\nid = \"arm\"\nsource = \"{}\"\nfreeze = {{ joint_1 = 0.1 }}\n",
        ours("six_axis_arm").display()
    );
    std::fs::write(folder.path().join("frozen.toml"), recipe).expect("a file");
    let ours = ours("gripper");
    let ours = ours.parent().and_then(|folder| folder.to_str());
    let allowed = ["--allow-folder", ours.expect("a path")];
    let all = [&["combine", "frozen.toml", "-o", "out", "--format", "json"][..], &allowed].concat();
    let (status, text, said) = urdd(&[&all[..], &CORE].concat(), folder.path());
    assert_eq!((status, said.as_str()), (0, ""));
    let told: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(told["robot"], "frozen");
    assert_eq!(told["parts"][0]["links"], 8);
    assert_eq!(told["combine_notes"][0]["kind"], "gone");
    let (status, _, said) = urdd(&["combine", "nowhere.toml", "-o", "x"], folder.path());
    assert_eq!(status, 1);
    assert!(said.starts_with("urdd: nowhere.toml: cannot be read: "), "{said}");
}
