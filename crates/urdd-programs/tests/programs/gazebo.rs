//! What tells the versions of Gazebo apart, each case given to libsdformat 12.3.0, 14.9.0 and 16.1.0.

use urdd_programs::{Deed, Effects, File, Mesh, Program};
use urdd_xml::{Counted, Kind};

/// A robot of links, each with its mass, and of joints: their type, ends and what is in them.
fn robot(links: &[(&str, &str)], joints: &[(&str, &str, [&str; 2], &str)]) -> String {
    let links = links.iter().map(|(name, mass)| {
        let inertia = r#"<inertia ixx="1e-9" ixy="0" ixz="0" iyy="1e-9" iyz="0" izz="1e-9"/>"#;
        let inertial = format!(r#"<inertial><mass value="{mass}"/>{inertia}</inertial>"#);
        let inertial = if mass.is_empty() { "" } else { &inertial };
        format!(r#"<link name="{name}">{inertial}</link>"#)
    });
    let joints = joints.iter().map(|(name, kind, [parent, child], inside)| {
        let limit = r#"<limit lower="-1" upper="1" effort="1" velocity="1"/>"#;
        let ends = format!(r#"<parent link="{parent}"/><child link="{child}"/>"#);
        format!(r#"<joint name="{name}" type="{kind}">{ends}{limit}{inside}</joint>"#)
    });
    format!("<robot name=\"arm\">{}</robot>", links.chain(joints).collect::<String>())
}

/// What Fortress does, and what Harmonic and Jetty do: whether they load it, and the parts that they leave out.
fn done(text: &str) -> [(bool, Vec<String>); 2] {
    let read = |program: Program| {
        let counted = Counted::new(text.as_bytes(), Kind::Robot).unwrap();
        let effects: Effects = program.read(&File::new(counted, &|_| Mesh::Missing));
        let dropped = effects.kept().iter().filter(|effect| effect.deed == Deed::Drops);
        let parts = dropped.map(|effect| effect.part.to_string()).collect();
        (effects.loads(), parts)
    };
    let [fortress, harmonic, jetty] =
        [Program::Fortress, Program::Harmonic, Program::Jetty].map(read);
    assert_eq!(harmonic, jetty);
    [fortress, harmonic]
}

fn parts<const N: usize>(loads: bool, parts: [&str; N]) -> (bool, Vec<String>) {
    (loads, parts.map(str::to_owned).into())
}

#[test]
fn mimics_are_read_from_fourteen_on() {
    let links = [("base", "1"), ("a", "1"), ("b", "1")];
    let turns = |mimic: &str| {
        let mimic = format!("<mimic joint=\"{mimic}\" multiplier=\"2\"/>");
        let joints =
            [("j", "revolute", ["base", "a"], ""), ("k", "revolute", ["a", "b"], mimic.as_str())];
        done(&robot(&links, &joints))
    };
    assert_eq!(turns("j"), [parts(true, ["joint/k/mimic"]), parts(true, [])]);
    // One that follows itself, nothing, or what is not there.
    assert_eq!(turns("k"), [parts(true, ["joint/k/mimic"]), parts(false, [])]);
    assert_eq!(turns(""), [parts(true, ["joint/k/mimic"]), parts(false, [])]);
    assert_eq!(turns("no"), [parts(true, ["joint/k/mimic"]), parts(false, [])]);
    // One that follows a joint that is merged.
    let mimic = r#"<mimic joint="j"/>"#;
    let joints = [("j", "fixed", ["base", "a"], ""), ("k", "revolute", ["a", "b"], mimic)];
    assert_eq!(done(&robot(&links, &joints)).map(|(loads, _)| loads), [true, false]);
    let text = robot(&links, &joints);
    let counted = Counted::new(text.as_bytes(), Kind::Robot).unwrap();
    let effects = Program::Jetty.read(&File::new(counted, &|_| Mesh::Missing));
    let why = effects.kept().iter().find(|effect| effect.deed == Deed::Refuses).unwrap();
    assert_eq!(why.fault.to_string(), "the joint that it follows is fixed, or left out");
    assert!(why.fault.advice().starts_with("let it follow a joint that moves"));
    let kept =
        r#"<gazebo reference="j"><preserveFixedJoint>1</preserveFixedJoint></gazebo></robot>"#;
    let text = robot(&links, &joints).replace("</robot>", kept);
    assert_eq!(done(&text), [parts(true, ["joint/k/mimic"]), parts(true, [])]);
}

#[test]
fn names_are_without_scopes_from_fourteen_on() {
    let of = |links: &[(&str, &str)], ends| done(&robot(links, &[("j", "revolute", ends, "")]));
    let scoped = of(&[("base", "1"), ("a::b", "1")], ["base", "a::b"]);
    assert_eq!(scoped, [parts(true, []), parts(false, [])]);
    let plain = robot(&[("base", "1")], &[]);
    let with = |inside: &str| done(&plain.replace("</robot>", &format!("{inside}</robot>")));
    let sensor = r#"<gazebo reference="base"><sensor name="a::b" type="imu"/></gazebo>"#;
    assert_eq!(with(sensor), [parts(true, []), parts(false, [])]);
    let plugin = r#"<gazebo><plugin name="a::b" filename="f"><p name="c::d"/></plugin></gazebo>"#;
    assert_eq!(with(plugin), [parts(true, []), parts(true, [])]);
    let shape =
        r#"</inertial><visual name="a::b"><geometry><sphere radius="1"/></geometry></visual>"#;
    let text = plain.replace("</inertial>", shape);
    assert_eq!(done(&text), [parts(true, []), parts(false, [])]);
    // `true` was read as a number.
    let named = of(&[("1", "1"), ("true", "1")], ["1", "true"]).map(|(loads, _)| loads);
    assert_eq!(named, [false, true]);
}

#[test]
fn what_is_merged_stays_as_frames_which_need_names() {
    let of = |joint, link| {
        done(&robot(&[("base", "1"), (link, "1")], &[(joint, "fixed", ["base", link], "")]))
    };
    assert_eq!(of("flange", "tool").map(|(loads, _)| loads), [true, true]);
    assert_eq!(of("tool", "tool").map(|(loads, _)| loads), [true, false]);
    assert_eq!(of("base", "tool").map(|(loads, _)| loads), [true, false]);
    assert_eq!(of("flange", "world").map(|(loads, _)| loads), [true, false]);
    assert_eq!(of("a::b", "tool").map(|(loads, _)| loads), [true, false]);
}

#[test]
fn a_link_without_mass_that_is_merged_keeps_those_below() {
    let joints = [("j", "fixed", ["base", "plate"], ""), ("k", "revolute", ["plate", "tip"], "")];
    let [fortress, later] = done(&robot(&[("base", "1"), ("plate", ""), ("tip", "1")], &joints));
    assert_eq!(fortress, parts(true, ["joint/j", "link/tip", "joint/k"]));
    assert_eq!(later, parts(true, ["joint/j"]));
}

#[test]
fn a_small_mass_is_one_from_fourteen_on() {
    let joints = [("j", "revolute", ["base", "tip"], "")];
    let of = |mass| done(&robot(&[("base", "1"), ("tip", mass)], &joints));
    let gone = || parts(true, ["link/tip", "joint/j"]);
    assert_eq!(of("1e-7"), [gone(), parts(true, [])]);
    assert_eq!(of("0"), [gone(), gone()]);
    assert_eq!(of("-1"), [parts(false, []), gone()]);
}

#[test]
fn a_link_world_is_lost_only_with_what_is_in_it() {
    let joints = [("j", "fixed", ["world", "base"], "")];
    let of = |mass| done(&robot(&[("world", mass), ("base", "1")], &joints));
    assert_eq!(of(""), [parts(true, []), parts(true, [])]);
    assert_eq!(of("1").map(|(_, parts)| parts), [["link/world"], ["link/world"]]);
}

#[test]
fn a_frame_needs_its_link() {
    let links = [("base", "1"), ("wrist", ""), ("tool", "")];
    let joints = [("j", "revolute", ["base", "wrist"], ""), ("k", "fixed", ["wrist", "tool"], "")];
    let [fortress, later] = done(&robot(&links, &joints));
    assert_eq!(fortress, parts(true, ["link/wrist", "joint/j", "joint/k"]));
    assert_eq!(later, parts(false, []));
}
