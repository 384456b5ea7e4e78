use crate::rules::prelude::*;
use urdd_format::legacy::composition::AdjustedRobotModule;

declare_rule! {
    /// The index mappings of `adjusted_robot_module` do not agree with each other, or with the two robots.
    ///
    /// The mappings carry what was computed for the base robot (meshes, shapes, a person's edits) over
    /// to the robot that was cut out of it. A wrong index gives a link the shape of another.
    ///
    /// `adjusted_…_to_base_…` has one entry for each link (joint) of this robot, `base_…_to_adjusted_…`
    /// one for each of the base robot: those that are kept, and those that are listed as deleted, which
    /// have null. Each is the inverse of the other.
    LEG004 "adjusted-mappings-wrong", Error, clause "10.4", since "0.1.0",
    phase References, needs [Legacy, Module(Kind::Urdf)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    for (_, module, document) in context.documents(&[Kind::AdjustedRobot]) {
        let ModuleDocument::LegacyAdjustedRobot(adjusted) = document else { continue };
        for mapping in mappings(adjusted, robot.links.len(), robot.joints.len()) {
            mapping.check(&module.file("module.json"), findings);
        }
    }
    Some(())
}

/// The mappings of links, or those of joints.
pub struct Mapping {
    pub what: &'static str,
    pub to_base: Vec<usize>,
    pub to_adjusted: Vec<Option<usize>>,
    pub kept: usize,
    pub deleted: usize,
}

fn mappings(adjusted: &AdjustedRobotModule, links: usize, joints: usize) -> [Mapping; 2] {
    let to_base = &adjusted.adjusted_link_idx_to_base_link_idx_mapping;
    let to_adjusted = &adjusted.base_link_idx_to_adjusted_link_idx_mapping;
    let of_links = Mapping {
        what: "link",
        to_base: to_base.iter().map(|link| link.get()).collect(),
        to_adjusted: to_adjusted.iter().map(|l| l.map(|l| l.get())).collect(),
        kept: links,
        deleted: adjusted.deleted_base_links.len(),
    };
    let to_base = &adjusted.adjusted_joint_idx_to_base_joint_idx_mapping;
    let to_adjusted = &adjusted.base_joint_idx_to_adjusted_joint_idx_mapping;
    let of_joints = Mapping {
        what: "joint",
        to_base: to_base.iter().map(|joint| joint.get()).collect(),
        to_adjusted: to_adjusted.iter().map(|j| j.map(|j| j.get())).collect(),
        kept: joints,
        deleted: adjusted.deleted_base_joints.len(),
    };
    [of_links, of_joints]
}

impl Mapping {
    pub fn check(&self, file: &str, findings: &mut Findings) {
        let what = self.what;
        let down = format!("adjusted_{what}_idx_to_base_{what}_idx_mapping");
        let up = format!("base_{what}_idx_to_adjusted_{what}_idx_mapping");
        let base = self.kept + self.deleted;
        let deleted = self.deleted;
        let of_base = format!("the base robot has, counting those deleted ({deleted})");
        for (name, right, written, why) in [
            (&down, self.kept, self.to_base.len(), "this robot has"),
            (&up, base, self.to_adjusted.len(), of_base.as_str()),
        ] {
            if right != written {
                let message = format!("one entry is needed for each {what} that {why}");
                Finding::at(file, format!("/{name}"), message)
                    .counts(right, written, "entries")
                    .report(findings);
                return;
            }
        }
        for (adjusted, base) in self.to_base.iter().copied().enumerate() {
            let back = self.to_adjusted.get(base).copied();
            if back != Some(Some(adjusted)) {
                let there = match back {
                    Some(Some(other)) => format!("{what} {other}"),
                    Some(None) => "null".to_owned(),
                    None => "no such entry".to_owned(),
                };
                let message =
                    format!("`{up}` does not lead from {what} {base} back to {what} {adjusted}");
                Finding::at(file, format!("/{down}/{adjusted}"), message)
                    .values(format!("{what} {adjusted} at /{up}/{base}"), there)
                    .report(findings);
            }
        }
        if !findings.is_empty() {
            return;
        }
        for (base, adjusted) in self.to_adjusted.iter().copied().enumerate() {
            if let Some(adjusted) = adjusted
                && self.to_base.get(adjusted) != Some(&base)
            {
                let message =
                    format!("`{down}` does not lead from {what} {adjusted} back to {what} {base}");
                Finding::at(file, format!("/{up}/{base}"), message)
                    .values("null", format!("{what} {adjusted}"))
                    .report(findings);
            }
        }
    }
}
