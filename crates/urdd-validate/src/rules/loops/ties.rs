use crate::rules::chain::joints::report_not_canonical;
use crate::rules::prelude::*;
use crate::rules::urdf::tree::repeated;
use urdd_format::index::DofIdx;

declare_rule! {
    /// A loop connects a link that is not there, or a link with itself.
    ///
    /// A loop is what holds two links together besides the joints of the tree. Most often a link was removed, or links stand
    /// in another order than when the loops were written.
    ///
    /// Write the indices of two different links of `urdf_module`.
    LOP001 "loop-link-wrong", Error, clause "6.8.2", since "1.4.0",
    phase References, needs [ModuleV1(Kind::Loops), Module(Kind::Urdf)], check loop_link_wrong,

    /// Two loops or couplings have the same name.
    ///
    /// A program that asks for a loop by its name gets one of the two.
    ///
    /// Give each loop and each coupling a name of its own.
    LOP002 "loop-name-repeated", Error, clause "6.8.2", since "1.4.0",
    phase References, needs [ModuleV1(Kind::Loops)], check loop_name_repeated,

    /// The quaternion of a loop's frame is not of length 1, or is the negative of the one to write.
    ///
    /// Most programs take a quaternion to be a unit one without looking: any other scales the frame.
    ///
    /// Divide the quaternion by its length. Then negate it if w is negative, or if w is 0 and the first of
    /// x, y, z that is not 0 is negative.
    LOP003 "loop-quaternion-not-canonical", Error, clause "6.8.2", since "1.4.0",
    phase References, consequence Format, needs [ModuleV1(Kind::Loops)], check loop_quaternion_not_canonical,

    /// A tolerance of a loop is negative.
    ///
    /// It says how far the loop may be open where it counts as closed. Below 0, no configuration is closed.
    ///
    /// Write 0 where the loop closes exactly, or how far apart its ends stay.
    LOP011 "loop-tolerance-negative", Error, clause "6.8.4", since "1.4.0",
    phase References, needs [ModuleV1(Kind::Loops)], check loop_tolerance_negative,

    /// A loop closes only loosely: a tolerance is more than a millionth of the robot's reach, or than 1e-6 rad.
    ///
    /// Its ends never meet. Most often numbers of the source were rounded: `1.5708` in place of pi / 2 turns a frame by 4e-6
    /// rad, and a loop of four parallel hinges has nothing that could make up for it. A simulator then pulls at the loop
    /// without end.
    ///
    /// Write the numbers of the source with more digits, or hold less: a ball in place of one of four hinges.
    LOP012 "loop-closes-loosely", Warning, clause "6.8.4", since "1.4.0",
    phase References, needs [ModuleV1(Kind::Loops), Module(Kind::Urdf), ROBOT_SOUND, NotFailed(LOP011)],
    check loop_closes_loosely,

    /// A coupling has no terms, or one of a DOF that is not there, twice, out of order, or without a coefficient.
    ///
    /// A coupling is an equation between DOFs. A term that means nothing makes programs divide by zero, or drive the wrong
    /// joint. Most often the joints stand in another order than when the couplings were written.
    ///
    /// Write one term for each DOF, in DOF order, each with a coefficient other than 0.
    LOP004 "coupling-wrong", Error, clause "6.8.5", since "1.4.0",
    phase References, needs [ModuleV1(Kind::Loops), ModuleV1(Kind::Dof), Passed(DOF001)], check coupling_wrong,

    /// `independent_dof_idxs` has a DOF that is not there, twice, or out of order.
    ///
    /// These are the DOFs that a program sets; it takes the others from what closes the loops.
    ///
    /// Write the indices of the DOFs that move freely, ascending, each once.
    LOP005 "independent-dofs-wrong", Error, clause "6.8.7", since "1.4.0",
    phase References, needs [ModuleV1(Kind::Loops), ModuleV1(Kind::Dof), Passed(DOF001)], check independent_dofs_wrong,
}

fn loop_link_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    let count = context.robot()?.links.len();
    for (place, one) in loops.loops.iter().enumerate() {
        let ends = [("link_a_idx", one.link_a_idx), ("link_b_idx", one.link_b_idx)];
        let mut all_there = true;
        for (key, link) in ends.iter().filter(|(_, link)| link.get() >= count) {
            all_there = false;
            finding_in(Kind::Loops, format!("/loops/{place}/{key}"), "there is no such link")
                .values(format!("an index below {count}"), link.0)
                .report(findings);
        }
        if all_there && one.link_a_idx == one.link_b_idx {
            let pointer = format!("/loops/{place}/link_b_idx");
            finding_in(Kind::Loops, pointer, "the loop connects a link with itself")
                .values("another link", one.link_b_idx.0)
                .report(findings);
        }
    }
    Some(())
}

