//! Builds the `composition_module`, which records how a robot was composed.

use std::collections::HashMap;

use super::compose::{Held, Member};
use super::recipe::Recipe;
use urdd_format::composition::{
    CompositionBase, CompositionModule, CompositionPart, FrozenJoint, PartAttachment, PartJoint,
    PartLink,
};
use urdd_format::index::{JointIdx, LinkIdx, RobotIdx};
use urdd_format::urdf::UrdfModule;

pub(super) fn composition(
    recipe: &Recipe,
    parts: &[Member],
    holders: &[Option<Held>],
    robot: &UrdfModule,
) -> CompositionModule {
    let links: HashMap<&str, u32> =
        (robot.links.iter().map(|link| link.name.as_str())).zip(0..).collect();
    let joints: HashMap<&str, u32> =
        (robot.joints.iter().map(|joint| joint.name.as_str())).zip(0..).collect();
    let link = |name: &str| LinkIdx(links.get(name).copied().unwrap_or_default());
    let joint = |name: &str| JointIdx(joints.get(name).copied().unwrap_or_default());
    let mut made = Vec::new();
    for (member, held) in parts.iter().zip(holders) {
        let (part, of) = (member.part, &member.loaded.robot);
        let attachment = held.as_ref().map(|held| PartAttachment {
            part_idx: held.part.map(|part| RobotIdx(part as u32)),
            link_idx: link(&held.link),
            joint_idx: joint(&held.joint.name.text),
        });
        let dropped = |names: &mut dyn Iterator<Item = &String>, dropped: &[Option<usize>]| {
            let names = names.zip(dropped).filter(|(_, with)| with.is_some());
            names.map(|(name, _)| name.clone()).collect()
        };
        let frozen = member.trim.frozen.iter().map(|(idx, position)| FrozenJoint {
            joint_idx: joint(&member.renamed(&of.joints[*idx].name)),
            position: position.iter().map(|value| value + 0.0).collect(),
        });
        made.push(CompositionPart {
            id: part.id.text.clone(),
            name: of.name.clone(),
            source: member.loaded.source.clone(),
            prefix: part.prefix.text.clone(),
            links: (member.kept_links().map(|link| &link.name))
                .map(|name| PartLink { name: name.clone(), link_idx: link(&member.renamed(name)) })
                .collect(),
            joints: (member.kept_joints().map(|joint| &joint.name))
                .map(|name| PartJoint {
                    name: name.clone(),
                    joint_idx: joint(&member.renamed(name)),
                })
                .collect(),
            dropped_links: dropped(
                &mut of.links.iter().map(|link| &link.name),
                &member.trim.dropped_links,
            ),
            dropped_joints: dropped(
                &mut of.joints.iter().map(|joint| &joint.name),
                &member.trim.dropped_joints,
            ),
            frozen_joints: frozen.collect(),
            attachment,
            composition: member.loaded.composition.clone().map(Into::into),
        });
    }
    let base = recipe.base.as_ref().map(|base| CompositionBase { link_idx: link(&base.to.text) });
    CompositionModule { base, parts: made }
}
