use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::{ModuleDocument, ModuleKind};

declare_rule! {
    /// The distance statistics are said to be of no samples.
    ///
    /// `num_samples` is the number of sampled configurations that the distances were taken over;
    /// without any there is no mean, smallest or largest distance.
    ///
    /// Write the number of configurations that were sampled, at least 1.
    SHP016 "no-samples", Error, clause "8.5", since "0.1.0",
    phase References, consequence Format, needs [Version1, Module(Kind::LinkShapesDistanceStatistics)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesDistanceStatistics;
    let (Some(ModuleDocument::LinkShapesDistanceStatistics(statistics)), Some(module)) =
        (context.document(kind), context.module(kind))
    else {
        return;
    };
    if statistics.num_samples.get() == 0 {
        findings.report(
            Finding::at(
                module.file("module.json"),
                "/num_samples",
                "distances are taken over at least one sampled configuration",
            )
            .expected("1 or more")
            .actual(0),
        );
    }
}
