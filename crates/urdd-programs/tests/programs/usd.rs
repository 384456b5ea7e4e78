//! What the converter for Isaac and Newton does with links that are fixed and have no shape, and with attributes that have a
//! prefix, each case given to urdf-usd-converter 0.3.4.

use urdd_programs::{Deed, Effects, File, Mesh, Program};
use urdd_xml::{Counted, Kind};

fn read(text: &str) -> Effects {
    let counted = Counted::new(text.as_bytes(), Kind::Robot).unwrap();
    Program::Isaac.read(&File::new(counted, &|_| Mesh::Missing))
}

#[test]
fn an_inertia_that_goes_to_the_link_above_is_usual_unless_links_are_below() {
    let inertial = r#"<inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>"#;
    let shape = r#"<visual><geometry><box size="1 1 1"/></geometry></visual>"#;
    let of = |above: &str| {
        read(&format!(
            r#"<robot name="arm"><link name="base">{shape}</link><link name="body">{inertial}</link>
            <joint name="f" type="fixed"><parent link="base"/><child link="body"/></joint>
            <link name="tip">{inertial}{shape}</link>
            <joint name="j" type="continuous"><parent link="{above}"/><child link="tip"/><axis xyz="0 0 1"/></joint></robot>"#
        ))
    };
    let dropped = |effects: &Effects| {
        let mut all = effects.kept().iter().filter(|effect| effect.deed == Deed::Drops);
        all.any(|effect| effect.part.to_string() == "link/body")
    };
    let beside = of("base");
    assert!(dropped(&beside) && beside.kept().iter().all(|effect| effect.fault.is_usual()));
    let below = of("body");
    let faults = below.kept().iter().filter(|effect| !effect.fault.is_usual());
    let said: Vec<String> = faults.map(|effect| effect.fault.to_string()).collect();
    let lost = "its inertia goes to the link above, and all below it is lost";
    assert!(dropped(&below) && said.iter().any(|one| one == lost), "{said:?}");
}

#[test]
fn an_attribute_with_a_prefix_is_called_so() {
    let of = |attribute: &str| {
        let inside = format!(r#"<gazebo><mu {attribute}="base">1</mu></gazebo>"#);
        let effects = read(&format!(
            r#"<robot name="arm" xmlns:gz="http://gazebosim.org/schema"><link name="base"/>{inside}</robot>"#
        ));
        effects
            .kept()
            .iter()
            .find(|effect| effect.deed == Deed::Refuses)
            .map(|it| it.fault.to_string())
    };
    let name = "in USD no attribute has a `-`, a `.` or a prefix in its name";
    let prefixed = format!("an attribute with a prefix is called `expressed_in`, and {name}");
    assert_eq!(of("gz:expressed_in"), Some(prefixed));
    assert_eq!(of("a-b"), Some(format!("an attribute is called `a-b`, and {name}")));
    assert_eq!(of("expressed_in"), None);
}
