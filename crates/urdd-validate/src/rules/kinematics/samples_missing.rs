use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::ModuleKind;

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
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::KinematicsSamples;
    // A module that is listed and not there is DIR002's.
    let listed = context.metadata().is_some_and(|metadata| {
        metadata
            .modules
            .iter()
            .any(|module| module.name == kind.name())
    });
    if context.module(kind).is_none() && !listed {
        findings.report(Finding::in_directory(
            "kinematics_samples_module is missing; consumers test their forward kinematics with it",
        ));
    }
}
