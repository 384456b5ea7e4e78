//! Recipes that cannot be applied: one typed error each, with its location and what to do.

use urdd_generate::combine::{CombineError, PartFault, RecipeFault};
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

/// The fault of a recipe: what, at which line and column, and the message.
fn fault(changes: &[(&str, &str)]) -> (RecipeFault, Option<(u32, u32)>, String) {
    let folder = testkit::temporary::folder();
    let made = put_together(&recipe(changes), folder.path(), &core());
    assert!(!folder.path().join("cell").exists());
    let error = made.expect_err("a recipe that cannot be followed");
    let words = error.to_string();
    match error {
        CombineError::Recipe { fault, at, .. } => {
            (*fault, at.map(|at| (at.line, at.column)), words)
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_recipe_that_the_others_are_made_of_is_sound() {
    let folder = testkit::temporary::folder();
    let (made, _) = put_together(&recipe(&[]), folder.path(), &core()).expect("a robot");
    assert_eq!(made.generated.robot_name, "cell");
}

#[test]
fn unknown_keys_are_told_with_the_nearest_key() {
    let (fault_of_part, at, words) = fault(&[("prefix = \"\"", "prefx = \"\"")]);
    assert!(matches!(fault_of_part, RecipeFault::UnknownKey { .. }));
    assert_eq!(at, Some((6, 1)));
    assert!(
        words.starts_with("cell.toml:6:1: unknown key `prefx`; did you mean `prefix`?"),
        "{words}"
    );
    for (from, to, meant) in [
        ("name =", "nmae =", "`name`"),
        ("to =", "too =", "`to`"),
        ("xyz =", "xzy =", "`xyz`"),
        ("# more of the arm", "dorp = []", "`drop`"),
    ] {
        let (_, _, words) = fault(&[(from, to)]);
        assert!(words.contains(&format!("did you mean {meant}?")), "{words}");
    }
    let (_, _, words) = fault(&[("# more of the arm", "limit = 3")]);
    assert!(words.contains("unknown key `limit`; expected one of: id, source"), "{words}");
}

#[test]
fn values_of_the_wrong_type_are_told_with_their_place() {
    let (fault_of, at, words) = fault(&[("[0, 0, 0.1]", "[0, 0]")]);
    assert!(matches!(fault_of, RecipeFault::Toml(_)), "{words}");
    assert_eq!(at.map(|at| at.0), Some(12), "{words}");
    assert!(matches!(fault(&[("name =", "= name =")]).0, RecipeFault::Toml(_)));
    assert_eq!(fault(&[("[0, 0, 0.1]", "[0, 0, nan]")]).0, RecipeFault::NotFinite("attach"));
}

#[test]
fn keys_that_must_be_there_are_named() {
    assert_eq!(fault(&[("id = \"arm\"\n", "")]).0, RecipeFault::MissingKey("id"));
    assert_eq!(fault(&[("to = \"arm/tool0\", ", "")]).0, RecipeFault::MissingKey("attach.to"));
    let folder = testkit::temporary::folder();
    let error = put_together("name = \"x\"", folder.path(), &core()).expect_err("no part");
    assert!(matches!(
        error,
        CombineError::Recipe { fault, .. } if *fault == RecipeFault::NoParts
    ));
}

#[test]
fn ids_tell_parts_apart() {
    let (fault_of, _, words) = fault(&[("id = \"gripper\"", "id = \"Arm\"")]);
    assert!(matches!(fault_of, RecipeFault::IdTwice { .. }));
    assert!(words.contains("another part has the id `Arm`:4:6"), "{words}");
    assert!(matches!(fault(&[("id = \"arm\"", "id = \"a/b\"")]).0, RecipeFault::BadId(_)));
}

#[test]
fn a_link_to_attach_to_that_is_not_there_is_told_with_the_nearest() {
    let (fault_of, at, words) = fault(&[("arm/tool0", "arm/tol0")]);
    assert!(matches!(fault_of, RecipeFault::Unknown { what: "link", .. }));
    assert_eq!(at, Some((12, 17)));
    assert!(words.contains("part `arm` has no link `tol0`; did you mean `tool0`?"), "{words}");
    let (_, _, words) = fault(&[("arm/tool0", "amr/tool0")]);
    assert!(words.contains("there is no part `amr`; did you mean `arm`?"), "{words}");
    assert!(matches!(fault(&[("arm/tool0", "tool0")]).0, RecipeFault::NoPartNamed(_)));
}

#[test]
fn parts_hang_on_no_ring() {
    let (fault_of, _, words) = fault(&[("arm/tool0", "gripper/grasp_frame")]);
    assert_eq!(fault_of, RecipeFault::OnItself("gripper".to_owned()), "{words}");
    let ring = "attach = { to = \"gripper/grasp_frame\" }";
    let (fault_of, _, words) = fault(&[("# more of the arm", ring)]);
    assert!(matches!(fault_of, RecipeFault::Ring(_)));
    assert!(words.contains("in a cycle: `arm` to `gripper`"), "{words}");
}

#[test]
fn a_robot_has_one_root() {
    let (fault_of, at, words) =
        fault(&[("attach = { to = \"arm/tool0\", xyz = [0, 0, 0.1] }", "")]);
    assert!(matches!(fault_of, RecipeFault::TwoRoots { .. }));
    assert_eq!(at, Some((10, 6)));
    assert!(words.contains("`arm` and `gripper` are both unattached"), "{words}");
    let (fault_of, _, words) = fault(&[("# more of the arm", "drop = [\"base_link\"]")]);
    assert!(matches!(fault_of, RecipeFault::DropsRoot { .. }), "{words}");
}

#[test]
fn what_is_dropped_cannot_be_used() {
    let (fault_of, at, words) = fault(&[("# more of the arm", "drop = [\"tool0\"]")]);
    assert!(matches!(fault_of, RecipeFault::Dropped { what: "link", .. }), "{words}");
    assert_eq!(at.map(|at| at.0), Some(12));
    let more = "drop = [\"left_finger\"]\nfreeze = { left_rack = 0.01 }";
    assert!(matches!(
        fault(&[("# more of the gripper", more)]).0,
        RecipeFault::Dropped { what: "joint", .. }
    ));
    let skip = "drop = [\"left_pad\"]\nskip = [[\"left_pad\", \"arm/tool0\"]]";
    assert!(matches!(
        fault(&[("# more of the gripper", skip)]).0,
        RecipeFault::Dropped { what: "link", .. }
    ));
    let (_, _, words) = fault(&[("# more of the gripper", "drop = [\"left_fingr\"]")]);
    assert!(words.contains("did you mean `left_finger`?"), "{words}");
}

#[test]
fn freezing_keeps_to_the_joint() {
    let with = |freeze: &str| fault(&[("# more of the gripper", freeze)]);
    let (fault_of, at, words) = with("freeze = { motor = 4.5 }");
    assert!(matches!(fault_of, RecipeFault::FreezeBeyond { .. }));
    assert_eq!(at, Some((13, 12)));
    assert!(
        words
            .contains("`motor` of part `gripper` moves from 0 to 4, so it cannot be frozen at 4.5"),
        "{words}"
    );
    assert!(matches!(
        with("freeze = { motor = [1, 2] }").0,
        RecipeFault::FreezeCount { expected: 1, found: 2, .. }
    ));
    assert!(matches!(with("freeze = { grasp_mount = 0 }").0, RecipeFault::FreezesFixed { .. }));
    assert_eq!(with("freeze = { motor = inf }").0, RecipeFault::NotFinite("freeze"));
    let (_, _, words) = with("freeze = { moter = 0 }");
    assert!(words.contains("no joint `moter`; did you mean `motor`?"), "{words}");
}

#[test]
fn a_mimic_whose_driver_is_dropped_is_refused() {
    let (fault_of, at, words) = fault(&[("# more of the gripper", "drop = [\"pinion\"]")]);
    assert!(matches!(fault_of, RecipeFault::DriverDropped { .. }));
    assert_eq!(at, Some((13, 9)));
    assert!(
        words.contains("`left_rack` of part `gripper` follows `motor`, which is dropped with `pinion`; freeze the joint"),
        "{words}"
    );
}

#[test]
fn joints_between_parts_are_such_as_urdf_has() {
    let with = |joint: &str| fault(&[("xyz = [0, 0, 0.1]", joint)]);
    let (_, _, words) = with("joint = \"revolut\"");
    assert!(words.contains("unknown joint type `revolut`; did you mean `revolute`?"), "{words}");
    assert!(matches!(with("joint = \"revolute\"").0, RecipeFault::NoLimit(_)));
    let crossed = "joint = \"prismatic\", limit = { lower = 1, upper = 0 }";
    assert!(matches!(with(crossed).0, RecipeFault::CrossedLimit { .. }));
    assert_eq!(with("axis = [0, 0, 0]").0, RecipeFault::ZeroAxis);
}

#[test]
fn names_that_clash_are_told_with_both_parts() {
    // Two of the same gripper, neither with a prefix.
    let gripper = format!(
        "prefix = \"\"\n[[part]]\nid = \"other\"\nsource = \"{}\"\nprefix = \"\"\nattach = {{ to = \"arm/base_link\" }}",
        ours("gripper").display()
    );
    let (fault_of, at, words) = fault(&[("# more of the gripper", &gripper)]);
    assert!(matches!(fault_of, RecipeFault::Clash { what: "link", .. }), "{words}");
    assert_eq!(at, Some((15, 6)));
    assert!(
        words.contains("the link `gripper_base` comes from part `gripper` and from part `other`; give one of them a `prefix`"),
        "{words}"
    );
    let named = "name = \"joint_1\"";
    let (fault_of, _, words) = fault(&[("xyz = [0, 0, 0.1]", named)]);
    assert!(matches!(fault_of, RecipeFault::Clash { what: "joint", .. }), "{words}");
}

#[test]
fn sources_that_are_no_robots_are_told_with_the_part() {
    let folder = testkit::temporary::folder();
    std::fs::create_dir(folder.path().join("empty")).expect("a folder");
    for source in ["nowhere", "empty"] {
        let text = recipe(&[(ours("gripper").to_str().expect("a path"), source)]);
        let error = put_together(&text, folder.path(), &core()).expect_err("no robot");
        let CombineError::Part { id, fault: PartFault::Missing(_), .. } = &error else {
            panic!("{error:?}");
        };
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
    assert!(matches!(fault(&[("# more of the gripper", names)]).0, RecipeFault::BadName(_)));
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