fn loop_name_repeated(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    let names = loops.loops.iter().map(|one| one.name.as_str());
    let names = names.chain(loops.couplings.iter().map(|one| one.name.as_str()));
    let count = loops.loops.len();
    let pointer = |index: usize| match index.checked_sub(count) {
        None => format!("/loops/{index}/name"),
        Some(coupling) => format!("/couplings/{coupling}/name"),
    };
    for (index, first, name) in repeated(names) {
        finding_in(Kind::Loops, pointer(index), "another loop or coupling has this name")
            .values("each name once", format!("`{name}`, as {}", pointer(first)))
            .report(findings);
    }
    Some(())
}

fn loop_quaternion_not_canonical(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    for (place, one) in loops.loops.iter().enumerate() {
        for (key, frame) in [("frame_a", &one.frame_a), ("frame_b", &one.frame_b)] {
            let pointer = format!("/loops/{place}/{key}/quaternion_wxyz");
            let quaternion = frame.quaternion_wxyz;
            report_not_canonical(Kind::Loops, pointer, quaternion, || true, findings);
        }
    }
    Some(())
}

fn loop_tolerance_negative(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    for (place, one) in loops.loops.iter().enumerate() {
        let tolerances = [
            ("position_tolerance", one.position_tolerance),
            ("rotation_tolerance", one.rotation_tolerance),
        ];
        for (key, tolerance) in tolerances.into_iter().filter(|(_, tolerance)| *tolerance < 0.0) {
            finding_in(Kind::Loops, format!("/loops/{place}/{key}"), "a tolerance is not negative")
                .values("at least 0", tolerance)
                .report(findings);
        }
    }
    Some(())
}

fn loop_closes_loosely(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    let reach = reach(context.robot()?, context.tree()?);
    for (place, one) in loops.loops.iter().enumerate() {
        let tolerances = [
            ("position_tolerance", one.position_tolerance, LOOSE * reach, "m"),
            ("rotation_tolerance", one.rotation_tolerance, LOOSE, "rad"),
        ];
        for (key, tolerance, most, unit) in tolerances {
            if tolerance <= most * (1.0 + NUMBER_RELATIVE) {
                continue;
            }
            let message = format!(
                "the ends of the loop `{}` stay up to {} {unit} apart where it counts as closed",
                one.name,
                number(tolerance, 2)
            );
            finding_in(Kind::Loops, format!("/loops/{place}/{key}"), message)
                .values(format!("at most {most:?}"), tolerance)
                .report(findings);
        }
    }
    Some(())
}

fn coupling_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    let count = document!(context, Dof)?.num_dofs.get();
    for (place, coupling) in loops.couplings.iter().enumerate() {
        let at = format!("/couplings/{place}/terms");
        if coupling.terms.is_empty() {
            finding_in(Kind::Loops, at, "this coupling is about no DOF")
                .values("a term for each DOF", "none")
                .report(findings);
            continue;
        }
        let dofs: Vec<DofIdx> = coupling.terms.iter().map(|term| term.dof_idx).collect();
        listed(&dofs, count, |term| format!("{at}/{term}/dof_idx"), findings);
        for (number, term) in coupling.terms.iter().enumerate() {
            if term.coefficients.iter().all(|coefficient| *coefficient == 0.0) {
                let pointer = format!("{at}/{number}/coefficients");
                finding_in(Kind::Loops, pointer, "this term adds nothing: leave it out")
                    .values("a coefficient other than 0", "zeros")
                    .report(findings);
            }
        }
    }
    Some(())
}

fn independent_dofs_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let loops = document!(context, Loops)?;
    let count = document!(context, Dof)?.num_dofs.get();
    let at = |place: usize| format!("/independent_dof_idxs/{place}");
    listed(&loops.independent_dof_idxs, count, at, findings);
    Some(())
}

/// Reports DOFs of a list that are not there, and the first that does not ascend.
fn listed(
    dofs: &[DofIdx],
    count: usize,
    pointer: impl Fn(usize) -> String,
    findings: &mut Findings,
) {
    for (place, dof) in dofs.iter().enumerate() {
        if dof.get() >= count {
            finding_in(Kind::Loops, pointer(place), "there is no such DOF")
                .values(format!("an index below {count}"), dof.0)
                .report(findings);
            return;
        }
    }
    if let Some(place) = (1..dofs.len()).find(|place| dofs[*place] <= dofs[place - 1]) {
        let message = match dofs[place] == dofs[place - 1] {
            true => "this DOF is there twice",
            false => "the DOFs do not ascend",
        };
        finding_in(Kind::Loops, pointer(place), message)
            .values(format!("an index above {}", dofs[place - 1].0), dofs[place].0)
            .report(findings);
    }
}
