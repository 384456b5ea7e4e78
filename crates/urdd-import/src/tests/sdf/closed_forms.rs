//! What libsdformat 12 does not know or does not compute, against closed forms.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Point3, Vector3};

use super::{body, fixture, given, inside, joint};
use crate::model::{Geometry, Inertial, JointKind, Mimic};
use crate::tests::Entries as _;

#[test]
fn a_screw_is_a_hinge_and_a_slide_that_follows() {
    let model = fixture("joints.sdf");
    let (moved, slide) = joint(&model, "screw/thread");
    assert_eq!((moved.joints.len(), slide.kind), (2, JointKind::Slide));
    // `thread_pitch` is in radians for a metre, of a left-handed thread.
    let mimic = slide.mimic.as_ref().expect("a mimic");
    assert_eq!(mimic.joint, "screw");
    assert!((mimic.multiplier - 0.25).abs() < 1e-15, "{}", mimic.multiplier);
    assert_eq!(slide.range, Some([-0.75, 0.75]));
    let right = inside(
        "1.11",
        "<link name='a'/><link name='b'/><joint name='j' type='screw'><parent>a</parent><child>b</child>\
         <screw_thread_pitch>0.5</screw_thread_pitch><thread_pitch>3</thread_pitch></joint>",
    );
    let right = right.expect("a model");
    let mimic = joint(&right, "j/thread").1.mimic.clone().expect("a mimic");
    assert_eq!(mimic.multiplier, 0.5 / TAU);
}

#[test]
fn a_universal_joint_turns_about_its_axes_in_order() {
    let model = fixture("joints.sdf");
    let names: Vec<&str> = body(&model, "c").joints.iter().map(|joint| &*joint.name).collect();
    assert_eq!(names, ["uni/axis", "uni/axis2"]);
}

#[test]
fn followers_have_the_offset_of_their_reference() {
    let model = inside(
        "1.11",
        "<link name='a'/><link name='b'/><link name='c'/>
         <joint name='k' type='universal'><parent>a</parent><child>b</child><axis/><axis2/></joint>
         <joint name='j' type='revolute'><parent>b</parent><child>c</child><axis><mimic joint='k' axis='axis2'>
         <multiplier>2</multiplier><offset>0.5</offset><reference>0.1</reference></mimic></axis></joint>",
    );
    let mimic = joint(&model.expect("a model"), "j").1.mimic.clone();
    assert_eq!(mimic, Some(Mimic { joint: "k/axis2".to_owned(), multiplier: 2.0, offset: 0.3 }));
}

#[test]
fn a_limit_alone_gets_another() {
    let range = |limits: &str, kind: &str| {
        let text = format!(
            "<link name='a'/><link name='b'/><joint name='j' type='{kind}'><parent>a</parent><child>b</child>\
             <axis><limit>{limits}</limit></axis></joint>"
        );
        joint(&inside("1.9", &text).expect("a model"), "j").1.range
    };
    assert_eq!(range("<lower>-0.5</lower>", "revolute"), Some([-0.5, 4.0 * PI]));
    assert_eq!(range("<upper>-20</upper>", "prismatic"), Some([-30.0, -20.0]));
    assert_eq!(range("<lower>-inf</lower><upper>1e16</upper>", "prismatic"), None);
    assert_eq!(range("<lower>0</lower><upper>1</upper>", "continuous"), None);
}

/// The mass of a link with `auto` and collision shapes.
fn auto(inertial: &str, shapes: &[(&str, &str)]) -> Inertial {
    let collision = |(pose, shape): &(&str, &str)| {
        format!(
            "<collision name='{pose}'><pose>{pose}</pose><geometry>{shape}</geometry></collision>"
        )
    };
    let shapes: String = shapes.iter().map(collision).collect();
    let text = format!("<link name='a'><inertial auto='true'>{inertial}</inertial>{shapes}</link>");
    let model = inside("1.11", &text).expect("a model");
    body(&model, "a").inertial.expect("a mass")
}

fn is_near(left: &Matrix3<f64>, right: [f64; 3]) -> bool {
    (left - Matrix3::from_diagonal(&Vector3::from(right))).amax() < 1e-12 * left.amax()
}

