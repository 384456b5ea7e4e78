//! LEG: conventions of URDDs that were published before version 1.

use crate::rules::bounds::{LEGACY_WIDENING, limited_dofs};
use crate::rules::prelude::*;
use crate::views::shared_meshes;
use urdd_format::legacy::composition::AdjustedRobotModule;

declare_rule! {
    /// The URDD is from before version 1, and has no `urdd.json`.
    ///
    /// That was usual then. Nothing says what the URDD was made from, which of its files
    /// belong together, or whether one was changed; it is checked by the rules that apply to it.
    ///
    /// Nothing needs to be done. For a URDD of version 1, write it again from its URDF.
    LEG001 "legacy-without-root-metadata", Info, clause "10.2", since "0.1.0",
    phase Files, needs [Legacy], check without_root_metadata,

    /// Mesh paths begin with a robot's folder name and are relative to the folder above the URDD.
    ///
    /// That was usual before version 1. Such a URDD cannot be renamed; and one whose paths lead
    /// into another URDD, as those of composed robots do, works only beside that one.
    ///
    /// Keep the folder's name, and keep the URDDs together that belong together. In version 1 paths
    /// are relative to the URDD's own root.
    LEG002 "parent-relative-paths", Info, clause "10.2", since "0.1.0",
    phase References, needs [Legacy], check parent_relative_paths,

    /// The folder of a URDD from before version 1 does not have its robot's name.
    ///
    /// Programs of that time find a robot by its folder's name, and mesh paths begin with it. A program
    /// that uses the name in the URDF looks in the wrong place. This is so in many published URDDs.
    ///
    /// Use the folder's name, not the robot's. In version 1 the folder may have any name, and
    /// `robot_name` of `urdd.json` says the robot's.
    LEG003 "folder-name-differs", Info, clause "10.2", since "0.1.0",
    phase References, needs [Legacy, Module(Kind::Urdf)], check folder_name_differs,

    /// The upper bound of a joint whose two limits are equal was raised by 1e-7.
    ///
    /// Published modules never have equal bounds. The joint stays locked for every purpose, but a program
    /// that looks for lower = upper does not see it. (Where published modules could not distinguish absent limits
    /// from zeros, the joint may also have no limits and be frozen by mistake: look into its URDF.)
    ///
    /// Nothing needs to be done. From version 1 on, a locked joint has equal bounds.
    LEG006 "locked-bound-widened", Info, clause "10.3", since "0.1.0",
    phase References, needs [Legacy, Passed(DOF005), Passed(BND002)], check locked_bound_widened,

    /// Links share one derived mesh file.
    ///
    /// The first producer named derived files after the mesh that they came from, so that links with
    /// one mesh name had one file, and the last of them overwrote it. Here these links place the mesh
    /// in the same way, and the file is right for all of them. Where they do not, MSH005 reports it.
    ///
    /// Nothing needs to be done now. When one of these links gets another visual origin or scale, the
    /// meshes of the others become wrong without notice. In version 1 each link has its own file.
    LEG007 "mesh-file-shared-alike", Info, clause "10.6", since "0.1.0",
    phase References, needs [Legacy, Module(Kind::Urdf), NotFailed(MSH001), NotFailed(MSH003)],
    check mesh_file_shared_alike,

    /// The index mappings of `adjusted_robot_module` do not agree with each other, or with the two robots.
    ///
    /// The mappings carry what was computed for the base robot (meshes, shapes, a person's edits) over
    /// to the robot that was cut out of it. A wrong index gives a link the shape of another.
    ///
    /// `adjusted_…_to_base_…` has one entry for each link (joint) of this robot, `base_…_to_adjusted_…`
    /// one for each of the base robot: those that are kept, and those that are listed as deleted, which
    /// have null. Each is the inverse of the other.
    LEG004 "adjusted-mappings-wrong", Error, clause "10.4", since "0.1.0",
    phase References, needs [Legacy, Module(Kind::Urdf)], check adjusted_mappings_wrong,
}

fn without_root_metadata(_: &Context, findings: &mut Findings) -> Option<()> {
    let message = "this URDD is from before version 1: it has no urdd.json, and is checked by the rules for that format";
    Finding::in_directory(message).report(findings);
    Some(())
}

fn parent_relative_paths(context: &Context, findings: &mut Findings) -> Option<()> {
    let paths = paths::all(context);
    let paths: Vec<_> = paths.iter().filter(|path| path.from_parent()).collect();
    let Some(first) = paths.first() else { return Some(()) };
    let siblings = paths.iter().filter_map(|path| match path.place(context) {
        paths::Place::Sibling { folder, .. } => Some(folder),
        _ => None,
    });
    let siblings: BTreeSet<&str> = siblings.collect();
    let count = paths.len();
    let message = if siblings.is_empty() {
        format!("{count} mesh paths begin with the folder's own name: do not rename the folder")
    } else {
        let mut names: Vec<&str> = siblings.iter().copied().take(5).collect();
        if siblings.len() > names.len() {
            names.push("and others");
        }
        format!(
            "some of {count} mesh paths lead into other folders beside this one: keep it beside {}, under these names",
            names.join(", ")
        )
    };
    let finding = Finding::at(first.file(), &first.pointer, message);
    findings.report(finding.actual(format!("{:?}", first.path)));
    Some(())
}

fn folder_name_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    // With the robot of the carried URDF, urdf_module may be missing.
    let Some(module) = context.module(Kind::Urdf) else { return Some(()) };
    let folder = context.root().folder_name();
    if folder != robot.name {
        let message = "the robot's name differs from that of its folder, which mesh paths use";
        finding_in(module, "/name", message)
            .values(format!("{folder:?} (the folder)"), format!("{:?}", robot.name))
            .report(findings);
    }
    Some(())
}

fn locked_bound_widened(context: &Context, findings: &mut Findings) -> Option<()> {
    for limited in limited_dofs(context)? {
        let ([lower, upper], [_, written]) = (limited.limits, limited.bounds);
        let raised = upper + LEGACY_WIDENING;
        if lower == upper && !numbers_agree(upper, written) && numbers_agree(raised, written) {
            let message = format!(
                "joint {:?} is locked at {upper:?}; its upper bound was raised by {LEGACY_WIDENING:?}",
                limited.joint.name
            );
            finding_in(Kind::Bounds, format!("/bounds/{}/1", limited.dof), message)
                .literals(upper, written)
                .report(findings);
        }
    }
    Some(())
}

fn mesh_file_shared_alike(context: &Context, findings: &mut Findings) -> Option<()> {
    let mut shared = shared_meshes::all(context);
    shared.retain(|shared| shared.alike);
    let pairs = shared.iter().flat_map(|shared| [shared.first.0, shared.other.0]);
    let links: BTreeSet<usize> = pairs.collect();
    if let Some(first) = shared.first() {
        let message = format!(
            "{} links share derived mesh files with others that place the same mesh in the same way: correct as it is, but wrong once one of them is placed differently",
            links.len()
        );
        let (a, b) = (first.first.0, first.other.0);
        let (a, b) = (context.link_label(a), context.link_label(b));
        let file = format!("{}/module.json", first.kind.folder());
        let finding = Finding::at(file, &first.other.1, message);
        findings.report(finding.actual(format!("`{}`, of {a} and {b}", first.path)));
    }
    Some(())
}

fn adjusted_mappings_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
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
