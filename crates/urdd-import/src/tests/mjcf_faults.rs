//! Descriptions that are refused, with the place; and that none makes the reader panic or take long.

use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

use super::mjcf::of_text;
use crate::model::Model;
use crate::place::Placed;
use crate::tests::Entries as _;

fn read(text: &str) -> Result<Model, Placed> {
    of_text(Path::new("/nowhere/m.xml"), text.to_owned(), None)
}

fn world(inside: &str) -> String {
    format!("<mujoco><worldbody><body name=\"b\">{inside}</body></worldbody></mujoco>")
}

fn fault(text: &str) -> String {
    let fault = read(text).expect_err(text);
    assert!(fault.file == "m.xml" && fault.line > 0 && fault.column > 0, "{fault:?}");
    fault.fault.to_string()
}

#[test]
fn what_is_wrong_is_said() {
    let cases = [
        (
            "<geom size=\"nan\"/>",
            "`size` of `<geom>` is `nan`, which is not a list of finite numbers",
        ),
        ("<geom size=\"0\"/>", "size 1 of `<geom>` must be positive"),
        ("<geom size=\"1\" pos=\"1 2\"/>", "not three numbers"),
        ("<geom size=\"1\" class=\"x\"/>", "the default class `x` is not defined"),
        ("<geom size=\"1\" quat=\"0 0 0 0\"/>", "not a quaternion that is not zero"),
        ("<geom size=\"1\" quat=\"1 0 0 0\" euler=\"0 0 0\"/>", "says its orientation twice"),
        ("<geom type=\"mesh\"/>", "needs the attribute `mesh`"),
        ("<geom type=\"mesh\" mesh=\"x\"/>", "names the mesh `x`"),
        ("<geom size=\"1\" material=\"x\"/>", "names the material `x`"),
        ("<geom size=\"1\" fromto=\"0 0 0 0 0 1\"/>", "`fromto` of `<geom>` is for capsules"),
        (
            "<geom type=\"capsule\" size=\"1\" fromto=\"0 0 1 0 0 1\"/>",
            "with two points that differ",
        ),
        ("<geom size=\"1\" density=\"-1\"/>", "must not be negative"),
        ("<joint range=\"2 1\" limited=\"true\"/>", "`range` of `<joint>` must rise"),
        ("<joint axis=\"0 0 0\"/>", "not an axis that is not zero"),
        ("<joint type=\"screw\"/>", "`free`, `ball`, `slide` or `hinge`"),
        ("<joint type=\"ball\"/><joint/>", "a body turns after a ball joint"),
        ("<joint/><freejoint/>", "a free joint beside others"),
        ("<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 3\"/>", "break A + B ≥ C"),
        ("<inertial mass=\"1\"/>", "`<inertial>` needs the attribute `pos`"),
        ("<inertial pos=\"0 0 0\" mass=\"1\" fullinertia=\"1 1 0 0 0 0\"/>", "not positive"),
        ("<body name=\"b\"/>", "two bodies are named `b`"),
        ("<replicate count=\"0\"><geom size=\"1\"/></replicate>", "not a number of replicas"),
        (
            "<replicate count=\"1000000000\"><geom size=\"1\"/></replicate>",
            "needs more memory or work",
        ),
        // Nothing is in it.
        ("<replicate count=\"1000000000\"/>", "needs more memory or work"),
        ("<attach model=\"x\" prefix=\"y\"/>", "`<attach>` names the model `x`"),
        ("<attach model=\"x\"/>", "`<attach>` needs the attribute `prefix`"),
        ("<include file=\"x.xml\"/>", "`x.xml` was not found"),
        ("<include/>", "`<include>` needs the attribute `file`"),
        ("<include file=\"m.xml\"/>", "`m.xml` is already included"),
    ];
    for (inside, said) in cases {
        let found = fault(&world(inside));
        assert!(found.contains(said), "{inside}: {found}");
    }
}

