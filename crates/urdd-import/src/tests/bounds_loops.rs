//! What gearboxes and couplings may ask for: as in `bounds`.

use std::path::Path;

use super::bounds::{in_memory, long, mjcf, refused};
use crate::import;

/// A chain of links and what is between its first and its last, very often.
#[test]
fn gearboxes_of_long_chains() {
    let robot = |joints: usize, name: &str, gearboxes: usize| {
        let chain: String = (1..=joints)
            .map(|at| format!("<link name='l{at}'/><joint name='{name}{at}' type='revolute'><parent>l{}</parent><child>l{at}</child><axis><xyz>0 0 1</xyz></axis></joint>", at - 1))
            .collect();
        let axes = "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 0 1</xyz></axis2>";
        let ends = format!(
            "<parent>l1</parent><child>l{joints}</child><gearbox_reference_body>l0</gearbox_reference_body>"
        );
        let gearboxes: String = (0..gearboxes)
            .map(|at| format!("<joint name='g{at}' type='gearbox'>{ends}<gearbox_ratio>2</gearbox_ratio>{axes}</joint>\n"))
            .collect();
        format!(
            "<sdf version='1.10'><model name='m'><link name='l0'/>\n{chain}{gearboxes}</model></sdf>"
        )
    };
    let few = robot(40, "j", 10);
    let read = import(Path::new("/r.sdf"), &in_memory(&[("r.sdf", few.as_bytes())]));
    let read = read.expect("little").expect("an SDF");
    let toml = read.files.iter().find(|(path, _)| path.ends_with(".loops.toml"));
    let toml = std::str::from_utf8(toml.expect("a file").1).expect("text");
    assert_eq!(toml.matches("[[coupling]]").count(), 10);
    for (joints, name, count) in [(900, "j", 3000), (20, &*long(20_000), 1000)] {
        let text = robot(joints, name, count);
        let (line, _) = refused("r.sdf", &in_memory(&[("r.sdf", text.as_bytes())]));
        assert!(line > 2, "{line}");
    }
}

/// Couplings of one name: each looks for the first number that is free.
#[test]
fn couplings_of_one_name_are_numbered_in_one_pass() {
    let count = 40_000;
    let equalities: String = "<joint name=\"c\" joint1=\"j\"/>".repeat(count);
    let body = "<body name=\"b\"><joint name=\"j\"/><geom size=\"1\"/></body>";
    let text = mjcf("", body, &format!("<equality>{equalities}</equality>"));
    let read = import(Path::new("/r.xml"), &in_memory(&[("r.xml", text.as_bytes())]));
    let read = read.expect("linear").expect("an MJCF");
    let (_, toml) =
        read.files.iter().find(|(path, _)| path.ends_with(".loops.toml")).expect("a file");
    let toml = std::str::from_utf8(toml).expect("text");
    assert!(toml.contains("name = \"c\"\n") && toml.contains(&format!("name = \"c_{count}\"\n")));
}
