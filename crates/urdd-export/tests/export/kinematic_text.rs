//! A URDF by its text alone, in a few lines: where links are, and what they weigh. Not by the crates under test.

use std::collections::BTreeMap;

use nalgebra::{Isometry3, Matrix3, Point3, Translation3, Unit, UnitQuaternion, Vector3};
use urdd_xml::{Document, Kind, Node, parse};

pub fn numbers(node: Option<Node>, key: &str) -> Option<Vec<f64>> {
    let text = node?.attribute(key)?;
    Some(text.split_whitespace().map(|part| part.parse().expect("a number")).collect())
}

fn three(node: Option<Node>, key: &str, or: [f64; 3]) -> Vector3<f64> {
    numbers(node, key).map_or(or.into(), |of| Vector3::new(of[0], of[1], of[2]))
}

/// Fixed-axis roll, pitch, yaw.
pub fn origin(of: Option<Node>) -> Isometry3<f64> {
    let rpy = three(of, "rpy", [0.0; 3]);
    let xyz = three(of, "xyz", [0.0; 3]);
    let rotation = UnitQuaternion::from_euler_angles(rpy.x, rpy.y, rpy.z);
    Isometry3::from_parts(Translation3::from(xyz), rotation)
}

pub struct Text<'t>(Document<'t>);

impl<'t> Text<'t> {
    pub fn new(text: &'t str) -> Self {
        Text(parse(text, Kind::Other).expect("XML"))
    }

    pub fn all(&self, tag: &'static str) -> impl Iterator<Item = Node<'_, 't>> {
        self.0.root_element().children().filter(move |node| node.has_tag_name(tag))
    }

    pub fn named(&self, tag: &'static str, name: &str) -> Node<'_, 't> {
        self.all(tag).find(|node| node.attribute("name") == Some(name)).expect(name)
    }

    /// The link that a joint names.
    pub fn of_joint(&self, joint: &str, end: &str) -> String {
        let node = self.named("joint", joint);
        let end = node.children().find(|child| child.has_tag_name(end)).expect("an end");
        end.attribute("link").expect("a link").to_owned()
    }

    /// The pose of each link in the root link, for the values of joints by name.
    pub fn poses(&self, value: &dyn Fn(&str) -> f64) -> BTreeMap<String, Isometry3<f64>> {
        let joints: Vec<Node> = self.all("joint").collect();
        let end = |joint: &Node, tag: &str| {
            let end = joint.children().find(|child| child.has_tag_name(tag)).expect("an end");
            end.attribute("link").expect("a link").to_owned()
        };
        let is_moved = |name: &str| joints.iter().any(|joint| end(joint, "child") == name);
        let names = self.all("link").map(|link| link.attribute("name").expect("a name"));
        let mut poses: BTreeMap<String, Isometry3<f64>> = names
            .filter(|name| !is_moved(name))
            .map(|name| (name.to_owned(), Isometry3::identity()))
            .collect();
        assert_eq!(poses.len(), 1, "roots");
        for _ in &joints {
            for joint in &joints {
                if let Some(parent) = poses.get(&end(joint, "parent")).copied() {
                    let name = joint.attribute("name").expect("a name");
                    let place = origin(joint.children().find(|it| it.has_tag_name("origin")));
                    let own = match joint.children().find(|it| it.has_tag_name("mimic")) {
                        Some(mimic) => {
                            let number = |key| numbers(Some(mimic), key).map(|of| of[0]);
                            number("multiplier").unwrap_or(1.0)
                                * value(mimic.attribute("joint").expect("a joint"))
                                + number("offset").unwrap_or(0.0)
                        }
                        None => value(name),
                    };
                    let axis = joint.children().find(|it| it.has_tag_name("axis"));
                    let axis = Unit::new_normalize(three(axis, "xyz", [1.0, 0.0, 0.0]));
                    let motion = match joint.attribute("type").expect("a type") {
                        "fixed" => Isometry3::identity(),
                        "prismatic" => Translation3::from(axis.into_inner() * own).into(),
                        _ => Isometry3::from_parts(
                            Translation3::identity(),
                            UnitQuaternion::from_axis_angle(&axis, own),
                        ),
                    };
                    poses.insert(end(joint, "child"), parent * place * motion);
                }
            }
        }
        poses
    }

    /// Mass, first moment and moments of inertia about the origin of a link, in its axes, of all links together.
    pub fn weight(
        &self,
        at: &str,
        value: &dyn Fn(&str) -> f64,
    ) -> (f64, Vector3<f64>, Matrix3<f64>) {
        let poses = self.poses(value);
        let mut sum = (0.0, Vector3::zeros(), Matrix3::zeros());
        for link in self.all("link") {
            let Some(inertial) = link.children().find(|it| it.has_tag_name("inertial")) else {
                continue;
            };
            let part = |tag: &str| inertial.children().find(|it| it.has_tag_name(tag));
            let mass = numbers(part("mass"), "value").map_or(0.0, |of| of[0]);
            let [xx, xy, xz, yy, yz, zz] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]
                .map(|key| numbers(part("inertia"), key).map_or(0.0, |of| of[0]));
            let place = poses[at].inverse()
                * poses[link.attribute("name").expect("a name")]
                * origin(part("origin"));
            let turn = place.rotation.to_rotation_matrix();
            let own = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
            let c = (place * Point3::origin()).coords;
            sum.0 += mass;
            sum.1 += c * mass;
            let steiner = Matrix3::identity() * c.norm_squared() - c * c.transpose();
            sum.2 += turn * own * turn.transpose() + steiner * mass;
        }
        sum
    }
}

/// The inertial element of a link: mass, centre, and moments xx, xy, xz, yy, yz, zz.
pub fn inertial(link: Node) -> (f64, Vec<f64>, [f64; 6]) {
    let inertial = link.children().find(|it| it.has_tag_name("inertial")).expect("a mass");
    let part = |tag: &str| inertial.children().find(|it| it.has_tag_name(tag));
    let mass = numbers(part("mass"), "value").expect("a mass")[0];
    let moments = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]
        .map(|key| numbers(part("inertia"), key).expect("a moment")[0]);
    (mass, numbers(part("origin"), "xyz").unwrap_or(vec![0.0; 3]), moments)
}
