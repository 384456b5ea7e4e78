//! What libsdformat 12.3 refuses is said, of files that are imported. Each case was given to it.

use super::{given, inside};

const SHAPE: &str = "<geometry><sphere><radius>1</radius></sphere></geometry>";
const LINKS: &str = "<link name='a'/><link name='b'/>";

/// What is said of a refusal by Gazebo.
fn refusals(text: &str) -> Vec<String> {
    let model = given(text, &[]).unwrap_or_else(|fault| panic!("{text}: {}", fault.fault));
    let said = model.tally.remarks.iter().map(|remark| remark.text.clone());
    said.filter_map(|text| text.strip_prefix("Gazebo refuses the file: ").map(str::to_owned))
        .collect()
}

fn of_model(version: &str, text: &str) -> Vec<String> {
    refusals(&format!("<sdf version='{version}'><model name='m'>{text}</model></sdf>"))
}

#[track_caller]
fn refused(text: &str, wanted: &str) {
    let said = of_model("1.9", text);
    assert!(matches!(&said[..], [said] if said.contains(wanted)), "{text}: {said:?}");
}

fn joint(ends: [&str; 2], name: &str) -> String {
    let [parent, child] = ends;
    format!(
        "<joint name='{name}' type='fixed'><parent>{parent}</parent><child>{child}</child></joint>"
    )
}

fn inertia(mass: f64, [x, y, z, xy]: [f64; 4]) -> String {
    format!(
        "<link name='a'><inertial><mass>{mass}</mass><inertia><ixx>{x}</ixx><iyy>{y}</iyy><izz>{z}</izz>\
         <ixy>{xy}</ixy></inertia></inertial></link>"
    )
}

#[test]
fn what_loads_is_not_said_to_be_refused() {
    let fine = [
        LINKS.to_owned() + &joint(["a", "b"], "j"),
        inertia(1.0, [1.0, 1.0, 2.0, 0.0]),
        inertia(0.0, [1.0, 1.0, 1.0, 0.0]),
        inertia(1.0, [0.0, 0.0, 0.0, 0.0]),
        inertia(1e-9, [1e-12, 1e-12, 1e-12, 0.0]),
        format!("<static>TRUE</static>{LINKS}"),
        format!(
            "<link name='a'><visual name='a'>{SHAPE}</visual><collision name='a'>{SHAPE}</collision></link>"
        ),
        format!("{LINKS}<plugin name='p' filename='q'><link name='a::b'/><plugin/></plugin>"),
        format!("{LINKS}<plugin name='p' filename='q'/><plugin name='p' filename='q'/>"),
        // The name of a plugin is that of a class.
        format!("{LINKS}<plugin name='gz::sim::systems::Physics' filename='q'/>"),
    ];
    for text in fine {
        assert_eq!(of_model("1.9", &text), [""; 0], "{text}");
    }
    let contact =
        "<sensor name='s' type='contact'><contact><collision>c</collision></contact></sensor>";
    assert_eq!(of_model("1.9", &format!("<link name='a'>{contact}</link>")), [""; 0]);
    let state = "<world name='w'><state world_name='w'><model name='m'/></state>";
    let text = format!("<sdf version='1.9'>{state}<model name='m'>{LINKS}</model></world></sdf>");
    assert_eq!(refusals(&text), [""; 0]);
    let joint = joint(["a", "b"], "a");
    assert_eq!(of_model("1.6", &format!("{LINKS}{joint}")), [""; 0]);
    assert_eq!(of_model("1.7", "<link name='x'/><link name='a::b'/>"), [""; 0]);
}

