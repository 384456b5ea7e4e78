//! Joints.

use crate::mujoco::reader::{MujocoReader, Release};
use crate::number::Pose;
use crate::prelude::*;

pub struct Joint<'t> {
    pub node: Node<'t>,
    pub name: &'t str,
    pub kind: &'t str,
    pub pose: Pose,
}

impl Joint<'_> {
    pub fn moves(&self) -> bool {
        self.kind != "fixed"
    }

    /// Whether it can mimic, and be mimicked.
    fn is_scalar(&self) -> bool {
        matches!(self.kind, "revolute" | "continuous" | "prismatic")
    }
}

impl MujocoReader<'_> {
    /// Reads a joint; `names` are those of joints that move.
    pub fn joint<'t>(
        &mut self,
        node: Node<'t>,
        names: &mut HashSet<&'t str>,
    ) -> Reading<Joint<'t>> {
        let kind = self.effects.needed(node, "type")?;
        if !JOINT_TYPES.contains(&&*kind.value) && kind.value != "spherical" {
            return self.effects.refuse(kind, Fault::value("type", &kind.value));
        }
        let name = self.text(node, "name")?;
        let part = Part::of("joint", name);
        let pose = self.origin(node, &part);
        let at = pose.as_ref().map_or_else(|_| Pose::default(), Pose::clone);
        let joint = Joint { node, name, kind: &kind.value, pose: at };
        let _ = self.axis(&joint);
        if !joint.moves() {
            return Ok(joint);
        }
        self.readable(node, "joint", name);
        if let Some(origin) = node.child("origin").filter(|_| pose.is_ok()) {
            self.finite(origin, &["xyz", "rpy"]);
        }
        if !names.insert(name) && !name.is_empty() {
            let fault = Fault::not_unique("joint", name);
            match self.release {
                Release::Three => return self.effects.refuse(node, fault),
                Release::Four => self.effects.read_as(node, &part, fault, "without a name"),
            }
        }
        if let Ok(Some(dynamics)) = self.only(node, "dynamics") {
            let part = part.inside("dynamics");
            let _ = self.number(dynamics, "damping", &part);
            let _ = self.number(dynamics, "friction", &part);
            self.finite(dynamics, &["damping", "friction"]);
        }
        let _ = self.limit(&joint, &part);
        if joint.kind == "planar" {
            let fault = Fault::Way("a planar joint becomes three joints");
            self.effects.read_as(kind, &part, fault, format!("{name}_TX, {name}_TY and {name}_RZ"));
        }
        self.effects.unread_elements(node, "safety_controller calibration", &part);
        Ok(joint)
    }

    fn axis(&mut self, joint: &Joint<'_>) -> Reading<()> {
        const LEAST: f64 = 1e-14;
        let Some(axis) = self.only(joint.node, "axis")? else { return Ok(()) };
        let numbers: [f64; 3] = self.needed_numbers(axis, "xyz")?;
        let square: f64 = numbers.iter().map(|number| number * number).sum();
        if square < LEAST && (joint.is_scalar() || joint.kind == "planar") {
            self.effects.refuse_mendable(axis, Fault::Other("the axis has no length"));
        }
        if joint.moves() {
            self.finite(axis, &["xyz"]);
        }
        Ok(())
    }

    fn limit(&mut self, joint: &Joint<'_>, part: &Part) -> Reading<()> {
        let part = part.inside("limit");
        let is_limited = matches!(joint.kind, "revolute" | "prismatic");
        let Some(limit) = self.only(joint.node, "limit")? else {
            if is_limited {
                self.effects.read_as(joint.node, part, Fault::MissingElement("limit"), "no limit");
            }
            return Ok(());
        };
        let reads_range = joint.kind != "continuous" || self.release == Release::Three;
        let mut range = [None; 2];
        if reads_range {
            range = [self.number(limit, "lower", &part)?, self.number(limit, "upper", &part)?];
        }
        let has_range = matches!(range, [Some(lower), Some(upper)] if lower < upper);
        match joint.kind {
            "spherical" if has_range && range[0] != Some(0.0) => {
                let why = "the lower limit of a spherical joint is not 0";
                self.effects.refuse_mendable(limit, Fault::Limits(why));
            }
            "continuous" if has_range => {
                let fault = Fault::Limits("a continuous joint is limited by `lower` and `upper`");
                self.effects.read_as(limit, &part, fault, "limited");
            }
            _ if is_limited && !has_range => {
                let fault = match range {
                    [None, _] => Fault::Missing("lower"),
                    [_, None] => Fault::Missing("upper"),
                    _ => Fault::Limits("`lower` is not below `upper`"),
                };
                self.effects.read_as(limit, &part, fault, "no limit");
            }
            _ => {}
        }
        self.effort(joint, limit, &part)?;
        self.effects.unread_attributes(limit, "velocity", &part);
        self.effects.unread_attributes(limit, FURTHER, &part);
        Ok(())
    }

    fn effort(&mut self, joint: &Joint<'_>, limit: Node<'_>, part: &Part) -> Reading<()> {
        let Some(effort) = self.number(limit, "effort", part)? else { return Ok(()) };
        let Some(value) = limit.attribute("effort") else { return Ok(()) };
        if matches!(joint.kind, "floating" | "spherical") {
            self.effects.unread(value, part.inside("effort"), "effort");
        } else if effort == 0.0 || effort.is_nan() {
            let fault = Fault::Way("an `effort` of 0 limits nothing");
            self.effects.read_as(value, part, fault, "no limit");
        } else if effort < 0.0 {
            let fault = Fault::range(value, "its sign does not count");
            self.effects.read_as(value, part, fault, (-effort).to_string());
        }
        Ok(())
    }

    /// Mimics, when all joints are known.
    pub fn mimics(&mut self, joints: &[Joint<'_>]) {
        let mut scalar: HashMap<&str, bool> = HashMap::new();
        for joint in joints.iter().filter(|joint| joint.moves()) {
            scalar.entry(joint.name).or_insert(joint.is_scalar());
        }
        for joint in joints.iter().filter(|joint| joint.moves()) {
            let part = Part::of("joint", joint.name);
            if self.release == Release::Three {
                self.effects.unread_elements(joint.node, "mimic", &part);
                continue;
            }
            let part = part.inside("mimic");
            let Ok(Some(mimic)) = self.only(joint.node, "mimic") else { continue };
            let leader = self.text(mimic, "joint");
            let _ = self.number(mimic, "multiplier", &part);
            let _ = self.number(mimic, "offset", &part);
            let Ok(leader) = leader else { continue };
            if !joint.is_scalar() {
                self.effects.drop(mimic, part, Fault::value("type", joint.kind));
            } else if leader == joint.name {
                self.effects.refuse_mendable(mimic, MIMICS_ITSELF);
            } else if scalar.get(leader) != Some(&true) {
                let fault = Fault::unknown("revolute, continuous or prismatic joint", leader);
                self.effects.drop(mimic, part, fault);
            }
        }
    }
}
