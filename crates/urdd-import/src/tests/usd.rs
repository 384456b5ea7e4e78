//! Models read of USD, against closed forms.

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;
use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Translation3, Vector3};
use urdd_format::loops::LoopKind;
use urdd_source::gate::Gate;
use urdd_source::{Files, ImportOptions, Settings};

use crate::model::{Body, Geometry, Joint, JointKind, Mimic, Model, Use};
use crate::place::TextFile;
use crate::tests::Entries as _;
use crate::usd;

pub(super) fn given(
    text: &str,
    files: &[(&str, &[u8])],
    options: &ImportOptions,
) -> Result<Model, String> {
    let file = |(path, bytes): &(&str, &[u8])| ((*path).to_owned(), Arc::from(*bytes));
    let files = Files::in_memory(files.iter().map(file)).expect("files");
    let gate = Gate::of_project(Path::new("/"), &Settings { files, ..Settings::default() });
    gate.account().deposit(text.len());
    let path = Path::new("/robot.usda").to_owned();
    let file = TextFile::any("robot.usda".to_owned(), path, Arc::from(text.as_bytes()));
    usd::read(file, &gate, options)
        .map_err(|fault| format!("{}:{}:{}: {}", fault.file, fault.line, fault.column, fault.fault))
}

/// What is in a stage in metres, whose z is up.
pub(super) fn inside(text: &str) -> Model {
    let head = "#usda 1.0\n( metersPerUnit = 1\n upAxis = \"Z\" )\n";
    given(&format!("{head}{text}"), &[], &ImportOptions::default()).expect("a model")
}

pub(super) fn body<'m>(model: &'m Model, name: &str) -> &'m Body {
    model.bodies.iter().find(|body| body.name == name).unwrap_or_else(|| panic!("no body {name}"))
}

pub fn joint<'m>(model: &'m Model, name: &str) -> (&'m Body, &'m Joint) {
    let all = model.bodies.iter().flat_map(|body| body.joints.iter().map(move |of| (body, of)));
    let mut found = all.filter(|(_, joint)| joint.name == name);
    found.next().unwrap_or_else(|| panic!("no joint {name}"))
}

fn near(one: &Isometry3<f64>, other: &Isometry3<f64>) -> bool {
    (one.to_homogeneous() - other.to_homogeneous()).amax() < 1e-6
}

/// Two bodies, and a joint of some type with its attributes.
fn two(kind: &str, attributes: &str) -> String {
    format!(
        "def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {{}}
        def Xform \"b\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {{
            double3 xformOp:translate = (9, 9, 9)
            uniform token[] xformOpOrder = [\"xformOp:translate\"]
            def Sphere \"ball\" {{ double3 xformOp:translate = (0, 0, 1)
                uniform token[] xformOpOrder = [\"xformOp:translate\"] }}
        }}
        def {kind} \"j\" {{ rel physics:body0 = </a>\n rel physics:body1 = </b>\n {attributes} }}"
    )
}

#[test]
fn a_hinge_turns_about_its_frames() {
    // About x of frames that are turned by 90° about z in both bodies: about y of the child.
    let turn = "(0.70710677, 0, 0, 0.70710677)";
    let model = inside(&two(
        "PhysicsRevoluteJoint",
        &format!(
            "uniform token physics:axis = \"X\"
            point3f physics:localPos0 = (1, 2, 3)
            point3f physics:localPos1 = (0.5, 0, 0.25)
            quatf physics:localRot0 = {turn}
            quatf physics:localRot1 = {turn}
            float physics:lowerLimit = -90
            float physics:upperLimit = 45"
        ),
    ));
    let (moved, hinge) = joint(&model, "j");
    // The frame of the link is where it turns, and what is in the body moves with it.
    assert!(near(&moved.pose, &Translation3::new(1.0, 2.0, 3.0).into()), "{}", moved.pose);
    assert_eq!((hinge.kind, hinge.frame), (JointKind::Hinge, Isometry3::identity()));
    assert!((hinge.axis - Vector3::y()).amax() < 1e-7, "{}", hinge.axis);
    assert_eq!(hinge.range, Some([-FRAC_PI_2, PI / 4.0]));
    let ball = &moved.shapes[0];
    assert!(near(&ball.pose, &Translation3::new(-0.5, 0.0, 0.75).into()), "{}", ball.pose);
    assert!(model.is_floating);
    // A joint alone to body 0 turns round.
    let turned = inside(
        &two("PhysicsRevoluteJoint", "uniform token physics:axis = \"Z\"")
            .replace("</a>", "</c>")
            .replace("</b>", "</a>")
            .replace("</c>", "</b>"),
    );
    assert_eq!(turned.bodies[0].name, "b");
}

