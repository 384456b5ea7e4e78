//! USD, read by a second implementation and placed by the words of UsdPhysics' documentation.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use nalgebra::{Isometry3, Matrix3, Quaternion, Translation3, UnitQuaternion, Vector3};
use testkit::robots::{made, our_robots};
use testkit::usda::{Prim, parsed};
use urdd_export::{ActuatorKind, Choices, Format};
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_kinematics::rotation::{from_rotation_vector, from_rpy, planar_basis, unit_axis};
use urdd_robot::{Robot, ShapeKind};

use crate::made::{export, exported, robot, urdf};

/// The prims of a file's robot: by name, the links and the joints.
pub struct Read {
    pub root: Prim,
}

impl Read {
    pub fn new(text: &str) -> Read {
        let file = parsed(text);
        let [meters, kilograms] =
            ["metersPerUnit", "kilogramsPerUnit"].map(|unit| file.metadata[unit].numbers());
        assert_eq!((meters, kilograms), (vec![1.0], vec![1.0]));
        assert_eq!(file.metadata["upAxis"].text(), "Z");
        Read { root: file.children[0].clone() }
    }

    pub fn links(&self) -> Vec<&Prim> {
        self.root.children.iter().filter(|prim| prim.applies("PhysicsRigidBodyAPI")).collect()
    }

    pub fn joints(&self) -> Vec<&Prim> {
        let all = self.root.all().into_iter();
        all.filter(|prim| prim.kind.starts_with("Physics") && prim.kind.ends_with("Joint"))
            .collect()
    }

    pub fn joint(&self, name: &str) -> &Prim {
        self.joints().into_iter().find(|joint| joint.shown() == name).expect("a joint")
    }
}

fn quaternion(numbers: &[f64]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(numbers[0], numbers[1], numbers[2], numbers[3]))
}

fn frame(joint: &Prim, place: usize) -> Isometry3<f64> {
    let position = joint.numbers(&format!("physics:localPos{place}"));
    let rotation = quaternion(&joint.numbers(&format!("physics:localRot{place}")));
    Isometry3::from_parts(Translation3::new(position[0], position[1], position[2]), rotation)
}

/// How a joint moves: about or along its axis, about its centre, or by the free axes of a generic joint.
fn motion(joint: &Prim, value: &[f64]) -> Isometry3<f64> {
    let turned =
        |v: [f64; 3]| Isometry3::from_parts(Translation3::identity(), from_rotation_vector(v));
    let along = |value: f64| {
        let mut axis = [0.0; 3];
        axis["XYZ".find(joint.get("physics:axis").text()).expect("an axis")] = value;
        axis
    };
    match joint.kind.as_str() {
        "PhysicsFixedJoint" => Isometry3::identity(),
        "PhysicsRevoluteJoint" => turned(along(value[0])),
        "PhysicsPrismaticJoint" => Translation3::from(along(value[0])).into(),
        "PhysicsSphericalJoint" => turned([value[0], value[1], value[2]]),
        "PhysicsJoint" => {
            let is_free = |axis: &&str| {
                let bound = |end: &str| joint.numbers(&format!("limit:{axis}:physics:{end}"))[0];
                bound("low") < bound("high")
            };
            let axes = ["transX", "transY", "transZ", "rotX", "rotY", "rotZ"];
            let free: Vec<&str> = axes.into_iter().filter(is_free).collect();
            match free.len() {
                6 => {
                    Isometry3::translation(value[0], value[1], value[2])
                        * turned([value[3], value[4], value[5]])
                }
                _ => {
                    assert_eq!(free, ["transX", "transY", "rotZ"]);
                    Isometry3::translation(value[0], value[1], 0.0) * turned([0.0, 0.0, value[2]])
                }
            }
        }
        other => panic!("a joint of type {other}"),
    }
}

/// The position of a joint: by DOF, or by the mimic, in degrees for those that turn.
fn position(read: &Read, joint: &Prim, dofs: &HashMap<&str, f64>) -> f64 {
    if !joint.applies("NewtonMimicAPI") {
        return dofs.get(joint.shown()).copied().unwrap_or(0.0);
    }
    let unit =
        if joint.kind == "PhysicsRevoluteJoint" { 180.0 / std::f64::consts::PI } else { 1.0 };
    let driver = joint.get("newton:mimicJoint").text();
    let driver = read.joints().into_iter().find(|of| of.path == driver).expect("a driver");
    let [offset, factor] =
        ["0", "1"].map(|end| joint.numbers(&format!("newton:mimicCoef{end}"))[0]);
    offset / unit + factor * position(read, driver, dofs)
}

