//! What an import carries beside its URDF is compared: whatever MJCF, SDF or USD can say, and the import knows.

use std::path::PathBuf;

use tempfile::TempDir;

use crate::{differences, places};

/// A robot of two joints. `joint`, `base`, `geom` and `end` are put where MJCF has such things.
struct Mjcf {
    joint: &'static str,
    base: &'static str,
    geom: &'static str,
    actuator: &'static str,
    end: &'static str,
}

const PLAIN: Mjcf = Mjcf { joint: "", base: "", geom: "", actuator: "kp='40' kv='2'", end: "" };

fn write(folder: &TempDir, name: &str, of: &Mjcf) -> PathBuf {
    let Mjcf { joint, base, geom, actuator, end } = of;
    let text = format!(
        "<mujoco model='m'><worldbody><body name='hull'>{base}<geom size='0.1' mass='2'/>\
         <body name='crank' pos='0 0 0.3'><joint name='turn' axis='0 1 0' range='-80 80' {joint}/>\
         <geom size='0.04' mass='1' {geom}/>\
         <body name='flap' pos='0 0 0.3'><joint name='swing' axis='1 0 0'/><geom size='0.04' mass='1'/></body>\
         </body></body></worldbody>\
         <actuator><position joint='turn' {actuator}/></actuator>{end}</mujoco>"
    );
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn each_thing_that_an_import_carries_is_named_where_it_differs() {
    let folder = TempDir::new().unwrap();
    let a = write(&folder, "a.xml", &PLAIN);
    assert!(differences(&a, &a).same);
    let cases: [(&str, Mjcf, &str); 9] = [
        ("gain", Mjcf { actuator: "kp='41' kv='2'", ..PLAIN }, "setup/actuators.joint.turn/kp"),
        ("damping", Mjcf { actuator: "kp='40' kv='3'", ..PLAIN }, "setup/actuators.joint.turn/kv"),
        (
            "armature",
            Mjcf { joint: "armature='0.2'", ..PLAIN },
            "setup/actuators.joint.turn/armature",
        ),
        ("base", Mjcf { base: "<freejoint/>", ..PLAIN }, "setup/base/added"),
        (
            "exclude",
            Mjcf { end: "<contact><exclude body1='flap' body2='hull'/></contact>", ..PLAIN },
            "srdf/disable_collisions flap - hull/added",
        ),
        (
            "key",
            Mjcf { end: "<keyframe><key name='up' qpos='0.1 0.2'/></keyframe>", ..PLAIN },
            "srdf/group_state up (all)/added",
        ),
        (
            "friction",
            Mjcf { geom: "friction='0.3'", ..PLAIN },
            "lost/coefficients of friction that differ/added",
        ),
        (
            "sensor",
            Mjcf { end: "<sensor><jointpos joint='turn'/></sensor>", ..PLAIN },
            "lost/sensors/added",
        ),
        ("spring", Mjcf { joint: "stiffness='3'", ..PLAIN }, "lost/springs of joints/added"),
    ];
    for (what, other, expected) in cases {
        let b = write(&folder, "b.xml", &other);
        for (from, to, word) in [(&a, &b, "added"), (&b, &a, "removed")] {
            let report = differences(from, to);
            let found = places(&report);
            let expected = expected.replace("added", word);
            assert!(found.contains(&expected), "{what}: {found:?}");
            assert!(!report.same, "{what}");
        }
    }
}

#[test]
fn positions_of_keyframes_and_gains_within_the_tolerance_are_equal() {
    let folder = TempDir::new().unwrap();
    let key = |name, end| write(&folder, name, &Mjcf { end, ..PLAIN });
    let a = key("a.xml", "<keyframe><key name='up' qpos='0.5 0.25'/></keyframe>");
    let b = key("b.xml", "<keyframe><key name='up' qpos='0.5 0.375'/></keyframe>");
    let found = places(&differences(&a, &b));
    assert_eq!(found, ["srdf/group_state up (all)/joint swing.value"]);
    let (a, b) = (crate::open(&a), crate::open(&b));
    assert!(urdd_diff::compare(&a, &b, 0.125).unwrap().same);
    assert!(!urdd_diff::compare(&a, &b, 0.0625).unwrap().same);
    assert!(urdd_diff::compare(&a, &b, -1.0).is_err());
    assert!(urdd_diff::compare(&a, &b, f64::NAN).is_err());
}

/// An import and its URDF with what stands beside it mean the same; without, they do not.
#[test]
fn a_urdf_has_what_stands_beside_it() {
    let folder = TempDir::new().unwrap();
    let urdf = "<robot name='m'><link name='a'/><link name='b'/><joint name='j' type='revolute'>\
        <parent link='a'/><child link='b'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>";
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let (a, b) = (write("a.urdf", urdf), write("b.urdf", urdf));
    let differ = || places(&differences(&a, &b));
    assert!(differ().is_empty());
    let srdf = |words: &str| format!("<robot name='m'>{words}</robot>");
    write("a.srdf", &srdf("<disable_collisions link1='a' link2='b' reason='Never'/>"));
    assert_eq!(differ(), ["srdf/disable_collisions a - b/removed"]);
    // The order of a pair, and of elements and attributes, is of no meaning; how a number is written is of none.
    let state = |value| {
        format!("<group_state group='g' name='s'><joint name='j' value='{value}'/></group_state>")
    };
    let pair = "<disable_collisions reason='Never' link2='a' link1='b'/>";
    write("b.srdf", &srdf(&format!("{pair}{}", state("0.50"))));
    let pair = "<disable_collisions link1='a' link2='b' reason='Never'/>";
    write("a.srdf", &srdf(&format!("{}{pair}", state("5e-1"))));
    assert_eq!(differ(), Vec::<String>::new());
    // A word that nobody knows.
    write("a.srdf", &srdf(&format!("{}{pair}<future name='x' strength='1'/>", state("5e-1"))));
    write("b.srdf", &srdf(&format!("{}{pair}<future name='x' strength='2'/>", state("5e-1"))));
    assert_eq!(differ(), ["srdf/future x/strength"]);
    write("b.srdf", &srdf(&format!("{}{pair}<future name='x' strength='1'/>", state("5e-1"))));
    write("a.export.toml", "robot = 'm'\n[base]\nfloating = false\n[actuators.joint.j]\nkp = 3\n");
    assert_eq!(differ(), ["setup/actuators.joint.j/removed", "setup/robot/removed"]);
    write("b.export.toml", "robot = 'm'\nactuators.joint.j.kp = 3.0\n[frames]\ntools = []\n");
    assert_eq!(differ(), Vec::<String>::new());
    write("b.export.toml", "robot = 'm'\nactuators.joint.j.kp = 3.0\n[new]\nword = [1, 2]\n");
    assert_eq!(differ(), ["setup/new/added"]);
}

#[test]
fn what_cannot_be_read_is_a_note() {
    let folder = TempDir::new().unwrap();
    let urdf = "<robot name='m'><link name='a'/></robot>";
    let write = |name: &str, text: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let (a, b) = (write("a.urdf", urdf.as_bytes()), write("b.urdf", urdf.as_bytes()));
    for (name, text) in [
        ("a.srdf", &b"<robot"[..]),
        ("a.srdf", b"\xff"),
        ("a.export.toml", b"robot = "),
        ("a.export.toml", b"\xff\xfe"),
    ] {
        write(name, text);
        let report = differences(&a, &b);
        assert!(report.same);
        let note = |note: &String| note.starts_with("A: the ") && note.contains("is not compared");
        assert!(report.notes.iter().any(note), "{name}: {:?}", report.notes);
        std::fs::remove_file(folder.path().join(name)).unwrap();
    }
}

/// Each path has the names above it: what a small file would make is charged to it.
#[test]
fn paths_of_long_names_are_not_multiplied() {
    let folder = TempDir::new().unwrap();
    let (name, urdf) = ("n".repeat(100_000), "<robot name='m'><link name='a'/></robot>");
    let many: String = (0..4000).map(|k| format!("<c{k}/>")).collect();
    let keys: String = (0..4000).map(|k| format!("k{k} = {{ x = {{ y = 1 }} }}\n")).collect();
    for (at, file, text) in [
        ("srdf", "m.srdf", format!("<robot name='m'><x><{name}>{many}</{name}></x></robot>")),
        ("toml", "m.export.toml", format!("[{name}]\n{keys}")),
    ] {
        let own = folder.path().join(at);
        std::fs::create_dir(&own).unwrap();
        std::fs::write(own.join("m.urdf"), urdf).unwrap();
        std::fs::write(own.join(file), text).unwrap();
        let path = own.join("m.urdf");
        let report = differences(&path, &path);
        let refused = |note: &String| note.contains("is not compared") && note.contains("more");
        assert!(report.notes.iter().any(refused), "{at}: {:?}", report.notes);
    }
}
