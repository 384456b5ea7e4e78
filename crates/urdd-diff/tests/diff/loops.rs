//! Differences of loops: each is named once, whoever says them.

use std::fs;
use std::path::Path;

use super::{differences, places};
use urdd_generate::{Settings, generate};

const LOOP: &str = r#"<loop name="pin" type="revolute"><predecessor link="coupler"><origin xyz="0.3 0 0"/></predecessor>
<successor link="rocker"><origin xyz="0.1 0 0"/></successor><axis xyz="0 0 1"/></loop>"#;

/// A parallelogram; its rocker follows. `closed` is what URDF+ says of it.
fn parallelogram(closed: &str) -> String {
    let joint = |name: &str, parent: &str, child: &str, x: f64, more: &str| {
        format!(
            r#"<joint name="{name}" type="continuous"{more}><parent link="{parent}"/><child link="{child}"/><origin xyz="{x} 0 0"/><axis xyz="0 0 1"/></joint>"#
        )
    };
    let follows = if closed.is_empty() { "" } else { r#" independent="false""# };
    [
        r#"<robot name="p"><link name="ground"/><link name="crank"/><link name="coupler"/><link name="rocker"/>"#,
        &joint("a", "ground", "crank", 0.0, ""),
        &joint("b", "crank", "coupler", 0.1, follows),
        &joint("c", "ground", "rocker", 0.3, follows),
        closed,
        "</robot>",
    ]
    .concat()
}

fn toml(at: f64, independent: &str) -> String {
    format!(
        "independent = [\"{independent}\"]\n[[loop]]\nname = \"pin\"\nkind = \"Revolute\"\nlink_a = \"coupler\"\nframe_a = {{ xyz = [0.3, 0.0, 0.0] }}\nlink_b = \"rocker\"\nframe_b = {{ xyz = [{at:?}, 0.0, 0.0] }}\n"
    )
}

fn write(folder: &Path, name: &str, urdf: &str, loops: Option<&str>) -> std::path::PathBuf {
    let folder = folder.join(name);
    fs::create_dir_all(&folder).expect("a folder");
    fs::write(folder.join("p.urdf"), urdf).expect("a URDF");
    if let Some(loops) = loops {
        fs::write(folder.join("p.loops.toml"), loops).expect("its loops");
    }
    folder.join("p.urdf")
}

#[test]
fn loops_of_urdfs_and_urdds_are_compared() {
    let folder = tempfile::tempdir().expect("a folder");
    let made = |name: &str, urdf: &str, loops: Option<&str>| {
        let urdf = write(folder.path(), name, urdf, loops);
        let urdd = folder.path().join(format!("{name}_urdd"));
        generate(&urdf, &urdd, &Settings::default(), &()).expect("a URDD");
        [urdf, urdd]
    };
    let plus = made("plus", &parallelogram(LOOP), None);
    let moved = made("moved", &parallelogram(&LOOP.replace("0.1 0 0", "0.12 0 0")), None);
    let tree = parallelogram("");
    let beside = made("beside", &tree, Some(&toml(0.1, "a")));
    let other = made("other", &tree, Some(&toml(0.1, "c")));
    let bare = made("bare", &tree, None);
    let found = |a: &Path, b: &Path| places(&differences(a, b));

    // A frame is a difference of the loop alone; the closed configurations follow from it.
    for (a, b) in plus.iter().zip(&moved) {
        assert_eq!(found(a, b), ["loops/loop pin/frame_b.position"]);
    }
    // Which DOFs move freely.
    for (a, b) in beside.iter().zip(&other) {
        assert_eq!(found(a, b), ["loops/DOFs that move freely/a", "loops/DOFs that move freely/c"]);
    }
    // A URDD says what its source says.
    assert_eq!(found(&plus[0], &plus[1]), [""; 0]);
    assert_eq!(found(&beside[0], &beside[1]), [""; 0]);
    // What a joint of URDF+ says of it is no difference of the joint.
    let crank = |joint: &str| {
        let urdf = parallelogram(LOOP).replace(r#" independent="false""#, "");
        let this = format!(r#"<joint name="{joint}" type="continuous""#);
        urdf.replace(&this, &format!(r#"{this} independent="false""#))
    };
    let (a, b) = (made("not_a", &crank("a"), None), made("not_b", &crank("b"), None));
    assert_eq!(
        found(&a[0], &b[0]),
        ["loops/DOFs that move freely/b", "loops/DOFs that move freely/a"]
    );
    // The same loop, in the URDF and beside it.
    let elsewhere = found(&plus[0], &beside[0]);
    assert!(elsewhere.iter().all(|place| place.starts_with("joints/")), "{elsewhere:?}");
    // One that is not there any more.
    assert_eq!(found(&beside[0], &bare[0]), ["loops/loop pin/removed"]);
    // The two links that it connects are not skipped any more.
    let gone = found(&beside[1], &bare[1]);
    let modules = ["link_shapes_skips_module/changed", "loops_module/removed"];
    assert_eq!(
        gone,
        [
            vec!["loops/loop pin/removed".to_owned()],
            modules.map(|of| format!("modules/{of}")).to_vec()
        ]
        .concat()
    );
}

#[test]
fn couplings_are_compared_by_joint() {
    let folder = tempfile::tempdir().expect("a folder");
    let gear = |ratio: f64| {
        format!("[[coupling]]\nname = \"gear\"\nterms = {{ a = [{ratio:?}], c = [-1.0] }}\n")
    };
    let one = write(folder.path(), "one", &parallelogram(""), Some(&gear(2.0)));
    let other = write(folder.path(), "other", &parallelogram(""), Some(&gear(2.5)));
    assert_eq!(places(&differences(&one, &other)), ["loops/coupling gear/a"]);
}
