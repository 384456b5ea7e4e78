//! What is written has names that every program takes.

use std::path::Path;

use crate::import;

/// The URDF of a model, which is a robot.
fn urdf(inside: &str, files: &[(&str, &str)]) -> String {
    let text = format!("<sdf version='1.9'><model name='m'>{inside}</model></sdf>");
    let all: Vec<(&str, &str)> = [("m.sdf", &*text)].into_iter().chain(files.to_vec()).collect();
    let settings = super::memory(&all);
    let imported = import(Path::new("/m.sdf"), &settings).expect("an import").expect("an SDF");
    let inner = imported.settings(&settings).expect("files");
    imported.load(&inner).expect("a robot");
    imported.text().to_owned()
}

#[test]
fn names_of_nested_models_have_no_colons() {
    let text = urdf(
        "<link name='a'/><model name='n'><link name='b'/><frame name='f'/><model name='o'><link name='c'/></model>\
         <joint name='k' type='fixed'><parent>b</parent><child>o::c</child></joint></model>\
         <joint name='j' type='fixed'><parent>a</parent><child>n::b</child></joint>",
        &[],
    );
    assert!(!text.contains("::"), "{text}");
    let old = "<sdf version='1.7'><model name='m'><link name='a'/><model name='n::o'><link name='b'/></model></model></sdf>";
    let model = super::given(old, &[]).expect("a model");
    assert_eq!(super::body(&model, "n/o/b").name, "n/o/b");
    for name in
        ["link name=\"n/b\"", "link name=\"n/o/c\"", "joint name=\"n/k\"", "link name=\"n/f\""]
    {
        assert!(text.contains(name), "{name}: {text}");
    }
}

#[test]
fn names_that_would_become_one_are_told_apart() {
    let fixed = |name: &str, parent: &str, child: &str| {
        format!(
            "<joint name='{name}' type='fixed'><parent>{parent}</parent><child>{child}</child></joint>"
        )
    };
    let inner = format!("<link name='b'/><link name='c'/>{}", fixed("j", "b", "c"));
    let outer = fixed("n/j", "n/b", "n::b");
    let text = urdf(&format!("<link name='n/b'/><model name='n'>{inner}</model>{outer}"), &[]);
    for name in ["link name=\"n/b_2\"", "joint name=\"n/j\"", "joint name=\"n/j_2\""] {
        assert!(text.contains(name), "{name}: {text}");
    }
}

#[test]
fn shapes_have_names_of_their_own() {
    let shape = |kind: &str, geometry: &str| {
        format!("<{kind} name='c'><geometry>{geometry}</geometry></{kind}>")
    };
    let (sphere, capsule) = (
        "<sphere><radius>1</radius></sphere>",
        "<capsule><radius>1</radius><length>1</length></capsule>",
    );
    let link = |name: &str, geometry: &str| {
        format!(
            "<link name='{name}'>{}{}</link>",
            shape("visual", geometry),
            shape("collision", geometry)
        )
    };
    let joint = |child: &str| {
        format!(
            "<joint name='j{child}' type='fixed'><parent>a</parent><child>{child}</child></joint>"
        )
    };
    let text = urdf(
        &(link("a", sphere) + &link("b", capsule) + &link("d", sphere) + &joint("b") + &joint("d")),
        &[],
    );
    for kind in ["visual", "collision"] {
        for name in ["c", "b/c", "b/c_top", "b/c_bottom", "d/c"] {
            let found = text.matches(&format!("<{kind} name=\"{name}\">")).count();
            assert_eq!(found, 1, "{kind} {name}: {text}");
        }
    }
}

#[test]
fn materials_have_names_of_their_own() {
    let gif = "GIF89a\u{1}\0\u{1}\0\0\0\0\0\0\0";
    let visual = |name: &str, map: &str| {
        let map = if map.is_empty() {
            String::new()
        } else {
            format!("<pbr><metal><albedo_map>{map}</albedo_map></metal></pbr>")
        };
        format!(
            "<visual name='{name}'><geometry><sphere><radius>1</radius></sphere></geometry>\
             <material><diffuse>1 0 0 1</diffuse>{map}</material></visual>"
        )
    };
    let all = visual("u", "")
        + &visual("v", "x.gif")
        + &visual("w", "y.gif")
        + &visual("x", "x.gif")
        + &visual("y", "");
    let text = urdf(&format!("<link name='a'>{all}</link>"), &[("x.gif", gif), ("y.gif", gif)]);
    let names: Vec<&str> =
        text.lines().filter_map(|line| line.trim().strip_prefix("<material name=\"")).collect();
    let plain = "rgba 1 0 0 1";
    let wanted = [
        plain.to_owned(),
        format!("{plain}_2"),
        format!("{plain}_3"),
        format!("{plain}_2"),
        plain.to_owned(),
    ];
    assert_eq!(names.len(), 5);
    for (name, wanted) in names.iter().zip(wanted) {
        assert_eq!(name.split('"').next(), Some(&*wanted), "{text}");
    }
}
