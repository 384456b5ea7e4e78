//! Builds the `composition_module`, which records how a robot was composed.

use std::collections::HashMap;

use super::compose::{Taken, held};
use super::error::CombineError;
use super::recipe::Recipe;
use urdd_format::composition::{
    CompositionBase, CompositionModule, CompositionPart, FrozenJoint, PartAttachment, PartJoint,
    PartLink,
};
use urdd_format::index::{JointIdx, LinkIdx, RobotIdx};
use urdd_format::urdf::UrdfModule;

/// Builds the module of a combined robot.
///
/// # Errors
/// If an attachment does not name a part; an earlier check rules this out.
pub(super) fn composition(
    recipe: &Recipe,
    parts: &[Taken],
    robot: &UrdfModule,
) -> Result<CompositionModule, CombineError> {
    let links = (robot.links.iter().map(|link| link.name.as_str())).zip(0..);
    let links: HashMap<&str, u32> = links.collect();
    let joints = (robot.joints.iter().map(|joint| joint.name.as_str())).zip(0..);
    let joints: HashMap<&str, u32> = joints.collect();
    let link = |name: &str| LinkIdx(links.get(name).copied().unwrap_or_default());
    let joint = |name: &str| JointIdx(joints.get(name).copied().unwrap_or_default());
    let mut made = Vec::new();
    for taken in parts {
        let (part, of) = (taken.part, &taken.loaded.robot);
        let attachment = held(recipe, parts, taken)?.map(|held| PartAttachment {
            part_idx: held.part.map(|part| RobotIdx(part as u32)),
            link_idx: link(&held.link),
            joint_idx: joint(&held.joint.name.text),
        });
        let all_links = of.links.iter().map(|link| &link.name).enumerate();
        let (kept, dropped): (Vec<_>, Vec<_>) =
            all_links.partition(|(idx, _)| taken.trim.keeps_link(*idx));
        let all_joints = of.joints.iter().map(|joint| &joint.name).enumerate();
        let (kept_joints, dropped_joints): (Vec<_>, Vec<_>) =
            all_joints.partition(|(idx, _)| taken.trim.keeps_joint(*idx));
        let names =
            |list: Vec<(usize, &String)>| list.into_iter().map(|(_, name)| name.clone()).collect();
        let frozen = taken.trim.frozen.iter().map(|(idx, position)| FrozenJoint {
            joint_idx: joint(&taken.renamed(&of.joints[*idx].name)),
            position: position.iter().map(|value| value + 0.0).collect(),
        });
        made.push(CompositionPart {
            id: part.id.text.clone(),
            name: of.name.clone(),
            source: taken.loaded.source.clone(),
            prefix: part.prefix.text.clone(),
            links: (kept.into_iter())
                .map(|(_, name)| PartLink {
                    name: name.clone(),
                    link_idx: link(&taken.renamed(name)),
                })
                .collect(),
            joints: (kept_joints.into_iter())
                .map(|(_, name)| PartJoint {
                    name: name.clone(),
                    joint_idx: joint(&taken.renamed(name)),
                })
                .collect(),
            dropped_links: names(dropped),
            dropped_joints: names(dropped_joints),
            frozen_joints: frozen.collect(),
            attachment,
            composition: taken.loaded.composition.clone().map(Into::into),
        });
    }
    let base = recipe.base.as_ref().map(|base| CompositionBase { link_idx: link(&base.link.text) });
    Ok(CompositionModule { base, parts: made })
}