#[test]
fn shapes_give_mass_by_density() {
    const STILL: &str = "0 0 0 0 0 0";
    let ball = auto("<density>100</density>", &[(STILL, "<sphere><radius>0.5</radius></sphere>")]);
    let mass = 100.0 * PI / 6.0;
    assert!((ball.mass - mass).abs() < 1e-12);
    assert!(is_near(&ball.inertia, [0.1 * mass; 3]));

    let rod = "<cylinder><radius>0.1</radius><length>2</length></cylinder>";
    let rod = auto("", &[("0 0 0 1.5707963267948966 0 0", rod)]);
    let mass = 1000.0 * PI * 0.02;
    let across = mass * (0.01 / 4.0 + 4.0 / 12.0);
    assert!(is_near(&rod.inertia, [across, mass * 0.005, across]));

    let cone = auto("", &[(STILL, "<cone><radius>0.3</radius><length>0.8</length></cone>")]);
    assert!((cone.centre - Point3::new(0.0, 0.0, -0.2)).amax() < 1e-15);
    assert!((cone.mass - 1000.0 * PI * 0.09 * 0.8 / 3.0).abs() < 1e-10);

    // A capsule without length is a ball; a long one is a rod.
    let flat =
        auto("", &[(STILL, "<capsule><radius>0.5</radius><length>1e-12</length></capsule>")]);
    assert!((flat.inertia - ball.inertia * 10.0).amax() < 1e-9);

    // Two cubes of 1 m, 2 m apart: by Steiner, each 1/6 and 1 kg m² for 1 kg.
    let cube = "<box><size>1 1 1</size></box>";
    let two = auto("<mass>2</mass>", &[("1 0 0 0 0 0", cube), ("-1 0 0 0 0 0", cube)]);
    assert_eq!((two.mass, two.centre), (2.0, Point3::origin()));
    assert!(is_near(&two.inertia, [1.0 / 3.0, 1.0 / 3.0 + 2.0, 1.0 / 3.0 + 2.0]));
}

#[test]
fn colours_are_as_opaque_as_their_shape() {
    let model = fixture("shapes.sdf");
    let shapes = &body(&model, "a").shapes;
    let material = shapes[0].material.as_ref().expect("a material");
    assert_eq!(material.rgba, Some([0.5, 0.25, 1.0, 0.75]));
    assert_eq!(model.friction, Some(0.6));
    let Geometry::Mesh { asset, scale } = shapes[2].geometry else { panic!("no mesh") };
    assert_eq!((&*model.assets[asset].path, scale), ("meshes/flat.obj", [2.0; 3]));
    // What the mesh names goes with it.
    assert!(model.assets.iter().any(|asset| asset.path == "meshes/flat.mtl"));
}

/// Two triangles: one at the origin, one with its middle at (2, 3, 0).
const OBJ: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 2 0\nv 3 2 0\nv 1 4 0\no near\nf 1 2 3\no far\nf 4 5 6\n";
const COLLADA: &str = "<COLLADA><library_geometries><geometry id='g'><mesh>\
    <source id='s'><float_array id='f' count='9'>1 2 0 3 2 0 1 4 0</float_array><technique_common>\
    <accessor source='#f' count='3' stride='3'/></technique_common></source>\
    <vertices id='v'><input semantic='POSITION' source='#s'/></vertices>\
    <triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p></triangles>\
    </mesh></geometry></library_geometries><library_visual_scenes><visual_scene id='w'>\
    <node name='far'><instance_geometry url='#g'/></node>\
    <node name='near'><translate>-1 -2 0</translate><instance_geometry url='#g'/></node>\
    </visual_scene></library_visual_scenes><scene><instance_visual_scene url='#w'/></scene></COLLADA>";

