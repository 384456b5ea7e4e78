//! Colours in three.js.

use urdd_programs::{Deed, File, Mesh, Program};
use urdd_xml::{Counted, Kind};

use crate::meshes;

#[test]
fn a_collada_mesh_loses_a_material_only_where_its_visual_has_one() {
    let visual = |file: &str, inside: &str| {
        let mesh = format!("<geometry><mesh filename=\"{file}\"/></geometry>");
        format!("<visual>{mesh}{inside}</visual>")
    };
    let red = r#"<material name="red"><color rgba="1 0 0 1"/></material>"#;
    let visuals =
        [visual("part.dae", ""), visual("part.dae", red), visual("part.stl", red)].concat();
    let text = format!("<robot name=\"arm\"><link name=\"base\">{visuals}</link></robot>");
    let counted = Counted::new(text.as_bytes(), Kind::Robot).unwrap();
    let program = Program::Three;
    let find = |name: &str| meshes::find(program, "all.urdf", name);
    let effects = program.read(&File::new(counted, &find));
    let of = |deed: Deed| {
        let all = effects.kept().iter().filter(move |effect| effect.deed == deed);
        all.map(|effect| effect.part.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(of(Deed::Drops), ["link/base/visual/1/material"]);
    assert_eq!(of(Deed::Reads), ["link/base/visual/0/material"]);
    assert!(effects.kept().iter().all(|effect| effect.fault.is_usual()));
}

#[test]
fn white_space_between_the_numbers_of_a_colour_is_told_and_what_is_read() {
    let read = |rgba: &str, name: &str| {
        let material = format!("<material name=\"red\"><color rgba=\"{rgba}\"/></material>");
        let shape = "<geometry><sphere radius=\"1\"/></geometry>";
        let visual = format!("<visual>{shape}<material name=\"{name}\"/></visual>");
        let text =
            format!("<robot name=\"arm\">{material}<link name=\"a\">{visual}</link></robot>");
        let counted = Counted::new(text.as_bytes(), Kind::Robot).unwrap();
        let effects = Program::Three.read(&File::new(counted, &|_| Mesh::Missing));
        let of_robot = effects.kept().iter().filter(|effect| effect.part.starts_with("material/"));
        let said = of_robot.map(|effect| (effect.fault.to_string(), effect.makes.clone().unwrap()));
        said.collect::<Vec<_>>()
    };
    assert!(read("0.1 0.2 0.3 1", "red").is_empty());
    let spaces = "`rgba` is `0.1 0.2 0.3   1`, and should be 4 numbers";
    let made = |words: &str, made: &str| vec![(words.to_owned(), made.to_owned())];
    assert_eq!(read("0.1 0.2 0.3   1", "red"), made(spaces, "0.1 0.2 0.3 NaN"));
    let text = "`rgba` is `1 0.2x 0 1`, which is not only a number";
    assert_eq!(read("1 0.2x 0 1", "red"), made(text, "1 0.2 0 1"));
    // No visual has it.
    assert!(read("0.1 0.2 0.3   1", "blue").is_empty());
}
