//! Worlds, and what they include.

use super::{body, given, inside, pose};
use crate::tests::Entries as _;
use urdd_source::ImportOptions;

const PART: &str = "<sdf version='1.9'><model name='part'><link name='p'/></model></sdf>";
const CONFIG: &str =
    "<!-- a -- b --><model><name>x</name><sdf version='1.9'>model.sdf</sdf></model>";

fn world(inside: &str) -> String {
    format!("<sdf version='1.9'><world name='w'>{inside}</world></sdf>")
}

fn include(uri: &str, rest: &str) -> String {
    format!("<include><uri>{uri}</uri>{rest}</include>")
}

#[test]
fn bare_and_schemed_names_are_those_of_models() {
    let files = [("models/part/model.config", CONFIG), ("models/part/model.sdf", PART)];
    let beside = [("part/model.config", CONFIG), ("part/model.sdf", PART)];
    let text = |uri: &str| {
        format!(
            "<sdf version='1.9'><model name='m'><link name='a'/>{}</model></sdf>",
            include(uri, "<pose>1 0 0 0 0 0</pose>")
        )
    };
    for uri in [
        "part",
        "file://part",
        "model://part",
        "part/",
        "./part",
        "part/model.sdf",
        "file://part/model.sdf",
    ] {
        let model =
            given(&text(uri), &beside).unwrap_or_else(|error| panic!("{uri}: {}", error.fault));
        assert!(model.bodies.iter().any(|body| body.name == "part/p"), "{uri}");
        assert_eq!(pose(&model, "part/p").translation.vector.x, 1.0);
    }
    for uri in ["part", "file://part", "model://part", "other://part"] {
        let folder = std::path::Path::new("/");
        let mut settings = super::memory(&files);
        settings.packages = urdd_source::Packages::from_environment(|name| {
            (name == "SDF_PATH").then(|| "/models".into())
        });
        let model = super::read(&text(uri), folder, &settings);
        let model = model.unwrap_or_else(|error| panic!("{uri}: {}", error.fault));
        assert_eq!(model.bodies.len(), 2, "{uri}");
    }
    let fault = given(&text("nothing"), &[]).expect_err("not there").fault.to_string();
    assert!(fault.starts_with("`nothing` was not found: tried /nothing"), "{fault}");
}

#[test]
fn a_static_robot_stays_static() {
    let last = |text: &str, files: &[(&str, &str)]| {
        let model = given(text, files).expect("a model");
        assert!(!model.is_floating);
        model.elements.last().expect("an element").0.clone()
    };
    // libsdformat takes the word of the last `<gazebo>`.
    let plugin = "<plugin filename='p' name='p'/>";
    let wanted = "<gazebo>\n  <static>true</static>\n</gazebo>\n";
    let text = format!(
        "<sdf version='1.9'><model name='m'><static>true</static><link name='a'/>{plugin}</model></sdf>"
    );
    assert_eq!(last(&text, &[]), wanted);
    let files = [("part.sdf", PART)];
    let text = world(&include("part.sdf", &format!("<static>true</static>{plugin}")));
    assert_eq!(last(&text, &files), wanted);
    let of_file = [("part.sdf", &*PART.replace("<link", "<static>1</static><link"))];
    assert_eq!(last(&world(&include("part.sdf", "")), &of_file), wanted);
    let model = given(&world(&include("part.sdf", "<static>0</static>")), &of_file);
    let model = model.expect("a model");
    assert!(model.is_floating && model.elements.is_empty());
}

