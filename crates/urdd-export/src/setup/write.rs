//! Writes what exports need as TOML, for a person to read and change.

use std::fmt::Write;

use super::{Guess, Members, Setup, USUAL_BANDWIDTH};
use crate::output::fill;
use crate::yaml::{quoted, real};
use crate::{ExportError, Structure};
use urdd_directory::export_toml::ActuatorKind;
use urdd_format::escape;
use urdd_robot::Robot;

const FILE: &str = include_str!("export.toml.in");

/// Examples of what can be set for a joint.
const JOINT: &str = "\
# [actuators.joint.NAME]
# kp = 2000.0
# armature = 0.1
";

impl Setup {
    /// The text of the file, with a reason for each guess. What is not set is there as a comment.
    ///
    /// # Errors
    /// If the description of the robot is missing or unusable, or the setup is that of another robot.
    pub fn to_toml(&self, robot: &Robot) -> Result<String, ExportError> {
        let structure = Structure::new(robot)?;
        structure.check(&self.of)?;
        let links = &structure.view.links;
        let link = |link: usize| quoted(&links[link].name);
        let joint = |joint: &usize| quoted(&structure.view.joints[*joint].name);
        let group = |group: usize| quoted(&self.groups[group].value.name);
        let names = |joints: &[usize]| list(joints.iter().map(joint));
        let mut groups = String::new();
        for Guess { value: of, why } in &self.groups {
            let _ = write!(groups, "\n[[group]]\n{}name = {}\n", guess(why), quoted(&of.name));
            let _ = match &of.members {
                Members::Chain { base, tip } => {
                    writeln!(groups, "base = {}\ntip = {}", link(*base), link(*tip))
                }
                Members::Joints(joints) => writeln!(groups, "joints = {}", names(joints)),
                Members::Groups(others) => {
                    writeln!(groups, "groups = {}", list(others.iter().map(|place| group(*place))))
                }
            };
            if of.passive {
                groups += "passive = true\n";
            }
        }
        let mut ends = String::new();
        for Guess { value: end, why } in &self.end_effectors {
            let _ = write!(ends, "\n[[end_effector]]\n{}", guess(why));
            let _ = writeln!(ends, "name = {}\ngroup = {}", quoted(&end.name), group(end.group));
            if let Some(parent) = end.parent_group {
                let _ = writeln!(ends, "parent_group = {}", group(parent));
            }
            let _ = writeln!(ends, "parent_link = {}", link(end.parent_link));
        }
        let frames = [("tools", &self.tools), ("imus", &self.imus)].map(|(key, of)| {
            let links = of.value.iter().map(|place| link(*place));
            format!("{}{key} = {}\n", guess(&of.why), list(links))
        });
        let mut joints = String::new();
        for (place, of) in &self.gains.joints {
            let _ = writeln!(joints, "[actuators.joint.{}]", joint(place));
            let words = [("name", of.name.as_deref()), ("kind", of.kind.map(ActuatorKind::word))];
            for (key, word) in words {
                joints.extend(word.map(|word| format!("{key} = {}\n", quoted(word))));
            }
            for (key, value) in [("kp", of.kp), ("kv", of.kv), ("armature", of.armature)] {
                joints.extend(value.map(|value| format!("{key} = {}\n", real(value))));
            }
            for (key, ends) in [("ctrlrange", of.ctrlrange), ("forcerange", of.forcerange)] {
                let text = |[least, most]: [f64; 2]| {
                    format!("{key} = [{}, {}]\n", real(least), real(most))
                };
                joints.extend(ends.map(text));
            }
        }
        let curobo = &self.curobo;
        let locked: Vec<String> =
            curobo.locked.iter().map(|(of, at)| format!("{} = {}", joint(of), real(*at))).collect();
        let locked = (!locked.is_empty()).then(|| format!("{{ {} }}", locked.join(", ")));
        let bandwidth = self.gains.bandwidth.unwrap_or(USUAL_BANDWIDTH);
        let mut floating =
            format!("{}floating = {}", guess(&self.floating.why), self.floating.value);
        for (name, pose) in &self.base_poses {
            let _ =
                write!(floating, "\nposes.{} = {}", quoted(name), list(pose.map(real).into_iter()));
        }
        let retract = curobo.retract.as_deref().map(quoted);
        let values = [
            ("ROBOT", quoted(&structure.view.name)),
            ("FLOATING", floating),
            ("GROUPS", groups),
            ("END_EFFECTORS", ends),
            ("FRAMES", frames.concat()),
            ("BANDWIDTH", entry("bandwidth", Some(real(bandwidth)), "")),
            ("JOINTS", if joints.is_empty() { JOINT.to_owned() } else { joints }),
            ("ACCELERATION", entry("acceleration", self.acceleration.map(real), "5.0")),
            ("JERK", entry("jerk", self.jerk.map(real), "100.0")),
            ("FRICTION", entry("friction", self.friction.map(real), "0.8")),
            ("EE_LINK", entry("ee_link", curobo.ee_link.map(link), "\"NAME\"")),
            ("RETRACT", entry("retract", retract, "\"home\"")),
            ("LOCKED", entry("locked", locked, "{ finger = 0.04 }")),
        ];
        Ok(fill(FILE, &values))
    }
}

/// A key with its value, or with an example as a comment.
fn entry(key: &str, value: Option<String>, example: &str) -> String {
    match value {
        Some(value) => format!("{key} = {value}"),
        None => format!("# {key} = {example}"),
    }
}

fn guess(why: &str) -> String {
    match why {
        "" => String::new(),
        why => format!("# Guess: {}.\n", escape::line(why)),
    }
}

fn list(words: impl Iterator<Item = String>) -> String {
    format!("[{}]", words.collect::<Vec<_>>().join(", "))
}
