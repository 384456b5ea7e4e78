//! Paths in documents (SPEC 2.8): relative to the URDD's root, portable, never outside it.

use urdd_directory::path::*;

#[test]
fn each_fault_is_told_apart() {
    for (path, fault) in [
        ("", PathFault::Empty),
        ("/etc/passwd", PathFault::Absolute),
        ("a//b", PathFault::EmptyPart),
        ("a/", PathFault::EmptyPart),
        ("a/../b", PathFault::DotPart),
        ("./a", PathFault::DotPart),
        ("a\\b", PathFault::Backslash),
        ("C:/a", PathFault::Colon),
        ("a/b\n", PathFault::ControlCharacter),
    ] {
        assert_eq!(check(path), Err(fault), "{path:?}");
    }
}

#[test]
fn dots_and_spaces_within_a_part_are_fine() {
    for path in ["a", "a/b.stl", "..a/b..", "ä b/c", ".gitattributes"] {
        assert_eq!(check(path), Ok(()), "{path:?}");
    }
}

#[test]
fn what_is_made_portable_is_one_sound_part() {
    for (name, part) in [
        ("a b.stl", "a b.stl"),
        ("a\\b/c:d\n", "a_b_c_d_"),
        ("", "_"),
        (".", "_"),
        ("..", "_"),
        ("..a", "..a"),
    ] {
        assert_eq!(portable(name), part);
        assert_eq!(check(part), Ok(()));
    }
}

#[test]
fn a_file_name_is_one_that_every_file_system_takes() {
    for (stem, ending, name) in [
        ("arm", ".urdf", "arm.urdf"),
        ("my arm, v1.2", ".urdf", "my arm, v1.2.urdf"),
        ("nul", ".urdf", "_nul.urdf"),
        ("Con.x", "", "_Con.x"),
        ("com1 ", ".stl", "_com1 .stl"),
        ("lpt\u{b3}", "", "_lpt\u{b3}"),
        ("COM0", "", "_COM0"),
        ("CONIN$", ".x", "_CONIN$.x"),
        ("console", "", "console"),
        ("com", "", "com"),
        ("com12", "", "com12"),
        ("a.", "", "a_"),
        ("a ", "", "a_"),
        ("a.", ".x", "a..x"),
        ("a<b>c\"d|e?f*g:h/i\\j", ".x", "a_b_c_d_e_f_g_h_i_j.x"),
    ] {
        assert_eq!(file_name(stem, ending), name);
    }
    // Characters of one to four bytes, cut between two.
    for character in ["x", "\u{e9}", "\u{4f60}", "\u{1f600}"] {
        let name = file_name(&character.repeat(300), ".urdf");
        assert!((237..=240).contains(&name.len()) && name.ends_with(".urdf"), "{name}");
    }
    assert_eq!(file_name("a", &"x".repeat(300)).len(), 300);
}

#[test]
fn what_a_mesh_names_is_found_from_its_folder() {
    let of = |named| beside("m/meshes/arm/base.obj", named);
    assert_eq!(of("base.mtl").as_deref(), Some("m/meshes/arm/base.mtl"));
    assert_eq!(of("./../tex\\a.png").as_deref(), Some("m/meshes/tex/a.png"));
    assert_eq!(of("/tex//a:b.png").as_deref(), Some("m/meshes/arm/tex/a_b.png"));
    assert_eq!(of("../../../../a.png"), None);
}