#[test]
fn slides_have_the_units_of_the_stage() {
    let text = two(
        "PhysicsPrismaticJoint",
        "uniform token physics:axis = \"Y\"\n point3f physics:localPos0 = (100, 0, 0)
        point3f physics:localPos1 = (0, 50, 0)
        float physics:lowerLimit = -20\n float physics:upperLimit = 30",
    );
    // A stage that says nothing is in centimetres, and its y is up: (x, y, z) becomes (x, -z, y).
    let model =
        given(&format!("#usda 1.0\n{text}"), &[], &ImportOptions::default()).expect("a model");
    let (moved, slide) = joint(&model, "j");
    assert_eq!((slide.kind, slide.range), (JointKind::Slide, Some([-0.2, 0.3])));
    assert_eq!(slide.axis, Vector3::z());
    assert!(near(&moved.pose, &Translation3::new(1.0, 0.0, -0.5).into()), "{}", moved.pose);
    assert!(near(
        &moved.shapes[0].pose,
        &(Translation3::new(0.0, -0.01, 0.0) * moved.shapes[0].pose.rotation)
    ));
    assert_eq!(moved.shapes[0].geometry, Geometry::Sphere(0.01));
}

#[test]
fn a_generic_joint_is_what_it_leaves_free() {
    let locked = |names: &[&str]| {
        let each = names.iter().map(|name| {
            format!("float limit:{name}:physics:low = 1\n float limit:{name}:physics:high = -1\n")
        });
        each.collect::<String>()
    };
    let generic = |free: &[&str]| {
        let all = ["transX", "transY", "transZ", "rotX", "rotY", "rotZ"];
        let names: Vec<&str> = all.into_iter().filter(|name| !free.contains(name)).collect();
        let schemas: Vec<String> =
            names.iter().map(|name| format!("\"PhysicsLimitAPI:{name}\"")).collect();
        let text = two("PhysicsJoint", &locked(&names));
        let head = format!("def PhysicsJoint \"j\" ( apiSchemas = [{}] )", schemas.join(", "));
        inside(&text.replace("def PhysicsJoint \"j\"", &head))
    };
    assert_eq!(body(&generic(&[]), "b").fixed_by.as_deref(), Some("j"));
    let one = generic(&["rotY"]);
    assert_eq!(
        (joint(&one, "j").1.kind, joint(&one, "j").1.axis),
        (JointKind::Hinge, Vector3::y())
    );
    assert_eq!(joint(&generic(&["rotX", "rotY", "rotZ"]), "j").1.kind, JointKind::Ball);
    let several = generic(&["transX", "rotZ"]);
    let names: Vec<&str> = body(&several, "b").joints.iter().map(|joint| &*joint.name).collect();
    assert_eq!(names, ["j/transX", "j/rotZ"]);
    let free = generic(&["transX", "transY", "transZ", "rotX", "rotY", "rotZ"]);
    assert_eq!(joint(&free, "j").1.kind, JointKind::Floating);
    let planar = generic(&["transX", "transZ", "rotY"]);
    let own = joint(&planar, "j").1;
    assert_eq!((own.kind, own.axis), (JointKind::Planar, Vector3::y()));
    // The rotation is not about the normal.
    assert_eq!(body(&generic(&["transX", "transZ", "rotX"]), "b").joints.len(), 3);
}

