//! The parts of a composed robot, as a tree.

use std::fmt::{self, Write};

use serde::Serialize;

use urdd_document::robot::Robot;
use urdd_format::composition::{CompositionBase, CompositionPart};
use urdd_format::escape;

/// A part of a composed robot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PartInfo {
    /// Its id in the recipe.
    pub id: String,
    /// Name of the robot that it was made from.
    pub robot: String,
    /// Prefix of its names.
    pub prefix: String,
    /// Number of its links.
    pub links: usize,
    /// Number of its links that were dropped.
    pub dropped_links: usize,
    /// Number of its joints that were made fixed.
    pub frozen_joints: usize,
    /// Id of the part that carries it; null if the base or nothing does.
    pub on_part: Option<String>,
    /// Name of the link that carries it, if known.
    pub on_link: Option<String>,
    /// Name of the joint that attaches it, if known.
    pub by_joint: Option<String>,
    /// Type of that joint, if known.
    pub joint_type: Option<String>,
    /// The parts attached to it.
    pub carries: Vec<PartInfo>,
    /// The parts that it was itself composed of.
    pub parts: Vec<PartInfo>,
}

/// The parts of a composition that no other part carries, each with the parts attached to it. `robot` is the robot that
/// the indices refer to, if available.
pub(super) fn tree(parts: &[CompositionPart], robot: Option<&Robot>) -> Vec<PartInfo> {
    let on = |part: &CompositionPart| Some(part.attachment.as_ref()?.part_idx?.get());
    let tops = (0..parts.len()).filter(|idx| on(&parts[*idx]).is_none());
    tops.map(|idx| part(parts, idx, robot, parts.len())).collect()
}

/// `depth` bounds the recursion for invalid documents, in which a part can be attached to itself.
fn part(parts: &[CompositionPart], idx: usize, robot: Option<&Robot>, depth: usize) -> PartInfo {
    let of = &parts[idx];
    let attachment = of.attachment.as_ref();
    let carrier = attachment.and_then(|attachment| parts.get(attachment.part_idx?.get()));
    let link = attachment.and_then(|attachment| {
        let idx = attachment.link_idx;
        let known = || robot?.links.get(idx.get()).map(|link| link.name.clone());
        let of_part = || {
            let carrier = carrier?;
            let link = carrier.links.iter().find(|link| link.link_idx == idx)?;
            Some(format!("{}{}", carrier.prefix, link.name))
        };
        known().or_else(of_part)
    });
    let joint = attachment.and_then(|of| robot?.joints.get(of.joint_idx.get()));
    let hangs_here = |other: &usize| {
        let attachment = parts[*other].attachment.as_ref();
        let on = attachment.and_then(|attachment| attachment.part_idx);
        depth > 0 && on.is_some_and(|on| on.get() == idx)
    };
    PartInfo {
        id: of.id.clone(),
        robot: of.name.clone(),
        prefix: of.prefix.clone(),
        links: of.links.len(),
        dropped_links: of.dropped_links.len(),
        frozen_joints: of.frozen_joints.len(),
        on_part: carrier.map(|carrier| carrier.id.clone()),
        on_link: link,
        by_joint: joint.map(|joint| joint.name.clone()),
        joint_type: joint.map(|joint| joint.joint_type.to_string()),
        carries: (0..parts.len())
            .filter(hangs_here)
            .map(|other| part(parts, other, robot, depth.saturating_sub(1)))
            .collect(),
        parts: (of.composition.as_ref()).map_or_else(Vec::new, |nested| tree(&nested.parts, None)),
    }
}

/// The name of the base's link.
pub(super) fn base(base: Option<&CompositionBase>, robot: Option<&Robot>) -> Option<String> {
    let link = robot?.links.get(base?.link_idx.get())?;
    Some(link.name.clone())
}

/// Writes the tree for people.
pub(super) fn write(parts: &[PartInfo], margin: &str, out: &mut impl Write) -> fmt::Result {
    for part in parts {
        write!(out, "{margin}{}", escape::line(&part.id))?;
        write!(out, "  (robot {}, {} links", escape::line(&part.robot), part.links)?;
        let counts = [(part.dropped_links, "dropped"), (part.frozen_joints, "joints frozen")];
        for (count, what) in counts.into_iter().filter(|(count, _)| *count > 0) {
            write!(out, ", {count} {what}")?;
        }
        out.write_str(")")?;
        if let Some(link) = &part.on_link {
            write!(out, "  on {}", escape::line(link))?;
        }
        if let (Some(joint), Some(kind)) = (&part.by_joint, &part.joint_type) {
            write!(out, "  by {} ({})", escape::line(joint), escape::line(kind))?;
        }
        out.write_char('\n')?;
        if !part.parts.is_empty() {
            writeln!(out, "{margin}  is put together of")?;
            write(&part.parts, &format!("{margin}    "), out)?;
        }
        write(&part.carries, &format!("{margin}  "), out)?;
    }
    Ok(())
}
