//! DOF: `dof_module`.

use crate::rules::prelude::*;
use urdd_document::dof_layout::describe;

declare_rule! {
    /// `num_dofs` and the lists that hold one entry per DOF do not agree on the number of DOFs.
    ///
    /// `num_dofs` is the length of a configuration. Programs allocate by it and index the lists with
    /// it: where one of them has another length, they crash, or read the wrong joint.
    ///
    /// Make `num_dofs`, the length of `dof_idx_to_joint_idx_mapping` and (from version 1 on) the
    /// length of `dofs` equal. Most often one of them was edited by hand, or was written before
    /// mimic joints were left out.
    DOF001 "dof-count-differs", Error, clause "6.2.1", since "0.1.0",
    phase References, needs [Module(Kind::Dof)], check dof_count_differs,

    /// A list of `dof_module` that is indexed by joint does not hold one entry per joint.
    ///
    /// Programs look up `joint_idx_to_dof_idxs_mapping[joint]` and `joint_idx_to_mimic_mapping[joint]`
    /// with the joint indices of `urdf_module`. With too few or too many entries, every joint after
    /// the gap moves with the wrong DOF.
    ///
    /// Write one entry for every joint, in joint order: fixed joints have the entries `[]` and null.
    /// If `urdf_module` has changed since, write `dof_module` again.
    DOF002 "joint-lists-length", Error, clause "6.2.1", since "0.1.0",
    phase References, needs [Module(Kind::Dof), ROBOT_SOUND], check joint_lists_length,

    /// A joint has another number of DOFs than its type gives it.
    ///
    /// Revolute, continuous and prismatic joints have one DOF, planar and spherical ones three,
    /// floating ones six, fixed ones none; a mimic joint follows another joint and has none of its
    /// own (in `dof_module` 0.0.1 it has). With a DOF too many or too few, every configuration has
    /// the wrong length.
    ///
    /// Correct `joint_idx_to_dof_idxs_mapping`, and with it everything that is indexed by DOF. If the
    /// joint's type or mimic has changed in `urdf_module`, write `dof_module` and what depends on it
    /// again.
    DOF004 "joint-dof-count-wrong", Error, clause "6.2.2", since "0.1.0",
    phase References, needs [Passed(URD009), Passed(DOF002)], check joint_dof_count_wrong,

    /// `dof_idx_to_joint_idx_mapping` and `joint_idx_to_dof_idxs_mapping` are not each other's inverse.
    ///
    /// One says which joint a DOF moves, the other which DOFs a joint has. Where they disagree, a
    /// program that goes from joints to DOFs and one that goes from DOFs to joints move different
    /// joints with the same configuration.
    ///
    /// Write one of the two from the other. The findings are where a mapping differs from what follows
    /// from `urdf_module`: DOFs in joint order.
    DOF003 "dof-mappings-disagree", Error, clause "6.2.3", since "0.1.0",
    phase References, needs [Passed(DOF001), Passed(DOF004)], check dof_mappings_disagree,

    /// DOFs do not stand in joint order.
    ///
    /// The order of a configuration is part of the format: DOFs in the order of their joints, and
    /// those of one joint in the order that SPEC gives for its type. Stored configurations, bounds
    /// and samples of another order are silently those of another robot.
    ///
    /// Number the DOFs anew, going through the joints in joint order, and bring everything that is
    /// indexed by DOF in the same order.
    DOF005 "dofs-out-of-order", Error, clause "6.2.4", since "0.1.0",
    phase References, needs [Passed(DOF003)], check dofs_out_of_order,

    /// An entry of `dofs` does not describe its DOF.
    ///
    /// `dofs[i]` says to people and programs what number i of a configuration is: its joint, its name
    /// (the joint's name, and for joints of several DOFs what SPEC 6.2.5 puts behind it), and whether
    /// it is an angle in radians or a length in metres. A user interface that labels its sliders by a
    /// wrong entry moves another joint than it says.
    ///
    /// Write `dofs` from `dof_idx_to_joint_idx_mapping` and the joints of `urdf_module`.
    DOF006 "dof-misdescribed", Error, clause "6.2.5", since "0.1.0",
    phase References, needs [Version1, Passed(DOF005), ModuleV1(Kind::Dof)], check dof_misdescribed,

    /// A mimic joint is resolved to the wrong DOF, factor or offset.
    ///
    /// Programs place a mimic joint at `multiplier * q[dof_idx] + offset` and never look at the URDF
    /// again. SPEC 5.10 says how to compute them when a mimic names another mimic: multiply the
    /// factors, carry the offsets. Common mistakes are to name the next joint instead of the last one,
    /// to add offsets without their factors, and to write an entry for a joint that follows nothing.
    ///
    /// Resolve the mimics of `urdf_module` again. Joints that are fixed or have no mimic get null;
    /// where a chain of mimics ends in a fixed joint, `dof_idx` is null and the joint's position is
    /// `offset`.
    DOF007 "mimic-resolved-wrong", Error, clause "6.2.6", since "0.1.0",
    phase References, needs [Version1, Passed(URD012), Passed(DOF005), ModuleV1(Kind::Dof)], check mimic_resolved_wrong,
}