#[test]
fn configurations_have_a_value_for_each_dof() {
    let values = "double \"j/rot_x\" = 1; double \"j/rot_y\" = 2; double \"j/rot_z\" = 3";
    let text = format!(
        "{}\ndef \"data\" ( customData = {{ dictionary urdd = {{ dictionary configurations = {{ dictionary \"home\" = {{ {values} }} }} }} }} ) {{}}",
        two("PhysicsSphericalJoint", "")
    );
    let model = inside(&text);
    let [home] = model.configurations.all() else { panic!("one configuration") };
    assert_eq!((&*home.name, &*home.values[0].values), ("home", &[1.0, 2.0, 3.0][..]));
}

#[test]
fn masses_follow_from_shapes() {
    let model = inside(
        "def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {
            def Cube \"box\" (apiSchemas = [\"PhysicsCollisionAPI\"]) {
                double size = 1
                float3 xformOp:scale = (0.1, 0.2, 0.3)
                double3 xformOp:translate = (1, 0, 0)
                uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:scale\"]
                uniform token purpose = \"guide\"
            }
        }",
    );
    let own = body(&model, "a").inertial.as_ref().expect("a mass");
    assert!((own.mass - 6.0).abs() < 1e-12, "{}", own.mass);
    assert!((own.centre - Point3::new(1.0, 0.0, 0.0)).amax() < 1e-12);
    assert!((own.inertia[(0, 0)] - 6.0 / 12.0 * (0.04 + 0.09)).abs() < 1e-12);
    let shape = &body(&model, "a").shapes[0];
    assert_eq!(
        (shape.used, shape.geometry.clone()),
        (Use::Collision, Geometry::Box([0.1, 0.2, 0.3]))
    );
}

#[test]
fn masses_that_are_said() {
    let model = inside(
        "def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsMassAPI\"]) {
            float physics:mass = 2.5
            point3f physics:centerOfMass = (0.1, 0, 0)
            float3 physics:diagonalInertia = (1, 2, 3)
            quatf physics:principalAxes = (0.70710677, 0, 0, 0.70710677)
        }",
    );
    let own = body(&model, "a").inertial.as_ref().expect("a mass");
    assert_eq!((own.mass, own.centre.x), (2.5, 0.1));
    let moments = [0, 1, 2].map(|axis| own.inertia[(axis, axis)]);
    // Turned by 90° about z.
    assert!((Vector3::from(moments) - Vector3::new(2.0, 1.0, 3.0)).amax() < 1e-6, "{moments:?}");
}

#[test]
fn drives_and_mimics() {
    let text = "
        def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsArticulationRootAPI\"]) {}
        def Xform \"b\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {}
        def Xform \"c\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {}
        def PhysicsFixedJoint \"w\" { rel physics:body1 = </a> }
        def PhysicsRevoluteJoint \"j\" ( apiSchemas = [\"PhysicsDriveAPI:angular\"] ) {
            rel physics:body0 = </a>\n rel physics:body1 = </b>
            float drive:angular:physics:stiffness = 2
            float drive:angular:physics:damping = 0.5
            float drive:angular:physics:maxForce = 30
            float newton:velocityLimit = 90
            double mjc:ref = 45
        }
        def PhysicsRevoluteJoint \"k\" ( apiSchemas = [\"PhysxMimicJointAPI:rotX\"]
            displayName = \"k-2\" ) {
            rel physics:body0 = </b>\n rel physics:body1 = </c>
            rel physxMimicJoint:rotX:referenceJoint = </j>
            float physxMimicJoint:rotX:gearing = 2
            float physxMimicJoint:rotX:offset = -90
        }";
    let model = inside(text);
    assert!(!model.is_floating);
    let (_, driven) = joint(&model, "j");
    let degree = PI / 180.0;
    assert!((driven.kp.unwrap() - 2.0 / degree).abs() < 1e-9);
    assert!((driven.kv.unwrap() - 0.5 / degree).abs() < 1e-9);
    assert_eq!((driven.effort, driven.velocity, driven.range), (Some(30.0), Some(FRAC_PI_2), None));
    assert!((driven.reference - FRAC_PI_2 / 2.0).abs() < 1e-9);
    let mimic = joint(&model, "k-2").1.mimic.clone();
    assert_eq!(mimic, Some(Mimic { joint: "j".to_owned(), multiplier: -2.0, offset: FRAC_PI_2 }));
}

