use crate::rules::prelude::*;
use urdd_format::index::DofIdx;

declare_rule! {
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
