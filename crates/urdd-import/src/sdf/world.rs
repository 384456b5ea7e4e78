//! Joints of a world that hold on to the robot.

use super::super::refusal::Refusal;
use super::joint_reader::{end, read};
use super::reader::Reader;
use super::scene::WORLD;
use super::tag::Tag;

/// Reads the joints between the model that was read and the world. The others are lost.
///
/// # Errors
/// If one is refused.
pub fn world_joints(reader: &mut Reader, world: Tag, model: &str) -> Result<(), Refusal> {
    for tag in world.children().filter(|child| child.name() == "joint") {
        let inside = |name: &str| match name.strip_prefix(model)? {
            "" => Some("__model__".to_owned()),
            rest => rest.strip_prefix("::").map(str::to_owned),
        };
        let parent = end(tag, "parent")?;
        let parent = if parent == WORLD { Some(parent) } else { inside(&parent) };
        let axes = ["axis", "axis2"].map(|axis| tag.descendant(&[axis, "xyz"]));
        let axes = axes.map(|xyz| xyz.and_then(|xyz| xyz.attribute("expressed_in")));
        let (_, relative_to) = tag.pose()?;
        let frames = axes.into_iter().chain([relative_to.as_deref()]).flatten();
        let is_known =
            frames.filter(|name| *name != "__model__").all(|name| inside(name).is_some());
        let Some((parent, child)) = parent.zip(inside(&end(tag, "child")?)).filter(|_| is_known)
        else {
            reader.tally.unread("`<joint>` of `<world>`");
            let text = "a joint of the world to what is not of the robot is lost";
            reader.tally.remark(tag.place(), text);
            continue;
        };
        let (mut node, mut joint) = read(reader, tag, 0)?;
        node.attached_to = Some(child);
        node.relative_to = node.relative_to.as_deref().and_then(inside);
        joint.parent = parent;
        for axis in &mut joint.axes {
            axis.expressed_in = axis.expressed_in.as_deref().map(|name| match inside(name) {
                Some(inside) => inside,
                None => name.to_owned(),
            });
        }
        // Names in the model do not mean it: it is in no table.
        reader.scene.nodes.push(node);
        reader.scene.joints.push(joint);
    }
    Ok(())
}
