use crate::reference::loops::Held;
use crate::rules::prelude::*;
use urdd_format::dof::Quantity;
use urdd_kinematics::ForwardKinematics;

declare_rule! {
    /// The number of independent DOFs is not the robot's mobility.
    ///
    /// So many DOFs can be set; the loops and couplings decide the others. With one too many, a program sets what cannot be
    /// set; with one too few, part of the robot hangs loose. The finding says how many there are at the reference
    /// configuration: the number of DOFs less the rank of what the loops hold. A loop may hold more than it needs (a planar
    /// four-bar of hinges does); that changes no rank.
    ///
    /// Count again; `urdd generate` does. Where the reference configuration is one in which the robot is stretched out, take
    /// another: there the rank is smaller than elsewhere.
    LOP009 "mobility-wrong", Error, clause "6.8.7", since "1.4.0",
    phase Kinematics, needs [
        ModuleV1(Kind::Loops), ModuleV1(Kind::Chain), ModuleV1(Kind::Dof), Passed(LOP005), Passed(LOP008), Passed(DOF006),
    ], check mobility_wrong,

    /// The other DOFs do not follow from the independent ones.
    ///
    /// The number is right, but the choice is not: a loop ties two of the independent DOFs to each other, and leaves another
    /// free. Setting the independent ones does not settle where the robot is.
    ///
    /// Take one of the two out, and put the free one in its place.
    LOP010 "independent-dofs-tied", Error, clause "6.8.7", since "1.4.0",
    phase Kinematics, needs [
        ModuleV1(Kind::Loops), ModuleV1(Kind::Chain), ModuleV1(Kind::Dof), Passed(LOP009),
    ], check independent_dofs_tied,
}

/// The least and greatest rank that may be counted; the same without the columns of the independent DOFs.
fn ranks(context: &Context, findings: &mut Findings) -> Option<[[usize; 2]; 2]> {
    let loops = document!(context, Loops)?;
    let dof = document!(context, Dof)?;
    let kinematics = ForwardKinematics::new(document!(context, Chain)?, dof);
    let kinematics = findings.or_skip(kinematics.map_err(SkipReason::obstacle))?;
    let reach = reach(context.robot()?, context.tree()?);
    let lengths: Vec<bool> = dof.dofs.iter().map(|dof| dof.quantity == Quantity::Length).collect();
    let reference = &loops.reference_configuration;
    let held = Held::new(loops, &kinematics, reference, &lengths, reach);
    let held = findings.or_skip(held.ok_or(skip::TOO_MANY_LOOPS))?;
    let independent: Vec<usize> = loops.independent_dof_idxs.iter().map(|idx| idx.get()).collect();
    Some(held.ranks(&independent))
}

fn mobility_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    let dofs = document!(context, Dof)?.dofs.len();
    let [[least, greatest], _] = ranks(context, findings)?;
    let stated = loops.independent_dof_idxs.len();
    if (least..=greatest).contains(&(dofs.saturating_sub(stated))) && stated <= dofs {
        return Some(());
    }
    let message = format!(
        "of {dofs} DOFs, loops and couplings tie {greatest} to others at the reference configuration"
    );
    finding_in(Kind::Loops, "/independent_dof_idxs", message)
        .counts(dofs - greatest, stated, "independent DOFs")
        .report(findings);
    Some(())
}

fn independent_dofs_tied(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    let dofs = document!(context, Dof)?.dofs.len();
    let [_, [_, greatest]] = ranks(context, findings)?;
    // What LOP009 accepted.
    let rank = dofs - loops.independent_dof_idxs.len();
    if greatest >= rank {
        return Some(());
    }
    let message = format!(
        "{rank} DOFs are to follow from the independent ones, but only {greatest} of them do: {} of the independent ones are tied to others of them",
        rank - greatest
    );
    finding_in(Kind::Loops, "/independent_dof_idxs", message)
        .counts(rank, greatest, "DOFs that follow")
        .report(findings);
    Some(())
}
