use crate::rules::prelude::*;

declare_rule! {
    /// `skipped_reasons` repeats a reason, or the reasons are out of order.
    ///
    /// The order is `SameLink`, `Always`, `Adjacent`, `Default`, `Never`. It makes no difference to
    /// readers. With one order, the same choice is the same text, and differences between two URDDs are
    /// real ones.
    ///
    /// Name each reason once, in this order. (`urdd generate --skip` does it.)
    SHP027 "skipped-reasons-disordered", Error, clause "8.7", since "0.2.0",
    phase References, needs [Version1, ModuleV1(Kind::LinkShapesSkips)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let stated = &document!(context, LinkShapesSkips)?.skipped_reasons;
    let mut ordered = stated.clone();
    ordered.sort();
    ordered.dedup();
    if ordered != *stated {
        let words = |reasons: &[_]| {
            let words: Vec<String> = reasons.iter().map(ToString::to_string).collect();
            words.join(", ")
        };
        let message = "name each reason once, in the order of SPEC 8.6";
        let finding = finding_in(Kind::LinkShapesSkips, "/skipped_reasons", message);
        findings.report(finding.values(words(&ordered), words(stated)));
    }
    Some(())
}