fn dof_count_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let dofs = context.dofs()?;
    let mut counts = vec![
        ("num_dofs", dofs.num_dofs.get()),
        ("dof_idx_to_joint_idx_mapping", dofs.dof_idx_to_joint_idx_mapping.len()),
    ];
    if let Some(v1) = document!(context, Dof) {
        counts.push(("dofs", v1.dofs.len()));
    }
    if let Some((name, count, others)) = odd_one(&counts) {
        let all = counts.iter().map(|(name, count)| format!("`{name}` {count}"));
        let message = format!(
            "the number of DOFs differs from place to place: {}; make them agree",
            all.collect::<Vec<_>>().join(", ")
        );
        finding_in(Kind::Dof, format!("/{name}"), message)
            .values(format!("{others} DOFs"), format!("{count} DOFs"))
            .report(findings);
    }
    Some(())
}

/// The name and value of the count that differs from the others (the first if no two agree), and the others' value.
/// `None` if all agree.
pub fn odd_one<'a>(counts: &[(&'a str, usize)]) -> Option<(&'a str, usize, usize)> {
    let first = counts.first()?;
    if counts.iter().all(|(_, count)| *count == first.1) {
        return None;
    }
    let alone = |candidate: &(&str, usize)| {
        let mut others = counts.iter().filter(|(name, _)| *name != candidate.0);
        let count = others.next().map(|(_, count)| *count)?;
        (count != candidate.1 && others.all(|(_, other)| *other == count)).then_some(count)
    };
    counts
        .iter()
        .find_map(|candidate| Some((candidate.0, candidate.1, alone(candidate)?)))
        .or_else(|| Some((first.0, first.1, counts.get(1)?.1)))
}

fn joint_lists_length(context: &Context, findings: &mut Findings) -> Option<()> {
    let joints = context.robot()?.joints.len();
    let dofs = context.dofs()?;
    let mut lists =
        vec![("joint_idx_to_dof_idxs_mapping", dofs.joint_idx_to_dof_idxs_mapping.len())];
    if let Some(v1) = document!(context, Dof) {
        let mimics = v1.joint_idx_to_mimic_mapping.len();
        lists.push(("joint_idx_to_mimic_mapping", mimics));
    }
    if let Some(wrong) = wrong_lengths(&lists, joints) {
        let all = wrong.in_words;
        let message = format!("one entry per joint of urdf_module is needed: {all}");
        finding_in(Kind::Dof, wrong.pointer, message)
            .counts(joints, wrong.length, "entries")
            .report(findings);
    }
    Some(())
}

