//! What Newton's and MuJoCo's schemas say of joints in a USD, against closed forms.

use std::f64::consts::FRAC_PI_4;

use nalgebra::{Matrix3, Vector3};

use super::usd::{body, inside, joint};
use crate::features;
use crate::model::{JointKind, Model};
use crate::tests::Entries as _;

/// Two bodies with two joints between them, on an articulation of which one attribute is given. `ends` are the bodies of each
/// joint.
fn stacked(attribute: &str, ends: [&str; 2]) -> Model {
    let joint = |name: &str, axis: &str, positions: [&str; 2]| {
        format!(
            "def PhysicsRevoluteJoint \"{name}\" {{ uniform token physics:axis = \"{axis}\"
            rel physics:body0 = </{}>\n rel physics:body1 = </{}>
            point3f physics:localPos0 = {}\n point3f physics:localPos1 = {} }}\n",
            ends[0], ends[1], positions[0], positions[1]
        )
    };
    let text = format!(
        "def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsArticulationRootAPI\"]) {{
            {attribute}
            def PhysicsFixedJoint \"w\" {{ rel physics:body1 = </a> }}
        }}
        def Xform \"b\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {{}}
        def Scope \"joints\" {{ {} {} }}",
        joint("x", "X", ["(0, 0, 1)", "(0, 0, 0.25)"]),
        joint("y", "Y", ["(0.5, 0, 1)", "(0.5, 0, 0.25)"]),
    );
    inside(&text)
}

#[test]
fn joints_of_two_bodies_are_one_behind_the_other_where_the_stage_says_so() {
    let said = "uniform bool newton:jointsAddMobility = 1";
    let model = stacked(said, ["a", "b"]);
    let moving = body(&model, "b");
    let found: Vec<_> =
        moving.joints.iter().map(|joint| (&*joint.name, joint.axis, joint.frame)).collect();
    let [x, y] = &found[..] else { panic!("{found:?}") };
    assert_eq!((x.0, x.1, y.0, y.1), ("x", Vector3::x(), "y", Vector3::y()));
    // Half a metre apart in the body.
    let frames = [x, y].map(|joint| moving.pose.translation.vector + joint.2.translation.vector);
    assert_eq!(frames, [Vector3::z(), Vector3::new(0.5, 0.0, 1.0)]);
    assert!(model.closings.is_empty());

    // From the other end, the last is the first.
    let turned = stacked(said, ["b", "a"]);
    let names: Vec<&str> = body(&turned, "b").joints.iter().map(|joint| &*joint.name).collect();
    assert_eq!(names, ["y", "x"]);
    assert_eq!(joint(&turned, "x").1.axis, -Vector3::x());

    // To the world, as MuJoCo has joints.
    let joint_to_world = |name: &str, axis: &str| {
        format!(
            "def PhysicsPrismaticJoint \"{name}\" (apiSchemas = [\"MjcJointAPI\"]) {{
            uniform token physics:axis = \"{axis}\"\n rel physics:body1 = </a> }}\n"
        )
    };
    let text = "def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {}\n".to_owned()
        + &joint_to_world("forward", "X")
        + &joint_to_world("side", "Y");
    let base = inside(&text);
    let names: Vec<&str> = body(&base, "a").joints.iter().map(|joint| &*joint.name).collect();
    assert_eq!((names, base.closings.len()), (vec!["forward", "side"], 0));

    // What an articulation leaves open closes a chain in any case.
    let text = "def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {
            uniform bool newton:jointsAddMobility = 1 }
        def PhysicsPrismaticJoint \"forward\" { rel physics:body1 = </a> }
        def PhysicsPrismaticJoint \"open\" { rel physics:body1 = </a>
            uniform bool physics:excludeFromArticulation = 1 }";
    let base = inside(text);
    assert_eq!(body(&base, "a").joints.len(), 1);
    let said: Vec<&str> = base.tally.remarks.iter().map(|of| &*of.text).collect();
    assert!(said.contains(&"the joint `open` is left out: it closes a chain"), "{said:?}");

    // By UsdPhysics itself, each of the two takes the motion of the other.
    let model = stacked("", ["a", "b"]);
    assert_eq!((body(&model, "b").joints.len(), model.closings.len()), (1, 1));
}

