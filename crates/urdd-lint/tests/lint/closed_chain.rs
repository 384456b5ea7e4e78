//! How far apart the ends of a loop are, by the geometry of a four-bar: all bars are 0.2 m long.

use std::fs;

use super::linted;
use urdd_format::report::Verdict;
use urdd_lint::LintSettings;

const OPEN: &str = include_str!("../cases/LNT066/invalid.urdf");
/// Of the case: a pin 0.01 m short of the rocker's end.
const SHORT: &str = "<successor link=\"rocker\"><origin xyz=\"0.19 0 0\"/></successor>";

/// What LNT066 says of the four-bar with another second end, and with this in place of its loop's type.
fn said(end: &str, kind: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("four_bar.urdf");
    let text = OPEN.replace(SHORT, end).replace("\"pin\" type=\"revolute\"", kind);
    fs::write(&file, text).expect("written");
    let findings = linted(&file, &LintSettings::default()).report.urdds.remove(0).findings;
    let mut of_loop = findings.into_iter().filter(|finding| finding.code == "LNT066");
    of_loop.next().expect("a finding").message
}

#[test]
fn gaps_are_those_of_the_geometry() {
    let revolute = "\"pin\" type=\"revolute\"";
    let end = |origin: &str| format!("<successor link=\"rocker\">{origin}</successor>");
    let tree = "no program keeps 1 loop of the robot: 3 joints move by themselves, of which 1 is `independent`";
    let advice = "; close the chain in the program's own format";
    let expected = |gap: &str| match gap {
        "" => format!("{tree}{advice}"),
        gap => format!(
            "{tree}; in the default configuration, the ends of `pin` are {gap} apart{advice}"
        ),
    };
    assert_eq!(said(SHORT, revolute), expected("0.01 m"));
    assert_eq!(said(&end("<origin xyz=\"0.2 0 0\"/>"), revolute), expected(""));
    // A turn about the axis is what a revolute pin allows; one about another axis opens it.
    let about_axis = end("<origin xyz=\"0.2 0 0\" rpy=\"0 0 0.5\"/>");
    assert_eq!(said(&about_axis, revolute), expected(""));
    let tilted = end("<origin xyz=\"0.2 0 0\" rpy=\"0.25 0 0\"/>");
    assert_eq!(said(&tilted, revolute), expected("0.25 rad"));
    // The rod lies along x, the rocker along y: a quarter of a turn between their frames.
    assert_eq!(said(&about_axis, "\"pin\" type=\"fixed\""), expected("2.07 rad"));
    assert_eq!(said(&tilted, "\"pin\" type=\"spherical\""), expected(""));
    // A slide along z leaves what is across, and does not turn.
    let raised = end("<origin xyz=\"0.17 0 0.3\" rpy=\"0 0 -1.5707963267948966\"/>");
    assert_eq!(said(&raised, "\"pin\" type=\"prismatic\""), expected("0.03 m"));
    assert_eq!(said(&raised, "\"pin\" type=\"spherical\""), expected("0.301 m"));
    // A loop with a fault has no gap: `urdd generate` says what is wrong with it.
    let no_axis = format!("{SHORT}<axis xyz=\"0 0 0\"/>");
    assert!(said(&no_axis, "\"pin\" type=\"prismatic\"").contains("this axis has no direction"));
}

/// What LNT066 says of a file of this name; others are beside it.
fn said_of(name: &str, files: &[(&str, &str)]) -> Vec<String> {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("written");
    }
    let file = folder.path().join(name);
    let linted = linted(&file, &LintSettings::default()).report.urdds.remove(0);
    assert_ne!(linted.verdict, Verdict::Incomplete, "{:?}", linted.reason);
    let findings = linted.findings;
    let of_loop = findings.into_iter().filter(|finding| finding.code == "LNT066");
    of_loop.map(|finding| finding.message).collect()
}

#[test]
fn loops_beside_a_urdf_are_told_where_they_are_open() {
    let (head, tail) = OPEN.split_once("<loop").expect("a loop");
    let (_, tail) = tail.split_once("</loop>").expect("its end");
    let tree = &*format!("{head}{tail}");
    let toml = |end: f64| {
        format!(
            "[[loop]]\nname = \"pin\"\nkind = \"Spherical\"\nlink_a = \"rod\"\nframe_a = {{ xyz = [0.2, 0.0, 0.0] }}\nlink_b = \"rocker\"\nframe_b = {{ xyz = [{end:?}, 0.0, 0.0] }}\n"
        )
    };
    let open = "in the default configuration, the ends of `pin` are 0.01 m apart; begin in a closed one, which `urdd generate` looks for";
    let four_bar = |end| said_of("a.urdf", &[("a.urdf", tree), ("a.loops.toml", &toml(end))]);
    assert_eq!(four_bar(0.19), [open]);
    assert_eq!(four_bar(0.2), [""; 0]);
    // MuJoCo keeps a chain closed, where it is closed to begin with.
    let mjcf = |end: f64| {
        format!(
            r#"<mujoco model="m"><compiler angle="radian"/><worldbody><body name="base"><geom size="0.02" mass="1"/>
<body name="crank"><joint axis="0 0 1"/><geom size="0.01" mass="1"/><body name="rod" pos="0 0.2 0"><joint axis="0 0 1"/><geom size="0.01" mass="1"/>
<site name="a" pos="0.2 0 0"/></body></body><body name="rocker" pos="0.2 0 0"><joint axis="0 0 1"/><geom size="0.01" mass="1"/><site name="b" pos="0 {end} 0"/></body>
</body></worldbody><equality><connect name="pin" site1="a" site2="b"/></equality></mujoco>"#
        )
    };
    assert_eq!(said_of("m.xml", &[("m.xml", &mjcf(0.19))]), [open]);
    assert_eq!(said_of("m.xml", &[("m.xml", &mjcf(0.2))]), [""; 0]);
}

#[test]
fn what_is_no_loop_is_told_where_it_is() {
    let told = |from: &str, to: &str| {
        assert!(OPEN.contains(from), "{from}");
        said_of("a.urdf", &[("a.urdf", &OPEN.replace(from, to))])
    };
    let left_out = |said: &[String], words: &str| {
        let of = |message: &&String| message.starts_with("`urdd generate` leaves this out: ");
        let found: Vec<&String> = said.iter().filter(of).collect();
        assert!(found.len() == 1 && found[0].contains(words), "{said:?}");
    };
    left_out(
        &told("type=\"revolute\">\n    <predecessor", "type=\"revolut\">\n    <predecessor"),
        "revolut",
    );
    // A file beside the URDF that cannot be read.
    let broken = said_of("a.urdf", &[("a.urdf", OPEN), ("a.loops.toml", "foo")]);
    let refused = |message: &String| {
        message.starts_with("`urdd generate` refuses the robot, for what says its loops: ")
    };
    assert_eq!(broken.iter().filter(|message| refused(message)).count(), 1, "{broken:?}");
    assert!(told("rod_turns", "rod_turn").iter().all(|message| message.starts_with("no program")));
}
