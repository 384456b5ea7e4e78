use crate::rules::prelude::*;
use urdd_format::index::SampleIdx;
use urdd_format::kinematics_samples::ConfigurationKind;

declare_rule! {
    /// There is no `kinematics_samples_module`.
    ///
    /// It holds configurations and the pose of every link in each: golden values with which a
    /// consumer in any language proves its own forward kinematics right, and which show years later
    /// what the producer meant.
    ///
    /// Write it: zero, middle, lower and upper configuration, and a few sampled ones.
    KIN005 "samples-missing", Warning, clause "9.2", since "0.1.0",
    phase Files, consequence Format, needs [Version1], check samples_missing,

    /// The samples are not zero, middle, lower, upper, and then sampled ones numbered from 0.
    ///
    /// A consumer looks a sample up by its place and kind; a sample that is left out or numbered
    /// otherwise gives it the wrong poses to compare with, or none at all.
    ///
    /// Write the four named configurations first, then samples 0, 1, 2 and so on without gaps, each
    /// with one value per DOF and one pose per link.
    KIN004 "sample-list-wrong", Error, clause "9.2", since "0.1.0",
    phase References, needs [Version1, Module(Kind::KinematicsSamples), Passed(URD004), Passed(DOF003)], check sample_list_wrong,
}

fn samples_missing(context: &Context, findings: &mut Findings) -> Option<()> {
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

/// The kinds of the first samples, in order.
const NAMED: [ConfigurationKind; 4] = [
    ConfigurationKind::Zero,
    ConfigurationKind::Middle,
    ConfigurationKind::Lower,
    ConfigurationKind::Upper,
];

fn sample_list_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let samples = &document!(context, KinematicsSamples)?.samples;
    let (dofs, links) = (context.dofs()?.num_dofs.get(), context.robot()?.links.len());
    for (place, sample) in samples.iter().enumerate() {
        let (kind, number) = match NAMED.get(place) {
            Some(kind) => (*kind, None),
            None => {
                let number = u32::try_from(place - NAMED.len()).ok();
                (ConfigurationKind::Sampled, number.map(SampleIdx))
            }
        };
        if (sample.kind, sample.sample_idx) != (kind, number) {
            let message = "a sample is in the wrong place; write Zero, Middle, Lower, Upper, then Sampled with sample_idx 0, 1, 2, …";
            finding_in(Kind::KinematicsSamples, format!("/samples/{place}"), message)
                .values(describe(kind, number), describe(sample.kind, sample.sample_idx))
                .report(findings);
            // The samples that follow are displaced too: one mistake, one finding.
            return Some(());
        }
        for (key, unit, found, expected) in [
            ("configuration", "DOF", sample.configuration.len(), dofs),
            ("link_poses", "link", sample.link_poses.len(), links),
        ] {
            if found != expected {
                let pointer = format!("/samples/{place}/{key}");
                finding_in(
                    Kind::KinematicsSamples,
                    pointer,
                    format!("`{key}` needs one entry per {unit}"),
                )
                .counts(expected, found, "entries")
                .report(findings);
            }
        }
    }
    if let Some(missing) = NAMED.get(samples.len()) {
        let message = format!(
            "the configuration {missing} is missing; the first four samples are Zero, Middle, Lower, Upper"
        );
        finding_in(Kind::KinematicsSamples, "/samples", message).expected(missing).report(findings);
    }
    Some(())
}

fn describe(kind: ConfigurationKind, number: Option<SampleIdx>) -> String {
    match number {
        Some(number) => format!("kind {kind}, sample_idx {number}"),
        None => format!("kind {kind}, sample_idx null"),
    }
}
