use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::skip::SkipReason;
use crate::tolerance::{NUMBER_RELATIVE, ROTATION, number_tolerance, rotation_distance};
use urdd_format::kinematics_samples::ConfigurationKind;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_kinematics::ConfigurationSpace;
use urdd_kinematics::rotation::from_rotation_vector;

declare_rule! {
    /// The configuration of a kinematics sample is not the one that the specification defines.
    ///
    /// Sampled configurations are defined, not drawn: number k is the same for every producer, so
    /// that sampled data can be computed again and compared. A producer whose numbers differ has its
    /// generator, its bounds or its order of DOFs wrong.
    ///
    /// Compare with the formulas and the tables of SPEC 9.3 and 9.4, step by step.
    KIN002 "sample-configuration-wrong", Error, clause "9.2", since "0.1.0",
    phase Kinematics,
    needs [
        Version1, Module(Kind::KinematicsSamples), Module(Kind::Chain), Module(Kind::Dof), Module(Kind::Bounds), Passed(KIN004),
        Passed(CHN002), Passed(CHN007), Passed(DOF003), Passed(DOF004), Passed(DOF005),
        Passed(BND001), Passed(BND002), Passed(BND003), Passed(BND006),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some(module) = context.module(ModuleKind::KinematicsSamples) else {
        return;
    };
    let (
        Some(ModuleDocument::KinematicsSamples(samples)),
        Some(ModuleDocument::Chain(chain)),
        Some(ModuleDocument::Dof(dof)),
        Some(ModuleDocument::Bounds(bounds)),
    ) = (
        &module.document,
        context.document(ModuleKind::Chain),
        context.document(ModuleKind::Dof),
        context.document(ModuleKind::Bounds),
    )
    else {
        return;
    };
    let space = match ConfigurationSpace::new(dof, chain, bounds) {
        Ok(space) => space,
        Err(error) => return findings.skip(SkipReason::Kinematics(error.to_string())),
    };
    for (place, sample) in samples.samples.iter().enumerate() {
        let expected = match (sample.kind, sample.sample_idx) {
            (ConfigurationKind::Zero, _) => space.zero(),
            (ConfigurationKind::Middle, _) => space.middle(),
            (ConfigurationKind::Lower, _) => space.lower(),
            (ConfigurationKind::Upper, _) => space.upper(),
            (ConfigurationKind::Sampled, Some(number)) => space.sampled(u64::from(number.0)),
            (ConfigurationKind::Sampled, None) => continue,
        };
        // Rotation vectors that are drawn are compared as rotations; those of the other kinds are
        // constants (SPEC 9.4), compared number by number as everything else.
        let vectors = match sample.kind {
            ConfigurationKind::Sampled => space.rotation_vectors(),
            _ => &[],
        };
        let found = &sample.configuration;
        for (dof, (expected, found)) in expected.iter().zip(found).enumerate() {
            let in_vector = vectors.iter().any(|vector| vector.contains(&dof));
            // Sums of bounds cancel: what counts is how large the bounds are, not the sum.
            let size = bounds
                .bounds
                .get(dof)
                .map_or(0.0, |[lower, upper]| lower.abs().max(upper.abs()));
            let tolerance = number_tolerance(*expected, *found).max(NUMBER_RELATIVE * size);
            if in_vector || (expected - found).abs() <= tolerance {
                continue;
            }
            findings.report(
                Finding::at(
                    module.file("module.json"),
                    format!("/samples/{place}/configuration/{dof}"),
                    format!(
                        "in the configuration {} this DOF has another value",
                        sample.kind
                    ),
                )
                .expected(expected)
                .actual(found)
                .tolerance(tolerance),
            );
        }
        for vector in vectors {
            let (Some(expected), Some(found)) = (pick(&expected, vector), pick(found, vector))
            else {
                continue;
            };
            if same_rotation(expected, found) {
                continue;
            }
            findings.report(
                Finding::at(
                    module.file("module.json"),
                    format!("/samples/{place}/configuration/{}", vector[0]),
                    format!("in the configuration {} the rotation vector that begins here has another value", sample.kind),
                )
                .expected(format!("{expected:?}"))
                .actual(format!("{found:?}"))
                .tolerance(ROTATION),
            );
        }
    }
}

fn pick(configuration: &[f64], dofs: &[usize; 3]) -> Option<[f64; 3]> {
    let [x, y, z] = dofs.map(|dof| configuration.get(dof).copied());
    Some([x?, y?, z?])
}

/// Compared as rotations, since at half a turn a vector and its opposite are the same; but longer
/// than half a turn no vector may be.
fn same_rotation(expected: [f64; 3], found: [f64; 3]) -> bool {
    let length = found.iter().map(|x| x * x).sum::<f64>().sqrt();
    let matrix = |v| *from_rotation_vector(v).to_rotation_matrix().matrix();
    length <= std::f64::consts::PI * (1.0 + ROTATION)
        && rotation_distance(&matrix(expected), &matrix(found)) <= ROTATION
}