fn poses(read: &Read, robot: &Robot, q: &[f64]) -> BTreeMap<String, Isometry3<f64>> {
    let dofs = robot.dof_names().expect("DOFs").iter().map(String::as_str);
    let dofs: HashMap<&str, f64> = dofs.zip(q.iter().copied()).collect();
    let mut left = read.joints();
    let mut found = BTreeMap::new();
    let world = left.iter().position(|joint| !joint.properties.contains_key("physics:body0"));
    let world = left.remove(world.expect("a joint to the world"));
    found.insert(world.get("physics:body1").text().to_owned(), Isometry3::identity());
    while !left.is_empty() {
        let is_next = |joint: &&Prim| found.contains_key(joint.get("physics:body0").text());
        let joint = left.remove(left.iter().position(is_next).expect("a tree"));
        let parts = ["trans_x", "trans_y", "trans_z", "rot_x", "rot_y", "rot_z", "rot"];
        let of = |part: &&str| dofs.get(format!("{}/{part}", joint.shown()).as_str()).copied();
        let mut value: Vec<f64> = parts.iter().filter_map(of).collect();
        if value.is_empty() {
            value = vec![position(read, joint, &dofs)];
        }
        let parent = found[joint.get("physics:body0").text()];
        let pose = parent * frame(joint, 0) * motion(joint, &value) * frame(joint, 1).inverse();
        found.insert(joint.get("physics:body1").text().to_owned(), pose);
    }
    let shown = |link: &&Prim| (link.shown().to_owned(), found[&link.path]);
    read.links().iter().map(shown).collect()
}

fn is_near(a: &Isometry3<f64>, b: &Isometry3<f64>) -> bool {
    // Numbers are binary32, over chains of ten joints.
    let rotation =
        a.rotation.to_rotation_matrix().matrix() - b.rotation.to_rotation_matrix().matrix();
    (a.translation.vector - b.translation.vector).amax() < 2e-6 && rotation.amax() < 2e-6
}

#[test]
fn joints_place_the_links_as_the_urdd_does() {
    let mut count = 0;
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).expect("a robot");
        let read = Read::new(&exported(&robot, Format::Usd).text);
        let space = robot.configurations().expect("bounds");
        let zero = space.zero();
        let links = robot.link_names().expect("links");
        for (k, q) in (0..20).map(|k| space.random(k)).chain([zero.clone()]).enumerate() {
            let found = poses(&read, &robot, &q);
            for (link, pose) in links.iter().zip(robot.link_poses(&q).expect("poses")) {
                assert!(
                    is_near(&found[link], &pose),
                    "{name}, {link}, {k}: {pose} {}",
                    found[link]
                );
                count += 1;
            }
        }
        // The bodies are where the default configuration has them.
        let placed = robot.link_poses(&zero).expect("poses");
        for link in read.links() {
            let at = link.numbers("xformOp:translate");
            let at = Translation3::new(at[0], at[1], at[2]);
            let own = Isometry3::from_parts(at, quaternion(&link.numbers("xformOp:orient")));
            let index = links.iter().position(|name| name == link.shown()).expect("a link");
            assert!((own.to_homogeneous() - placed[index].to_homogeneous()).amax() < 1e-12);
        }
    }
    assert!(count > 1500, "{count}");
}

/// A planar joint's frame is that of SPEC 5.8.
#[test]
fn a_planar_joint_moves_in_its_plane() {
    let (_folder, robot) = robot(&urdf(
        r#"<link name="a"/><link name="b"/><joint name="j" type="planar"><parent link="a"/><child link="b"/><axis xyz="1 2 -2"/></joint>"#,
    ));
    let read = Read::new(&exported(&robot, Format::Usd).text);
    let axis = unit_axis([1.0, 2.0, -2.0]).expect("an axis");
    let [x, y] = planar_basis(&axis);
    let turned = frame(read.joint("j"), 0).rotation;
    let expected = Matrix3::from_columns(&[x, y, axis.into_inner()]);
    assert!((turned.to_rotation_matrix().matrix() - expected).amax() < 1e-7);
}

