//! How it reads joints. Of what repeats, the last counts.

use super::{Joint, ThreeReader, name_of, named};
use crate::prelude::*;

impl<'t> ThreeReader<'_, 't> {
    pub(super) fn joint(
        &mut self,
        node: Node<'t>,
        links: &HashMap<&str, Node<'t>>,
    ) -> Reading<Joint<'t>> {
        let part = Part::of("joint", name_of(node));
        let mimic = named(node, "mimic").next();
        if let Some(mimic) = mimic {
            self.numbers(mimic, &["multiplier", "offset"], &part.inside("mimic"), "NaN");
        }
        self.pose(node, &part);
        let Some(parent) = self.last(node, "parent", &part) else {
            return self.effects.refuse(node, Fault::MissingElement("parent"));
        };
        let link = parent.value("link").unwrap_or("null");
        if !links.contains_key(link) {
            return self.effects.refuse(parent, Fault::unknown("link", link));
        }
        let child = self.last(node, "child", &part);
        let link = child.map(|child| child.value("link").unwrap_or("null"));
        if link.is_none_or(|link| !links.contains_key(link)) {
            let fault = Fault::unknown("link", link.unwrap_or_default());
            self.effects.drop(child.unwrap_or(node), part.inside("child"), fault);
        }
        if let Some(axis) = named(node, "axis").next() {
            let Some(xyz) = axis.attribute("xyz") else {
                return self.effects.refuse(axis, Fault::Missing("xyz"));
            };
            self.axis(xyz, &part.inside("axis"));
        }
        self.limit(node, &part);
        for unread in ["dynamics", "calibration", "safety_controller"] {
            if let Some(found) = named(node, unread).next() {
                self.effects.unread(found, part.inside(unread), unread);
            }
        }
        Ok(Joint { node, child: link, mimic })
    }

    /// An axis is split at white space, which may be before the first number too.
    fn axis(&mut self, xyz: &Attribute<'_>, part: &Part) {
        let text = &*xyz.value;
        let is_padded = text.is_empty() || text.starts_with(char::is_whitespace);
        let before = is_padded.then_some("");
        self.vector(xyz, before.into_iter().chain(text.split_whitespace()), 3, part);
    }

    fn limit(&mut self, joint: Node<'t>, part: &Part) {
        let (kind, part) = (joint.attribute("type"), part.inside("limit"));
        let text = kind.map_or("", |kind| &*kind.value);
        if !JOINT_TYPES.contains(&text) {
            let at = kind.map_or(joint.start(), |kind| kind.range.start);
            let part = Part::of("joint", name_of(joint));
            self.effects.read_as(at, part, Fault::value("type", text), "fixed");
        }
        let is_limited = matches!(text, "revolute" | "prismatic");
        let mut limits = named(joint, "limit").peekable();
        if limits.peek().is_none() && is_limited {
            self.effects.read_as(joint, &part, Fault::MissingElement("limit"), "locked at 0");
        }
        for limit in limits {
            self.numbers(limit, &["lower", "upper", "effort", "velocity"], &part, "NaN");
            self.effects.unread_attributes(limit, FURTHER, &part);
        }
    }

    /// Of joints with one child the last has it.
    pub(super) fn children(&mut self, joints: &[Joint<'t>]) {
        let mut last: HashMap<&str, Node<'t>> = HashMap::new();
        for joint in joints {
            let Some(child) = joint.child else { continue };
            if let Some(other) =
                last.insert(child, joint.node).filter(|one| !one.is_like(joint.node))
            {
                let part = Part::of("joint", name_of(other)).inside("child");
                self.effects.drop(joint.node, part, TWO_PARENTS);
            }
        }
    }

    pub(super) fn mimics(
        &mut self,
        joints: &[Joint<'t>],
        by_name: &HashMap<&str, usize>,
    ) -> Reading<()> {
        /// How often a joint was met: never, on the way, or to its end.
        const NEW: usize = 0;
        const DONE: usize = usize::MAX;
        let mut driver = vec![None; joints.len()];
        for (index, joint) in joints.iter().enumerate() {
            let Some(mimic) =
                joint.mimic.filter(|_| by_name.get(name_of(joint.node)) == Some(&index))
            else {
                continue;
            };
            let name = mimic.value("joint").unwrap_or("null");
            driver[index] = by_name.get(name).copied();
            if driver[index].is_none() {
                return self.effects.refuse(mimic, Fault::unknown("joint", name));
            }
        }
        let mut met = vec![NEW; joints.len()];
        for start in 0..joints.len() {
            let mut way = Vec::new();
            let mut at = Some(start);
            while let Some(joint) = at.filter(|&joint| met[joint] == NEW) {
                met[joint] = start + 1;
                way.push(joint);
                at = driver[joint];
            }
            if let Some(again) = at.filter(|&joint| met[joint] == start + 1) {
                let place = joints[again].mimic.unwrap_or(joints[again].node);
                let fault = Fault::Other("joints mimic each other in a loop");
                return self.effects.refuse(place, fault);
            }
            way.into_iter().for_each(|joint| met[joint] = DONE);
        }
        Ok(())
    }
}