#[test]
fn a_circle_of_followers_is_broken() {
    let follower = |name: &str, child: &str, leader: &str| {
        format!(
            "def PhysicsRevoluteJoint \"{name}\" (apiSchemas = [\"NewtonMimicAPI\"]) {{
            rel physics:body0 = </a>\n rel physics:body1 = </{child}>\n rel newton:mimicJoint = </{leader}> }}\n"
        )
    };
    let bodies = ["a", "b", "c", "d"].map(|name| {
        format!("def Xform \"{name}\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {{}}\n")
    });
    let joints = [("i", "b", "j"), ("j", "c", "k"), ("k", "d", "i")]
        .map(|(name, child, leader)| follower(name, child, leader));
    let model = inside(&(bodies.concat() + &joints.concat()));
    let leaders =
        ["i", "j", "k"].map(|name| joint(&model, name).1.mimic.clone().map(|of| of.joint));
    assert_eq!(leaders, [Some("j".to_owned()), Some("k".to_owned()), None]);
}

#[test]
fn joints_that_add_mobility_follow_each_other() {
    let joint_of = |name: &str, kind: &str, parent: &str, at: &str| {
        format!(
            "def {kind} \"{name}\" {{ {parent} rel physics:body1 = </r/b>
            point3f physics:localPos0 = {at}\n point3f physics:localPos1 = {at} }}\n"
        )
    };
    let text = |parent: &str, flag: &str| {
        let joints = joint_of("s", "PhysicsPrismaticJoint", parent, "(0, 0, 0)")
            + &joint_of("h", "PhysicsRevoluteJoint", parent, "(0, 1, 0)");
        format!(
            "def Xform \"r\" {{ {flag}
            def Xform \"b\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {{}}
            def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {{}} }}\n{joints}"
        )
    };
    let adds = "uniform bool newton:jointsAddMobility = 1";
    // Of the world, and of another body.
    for parent in ["", "rel physics:body0 = </r/a>\n"] {
        let model = inside(&text(parent, adds));
        let own = body(&model, "b");
        let names: Vec<&str> = own.joints.iter().map(|joint| &*joint.name).collect();
        assert_eq!((names, model.closings.len()), (vec!["s", "h"], 0));
        // The body stays where it is, and turns about a point of it.
        assert_eq!(own.pose, Isometry3::identity());
        assert_eq!(own.joints[1].frame.translation.vector, Vector3::y());
        assert!(!model.is_floating || !parent.is_empty());
    }
    let closed = inside(&text("rel physics:body0 = </r/a>\n", ""));
    assert_eq!((body(&closed, "b").joints.len(), closed.closings.len()), (1, 1));
}

#[test]
fn joints_that_articulations_exclude_close_chains() {
    let bodies: String = ["a", "b", "c"]
        .map(|name| format!("def Xform \"{name}\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {{}}\n"))
        .concat();
    let joint_of = |name: &str, one: &str, other: &str, more: &str| {
        format!(
            "def PhysicsRevoluteJoint \"{name}\" {{ rel physics:body0 = </{one}>\n rel physics:body1 = </{other}>\n {more} }}\n"
        )
    };
    // The first of the file is left out of the tree.
    let excluded = "bool physics:excludeFromArticulation = 1\n uniform token physics:axis = \"X\"\n point3f physics:localPos0 = (1, 0, 0)";
    let text = bodies.clone()
        + &joint_of("x", "a", "c", excluded)
        + &joint_of("i", "a", "b", "")
        + &joint_of("j", "b", "c", "point3f physics:localPos1 = (0, 0, 1)");
    let model = inside(&text);
    assert_eq!(body(&model, "c").joints[0].name, "j");
    let [closing] = model.closings.all() else { panic!("{:?}", model.closings) };
    assert_eq!((closing.name.as_deref(), closing.kind), (Some("x"), LoopKind::Revolute));
    let [one, other] = &closing.ends;
    // z of the frames is the axis of the joint.
    assert!((one.frame.rotation * Vector3::z() - Vector3::x()).amax() < 1e-9);
    assert!((one.frame.translation.vector - Vector3::x()).amax() < 1e-9);
    // The link is where its joint is.
    assert!((other.frame.translation.vector - Vector3::new(0.0, 0.0, -1.0)).amax() < 1e-9);
    // It does not make one robot of two that the world holds.
    let held = |name: &str| {
        format!("def PhysicsFixedJoint \"w{name}\" {{ rel physics:body1 = </{name}> }}\n")
    };
    let two = bodies
        + &held("a")
        + &held("c")
        + &joint_of("i", "a", "b", "")
        + &joint_of("x", "a", "c", excluded);
    let names: Vec<String> = inside(&two).bodies.iter().map(|body| body.name.clone()).collect();
    assert_eq!(names, ["a", "b"]);
}

