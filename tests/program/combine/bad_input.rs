//! Recipes that cannot be applied: one error each, with its location, what is wrong, and what to do.

use urdd_generate::combine::{CombineError, PartFault};
use urdd_generate::{Selection, Settings, generate};

use crate::combine::support::{core, findings, ours, put_together, with_ours};

/// A recipe with an arm and a gripper, with some lines replaced.
fn recipe(changes: &[(&str, &str)]) -> String {
    let text = format!(
        r#"name = "cell"

[[part]]
id = "arm"
source = "{}"
prefix = ""
# more of the arm

[[part]]
id = "gripper"
source = "{}"
attach = {{ to = "arm/tool0", xyz = [0, 0, 0.1] }}
# more of the gripper
"#,
        ours("six_axis_arm").display(),
        ours("gripper").display()
    );
    changes.iter().fold(text, |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    })
}

/// The fault of a recipe: the line and column, and the message after them.
fn fault(changes: &[(&str, &str)]) -> (Option<(u32, u32)>, String) {
    let folder = testkit::temporary::folder();
    let made = put_together(&recipe(changes), folder.path(), &core());
    assert!(!folder.path().join("cell").exists());
    match made.expect_err("a recipe that cannot be followed") {
        CombineError::Recipe { file, fault, at } => {
            assert_eq!(file, "cell.toml");
            (at.map(|at| (at.line, at.column)), fault)
        }
        other => panic!("{other:?}"),
    }
}

/// The message of a recipe that cannot be applied begins with these words, and ends with those.
fn assert_fault(changes: &[(&str, &str)], begin: &str, end: &str) {
    let (_, words) = fault(changes);
    assert!(words.starts_with(begin) && words.ends_with(end), "{words}");
}

#[test]
fn the_recipe_that_the_others_are_made_of_is_sound() {
    let folder = testkit::temporary::folder();
    let (made, _) = put_together(&recipe(&[]), folder.path(), &core()).expect("a robot");
    assert_eq!(made.generated.robot_name, "cell");
}

#[test]
fn unknown_keys_are_told_with_the_nearest_key() {
    let (at, words) = fault(&[("prefix = \"\"", "prefx = \"\"")]);
    assert_eq!(at, Some((6, 1)));
    assert_eq!(
        words,
        "unknown field `prefx`, expected one of `id`, `source`, `prefix`, `drop`, `freeze`, `attach`, `skip`, `names`; did you mean `prefix`?"
    );
    for (from, to, meant) in [
        ("name =", "nmae =", "`name`"),
        ("to =", "too =", "`to`"),
        ("xyz =", "xzy =", "`xyz`"),
        ("# more of the arm", "dorp = []", "`drop`"),
        ("xyz = [0, 0, 0.1]", "limit = { uper = 1 }", "`upper`"),
        ("name = \"cell\"", "base = { lnk = \"x\" }", "`link`"),
    ] {
        assert_fault(&[(from, to)], "unknown field `", &format!("; did you mean {meant}?"));
    }
    for (from, to) in [
        ("# more of the arm", "limit = 3"),
        ("name = \"cell\"", "base = { to = \"x\" }"),
        ("to = \"arm/tool0\"", "link = \"arm/tool0\""),
    ] {
        let (at, words) = fault(&[(from, to)]);
        assert!(words.starts_with("unknown field `") && !words.contains("mean"), "{words}");
        assert!(at.is_some());
    }
}

#[test]
fn values_of_the_wrong_type_are_told_with_their_place() {
    let (at, words) = fault(&[("[0, 0, 0.1]", "[0, 0]")]);
    assert_eq!(at, Some((12, 36)), "{words}");
    assert!(words.contains("array of length 3"), "{words}");
    let (at, words) = fault(&[("# more of the arm", "freeze = { joint_1 = \"x\" }")]);
    assert_eq!(at, Some((7, 22)), "{words}");
    assert_eq!(words, "expected a number, or a list with one for each DOF");
    let (at, _) = fault(&[("name =", "= name =")]);
    assert_eq!(at.map(|at| at.0), Some(1));
    let nan = fault(&[("[0, 0, 0.1]", "[0, 0, nan]")]);
    assert_eq!(nan, (Some((12, 17)), "a number of `attach` is not finite".to_owned()));
}

#[test]
fn keys_that_must_be_there_are_named() {
    let missing = fault(&[("id = \"arm\"\n", "")]);
    assert_eq!(missing, (Some((3, 1)), "missing field `id`".to_owned()));
    let missing = fault(&[("to = \"arm/tool0\", ", "")]);
    assert_eq!(missing, (Some((12, 10)), "missing field `to`".to_owned()));
    let folder = testkit::temporary::folder();
    let error = put_together("name = \"x\"", folder.path(), &core()).expect_err("no part");
    assert!(error.to_string().starts_with("cell.toml: there is no part; write"), "{error}");
}

