//! Names that SDF cannot have, or that are of nothing.

use super::tree::{Release, Tree};
use crate::prelude::*;

/// The names of the robot, and of links and joints that are kept, or are SDF in a `<gazebo>`: `own`.
pub(super) fn check(
    robot: Node<'_>,
    links: &Tree<'_>,
    own: &[Node<'_>],
    effects: &mut Effects,
) -> Reading<()> {
    let release = links.release;
    let one = |node, kind, name, effects: &mut Effects| one(node, kind, name, release, effects);
    one(robot, "robot", robot.value("name").unwrap_or_default(), effects)?;
    let mut names = HashSet::new();
    let bodies = || links.bodies.iter().filter(|body| body.is_made);
    let joints = bodies().filter_map(|body| body.joint.as_ref());
    let joints = joints.filter(|joint| !joint.has_no_type());
    let all = bodies().map(|body| (body.node, "link", body.name));
    for (node, kind, name) in all.chain(joints.map(|joint| (joint.node, "joint", joint.name))) {
        one(node, kind, name, effects)?;
        let read = release.read(name);
        if read != name {
            let rule = match release {
                Release::Twelve => "white space around it is cut off, `true` is 1 and `false` 0",
                Release::Fourteen => "white space around it is cut off",
            };
            effects.read_as(node, Part::of(kind, name), Fault::name(kind, name, rule), read);
        }
        if !names.insert(read) {
            return effects.refuse(node, Fault::not_unique("link or joint", name));
        }
    }
    let of_name = |name| {
        let mut all = links.bodies.iter().filter_map(|body| body.joint.as_ref());
        all.find(|joint| joint.name == name).map(|joint| joint.node)
    };
    for (body, from) in links.frames() {
        for (node, kind, name) in [(body.node, "link", body.name), (from.node, "joint", from.name)]
        {
            one(node, kind, name, effects)?;
            if !names.insert(release.read(name)) {
                // Where a joint and a link have one name, the joint is named.
                let fault = Fault::not_unique("link or joint", name);
                return effects.refuse(of_name(name).unwrap_or(node), fault);
            }
        }
    }
    let own = || own.iter().filter_map(|&node| Some((node, node.value("name")?)));
    for (node, name) in own() {
        one(node, if node.name() == "link" { "link" } else { "joint" }, name, effects)?;
        if !names.insert(release.read(name)) {
            return effects.refuse(node, Fault::not_unique("link or joint", name));
        }
    }
    for (node, name) in own().filter(|(node, _)| node.name() == "joint") {
        joint(node, name, &names, release, effects)?;
    }
    Ok(())
}

/// A joint of SDF: its type, and the links, or joints in their place, that it connects.
fn joint(
    node: Node<'_>,
    name: &str,
    names: &HashSet<&str>,
    release: Release,
    effects: &mut Effects,
) -> Reading<()> {
    const KINDS: &str =
        "ball continuous fixed gearbox prismatic revolute revolute2 screw universal";
    if let Some(kind) = node.attribute("type")
        && !KINDS.split(' ').any(|known| known.eq_ignore_ascii_case(&kind.value))
    {
        return effects.refuse(kind, Fault::value("type", &kind.value));
    }
    let ends = ["parent", "child"].map(|end| {
        let end = node.child(end)?;
        Some((end, release.read(end.text()?)))
    });
    let [Some(parent), Some(child)] = ends else { return Ok(()) };
    for (end, link) in [parent, child] {
        let is_world = link == "world" && end.name() == "parent";
        if !is_world && (link == release.read(name) || !names.contains(link)) {
            return effects.refuse(end, Fault::unknown("link or joint", link));
        }
    }
    if parent.1 == child.1 {
        return effects.refuse(child.0, Fault::Tree("a joint has one link on both sides"));
    }
    Ok(())
}

fn one(
    node: Node<'_>,
    kind: &'static str,
    name: &str,
    release: Release,
    effects: &mut Effects,
) -> Reading<()> {
    let read = release.read(name);
    let is_reserved = name == "world"
        || read == "world"
        || read.len() >= 4 && read.starts_with("__") && read.ends_with("__");
    let at = node.attribute("name").map_or(node.start(), |name| name.range.start);
    if read.is_empty() {
        return effects.refuse(at, Fault::Empty("name"));
    }
    if release.keeps(name) {
        return effects.refuse(at, scoped(kind, name));
    }
    if is_reserved {
        return effects.refuse(at, Fault::name(kind, name, "the name is one of SDF's own"));
    }
    Ok(())
}

/// Why a name of a kind of thing is refused that has `::` in it.
pub(super) fn scoped(kind: &'static str, name: &str) -> Fault {
    Fault::name(kind, name, "SDF has `::` between names")
}