#[test]
fn a_part_of_a_mesh_is_a_mesh_of_its_own() {
    for (file, text) in [("m.obj", OBJ), ("m.dae", COLLADA)] {
        let shape = |part: &str, center: bool| {
            format!(
                "<visual name='v'><pose>0 0 1 0 0 0</pose><geometry><mesh><uri>{file}</uri><scale>2 1 1</scale>\
                 <submesh><name>{part}</name><center>{center}</center></submesh></mesh></geometry></visual>"
            )
        };
        let shapes = [shape("far", true), shape("near", false), shape("none", true)].concat();
        let text_of_model = format!(
            "<sdf version='1.6'><model name='m'><link name='a'>{shapes}</link></model></sdf>"
        );
        let model = given(&text_of_model, &[(file, text)]).expect("a model");
        let shapes = &body(&model, "a").shapes;
        assert_eq!((shapes.len(), model.assets.len()), (2, 2), "{file}");
        // Scaled about its own middle.
        assert_eq!(shapes[0].pose.translation.vector, Vector3::new(-4.0, -3.0, 1.0));
        assert_eq!(shapes[1].pose.translation.vector, Vector3::new(0.0, 0.0, 1.0));
        let bounds = |index: usize| {
            let asset = &model.assets[index];
            let scene = urdd_geometry::read::read(&asset.bytes, &asset.path, &mut |_| None);
            let bounds = scene.expect("a mesh").merged().bounds().expect("bounds");
            (bounds.min, bounds.max)
        };
        assert_eq!(bounds(0), ([1.0, 2.0, 0.0], [3.0, 4.0, 0.0]), "{file}");
        assert_eq!(bounds(1).0, [0.0; 3], "{file}");
    }
}

#[test]
fn a_shape_without_a_size_has_that_of_sdf() {
    let of = |shape: &str| {
        let text = format!(
            "<link name='a'><collision name='c'><geometry>{shape}</geometry></collision></link>"
        );
        let model = inside("1.12", &text).expect("a model");
        let said = model.tally.remarks.iter().filter(|one| one.text.contains("SDF gives it"));
        (body(&model, "a").shapes[0].geometry.clone(), said.count())
    };
    // What the specification says of each.
    for (text, wanted, said) in [
        ("<sphere>1</sphere>", Geometry::Sphere(1.0), 1),
        ("<sphere/>", Geometry::Sphere(1.0), 1),
        ("<box/>", Geometry::Box([1.0; 3]), 1),
        ("<box>1 2 3</box>", Geometry::Box([1.0; 3]), 1),
        ("<cylinder/>", Geometry::Cylinder { radius: 1.0, length: 1.0 }, 2),
        (
            "<cylinder><length>3</length></cylinder>",
            Geometry::Cylinder { radius: 1.0, length: 3.0 },
            1,
        ),
        ("<capsule/>", Geometry::Capsule { radius: 0.5, length: 1.0 }, 2),
        ("<ellipsoid/>", Geometry::Ellipsoid([1.0; 3]), 1),
        ("<sphere><radius>2</radius></sphere>", Geometry::Sphere(2.0), 0),
    ] {
        assert_eq!(of(text), (wanted, said), "{text}");
    }
    assert!(matches!(of("<cone/>").0, Geometry::Mesh { scale: [1.0, 1.0, 1.0], .. }));
}

