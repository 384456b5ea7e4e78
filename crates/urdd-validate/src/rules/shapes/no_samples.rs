use crate::rules::prelude::*;

declare_rule! {
    /// The distance statistics are said to be of no samples.
    ///
    /// `num_samples` is the number of sampled configurations that the distances were taken over;
    /// without any there is no mean, smallest or largest distance.
    ///
    /// Write the number of configurations that were sampled, at least 1.
    SHP016 "no-samples", Error, clause "8.5", since "0.1.0",
    phase References, consequence Format, needs [Version1, ModuleV1(Kind::LinkShapesDistanceStatistics)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let statistics = document!(context, LinkShapesDistanceStatistics)?;
    if statistics.num_samples.get() == 0 {
        let message = "distances are taken over at least one sampled configuration";
        finding_in(Kind::LinkShapesDistanceStatistics, "/num_samples", message)
            .values("1 or more", 0)
            .report(findings);
    }
    Some(())
}