#[test]
fn ids_tell_parts_apart() {
    let (_, words) = fault(&[("id = \"gripper\"", "id = \"Arm\"")]);
    assert!(words.starts_with("another part has the id `Arm`:4:6; ids must differ"), "{words}");
    assert_fault(&[("id = \"arm\"", "id = \"a/b\"")], "`a/b` is not a valid id", "");
}

#[test]
fn a_link_to_attach_to_that_is_not_there_is_told_with_the_nearest() {
    let (at, words) = fault(&[("arm/tool0", "arm/tol0")]);
    assert_eq!(at, Some((12, 17)));
    assert_eq!(words, "part `arm` has no link `tol0`; did you mean `tool0`?");
    let (_, words) = fault(&[("arm/tool0", "amr/tool0")]);
    assert_eq!(words, "there is no part `amr`; did you mean `arm`?");
    assert_fault(&[("arm/tool0", "tool0")], "`tool0` does not name a part", "write `part/link`");
    let base = ("name = \"cell\"", "base = {}");
    let (_, words) = fault(&[base, ("arm/tool0", "base/wrld")]);
    assert_eq!(words, "part `base` has no link `wrld`; did you mean `world`?");
}

#[test]
fn parts_hang_on_no_ring() {
    let own = ("arm/tool0", "gripper/grasp_frame");
    assert_fault(&[own], "part `gripper` is attached to itself", "a link of another part");
    let ring = "attach = { to = \"gripper/grasp_frame\" }";
    let (_, words) = fault(&[("# more of the arm", ring)]);
    assert!(words.starts_with("parts are attached in a cycle: `arm` to `gripper`;"), "{words}");
}

#[test]
fn a_robot_has_one_root() {
    let (at, words) = fault(&[("attach = { to = \"arm/tool0\", xyz = [0, 0, 0.1] }", "")]);
    assert_eq!(at, Some((10, 6)));
    assert!(words.contains("`arm` and `gripper` are both unattached"), "{words}");
    let root = ("# more of the arm", "drop = [\"base_link\"]");
    assert_fault(&[root], "`base_link` is the root of part `arm`", "farther from the root");
}

#[test]
fn what_is_dropped_cannot_be_used() {
    let (at, words) = fault(&[("# more of the arm", "drop = [\"tool0\"]")]);
    assert_eq!(words, "the link `tool0` of part `arm` is dropped, with `tool0`");
    assert_eq!(at.map(|at| at.0), Some(12));
    for (more, dropped) in [
        (
            "drop = [\"left_finger\"]\nfreeze = { left_rack = 0.01 }",
            "the joint `left_rack` of part `gripper` is dropped, with `left_finger`",
        ),
        (
            "drop = [\"left_pad\"]\nskip = [[\"left_pad\", \"arm/tool0\"]]",
            "the link `left_pad` of part `gripper` is dropped, with `left_pad`",
        ),
        (
            "drop = [\"left_fingr\"]",
            "part `gripper` has no link `left_fingr`; did you mean `left_finger`?",
        ),
    ] {
        assert_eq!(fault(&[("# more of the gripper", more)]).1, dropped);
    }
}

#[test]
fn freezing_keeps_to_the_joint() {
    let with = |freeze: &str| fault(&[("# more of the gripper", freeze)]);
    let (at, words) = with("freeze = { motor = 4.5 }");
    assert_eq!(at, Some((13, 12)));
    assert_eq!(
        words,
        "joint `motor` of part `gripper` moves from 0 to 4, so it cannot be frozen at 4.5"
    );
    for (freeze, expected) in [
        ("motor = [1, 2]", "joint `motor` of part `gripper` has 1 DOF, but there are 2"),
        ("grasp_mount = 0", "joint `grasp_mount` of part `gripper` is already fixed"),
        ("motor = inf", "a number of `freeze` is not finite"),
        ("moter = 0", "part `gripper` has no joint `moter`; did you mean `motor`?"),
    ] {
        assert_eq!(with(&format!("freeze = {{ {freeze} }}")).1, expected);
    }
}

#[test]
fn a_mimic_whose_driver_is_dropped_is_refused() {
    let (at, words) = fault(&[("# more of the gripper", "drop = [\"pinion\"]")]);
    assert_eq!(at, Some((13, 9)));
    assert!(
        words.contains("`left_rack` of part `gripper` follows `motor`, which is dropped with `pinion`; freeze the joint"),
        "{words}"
    );
}

#[test]
fn joints_between_parts_are_such_as_urdf_has() {
    let with = |joint: &str| fault(&[("xyz = [0, 0, 0.1]", joint)]);
    let (at, words) = with("joint = \"revolut\"");
    assert_eq!(at, Some((12, 38)));
    let known = "revolute, continuous, prismatic, fixed, floating, planar, spherical";
    assert_eq!(
        words,
        format!("unknown joint type `revolut`; did you mean `revolute`?; expected one of: {known}")
    );
    let (_, words) = with("joint = \"revolute\"");
    assert!(words.starts_with("a revolute joint needs limits: `limit = { lower"), "{words}");
    let (_, words) = with("joint = \"prismatic\", limit = { lower = 1, upper = 0 }");
    assert_eq!(words, "the lower limit, 1, is above the upper one, 0");
    let (_, words) = with("axis = [0, 0, 0]");
    assert_eq!(words, "the axis is 0 0 0, which has no direction");
}