/// Seen from the base, the second wheel turns by minus the ratio of what the first does; axes and joints may point the other
/// way, and a wheel may be on an arm that turns too.
#[test]
fn a_gearbox_is_an_equation_of_what_turns_its_links() {
    let coupled = |reference: &str, axis2: &str, second: &str| {
        let joint = |name: &str, parent: &str, child: &str, axis: &str| {
            format!(
                "<joint name='{name}' type='revolute'><parent>{parent}</parent><child>{child}</child><axis><xyz>{axis}</xyz></axis></joint>"
            )
        };
        let text = format!(
            "<link name='base'/><link name='p'/><link name='arm'><pose>1 0 0 0 0 0.3</pose></link><link name='c'><pose>2 0 0 3.141592653589793 0 0</pose></link>{}{}{}{}
             <joint name='gears' type='gearbox'><parent>p</parent><child>c</child><gearbox_ratio>-1.5</gearbox_ratio>
             {reference}<axis><xyz expressed_in='__model__'>0 0 1</xyz></axis><axis2><xyz expressed_in='__model__'>{axis2}</xyz></axis2></joint>",
            "<joint name='still' type='fixed'><parent>world</parent><child>base</child></joint>",
            joint("a", "base", "p", "0 0 -1"),
            joint("b", "base", "arm", "0 0 1"),
            joint("d", "arm", "c", second),
        );
        inside("1.9", &text).expect("a model")
    };
    let terms = |model: &crate::model::Model| {
        let coupled = model.couplings.all().first().expect("a coupling");
        assert_eq!((coupled.name.as_deref(), coupled.constant), (Some("gears"), 0.0));
        let terms = coupled.terms.iter().map(|(name, of)| (name.clone(), of.clone()));
        terms.collect::<Vec<_>>()
    };
    let of = |name: &str, factor: f64| (name.to_owned(), vec![factor]);
    // The child's own z points down: `d` turns it back about z.
    let base = "<gearbox_reference_body>base</gearbox_reference_body>";
    let model = coupled(base, "0 0 1", "0 0 1");
    assert_eq!(terms(&model), [of("a", 1.5), of("b", 1.0), of("d", -1.0)]);
    assert_eq!(model.tally.number_of(crate::features::GEARBOXES), 1);
    // About the other direction, its angle has the other sign.
    assert_eq!(
        terms(&coupled(base, "0 0 -1", "0 0 1")),
        [of("a", 1.5), of("b", -1.0), of("d", 1.0)]
    );
    // From the arm, the parent turns by what it does and what the arm turns back.
    let arm = "<gearbox_reference_body>arm</gearbox_reference_body>";
    assert_eq!(terms(&coupled(arm, "0 0 1", "0 0 1")), [of("a", 1.5), of("b", 1.5), of("d", -1.0)]);
    // Without one it is the world, to which the base is fixed.
    assert_eq!(terms(&coupled("", "0 0 1", "0 0 1")), terms(&model));
    // What turns about another axis is no angle about this one.
    let lost = coupled(base, "0 0 1", "0 1 1");
    assert_eq!(lost.couplings.len(), 0);
    assert_eq!(lost.tally.number_of(crate::features::LOST_GEARBOXES), 1);
    let nowhere = "<gearbox_reference_body>nowhere</gearbox_reference_body>";
    let lost = coupled(nowhere, "0 0 1", "0 0 1");
    assert_eq!(lost.couplings.len(), 0);
    let remarks = |model: &crate::model::Model| {
        model.tally.remarks.iter().map(|of| of.text.clone()).collect::<Vec<_>>().join("\n")
    };
    assert!(
        remarks(&lost).contains("there is no link `nowhere`, its reference body"),
        "{}",
        remarks(&lost)
    );
    assert!(!remarks(&model).contains("the world is taken"), "{}", remarks(&model));
    let assumed = remarks(&coupled("", "0 0 1", "0 0 1"));
    assert!(assumed.contains("names no `gearbox_reference_body`: the world is taken"), "{assumed}");
}

/// A gearbox of a link with itself is none, and one of the ratio 0 holds its child.
#[test]
fn a_gearbox_that_locks_a_joint_says_so() {
    let of = |parent: &str, ratio: &str| {
        inside("1.9", &format!(
            "<link name='base'/><link name='p'/><link name='c'/>
            <joint name='a' type='revolute'><parent>base</parent><child>p</child><axis><xyz>0 0 1</xyz></axis></joint>
            <joint name='b' type='revolute'><parent>base</parent><child>c</child><axis><xyz>0 0 1</xyz></axis></joint>
            <joint name='gears' type='gearbox'><parent>{parent}</parent><child>c</child><gearbox_ratio>{ratio}</gearbox_ratio>
            <gearbox_reference_body>base</gearbox_reference_body><axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 0 1</xyz></axis2></joint>",
        )).expect("a model")
    };
    let said = |model: &crate::model::Model, words: &str| {
        model.tally.remarks.iter().any(|of| of.text.contains(words))
    };
    assert!(!said(&of("p", "2"), "is 0"));
    let held = of("p", "0");
    assert_eq!(held.couplings.len(), 1);
    assert!(said(&held, "`gearbox_ratio` of `gears` is 0: its child does not turn"));
    let itself = of("c", "2");
    assert_eq!(itself.couplings.len(), 0);
    assert!(said(&itself, "it has the same link at both ends"));
}
