use crate::rules::prelude::*;
use urdd_format::kinematics_samples::ConfigurationKind;
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
        Version1, Module(Kind::KinematicsSamples), ModuleV1(Kind::Chain), ModuleV1(Kind::Dof),
        ModuleV1(Kind::Bounds), Passed(KIN004), Passed(CHN002), Passed(CHN007), Passed(DOF003), Passed(DOF004),
        Passed(DOF005), Passed(BND001), Passed(BND002), Passed(BND003), Passed(BND006),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
            let in_vector = vectors.iter().any(|vector| vector.contains(&dof));
            // Sums of bounds cancel: what matters is the size of the bounds, not of the sum.
            let bounds = bounds.bounds.get(dof);
            let size = bounds.map_or(0.0, |[lower, upper]| lower.abs().max(upper.abs()));
            let tolerance = number_tolerance(*expected, *found).max(NUMBER_RELATIVE * size);
            if in_vector || (expected - found).abs() <= tolerance {
                continue;
            }
            let kind = sample.kind;
            let pointer = format!("/samples/{place}/configuration/{dof}");
            let message = format!("in the configuration {kind} this DOF has another value");
            finding_in(Kind::KinematicsSamples, pointer, message)
                .values(expected, found)
                .tolerance(tolerance)
                .report(findings);
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

fn pick(configuration: &[f64], dofs: &[usize; 3]) -> Option<[f64; 3]> {
    let [x, y, z] = dofs.map(|dof| configuration.get(dof).copied());
    Some([x?, y?, z?])
}

/// Compares two rotation vectors as rotations: at half a turn, a vector and its opposite are the same. No vector may be
/// longer than half a turn.
fn same_rotation(expected: [f64; 3], found: [f64; 3]) -> bool {
    let length = found.iter().map(|x| x * x).sum::<f64>().sqrt();
    let matrix = |v| *from_rotation_vector(v).to_rotation_matrix().matrix();
    length <= std::f64::consts::PI * (1.0 + ROTATION)
        && rotation_distance(&matrix(expected), &matrix(found)) <= ROTATION
}