#[test]
fn masses_are_those_of_the_urdf() {
    let mut count = 0;
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).expect("a robot");
        let read = Read::new(&exported(&robot, Format::Usd).text);
        for link in robot.description().expect("a robot").links {
            let prim = read.links().into_iter().find(|prim| prim.shown() == link.name);
            let prim = prim.expect("a link");
            let number = |name: &str| prim.numbers(&format!("physics:{name}"));
            let axes = quaternion(&number("principalAxes")).to_rotation_matrix();
            let moments = Matrix3::from_diagonal(&Vector3::from_vec(number("diagonalInertia")));
            let found = axes.matrix() * moments * axes.matrix().transpose();
            let Some(inertial) = link.inertial else {
                assert_eq!(number("mass"), [1e-6], "{name}");
                continue;
            };
            let mass = inertial.mass.map_or(0.0, |mass| mass.value);
            assert!((number("mass")[0] - mass).abs() <= 1e-7 * mass, "{name}");
            let of = inertial.inertia.as_ref().map(|of| {
                [of.ixx, of.ixy, of.ixz, of.iyy, of.iyz, of.izz].map(|value| value.unwrap_or(0.0))
            });
            let [xx, xy, xz, yy, yz, zz] = of.unwrap_or_default();
            let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
            let origin = inertial.origin.as_ref();
            let rpy = origin.and_then(|origin| origin.rpy).unwrap_or_default();
            let turn = from_rpy(rpy).to_rotation_matrix();
            let tensor = turn.matrix() * tensor * turn.matrix().transpose();
            assert!((found - tensor).amax() < 1e-6 * tensor.amax(), "{name}: {found} {tensor}");
            let centre = origin.and_then(|origin| origin.xyz).unwrap_or_default();
            let there = number("centerOfMass");
            assert!((0..3).all(|k| (there[k] - centre[k]).abs() < 1e-7), "{name}");
            count += 1;
        }
    }
    assert!(count > 30, "{count}");
}

type Pair = [(String, usize); 2];

/// The pairs of pieces that UsdPhysics leaves out: those of two bodies of a joint that does not say otherwise, and filtered
/// ones, of bodies or of shapes.
fn filtered(read: &Read) -> BTreeSet<Pair> {
    let mut shapes = Vec::new();
    for link in read.links() {
        let holder = link.children.iter().filter(|child| child.name() == "collisions");
        for shape in holder.flat_map(|holder| &holder.children) {
            assert!(shape.applies("PhysicsCollisionAPI"));
            let piece = shape.name().strip_prefix("piece_").expect("a piece");
            shapes.push((link, shape, piece.parse::<usize>().expect("a number")));
        }
    }
    let mut left_out: BTreeSet<[&str; 2]> = BTreeSet::new();
    for prim in read.root.all() {
        if prim.applies("PhysicsFilteredPairsAPI") {
            for target in prim.get("physics:filteredPairs").list() {
                left_out.insert([prim.path.as_str(), target.text()]);
            }
        }
    }
    for joint in read.joints() {
        let is_checked = joint.properties.contains_key("physics:collisionEnabled");
        if joint.properties.contains_key("physics:body0") && !is_checked {
            left_out.insert(
                ["body0", "body1"].map(|body| joint.get(&format!("physics:{body}")).text()),
            );
        }
    }
    let mut found = BTreeSet::new();
    for (a, one, i) in &shapes {
        for (b, other, j) in &shapes {
            let is_out = [[&a.path, &b.path], [&one.path, &other.path]].iter().any(|[x, y]| {
                left_out.contains(&[x.as_str(), y.as_str()])
                    || left_out.contains(&[y.as_str(), x.as_str()])
            });
            if a.path < b.path && is_out {
                let mut pair = [(a.shown().to_owned(), *i), (b.shown().to_owned(), *j)];
                pair.sort();
                found.insert(pair);
            }
        }
    }
    found
}

