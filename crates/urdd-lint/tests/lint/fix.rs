//! Fixes mend what they say, once, and change nothing else.

use std::fs;
use std::path::Path;

use super::cases::{cases, copied};
use super::{SLIDE, codes, linted, written};
use urdd_lint::{LintSettings, mend, rules};

#[test]
fn a_fix_mends_the_fault_and_the_second_time_nothing_is_left() {
    let mut mended_by = Vec::new();
    for rule in rules::all() {
        let code = rule.description.code;
        for case in cases(code, "invalid") {
            let (_folder, file) = copied(&case);
            let mut settings = LintSettings::default();
            settings.report.severities.insert(code, rule.description.severity);
            let mended = mend(std::slice::from_ref(&file), &settings, false).expect("it");
            let Some(mended) = mended.into_iter().next() else {
                continue;
            };
            mended_by.push(code.as_str());
            let before = fs::read_to_string(&file).expect("it");
            assert_eq!(before, mended.before, "nothing is written");
            fs::write(&file, &mended.after).expect("written");
            let left = codes(&linted(&file, &settings));
            assert!(!left.contains(&code.as_str().to_owned()), "{}: {left:?}", case.display());
            let again = mend(std::slice::from_ref(&file), &settings, false).expect("it");
            assert_eq!(again, [], "{}", case.display());
        }
    }
    assert!(mended_by.contains(&"LNT012"), "{mended_by:?}");
}

#[test]
fn every_other_byte_stays() {
    let text = format!("\u{feff}<!-- \u{1F916} -->\n{SLIDE}").replace('\n', "\r\n");
    let (_folder, file) = written(&text);
    let mended = mend(std::slice::from_ref(&file), &LintSettings::default(), false).expect("it");
    let [mended] = &mended[..] else {
        panic!("{mended:?}");
    };
    let (start, end) = text.split_once("0 0 1.01").expect("it");
    assert!(mended.after.starts_with(start) && mended.after.ends_with(end), "{}", mended.after);
    let axis = &mended.after[start.len()..mended.after.len() - end.len()];
    let axis: Vec<f64> = axis.split(' ').map(|x| x.parse().expect("a number")).collect();
    assert_eq!(axis, [0.0, 0.0, 1.0]);
    assert_eq!(mended.places, 1);
    let target = mended.target.clone().expect("nothing forbids it");
    mended.check(&target).expect("unchanged");
    fs::write(&file, SLIDE).expect("written");
    assert!(mended.check(&target).is_err(), "somebody wrote to it");
}

#[test]
fn what_is_allowed_or_ignored_is_not_mended() {
    let allowed = SLIDE.replace("<axis", "<!-- urdd: allow LNT012 --><axis");
    let (_folder, file) = written(&allowed);
    let of = |file: &Path, settings: &LintSettings| {
        mend(&[file.to_owned()], settings, false).expect("it")
    };
    assert_eq!(of(&file, &LintSettings::default()), []);
    let (_folder, file) = written(SLIDE);
    let mut settings = LintSettings::default();
    settings.report.selection.ignore = vec!["LNT012".parse().expect("a code")];
    assert_eq!(of(&file, &settings), []);
}

/// What the fixes make of a text, if they change it. `files` are beside it.
fn mended(text: &str, files: &[&str]) -> Option<String> {
    let (folder, file) = written(text);
    for name in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, include_bytes!("../cases/LNT027/meshes/box.stl")).expect("written");
    }
    let mended = mend(&[file], &LintSettings::default(), false).expect("it");
    mended.into_iter().next().map(|mended| mended.after)
}

#[test]
fn a_misspelt_attribute_is_mended_where_it_can_mean_one_thing() {
    let arm = include_str!("../cases/LNT040/near_miss.urdf");
    let with = |from: &str, to: &str| {
        assert!(arm.contains(from), "{from}");
        (arm.replacen(from, to, 1), mended(&arm.replacen(from, to, 1), &[]))
    };
    let (text, after) = with("upper=\"2\"", "uper=\"2\"");
    assert_eq!(after, Some(text.replace("uper=", "upper=")));
    let (_, two) = with("upper=\"2\"", "uper=\"2\" uppr=\"1\"");
    assert_eq!(two, None, "two attributes of one name are no XML");
    let (_, unfit) = with("upper=\"2\"", "uper=\"abc\"");
    assert_eq!(unfit, None, "not a number");
    let (_, unclear) = with("ixz=\"0\"", "iaz=\"0\"");
    assert_eq!(unclear, None, "ixz, iyz or izz");
}

