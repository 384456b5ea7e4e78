//! `[[robot]]` of a settings file.

use crate::settings::Settings;
use crate::settings_file::DeclaredRobot;
use crate::settings_file::SettingsFile;

fn read(text: &str) -> Result<Vec<DeclaredRobot>, String> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("urdd.toml");
    std::fs::write(&file, text).unwrap();
    let read = SettingsFile::read(&file).map_err(|error| error.to_string());
    read.map(|read| read.robots)
        .map_err(|error| error.split_once("urdd.toml:").unwrap().1.to_owned())
}

#[test]
fn lists_are_variants_and_their_product_is_made() {
    let text = "[[robot]]\npath = \"urdf/arm.urdf.xacro\"\n\
        args = { type = [\"long\", \"short\"], dof = [6, 7], hand = true, title = [\"one\"] }\n\
        [[robot]]\npath = \"leg.urdf\"\nname = \"left\"\n";
    let found = read(text).unwrap();
    let short = |one: &DeclaredRobot| {
        format!("{} {}", one.name.clone().unwrap_or_default(), one.arguments.join(" "))
    };
    assert_eq!(
        found.iter().map(short).collect::<Vec<_>>(),
        [
            "arm_6_long dof:=6 hand:=true title:=one type:=long",
            "arm_6_short dof:=6 hand:=true title:=one type:=short",
            "arm_7_long dof:=7 hand:=true title:=one type:=long",
            "arm_7_short dof:=7 hand:=true title:=one type:=short",
            "left ",
        ]
    );
    assert!(found[0].file.is_absolute() && found[0].file.ends_with("urdf/arm.urdf.xacro"));
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let list = |count: usize| format!("{:?}", vec![1; count]);
    let (hundred, ten) = (list(100), list(10));
    for (text, place, words) in [
        (
            format!("\n[[robot]]\npath = \"a\"\nargs = {{ a = {hundred}, b = {hundred} }}"),
            "3:8",
            "10000 robots",
        ),
        (
            format!(
                "[[robot]]\npath = \"a\"\nargs = {{ a = {hundred}, b = {ten} }}\n[[robot]]\npath = \"b\""
            ),
            "5:8",
            "1001 robots",
        ),
        (
            format!(
                "[[robot]]\npath = \"a\"\nargs = {{ a = \"{}\", b = {} }}",
                "x".repeat(300_000),
                list(1000)
            ),
            "2:8",
            "more memory or work",
        ),
        // Each is compiled, which takes far more than its text.
        (format!("exclude = [{}]", "\"*\",".repeat(20_000)), "1", "more memory or work"),
        ("[[robot]]\npath = \"a\"\nargs = { \"a b\" = 1 }".to_owned(), "3:10", "`a b`"),
        ("[[robot]]\npath = \"a\"\nargs = { a = [] }".to_owned(), "3:10", "empty"),
        (
            "[[robot]]\npath = \"a\"\nargs = { a = { b = 1 } }".to_owned(),
            "3:14",
            "a text, a number",
        ),
        ("[[robot]]\nname = \"a\"".to_owned(), "1:1", "path"),
        ("[[robot]]\npath = \"a\"\narg = { a = 1 }".to_owned(), "3:1", "arg"),
    ] {
        let why = read(&text).unwrap_err();
        assert!(why.starts_with(&format!("{place}:")) && why.contains(words), "{place}: {why}");
    }
    // Programs that only need the rest still say it.
    assert!(Settings::from_toml("[[robot]]\npath = 1").is_err());
}

#[test]
fn lines_are_added_behind_what_is_there() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("urdd.toml");
    let lines = "\n[[robot]]\npath = \"a\"\n";
    assert_eq!(SettingsFile::with_lines(&file, lines).unwrap(), &lines[1..]);
    let own = "# mine\n[severity]\nLNT001 = \"info\" # so";
    std::fs::write(&file, own).unwrap();
    assert_eq!(SettingsFile::with_lines(&file, lines).unwrap(), format!("{own}\n{lines}"));
    for own in ["robot = [{ path = \"b\" }]", "x = ["] {
        std::fs::write(&file, own).unwrap();
        assert!(SettingsFile::with_lines(&file, lines).is_err(), "{own}");
    }
}