fn joint_dof_count_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let layout = context.dof_layout()?;
    let dofs = context.dofs()?;
    let joints = robot.joints.iter().zip(&layout.dofs_of_joint);
    for (index, ((joint, right), list)) in
        joints.zip(&dofs.joint_idx_to_dof_idxs_mapping).enumerate()
    {
        if list.len() == right.len() {
            continue;
        }
        let kind = match &joint.mimic {
            Some(mimic) if right.is_empty() => format!("a mimic of {:?}", mimic.joint),
            _ => format!("a {} joint", joint.joint_type),
        };
        let (name, right) = (&joint.name, count(right.len()));
        let pointer = format!("/joint_idx_to_dof_idxs_mapping/{index}");
        let message = format!("joint {index} ({name:?}) is {kind} and has {right} of its own");
        finding_in(Kind::Dof, pointer, message).values(right, count(list.len())).report(findings);
    }
    Some(())
}

fn count(dofs: usize) -> String {
    match dofs {
        0 => "no DOF".to_owned(),
        1 => "1 DOF".to_owned(),
        _ => format!("{dofs} DOFs"),
    }
}

fn dof_mappings_disagree(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let layout = context.dof_layout()?;
    let dofs = context.dofs()?;
    let joint_of_dof: Vec<usize> =
        dofs.dof_idx_to_joint_idx_mapping.iter().map(|joint| joint.get()).collect();
    let dofs_of_joint =
        dofs.joint_idx_to_dof_idxs_mapping.iter().map(|list| list.iter().map(|dof| dof.get()));
    if are_inverse(&joint_of_dof, dofs_of_joint.clone()) {
        return Some(());
    }
    let name = |joint: usize| match robot.joints.get(joint) {
        Some(joint) => format!("{:?}", joint.name),
        None => "no joint".to_owned(),
    };
    for ((joint, list), right) in dofs_of_joint.enumerate().zip(&layout.dofs_of_joint) {
        for ((place, dof), right) in list.enumerate().zip(right.clone()) {
            if dof != right {
                let pointer = format!("/joint_idx_to_dof_idxs_mapping/{joint}/{place}");
                let message = format!(
                    "the mappings disagree: joint {joint} ({}) is said to have DOF {dof}",
                    name(joint)
                );
                finding_in(Kind::Dof, pointer, message).values(right, dof).report(findings);
            }
        }
    }
    let all = layout.joint_of_dof.len();
    for (dof, joint) in joint_of_dof.iter().copied().enumerate() {
        let right = layout.joint_of_dof.get(dof).copied();
        if right != Some(joint) {
            let pointer = format!("/dof_idx_to_joint_idx_mapping/{dof}");
            let message = format!(
                "the mappings disagree: DOF {dof} is said to move joint {joint} ({})",
                name(joint)
            );
            let right = right.map_or(format!("{all} DOFs in all"), |right| right.to_string());
            finding_in(Kind::Dof, pointer, message).values(right, joint).report(findings);
        }
    }
    if findings.is_empty() {
        let message = "joints have DOFs that are not listed here; list every DOF";
        finding_in(Kind::Dof, "/dof_idx_to_joint_idx_mapping", message)
            .counts(all, joint_of_dof.len(), "entries")
            .report(findings);
    }
    Some(())
}

/// Whether every DOF is listed exactly once, by the joint that it moves.
pub fn are_inverse(
    joint_of_dof: &[usize],
    dofs_of_joint: impl Iterator<Item = impl Iterator<Item = usize>>,
) -> bool {
    let mut listed = vec![false; joint_of_dof.len()];
    for (joint, list) in dofs_of_joint.enumerate() {
        for dof in list {
            match (joint_of_dof.get(dof), listed.get_mut(dof)) {
                (Some(moved), Some(listed)) if *moved == joint && !*listed => *listed = true,
                _ => return false,
            }
        }
    }
    listed.into_iter().all(|listed| listed)
}

