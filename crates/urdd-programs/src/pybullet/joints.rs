//! Joints, and the tree that they make.

use std::collections::{HashMap, HashSet};

use super::{Joint, Reader, atof, pieces};
use crate::effect::Reading;
use crate::fault::Fault;
use crate::tree::{Attribute, Node};

impl Reader<'_> {
    pub(super) fn joint<'t>(
        &mut self,
        node: Node<'t>,
        links: &HashMap<&str, Node<'_>>,
    ) -> Reading<Joint<'t>> {
        let Some(name) = node.value("name") else {
            return self.effects.refuse(node, Fault::Missing("name"));
        };
        if name.is_empty() {
            return self.effects.crash(node, Fault::Empty("name"));
        }
        self.name_fits(node, "joint", name)?;
        let part = format!("joint/{name}");
        self.pose(node, &format!("{part}/origin"));
        let parent = self.end(node, "parent")?;
        let child = self.end(node, "child")?;
        let Some(kind) = node.attribute("type") else {
            return self.effects.crash(node, Fault::Missing("type"));
        };
        let known = ["revolute", "continuous", "prismatic", "fixed", "planar", "spherical"];
        if kind.value == "floating" {
            self.effects.read_as(kind, &*part, Fault::value("type", "floating"), "fixed");
        } else if !known.contains(&&*kind.value) {
            return self.effects.refuse(kind, Fault::value("type", &kind.value));
        }
        if !matches!(&*kind.value, "fixed" | "floating")
            && let Some(axis) = node.child("axis")
        {
            self.axis(axis, &format!("{part}/axis"))?;
            if kind.value == "spherical" {
                let fault = Fault::Other("a spherical joint has no axis");
                self.effects.drop(axis, format!("{part}/axis"), fault);
            }
        }
        self.limit(node, &kind.value, &format!("{part}/limit"))?;
        if let Some(dynamics) = node.child("dynamics") {
            let values = ["damping", "friction"].map(|name| dynamics.attribute(name));
            if values.iter().all(Option::is_none) {
                let fault = Fault::Other("`<dynamics>` has neither damping nor friction");
                return self.effects.refuse(dynamics, fault);
            }
            for value in values.into_iter().flatten() {
                self.number(value, &format!("{part}/dynamics"));
            }
        }
        for unread in ["mimic", "calibration", "safety_controller"] {
            if let Some(found) = node.child(unread) {
                self.effects.drop(
                    found,
                    format!("{part}/{unread}"),
                    Fault::NeverRead(unread.into()),
                );
            }
        }
        for (end, name) in [(child, "child"), (parent, "parent")] {
            if !links.contains_key(end) {
                let place = node.child(name).unwrap_or(node);
                return self.effects.refuse(place, Fault::unknown("link", end));
            }
        }
        Ok(Joint { node, name, parent, child })
    }

    /// The name of a joint's parent or child.
    fn end<'t>(&mut self, joint: Node<'t>, name: &'static str) -> Reading<&'t str> {
        let Some(end) = joint.child(name) else {
            return self.effects.refuse(joint, Fault::MissingElement(name));
        };
        match end.value("link") {
            Some("") => self.effects.refuse(end, Fault::Empty("link")),
            Some(link) => Ok(link),
            None if name == "child" => self.effects.crash(end, Fault::Missing("link")),
            None => self.effects.refuse(end, Fault::Missing("link")),
        }
    }

    fn axis(&mut self, axis: Node<'_>, part: &str) -> Reading<()> {
        let Some(xyz) = axis.attribute("xyz") else {
            self.effects.read_as(axis, part, Fault::Missing("xyz"), "whatever the memory has");
            return Ok(());
        };
        if pieces(&xyz.value).len() < 3 {
            return self.effects.refuse(xyz, Fault::count("xyz", 3, &xyz.value));
        }
        self.vector(xyz, part, "");
        let numbers = pieces(&xyz.value).into_iter().take(3).map(atof);
        if numbers.fold(0.0, |sum, number| sum + number * number) == 0.0 {
            let fault = Fault::range("xyz", &xyz.value, "an axis has no length 0");
            self.effects.read_as(xyz, part, fault, "nan");
        }
        Ok(())
    }

    fn limit(&mut self, joint: Node<'_>, kind: &str, part: &str) -> Reading<()> {
        let Some(limit) = joint.child("limit") else {
            return match kind {
                "revolute" | "prismatic" => {
                    self.effects.refuse(joint, Fault::MissingElement("limit"))
                }
                _ => Ok(()),
            };
        };
        let values = ["lower", "upper", "effort", "velocity"].map(|name| limit.attribute(name));
        for value in values.into_iter().flatten() {
            self.number(value, part);
        }
        let end = |value: Option<&Attribute<'_>>, default| {
            value.map_or(default, |value| atof(&value.value))
        };
        let (lower, upper) = (end(values[0], 0.0), end(values[1], -1.0));
        if matches!(kind, "revolute" | "prismatic") && lower > upper {
            let fault = match values[1] {
                Some(_) => Fault::Other("`lower` is above `upper`"),
                None => Fault::Missing("upper"),
            };
            self.effects.read_as(limit, part, fault, "no limit");
        }
        Ok(())
    }

    pub(super) fn tree(
        &mut self,
        robot: Node<'_>,
        links: &HashMap<&str, Node<'_>>,
        joints: &[Joint<'_>],
    ) -> Reading<()> {
        let mut children: HashMap<&str, Vec<&str>> = HashMap::new();
        let mut has_parent = HashSet::new();
        for joint in joints {
            children.entry(joint.parent).or_default().push(joint.child);
            has_parent.insert(joint.child);
        }
        let mut roots: Vec<_> = links
            .iter()
            .filter(|(name, _)| !has_parent.contains(*name))
            .map(|(name, node)| (node.start(), *name))
            .collect();
        roots.sort_unstable();
        match roots[..] {
            [] => return self.effects.refuse(robot, Fault::Tree("no link is the root")),
            [_] => {}
            [_, (second, _), ..] => {
                return self
                    .effects
                    .crash(second, Fault::Tree("two links have no joint above them"));
            }
        }
        let mut reached = HashSet::from([roots[0].1]);
        let mut open = vec![roots[0].1];
        while let Some(link) = open.pop() {
            for &child in children.get(link).into_iter().flatten() {
                if !reached.insert(child) {
                    let at = joints
                        .iter()
                        .rfind(|joint| joint.child == child)
                        .map_or(robot, |joint| joint.node);
                    return self
                        .effects
                        .crash(at, Fault::Tree("a link is the child of two joints"));
                }
                open.push(child);
            }
        }
        let fault = Fault::Tree("it is in a loop, which the root does not reach");
        for (name, node) in links.iter().filter(|(name, _)| !reached.contains(*name)) {
            self.effects.drop(*node, format!("link/{name}"), fault.clone());
        }
        for joint in joints.iter().filter(|joint| !reached.contains(joint.child)) {
            self.effects.drop(joint.node, format!("joint/{}", joint.name), fault.clone());
        }
        Ok(())
    }
}