#[test]
fn the_robot_is_the_articulation() {
    let text = "
        def Xform \"crate\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {}
        def Xform \"robot\" (apiSchemas = [\"PhysicsArticulationRootAPI\"]) {
            def Xform \"base\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsFilteredPairsAPI\"]) {
                rel physics:filteredPairs = </robot/tip>
                def Xform \"camera\" { double3 xformOp:translate = (0, 0, 2)
                    uniform token[] xformOpOrder = [\"xformOp:translate\"]
                    def Xform \"lens\" { double3 xformOp:translate = (1, 0, 0)
                        uniform token[] xformOpOrder = [\"xformOp:translate\"] } }
            }
            def Xform \"tip\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {}
            def PhysicsSphericalJoint \"ball\" { rel physics:body0 = </robot/base>
                rel physics:body1 = </robot/tip>
                bool physics:collisionEnabled = 1 }
        }";
    let model = inside(text);
    let names: Vec<&str> = model.bodies.iter().map(|body| &*body.name).collect();
    assert_eq!(names, ["base", "tip", "camera", "lens"]);
    assert!(body(&model, "camera").is_frame);
    assert_eq!(body(&model, "lens").pose.translation.vector, Vector3::new(1.0, 0.0, 2.0));
    assert_eq!((model.apart[0].bodies, model.checked[0].bodies), ([0, 1], [0, 1]));
    let chosen = ImportOptions { body: Some("crate".to_owned()), ..ImportOptions::default() };
    let head = "#usda 1.0\n( metersPerUnit = 1\n upAxis = \"Z\" )\n";
    let other = given(&format!("{head}{text}"), &[], &chosen).expect("a model");
    assert_eq!(other.bodies[0].name, "crate");
    let missing = ImportOptions { body: Some("gone".to_owned()), ..ImportOptions::default() };
    let error = given(&format!("{head}{text}"), &[], &missing).unwrap_err();
    assert!(error.contains("there is no body `gone`"), "{error}");
}

#[test]
fn refused() {
    let options = ImportOptions::default();
    let error = |text: &str| {
        given(&format!("#usda 1.0\n{text}"), &[("/x.usda", b"no")], &options).unwrap_err()
    };
    for (text, found) in [
        ("def \"a\" {}", "robot.usda:1:1: no prim has `PhysicsRigidBodyAPI`"),
        ("def \"a\" {", "robot.usda:2:10: the file ends inside of a prim"),
        (
            "def \"a\" (references = @gone.usda@) {}",
            "robot.usda:2:1: cannot read `gone.usda`: `gone.usda` was not found",
        ),
        ("( subLayers = [@gone.usda@] )", "robot.usda:0:0: cannot read `gone.usda`"),
        (
            "def \"a\" (references = @../../gone.usda@) {}",
            "robot.usda:2:1: cannot read `../../gone.usda`",
        ),
        ("def \"a\" (references = @x.usda@) {}", "x.usda:0:0: not a USD layer"),
        ("def \"a\" (references = @https://a/b.usd@) {}", "layers from the network are not read"),
        ("( metersPerUnit = 0 )\ndef \"a\" {}", "have to be above 0"),
        (
            "def Xform \"a\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) { float3 xformOp:scale = (0, 1, 1)\n uniform token[] xformOpOrder = [\"xformOp:scale\"] }",
            "robot.usda:2:1: `/a` is scaled by 0",
        ),
    ] {
        let error = error(text);
        assert!(error.contains(found), "{text}: {error}");
    }
}
