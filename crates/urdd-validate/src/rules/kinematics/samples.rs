use crate::rules::prelude::*;
use urdd_format::index::SampleIdx;
use urdd_format::kinematics_samples::ConfigurationKind;
use urdd_kinematics::ConfigurationSpace;
use urdd_kinematics::rotation::from_rotation_vector;

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
    phase References, needs [Version1, Module(Kind::KinematicsSamples), Passed(URD004), Passed(DOF003)],
    check sample_list_wrong,

    /// The configuration of a kinematics sample is not the one that the specification defines.
    ///
    /// Sampled configurations are defined, not drawn: number k is the same for every producer, so
    /// that sampled data can be computed again and compared. A producer whose numbers differ has its
    /// generator, its bounds or its order of DOFs wrong.
    ///
    /// Compare with the formulas and the tables of SPEC 9.3 and 9.4, step by step.
    KIN002 "sample-configuration-wrong", Error, clause "9.2", since "0.1.0",
    phase Kinematics, needs [
        Version1, Module(Kind::KinematicsSamples), ModuleV1(Kind::Chain), ModuleV1(Kind::Dof),
        ModuleV1(Kind::Bounds), Passed(KIN004), Passed(CHN002), Passed(CHN007), Passed(DOF003), Passed(DOF004),
        Passed(DOF005), Passed(BND001), Passed(BND002), Passed(BND003), Passed(BND006),
    ], check sample_configuration_wrong,
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
    format!("kind {kind}, sample_idx {}", or_null(number.map(|number| number.0)))
}

fn sample_configuration_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let samples = document!(context, KinematicsSamples)?;
    let chain = document!(context, Chain)?;
    let dof = document!(context, Dof)?;
    let bounds = document!(context, Bounds)?;
    let space = ConfigurationSpace::new(dof, chain, &bounds.bounds);
    let space = findings.or_skip(space.map_err(SkipReason::obstacle))?;
    for (place, sample) in samples.samples.iter().enumerate() {
        let expected = match (sample.kind, sample.sample_idx) {
            (ConfigurationKind::Zero, _) => space.zero(),
            (ConfigurationKind::Middle, _) => space.middle(),
            (ConfigurationKind::Lower, _) => space.lower(),
            (ConfigurationKind::Upper, _) => space.upper(),
            (ConfigurationKind::Sampled, Some(number)) => space.sampled(u64::from(number.0)),
            (ConfigurationKind::Sampled, None) => continue,
        };
        // Sampled rotation vectors are compared as rotations. Those of the other kinds are constants (SPEC 9.4) and are
        // compared number by number, like everything else.
        let vectors = match sample.kind {
            ConfigurationKind::Sampled => space.rotation_vectors(),
            _ => &[],
        };
        let found = &sample.configuration;
        for (dof, (expected, found)) in expected.iter().zip(found).enumerate() {
            if vectors.iter().any(|vector| vector.contains(&dof)) {
                continue;
            }
            let bounds = bounds.bounds.get(dof).copied().unwrap_or_default();
            report_off_by_bounds(bounds, [*expected, *found], findings, || {
                let pointer = format!("/samples/{place}/configuration/{dof}");
                let message =
                    format!("in the configuration {} this DOF has another value", sample.kind);
                finding_in(Kind::KinematicsSamples, pointer, message)
            });
        }
        for vector in vectors {
            let (expected, found) = (pick(&expected, vector)?, pick(found, vector)?);
            if same_rotation(expected, found) {
                continue;
            }
            let pointer = format!("/samples/{place}/configuration/{}", vector[0]);
            let message = format!(
                "in the configuration {} the rotation vector that begins here has another value",
                sample.kind
            );
            finding_in(Kind::KinematicsSamples, pointer, message)
                .literals(expected, found)
                .tolerance(ROTATION)
                .report(findings);
        }
    }
    Some(())
}

pub fn pick(configuration: &[f64], dofs: &[usize; 3]) -> Option<[f64; 3]> {
    let [x, y, z] = dofs.map(|dof| configuration.get(dof).copied());
    Some([x?, y?, z?])
}

/// Compares two rotation vectors as rotations: at half a turn, a vector and its opposite are the same. No vector may be
/// longer than half a turn.
fn same_rotation(expected: [f64; 3], found: [f64; 3]) -> bool {
    let length = found.iter().map(|x| x * x).sum::<f64>().sqrt();
    length <= std::f64::consts::PI * (1.0 + ROTATION) && turn_alike(expected, found)
}

/// Whether two rotation vectors, whatever their lengths, are the same rotation.
pub fn turn_alike(a: [f64; 3], b: [f64; 3]) -> bool {
    let matrix = |v| *from_rotation_vector(v).to_rotation_matrix().matrix();
    rotation_distance(&matrix(a), &matrix(b)) <= ROTATION
}
