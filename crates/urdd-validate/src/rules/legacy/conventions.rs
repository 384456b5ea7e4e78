use crate::rules::bounds::unlimited::{LEGACY_WIDENING, limited_dofs};
use crate::rules::prelude::*;
use crate::views::shared_meshes;
use urdd_document::paths::Place;

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
        Place::Sibling { folder, .. } => Some(folder),
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