#[test]
fn what_is_wrong_of_a_model_is_said() {
    let body = "<worldbody><body name=\"b\"><joint name=\"j\"/></body></worldbody>";
    let cases = [
        ("<worldbody><joint/></worldbody>", "`<joint>` cannot be in the world"),
        ("<compiler coordinate=\"global\"/>", "of MuJoCo 2.3.3 and older"),
        ("<compiler eulerseq=\"xy\"/>", "three of x, y, z, X, Y, Z"),
        ("<default class=\"x\"/>", "cannot be named `x`"),
        ("<default><default/></default>", "needs the attribute `class`"),
        ("<default><geom/><geom/></default>", "`<geom>` stands twice"),
        ("<default><default class=\"a\"/><default class=\"a\"/></default>", "`a` is defined twice"),
        ("<actuator><motor joint=\"x\"/></actuator>", "`<motor>` names the joint `x`"),
        ("<equality><joint joint1=\"x\"/></equality>", "`<joint>` names the joint `x`"),
        ("<contact><exclude body1=\"b\" body2=\"x\"/></contact>", "`<exclude>` names the body `x`"),
        ("<contact><pair geom1=\"x\" geom2=\"y\"/></contact>", "`<pair>` names the geom `x`"),
        (
            "<keyframe><key qpos=\"1 2\"/></keyframe>",
            "has 2 numbers, but the model has 1 positions",
        ),
        ("<asset><mesh name=\"m\" vertex=\"0\" scale=\"0 1 1\"/></asset>", "that are not 0"),
        ("<geom", "not well-formed XML"),
        ("<!DOCTYPE x [<!ENTITY a \"b\">]>", "not well-formed XML"),
    ];
    for (inside, said) in cases {
        let found = fault(&format!("<mujoco>{inside}{body}</mujoco>"));
        assert!(found.contains(said), "{inside}: {found}");
    }
    assert!(fault("<mujoco><worldbody/></mujoco>").contains("there is no robot in it"));
    let deep: String = (0..40).map(|class| format!("<default class=\"{class}\">")).collect();
    let deep =
        format!("<mujoco><default>{deep}{}</default>{body}</mujoco>", "</default>".repeat(40));
    assert!(fault(&deep).contains("nested more than 32 deep"));
    let text = world("<joint range=\"0 1\"/>");
    let text = text.replace("<worldbody>", "<compiler autolimits=\"false\"/><worldbody>");
    assert!(fault(&text).contains("but not `limited`"));
    let unknown = of_text(Path::new("/nowhere/m.xml"), world(""), Some("x")).unwrap_err();
    assert!(unknown.fault.to_string().contains("no body `x`"));
}

#[test]
fn a_fault_is_placed_in_the_file_that_has_it() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("arm.xml"), "<x>\n <geom size=\"no\"/>\n</x>").unwrap();
    let path = folder.path().canonicalize().unwrap().join("m.xml");
    let fault = of_text(&path, world("<include file=\"arm.xml\"/>"), None).unwrap_err();
    assert!(fault.file.ends_with("arm.xml"), "{fault:?}");
    assert_eq!((fault.line, fault.column), (2, 2));
    std::fs::write(folder.path().join("arm.xml"), "<x><include file=\"arm.xml\"/></x>").unwrap();
    let fault = of_text(&path, world("<include file=\"arm.xml\"/>"), None).unwrap_err();
    assert!(fault.fault.to_string().contains("already included"), "{fault:?}");
    let fault = of_text(&path, world("<include file=\"/etc/passwd\"/>"), None).unwrap_err();
    assert!(fault.fault.to_string().contains("outside"), "{fault:?}");
}

