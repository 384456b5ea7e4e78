//! Reads the kinematics of a URDF for tests: strict, small, and independent of the generator.

use urdd_format::dof::ResolvedMimic;
use urdd_format::index::DofIdx;
use urdd_format::urdf::JointType;
use urdd_xml::Node;

use crate::core_modules::{Joint, dof_count, first_dofs};

/// The names of the links, and the joints, both in the order of the text.
pub fn read(text: &str) -> (Vec<String>, Vec<Joint>) {
    let document = urdd_xml::parse(text, urdd_xml::Kind::Other).unwrap();
    let robot = document.root_element();
    let named = |tag| children(robot, tag).map(|node| (node.attribute("name").unwrap(), node));
    let links: Vec<String> = named("link").map(|(name, _)| name.to_owned()).collect();
    let index = |name: &str| links.iter().position(|link| link == name).unwrap();
    let end = |joint, tag| index(child(joint, tag).unwrap().attribute("link").unwrap());
    let mut joints: Vec<Joint> = named("joint")
        .map(|(name, node)| Joint {
            name: name.to_owned(),
            joint_type: joint_type(node.attribute("type").unwrap()),
            parent: end(node, "parent"),
            child: end(node, "child"),
            xyz: numbers(child(node, "origin"), "xyz", [0.0; 3]),
            rpy: numbers(child(node, "origin"), "rpy", [0.0; 3]),
            axis: numbers(child(node, "axis"), "xyz", [1.0, 0.0, 0.0]),
            // A placeholder, so that the joint has no DOF; resolved below once the drivers' DOFs are known.
            mimic: child(node, "mimic").map(|_| ResolvedMimic {
                dof_idx: None,
                multiplier: 0.0,
                offset: 0.0,
            }),
        })
        .collect();
    let nodes: Vec<Node> = named("joint").map(|(_, node)| node).collect();
    let resolved: Vec<_> = (0..joints.len()).map(|idx| resolve(&nodes, &joints, idx)).collect();
    for (joint, resolved) in joints.iter_mut().zip(resolved) {
        joint.mimic = joint.mimic.take().map(|_| resolved);
    }
    (links, joints)
}

/// How joint `idx` follows a DOF: its own, or the one at the end of its chain of mimic joints.
fn resolve(nodes: &[Node], joints: &[Joint], idx: usize) -> ResolvedMimic {
    let Some(mimic) = child(nodes[idx], "mimic") else {
        let moves = dof_count(&joints[idx]) > 0;
        let dof_idx = moves.then(|| DofIdx(first_dofs(joints)[idx]));
        return ResolvedMimic { dof_idx, multiplier: 1.0, offset: 0.0 };
    };
    let number =
        |name, absent| mimic.attribute(name).map_or(absent, |text| text.trim().parse().unwrap());
    let (multiplier, offset): (f64, f64) = (number("multiplier", 1.0), number("offset", 0.0));
    let driver = mimic.attribute("joint").unwrap();
    let driver = joints.iter().position(|joint| joint.name == driver).unwrap();
    let driver = resolve(nodes, joints, driver);
    ResolvedMimic {
        dof_idx: driver.dof_idx,
        multiplier: multiplier * driver.multiplier,
        offset: multiplier * driver.offset + offset,
    }
}

fn children<'a, 'd>(node: Node<'a, 'd>, tag: &'static str) -> impl Iterator<Item = Node<'a, 'd>> {
    node.children().filter(move |child| child.has_tag_name(tag))
}

fn child<'a, 'd>(node: Node<'a, 'd>, tag: &'static str) -> Option<Node<'a, 'd>> {
    children(node, tag).next()
}

fn numbers(node: Option<Node>, name: &str, absent: [f64; 3]) -> [f64; 3] {
    let Some(text) = node.and_then(|node| node.attribute(name)) else {
        return absent;
    };
    let numbers: Vec<f64> = text.split_whitespace().map(|word| word.parse().unwrap()).collect();
    numbers.try_into().unwrap()
}

fn joint_type(word: &str) -> JointType {
    let joint_type = JointType::ALL.iter().find(|known| known.as_str().eq_ignore_ascii_case(word));
    *joint_type.unwrap()
}
