use crate::rules::prelude::*;

declare_rule! {
    /// There is no `kinematics_samples_module`.
    ///
    /// It holds configurations and the pose of every link in each: golden values with which a
    /// consumer in any language proves its own forward kinematics right, and which show years later
    /// what the producer meant.
    ///
    /// Write it: zero, middle, lower and upper configuration, and a few sampled ones.
    KIN005 "samples-missing", Warning, clause "9.2", since "0.1.0",
    phase Files, consequence Format, needs [Version1],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::KinematicsSamples;
    // DIR002 reports a module that is listed and missing.
    let mut listed = context.metadata().into_iter().flat_map(|metadata| &metadata.modules);
    if context.module(kind).is_none() && listed.all(|module| module.name != kind.name()) {
        let message =
            "kinematics_samples_module is missing; consumers test their forward kinematics with it";
        Finding::in_directory(message).report(findings);
    }
    Some(())
}
