//! What an MJCF means beyond shapes and masses. Numbers are closed forms, and were MuJoCo 4.0.0's.

use std::path::Path;

use nalgebra::Vector3;
use urdd_format::loops::LoopKind;

use super::mjcf::of_text;
use crate::features::{self, Feature};
use crate::model::{Joint, Model};
use crate::tests::Entries as _;

fn read(text: &str) -> Model {
    of_text(Path::new("/nowhere/m.xml"), text.to_owned(), None).unwrap()
}

fn joint<'m>(model: &'m Model, name: &str) -> &'m Joint {
    let mut joints = model.bodies.iter().flat_map(|body| body.joints.all());
    joints.find(|joint| joint.name == name).unwrap()
}

fn remarks(model: &Model) -> String {
    model.tally.remarks.iter().map(|of| format!("{}\n", of.text)).collect()
}

const SERVOS: &str = r#"<mujoco model="servo"><compiler angle="radian"/><worldbody><body name="base"><geom size=".1" mass="1"/>
<body name="arm" pos=".1 0 0"><joint name="turn" axis="0 1 0" armature=".2" range="-1 1" ref=".5"/>
<inertial pos=".5 0 0" mass="2" diaginertia=".1 .1 .1"/>
<body name="rod" pos="1 0 0"><joint name="push" type="slide" axis="1 0 0" range="0 .3"/>
<inertial pos="0 0 0" mass="3" diaginertia=".05 .05 .05"/></body></body>
<body name="hub"><joint name="wheel"/><geom size=".1" mass="1"/></body>
<body name="both"><joint name="two" actuatorfrcrange="-3 8"/><geom size=".1" mass="1"/></body></body></worldbody>
<actuator><position name="servo" joint="turn" kp="10" dampratio="1.5" gear="2" ctrlrange="-4 4" forcerange="-5 20"/>
<position name="push" joint="push" kp="100" dampratio="1" inheritrange="0.5"/>
<velocity name="drive" joint="wheel" kv="5" ctrlrange="-3 6" gear="0.5"/>
<position name="one" joint="two" kp="100"/><velocity name="other" joint="two" kv="7"/></actuator></mujoco>"#;

#[test]
fn servos_are_damped_as_the_mass_that_they_move_asks() {
    let model = read(SERVOS);
    let gains = |name| {
        let joint = joint(&model, name);
        [joint.kp.unwrap(), joint.kv.unwrap()]
    };
    // 0.2 of the motor, 0.1 + 2 0.5² of the arm, 0.05 + 3 1² of the rod, which slides along the arm and so feels no
    // turn; the gear counts twice in kp.
    let moved: f64 = 0.2 + 0.1 + 0.5 + 0.05 + 3.0;
    for (name, expected) in [
        ("turn", [40.0, 2.0 * 1.5 * (40.0 * moved).sqrt()]),
        ("push", [100.0, 2.0 * 300.0_f64.sqrt()]),
        ("wheel", [0.0, 5.0 * 0.25]),
        ("two", [100.0, 7.0]),
    ] {
        let found = gains(name);
        let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(is_near, "{name}: {found:?}, {expected:?}");
    }
    assert_eq!(model.tally.all_unread().len(), 0, "{:?}", model.tally.all_unread());
}

/// The mass that a force at a joint feels while the others are free, of a servo with `kp` 1 and `dampratio` 0.5.
fn felt(bodies: &str, name: &str) -> f64 {
    let model = read(&format!(
        r#"<mujoco><compiler angle="radian"/><worldbody>{bodies}</worldbody>
<actuator><position joint="{name}" kp="1" dampratio="0.5"/></actuator></mujoco>"#
    ));
    joint(&model, name).kv.unwrap().powi(2)
}

