//! What joints of a USD have besides frames: limits, drives, mimics, in the units of its schemas.

use testkit::usda::{Prim, Value};
use urdd_export::{ActuatorKind, Choices, Export, Format, Setup};
use urdd_format::link_shapes_skips::SkippedReason;

use crate::made::{export, exported, robot, urdf};
use crate::usd::Read;
use crate::usd_input::{LIMIT, joint, link};

/// Degrees of a radian.
const DEGREES: f64 = 180.0 / std::f64::consts::PI;

fn is_near(prim: &Prim, attribute: &str, expected: f64) {
    let found = prim.numbers(attribute)[0];
    let path = &prim.path;
    assert!(
        (found - expected).abs() <= 1e-6 * expected.abs(),
        "{path} {attribute}: {found} {expected}"
    );
}

fn notes(made: &Export) -> String {
    made.notes.iter().map(|note| format!("{note}\n")).collect()
}

#[test]
fn angles_are_in_degrees_and_lengths_in_metres() {
    let turn = r#"<axis xyz="0 0 1"/><limit lower="0.25" upper="1" effort="5" velocity="2"/><dynamics damping="0.5" friction="0.125"/>"#;
    let slide = r#"<axis xyz="0 1 0"/><limit lower="-0.5" upper="-0.25" effort="7" velocity="3"/><dynamics damping="0.75" friction="0.5"/>"#;
    let ball = r#"<limit effort="1" velocity="4"/><dynamics damping="0.25"/>"#;
    let parts = ["a", "b", "c", "d"].map(|name| link(name, "")).concat()
        + &joint("turn", "revolute", "a", "b", turn)
        + &joint("slide", "prismatic", "b", "c", slide)
        + &joint("ball", "spherical", "c", "d", ball);
    let (_folder, robot) = robot(&urdf(&parts));
    let setup = "robot = \"r\"\n[actuators.joint.turn]\narmature = 0.5\n[actuators.joint.slide]\narmature = 2.0";
    let setup = Setup::from_toml(setup, "x", &robot).expect("a setup");
    let made = |kind: ActuatorKind| {
        let setup = Some(setup.clone());
        let choices = Choices { actuators: Some(kind), setup, ..Choices::default() };
        Read::new(&export(&robot, Format::Usd, &choices).expect("an export").text)
    };
    for kind in ActuatorKind::ALL {
        let read = made(*kind);
        let cases = [
            ("turn", "angular", DEGREES, [0.25, 1.0, 5.0, 2.0, 0.5, 0.125, 0.5], 0.25),
            ("slide", "linear", 1.0, [-0.5, -0.25, 7.0, 3.0, 0.75, 0.5, 2.0], -0.25),
        ];
        for (name, instance, unit, values, start) in cases {
            let prim = read.joint(name);
            let [lower, upper, effort, velocity, damping, friction, armature] = values;
            is_near(prim, "physics:lowerLimit", lower * unit);
            is_near(prim, "physics:upperLimit", upper * unit);
            is_near(prim, &format!("drive:{instance}:physics:maxForce"), effort);
            is_near(prim, "newton:velocityLimit", velocity * unit);
            is_near(prim, "physxJoint:maxJointVelocity", velocity * unit);
            is_near(prim, "newton:damping", damping / unit);
            is_near(prim, "newton:friction", friction);
            is_near(prim, "newton:armature", armature);
            is_near(prim, "physxJoint:armature", armature);
            // The default configuration is the bound nearest to 0.
            is_near(prim, &format!("state:{instance}:physics:position"), start * unit);
            let target = format!("drive:{instance}:physics:targetPosition");
            match kind {
                ActuatorKind::Position => is_near(prim, &target, start * unit),
                _ => assert!(!prim.properties.contains_key(&target), "{kind:?}"),
            }
            let schemas = ["NewtonJointAPI", "PhysxJointAPI"]
                .map(str::to_owned)
                .into_iter()
                .chain(["Drive", "JointState"].map(|of| format!("Physics{of}API:{instance}")));
            schemas.for_each(|schema| assert!(prim.applies(&schema), "{schema}"));
        }
        let ball = read.joint("ball");
        is_near(ball, "newton:velocityLimit", 4.0 * DEGREES);
        is_near(ball, "newton:damping", 0.25 / DEGREES);
    }
    assert!(
        exported(&robot, Format::Usd).notes.iter().any(|note| note.to_string().contains("`state`"))
    );
}

