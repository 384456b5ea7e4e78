//! Joints: any fault in one refuses the file.

use std::collections::BTreeMap;

use super::{Joint, PartRead, UrdfdomReader, needed, number, numbers, vector};
use crate::prelude::*;

impl UrdfdomReader<'_> {
    pub(super) fn joints<'t>(&mut self, robot: Node<'t>) -> Reading<BTreeMap<&'t str, Joint<'t>>> {
        let mut joints = BTreeMap::new();
        for node in robot.named("joint") {
            let (name, joint) = match self.joint(node) {
                Ok(read) => read,
                Err((at, fault)) => return self.effects.refuse(at, fault),
            };
            if joints.insert(name, joint).is_some() {
                return self.effects.refuse(node, Fault::not_unique("joint", name));
            }
        }
        Ok(joints)
    }

    fn joint<'t>(&mut self, node: Node<'t>) -> PartRead<(&'t str, Joint<'t>)> {
        let name = &*needed(node, "name")?.value;
        self.pose(node)?;
        let end = |name| node.child(name).and_then(|end| end.value("link")).unwrap_or_default();
        let kind = needed(node, "type")?;
        if !JOINT_TYPES.contains(&&*kind.value) {
            return Err((kind.range.start, Fault::value("type", &kind.value)));
        }
        if let Some(axis) =
            node.child("axis").filter(|_| !matches!(&*kind.value, "fixed" | "floating"))
        {
            match axis.attribute("xyz") {
                Some(xyz) => drop(vector(xyz, 3)?),
                None => {
                    let part = Part::of("joint", name).inside("axis");
                    self.effects.read_as(axis, part, Fault::Missing("xyz"), "0 0 0");
                }
            }
        }
        let is_limited = matches!(&*kind.value, "revolute" | "prismatic");
        match node.child("limit") {
            Some(limit) => {
                self.limit(limit, is_limited, &Part::of("joint", name).inside("limit"))?
            }
            None if is_limited => return Err((node.start(), Fault::MissingElement("limit"))),
            None => {}
        }
        if let Some(safety) = node.child("safety_controller") {
            numbers(safety, &["soft_lower_limit", "soft_upper_limit", "k_position"])?;
            number(needed(safety, "k_velocity")?)?;
        }
        if let Some(calibration) = node.child("calibration") {
            numbers(calibration, &["rising", "falling"])?;
        }
        if let Some(mimic) = node.child("mimic") {
            needed(mimic, "joint")?;
            numbers(mimic, &["multiplier", "offset"])?;
        }
        if let Some(dynamics) = node.child("dynamics") {
            if ["damping", "friction"].iter().all(|name| dynamics.attribute(name).is_none()) {
                return Err((dynamics.start(), NO_DYNAMICS));
            }
            numbers(dynamics, &["damping", "friction"])?;
        }
        let (parent, child) = (end("parent"), end("child"));
        Ok((name, Joint { node, kind: &kind.value, parent, child }))
    }

    fn limit(&mut self, limit: Node<'_>, is_limited: bool, part: &Part) -> PartRead<()> {
        numbers(limit, &["lower", "upper"])?;
        if self.minor < 2 {
            for name in ["effort", "velocity"] {
                number(needed(limit, name)?)?;
            }
            self.effects.unread_attributes(limit, FURTHER, part);
            return Ok(());
        }
        let mut ends = [None; 2];
        for (name, end) in ["lower", "upper"].into_iter().zip(&mut ends) {
            *end = match is_limited {
                true => Some(number(needed(limit, name)?)?),
                false => limit.attribute(name).map(number).transpose()?,
            };
        }
        if let [Some(lower), Some(upper)] = ends
            && lower > upper
        {
            return Err((limit.start(), CROSSED));
        }
        let names = ["effort", "velocity"].into_iter().chain(FURTHER.split(' '));
        for value in names.filter_map(|name| limit.attribute(name)) {
            if number(value)? < 0.0 {
                return Err((value.at(), Fault::range(value, "must not be negative")));
            }
        }
        Ok(())
    }
}
