//! What is refused, with its place.

use super::{given, inside};
use crate::tests::Entries as _;

#[track_caller]
fn refused(version: &str, text: &str, wanted: &str) {
    let fault = inside(version, text).expect_err("refused");
    let said = fault.fault.to_string();
    assert!(said.contains(wanted), "{said}");
    assert_eq!((&*fault.file, fault.line), ("robot.sdf", 1));
}

#[test]
fn names_without_a_meaning_are_refused() {
    let at =
        |name: &str| format!("<link name='a'><pose relative_to='{name}'>0 0 0 0 0 0</pose></link>");
    refused("1.9", &at("nobody"), "`relative_to` names `nobody`, which is no link");
    refused("1.9", &at("world"), "`relative_to` names `world`");
    refused("1.9", "<link name='a'/><link name='a'/>", "two links of a model");
    refused("1.9", "<link/>", "`<link>` has no name");
    refused("1.9", "<link name='world'/>", "is the name of the world");
    refused("1.9", "<frame name='f'/>", "has no link");
    refused("2.0", "<link name='a'/>", "version `2.0` is not read");
}

#[test]
fn circles_are_refused() {
    let frame = |name: &str, to: &str| {
        format!("<frame name='{name}' attached_to='{to}'/><link name='{name}l'/>")
    };
    let circle = frame("a", "b") + &frame("b", "c") + &frame("c", "a");
    refused("1.9", &circle, "refers to itself");
    let poses = "<link name='a'><pose relative_to='b'/></link><link name='b'><pose relative_to='a'/></link>";
    refused("1.9", poses, "refers to itself");
    let placed = "<link name='a'/><model name='n' placement_frame='f'><link name='l'/><frame name='f'>\
                  <pose relative_to='g'/></frame><frame name='g'><pose relative_to='f'/></frame></model>";
    refused("1.9", placed, "refers to itself");
    let file = "<sdf version='1.9'><model name='m'><link name='a'/><include><uri>b.sdf</uri></include></model></sdf>";
    let fault = given(file, &[("b.sdf", file)]).expect_err("a circle");
    assert!(fault.fault.to_string().contains("includes itself"), "{}", fault.fault);
}

#[test]
fn numbers_that_are_none_are_refused() {
    let pose = |text: &str| format!("<link name='a'><pose>{text}</pose></link>");
    refused("1.9", &pose("0 0 0 0 0"), "six finite numbers");
    refused("1.9", &pose("0 0 0 0 0 nan"), "not a number");
    refused("1.9", &pose("0 0 0 0 0 inf"), "six finite numbers");
    let shape = "<link name='a'><visual name='v'><geometry><sphere><radius>-1</radius></sphere></geometry></visual></link>";
    refused("1.9", shape, "at least 0");
}

#[test]
fn files_that_are_not_there_or_outside_are_refused() {
    let include = "<link name='a'/><include><uri>model://nothing</uri></include>";
    refused("1.9", include, "`model://nothing` was not found");
    let pass = "<link name='a'/><include><uri>/etc/passwd</uri></include>";
    refused("1.9", pass, "was not found");
}

#[test]
fn what_is_no_mesh_and_no_image_is_not_carried() {
    let text = "<sdf version='1.9'><model name='m'><link name='a'><visual name='v'><geometry><mesh><uri>b.obj</uri>\
                </mesh></geometry><material><pbr><metal><albedo_map>key.env</albedo_map></metal></pbr></material>\
                </visual></link></model></sdf>";
    let mesh = "mtllib key.env\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let model = given(text, &[("b.obj", mesh), ("key.env", "secret")]).expect("a model");
    let paths: Vec<&str> = model.assets.iter().map(|asset| &*asset.path).collect();
    assert_eq!(paths, ["meshes/b.obj"]);
    assert_eq!(model.tally.remarks.len(), 1);
    assert!(model.tally.remarks[0].text.contains("`key.env` is not an image; it is left out"));
}

#[test]
fn depth_is_bounded() {
    let deep = "<model name='n'>".repeat(100) + "<link name='a'/>" + &"</model>".repeat(100);
    refused("1.9", &deep, "nested more than 64 deep");
}

#[test]
fn included_files_are_bounded() {
    // Each file includes the next ten times.
    let names: Vec<String> = (0..20).map(|at| format!("{at}.sdf")).collect();
    let include = |next: &str| {
        let all: String = (0..10)
            .map(|at| format!("<include><uri>{next}</uri><name>n{at}</name></include>"))
            .collect();
        format!("<sdf version='1.9'><model name='m'><link name='a'/>{all}</model></sdf>")
    };
    let leaf = "<sdf version='1.9'><model name='m'><link name='a'/></model></sdf>".to_owned();
    let includes = (1..20).map(|at| include(&format!("{at}.sdf")));
    let texts: Vec<String> = includes.chain([leaf]).collect();
    let files: Vec<(&str, &str)> =
        names.iter().zip(&texts).map(|(name, text)| (&**name, &**text)).collect();
    let fault = given(&include("0.sdf"), &files).expect_err("too many");
    assert!(fault.fault.to_string().contains("needs more memory or work"), "{}", fault.fault);
}
