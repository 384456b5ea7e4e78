use super::prelude::*;

declare_lint! {
    /// The origin of a joint, a visual or a collision is tens of metres away, and the robot's parts are far smaller.
    ///
    /// It is in millimetres. Parts are scattered: RViz shows one of them, because the others are hundreds of metres away, and
    /// planners and simulators take the robot for one of that size.
    ///
    /// Before, between boxes of 0.1 m: `<origin xyz="300 0 50"/>`. After: `<origin xyz="0.3 0 0.05"/>`.
    ///
    /// Write lengths in metres.
    LNT064 "origin-in-millimetres", Warning, WrongPlace, since "1.3.0"
}

/// The shortest distance, m, that shows that lengths are in millimetres: 1 cm.
const LEAST: f64 = 10.0;
/// How often the largest shape fits into the distance.
const TIMES: f64 = 30.0;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let (robot, _) = urdf.bodies(findings)?;
    let length = |xyz: [f64; 3]| Vector3::from(xyz).norm();
    let joints = robot.joints.iter().zip(&urdf.joints);
    let mut origins: Vec<(f64, Node)> =
        joints.map(|(joint, node)| (length(joint.origin.xyz), *node)).collect();
    for (link, node) in robot.links.iter().zip(&urdf.links) {
        for (kind, name) in
            [(GeometryKind::Visual, "visual"), (GeometryKind::Collision, "collision")]
        {
            let nodes = children(*node).filter(|(one, _)| *one == name).map(|(_, node)| node);
            let elements = link.elements(kind).iter().zip(nodes);
            origins.extend(elements.map(|(one, node)| (length(one.origin.xyz), node)));
        }
    }
    if origins.iter().all(|(length, _)| *length < LEAST) {
        return Some(());
    }
    let geometry = urdf.geometry(findings)?;
    let shapes = geometry.links.iter().flat_map(|link| &link.shapes);
    let largest = shapes.map(|shape| diagonal(shape.corners())).fold(0.0, f64::max);
    // A shape that is not known may be as large as the distances.
    if geometry.links.iter().any(|link| link.is_partial) || largest == 0.0 {
        return Some(());
    }
    origins.retain(|(length, _)| *length > TIMES * largest);
    if origins.iter().all(|(length, _)| *length < LEAST) {
        return Some(());
    }
    for (length, node) in origins {
        let of = match node.tag_name().name() {
            "joint" => "joint is placed on its parent",
            "visual" => "visual is placed on its link",
            _ => "collision is placed on its link",
        };
        let message = format!(
            "the {of} at a distance of {}, and the largest shape of the robot is {}; if `xyz` is in millimetres, divide it by \
            1000",
            metres(length),
            metres(largest)
        );
        urdf.at(child(node, "origin").unwrap_or(node), message).report(findings);
    }
    Some(())
}
