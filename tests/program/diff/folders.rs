//! Two folders with an `urdd.toml` each.

use std::path::Path;

use serde_json::Value;

use super::command::run;
use testkit::workshop::Workshop;

/// As xacro, it makes a robot whose mass is an argument.
const XACRO: &str = "#!/bin/sh\nfor word; do case \"$word\" in mass:=*) mass=\"${word#mass:=}\";; *) file=\"$word\";; esac; done\n\
    while read -r line; do case \"$line\" in *MASS*) echo \"${line%MASS*}$mass${line#*MASS}\";; *) echo \"$line\";; esac; done < \"$file\"\n";

fn robot(name: &str, mass: &str) -> String {
    format!(
        "<robot name='{name}'><link name='a'><inertial><mass value='{mass}'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link></robot>\n"
    )
}

fn shop(files: &[(&str, &str)]) -> Workshop {
    let shop = Workshop::new();
    for (path, text) in files {
        std::fs::create_dir_all(shop.path(path).parent().unwrap()).unwrap();
        shop.write(path, text);
    }
    shop
}

/// The exit status, and for each robot its label, what became of it, and whether there is a report.
fn compared(
    folder: &Path,
    more: &[&str],
    programs: Option<&Path>,
) -> (i32, Vec<(String, String, bool)>) {
    let words = [&["before", "after", "--no-findings", "--format", "json"], more].concat();
    let (status, out, err) = run(folder, &words, programs);
    let all: Vec<Value> = serde_json::from_str(&out).unwrap_or_else(|_| panic!("{err}"));
    let text = |one: &Value, key: &str| one[key].as_str().unwrap().to_owned();
    let one = |one: &Value| (text(one, "label"), text(one, "presence"), one["report"].is_object());
    (status, all.iter().map(one).collect())
}

#[test]
fn all_robots_of_both_are_compared() {
    let shop = shop(&[
        (
            "before/urdd.toml",
            "exclude = [\"old\"]\n[[robot]]\npath = \"arm.urdf\"\nname = \"left\"\n",
        ),
        ("after/urdd.toml", "[[robot]]\npath = \"moved/arm.urdf\"\nname = \"left\"\n"),
        ("before/arm.urdf", &robot("arm", "1")),
        ("after/moved/arm.urdf", &robot("arm", "2")),
        ("before/hand.urdf", &robot("hand", "1")),
        ("after/hand.urdf", &robot("hand", "1.0")),
        ("before/gone.urdf", &robot("gone", "1")),
        ("after/new.urdf", &robot("new", "1")),
        ("before/old/robot.urdf", "<robot"),
    ]);
    let expected = [
        ("left", "changed", true),
        ("gone.urdf", "removed", false),
        ("hand.urdf", "same", true),
        ("new.urdf", "added", false),
    ];
    let expected: Vec<_> = expected.map(|(a, b, c)| (a.to_owned(), b.to_owned(), c)).into();
    let (status, mut found) = compared(shop.folder(), &[], None);
    found.sort();
    let mut expected = expected;
    expected.sort();
    assert_eq!((status, found), (1, expected));
    let (status, out, _) = run(shop.folder(), &["before", "after", "--no-findings"], None);
    assert_eq!(status, 1);
    for words in [
        "== left: changed\n",
        "inertial.mass: 1 -> 2 kg",
        "== hand.urdf: same\n",
        "4 robots: 1 same, 1 changed, 1 added, 1 removed, 0 unreadable\n",
    ] {
        assert!(out.contains(words), "{words}: {out}");
    }
    let (_, out, _) =
        run(shop.folder(), &["before", "after", "--no-findings", "--format", "markdown"], None);
    assert!(out.contains("## `left`: changed\n"), "{out}");
    assert_eq!(run(shop.folder(), &["before", "before", "--no-findings"], None).0, 0);
    // One that cannot be read is no pass.
    shop.write("after/hand.urdf", "<robot");
    let (status, found) = compared(shop.folder(), &[], None);
    assert_eq!(status, 2);
    assert!(found.contains(&("hand.urdf".to_owned(), "unreadable".to_owned(), false)), "{found:?}");
}

#[test]
fn robots_of_a_xacro_file_are_compared_by_their_arguments() {
    use std::os::unix::fs::PermissionsExt;
    let declared =
        "[[robot]]\npath = \"arm.xacro\"\nname = \"arm\"\nargs = { mass = [\"1\", \"2\"] }\n";
    let text = robot("arm", "MASS");
    let shop = shop(&[
        ("before/urdd.toml", declared),
        ("after/urdd.toml", &declared.replace("\"2\"", "\"3\"")),
        ("before/arm.xacro", &text),
        ("after/arm.xacro", &text),
        ("bin/xacro", XACRO),
    ]);
    let programs = shop.path("bin");
    std::fs::set_permissions(shop.path("bin/xacro"), std::fs::Permissions::from_mode(0o755))
        .unwrap();
    let (status, found) = compared(shop.folder(), &["--xacro"], Some(&programs));
    let one = |label: &str, presence: &str, has| (label.to_owned(), presence.to_owned(), has);
    let expected = [
        one("arm_1 mass:=1", "same", true),
        one("arm_2 mass:=2", "removed", false),
        one("arm_3 mass:=3", "added", false),
    ];
    assert_eq!((status, found), (1, expected.into()));
    // A program runs only where somebody asks for it.
    let (status, found) = compared(shop.folder(), &[], Some(&programs));
    assert_eq!(status, 2);
    assert!(found.iter().all(|(_, presence, _)| presence == "unreadable"), "{found:?}");
}