#[test]
fn servos_feel_what_is_coupled_as_far_as_it_gives_way() {
    let is_near = |found: f64, expected: f64| {
        assert!((found / expected - 1.0).abs() < 1e-9, "{found}, {expected}");
    };
    // M = [2.0825 0.82; 0.82 0.42]: 0.2 + 0.1 + 0.25² + 0.1 + 2 0.9², 0.1 + 2 0.4 0.9 and 0.1 + 2 0.4².
    let elbow = r#"<body><joint name="turn" armature=".2"/><inertial pos=".25 0 0" mass="1" diaginertia=".1 .1 .1"/>
<body pos=".5 0 0"><joint name="fold"/><inertial pos=".4 0 0" mass="2" diaginertia=".1 .1 .1"/></body></body>"#;
    is_near(felt(elbow, "turn"), 2.0825 - 0.82_f64.powi(2) / 0.42);
    is_near(felt(elbow, "fold"), 0.42 - 0.82_f64.powi(2) / 2.0825);
    // A slide between two bodies that float: 3 2 / (3 + 2). One that a ball holds: turned about the ball, and slid.
    let rod = |joint: &str, at: &str| {
        format!(
            r#"<body pos="1 2 3" euler="0.3 0.2 0.1">{joint}<inertial pos="0 0 0" mass="3" diaginertia=".2 .2 .2"/>
<body pos="{at}"><joint name="push" type="slide" axis="1 0 0"/><inertial pos="0 0 0" mass="2" diaginertia=".1 .1 .1"/></body></body>"#
        )
    };
    is_near(felt(&rod("<freejoint/>", "0.5 0 0"), "push"), 1.2);
    is_near(felt(&rod("", "0.5 0 0"), "push"), 2.0);
    // 2 - (2 0.5)² / (0.2 + 0.1 + 2 0.5²): the ball turns about z, as the slide is 0.5 m beside it.
    is_near(felt(&rod(r#"<joint type="ball"/>"#, "0 0.5 0"), "push"), 2.0 - 1.0 / 0.8);
}

#[test]
fn names_and_ranges_of_actuators_are_carried() {
    let model = read(SERVOS);
    let of = |name| joint(&model, name).actuator.clone();
    let turn = of("turn");
    assert_eq!((turn.name.as_deref(), turn.is_of_speed), (Some("servo"), false));
    assert_eq!((turn.control, turn.force), (Some([-2.0, 2.0]), Some([-10.0, 40.0])));
    let push = of("push");
    assert_eq!(push.name, None);
    // Half of the range about its middle.
    let [least, most] = push.control.unwrap();
    assert!((least - 0.075).abs() < 1e-15 && (most - 0.225).abs() < 1e-15);
    let wheel = of("wheel");
    assert_eq!((wheel.name.as_deref(), wheel.is_of_speed), (Some("drive"), true));
    assert_eq!((wheel.control, joint(&model, "wheel").velocity), (Some([-6.0, 12.0]), Some(12.0)));
    // Of two actuators of a joint, neither name is that of both.
    assert_eq!((of("two").name, of("two").force), (None, Some([-3.0, 8.0])));
    assert_eq!(joint(&model, "two").effort, Some(8.0));
    assert_eq!(model.tally.number_of(features::MORE_GAINS), 1);
}

/// Two bodies, and something more.
fn two(more: &str, first: &str, second: &str) -> Model {
    read(&format!(
        r#"<mujoco>{more}<worldbody><body name="a"><joint name="j"/>{first}<body name="b" pos="0.3 0 0"><joint name="k" range="-90 90"/>
        {second}<body name="c" pos="0.3 0 0"><joint name="l"/><geom size="0.1"/></body></body></body></worldbody></mujoco>"#
    ))
}

#[test]
fn what_is_lost_of_contacts_and_gravity_is_said() {
    let count = |model: &Model, of: Feature| model.tally.number_of(of);
    let geom = r#"<geom size="0.1"/>"#;
    let plain = two("", geom, geom);
    for feature in [features::TORSION, features::GRAVCOMP, features::PARTLY_APART] {
        assert_eq!(count(&plain, feature), 0, "{}", feature.name);
    }
    let model = two("", r#"<geom size="0.1" friction="1 0.05 0.01"/>"#, geom);
    assert_eq!(count(&model, features::TORSION), 1);
    let model = two(r#"<default><geom friction="1 0.005 0.0001"/></default>"#, geom, geom);
    assert_eq!(count(&model, features::TORSION), 0);
    let first = r#"<geom size="0.1"/><geom size="0.1" contype="2" conaffinity="2"/>"#;
    // `a` and `b` are neighbours; of `a` and `c`, half of the shapes collide.
    assert_eq!(count(&two("", first, geom), features::PARTLY_APART), 1);
    let text = r#"<mujoco><worldbody><body gravcomp="1"><joint/><geom size="1"/><body gravcomp="0"/></body></worldbody></mujoco>"#;
    assert_eq!(count(&read(text), features::GRAVCOMP), 1);
}

#[test]
fn without_its_filter_a_body_collides_with_the_one_that_it_moves_on() {
    let geom = r#"<geom size="0.1"/>"#;
    let pairs = |more: &str| {
        let model = two(more, geom, geom);
        let name = |index: usize| model.bodies[index].name.clone();
        let of = |pair: &crate::model::Apart| pair.bodies.map(name).concat();
        let [apart, checked] = [&model.apart, &model.checked];
        [apart, checked].map(|list| list.iter().map(of).collect::<Vec<String>>())
    };
    assert_eq!(pairs(""), [vec!["ab", "bc"], vec![]]);
    let off = r#"<option><flag filterparent="disable"/></option>"#;
    assert_eq!(pairs(off), [vec![], vec!["ab", "bc"]]);
    let exclude = format!(r#"{off}<contact><exclude body1="b" body2="a"/></contact>"#);
    assert_eq!(pairs(&exclude), [vec!["ab"], vec!["bc"]]);
}

#[test]
fn short_keys_are_filled_from_the_model() {
    // MuJoCo has 1, and the reference of what is not said: 20 and 30 degrees, no turn.
    let model = read(
        r#"<mujoco><worldbody><body><joint name="a" ref="20"/><geom size="0.1"/><body><joint name="b" type="ball"/><geom size="0.1"/>
        <body><joint name="c" ref="30"/><geom size="0.1"/></body></body></body></worldbody>
        <keyframe><key name="one" qpos="1"/><key name="part" qpos="2 0 0"/><key name="none"/></keyframe></mujoco>"#,
    );
    let values = |at: usize| -> Vec<Vec<f64>> {
        model.configurations[at].values.iter().map(|value| value.values.clone()).collect()
    };
    let degrees = |angle: f64| vec![angle.to_radians()];
    assert_eq!(values(0), [vec![1.0], vec![0.0; 3], degrees(30.0)]);
    // A quaternion of 0 is no turn.
    assert_eq!(values(2), [degrees(20.0), vec![0.0; 3], degrees(30.0)]);
}

#[test]
fn balls_may_be_limited_without_a_range() {
    let read = |joint: &str| {
        let text = format!(
            r#"<mujoco><worldbody><body><joint type="ball" {joint}/><geom size="0.1"/></body></worldbody></mujoco>"#
        );
        of_text(Path::new("/nowhere/m.xml"), text, None)
    };
    // As MuJoCo 4.0.0 reads and refuses them.
    for (joint, lost) in [
        (r#"limited="true""#, 1),
        (r#"limited="true" range="0 60""#, 1),
        (r#"limited="true" range="0 -1""#, 1),
        (r#"range="0 60""#, 1),
        (r#"range="20 10""#, 0),
        (r#"limited="false" range="-30 40""#, 0),
    ] {
        let model = read(joint).unwrap();
        assert_eq!(model.tally.number_of(features::BALL_RANGES), lost, "{joint}");
    }
    for joint in [r#"range="-30 40""#, r#"limited="true" range="20 10""#] {
        let fault = read(joint).unwrap_err().fault.to_string();
        assert!(fault.contains("`range` of a ball has 0"), "{joint}: {fault}");
    }
}

#[test]
fn meshes_without_faces_are_hulls() {
    let folder = tempfile::tempdir().unwrap();
    // The corners of a box of 0.2, 0.4, 0.6 m, and a point inside; its faces nobody says.
    let corners = (0..8).map(|bits| {
        let [x, y, z] = [0, 1, 2].map(|axis| f64::from((bits >> axis) & 1));
        format!("v {} {} {}\n", 0.2 * x, 0.4 * y, 0.6 * z)
    });
    let text = corners.collect::<String>() + "# points\nv 0.1 0.1 0.1\n";
    std::fs::write(folder.path().join("points.obj"), text).unwrap();
    let path = folder.path().canonicalize().unwrap().join("m.xml");
    let text = r#"<mujoco><asset><mesh file="points.obj"/></asset><worldbody><body><joint/><geom type="mesh" mesh="points"/></body></worldbody></mujoco>"#;
    let model = of_text(&path, text.to_owned(), None).unwrap();
    let inertial = model.bodies[1].inertial.as_ref().unwrap();
    assert!((inertial.mass - 1000.0 * 0.2 * 0.4 * 0.6).abs() < 1e-4, "{}", inertial.mass);
    assert!((inertial.centre - nalgebra::Point3::new(0.1, 0.2, 0.3)).norm() < 1e-6);
    assert_eq!(model.assets[0].path, "meshes/points.stl");
    // Four points in a plane have no hull, and MuJoCo refuses them.
    let flat = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
    std::fs::write(folder.path().join("points.obj"), flat).unwrap();
    let fault = of_text(&path, text.to_owned(), None).unwrap_err().fault.to_string();
    assert!(fault.contains("encloses no volume"), "{fault}");
}

#[test]
fn what_is_soft_and_what_a_plugin_makes_is_refused_for_its_reason() {
    let fault =
        |text: &str| of_text(Path::new("/nowhere/m.xml"), text.to_owned(), None).unwrap_err();
    let soft = r#"<mujoco><worldbody><flexcomp type="grid" count="3 3 1" spacing="1 1 1"/></worldbody></mujoco>"#;
    assert!(fault(soft).fault.to_string().contains("which are soft"));
    let made = |inertial: &str| {
        format!(
            r#"<mujoco><asset><mesh name="m"><plugin plugin="mujoco.sdf.torus"/></mesh></asset><worldbody><body name="b"><joint/>{inertial}
            <geom type="sdf" mesh="m"/></body></worldbody></mujoco>"#
        )
    };
    let said = fault(&made("")).fault.to_string();
    assert!(said.contains("`<inertial>`") && !said.contains("saveLastXML"), "{said}");
    let model = read(&made(r#"<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>"#));
    assert_eq!(model.tally.number_of(features::MISSING_MESHES), 1);
    assert!(model.bodies[0].shapes.is_empty());
}

#[test]
fn ties_say_what_they_tie() {
    let text = |equality: &str| {
        format!(
            r#"<mujoco><worldbody><body name="cart" mocap="true"><geom size="0.1"/></body>
            <body name="arm"><joint name="j"/><geom size="0.1"/><body name="rod"><joint/><geom size="0.1"/></body></body></worldbody>
            <equality>{equality}</equality><actuator><motor joint="j"/></actuator></mujoco>"#
        )
    };
    for (equality, said, closed) in [
        (r#"<connect name="loop" body1="rod" body2="arm" anchor="0 0 1"/>"#, "", 1),
        (
            r#"<distance name="rope" body1="rod" body2="arm"/>"#,
            "the distance `rope` of `rod` and `arm` closes a chain, in another way than is read here",
            0,
        ),
        (r#"<weld body1="rod"/>"#, "", 1),
        (r#"<weld body1="cart" body2="arm"/>"#, "follows a body that a program moves", 0),
        (r#"<weld body1="arm" body2="rod" active="false"/>"#, "is not active", 0),
    ] {
        let model = read(&text(equality));
        assert!(remarks(&model).contains(said), "{}", remarks(&model));
        assert_eq!(model.tally.number_of(features::CLOSED), closed, "{equality}");
        assert_eq!(model.closings.len(), closed, "{equality}");
        assert_eq!(model.tally.number_of(features::TIES), 1 - closed, "{equality}");
        // The world is not a body of the robot.
        assert_eq!(model.tally.number_of(features::BODIES), 2);
    }
}

/// A crank and a rod on a base that stands in the world, the rod turned by 90 degrees about x.
fn linkage(equality: &str) -> Model {
    read(&format!(
        r#"<mujoco><compiler angle="radian"/><worldbody><body name="base" pos="1 2 3"><geom size="0.1"/><site name="s" pos="0.5 0 0"/>
        <body name="crank" pos="0.1 0 0"><joint name="a" axis="0 0 1" ref="0.25"/><geom size="0.1"/>
        <body name="rod" pos="0.2 0 0" quat="1 1 0 0"><joint name="b" axis="0 0 1"/><geom size="0.1"/><site name="t" pos="0 0.3 0"/>
        </body></body></body></worldbody><equality>{equality}</equality></mujoco>"#
    ))
}

#[test]
fn what_closes_a_chain_has_its_frames_in_both_bodies() {
    let frames = |equality: &str| {
        let model = linkage(equality);
        let [closing] = model.closings.all() else { panic!("{}", remarks(&model)) };
        let ends = closing.ends.map(|end| (model.bodies[end.body].name.clone(), end.frame));
        (closing.kind, ends)
    };
    let near = |found: Vector3<f64>, expected: [f64; 3]| {
        assert!((found - Vector3::from(expected)).norm() < 1e-12, "{found}, not {expected:?}");
    };
    // A point of the rod, in the base where the model has it: (0.1 + 0.2, 0, 0) and (0, 0, 0.3) turned about x.
    let (kind, [(one, a), (other, b)]) =
        frames(r#"<connect body1="rod" body2="base" anchor="0 0.3 0"/>"#);
    assert_eq!((kind, &*one, &*other), (LoopKind::Spherical, "rod", "base"));
    near(a.translation.vector, [0.0, 0.3, 0.0]);
    near(b.translation.vector, [0.3, 0.0, 0.3]);
    // The world, in which the base stands.
    let (_, [_, (other, b)]) = frames(r#"<connect body1="rod" anchor="0 0.3 0"/>"#);
    assert_eq!(other, "world");
    near(b.translation.vector, [1.3, 2.0, 3.3]);
    // A weld where the model has it, held at a point of the second body.
    let (kind, [(_, a), (_, b)]) = frames(r#"<weld body1="base" body2="rod" anchor="0 0.1 0"/>"#);
    assert_eq!(kind, LoopKind::Fixed);
    near(a.translation.vector, [0.3, 0.0, 0.1]);
    near(b.translation.vector, [0.0, 0.1, 0.0]);
    assert!((a.rotation.angle() - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    assert_eq!(b.rotation.angle(), 0.0);
    // And where it says.
    let (_, [(_, a), _]) = frames(r#"<weld body1="base" body2="rod" relpose="0.4 0 0 1 0 0 0"/>"#);
    near(a.translation.vector, [0.4, 0.0, 0.0]);
    assert_eq!(a.rotation.angle(), 0.0);
    let (kind, ends) = frames(r#"<connect site1="s" site2="t"/>"#);
    assert_eq!((kind, &*ends[0].0, &*ends[1].0), (LoopKind::Spherical, "s", "t"));
}

#[test]
fn a_polynomial_of_joints_is_an_equation() {
    let model =
        linkage(r#"<joint name="cam" joint1="b" joint2="a" polycoef="0.1 0.2 0.3 0.4 0.5"/>"#);
    let [coupled] = model.couplings.all() else { panic!("{}", remarks(&model)) };
    let value = |a: f64, b: f64| {
        let at = |name: &str| if name == "a" { a } else { b };
        let terms = coupled.terms.iter().map(|(name, coefficients)| {
            let powers = coefficients.iter().enumerate();
            powers.map(|(k, c)| c * at(name).powi(k as i32 + 1)).sum::<f64>()
        });
        coupled.constant + terms.sum::<f64>()
    };
    for a in [-1.0, 0.0, 0.25, 0.7] {
        let x: f64 = a - 0.25;
        let b = 0.1 + 0.2 * x + 0.3 * x.powi(2) + 0.4 * x.powi(3) + 0.5 * x.powi(4);
        assert!(value(a, b).abs() < 1e-14, "{}", value(a, b));
        assert!((value(a, b + 1.0).abs() - 1.0).abs() < 1e-14);
    }
    assert_eq!(model.tally.number_of(features::POLYNOMIALS), 1);
}

#[test]
fn a_joint_that_is_held_is_an_equation_of_it_alone() {
    let model = linkage(r#"<joint name="hold" joint1="a" polycoef="0.5 7 0 0 0"/>"#);
    let [coupled] = model.couplings.all() else { panic!("{}", remarks(&model)) };
    // a - 0.25 = 0.5
    assert_eq!((coupled.name.as_deref(), coupled.constant), (Some("hold"), -0.75));
    assert_eq!(coupled.terms, [("a".to_owned(), vec![1.0])]);
    assert_eq!(model.tally.number_of(features::POLYNOMIALS), 1);
    let ball = read(
        r#"<mujoco><worldbody><body name="b"><joint name="j" type="ball"/><geom size="0.1"/></body></worldbody>
        <equality><joint joint1="j"/></equality></mujoco>"#,
    );
    assert_eq!((ball.couplings.len(), ball.tally.number_of(features::COUPLINGS)), (0, 1));
}

/// MuJoCo 4.0.0 lets a body turn at 1 rad/s that a weld with `torquescale="0"` holds, and stops it with 1.
#[test]
fn a_weld_that_holds_no_rotation_is_a_ball() {
    for (equality, kind) in [
        (
            r#"<weld body1="base" body2="rod" anchor="0 0.1 0" torquescale="0"/>"#,
            LoopKind::Spherical,
        ),
        (r#"<weld body1="base" body2="rod" anchor="0 0.1 0" torquescale="0.1"/>"#, LoopKind::Fixed),
        (r#"<weld site1="s" site2="t" torquescale="0"/>"#, LoopKind::Spherical),
        (r#"<weld site1="s" site2="t"/>"#, LoopKind::Fixed),
    ] {
        let model = linkage(equality);
        let [closing] = model.closings.all() else { panic!("{}", remarks(&model)) };
        assert_eq!(closing.kind, kind, "{equality}");
        if equality.contains("anchor") {
            // At its anchor: in the base where the model has it.
            let [a, b] = closing.ends.map(|end| end.frame.translation.vector);
            assert!((a - Vector3::new(0.3, 0.0, 0.1)).norm() < 1e-12, "{a}");
            assert!((b - Vector3::new(0.0, 0.1, 0.0)).norm() < 1e-12, "{b}");
        }
    }
}