#[test]
fn followers_follow_in_newton_and_in_physx() {
    let limits =
        |lower: f64| format!(r#"<limit lower="{lower}" upper="3" effort="1" velocity="1"/>"#);
    let mimic = |driver: &str, axis: &str| {
        format!(
            r#"<axis xyz="{axis}"/>{}<mimic joint="{driver}" multiplier="-2" offset="0.125"/>"#,
            limits(-3.0)
        )
    };
    let parts = ["a", "b", "c", "d", "e"].map(|name| link(name, "")).concat()
        + &joint(
            "driver",
            "revolute",
            "a",
            "b",
            &format!(r#"<axis xyz="0 0 1"/>{}"#, limits(0.25)),
        )
        + &joint("turns", "revolute", "b", "c", &mimic("driver", "0 1 0"))
        + &joint("slides", "prismatic", "c", "d", &mimic("driver", "0 1 0"))
        + &joint("again", "revolute", "d", "e", &mimic("turns", "0 1 0"));
    let (_folder, robot) = robot(&urdf(&parts));
    let made = exported(&robot, Format::Usd);
    let read = Read::new(&made.text);
    let driver = read.joint("driver").path.clone();
    for (name, kind, unit, [offset, factor]) in [
        ("turns", "rotY", DEGREES, [0.125, -2.0]),
        // PhysX knows `rotX`, `rotY` and `rotZ` alone, also where a joint slides (IsaacSim#731).
        ("slides", "rotY", 1.0, [0.125, -2.0]),
        // Of the driver of its driver: -2 (-2 q + 0.125) + 0.125.
        ("again", "rotY", DEGREES, [-0.125, 4.0]),
    ] {
        let prim = read.joint(name);
        assert_eq!(prim.get("newton:mimicJoint").text(), driver);
        is_near(prim, "newton:mimicCoef0", offset * unit);
        is_near(prim, "newton:mimicCoef1", factor);
        // PhysX holds own + gearing other + offset at 0.
        let physx = |what: &str| format!("physxMimicJoint:{kind}:{what}");
        is_near(prim, &physx("gearing"), -factor);
        is_near(prim, &physx("offset"), -offset * unit);
        assert_eq!(prim.get(&physx("referenceJoint")).text(), driver);
        assert_eq!(prim.get(&physx("referenceJointAxis")).text(), "rotZ");
        assert!(prim.applies(&format!("PhysxMimicJointAPI:{kind}")));
        // It is where the driver's 0.25 rad puts it.
        let instance = if unit == 1.0 { "linear" } else { "angular" };
        let start = (offset + factor * 0.25) * unit;
        is_near(prim, &format!("state:{instance}:physics:position"), start);
    }
    let said = notes(&made);
    assert!(said.contains("`slides`: it mimics a joint of another kind"), "{said}");
    assert!(!said.contains("`turns`: it mimics"), "{said}");
}

/// PhysX refuses the mimic of a joint without finite limits (IsaacSim#305).
#[test]
fn joints_without_limits_follow_in_newton_alone() {
    let limits = r#"<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>"#;
    let endless = r#"<axis xyz="0 0 1"/>"#;
    let follow = |driver: &str| format!(r#"<mimic joint="{driver}" multiplier="2"/>"#);
    let names = ["a", "b", "c", "d", "e", "f"];
    let parts = names.map(|name| link(name, "")).concat()
        + &joint("wheel", "continuous", "a", "b", endless)
        + &joint("hinge", "revolute", "a", "c", limits)
        + &joint(
            "wheel_of_wheel",
            "continuous",
            "a",
            "d",
            &format!("{endless}{}", follow("wheel")),
        )
        + &joint("hinge_of_wheel", "revolute", "a", "e", &format!("{limits}{}", follow("wheel")))
        + &joint(
            "wheel_of_hinge",
            "continuous",
            "a",
            "f",
            &format!("{endless}{}", follow("hinge")),
        );
    let (_folder, robot) = robot(&urdf(&parts));
    let made = exported(&robot, Format::Usd);
    let (read, said) = (Read::new(&made.text), notes(&made));
    for name in ["wheel_of_wheel", "hinge_of_wheel", "wheel_of_hinge"] {
        let prim = read.joint(name);
        assert!(prim.applies("NewtonMimicAPI"), "{name}");
        is_near(prim, "newton:mimicCoef1", 2.0);
        assert!(prim.properties.keys().all(|key| !key.starts_with("physxMimicJoint")), "{name}");
        assert!(!prim.applies("PhysxMimicJointAPI:rotZ"), "{name}");
        assert!(
            said.contains(&format!(
                "`{name}`: it mimics a joint, and one of the two has no limits"
            ))
        );
    }
    // No limits are invented.
    assert!(!read.joint("wheel_of_hinge").properties.contains_key("physics:lowerLimit"));
}

#[test]
fn a_base_that_is_free_stands_on_the_floor() {
    let parts = link("a", "") + &link("b", "");
    // A box of 0.1 m around each link: the lower one is 2 m below the root.
    let below = r#"<origin xyz="0 0 -2"/>"#;
    let parts = parts + &joint("world_fixed", "fixed", "a", "b", below);
    let (_folder, robot) = robot(&urdf(&parts));
    let fixed = Read::new(&exported(&robot, Format::Usd).text);
    let worlds = |read: &Read| -> Vec<String> {
        let joints = read.joints().into_iter();
        let to_world = joints.filter(|joint| !joint.properties.contains_key("physics:body0"));
        to_world.map(|joint| joint.name().to_owned()).collect()
    };
    // A joint of the robot has the name that this one would have.
    assert_eq!(worlds(&fixed), ["world_fixed_2"]);
    assert_eq!(fixed.links()[0].numbers("xformOp:translate"), [0.0; 3]);
    let choices = Choices { floating_base: true, ..Choices::default() };
    let free = Read::new(&export(&robot, Format::Usd, &choices).expect("an export").text);
    assert_eq!(worlds(&free), [""; 0]);
    let heights = free.links().into_iter().map(|link| link.numbers("xformOp:translate")[2]);
    for (found, expected) in heights.zip([2.05, 0.05]) {
        assert!((found - expected).abs() < 1e-9, "{found}");
    }
}

#[test]
fn a_root_that_is_the_world_is_not_free() {
    let (_folder, robot) = robot(&urdf(&link("world", "")));
    let choices = Choices { floating_base: true, ..Choices::default() };
    let made = export(&robot, Format::Usd, &choices).expect("an export");
    assert_eq!(Read::new(&made.text).joints().len(), 1);
    assert!(notes(&made).contains("which never moves"), "{}", notes(&made));
}

#[test]
fn axes_that_cannot_move_are_locked_and_said() {
    let parts = ["a", "b", "c"].map(|name| link(name, "")).concat()
        + &joint("plane", "planar", "a", "b", r#"<axis xyz="0 1 0"/>"#)
        + &joint(
            "held",
            "revolute",
            "b",
            "c",
            r#"<axis xyz="1 0 0"/><limit lower="1" upper="1" effort="1" velocity="1"/>"#,
        );
    let (_folder, robot) = robot(&urdf(&parts));
    let made = exported(&robot, Format::Usd);
    let read = Read::new(&made.text);
    let plane = read.joint("plane");
    for (axis, is_free) in [("transX", true), ("transZ", false), ("rotX", false), ("rotZ", true)] {
        assert!(plane.applies(&format!("PhysicsLimitAPI:{axis}")));
        let [low, high] =
            ["low", "high"].map(|end| plane.numbers(&format!("limit:{axis}:physics:{end}"))[0]);
        // UsdPhysics: an axis is locked where its low limit is above its high one.
        let expected =
            if is_free { low == f64::NEG_INFINITY && high == f64::INFINITY } else { low > high };
        assert!(expected, "{axis}: {low} {high}");
    }
    let said = notes(&made);
    assert!(said.contains("`held`: its limits are equal"), "{said}");
}

/// The two links of a joint are not checked in USD, unless the joint says so.
#[test]
fn links_of_a_joint_are_checked_where_a_person_wants_it() {
    let parts = link("a", "") + &link("b", "") + &joint("j", "revolute", "a", "b", LIMIT);
    let (_folder, robot) = robot(&urdf(&parts));
    let checked = |reasons| {
        let choices = Choices { reasons, ..Choices::default() };
        let read = Read::new(&export(&robot, Format::Usd, &choices).expect("an export").text);
        let joint = read.joint("j");
        joint.properties.get("physics:collisionEnabled").map(Value::numbers)
    };
    assert_eq!(checked(None), None);
    assert_eq!(checked(Some(vec![SkippedReason::Never])), Some(vec![1.0]));
}