#[test]
fn included_models_have_the_names_of_their_files() {
    let house = PART.replace("part", "house").replace("<link", "<static>true</static><link");
    let bot = PART.replace("part", "robot_9000");
    let lamp = "<sdf version='1.9'><light type='point' name='lamp'/></sdf>";
    let files = [("b.sdf", &*bot), ("h.sdf", &*house), ("l.sdf", lamp), ("p.sdf", PART)];
    let both = world(&(include("h.sdf", "") + &include("b.sdf", "") + &include("l.sdf", "")));
    let model = given(&both, &files).expect("the only one that moves");
    assert_eq!(model.name, "robot_9000");
    assert_eq!(model.files.len(), 2, "the description and the robot");
    let two = world(
        &(include("p.sdf", "") + &include("b.sdf", "<name>me</name>") + &include("none.sdf", "")),
    );
    let said = given(&two, &files).expect_err("three").fault.to_string();
    assert!(said.contains("`part`, `me`, `none.sdf`"), "{said}");
    let of = |model: &str| {
        let options = ImportOptions { model: Some(model.to_owned()), ..ImportOptions::default() };
        super::read_with(&both, std::path::Path::new("/"), &super::memory(&files), &options)
    };
    assert_eq!(of("house").expect("by its name").name, "house");
    assert_eq!(of("h.sdf").expect("by its file").name, "house");
}

#[test]
fn a_joint_of_the_world_holds_the_robot() {
    let joint = |kind: &str, parent: &str, child: &str, rest: &str| {
        format!(
            "<joint name='hold' type='{kind}'><parent>{parent}</parent><child>{child}</child>{rest}</joint>"
        )
    };
    let text = |joint: &str| {
        world(&format!(
            "<model name='cart'><pose>7 0 0 0 0 0</pose><link name='a'><pose>0 0 1 0 0 0</pose></link>\
             <link name='b'/></model><model name='other'><static>1</static><link name='c'/></model>{joint}"
        ))
    };
    let model = given(&text(&joint("fixed", "world", "cart", "")), &[]).expect("a model");
    assert!(!model.is_floating && model.bodies[0].name == "world");
    assert_eq!(body(&model, "a").fixed_by.as_deref(), Some("hold"));
    assert_eq!(body(&model, "a").pose.translation.vector.z, 1.0);
    // Along the x of the cart, 2 m above its frame.
    let rest = "<pose relative_to='cart'>0 0 2 0 0 0</pose><axis><xyz expressed_in='cart::b'>1 0 0</xyz></axis>";
    let model = given(&text(&joint("prismatic", "world", "cart::b", rest)), &[]).expect("a model");
    let b = body(&model, "b");
    assert_eq!((&*b.joints[0].name, b.joints[0].axis.x), ("hold", 1.0));
    assert_eq!(b.joints[0].frame.translation.vector.z, 2.0);
    for lost in [joint("fixed", "other", "cart", ""), joint("fixed", "cart", "other::c", "")] {
        let model = given(&text(&lost), &[]).expect("a model");
        assert!(model.is_floating);
        assert_eq!(model.tally.all_unread().get("`<joint>` of `<world>`"), Some(&1));
    }
    // Its name is not one of the model's.
    let own = "<joint name='hold' type='fixed'><parent>a</parent><child>b</child></joint></model><model name='other'";
    let both =
        text(&joint("fixed", "world", "cart", "")).replace("</model><model name='other'", own);
    let model = given(&both, &[]).expect("a model");
    assert_eq!(model.bodies.len(), 3);
    let inside = given(&text(&joint("fixed", "cart::a", "cart::b", "")), &[]).expect("a model");
    assert_eq!(body(&inside, "b").fixed_by.as_deref(), Some("hold"));
}

#[test]
fn limits_of_continuous_joints_are_said() {
    let of = |kind: &str, limit: &str| {
        let text = format!(
            "<link name='a'/><link name='b'/><joint name='j' type='{kind}'><parent>a</parent><child>b</child>\
             <axis><limit>{limit}</limit></axis></joint>"
        );
        let model = inside("1.9", &text).expect("a model");
        model.tally.remarks.iter().map(|remark| remark.text.clone()).collect::<Vec<_>>()
    };
    let said = ["the limits of joint `j` are left out: a continuous joint has none"];
    assert_eq!(of("continuous", "<lower>-0.5</lower><upper>0.5</upper>"), said);
    assert_eq!(of("continuous", "<upper>0.5</upper>"), said);
    assert!(of("continuous", "<lower>-1e16</lower><effort>2</effort>").is_empty());
    assert!(of("revolute", "<lower>-0.5</lower><upper>0.5</upper>").is_empty());
}