#[test]
fn a_file_name_is_mended_where_that_file_is_there() {
    let arm = include_str!("../cases/LNT029/near_miss.urdf");
    let named = |name: &str| arm.replace("meshes/box.stl", name);
    let slashes = ["meshes/box.stl"];
    let backslash = named("meshes\\box.stl");
    assert_eq!(mended(&backslash, &slashes), Some(arm.to_owned()));
    assert_eq!(mended(&backslash, &[]), None, "not there");
    if cfg!(target_os = "linux") {
        let both = ["meshes/box.stl", "meshes\\box.stl"];
        assert_eq!(mended(&backslash, &both), None, "a name of Linux");
        let case = ["meshes/Box.stl", "meshes/BOX.stl"];
        assert_eq!(mended(arm, &case[..1]), Some(named(case[0])));
        assert_eq!(mended(arm, &case), None, "one of two");
        let folder = ["Meshes/BOX.stl", "meshes/tin.stl"];
        assert_eq!(mended(arm, &folder), Some(named(folder[0])));
        let up = |folder: &str| named(&format!("./{folder}/../{folder}/box.stl"));
        assert_eq!(mended(&up("Meshes"), &slashes), Some(up("meshes")));
        let both = ["Meshes/box.stl", "MESHES/box.stl"];
        assert_eq!(mended(arm, &both), None, "one of two folders");
        let back = named("MESHES\\box.stl");
        assert_eq!(mended(&back, &slashes), Some(arm.to_owned()), "both faults");
    }
}

/// A robot that all programs load.
const ARM: &str = include_str!("../cases/LNT060/near_miss.urdf");

/// The robot with one text in place of another.
fn arm(old: &str, new: &str) -> String {
    assert!(ARM.contains(old), "{old}");
    ARM.replacen(old, new, 1)
}

#[test]
fn what_programs_refuse_is_mended_where_there_is_one_right_answer() {
    let steel = "  <material name=\"steel\"><color rgba=\"0.6 0.6 0.7 1\"/></material>\n";
    let twice = format!("{steel}{steel}");
    let effort = " effort=\"10\"";
    let lines = " effort=\"\n  10\n\"";
    let mass = "<mass value=\"4\"/>\n";
    let masses = "<mass value=\"4\"/>\n      <mass value=\"4\"/>\n";
    let controller = "    <safety_controller";
    let dynamics = "    <dynamics/>\n    <safety_controller";
    let link = "  <link name=\"base\">\n";
    let prefixed = "<controller:x name=\"a\"/>\n  <link name=\"base\">\n";
    for (old, new) in [
        ("upper=\"2\"", "upper=\" 2 \""),
        ("0.2 0.2 0.1", "0.2\t0.2  0.1"),
        ("0 0 0.05", "0,0,0.05"),
        ("0 0 0.05", "0; 0; 0.05"),
        (effort, lines),
        (steel, &twice),
        (mass, masses),
        (controller, dynamics),
        ("\"revolute\"", "\"Revolute\""),
        ("<robot name=\"arm\">", "<robot name=\"arm\" version=\"1.0\">"),
    ] {
        let changed = arm(old, new);
        if old.starts_with("<robot") {
            let wrong = changed.replace("\"1.0\"", "\"1\"");
            assert_eq!(mended(&wrong, &[]), Some(changed), "{new}");
        } else {
            assert_eq!(mended(&changed, &[]).as_deref(), Some(ARM), "{new}");
        }
    }
    let declared = mended(&arm(link, prefixed), &[]).expect("mended");
    assert!(declared.starts_with("<robot xmlns:controller=\"http://"), "{declared}");
    let boxes = "<geometry><box size=\"0.1 0.1 0.3\"/></geometry>";
    let mesh = |name: &str| format!("<geometry><mesh filename=\"{name}\"/></geometry>");
    let spaced = ARM.replace(boxes, &mesh(" box.stl "));
    assert_eq!(mended(&spaced, &["box.stl"]), Some(ARM.replace(boxes, &mesh("box.stl"))));
}

#[test]
fn what_has_several_answers_stays() {
    let steel = "<material name=\"steel\"><color rgba=\"0.6 0.6 0.7 1\"/></material>";
    let other = "<material name=\"steel\"><color rgba=\"0 0 0 1\"/></material>";
    let capsule = "<capsule radius=\"0.1\" length=\"0.2\"/>";
    for (old, new) in [
        ("effort=\"10\"", "effort=\"1,0\""),
        ("effort=\"10\"", "effort=\"10 10\""),
        ("0 0 0.05", "0 0,05"),
        ("0 0 0.05", "0 0 0.05m"),
        (steel, &format!("{steel}{other}")),
        ("<mass value=\"4\"/>", "<mass value=\"4\"/><mass value=\"5\"/>"),
        ("\"revolute\"", "\"rotation\""),
    ] {
        assert_eq!(mended(&arm(old, new), &[]), None, "{new}");
    }
    let newer = arm("<box size=\"0.2 0.2 0.1\"/>", capsule);
    let newer = newer.replace("<robot ", "<robot version=\"2.0\" ");
    assert_eq!(mended(&newer, &[]), None);
}