#[test]
fn names_that_clash_are_told_with_both_parts() {
    // Two of the same gripper, neither with a prefix.
    let gripper = format!(
        "prefix = \"\"\n[[part]]\nid = \"other\"\nsource = \"{}\"\nprefix = \"\"\nattach = {{ to = \"arm/base_link\" }}",
        ours("gripper").display()
    );
    let (at, words) = fault(&[("# more of the gripper", &gripper)]);
    assert_eq!(at, Some((15, 6)));
    assert!(
        words.contains("the link `gripper_base` comes from part `gripper` and from part `other`; give one of them a `prefix`"),
        "{words}"
    );
    let named = "name = \"joint_1\"";
    let (_, words) = fault(&[("xyz = [0, 0, 0.1]", named)]);
    assert!(words.starts_with("the joint `joint_1` comes from part `arm` and from the joint that attaches part `gripper`;"), "{words}");
}

#[test]
fn sources_that_are_no_robots_are_told_with_the_part() {
    let folder = testkit::temporary::folder();
    std::fs::create_dir(folder.path().join("empty")).expect("a folder");
    for source in ["nowhere", "empty"] {
        let text = recipe(&[(ours("gripper").to_str().expect("a path"), source)]);
        let error = put_together(&text, folder.path(), &core()).expect_err("no robot");
        let CombineError::Part { id, fault: PartFault::Unusable(why), .. } = &error else {
            panic!("{error:?}");
        };
        assert!(why.starts_with("there is no such URDD or URDF: "), "{why}");
        assert_eq!(id, "gripper");
    }
    std::fs::write(folder.path().join("bad.urdf"), "<robot name=\"x\"/>").expect("a file");
    let text = recipe(&[(ours("gripper").to_str().expect("a path"), "bad.urdf")]);
    let error = put_together(&text, folder.path(), &core()).expect_err("no robot");
    assert!(matches!(error, CombineError::Generate { id: Some(_), .. }), "{error:?}");
    assert!(error.to_string().contains("bad.urdf:1:1"), "{error}");
}

#[test]
fn names_are_told_as_elements_or_attributes() {
    let names = "names = [\"a@b@c\"]";
    let names = ("# more of the gripper", names);
    assert_fault(&[names], "`a@b@c` does not say where links and joints are named; write", "");
}

#[test]
fn parts_of_unequal_modules_are_said() {
    let folder = testkit::temporary::folder();
    let folder = folder.path();
    for (name, modules) in
        [("six_axis_arm", &["core", "original_meshes"][..]), ("gripper", &["core"])]
    {
        let settings = Settings {
            selection: Selection::parse(modules.iter().copied()).expect("modules"),
            ..with_ours()
        };
        generate(&ours(name), &folder.join(name), &settings, &()).expect("a URDD");
    }
    let text = recipe(&[
        (ours("six_axis_arm").to_str().expect("a path"), "six_axis_arm"),
        (ours("gripper").to_str().expect("a path"), "gripper"),
    ]);
    let settings = Settings {
        selection: Selection::parse(["core", "original_meshes"]).expect("modules"),
        ..with_ours()
    };
    let (made, target) = put_together(&text, folder, &settings).expect("a robot");
    let notes: Vec<(&str, String)> =
        (made.notes.iter()).map(|note| (note.kind, note.to_string())).collect();
    let unequal =
        "part `gripper`: it has no original_meshes_module, which other parts have; it is computed";
    assert_eq!(notes, [("unequal-modules", unequal.to_owned())]);
    // The whole has what one of them lacks.
    let meshes = "mesh_modules/original_meshes_module/module.json";
    assert!(target.join(meshes).is_file());
    assert_eq!(findings(&target), [] as [String; 0]);
}

#[test]
fn no_path_is_recorded_of_parts_from_elsewhere() {
    let folder = testkit::temporary::folder();
    let recipes = folder.path().join("recipes");
    std::fs::create_dir(&recipes).expect("a folder");
    std::fs::copy(ours("gripper"), folder.path().join("gripper.urdf")).expect("a file");
    let text = recipe(&[(ours("gripper").to_str().expect("a path"), "../gripper.urdf")]);
    let mut settings = core();
    settings.source.allowed_folders.push(folder.path().to_owned());
    let (made, target) = put_together(&text, &recipes, &settings).expect("a robot");
    let names: Vec<&str> = (made.composition.parts.iter()).map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["six_axis_arm", "gripper"]);
    // Neither in the folder of the recipe's parts, nor in that of the arm.
    let own = folder.path().to_str().expect("a path");
    for path in [own, env!("CARGO_MANIFEST_DIR"), "../gripper"] {
        for file in ["cell.urdf", "urdd.json", "composition_module/module.json"] {
            let text = std::fs::read_to_string(target.join(file)).expect("a file");
            assert!(!text.contains(path), "{file} names {path}");
        }
    }
}