#[test]
fn models_that_are_attached_are_bounded() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().canonicalize().unwrap().join("m.xml");
    let attach = |name: &str, times: usize| {
        let each: String = (0..times)
            .map(|at| format!("<attach model=\"x\" prefix=\"{at}/{}\"/>", "p".repeat(20)))
            .collect();
        format!(
            "<mujoco><asset><model name=\"x\" file=\"{name}\"/></asset><worldbody><body><joint/><geom size=\"1\"/></body>{each}</worldbody></mujoco>"
        )
    };
    let refused = |text: String| of_text(&path, text, None).unwrap_err().fault.to_string();
    std::fs::write(&path, attach("m.xml", 1)).unwrap();
    assert!(refused(attach("m.xml", 1)).contains("attached in each other, or one to itself"));
    assert!(refused(attach("/etc/passwd", 1)).contains("outside"));
    // Each has ten of the next one: a million bodies.
    for level in 0..6 {
        let next = format!("{}.xml", level + 1);
        std::fs::write(folder.path().join(format!("{level}.xml")), attach(&next, 10)).unwrap();
    }
    std::fs::write(folder.path().join("6.xml"), world("<joint/><geom size=\"1\"/>")).unwrap();
    let start = Instant::now();
    assert!(refused(attach("0.xml", 10)).contains("needs more memory or work"));
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
    // Each has one of the next one.
    for level in 0..12 {
        let next = format!("{}.xml", level + 1);
        std::fs::write(folder.path().join(format!("{level}.xml")), attach(&next, 1)).unwrap();
    }
    std::fs::write(folder.path().join("12.xml"), world("<joint/><geom size=\"1\"/>")).unwrap();
    assert!(refused(attach("0.xml", 1)).contains("attached in each other, or one to itself"));
    assert!(of_text(&path, attach("4.xml", 1), None).is_ok());
    // As deep as one file may be.
    let deep =
        |inside: &str| format!("{}{inside}{}", "<frame>".repeat(150), "</frame>".repeat(150));
    std::fs::write(folder.path().join("deep.xml"), world(&deep("<joint/><geom size=\"1\"/>")))
        .unwrap();
    let text = attach("deep.xml", 1)
        .replace("<attach", "<frame><attach")
        .replace("</worldbody>", "</frame></worldbody>");
    assert!(of_text(&path, text, None).is_ok());
    let text = attach("deep.xml", 1);
    let text = text.replace("<attach", &format!("{}<attach", "<frame>".repeat(150)));
    let text = text.replace("</worldbody>", &("</frame>".repeat(150) + "</worldbody>"));
    assert!(refused(text).contains("nested more than 256 deep"));
    // A body that the model does not have.
    let text = attach("6.xml", 1).replace("<attach ", "<attach body=\"no\" ");
    assert!(refused(text).contains("names the body `no`"));
}

#[test]
fn large_models_take_no_longer_than_they_are_long() {
    let start = Instant::now();
    let mut wide = String::new();
    for number in 0..10_000 {
        let _ = write!(wide, "<body><joint/><geom size=\"0.1\" class=\"c\"/></body>");
        if number % 1000 == 0 {
            wide += "<site/><site/>";
        }
    }
    let defaults = "<default><default class=\"c\"><geom density=\"1\"/></default></default>";
    let text = world(&wide).replace("<worldbody>", &format!("{defaults}<worldbody>"));
    let model = read(&text).unwrap();
    assert_eq!(model.bodies.len(), 10_021);
    let is_said = |text: &str| text.contains("bodies have shapes that collide");
    assert!(model.tally.remarks.iter().any(|remark| is_said(&remark.text)));
    let deep = "<frame>".repeat(300) + &"</frame>".repeat(300);
    assert!(fault(&world(&deep)).contains("levels of nested elements"));
    let many =
        "<body><joint/><replicate count=\"400\"><body><geom size=\"1\"/></body></replicate></body>";
    assert_eq!(read(&world(many)).unwrap().bodies.len(), 402);
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
}

#[test]
fn names_are_kept_and_made_unique() {
    let inside = "<geom size=\"1\"/><site name=\"b\"/><site name=\"a&lt;&#10;&quot;\"/><body/><body><joint/><joint/></body>";
    let model = read(&world(inside)).unwrap();
    let names: Vec<&str> = model.bodies.iter().map(|body| &*body.name).collect();
    assert_eq!(names, ["b", "b_body", "b_body_2", "b_site", "a<\n\""]);
    let joints: Vec<&str> = model.bodies[2].joints.iter().map(|joint| &*joint.name).collect();
    assert_eq!(joints, ["b_body_2_joint", "b_body_2_joint_2"]);
}