#[test]
fn names_that_no_urdf_can_hold_are_not_taken() {
    let text = "def Xform \"a\" (displayName = \"ev\\x1b[31mil\"
        apiSchemas = [\"PhysicsRigidBodyAPI\"]) {
            def Cube \"c\" (displayName = \"two\\nlines\"; apiSchemas = [\"PhysicsCollisionAPI\"]) {} }";
    let model = inside(text);
    let (link, shape) = (&model.bodies[0], &model.bodies[0].shapes[0]);
    assert_eq!((&*link.name, shape.name.as_deref()), ("a", Some("c")));
}

#[test]
fn actuators_masses_and_sites_of_these_schemas() {
    let text = "
        def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsArticulationRootAPI\"]) {}
        def Xform \"b\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {}
        def Xform \"c\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {}
        def PhysicsFixedJoint \"w\" { rel physics:body1 = </a> }
        def PhysicsRevoluteJoint \"j\" ( apiSchemas = [\"MjcJointAPI\"] ) {
            rel physics:body0 = </a>\n rel physics:body1 = </b>
            uniform double mjc:armature = 0.02\n uniform double mjc:damping = 0.1
            uniform double mjc:frictionloss = 0.3\n uniform double mjc:stiffness = 4
            float newton:effortLimit = 7
        }
        def PhysicsPrismaticJoint \"k\" { rel physics:body0 = </b>\n rel physics:body1 = </c> }
        def MjcActuator \"servo\" {
            rel mjc:target = </j>
            uniform double[] mjc:gainPrm = [100, 0, 0]
            uniform double[] mjc:biasPrm = [0, -100, -10]
            uniform token mjc:biasType = \"affine\"
            uniform double[] mjc:gear = [2, 0, 0, 0, 0, 0]
            uniform double mjc:ctrlRange:min = -1\n uniform double mjc:ctrlRange:max = 1
            uniform double mjc:forceRange:min = -5\n uniform double mjc:forceRange:max = 5
        }
        def PhysicsRevoluteJoint \"h\" { rel physics:body0 = </a>\n rel physics:body1 = </d>
            float physics:lowerLimit = -90\n float physics:upperLimit = 90 }
        def Xform \"d\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {}
        def MjcActuator \"of_range\" {
            rel mjc:target = </h>\n uniform double mjc:inheritRange = 0.5
            uniform double[] mjc:gainPrm = [8]\n uniform double[] mjc:biasPrm = [0, -8]
            uniform token mjc:biasType = \"affine\"
        }
        def MjcActuator \"motor\" {
            rel mjc:target = </k>
            uniform double[] mjc:gear = [2, 0, 0, 0, 0, 0]
            uniform double mjc:ctrlRange:min = -3\n uniform double mjc:ctrlRange:max = 2
        }
        def MjcActuator \"of_a_tendon\" { rel mjc:target = </t> }
        def MjcTendon \"t\" {}";
    let model = inside(text);
    let (_, servo) = joint(&model, "j");
    // Gains at the joint: of the gear, squared.
    assert_eq!((servo.kp, servo.kv, servo.armature), (Some(400.0), Some(40.0), Some(0.02)));
    assert_eq!((servo.damping, servo.friction), (0.1, 0.3));
    // 10 N m by the gear, and 7 by the joint.
    assert_eq!(servo.effort, Some(7.0));
    assert_eq!(servo.actuator.control, Some([-0.5, 0.5]));
    assert_eq!(servo.actuator.name.as_deref(), Some("servo"));
    let told = joint(&model, "h").1.actuator.control.expect("a range");
    assert!(
        told.iter().zip([-FRAC_PI_4, FRAC_PI_4]).all(|(one, other)| (one - other).abs() < 1e-9)
    );
    let (_, motor) = joint(&model, "k");
    assert_eq!((motor.kind, motor.kp, motor.effort), (JointKind::Slide, None, Some(6.0)));
    assert_eq!(motor.actuator.force, Some([-6.0, 4.0]));
    // Newton's: the same gains, and what both schemas say of damping counts once.
    let text = "
        def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsArticulationRootAPI\"]) {
            def Sphere \"tip\" (apiSchemas = [\"NewtonSiteAPI\"]) { double3 xformOp:translate = (0, 0, 2)
                uniform token[] xformOpOrder = [\"xformOp:translate\"] } }
        def Xform \"b\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"NewtonMassAPI\"]) {
            float physics:mass = 2\n point3f physics:centerOfMass = (0, 0, 0.5)
            float3 physics:diagonalInertia = (9, 9, 9)
            double[] newton:inertia = [1, 2, 3, 0.1, 0.2, 0.3] }
        def PhysicsFixedJoint \"w\" { rel physics:body1 = </a> }
        def PhysicsRevoluteJoint \"j\" { rel physics:body0 = </a>\n rel physics:body1 = </b>
            uniform double mjc:damping = 0.5\n float newton:damping = 0.0087266462599716 }
        def NewtonActuator \"pd\" ( apiSchemas = [\"NewtonPDControlAPI\", \"NewtonMaxEffortClampingAPI\"] ) {
            rel newton:targets = </j>\n float newton:kp = 30\n float newton:kd = 3\n float newton:maxEffort = 12 }
        def NewtonActuator \"pid\" ( apiSchemas = [\"NewtonPIDControlAPI\"] ) { rel newton:targets = </j> }";
    let of_newton = inside(text);
    let (_, pd) = joint(&of_newton, "j");
    assert_eq!((pd.kp, pd.kv, pd.effort), (Some(30.0), Some(3.0), Some(12.0)));
    assert!((pd.damping - 0.5).abs() < 1e-7);
    assert_eq!(of_newton.tally.number_of(features::OTHER_ACTUATORS), 1);
    let inertia = body(&of_newton, "b").inertial.as_ref().expect("an inertial").inertia;
    assert_eq!(inertia, Matrix3::new(1.0, 0.1, 0.2, 0.1, 2.0, 0.3, 0.2, 0.3, 3.0));
    let tip = body(&of_newton, "tip");
    assert!(tip.is_frame && body(&of_newton, "a").shapes.is_empty());
    assert_eq!(tip.pose.translation.vector, Vector3::new(0.0, 0.0, 2.0));
    let counted = |what| model.tally.number_of(what);
    assert_eq!(counted(features::OTHER_ACTUATORS), 1);
    assert_eq!((counted(features::TENDONS), counted(features::SPRINGS)), (1, 1));
}
