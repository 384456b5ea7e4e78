//! Names of loops and couplings in exports.

use urdd_export::{Choices, Format};

use crate::loops::{again, exported, made_of, module};

const URDF: &str = r#"<robot name="fb"><link name="ground"/><link name="crank"/><link name="coupler"/><link name="rocker"/><link name="wheel"/>
<joint name="a" type="continuous"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/></joint>
<joint name="b" type="continuous"><parent link="crank"/><child link="coupler"/><origin xyz="0.1 0 0"/><axis xyz="0 0 1"/></joint>
<joint name="c" type="continuous"><parent link="ground"/><child link="rocker"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/></joint>
<joint name="j1" type="continuous"><parent link="ground"/><child link="wheel"/><axis xyz="0 0 1"/></joint></robot>"#;

fn of_kind(name: &str, kind: &str) -> String {
    format!(
        "[[loop]]\nname = \"{name}\"\nkind = {kind:?}\nlink_a = \"coupler\"\nframe_a = {{ xyz = [0.3, 0.0, 0.0] }}\nlink_b = \"rocker\"\nframe_b = {{ xyz = [0.1, 0.0, 0.0] }}\n"
    )
}

#[test]
fn an_mjcf_has_the_names_of_loops_and_couplings() {
    let toml = of_kind("pin", "Spherical")
        + "[[coupling]]\nname = \"hold\"\nconstant = -0.5\nterms = { j1 = [1.0] }\n";
    let (_folder, robot) = made_of(URDF, &toml);
    let made = exported(&robot, Format::Mjcf, Choices::default());
    for words in ["<connect name=\"pin\"", "<joint name=\"hold\" joint1=\"j1\" polycoef=\"0.5 0"] {
        assert!(made.text.contains(words), "{words}: {}", made.text);
    }
    let (_again, same) = again(&made, "r.xml");
    let module = module(&same);
    assert_eq!(module.loops[0].name, "pin");
    let [hold] = &module.couplings[..] else { panic!("{:?}", module.couplings) };
    assert_eq!((&*hold.name, hold.constant), ("hold", -0.5));
    let [term] = &hold.terms[..] else { panic!("{hold:?}") };
    assert_eq!(term.coefficients, [1.0, 0.0, 0.0, 0.0]);
}

/// MuJoCo refuses two equalities of one name.
#[test]
fn the_two_points_of_a_hinge_have_two_names() {
    let toml = of_kind("pin", "Revolute") + &of_kind("pin/1", "Spherical");
    let (_folder, robot) = made_of(URDF, &toml);
    let made = exported(&robot, Format::Mjcf, Choices::default());
    let names: Vec<&str> = made
        .text
        .split("<connect name=\"")
        .skip(1)
        .filter_map(|rest| Some(rest.split_once('"')?.0))
        .collect();
    let distinct: std::collections::BTreeSet<&str> = names.iter().copied().collect();
    assert_eq!((names.len(), distinct.len()), (3, 3), "{names:?}");
    assert!(distinct.contains("pin") && distinct.contains("pin/1"), "{names:?}");
}

#[test]
fn a_usd_escapes_what_is_not_seen() {
    let toml = of_kind("p\u{9b}\u{202e}\u{85}é", "Spherical");
    let (_folder, robot) = made_of(URDF, &toml);
    let made = exported(&robot, Format::Usd, Choices::default());
    // The bytes of UTF-8.
    let name = r#"displayName = "p\xc2\x9b\xe2\x80\xae\xc2\x85é""#;
    assert!(made.text.contains(name), "{}", made.text);
    assert!(!made.text.contains(['\u{9b}', '\u{202e}', '\u{85}']));
}