#[test]
fn the_pairs_are_those_of_the_urdd_by_piece() {
    let [mut count, mut named_in_all] = [0; 2];
    for (name, urdf) in our_robots() {
        let (_folder, path) = made(&urdf);
        let robot = Robot::open(path).expect("a robot");
        for kind in [ShapeKind::Pieces, ShapeKind::Hulls] {
            let options = Choices { shapes: kind.into(), keep_pairs: true, ..Choices::default() };
            let read = Read::new(&export(&robot, Format::Usd, &options).expect("an export").text);
            let skips = robot.skips(kind).expect("skips");
            let links = robot.link_names().expect("links");
            let joints = robot.description().expect("a robot").joints;
            let mut expected = BTreeSet::new();
            for (i, &(a, piece)) in skips.places().iter().enumerate() {
                for (j, &(b, other)) in skips.places().iter().enumerate() {
                    if a < b && skips.is_skipped(i, j) {
                        let mut pair = [(links[a].clone(), piece), (links[b].clone(), other)];
                        pair.sort();
                        expected.insert(pair);
                    }
                }
            }
            count += expected.len();
            assert_eq!(filtered(&read), expected, "{name} {kind}");
            // By default, links of which one pair of pieces is skipped for a contact are not checked.
            let touches = [SkipReason::Always, SkipReason::Adjacent, SkipReason::Default];
            let places = skips.places();
            let is_whole = |a: usize, b: usize| {
                (0..places.len()).any(|i| {
                    (0..places.len()).any(|j| {
                        let reason = skips.reason(i, j);
                        places[i].0 == a
                            && places[j].0 == b
                            && reason.is_some_and(|reason| touches.contains(&reason))
                    })
                })
            };
            for &(a, piece) in places {
                for &(b, other) in places.iter().filter(|(b, _)| a < *b && is_whole(a, *b)) {
                    let mut pair = [(links[a].clone(), piece), (links[b].clone(), other)];
                    pair.sort();
                    expected.insert(pair);
                }
            }
            let options = Choices { shapes: kind.into(), ..Choices::default() };
            let made = export(&robot, Format::Usd, &options).expect("an export");
            let read = Read::new(&made.text);
            assert_eq!(filtered(&read), expected, "{name} {kind}");
            // Each pair of links is named of which that loses pairs that the URDD checks.
            let is_checked = |a: usize, b: usize| {
                (0..places.len()).any(|i| {
                    (0..places.len())
                        .any(|j| places[i].0 == a && places[j].0 == b && !skips.is_skipped(i, j))
                })
            };
            let lost = (0..links.len()).flat_map(|a| (a + 1..links.len()).map(move |b| (a, b)));
            let lost = lost.filter(|&(a, b)| is_whole(a, b) && is_checked(a, b)).count();
            let notes = made.notes.iter().map(ToString::to_string);
            let named = notes.filter(|note| note.contains("disabled as a whole")).count();
            assert_eq!(named, lost, "{name} {kind}");
            named_in_all += named;
            assert!(joints.len() < read.joints().len() + 1);
        }
    }
    assert!(count > 100, "{count}");
    assert!(named_in_all > 0);
}

#[test]
fn drives_have_the_gains_of_actuators_of_mjcf_and_limits_are_in_degrees() {
    let robots = our_robots();
    let (_, urdf) = robots.iter().find(|(name, _)| name == "welding_arm").expect("an arm");
    let (_folder, path) = made(urdf);
    let robot = Robot::open(path).expect("a robot");
    let unit = 180.0 / std::f64::consts::PI;
    for kind in ActuatorKind::ALL {
        let options = Choices { actuators: Some(*kind), ..Choices::default() };
        let read = Read::new(&export(&robot, Format::Usd, &options).expect("an export").text);
        let peer = export(&robot, Format::Mjcf, &options).expect("an export").text;
        let peer = urdd_xml::parse(&peer, urdd_xml::Kind::Other).expect("XML");
        let actuators: Vec<_> = peer
            .descendants()
            .find(|node| node.has_tag_name("actuator"))
            .expect("actuators")
            .children()
            .filter(urdd_xml::Node::is_element)
            .collect();
        assert!(actuators.len() > 3);
        for actuator in actuators {
            let gain = |key: &str| {
                actuator.attribute(key).map_or(0.0, |text| text.parse::<f64>().expect("a number"))
            };
            let joint = read.joint(actuator.attribute("joint").expect("a joint"));
            let [instance, unit] = match joint.kind.as_str() {
                "PhysicsRevoluteJoint" => ["angular", "57.29577951308232"],
                _ => ["linear", "1"],
            };
            let unit: f64 = unit.parse().expect("a number");
            assert!(joint.applies(&format!("PhysicsDriveAPI:{instance}")));
            let drive = |name: &str| joint.numbers(&format!("drive:{instance}:physics:{name}"))[0];
            let is_near = |a: f64, b: f64| (a - b).abs() <= 1e-6 * b.abs();
            assert!(is_near(drive("stiffness"), gain("kp") / unit), "{}", joint.path);
            assert!(is_near(drive("damping"), gain("kv") / unit), "{}", joint.path);
        }
    }
    let read = Read::new(&exported(&robot, Format::Usd).text);
    for joint in robot.description().expect("a robot").joints {
        let Some(limit) = joint.limit else { continue };
        let prim = read.joint(&joint.name);
        let unit = if prim.kind == "PhysicsRevoluteJoint" { unit } else { 1.0 };
        if let (Some(lower), true) =
            (limit.lower, prim.properties.contains_key("physics:lowerLimit"))
        {
            assert!((prim.numbers("physics:lowerLimit")[0] - lower * unit).abs() < 1e-4);
            assert!(prim.properties.keys().all(|key| !key.starts_with("drive:")));
        }
    }
}
