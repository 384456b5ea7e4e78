use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::{ModuleDocument, ModuleKind};

declare_rule! {
    /// `skipped_reasons` repeats a reason, or the reasons are out of order.
    ///
    /// The order is `SameLink`, `Always`, `Adjacent`, `Default`, `Never`. It changes nothing for who
    /// reads them. With one order, the same choice is the same text, and differences between two URDDs
    /// are real ones.
    ///
    /// Name each reason once, in this order. (`urdd generate --skip` does it.)
    SHP027 "skipped-reasons-disordered", Error, clause "8.7", since "0.2.0",
    phase References, needs [Version1, Module(Kind::LinkShapesSkips)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesSkips;
    let (Some(ModuleDocument::LinkShapesSkips(skips)), Some(module)) =
        (context.document(kind), context.module(kind))
    else {
        return;
    };
    let stated = &skips.skipped_reasons;
    let mut ordered = stated.clone();
    ordered.sort();
    ordered.dedup();
    if ordered == *stated {
        return;
    }
    let words = |reasons: &[_]| {
        let words: Vec<String> = reasons.iter().map(ToString::to_string).collect();
        words.join(", ")
    };
    findings.report(
        Finding::at(
            module.file("module.json"),
            "/skipped_reasons",
            "name each reason once, in the order of SPEC 8.6",
        )
        .expected(words(&ordered))
        .actual(words(stated)),
    );
}
