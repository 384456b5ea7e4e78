//! Writes what exports need as TOML, for a person to read and change.

use std::fmt::Write;

use super::{Members, Setup};
use crate::error::ExportError;
use crate::options::MjcfOptions;
use crate::structure::Structure;
use crate::yaml::{quoted, real};
use urdd_format::escape;
use urdd_robot::Robot;

const HEAD: &str = "\
# What exports need and the URDD does not say. `urdd export` reads this file where it lies beside the URDD.
# Lines that begin with \"Guess\" say why something was guessed. Change what is wrong; leave out what you do not need.
";

const BASE: &str = "\
# Whether the root link moves freely in the world. MJCF: a free joint. MoveIt: the virtual joint.
";

const GROUPS: &str = "
# Planning groups, for MoveIt: a chain from `base` to `tip`, or `joints`, or other `groups`.
# Of a group with `passive = true` nothing drives the joints.
";

const END_EFFECTORS: &str = "
# End effectors, for MoveIt: a group, and what carries it.
";

const FRAMES: &str = "
# Links whose frames have a meaning. `tools`: sites in MJCF; the first is what cuRobo plans for.
# `imus`: gyroscopes and accelerometers in MJCF, with `--sensors`.
";

const ACTUATORS: &str = "
# MJCF: gains are computed from the inertia that a joint moves, for this bandwidth, Hz. For a joint, `kp` (N m/rad or
# N/m), `kv` (N m s/rad or N s/m) and `armature` (kg m2 or kg) can be set.
[actuators]
";

const JOINT: &str = "\
# [actuators.joint.NAME]
# kp = 2000.0
# armature = 0.1
";

const LIMITS: &str = "
# Limits of joints for which the URDF has none: MoveIt, cuRobo. Without them, MoveIt's files have no limits of
# acceleration, and cuRobo's have its defaults. `acceleration` is in rad/s2 or m/s2, `jerk` in rad/s3 or m/s3.
[limits]
";

const CONTACT: &str = "
# The coefficient of friction of all shapes: MJCF, Drake, SDF. Without it, each program has its own.
[contact]
";

const CUROBO: &str = "
# cuRobo: the link that is planned for (otherwise the first tool), the named configuration to which plans retract
# (otherwise the default configuration), and joints that are locked (otherwise all that do not move `ee_link`).
[curobo]
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
        let mut text = format!("{HEAD}robot = {}\n\n[base]\n{BASE}", quoted(&structure.view.name));
        guess(&mut text, &self.floating.why);
        let _ = writeln!(text, "floating = {}", self.floating.value);
        text += GROUPS;
        for of in &self.groups {
            text += "\n[[group]]\n";
            guess(&mut text, &of.why);
            let _ = writeln!(text, "name = {}", quoted(&of.value.name));
            let _ = match &of.value.members {
                Members::Chain { base, tip } => {
                    writeln!(text, "base = {}\ntip = {}", link(*base), link(*tip))
                }
                Members::Joints(joints) => {
                    writeln!(text, "joints = {}", list(joints.iter().map(joint)))
                }
                Members::Groups(groups) => {
                    let groups = groups.iter().map(|place| group(*place));
                    writeln!(text, "groups = {}", list(groups))
                }
            };
            if of.value.passive {
                text += "passive = true\n";
            }
        }
        text += END_EFFECTORS;
        for end in &self.end_effectors {
            text += "\n[[end_effector]]\n";
            guess(&mut text, &end.why);
            let end = &end.value;
            let _ = writeln!(text, "name = {}\ngroup = {}", quoted(&end.name), group(end.group));
            if let Some(parent) = end.parent_group {
                let _ = writeln!(text, "parent_group = {}", group(parent));
            }
            let _ = writeln!(text, "parent_link = {}", link(end.parent_link));
        }
        let _ = writeln!(text, "{FRAMES}[frames]");
        for (key, of) in [("tools", &self.tools), ("imus", &self.imus)] {
            guess(&mut text, &of.why);
            let links = of.value.iter().map(|place| link(*place));
            let _ = writeln!(text, "{key} = {}", list(links));
        }
        text += ACTUATORS;
        let bandwidth = self.gains.bandwidth.unwrap_or(MjcfOptions::BANDWIDTH);
        entry(&mut text, "bandwidth", Some(real(bandwidth)), "");
        for (place, of) in &self.gains.joints {
            let _ = writeln!(text, "[actuators.joint.{}]", joint(place));
            for (key, value) in [("kp", of.kp), ("kv", of.kv), ("armature", of.armature)] {
                if value.is_some() {
                    entry(&mut text, key, value.map(real), "");
                }
            }
        }
        if self.gains.joints.is_empty() {
            text += JOINT;
        }
        text += LIMITS;
        entry(&mut text, "acceleration", self.acceleration.map(real), "5.0");
        entry(&mut text, "jerk", self.jerk.map(real), "100.0");
        text += CONTACT;
        entry(&mut text, "friction", self.friction.map(real), "0.8");
        text += CUROBO;
        let curobo = &self.curobo;
        entry(&mut text, "ee_link", curobo.ee_link.map(link), "\"NAME\"");
        entry(&mut text, "retract", curobo.retract.as_deref().map(quoted), "\"home\"");
        let locked = curobo.locked.iter();
        let locked: Vec<String> =
            locked.map(|(of, at)| format!("{} = {}", joint(of), real(*at))).collect();
        let locked = (!locked.is_empty()).then(|| format!("{{ {} }}", locked.join(", ")));
        entry(&mut text, "locked", locked, "{ finger = 0.04 }");
        Ok(text)
    }
}

/// A key with its value, or with an example as a comment.
fn entry(text: &mut String, key: &str, value: Option<String>, example: &str) {
    let _ = match value {
        Some(value) => writeln!(text, "{key} = {value}"),
        None => writeln!(text, "# {key} = {example}"),
    };
}

fn guess(text: &mut String, why: &str) {
    if !why.is_empty() {
        let _ = writeln!(text, "# Guess: {}.", escape::line(why));
    }
}

fn list(words: impl Iterator<Item = String>) -> String {
    let words: Vec<String> = words.collect();
    format!("[{}]", words.join(", "))
}
