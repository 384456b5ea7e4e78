use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::index::SampleIdx;
use urdd_format::kinematics_samples::ConfigurationKind;
use urdd_format::registry::{ModuleDocument, ModuleKind};

declare_rule! {
    /// The samples are not zero, middle, lower, upper, and then sampled ones numbered from 0.
    ///
    /// A consumer looks a sample up by its place and kind; a sample that is left out or numbered
    /// otherwise gives it the wrong poses to compare with, or none at all.
    ///
    /// Write the four named configurations first, then samples 0, 1, 2 and so on without gaps, each
    /// with one value per DOF and one pose per link.
    KIN004 "sample-list-wrong", Error, clause "9.2", since "0.1.0",
    phase References, needs [Version1, Module(Kind::KinematicsSamples), Passed(URD004), Passed(DOF003)],
    check check,
}

/// Samples with these kinds come first, in this order.
const NAMED: [ConfigurationKind; 4] = [
    ConfigurationKind::Zero,
    ConfigurationKind::Middle,
    ConfigurationKind::Lower,
    ConfigurationKind::Upper,
];

fn check(context: &Context, findings: &mut Findings) {
    let (Some(module), Some(robot), Some(dofs)) = (
        context.module(ModuleKind::KinematicsSamples),
        context.robot(),
        context.dofs(),
    ) else {
        return;
    };
    let Some(ModuleDocument::KinematicsSamples(document)) = &module.document else {
        return;
    };
    let file = module.file("module.json");
    for (place, sample) in document.samples.iter().enumerate() {
        let (kind, number) = match NAMED.get(place) {
            Some(kind) => (*kind, None),
            None => (
                ConfigurationKind::Sampled,
                u32::try_from(place - NAMED.len()).ok().map(SampleIdx),
            ),
        };
        if (sample.kind, sample.sample_idx) != (kind, number) {
            let message = "a sample is in the wrong place; write Zero, Middle, Lower, Upper, then Sampled with sample_idx 0, 1, 2, …";
            // Whatever follows is displaced too: one mistake, one message.
            return findings.report(
                Finding::at(file, format!("/samples/{place}"), message)
                    .expected(describe(kind, number))
                    .actual(describe(sample.kind, sample.sample_idx)),
            );
        }
        let lengths = [
            (
                "configuration",
                sample.configuration.len(),
                dofs.num_dofs.get(),
                "DOF",
            ),
            (
                "link_poses",
                sample.link_poses.len(),
                robot.links.len(),
                "link",
            ),
        ];
        for (key, found, expected, unit) in lengths {
            if found != expected {
                findings.report(
                    Finding::at(
                        file.clone(),
                        format!("/samples/{place}/{key}"),
                        format!("`{key}` needs one entry per {unit}"),
                    )
                    .expected(format!("{expected} entries"))
                    .actual(format!("{found} entries")),
                );
            }
        }
    }
    if let Some(missing) = NAMED.get(document.samples.len()) {
        let message = format!(
            "the configuration {missing} is missing; the first four samples are Zero, Middle, Lower, Upper"
        );
        findings.report(Finding::at(file, "/samples", message).expected(missing));
    }
}

fn describe(kind: ConfigurationKind, number: Option<SampleIdx>) -> String {
    match number {
        Some(number) => format!("kind {kind}, sample_idx {number}"),
        None => format!("kind {kind}, sample_idx null"),
    }
}
