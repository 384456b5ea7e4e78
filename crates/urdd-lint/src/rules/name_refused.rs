use super::prelude::*;

declare_lint! {
    /// A link or joint has a name that a program refuses.
    ///
    /// - A joint and a link of one name: SDFormat, so Gazebo, refuses the robot.
    /// - `world` on a link that is not the root: MuJoCo refuses the robot, an error; SDFormat keeps this name for the world.
    /// - A slash at the beginning: tf2 refuses it as the name of a frame.
    /// - `::`, and `__` at both ends: reserved in SDFormat.
    /// - An empty name: PyBullet 3.2.7 crashes. urdfdom, so Pinocchio, refuses the file if it is a link's: an error.
    ///
    /// Choose another name, and change it wherever it is used: SRDF, controllers, launch files.
    LNT015 "name-refused", Warning, Format, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let links: BTreeSet<&str> = urdf.names(&urdf.links).collect();
    let children = urdf.joints.iter().filter_map(|joint| child(*joint, "child"));
    let children: BTreeSet<&str> = children.filter_map(|child| child.attribute("link")).collect();
    let all = urdf.links.iter().map(|node| (node, false));
    for (node, is_joint) in all.chain(urdf.joints.iter().map(|node| (node, true))) {
        let Some(name) = node.attribute("name") else {
            continue;
        };
        let is_reserved = name.len() > 4 && name.starts_with("__") && name.ends_with("__");
        let wrong = if name.is_empty() {
            "the name is empty: urdfdom refuses the file, and PyBullet crashes"
        } else if name.starts_with('/') {
            "tf2 refuses names that begin with a slash"
        } else if name.contains("::") || is_reserved {
            "SDFormat, so Gazebo, keeps `::` and `__NAME__` for itself"
        } else if is_joint && links.contains(name) {
            "a link has the same name, and SDFormat, so Gazebo, refuses that"
        } else if !is_joint && name == "world" && children.contains(name) {
            "MuJoCo refuses the robot: `world` is the world itself, and this link is not the root"
        } else {
            continue;
        };
        let message = format!("{wrong}; choose another name");
        let is_refused = !is_joint && (name.is_empty() || name == "world");
        error_if(is_refused, urdf.at_attribute(*node, "name", message)).report(findings);
    }
    Some(())
}
