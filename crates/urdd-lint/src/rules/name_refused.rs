use std::collections::HashMap;

use super::prelude::*;

declare_lint! {
    /// A link or joint has a name that a program refuses.
    ///
    /// - A joint and a link have one name.
    /// - A joint is called `world`, or a link is that is not the root. Of a link that is fixed to one that moves, MuJoCo takes
    ///   it for the world: it stands still, with all that hangs on it.
    /// - A name begins with a slash: tf2 refuses it as the name of a frame.
    /// - A name has `::`, or `__` at both ends: they are reserved in SDFormat.
    /// - A name is empty.
    ///
    /// Choose another name, and change it wherever it is used: SRDF, controllers, launch files.
    LNT015 "name-refused", Warning, Format, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let links: BTreeSet<&str> = urdf.names(&urdf.links).collect();
    let world = world(urdf);
    let all = urdf.links.iter().map(|node| (node, false));
    for (node, is_joint) in all.chain(urdf.joints.iter().map(|node| (node, true))) {
        let Some(name) = node.attribute("name") else { continue };
        let is_reserved = name.len() >= 4 && name.starts_with("__") && name.ends_with("__");
        let wrong = if name.is_empty() {
            "the name is empty"
        } else if name.starts_with('/') {
            "tf2 refuses names that begin with a slash"
        } else if name.contains("::") || is_reserved {
            "SDFormat, so Gazebo, keeps `::` and `__NAME__` for itself"
        } else if is_joint && links.contains(name) {
            "a link has the same name"
        } else if is_joint && name == WORLD {
            "SDFormat, so Gazebo, keeps the name `world` for the world"
        } else if !is_joint && name == WORLD && world == World::Moved {
            "`world` is the world itself, and a joint moves this link"
        } else if !is_joint && name == WORLD && world == World::Carried {
            "MuJoCo takes the link for the world itself: it stands still, with all that hangs on it, while the robot moves"
        } else if !is_joint && name == WORLD && world == World::Fixed {
            "`world` is the world itself, and this link is fixed to another one"
        } else {
            continue;
        };
        urdf.at_attribute(*node, "name", format!("{wrong}; choose another name")).report(findings);
    }
    Some(())
}

const WORLD: &str = "world";

/// Where the link `world` is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum World {
    /// Nowhere, or at the root.
    Root,
    /// It is fixed to a link that does not move.
    Fixed,
    /// A joint moves it.
    Moved,
    /// It is fixed to a link that moves.
    Carried,
}

fn world<'a>(urdf: &Subject<'a>) -> World {
    let end = |joint: &Node<'a, 'a>, end: &str| {
        let link = joint.children().find(|node| node.has_tag_name(end));
        link.and_then(|link| link.attribute("link")).unwrap_or_default()
    };
    let mut above: HashMap<&str, Node> = HashMap::new();
    for joint in &urdf.joints {
        above.entry(end(joint, "child")).or_insert(*joint);
    }
    let mut link = WORLD;
    // A circle ends with the joints.
    for step in 0..=urdf.joints.len() {
        let Some(joint) = above.get(link) else {
            return if step == 0 { World::Root } else { World::Fixed };
        };
        if moves(*joint) {
            return if step == 0 { World::Moved } else { World::Carried };
        }
        link = end(joint, "parent");
    }
    World::Root
}

fn moves(joint: Node) -> bool {
    joint.attribute("type") != Some("fixed")
}