#[test]
fn names_that_gazebo_refuses_are_said() {
    refused("<link name='__x__'/>", "`<link>` `__x__` has a name that is reserved");
    refused(&format!("{LINKS}<frame name='__f__'/>"), "reserved");
    refused(&(LINKS.to_owned() + &joint(["a", "b"], "world")), "`<joint>` `world` has a name that");
    refused("<link name='a::b'/>", "has `::` in its name");
    refused(&format!("<link name='a'><visual name='a::v'>{SHAPE}</visual></link>"), "`::`");
    refused(&format!("<link name='a'><visual>{SHAPE}</visual></link>"), "`<visual>` has no name");
    refused(&format!("<link name='a'><visual name=''>{SHAPE}</visual></link>"), "has no name");
    let two = format!("<visual name='v'>{SHAPE}</visual>").repeat(2);
    refused(&format!("<link name='a'>{two}</link>"), "`<visual>` `v` has the name of another");
    refused(&(LINKS.to_owned() + &joint(["a", "b"], "a")), "`<joint>` `a` has the name of another");
    refused(&format!("{LINKS}<frame name='a'/>"), "has the name of another");
    refused(&format!("{LINKS}<plugin filename='x'/>"), "`<plugin>` has no name");
    refused(&format!("{LINKS}<plugin name='x'/>"), "has no `filename`");
    refused("<link name='a'><sensor name='s'/></link>", "`<sensor>` has no `type`");
    let reserved =
        refusals("<sdf version='1.9'><model name='__m__'><link name='a'/></model></sdf>");
    assert_eq!(reserved.len(), 1);
}

#[test]
fn what_else_gazebo_refuses_is_said() {
    let masses = [
        (-1.0, [1.0, 1.0, 1.0, 0.0]),
        (1.0, [1.0, 1.0, 3.0, 0.0]),
        (1.0, [-1.0, 1.0, 1.0, 0.0]),
        (1.0, [1.0, 1.0, 1.0, 5.0]),
    ];
    for (mass, moments) in masses {
        refused(&inertia(mass, moments), "no body has such a mass");
    }
    refused("<pose relative_to='a'>1 0 0 0 0 0</pose><link name='a'/>", "is put relative to `a`");
    refused("<static>perhaps</static><link name='a'/>", "neither true nor false");
    let colour =
        format!("<visual name='v'>{SHAPE}<material><diffuse>2 0 0 1</diffuse></material></visual>");
    refused(&format!("<link name='a'>{colour}</link>"), "`<diffuse>` is `2 0 0 1`, not numbers");
    let script = format!(
        "<visual name='v'>{SHAPE}<material><script><name>x</name></script></material></visual>"
    );
    refused(&format!("<link name='a'>{script}</link>"), "`<script>` has no `<uri>`");
    refused(&format!("{LINKS}<model name='n'/>"), "is not static has no link");
    refused(&(LINKS.to_owned() + &joint(["a", "a"], "j")), "joint `j` has `a` at both ends");
    let light = "<sdf version='1.9'><model name='m'><link name='a'/></model><light name='l' type='point'/></sdf>";
    assert_eq!(refusals(light).len(), 1);
    let two = "<model name='n'><static>1</static><link name='a'/></model>";
    let text = format!("<sdf version='1.9'><model name='m'><link name='a'/></model>{two}</sdf>");
    assert_eq!(refusals(&text).len(), 1);
    let text =
        "<sdf version='1.9'><model name='m' canonical_link='zz'><link name='a'/></model></sdf>";
    assert!(refusals(text)[0].contains("`canonical_link` names `zz`"));
    let text = text.replace("canonical_link", "placement_frame");
    assert!(refusals(&text)[0].contains("`placement_frame` names `zz`"));
    let quaternion = "rotation_format='quat_xyzw' degrees='true'>0 0 0 0 0 0 1<";
    refused(&format!("<link name='a'><pose {quaternion}/pose></link>"), "not in degrees");
    let other = "<link name='a'><pose rotation_format='foo'>0 0 0 0 0 0</pose></link>";
    refused(other, "`rotation_format` is `foo`");
    let world = "<sdf version='1.9'><world><model name='m'><link name='a'/></model></world></sdf>";
    assert!(refusals(world)[0].contains("`<world>` has no name"));
}

#[test]
fn what_gazebo_refuses_for_the_same_reason_is_refused() {
    for text in [
        format!("{LINKS}<joint name='j' type='fixed'><parent>zz</parent><child>b</child></joint>"),
        "<link name='a'><pose relative_to='zz'/></link>".to_owned(),
        "<link name='a'><pose>0 0 0 0 0</pose></link>".to_owned(),
        "<link name='a'><inertial><mass>x</mass></inertial></link>".to_owned(),
        "<link name='a'><visual name='v'><geometry><box><size/></box></geometry></visual></link>"
            .to_owned(),
    ] {
        assert!(inside("1.9", &text).is_err(), "{text}");
    }
}
