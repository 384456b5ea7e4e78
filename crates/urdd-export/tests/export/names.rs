//! Names that formats can represent, and file names.

use urdd_export::Format;
use urdd_export::names::*;

#[test]
fn names_of_files_are_safe_and_differ() {
    let mut names = FileNames::default();
    assert_eq!(names.of("../a b"), "_.._a_b");
    assert_eq!(names.of("Arm"), "Arm");
    assert_eq!(names.of("arm"), "arm-2");
    assert_eq!(names.of("arm"), "arm-3");
    assert_eq!(names.of(""), "_");
    for device in ["con", "NUL.x", "com1", "Lpt9.a.b", "aux", "-rf", "--help"] {
        assert_eq!(names.of(device), format!("_{device}"));
    }
    for plain in ["console", "com", "comx", "lpt10", "a.con", "nul_"] {
        assert_eq!(names.of(plain), plain);
    }
    assert!(names.of(&"x".repeat(500)).len() <= LONGEST);
}

#[test]
fn a_name_that_a_format_cannot_hold_is_an_error() {
    let of = |format, what, name: &str| one(format, what, name).is_ok();
    assert!(of(Format::Srdf, "link", "a<b>\"&'\n\t\r\u{7f}\u{85}\u{202e}"));
    for name in ["\0", "a\u{1b}", "\u{fffe}", "\u{ffff}"] {
        assert!(!of(Format::Srdf, "link", name));
        assert!(of(Format::Curobo, "link", name));
    }
    assert!(of(Format::Curobo, "link", &"x".repeat(100_000)));
    for name in ["${x}", "$(x)", "$$", "a$$b", "a\tb", "a\nb", "a\rb", "-", "--ros-args"] {
        assert!(!of(Format::Moveit, "link", name), "{name:?}");
        assert!(of(Format::Urdf, "link", name), "{name:?}");
    }
    for name in ["$x", "a$", "{{x}}", "a-b", "$ {x}"] {
        assert!(of(Format::Moveit, "link", name), "{name:?}");
    }
    assert!(of(Format::Foam, "link", &"x".repeat(100_000)));
    assert!(!of(Format::Urdf, "joint", ""));
    assert!(of(Format::Urdf, "robot", ""));
    assert!(!of(Format::Drake, "robot", ""));
    assert!(!of(Format::Drake, "link", "a::b"));
    // Drake 1.51: `body with name 'rob:::base' not found`, and model `rob` for `::rob`.
    for format in [Format::Drake, Format::Sdf] {
        assert!(!of(format, "link", ":base") && !of(format, "link", ":"));
        assert!(of(format, "link", "base:") && of(format, "link", "b:ase"));
        assert!(
            of(format, "joint", ":j") && of(format, "robot", ":rob") && of(format, "robot", "rob:")
        );
        assert!(!of(format, "robot", ":") && !of(format, "robot", "::"));
    }
    assert!(!of(Format::Drake, "robot", "::rob") && !of(Format::Drake, "robot", "rob::"));
    assert!(of(Format::Drake, "robot", "r::ob"));
    assert!(check_unique(Format::Mjcf, "joint", ["a", "b"], "twice").is_ok());
    assert!(check_unique(Format::Mjcf, "joint", ["a", "b", "a"], "twice").is_err());
}