fn dofs_out_of_order(context: &Context, findings: &mut Findings) -> Option<()> {
    let dofs = context.dofs()?;
    let joints = dofs.dof_idx_to_joint_idx_mapping.iter();
    for (dof, (before, after)) in (1..).zip(joints.clone().zip(joints.skip(1))) {
        if after < before {
            let pointer = format!("/dof_idx_to_joint_idx_mapping/{dof}");
            let message = format!(
                "DOF {dof} moves joint {after}, but the DOF before it moves joint {before}: number the DOFs in joint order"
            );
            finding_in(Kind::Dof, pointer, message)
                .values(format!("joint {before} or later"), format!("joint {after}"))
                .report(findings);
        }
    }
    // Swapped DOFs of different joints are wrong in these lists too.
    if !findings.is_empty() {
        return Some(());
    }
    for (joint, list) in dofs.joint_idx_to_dof_idxs_mapping.iter().enumerate() {
        if !list.is_sorted() {
            let written: Vec<usize> = list.iter().map(|dof| dof.get()).collect();
            let mut right = written.clone();
            right.sort_unstable();
            let pointer = format!("/joint_idx_to_dof_idxs_mapping/{joint}");
            let message = format!("the DOFs of joint {joint} are not in ascending order");
            finding_in(Kind::Dof, pointer, message).literals(&right, &written).report(findings);
        }
    }
    Some(())
}

fn dof_misdescribed(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let layout = context.dof_layout()?;
    let dofs = document!(context, Dof)?;
    for (index, dof) in dofs.dofs.iter().enumerate() {
        let (joint_idx, place) = layout.place(index)?;
        let joint = robot.joints.get(joint_idx)?;
        let (suffix, quantity) = describe(joint.joint_type, place)?;
        let mut expect = |key: &str, right: String, written: String| {
            if right != written {
                let pointer = format!("/dofs/{index}/{key}");
                let message =
                    format!("this does not describe DOF {index}, which moves joint {joint_idx}");
                finding_in(Kind::Dof, pointer, message).values(right, written).report(findings);
            }
        };
        let quoted = |name: &str| format!("{name:?}");
        expect("joint_idx", joint_idx.to_string(), dof.joint_idx.to_string());
        expect("joint_name", quoted(&joint.name), quoted(&dof.joint_name));
        let name = format!("{}{suffix}", joint.name);
        expect("name", quoted(&name), quoted(&dof.name));
        expect("quantity", quantity.to_string(), dof.quantity.to_string());
    }
    Some(())
}

fn mimic_resolved_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let mimics = context.mimics()?;
    let layout = context.dof_layout()?;
    let dofs = document!(context, Dof)?;
    let joints = robot.joints.iter().zip(&mimics.by_joint);
    let written = dofs.joint_idx_to_mimic_mapping.iter();
    for (index, ((joint, right), written)) in joints.zip(written).enumerate() {
        let pointer = format!("/joint_idx_to_mimic_mapping/{index}");
        let joint = format!("joint {index} ({:?})", joint.name);
        let (right, written) = match (right, written) {
            (Some(right), Some(written)) => (right, written),
            (None, None) => continue,
            (right, _) => {
                let (message, expected, actual) = match right {
                    None => ("follows no other joint; write null", "null", "a mimic"),
                    Some(_) => ("is a mimic joint; write what it follows", "a mimic", "null"),
                };
                let finding = finding_in(Kind::Dof, pointer, format!("{joint} {message}"));
                findings.report(finding.values(expected, actual));
                continue;
            }
        };
        let driver = layout.dofs_of_joint.get(right.driver).cloned();
        let dof = driver.and_then(|mut dofs| dofs.next());
        let written_dof = written.dof_idx.map(|dof| dof.get());
        if dof != written_dof {
            let message = format!(
                "{joint} follows joint {} ({:?}) through its mimics, and this is not that joint's DOF",
                right.driver,
                robot.joints.get(right.driver)?.name
            );
            finding_in(Kind::Dof, format!("{pointer}/dof_idx"), message)
                .values(or_null(dof), or_null(written_dof))
                .report(findings);
        }
        for (key, right, written) in [
            ("multiplier", right.multiplier, written.multiplier),
            ("offset", right.offset, written.offset),
        ] {
            if !numbers_agree(right, written) {
                let message =
                    format!("this is not the {key} with which {joint} follows its driver");
                finding_in(Kind::Dof, format!("{pointer}/{key}"), message)
                    .numbers(right, written, number_tolerance(right, written))
                    .report(findings);
            }
        }
    }
    Some(())
}
